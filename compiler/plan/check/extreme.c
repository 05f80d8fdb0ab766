/* The greatest and the least number of a tray, `max(X of a)`, and the longest and the shortest gap, `max(gap from a to
 * b)`: what they can be, and what a comparison of a gap with a number means. */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "runtime/number/rational.h"

enum { VALUES_MAX = 1000, TRAYS_MAX = 1 << 18 };

/* ---- checking */

static void check_by(tn_check *check, tn_ast_expr *gap)
{
    const tn_ast_word *by = gap->name;
    gap->field = by ? tn_check_field_named(check, by) : TN_NONE;
    const tn_checked_field *field = gap->field == TN_NONE ? NULL : &check->schema->fields[gap->field];
    if (!field || field->kind == TN_FIELD_LENGTH || field->kind == TN_FIELD_ZONE)
        return;
    gap->field = TN_NONE;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_NOT_A_LENGTH, by->node.span, "`%s` has no lengths to add up", by->text);
    tn_help(check->diagnostics, d,
            "a gap is measured by a field of lengths or by the depths of a zone; without `by` "
            "it is a number of trays");
}

void tn_check_extreme(tn_check *check, tn_ast_expr *expr)
{
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        tn_check_expr(check, part);
    if (!check->schema)
        return;
    expr->spec = tn_check_any(check, check->schema, expr->node.span);
    if (expr->kind == TN_EXPR_GAP)
        check_by(check, expr);
    else
        expr->figure_good = tn_check_figure(check, check->schema, expr->figure, &expr->figure_amount);
}

/* ---- what a number of a tray can be */

static bool next(const tn_checked_schema *schema, const bool *depends, uint8_t *values)
{
    for (uint32_t f = schema->field_count; f-- > 0;) {
        if (!depends[f])
            continue;
        if (++values[f] < schema->fields[f].value_count)
            return true;
        values[f] = 0;
    }
    return false;
}

typedef struct numbers {
    mpq_t *items; /* ascending */
    size_t count, room;
} numbers;

/* false: there are too many. */
static bool add_number(numbers *all, const mpq_t number)
{
    size_t low = 0, high = all->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        int order = mpq_cmp(all->items[middle], number);
        if (order == 0)
            return true;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    if (all->count == VALUES_MAX)
        return false;
    mpq_init(all->items[all->count]);
    mpq_set(all->items[all->count], number);
    for (size_t i = all->count++; i > low; i--)
        mpq_swap(all->items[i], all->items[i - 1]);
    return true;
}

static bool collect(const tn_checked_schema *schema, const tn_ast_expr *figure, numbers *all)
{
    bool depends[TN_FIELDS_MAX] = {0}, good = true;
    uint8_t values[TN_FIELDS_MAX] = {0};
    size_t tries = 0;
    mpq_t number;
    mpq_init(number);
    tn_figure_fields(schema, figure, NULL, depends);
    do {
        if (tn_figure_compute(schema, figure, NULL, values, number) == TN_FIGURE_SAYS)
            good = add_number(all, number);
    } while (good && ++tries < TRAYS_MAX && next(schema, depends, values));
    mpq_clear(number);
    return good && tries < TRAYS_MAX;
}

static const char *text_of(tn_check *check, const mpq_t number)
{
    if (!tn_rational_fits(number))
        return NULL;
    char *text = mpq_get_str(NULL, 10, number);
    const char *kept = tn_arena_copy(check->arena, text, strlen(text));
    free(text);
    return kept;
}

static tn_checked_extreme *keep(tn_check *check, const tn_ast_expr *extreme, const numbers *all)
{
    tn_checked_extreme *made = TN_NEW(check->arena, tn_checked_extreme);
    const char **values = TN_NEW_ARRAY(check->arena, const char *, all->count + 1);
    uint32_t *reached = TN_NEW_ARRAY(check->arena, uint32_t, all->count + 1);
    if (!made || !values || !reached)
        return NULL;
    *made = (tn_checked_extreme){.values = values, .count = all->count, .reached = reached};
    for (size_t i = 0; i < all->count; i++) {
        size_t at = extreme->extreme == TN_EXTREME_MOST ? i : all->count - 1 - i;
        values[i] = text_of(check, all->items[at]);
        if (values[i])
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_FINE, extreme->figure->node.span,
                                     "this number has more digits than sums are made with");
        tn_help(check->diagnostics, d, "use rounder numbers");
        return NULL;
    }
    return made;
}

tn_checked_extreme *tn_extreme_values(tn_check *check, tn_ast_expr *extreme)
{
    if (extreme->numbers || !extreme->figure_good)
        return extreme->numbers;
    numbers all = {.items = malloc(VALUES_MAX * sizeof *all.items)};
    if (!all.items)
        return NULL;
    if (!collect(check->schema, extreme->figure, &all)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_MANY, extreme->figure->node.span,
                                     "a tray can have more than %d different numbers here", VALUES_MAX);
        tn_help(check->diagnostics, d, "measure in rounder numbers, or by a field of fewer values");
    } else {
        extreme->numbers = keep(check, extreme, &all);
    }
    for (size_t i = 0; i < all.count; i++)
        mpq_clear(all.items[i]);
    free(all.items);
    return extreme->numbers;
}

