/* Checks a connection grammar: symbols, terminals, probabilities, what can be reached; and warns of what it surely does
 * not mean. */
#include <stdlib.h>
#include <string.h>

#include "compiler/pcfg/ast.h"
#include "runtime/place/model/frame.h"

/* ==== reads terminals: the name of an operation and its arguments, as the published program writes them */

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

/* The operation that the terminal names, with its arguments; NULL if it is none. */
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

/* Sets the item's step, or reports what is wrong and marks it as unknown. Warns about what is probably wrong. */
static void pcfg_read_terminal(tn_arena *arena, tn_diagnostics *diagnostics, tn_pcfg_item *item)
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

/* ==== warns of what a connection grammar says and surely does not mean */

/* ---- before the first bound */

static void find_nullable(const tn_pcfg_grammar *g)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t s = 0; s < g->count; s++) {
            tn_pcfg_symbol *symbol = g->symbols[s];
            for (const tn_pcfg_alternative *a = symbol->alternatives.first; a && !symbol->nullable; a = a->next) {
                const tn_pcfg_item *item = a->first;
                while (item && item->kind == TN_PCFG_NAME && tn_pcfg_symbol_of(g, item)->nullable)
                    item = item->next;
                symbol->nullable = !item;
                changed |= symbol->nullable;
            }
        }
    }
}

/* A step that is no bound and can be the first of all; NULL if there is none. */
static const tn_pcfg_item *first_step(const tn_pcfg_grammar *g)
{
    uint32_t *pending = TN_NEW_ARRAY(g->arena, uint32_t, g->count + 1), count = 0;
    if (!pending)
        return NULL;
    pending[count++] = 0;
    g->symbols[0]->visited = true;
    while (count > 0) {
        const tn_pcfg_symbol *symbol = g->symbols[pending[--count]];
        for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next) {
            for (const tn_pcfg_item *item = a->first; item; item = item->next) {
                if (item->kind == TN_PCFG_TERMINAL && !tn_step_is_bound(item->step.kind))
                    return item;
                if (item->kind == TN_PCFG_TERMINAL)
                    break;
                tn_pcfg_symbol *next = tn_pcfg_symbol_of(g, item);
                if (!next->visited)
                    pending[count++] = next->index;
                next->visited = true;
                if (!next->nullable)
                    break;
            }
        }
    }
    return NULL;
}

static void check_first_step(const tn_pcfg_grammar *g)
{
    find_nullable(g);
    const tn_pcfg_item *item = first_step(g);
    if (!item)
        return;
    tn_diagnostic *d = tn_report(g->diagnostics, W_PLACE_BEFORE_BOUND, item->span,
                                 "this step can come before the first bound: after it, as nothing is filled, a ball of "
                                 "radius 8 bounds the model too");
    tn_help(g->diagnostics, d, "begin with the bound: %s -> 'PlaceBoundingBox(8,9,8)' ...", g->symbols[0]->name);
}

/* ---- lookaheads */

enum { STEPS_MAX = 4096, FRAMES_MAX = 64, DEPTH_MAX = 64 };

/* A walk through an alternative, each symbol in it replaced by its last alternative. */
typedef struct walk {
    const tn_pcfg_grammar *grammar;
    tn_frame frames[FRAMES_MAX];
    uint32_t depth, steps;
    bool may_fail, fills, stopped;
    tn_cell_box first; /* the first box that must be free */
} walk;

static void take(walk *w, const tn_step *step)
{
    w->may_fail |= tn_step_may_fail(step->kind);
    if (step->kind == TN_STEP_FILL && !w->fills) {
        w->fills = true;
        w->first = tn_frame_box(&w->frames[w->depth], step);
    } else if (step->kind == TN_STEP_PUSH && w->depth + 1 < FRAMES_MAX) {
        w->frames[w->depth + 1] = w->frames[w->depth];
        w->depth++;
    } else if (step->kind == TN_STEP_POP && w->depth > 0) {
        w->depth--;
    } else if (step->kind == TN_STEP_PUSH || step->kind == TN_STEP_POP) {
        w->stopped = true;
    } else {
        w->stopped |= !tn_frame_step(&w->frames[w->depth], step);
    }
}

