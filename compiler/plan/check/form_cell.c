/* Reads what a form asks of cells: the items of `cell(...)`, joined by and, or, not, as code that decides on one cell.
 *
 * An item is a storey, a function, `void`, `any`, an area, a zone (then the cell is of that zone), or whatever a tray
 * specifier says of the cell's tray. */
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/form.h"

void tn_decision_add(tn_check *check, tn_decision *decision, tn_decision_step step)
{
    if (decision->count == decision->capacity) {
        size_t capacity = decision->capacity ? 2 * decision->capacity : 8;
        tn_decision_step *steps = TN_NEW_ARRAY(check->arena, tn_decision_step, capacity);
        if (!steps)
            return;
        if (decision->count)
            memcpy(steps, decision->steps, decision->count * sizeof *steps);
        decision->steps = steps;
        decision->capacity = capacity;
    }
    decision->steps[decision->count++] = step;
}

/* Where a cell's item is read. */
typedef struct tn_cell_reader {
    tn_check *check;
    const tn_checked_form *form;
    tn_decision *decision;
    bool decided;
    tn_item_context context; /* the field that the alternatives before were about */
    uint32_t zone;           /* which the alternative asks for; TN_NONE: none */
    bool alone;              /* it asks for nothing else */
} tn_cell_reader;

static void add(tn_cell_reader *reader, tn_opcode opcode, uint32_t index, tn_span span)
{
    tn_decision_add(reader->check, reader->decision,
                    (tn_decision_step){.opcode = opcode, .index = index, .span = span});
}

static bool bad_cell(tn_check *check, tn_span span, const char *message, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_CELL, span, "%s", message);
    tn_help(check->diagnostics, d, "%s", help);
    return false;
}

const tn_ast_word *tn_form_negated(tn_check *check, const tn_ast_alternative *alternative, const char *what,
                                   bool *negated)
{
    const tn_ast_word *word = (const tn_ast_word *)alternative->words.first;
    for (*negated = false; word && word->kind == TN_WORD_NOT; word = (const tn_ast_word *)word->node.next)
        *negated = !*negated;
    if (!word) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_BAD_CELL, alternative->node.span, "nothing follows this `not`");
        tn_help(check->diagnostics, d, "say what the %s is not", what);
    }
    return word;
}

tn_area_test tn_form_test(tn_operator sign)
{
    static const tn_area_test tests[] = {
        [TN_LESS] = TN_AREA_LESS,       [TN_AT_MOST] = TN_AREA_AT_MOST,   [TN_EQUAL] = TN_AREA_EQUAL,
        [TN_UNEQUAL] = TN_AREA_UNEQUAL, [TN_AT_LEAST] = TN_AREA_AT_LEAST, [TN_GREATER] = TN_AREA_GREATER,
    };
    return tests[sign];
}

/* What is wrong about `area` or `cells` and what follows: the value, where there is one. */
static bool bad_comparison(tn_check *check, const tn_ast_word *word, bool areas)
{
    const tn_ast_word *sign = (const tn_ast_word *)word->node.next;
    bool compared = sign && sign->kind == TN_WORD_OPERATOR;
    const tn_ast_word *value = compared ? (const tn_ast_word *)sign->node.next : NULL;
    if (value && value->broken)
        return false;
    if (value && value->kind == (areas ? TN_WORD_AREA : TN_WORD_NUMBER))
        return bad_cell(check, value->node.next->span, "this does not belong to the item",
                        "items are separated by commas, alternatives joined by `or`");
    tn_span span = value ? value->node.span : word->node.span;
    if (!areas)
        return bad_cell(check, span, "the number of cells can only be compared with a whole number",
                        "write `cells > 1`");
    if (!value || (value->kind != TN_WORD_NUMBER && value->kind != TN_WORD_DECIMAL))
        return bad_cell(check, span, "an area can only be compared with an area",
                        "write `area < 90sf` or `area >= 8.5m2`");
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_CELL, span, "an area can only be compared with an area");
    size_t digits = strspn(value->text, "0123456789.");
    tn_help(check->diagnostics, d, "write it with its unit, such as `%.*ssf` or `%.*sm2`", (int)digits, value->text,
            (int)digits, value->text);
    return false;
}

