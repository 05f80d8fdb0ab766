/* Sets of trays: what specifiers let in that compare sums, what `only` and `forbid` say, and what is legal. What a
 * module says of trays it says by specifiers, so sets are written out as such: boxes that share no tray. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/check.h"

tn_choice_diagram *tn_schema_choices(tn_check *check, tn_checked_schema *schema)
{
    uint32_t counts[TN_FIELDS_MAX];
    if (schema->choices)
        return schema->choices;
    for (uint32_t f = 0; f < schema->field_count; f++)
        counts[f] = schema->fields[f].value_count;
    schema->choices = tn_choices_new(counts, schema->field_count, TN_CHOICES_ROOM);
    check->out_of_memory |= !schema->choices;
    return schema->choices;
}

/* Was the set made? Where not, says why. */
static bool is_made(tn_check *check, const tn_checked_schema *schema, tn_choice_set set, tn_span span)
{
    if (set != TN_CHOICE_LOST)
        return true;
    if (!tn_choices_full(schema->choices)) {
        check->out_of_memory = true;
        return false;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_MANY, span, "which trays are so takes too long to find out");
    tn_help(check->diagnostics, d, "ask for fewer fields at once");
    return false;
}

/* ---- specifiers */

/* What the items say that compare sums; the others are left in `plain`. false: reported. */
static bool sums_of(tn_check *check, tn_checked_schema *schema, const tn_ast_expr *tray, bool rule, tn_tray_set *set,
                    tn_ast_list *plain, bool *any)
{
    bool good = true;
    *set = (tn_tray_set){TN_CHOICE_ALL, TN_CHOICE_NONE};
    *plain = tn_ast_empty();
    *any = false;
    for (TN_EACH(const tn_ast_item, item, tray->items)) {
        if (!tn_is_sum_item(schema, item, rule)) {
            tn_ast_item *copy = TN_NEW(check->arena, tn_ast_item);
            if (!copy)
                return false;
            *copy = *item;
            copy->node.next = NULL;
            *plain = tn_ast_append(*plain, copy);
            continue;
        }
        tn_tray_set one;
        *any = true;
        if (!tn_schema_choices(check, schema) || !tn_check_sum_item(check, schema, item, &one)) {
            good = false;
            continue;
        }
        set->yes = tn_choices_and(schema->choices, set->yes, one.yes);
        set->no = tn_choices_or(schema->choices, set->no, one.no);
    }
    return good;
}

/* The same trays, of those that the specifier lets in. */
static void narrow(const tn_checked_schema *schema, const tn_checked_spec *spec, tn_tray_set *set)
{
    tn_choice_set box = tn_choices_box(schema->choices, spec->mask);
    set->yes = tn_choices_and(schema->choices, set->yes, box);
    set->no = tn_choices_or(schema->choices, set->no, tn_choices_not(schema->choices, box));
}

bool tn_check_tray_set(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                       const tn_ast_expr *tray, tn_tray_set *set)
{
    tn_ast_expr plain = *tray;
    bool any, good = sums_of(check, schema, tray, false, set, &plain.items, &any);
    tn_checked_spec *spec = tn_check_spec(check, schema, older, &plain);
    if (!spec || spec->broken || !good || !tn_schema_choices(check, schema))
        return false;
    narrow(schema, spec, set);
    return is_made(check, schema, set->yes, tray->node.span) && is_made(check, schema, set->no, tray->node.span);
}

/* ---- limits */

/* A word of the schema, or a constant, where `tray(...)` has to stand: what that would be. false: it is none. */
static bool help_tray(tn_check *check, tn_diagnostic *d, const tn_checked_schema *schema, const tn_ast_expr *expr)
{
    const char *word = expr->name ? expr->name->text : "";
    uint32_t field = expr->kind == TN_EXPR_NAME ? tn_field_find(schema, word) : TN_NONE;
    bool whole = expr->kind == TN_EXPR_NUMBER || (field != TN_NONE && schema->fields[field].kind == TN_FIELD_FLAG);
    if (!whole && (expr->kind != TN_EXPR_NAME || !tn_schema_says(schema, word)))
        return false;
    tn_help(check->diagnostics, d, "what a tray has is written `tray(%s%s)`", word,
            whole || field == TN_NONE ? "" : " ...");
    return true;
}

static bool refuse(tn_check *check, const tn_checked_schema *schema, const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_BROKEN || schema->ast->body.broken)
        return false;
    bool rule = expr->kind == TN_EXPR_NAME && tn_names_get(&check->names, expr->name->text);
    tn_diagnostic *d = rule
                           ? tn_report(check->diagnostics, E_BAD_LIMIT, expr->node.span,
                                       "`%s` is a name of the file, and which trays there are does not depend on rules",
                                       expr->name->text)
                           : tn_report(check->diagnostics, E_BAD_LIMIT, expr->node.span,
                                       "`only` and `forbid` say what a single tray is, and this says something else");
    if (rule)
        tn_help(check->diagnostics, d,
                "rules are about plans of the trays that there are: write out what it says, by `tray(...)`");
    else if (!help_tray(check, d, schema, expr))
        tn_help(check->diagnostics, d,
                "they are made of `tray(...)`, `any`, `and`, `or`, `not`, `implies` and parentheses");
    return false;
}

