/* A stretch and what lies around it: `a beside b`, `a within K of b`, `a at least K from every b`, and each of them
 * after `every`. The distance K becomes a rule of the gap: a condition on the trays or the lengths that lie between. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"

enum { LETS_DEEP = 16 }; /* of names that stand for one another */

static tn_ast_expr *make(tn_check *check, tn_expr_kind kind, tn_span span)
{
    tn_ast_expr *expr = TN_NEW(check->arena, tn_ast_expr);
    if (expr)
        *expr = (tn_ast_expr){.node.span = span, .kind = kind, .depth = 1};
    return expr;
}

static tn_ast_word *word_of(tn_check *check, tn_span span, tn_word_kind kind, const char *text)
{
    tn_ast_word *word = TN_NEW(check->arena, tn_ast_word);
    if (word)
        *word = (tn_ast_word){.node.span = span, .kind = kind, .text = text};
    return word;
}

/* What lies between has so many trays. */
static tn_ast_expr *trays_between(tn_check *check, tn_span span, tn_ast_cond *condition)
{
    tn_ast_expr *count = make(check, TN_EXPR_QUANTITY, span), *any = make(check, TN_EXPR_ANY, span);
    if (!count || !any)
        return NULL;
    count->parts = tn_ast_one(any);
    count->condition = condition;
    return count;
}

/* What lies between is so long, in the field or in the schema's first field of lengths. */
static tn_ast_expr *length_between(tn_check *check, tn_span span, const tn_ast_word *by, tn_ast_cond *condition)
{
    tn_ast_expr *sum = make(check, TN_EXPR_SUM, span), *figure = make(check, TN_EXPR_FIGURE, span);
    if (!sum || !figure)
        return NULL;
    tn_span nowhere = {span.file, span.begin, span.begin}; /* the field is not written there */
    const tn_checked_schema *schema = check->schema;
    figure->name = word_of(check, nowhere, TN_WORD_NAME, by ? by->text : schema->fields[schema->length_field].name);
    sum->name = figure->name;
    sum->figure = figure;
    sum->condition = condition;
    return figure->name ? sum : NULL;
}

static void report_distance(tn_check *check, const tn_ast_expr *distance, const char *what)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NEAR_DISTANCE, distance->node.span, "%s", what);
    tn_help(check->diagnostics, d, "write a number of trays, such as `2`, or a length, such as `12m`");
}

/* ---- a name that stands for no number */

static bool is_number(const tn_check *check, const tn_ast_expr *value, uint32_t deep);

/* Does a `let` or a param of that name, which is seen here, stand for a number? A param of words does not. */
static bool names_number(const tn_check *check, const tn_checked_name *name, uint32_t deep)
{
    const tn_checked_rule *rule = name ? name->rule : NULL;
    return rule && rule->is_let && !rule->ast->words.first && rule->ast->body &&
           tn_import_reaches(check->imports, check->unit, name->unit) && is_number(check, rule->ast->body, deep);
}

/* Through the names of others, which may go round. */
static bool is_number(const tn_check *check, const tn_ast_expr *value, uint32_t deep)
{
    if (value->kind == TN_EXPR_NAME)
        return deep < LETS_DEEP && names_number(check, tn_names_get(&check->names, value->name->text), deep + 1);
    bool number = value->kind == TN_EXPR_NUMBER || tn_is_arithmetic(value->kind);
    for (TN_EACH(const tn_ast_expr, part, value->parts))
        number = number && is_number(check, part, deep);
    return number;
}

static const char *nearest_number(tn_check *check, const char *word)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, check->names.count + 1);
    size_t count = 0;
    for (size_t i = 0; names && i < check->names.capacity; i++)
        if (check->names.entries[i].text && names_number(check, check->names.entries[i].value, 0))
            names[count++] = check->names.entries[i].text;
    return count ? tn_nearest(word, names, count) : NULL;
}

/* The first name in it that nothing has; NULL: there is none. */
static const tn_ast_expr *unknown_name(const tn_check *check, const tn_ast_expr *expr)
{
    const tn_ast_expr *found = NULL;
    if (expr->kind == TN_EXPR_NAME)
        return tn_names_get(&check->names, expr->name->text) ? NULL : expr;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        found = found ? found : tn_is_arithmetic(expr->kind) ? unknown_name(check, part) : NULL;
    return found;
}

/* What is no constant often has a name that is misspelled. */
static void report_no_constant(tn_check *check, const tn_ast_expr *distance)
{
    const tn_ast_expr *unknown = unknown_name(check, distance);
    const char *near = unknown ? nearest_number(check, unknown->name->text) : NULL;
    if (!near) {
        report_distance(check, distance, "a distance has to be a constant");
        return;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_NEAR_DISTANCE, unknown->node.span,
                                 "a distance has to be a constant, and there is none called `%s`", unknown->name->text);
    tn_suggest(check->diagnostics, d, "%s", near);
}