/* area < 90sf, cells > 1 */
bool tn_form_compared(tn_check *check, const tn_ast_word *word, tn_opcode opcode, tn_decision *decision)
{
    bool areas = opcode != TN_OP_ROOM_CELLS;
    const tn_ast_word *sign = (const tn_ast_word *)word->node.next;
    const tn_ast_word *other = sign ? (const tn_ast_word *)sign->node.next : NULL;
    if (!sign || sign->kind != TN_WORD_OPERATOR || !other || other->kind != (areas ? TN_WORD_AREA : TN_WORD_NUMBER) ||
        other->node.next)
        return bad_comparison(check, word, areas);
    tn_decision_step step = {.opcode = opcode,
                             .index = tn_form_test(sign->op),
                             .area = other->value,
                             .span = tn_span_join(word->node.span, other->node.span)};
    if (areas && !tn_amount_read_cell(check, other, &step.area))
        return false;
    tn_decision_add(check, decision, step);
    return true;
}

/* A storey, a function, `void`, `any`: words that stand alone. *found is false where it is none of these. */
static bool read_own_word(tn_cell_reader *reader, const tn_ast_word *word, bool *found)
{
    const tn_checked_form *form = reader->form;
    tn_span span = word->node.span;
    uint32_t storey = tn_form_storey(form, word->text), function = tn_form_function(form, word->text);
    bool is_void = strcmp(word->text, "void") == 0, any = strcmp(word->text, "any") == 0;
    if (!reader->decided && tn_schema_says(form->schema, word->text))
        function = TN_NONE; /* it has a name of the schema: that was said, and here the schema's word is meant */
    *found = storey != TN_NONE || function != TN_NONE || is_void || any;
    if (!*found)
        return true;
    if (word->node.next)
        return bad_cell(reader->check, ((const tn_ast_word *)word->node.next)->node.span,
                        "this does not belong to the item",
                        "items are separated by commas, alternatives joined by `or`");
    if ((is_void || function != TN_NONE) && !reader->decided)
        return bad_cell(reader->check, span, "functions and voids are not known yet where this is decided",
                        "ask for zones, storeys, areas and what the tray is");
    add(reader,
        any                 ? TN_OP_EVERY
        : is_void           ? TN_OP_IS_VOID
        : storey != TN_NONE ? TN_OP_IN_STOREY
                            : TN_OP_IS_FOR,
        storey != TN_NONE ? storey : function, span);
    return true;
}

enum { OWN_WORDS = 2 }; /* `any` and `void` */

/* The names of storeys, functions where they are known, and zones, and the words of cells; how many. */
static size_t own_words(const tn_cell_reader *reader, const char **names)
{
    const tn_checked_form *form = reader->form;
    size_t count = 0;
    for (uint32_t i = 0; i < form->storey_count; i++)
        names[count++] = form->storeys[i].ast->name->text;
    for (uint32_t i = 0; i < form->function_count && reader->decided; i++)
        names[count++] = form->rules[i].ast->name->text;
    for (uint32_t f = 0; f < form->schema->field_count; f++)
        if (form->schema->fields[f].kind == TN_FIELD_ZONE)
            names[count++] = form->schema->fields[f].name;
    names[count++] = "any";
    if (reader->decided)
        names[count++] = "void";
    return count;
}