static bool set_of_parts(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                         const tn_ast_expr *expr, tn_tray_set *set)
{
    bool both = expr->kind == TN_EXPR_AND, implies = expr->kind == TN_EXPR_IMPLIES, good = true;
    tn_choice_diagram *choices = tn_schema_choices(check, schema);
    *set = both ? (tn_tray_set){TN_CHOICE_ALL, TN_CHOICE_NONE} : (tn_tray_set){TN_CHOICE_NONE, TN_CHOICE_ALL};
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        tn_tray_set one;
        if (!tn_check_limit_set(check, schema, older, part, &one) || !choices) {
            good = false;
            continue;
        }
        if (implies && (const tn_ast_node *)part == expr->parts.first)
            one = (tn_tray_set){one.no, one.yes};
        set->yes = (both ? tn_choices_and : tn_choices_or)(choices, set->yes, one.yes);
        set->no = (both ? tn_choices_or : tn_choices_and)(choices, set->no, one.no);
    }
    return good;
}

/* Recursion is as deep as the parser lets expressions nest. */
bool tn_check_limit_set(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                        const tn_ast_expr *expr, tn_tray_set *set)
{
    switch (expr->kind) {
    case TN_EXPR_TRAY:
        return tn_check_tray_set(check, schema, older, expr, set);
    case TN_EXPR_ANY:
        *set = (tn_tray_set){TN_CHOICE_ALL, TN_CHOICE_NONE};
        return true;
    case TN_EXPR_AND:
    case TN_EXPR_OR:
    case TN_EXPR_IMPLIES:
        return set_of_parts(check, schema, older, expr, set);
    case TN_EXPR_NOT: {
        tn_tray_set one;
        if (!tn_check_limit_set(check, schema, older, (const tn_ast_expr *)expr->parts.first, &one))
            return false;
        *set = (tn_tray_set){one.no, one.yes};
        return true;
    }
    default:
        return refuse(check, schema, expr);
    }
}

tn_choice_set tn_legal_set(tn_check *check, tn_checked_schema *schema)
{
    tn_choice_diagram *choices = tn_schema_choices(check, schema);
    if (schema->legal_known || !choices)
        return choices ? schema->legal : TN_CHOICE_LOST;
    tn_choice_set *boxes = TN_NEW_ARRAY(check->arena, tn_choice_set, schema->forbid_count + 1u);
    for (uint32_t i = 0; boxes && i < schema->forbid_count; i++)
        boxes[i] = tn_choices_box(choices, schema->forbids[i]->mask);
    schema->legal_known = true;
    schema->legal =
        boxes ? tn_choices_not(choices, tn_choices_any_of(choices, boxes, schema->forbid_count)) : TN_CHOICE_LOST;
    check->out_of_memory |= schema->legal == TN_CHOICE_LOST && !tn_choices_full(choices);
    return schema->legal;
}

bool tn_check_undivided(tn_check *check, tn_checked_schema *schema, tn_tray_set set, tn_span span)
{
    tn_choice_diagram *choices = schema->choices;
    tn_choice_set neither = tn_choices_not(choices, tn_choices_or(choices, set.yes, set.no));
    if (neither == TN_CHOICE_NONE)
        return true;
    neither = tn_choices_and(choices, neither, tn_legal_set(check, schema));
    uint8_t values[TN_FIELDS_MAX];
    if (!is_made(check, schema, neither, span))
        return false;
    if (!tn_choices_first(choices, neither, values))
        return true;
    char tray[400];
    tn_say_tray(schema, values, tray, sizeof tray);
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_DIVIDED_BY_ZERO, span, "this divides by 0 in the tray `%s`", tray);
    tn_help(check->diagnostics, d,
            "ask only trays where that is not 0, by an item more: `tray(body not none, width / body depth > 2)`; or "
            "multiply: `width > 2 * body depth`");
    return false;
}

/* ---- boxes */

typedef struct boxing {
    tn_check *check;
    tn_checked_schema *schema;
    tn_span span;
    tn_checked_trays *trays;
} boxing;

static bool add_box(void *context, const uint64_t *mask)
{
    boxing *b = context;
    tn_checked_spec *spec = tn_box_spec(b->check, b->schema, mask, b->span);
    if (spec)
        b->trays->boxes[b->trays->count++] = spec;
    return spec != NULL;
}

typedef struct box_count {
    size_t count, most;
} box_count;

static bool count_box(void *context, const uint64_t *mask)
{
    box_count *boxes = context;
    (void)mask;
    return ++boxes->count <= boxes->most;
}