static void go_through(walk *w, const tn_pcfg_alternative *alternative, uint32_t depth)
{
    for (const tn_pcfg_item *item = alternative->first; item && !w->stopped && !w->fills; item = item->next) {
        w->stopped = ++w->steps > STEPS_MAX || depth > DEPTH_MAX;
        if (item->kind == TN_PCFG_TERMINAL)
            take(w, &item->step);
        else if (!w->stopped)
            go_through(w, tn_pcfg_symbol_of(w->grammar, item)->alternatives.last, depth + 1);
    }
}

static walk look(const tn_pcfg_grammar *g, const tn_pcfg_alternative *alternative)
{
    walk w = {.grammar = g};
    go_through(&w, alternative, 0);
    return w;
}

static void check_close(const tn_pcfg_grammar *g, const tn_pcfg_symbol *symbol)
{
    const tn_pcfg_alternative *last = symbol->alternatives.last;
    if (symbol->drawn || symbol->count < 2 || !look(g, last).may_fail)
        return;
    tn_diagnostic *d =
        tn_report(g->diagnostics, W_PLACE_NO_CLOSE, last->span,
                  "where no alternative of %s fits, this last one is taken although it does not fit", symbol->name);
    tn_help(g->diagnostics, d, "give %s a last alternative that always fits, such as an empty one: %s ->", symbol->name,
            symbol->name);
}

/* Does a box hold one of the eight cells around the place that the symbol is expanded at? */
static bool touches(const tn_cell_box *box)
{
    for (int k = 0; k < 3; k++)
        if (box->low[k] >= 1 || box->high[k] <= -1)
            return false;
    return true;
}

/* Alternatives of a symbol that fills its place should all do so. */
static void check_touch(const tn_pcfg_grammar *g, const tn_pcfg_symbol *symbol)
{
    const tn_pcfg_alternative *touching = NULL;
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; a && !touching; a = a->next) {
        walk w = look(g, a);
        touching = w.fills && touches(&w.first) ? a : NULL;
    }
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; touching && a; a = a->next) {
        walk w = look(g, a);
        if (!w.fills || touches(&w.first))
            continue;
        tn_diagnostic *d = tn_report(g->diagnostics, W_PLACE_NO_TOUCH, a->span,
                                     "this alternative of %s misses its place: its box has the cells %d to %d, %d to "
                                     "%d, %d to %d from there",
                                     symbol->name, w.first.low[0], w.first.high[0] - 1, w.first.low[1],
                                     w.first.high[1] - 1, w.first.low[2], w.first.high[2] - 1);
        tn_note(g->diagnostics, d, &touching->span, "this one touches it");
    }
}

void tn_pcfg_warn(const tn_pcfg_grammar *g)
{
    check_first_step(g);
    for (uint32_t s = 0; s < g->count; s++) {
        if (!g->symbols[s]->reached)
            continue;
        check_close(g, g->symbols[s]);
        check_touch(g, g->symbols[s]);
    }
}

/* ==== checks a connection grammar: symbols, terminals, probabilities, what can be reached */

/* ---- symbols */

static tn_pcfg_symbol *symbol_named(tn_pcfg_grammar *g, const tn_pcfg_rule *rule)
{
    char *name = tn_arena_copy(g->arena, rule->name.text, rule->name.length);
    tn_pcfg_symbol *symbol = name ? tn_names_get(&g->names, name) : NULL;
    if (symbol || !name)
        return symbol;
    symbol = TN_NEW(g->arena, tn_pcfg_symbol);
    if (!symbol)
        return NULL;
    symbol->name = name;
    symbol->span = rule->name_span;
    symbol->index = g->count;
    g->symbols[g->count++] = symbol;
    tn_names_put(&g->names, name, symbol);
    if (rule->name.length > TN_NAME_MAX)
        tn_report(g->diagnostics, E_NAME_TOO_LONG, rule->name_span, "a name of %zu bytes; the limit is %u",
                  rule->name.length, TN_NAME_MAX);
    return symbol;
}