/* A word that is meant as a storey, a function or a zone, and is none: reported, with the one that is nearest. */
static bool is_unknown(const tn_cell_reader *reader, const tn_ast_word *word)
{
    const tn_checked_form *form = reader->form;
    if (form->broken || word->kind != TN_WORD_NAME || tn_schema_says(form->schema, word->text))
        return form->broken;
    const char **names =
        TN_NEW_ARRAY(reader->check->arena, const char *,
                     form->storey_count + form->function_count + form->schema->field_count + OWN_WORDS);
    size_t count = names ? own_words(reader, names) : 0;
    if (!tn_nearest(word->text, names, count) && tn_value_guessed(reader->check, form->schema, word))
        return false;
    tn_form_unknown(reader->check, form, word, reader->decided ? "zone, storey or function" : "zone or storey", names,
                    count);
    return true;
}

/* A cell has the depth of its zone: there is none where a fill has no depth. */
static void warn_no_depth(const tn_cell_reader *reader, const tn_checked_spec *spec, const tn_checked_field *zone,
                          tn_span span)
{
    tn_check *check = reader->check;
    for (uint32_t v = 0; v < zone->value_count; v++) {
        uint32_t bit = zone->first_bit + v;
        if (zone->values[v].length > 0 && spec->mask[bit / 64] >> (bit % 64) & 1)
            return;
    }
    if (spec->broken || !tn_check_wanted(check, W_CELL_NEVER))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_CELL_NEVER, span,
                                 "no cell is so: where the `%s` of a tray has no depth, it has no cell", zone->name);
    tn_help(check->diagnostics, d,
            "leave it out, or name fills of `%s` that have a depth; cells of other zones are not meant by it",
            zone->name);
}

/* A zone alone, or what a tray specifier says. */
static bool read_tray_words(tn_cell_reader *reader, const tn_ast_word *word, tn_span span)
{
    tn_checked_schema *schema = reader->form->schema;
    uint32_t field = word->kind == TN_WORD_NAME ? tn_field_find(schema, word->text) : TN_NONE;
    bool zone = field != TN_NONE && schema->fields[field].kind == TN_FIELD_ZONE;
    if (zone && !word->node.next) {
        reader->context.field = reader->zone = field;
        reader->alone = true;
        add(reader, TN_OP_IN_ZONE, field, span);
        return true;
    }
    tn_checked_spec *spec = tn_check_alternative(reader->check, schema, word, span, &reader->context);
    if (!spec)
        return false;
    tn_decision_add(reader->check, reader->decision,
                    (tn_decision_step){.opcode = TN_OP_IN_TRAY, .spec = spec, .span = span});
    if (schema->fields[reader->context.field].kind == TN_FIELD_ZONE) {
        reader->zone = reader->context.field;
        warn_no_depth(reader, spec, &schema->fields[reader->context.field], span);
        add(reader, TN_OP_IN_ZONE, reader->context.field, span);
        add(reader, TN_OP_ALL_OF, 0, span);
    }
    return true;
}

static bool read_words(tn_cell_reader *reader, const tn_ast_word *word, tn_span span)
{
    bool found = false;
    if (word->kind == TN_WORD_NAME && strcmp(word->text, "area") == 0)
        return tn_form_compared(reader->check, word, TN_OP_HAS_AREA, reader->decision);
    if (word->kind == TN_WORD_NAME && !read_own_word(reader, word, &found))
        return false;
    return found || (!is_unknown(reader, word) && read_tray_words(reader, word, span));
}

bool tn_form_cell_words(tn_check *check, const tn_checked_form *form, const tn_ast_word *word, tn_span span,
                        tn_item_context *context, tn_decision *decision)
{
    tn_cell_reader reader = {.check = check, .form = form, .decision = decision, .decided = true, .context = *context};
    bool good = read_words(&reader, word, span);
    *context = reader.context;
    return good;
}

/* zones[field]: may a cell be of the zone, by one of the alternatives of an item? */
static void allow_zones(const tn_cell_reader *reader, bool negated, bool *zones)
{
    const tn_checked_schema *schema = reader->form->schema;
    for (uint32_t f = 0; zones && f < schema->field_count; f++)
        zones[f] |= schema->fields[f].kind == TN_FIELD_ZONE &&
                    (reader->zone == TN_NONE || (negated ? !reader->alone || f != reader->zone : f == reader->zone));
}