/* ---- gaps compared with a number */

static tn_ast_expr *make(tn_check *check, tn_expr_kind kind, tn_span span, tn_ast_expr *part)
{
    tn_ast_expr *expr = TN_NEW(check->arena, tn_ast_expr);
    if (!expr || !part)
        return NULL;
    *expr = (tn_ast_expr){.node.span = span, .kind = kind, .depth = 1, .parts = tn_ast_one(part)};
    return expr;
}

/* `max(gap) <= number`: every a has a b as near, of which the opposite is what a gap must not be. `min(gap) <= number`:
 * some a has. Without `or_equal`: less. */
static tn_ast_expr *gap_at_most(tn_check *check, tn_span span, const tn_ast_expr *gap, bool or_equal, int64_t number)
{
    bool every = gap->extreme == TN_EXTREME_MOST;
    tn_operator op = every ? (or_equal ? TN_GREATER : TN_AT_LEAST) : (or_equal ? TN_AT_MOST : TN_LESS);
    const tn_ast_word *by = gap->field == TN_NONE ? NULL : gap->name;
    tn_ast_expr *source = tn_expr_copy(check, (const tn_ast_expr *)gap->parts.first),
                *destination = tn_expr_copy(check, (const tn_ast_expr *)gap->parts.last);
    tn_ast_expr *between = tn_check_gap_rule(check, span, by, op, number);
    tn_ast_expr *near = make(check, every ? TN_EXPR_EVERY_NEAR : TN_EXPR_NEAR, span, source);
    if (!near || !destination || !between)
        return NULL;
    near->near = TN_NEAR_WITHIN;
    near->parts = tn_ast_append(tn_ast_append(near->parts, destination), between);
    if (every)
        return near;
    /* There is one somewhere in the stretch: not the opposite. */
    return make(check, TN_EXPR_NOT, span, make(check, TN_EXPR_NOT, span, near));
}

/* The whole number that gaps, which are whole, compare alike with, up or down; beyond all gaps it is TN_GAP_MAX. */
static int64_t whole(const mpq_t number, bool up)
{
    mpz_t rounded;
    mpz_init(rounded);
    (up ? mpz_cdiv_q : mpz_fdiv_q)(rounded, mpq_numref(number), mpq_denref(number));
    int64_t result = mpz_cmp_si(rounded, TN_GAP_MAX) > 0    ? TN_GAP_MAX
                     : mpz_cmp_si(rounded, -TN_GAP_MAX) < 0 ? -TN_GAP_MAX
                                                            : mpz_get_si(rounded);
    mpz_clear(rounded);
    return result;
}

/* The gap compares so with the number. */
static tn_ast_expr *gap_compares(tn_check *check, tn_span span, const tn_ast_expr *gap, tn_operator op,
                                 const mpq_t number)
{
    if (op == TN_EQUAL || op == TN_UNEQUAL) {
        tn_ast_expr *below = gap_compares(check, span, gap, TN_LESS, number),
                    *above = gap_compares(check, span, gap, TN_GREATER, number);
        tn_ast_expr *either = make(check, TN_EXPR_OR, span, below);
        if (!either || !above)
            return NULL;
        either->parts = tn_ast_append(either->parts, above);
        return op == TN_UNEQUAL ? either : make(check, TN_EXPR_NOT, span, either);
    }
    bool or_equal = op == TN_AT_MOST || op == TN_GREATER; /* `>` is not `<=` */
    tn_ast_expr *small = gap_at_most(check, span, gap, or_equal, whole(number, !or_equal));
    return op == TN_LESS || op == TN_AT_MOST ? small : make(check, TN_EXPR_NOT, span, small);
}

void tn_check_gap_compared(tn_check *check, tn_ast_expr *expr, const tn_checked_term *gap, const char *constant)
{
    tn_span span = expr->node.span;
    mpq_t number, factor;
    mpq_inits(number, factor, NULL);
    mpq_set_str(number, constant, 10);
    mpq_set_str(factor, gap->factor, 10);
    mpq_div(number, number, factor);
    mpq_neg(number, number);
    tn_operator op = mpq_sgn(factor) < 0 ? tn_operator_turned(expr->op) : expr->op;
    tn_ast_expr *made = gap_compares(check, span, gap->part, op, number);
    mpq_clears(number, factor, NULL);
    if (!made)
        return;
    tn_ast_node node = expr->node;
    *expr = *made;
    expr->node = node;
    expr->from_sum = true;
}