/* The alternatives of all lines of a symbol, in their order. */
static void collect(tn_pcfg_grammar *g, const tn_pcfg_file *file)
{
    size_t rules = 0;
    for (const tn_pcfg_rule *rule = file->first; rule; rule = rule->next)
        rules++;
    g->names.arena = g->arena;
    g->symbols = TN_NEW_ARRAY(g->arena, tn_pcfg_symbol *, rules + 1);
    for (const tn_pcfg_rule *rule = file->first; g->symbols && rule; rule = rule->next) {
        tn_pcfg_symbol *symbol = symbol_named(g, rule);
        if (!symbol)
            return;
        if (symbol->alternatives.last)
            symbol->alternatives.last->next = rule->alternatives.first;
        else
            symbol->alternatives.first = rule->alternatives.first;
        symbol->alternatives.last = rule->alternatives.last;
        for (const tn_pcfg_alternative *a = rule->alternatives.first; a; a = a->next)
            symbol->count++;
    }
}

static void read_items(tn_pcfg_grammar *g, tn_pcfg_alternative *alternative)
{
    for (tn_pcfg_item *item = alternative->first; item; item = item->next) {
        if (item->kind == TN_PCFG_TERMINAL) {
            pcfg_read_terminal(g->arena, g->diagnostics, item);
            continue;
        }
        char *name = tn_arena_copy(g->arena, item->text.text, item->text.length);
        const tn_pcfg_symbol *symbol = name ? tn_names_get(&g->names, name) : NULL;
        item->unknown = !symbol;
        item->step.kind = TN_STEP_EXPAND;
        item->step.index = symbol ? symbol->index : 0;
    }
}

/* ---- what can be reached */

static void reach(tn_pcfg_grammar *g)
{
    uint32_t *pending = TN_NEW_ARRAY(g->arena, uint32_t, g->count + 1), count = 0;
    if (!pending)
        return;
    g->symbols[0]->reached = true;
    pending[count++] = 0;
    while (count > 0) {
        const tn_pcfg_symbol *symbol = g->symbols[pending[--count]];
        for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next) {
            for (const tn_pcfg_item *item = a->first; item; item = item->next) {
                if (item->kind != TN_PCFG_NAME || item->unknown || tn_pcfg_symbol_of(g, item)->reached)
                    continue;
                tn_pcfg_symbol_of(g, item)->reached = true;
                pending[count++] = item->step.index;
            }
        }
    }
}

static bool is_epsilon(tn_pcfg_text text)
{
    return text.length == 2 && (memcmp(text.text, "\xc9\x9b", 2) == 0 || memcmp(text.text, "\xce\xb5", 2) == 0);
}

/* A note instead of what the code says. */
static void soften(tn_diagnostics *list, tn_diagnostic *diagnostic)
{
    if (diagnostic->severity == TN_WARNING)
        list->warning_count--;
    diagnostic->severity = TN_NOTE;
}