static bool read_alternative(tn_cell_reader *reader, const tn_ast_alternative *alternative, bool *zones)
{
    bool negated;
    reader->zone = TN_NONE;
    reader->alone = false;
    const tn_ast_word *word = tn_form_negated(reader->check, alternative, "cell", &negated);
    if (!word || !read_words(reader, word, alternative->node.span))
        return false;
    if (negated)
        add(reader, TN_OP_NONE_OF, 0, alternative->node.span);
    allow_zones(reader, negated, zones);
    return true;
}

/* Adds the zones that the item allows. */
static bool read_item(tn_cell_reader *reader, const tn_ast_item *item, bool *zones)
{
    bool good = true, first = true;
    reader->context = (tn_item_context){.field = TN_NONE};
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
        good &= read_alternative(reader, alternative, zones);
        if (!first)
            add(reader, TN_OP_ONE_OF, 0, alternative->node.span);
        first = false;
    }
    return good;
}

/* Keeps the zones that an item allows, too; true where none is left. */
static bool keep_zones(const tn_cell_reader *reader, const bool *zones, bool *kept)
{
    bool any = false;
    for (uint32_t f = 0; f < reader->form->schema->field_count; f++)
        any |= kept[f] &= zones[f];
    return !any;
}

static void warn_two_zones(const tn_cell_reader *reader, tn_span span)
{
    tn_check *check = reader->check;
    if (!tn_check_wanted(check, W_CELL_NEVER))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_CELL_NEVER, span,
                                 "no cell is so: it would be of another zone than the items before ask for");
    tn_help(check->diagnostics, d,
            "a cell is of one zone: several are joined by `or`; in a rule, `cell(...) and tray(...)` also asks what "
            "the tray is");
}

static bool read_cell(tn_cell_reader *reader, const tn_ast_expr *expr)
{
    bool good = true, first = true;
    uint32_t fields = reader->form->schema->field_count;
    bool *kept = TN_NEW_ARRAY(reader->check->arena, bool, fields + 1);
    bool *zones = TN_NEW_ARRAY(reader->check->arena, bool, fields + 1);
    bool never = !kept || !zones; /* or it was said */
    if (!never)
        memset(kept, true, fields);
    if (!expr->items.first)
        add(reader, TN_OP_EVERY, 0, expr->node.span);
    for (TN_EACH(const tn_ast_item, item, expr->items)) {
        if (zones)
            memset(zones, false, fields);
        bool read = read_item(reader, item, zones);
        if (!never && read && good && (never = keep_zones(reader, zones, kept)))
            warn_two_zones(reader, item->node.span);
        good &= read;
        if (!first)
            add(reader, TN_OP_ALL_OF, 0, item->node.span);
        first = false;
    }
    return good;
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
static bool read_cells(tn_cell_reader *reader, const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_CELL)
        return read_cell(reader, expr);
    if (expr->kind != TN_EXPR_AND && expr->kind != TN_EXPR_OR && expr->kind != TN_EXPR_NOT)
        return expr->kind != TN_EXPR_BROKEN && bad_cell(reader->check, expr->node.span, "this says nothing of a cell",
                                                        "write `cell(...)`, joined by `and`, `or` and `not`");
    bool good = expr->kind != TN_EXPR_BROKEN, first = true;
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        good &= read_cells(reader, part);
        if (!first)
            add(reader, expr->kind == TN_EXPR_AND ? TN_OP_ALL_OF : TN_OP_ONE_OF, 0, part->node.span);
        first = false;
    }
    if (expr->kind == TN_EXPR_NOT)
        add(reader, TN_OP_NONE_OF, 0, expr->node.span);
    return good;
}

bool tn_form_cell(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, bool decided,
                  tn_decision *decision)
{
    tn_cell_reader reader = {.check = check, .form = form, .decision = decision, .decided = decided};
    decision->span = expr ? expr->node.span : (tn_span){0};
    return expr && read_cells(&reader, expr);
}