/* The distance as one word, a number or a length; NULL: reported. */
static tn_ast_word *read_distance(tn_check *check, tn_ast_expr *distance)
{
    if (!tn_is_constant(distance)) {
        if (distance->kind != TN_EXPR_BROKEN)
            report_no_constant(check, distance);
        return NULL;
    }
    const tn_checked_sum *sum = tn_check_sum(check, distance);
    if (!sum)
        return NULL;
    bool length = sum->power == 1 && !sum->any, whole = !strchr(sum->constant, '/') && strlen(sum->constant) < 18;
    const char *wrong = *sum->constant == '-'        ? "a distance cannot be below 0"
                        : sum->power != 0 && !length ? "a distance has to be a number of trays or a length"
                        : !whole && !length          ? "a distance in trays has to be a whole number"
                        : !whole                     ? "this length is too fine or too long for a distance"
                        : length && check->schema->length_field == TN_NONE
                            ? "the schema has no field of lengths to measure this by"
                            : NULL;
    if (wrong) {
        report_distance(check, distance, wrong);
        return NULL;
    }
    tn_ast_word *word = word_of(check, distance->node.span, length ? TN_WORD_LENGTH : TN_WORD_NUMBER, sum->constant);
    if (word)
        word->value = strtoll(sum->constant, NULL, 10);
    return word;
}

/* The comparison that a gap has to meet. Of `every`, it is what a gap must not be. */
static tn_operator gap_operator(const tn_ast_expr *near)
{
    bool every = near->kind == TN_EXPR_EVERY_NEAR;
    if (near->near == TN_NEAR_APART)
        return every ? TN_LESS : TN_AT_LEAST;
    if (near->near == TN_NEAR_BESIDE && !every)
        return TN_EQUAL;
    return every ? TN_GREATER : TN_AT_MOST;
}

static tn_ast_cond *gap_condition(tn_check *check, tn_span span, tn_operator op, const tn_ast_word *distance)
{
    tn_ast_cond *condition = TN_NEW(check->arena, tn_ast_cond);
    if (!condition)
        return NULL;
    *condition = (tn_ast_cond){.node.span = span,
                               .kind = TN_COND_COMPARE,
                               .op = op,
                               .left = word_of(check, span, TN_WORD_NAME, "n"),
                               .right = distance,
                               .depth = 1};
    return condition->left ? condition : NULL;
}

void tn_check_near(tn_check *check, tn_ast_expr *near)
{
    tn_ast_expr *source = (tn_ast_expr *)near->parts.first, *destination = (tn_ast_expr *)source->node.next,
                *distance = (tn_ast_expr *)destination->node.next;
    tn_check_expr(check, source);
    tn_check_expr(check, destination);
    if (!check->schema)
        return;
    const tn_ast_word *word =
        distance ? read_distance(check, distance) : word_of(check, near->node.span, TN_WORD_NUMBER, "0");
    tn_span span = near->node.span;
    tn_ast_cond *condition = word ? gap_condition(check, span, gap_operator(near), word) : NULL;
    bool length = word && word->kind == TN_WORD_LENGTH;
    tn_ast_expr *gap = !condition ? NULL
                       : length   ? length_between(check, span, NULL, condition)
                                  : trays_between(check, span, condition);
    destination->node.next = NULL; /* the list ends with it, or with the rule of the gap */
    near->parts = tn_ast_append(tn_ast_append(tn_ast_one(source), destination), gap);
    if (gap)
        tn_check_expr(check, gap);
}

tn_ast_expr *tn_check_gap_rule(tn_check *check, tn_span span, const tn_ast_word *by, tn_operator op, int64_t number)
{
    char text[32];
    snprintf(text, sizeof text, "%lld", (long long)number);
    tn_ast_word *word =
        word_of(check, span, by ? TN_WORD_LENGTH : TN_WORD_NUMBER, tn_arena_copy(check->arena, text, strlen(text)));
    tn_ast_cond *condition = word ? gap_condition(check, span, op, word) : NULL;
    if (!condition)
        return NULL;
    word->value = number;
    tn_ast_expr *gap = by ? length_between(check, span, by, condition) : trays_between(check, span, condition);
    bool quiet = check->quiet;
    check->quiet = true; /* nobody has written this condition: a warning of it would be about something else */
    if (gap)
        tn_check_expr(check, gap);
    check->quiet = quiet;
    return gap;
}
