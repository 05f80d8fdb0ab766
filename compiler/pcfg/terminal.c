/* Reads terminals: the name of an operation and its arguments, as the published program writes them. */
#include "compiler/pcfg/terminal.h"

#include <stdlib.h>
#include <string.h>

typedef struct operation {
    const char *name;
    tn_step_kind kind;
    uint32_t arguments;
    const char *example;
} operation;

static const operation operations[] = {
    {"Move", TN_STEP_MOVE, 3, "Move(0,3,0)"},
    {"Rotate", TN_STEP_TURN, 1, "Rotate(90)"},
    {"SetColor", TN_STEP_COLOUR, 1, "SetColor(4)"},
    {"Place", TN_STEP_PART, 1, "Place(3001)"},
    {"FillRect", TN_STEP_FILL, 3, "FillRect(8,3,4)"},
    {"FillRectNoCheck", TN_STEP_FILL_OVER, 3, "FillRectNoCheck(8,3,4)"},
    {"AssertFilled", TN_STEP_TOUCH, 0, "AssertFilled()"},
    {"PlaceBoundingBox", TN_STEP_BOUND_BOX, 3, "PlaceBoundingBox(8,9,8)"},
    {"PlaceBoundingSphere", TN_STEP_BOUND_BALL, 1, "PlaceBoundingSphere(8)"},
};
enum { OPERATIONS = sizeof operations / sizeof *operations };

typedef struct reading {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_pcfg_item *item;
} reading;

/* The place of a piece of the terminal. */
static tn_span place_of(const reading *r, const char *text, size_t length)
{
    const tn_pcfg_item *item = r->item;
    uint32_t begin = item->span.begin + 1 + (uint32_t)(text - item->text.text);
    return (tn_span){item->span.file, begin, begin + (uint32_t)length};
}

static tn_diagnostic *refuse(const reading *r, tn_code code, const char *text, size_t length, const char *message)
{
    r->item->unknown = true;
    return tn_report(r->diagnostics, code, place_of(r, text, length), "%s", message);
}

/* What the operation takes, and an example. */
static void help_with(const reading *r, tn_diagnostic *d, const operation *op)
{
    const char *takes = op->kind == TN_STEP_PART ? "the name of a part"
                        : op->arguments == 0     ? "nothing"
                        : op->arguments == 1     ? "one whole number"
                                                 : "three whole numbers";
    tn_help(r->diagnostics, d, "%s takes %s: '%s', for example", op->name, takes, op->example);
}

static void unknown_operation(const reading *r, size_t length)
{
    const char *names[OPERATIONS], *text = r->item->text.text;
    const char *wanted = tn_arena_copy(r->arena, text, length);
    for (size_t i = 0; i < OPERATIONS; i++)
        names[i] = operations[i].name;
    const char *near = wanted ? tn_nearest(wanted, names, OPERATIONS) : NULL;
    tn_diagnostic *d =
        refuse(r, E_PLACE_TERMINAL, text, length ? length : r->item->text.length, "there is no such step");
    if (near)
        tn_suggest(r->diagnostics, d, "%s", near);
    else
        tn_help(r->diagnostics, d,
                "the steps are (, ), Move, Rotate, SetColor, Place, FillRect, FillRectNoCheck, AssertFilled, "
                "PlaceBoundingBox and PlaceBoundingSphere");
}

/* The operation that the terminal names, with its arguments; NULL where it is none. */
static const operation *find_operation(const reading *r, tn_pcfg_text *arguments)
{
    tn_pcfg_text text = r->item->text;
    const char *open = memchr(text.text, '(', text.length);
    size_t length = open ? (size_t)(open - text.text) : text.length;
    const operation *found = NULL;
    for (size_t i = 0; i < OPERATIONS; i++)
        if (strlen(operations[i].name) == length && memcmp(operations[i].name, text.text, length) == 0)
            found = &operations[i];
    if (!found) {
        unknown_operation(r, length);
        return NULL;
    }
    const char *end = text.text + text.length, *close = open ? memchr(open, ')', (size_t)(end - open)) : NULL;
    bool nested = open && memchr(open + 1, '(', (size_t)(end - open - 1));
    if (!close || close + 1 != end || nested) {
        tn_diagnostic *d = refuse(r, E_PLACE_TERMINAL, text.text, text.length,
                                  "a step ends with its arguments in one pair of parentheses");
        help_with(r, d, found);
        return NULL;
    }
    *arguments = (tn_pcfg_text){open + 1, (size_t)(close - open - 1)};
    return found;
}

static tn_pcfg_text trim(tn_pcfg_text text)
{
    while (text.length && strchr(" \t\f\v", text.text[0])) {
        text.text++;
        text.length--;
    }
    while (text.length && strchr(" \t\f\v", text.text[text.length - 1]))
        text.length--;
    return text;
}

/* The largest number of an operation's arguments, either way from 0. */
static int32_t largest(const operation *op)
{
    return op->kind == TN_STEP_MOVE     ? TN_PLACE_FAR
           : op->kind == TN_STEP_COLOUR ? TN_PLACE_COLOUR_MAX
           : op->kind == TN_STEP_TURN   ? TN_PLACE_FAR
                                        : TN_PLACE_SIZE_MAX;
}