/* In an editor, a file may be a part of a grammar. */
static void report_unknown(tn_pcfg_grammar *g, const tn_pcfg_item *item, bool reached)
{
    enum { NAMES_MAX = 1000 };
    tn_diagnostics *list = g->diagnostics;
    bool error = reached && !g->partial;
    tn_diagnostic *d = tn_report(list, error ? E_PLACE_UNDEFINED : W_PLACE_NO_RULE, item->span,
                                 g->partial ? "%.*s has no rule in this file" : "%.*s has no rule",
                                 (int)item->text.length, item->text.text);
    if (g->partial)
        soften(list, d);
    if (is_epsilon(item->text)) {
        tn_help(list, d, "an alternative that does nothing is left empty");
        return;
    }
    uint32_t count = g->count < NAMES_MAX ? g->count : NAMES_MAX;
    const char **names = TN_NEW_ARRAY(g->arena, const char *, count + 1);
    const char *wanted = tn_arena_copy(g->arena, item->text.text, item->text.length);
    if (!names || !wanted)
        return;
    for (uint32_t i = 0; i < count; i++)
        names[i] = g->symbols[i]->name;
    const char *near = tn_nearest(wanted, names, count);
    if (near)
        tn_suggest(list, d, "%s", near);
    else if (error)
        tn_help(list, d, "write a rule for it, or give the file that has it too: all files given are one grammar");
}

static void check_reached(tn_pcfg_grammar *g)
{
    for (uint32_t s = 0; s < g->count; s++) {
        const tn_pcfg_symbol *symbol = g->symbols[s];
        for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next)
            for (const tn_pcfg_item *item = a->first; item; item = item->next)
                if (item->kind == TN_PCFG_NAME && item->unknown)
                    report_unknown(g, item, symbol->reached);
        if (!symbol->reached && !g->partial)
            tn_report(g->diagnostics, W_GRAMMAR_UNREACHABLE, symbol->span,
                      "%s cannot be reached from the start symbol %s", symbol->name, g->symbols[0]->name);
    }
}

/* ---- probabilities */

static void warn_of_lost(const tn_pcfg_grammar *g, const tn_pcfg_probability *p)
{
    tn_diagnostics *list = g->diagnostics;
    if (p->lost == TN_PCFG_COUNTS || p->value == 0)
        return;
    tn_diagnostic *d =
        tn_report(list, W_PLACE_PROBABILITY_LOST, p->span,
                  p->lost == TN_PCFG_LATER   ? "a later probability of this alternative counts, not this one"
                  : p->lost == TN_PCFG_BLANK ? "this probability is not read: a blank follows it on its line"
                                             : "this probability is not read: it does not end its line");
    tn_help(list, d,
            p->lost == TN_PCFG_BLANK   ? "leave out the blank behind it"
            : p->lost == TN_PCFG_LATER ? "leave out one of the two"
                                       : "put it behind everything else on the line");
}

/* In the order in which the engine adds them. */
static void check_probabilities(const tn_pcfg_grammar *g, tn_pcfg_symbol *symbol)
{
    tn_diagnostics *list = g->diagnostics;
    double sum = 0;
    for (const tn_pcfg_alternative *a = symbol->alternatives.first; a; a = a->next) {
        for (const tn_pcfg_probability *p = a->first_probability; p; p = p->next)
            warn_of_lost(g, p);
        sum += a->probability;
    }
    symbol->drawn = tn_place_draws(sum);
    if (sum >= 3) {
        tn_report(list, E_PLACE_PROBABILITY, symbol->span, "the probabilities of %s sum to %.15g, which is more than 1",
                  symbol->name, sum);
    } else if (sum > 0 && !symbol->drawn && !g->partial) {
        tn_diagnostic *d = tn_report(list, W_PLACE_PROBABILITY_SUM, symbol->span,
                                     "the probabilities of %s sum to %.15g, not to 1: its alternatives are tried in "
                                     "order, and none is drawn",
                                     symbol->name, sum);
        tn_help(list, d, "let them sum to 1, or leave them all out");
    }
}

void tn_pcfg_check(tn_pcfg_grammar *g, const tn_pcfg_file *file)
{
    collect(g, file);
    if (tn_arena_failed(g->arena) || g->count == 0)
        return;
    for (uint32_t s = 0; s < g->count; s++)
        for (tn_pcfg_alternative *a = g->symbols[s]->alternatives.first; a; a = a->next)
            read_items(g, a);
    reach(g);
    check_reached(g);
    for (uint32_t s = 0; s < g->count; s++)
        check_probabilities(g, g->symbols[s]);
}