bool tn_check_boxes(tn_check *check, tn_checked_schema *schema, tn_choice_set set, size_t most, tn_span span,
                    tn_checked_trays *trays)
{
    box_count boxes = {.most = most};
    *trays = (tn_checked_trays){0};
    if (!is_made(check, schema, set, span))
        return false;
    bool few = tn_choices_boxes(schema->choices, set, count_box, &boxes);
    check->out_of_memory |= !few && boxes.count <= most;
    if (boxes.count > most) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_TOO_MANY, span, "this asks for trays of more than %zu kinds", most);
        tn_help(check->diagnostics, d, "compare fewer fields at once, or fields of fewer values");
        return false;
    }
    trays->boxes = TN_NEW_ARRAY(check->arena, tn_checked_spec *, boxes.count + 1);
    boxing b = {check, schema, span, trays};
    bool whole = trays->boxes && few && tn_choices_boxes(schema->choices, set, add_box, &b);
    check->out_of_memory |= !whole;
    return whole;
}

/* ---- specifiers of rules */

static tn_ast_expr *tray_of(tn_check *check, tn_checked_spec *spec, tn_span span)
{
    tn_ast_expr *expr = TN_NEW(check->arena, tn_ast_expr);
    if (expr)
        *expr = (tn_ast_expr){.node.span = span, .kind = TN_EXPR_TRAY, .depth = 1, .spec = spec};
    return expr;
}

/* No combination of values is so: unless bound words made it. */
static void report_none(tn_check *check, const tn_ast_expr *tray, tn_ast_list items)
{
    for (TN_EACH(const tn_ast_item, item, items))
        if (item->made)
            return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_SUCH_VALUE, tray->node.span, "no tray is so");
    tn_help(check->diagnostics, d, "compare with numbers that the fields of schema `%s` can come to",
            check->schema->name);
}

/* Leaves the boxes out that no legal tray is in, but for one if all are such: that is said of it. */
static void leave_out_illegal(tn_check *check, tn_checked_schema *schema, tn_checked_trays *trays)
{
    tn_choice_set legal = tn_legal_set(check, schema);
    size_t kept = 0;
    for (size_t i = 0; i < trays->count; i++) {
        tn_choice_set box = tn_choices_box(schema->choices, trays->boxes[i]->mask);
        if (tn_choices_and(schema->choices, box, legal) != TN_CHOICE_NONE)
            trays->boxes[kept++] = trays->boxes[i];
    }
    trays->count = kept ? kept : trays->count > 0;
}

/* The set without the trays that an item about a number leaves out: what a division comes to is no matter there. */
static tn_tray_set of_numbers(tn_check *check, tn_checked_schema *schema, tn_ast_list items, tn_tray_set set)
{
    tn_tray_set one;
    if (tn_choices_or(schema->choices, set.yes, set.no) == TN_CHOICE_ALL)
        return set;
    for (TN_EACH(const tn_ast_item, item, items))
        if (!tn_is_sum_item(schema, item, true) && tn_is_sum_item(schema, item, false) &&
            tn_check_sum_item(check, schema, item, &one))
            set.no = tn_choices_or(schema->choices, set.no, one.no);
    return set;
}

/* What the items say together: one specifier, or any of several, and what is asked of numbers besides. */
static void set_spec(tn_check *check, tn_ast_expr *tray, tn_tray_set set, tn_ast_list written)
{
    tn_checked_schema *schema = tray->spec->schema;
    tn_span span = tray->node.span;
    tn_checked_trays trays;
    narrow(schema, tray->spec, &set);
    if (!tn_check_undivided(check, schema, of_numbers(check, schema, written, set), span) ||
        !tn_check_boxes(check, schema, set.yes, TN_TRAY_BOXES_MAX, span, &trays))
        return;
    leave_out_illegal(check, schema, &trays);
    if (trays.count == 0) {
        report_none(check, tray, written);
        uint64_t *none = TN_NEW_ARRAY(check->arena, uint64_t, schema->words);
        if (none)
            tray->spec = tn_box_spec(check, schema, none, span);
        return;
    }
    if (trays.count == 1) {
        tray->spec = trays.boxes[0];
        return;
    }
    tn_ast_expr *either = tray->tests.first ? tray_of(check, NULL, span) : tray;
    if (!either)
        return;
    either->kind = TN_EXPR_OR;
    for (size_t i = 0; i < trays.count; i++)
        either->parts = tn_ast_append(either->parts, tray_of(check, trays.boxes[i], span));
    if (either != tray)
        tray->tests = tn_ast_append(tray->tests, either);
}

bool tn_check_sums_of_tray(tn_check *check, tn_ast_expr *tray)
{
    tn_checked_schema *schema = check->schema;
    bool any = false;
    for (TN_EACH(const tn_ast_item, item, tray->items))
        any = any || tn_is_sum_item(schema, item, true);
    if (!any || tray->loose)
        return false;
    tn_ast_list written = tray->items, plain;
    tn_tray_set set;
    bool good = sums_of(check, schema, tray, true, &set, &plain, &any);
    tray->items = plain;
    tn_check_tests_of_numbers(check, tray);
    tray->spec = tn_check_spec(check, schema, tray->older, tray);
    if (good && tray->spec && !tray->spec->broken)
        set_spec(check, tray, set, written);
    return true;
}