static void read_number(const reading *r, const operation *op, tn_pcfg_text argument, int32_t *value)
{
    tn_pcfg_text text = trim(argument);
    bool sign = text.length && (text.text[0] == '-' || text.text[0] == '+');
    const char *digits = text.text + sign;
    size_t count = text.length - sign;
    int64_t number = 0;
    for (size_t i = 0; i < count; i++) {
        if (digits[i] < '0' || digits[i] > '9') {
            count = 0;
            break;
        }
    }
    if (count == 0) {
        tn_diagnostic *d =
            refuse(r, E_PLACE_ARGUMENT, text.text, text.length ? text.length : 1, "this is no whole number");
        help_with(r, d, op);
        return;
    }
    if (!tn_integer_read(digits, count, &number) || number > largest(op)) {
        tn_diagnostic *d = refuse(r, E_PLACE_ARGUMENT, text.text, text.length, "this number is too large");
        tn_help(r->diagnostics, d, "%s takes numbers from -%d to %d", op->name, largest(op), largest(op));
        return;
    }
    *value = (int32_t)(text.text[0] == '-' ? -number : number);
}

static void read_numbers(const reading *r, const operation *op, tn_pcfg_text arguments)
{
    tn_pcfg_text rest = arguments;
    uint32_t count = 1;
    for (size_t i = 0; i < arguments.length; i++)
        count += arguments.text[i] == ',';
    if (count != op->arguments) {
        tn_diagnostic *d = refuse(r, E_PLACE_TERMINAL, r->item->text.text, r->item->text.length,
                                  "a step with too few or too many arguments");
        help_with(r, d, op);
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        const char *comma = memchr(rest.text, ',', rest.length);
        size_t length = comma ? (size_t)(comma - rest.text) : rest.length;
        read_number(r, op, (tn_pcfg_text){rest.text, length}, &r->item->step.a[i]);
        size_t used = comma ? length + 1 : length;
        rest = (tn_pcfg_text){rest.text + used, rest.length - used};
    }
}

/* ---- warnings */

static void warn_of_size(const reading *r)
{
    const tn_step *step = &r->item->step;
    if (step->kind != TN_STEP_FILL && step->kind != TN_STEP_FILL_OVER)
        return;
    if (step->a[0] % 2 == 0 && step->a[2] % 2 == 0)
        return;
    tn_diagnostic *d = tn_report(r->diagnostics, W_PLACE_ODD_SIZE, r->item->span,
                                 "an odd width or depth is rounded down: the box is %d x %d x %d",
                                 abs(step->a[0]) / 2 * 2, step->a[1], abs(step->a[2]) / 2 * 2);
    tn_help(r->diagnostics, d, "a stud is 2 wide: write even numbers");
}

/* Quarter turns towards zero. */
static void settle_angle(const reading *r)
{
    tn_step *step = &r->item->step;
    int32_t angle = step->a[0], turns = angle / 90;
    step->a[0] = (turns % 4 + 4) % 4;
    if (angle % 90 == 0)
        return;
    tn_diagnostic *d = tn_report(r->diagnostics, W_PLACE_ANGLE, r->item->span,
                                 "an angle of %d is not a quarter turn: the step turns by %d", angle, turns * 90);
    tn_help(r->diagnostics, d, "write 0, 90, 180 or 270");
}

static void read_part(const reading *r, const operation *op, tn_pcfg_text name)
{
    if (name.length == 0) {
        tn_diagnostic *d =
            refuse(r, E_PLACE_TERMINAL, r->item->text.text, r->item->text.length, "a part without a name");
        help_with(r, d, op);
        return;
    }
    char *text = tn_arena_copy(r->arena, name.text, name.length);
    r->item->step.text = text;
    if (!text || !strchr(text, 'r'))
        return;
    char *written = tn_arena_copy(r->arena, name.text, name.length);
    if (!written)
        return;
    size_t length = 0;
    for (const char *c = text; *c; c++)
        if (*c != 'r')
            written[length++] = *c;
    written[length] = '\0';
    tn_diagnostic *d = tn_report(r->diagnostics, W_PLACE_PART_NAME, place_of(r, name.text, name.length),
                                 "the letter r is left out of part names: a model file says %s.dat", written);
    tn_help(r->diagnostics, d, "the published program does so too; name the part without that letter");
}

void tn_pcfg_read_terminal(tn_arena *arena, tn_diagnostics *diagnostics, tn_pcfg_item *item)
{
    const reading r = {arena, diagnostics, item};
    tn_pcfg_text arguments;
    if (item->text.length == 1 && (item->text.text[0] == '(' || item->text.text[0] == ')')) {
        item->step.kind = item->text.text[0] == '(' ? TN_STEP_PUSH : TN_STEP_POP;
        return;
    }
    const operation *op = find_operation(&r, &arguments);
    if (!op)
        return;
    item->step.kind = op->kind;
    if (op->kind == TN_STEP_PART) {
        read_part(&r, op, arguments);
    } else if (op->arguments > 0) {
        read_numbers(&r, op, arguments);
    } else if (trim(arguments).length > 0) {
        tn_diagnostic *d =
            refuse(&r, E_PLACE_TERMINAL, item->text.text, item->text.length, "a step with too many arguments");
        help_with(&r, d, op);
    }
    if (item->unknown)
        return;
    warn_of_size(&r);
    if (op->kind == TN_STEP_TURN)
        settle_angle(&r);
}
