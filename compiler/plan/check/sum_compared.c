/* Comparisons of sums: the left side less the right one, compared with 0; quotients, remainders, and gaps, which become
 * relations. */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/form.h"

enum { MATCHES_MAX = 10, CASES_MAX = 1024, SIDES = 3 };

/* The left side less the right. */
static tn_checked_sum *difference(tn_check *check, const tn_ast_expr *expr, const tn_ast_expr *left,
                                  const tn_ast_expr *right, const tn_sum_parts *a, const tn_sum_parts *b)
{
    tn_ast_expr both = {.node.span = expr->node.span};
    tn_ast_expr one = *left, other = *right;
    both.parts = tn_ast_append(tn_ast_one(&one), &other);
    tn_sum_parts s;
    return tn_sum_add_up(check, &both, TN_EXPR_MINUS, "compared with", a, b, &s)
               ? tn_sum_finish(check, &s, expr->node.span)
               : NULL;
}

/* Each `matches` doubles what a comparison becomes, and each number that an extreme can be makes a case of it. */
static bool few_cases(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *sides, size_t count)
{
    size_t matches = 0, cases = 1;
    for (size_t i = 0; i < count; i++)
        for (size_t t = 0; t < sides[i].count; t++) {
            const tn_checked_term *term = &sides[i].terms[t];
            size_t times = term->kind == TN_TERM_MATCHES   ? 2
                           : term->kind == TN_TERM_EXTREME ? term->part->numbers->count + 1
                                                           : 1;
            matches += term->kind == TN_TERM_MATCHES;
            cases = cases > CASES_MAX ? cases : cases * times;
        }
    if (matches > MATCHES_MAX) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_TOO_MANY, expr->node.span,
                      "this comparison has %zu different `matches`, more than the limit of %d", matches, MATCHES_MAX);
        tn_help(check->diagnostics, d, "count fewer rules in one comparison, or join some of them by `or`");
        return false;
    }
    if (cases <= CASES_MAX)
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_MANY, expr->node.span,
                                 "what this comparison is of can be more than %d different numbers", CASES_MAX);
    tn_help(check->diagnostics, d, "compare `max(...)` and `min(...)` with constants, each by itself");
    return false;
}

/* ---- comparisons */

/* Where there is nothing to choose from, a greatest number is below and a least one above all numbers. A comparison in
 * which one is below and another above has no answer. */
static bool one_infinity(tn_check *check, const tn_checked_sum *sum, tn_span span)
{
    bool below = false, above = false;
    for (size_t i = 0; i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (term->kind != TN_TERM_EXTREME)
            continue;
        bool least = term->part->extreme == TN_EXTREME_LEAST, positive = *term->factor != '-';
        above |= least == positive;
        below |= least != positive;
    }
    if (!above || !below)
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_TWO_INFINITIES, span,
                                 "where there is nothing to choose from, this comparison has no answer");
    tn_help(
        check->diagnostics, d,
        "`max(...)` of nothing is below all numbers, `min(...)` of nothing above all: compare each with a constant");
    return false;
}

static bool has_gap(const tn_checked_sum *sum)
{
    for (size_t i = 0; i < sum->count; i++)
        if (sum->terms[i].kind == TN_TERM_GAP)
            return true;
    return false;
}

/* A comparison of a gap becomes a relation. false: reported. */
static bool compare_gap(tn_check *check, tn_ast_expr *expr, const tn_checked_sum *sum)
{
    if (sum->count == 1 && sum->terms[0].kind == TN_TERM_GAP) {
        tn_check_gap_compared(check, expr, &sum->terms[0], sum->constant);
        return true;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_QUOTIENT, expr->node.span,
                                 "a gap is compared with a constant, and here there is more");
    tn_help(check->diagnostics, d, "write `max(gap from a to b) <= 3`, and join comparisons by `and`");
    return false;
}

/* Is one of the sides a quotient? Then the others have to be constants. *which: the side; false: reported. */
static bool find_quotient(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *sides, size_t count,
                          size_t *which)
{
    size_t quotients = 0, others = 0;
    *which = SIDES;
    for (size_t i = 0; i < count; i++) {
        *which = sides[i].over ? i : *which;
        quotients += sides[i].over != NULL;
        others += !sides[i].over && sides[i].count > 0;
    }
    if (quotients == 0 || (quotients == 1 && others == 0 && (*which == 0 || count < SIDES)))
        return true;
    tn_report_quotient(check, expr->node.span);
    return false;
}

/* a less c times what it is divided by. */
static tn_checked_sum *less_times(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *quotient,
                                  tn_sum_amount constant)
{
    tn_sum_parts top = *quotient, times = *quotient->over;
    top.over = NULL;
    times.terms = TN_NEW_ARRAY(check->arena, tn_checked_term, times.count + 1);
    if (!times.terms)
        return NULL;
    memcpy(times.terms, quotient->over->terms, times.count * sizeof *times.terms);
    top.constant.power += times.constant.power;
    bool good = tn_sum_scale(check, &times, TN_EXPR_TIMES, constant);
    times.constant.power = top.constant.power;
    tn_sum_parts made;
    tn_ast_expr both = *expr;
    if (good && tn_sum_add_up(check, &both, TN_EXPR_MINUS, "compared with", &top, &times, &made))
        return tn_sum_finish(check, &made, expr->node.span);
    return NULL;
}

/* A quotient compared with a constant: what is divided less so many times what it is divided by, whose sign decides. */
static void check_quotient(tn_check *check, tn_ast_expr *expr, const tn_sum_parts *sides, size_t count, size_t which)
{
    const tn_sum_parts *quotient = &sides[which], *other = &sides[which == 0 ? 1 : 0];
    const tn_ast_expr *parts[SIDES] = {0};
    size_t at = 0;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        parts[at++] = part;
    for (size_t i = 0; i < count; i++) {
        tn_sum_amount both;
        if (i != which && !tn_same_power(check, quotient->constant, parts[which]->node.span, sides[i].constant,
                                         parts[i]->node.span, "compared with", &both))
            return;
    }
    tn_checked_sum *low = less_times(check, expr, quotient, other->constant),
                   *high = count == SIDES ? less_times(check, expr, quotient, sides[2].constant) : NULL,
                   *over = tn_sum_finish(check, quotient->over, parts[which]->node.span);
    if (!low || !over || (count == SIDES && !high))
        return;
    if (which > 0)
        expr->op = tn_operator_turned(expr->op);
    expr->sum = low;
    expr->high = high;
    expr->over = over;
    expr->whole = low->whole || over->whole || low->houses || over->houses;
    tn_check_compared_sum(check, low);
    tn_check_compared_sum(check, over);
}

/* A range of gaps: at least the one and at most the other. */
static void split_range(tn_check *check, tn_ast_expr *expr, const tn_checked_sum *low, const tn_checked_sum *high)
{
    tn_ast_expr *first = TN_NEW(check->arena, tn_ast_expr), *second = TN_NEW(check->arena, tn_ast_expr);
    if (!first || !second)
        return;
    *first = (tn_ast_expr){.node.span = expr->node.span, .kind = TN_EXPR_COMPARE, .op = TN_AT_LEAST, .depth = 1};
    *second = (tn_ast_expr){.node.span = expr->node.span, .kind = TN_EXPR_COMPARE, .op = TN_AT_MOST, .depth = 1};
    if (!compare_gap(check, first, low) || !compare_gap(check, second, high))
        return;
    expr->kind = TN_EXPR_AND;
    expr->from_sum = true;
    expr->parts = tn_ast_append(tn_ast_one(first), second);
}

/* `quantity(a) < 10%` is "less than a tenth of a tray": a share is one of something. */
static void warn_of_share(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *sides)
{
    const tn_ast_expr *left = (const tn_ast_expr *)expr->parts.first, *right = (const tn_ast_expr *)expr->parts.last;
    for (int turn = 0; turn < 2; turn++) {
        const tn_ast_expr *share = turn ? left : right, *sum = turn ? right : left;
        const char *text = share->kind == TN_EXPR_NUMBER ? share->name->text : "";
        size_t size = strlen(text);
        bool counts = sum->kind == TN_EXPR_QUANTITY || sum->kind == TN_EXPR_OCCURRENCES || sum->kind == TN_EXPR_TRAYS;
        if (size < 2 || text[size - 1] != '%' || !counts || sides[turn].over || !tn_check_wanted(check, W_SHARE_ALONE))
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, W_SHARE_ALONE, share->node.span,
                                     "`%s` is a number here, a share of nothing", text);
        tn_help(check->diagnostics, d, "a share of all trays is `%s * trays`", text);
        tn_replace_with(check->diagnostics, d, "%s * trays", text);
        return;
    }
}

/* A gap in trays is not compared with a length: it is measured by a field then. */
static bool gap_is_measured(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *sides, size_t count)
{
    bool trays = false, length = false;
    for (size_t i = 0; i < count; i++) {
        for (size_t t = 0; t < sides[i].count; t++)
            trays |= sides[i].terms[t].kind == TN_TERM_GAP && sides[i].constant.power == 0;
        length |= sides[i].constant.power == 1;
    }
    if (!trays || !length)
        return true;
    const tn_checked_schema *schema = check->schema;
    tn_diagnostic *d = tn_report(check->diagnostics, E_DIMENSIONS, expr->node.span,
                                 "a gap is a number of trays, and is compared with a length here");
    tn_help(check->diagnostics, d, "measure it by a field: `max(gap from a to b by %s)`",
            schema->length_field == TN_NONE ? "FIELD" : schema->fields[schema->length_field].name);
    return false;
}

void tn_check_comparison(tn_check *check, tn_ast_expr *expr)
{
    const tn_ast_expr *left = (const tn_ast_expr *)expr->parts.first, *middle = (const tn_ast_expr *)left->node.next,
                      *right = (const tn_ast_expr *)expr->parts.last;
    tn_sum_parts sides[SIDES];
    size_t count = 0, quotient;
    bool good = true;
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        good &= tn_sum_eval(check, part, &sides[count++]);
    if (!good || !few_cases(check, expr, sides, count) || !find_quotient(check, expr, sides, count, &quotient))
        return;
    if (quotient < SIDES) {
        check_quotient(check, expr, sides, count, quotient);
        return;
    }
    if (!gap_is_measured(check, expr, sides, count))
        return;
    if (expr->kind == TN_EXPR_COMPARE)
        warn_of_share(check, expr, sides);
    /* First the dimensions: what cannot be compared at all is said before what cannot be compared here. */
    bool range = expr->kind != TN_EXPR_COMPARE;
    tn_checked_sum *low = difference(check, expr, left, middle, &sides[0], &sides[1]),
                   *high = range ? difference(check, expr, left, right, &sides[0], &sides[2]) : NULL;
    if (!low || (range && !high))
        return;
    if (has_gap(low) || (range && has_gap(high))) {
        if (range)
            split_range(check, expr, low, high);
        else
            compare_gap(check, expr, low);
        return;
    }
    if (!one_infinity(check, low, expr->node.span) || (range && !one_infinity(check, high, expr->node.span)))
        return;
    expr->sum = low;
    expr->high = high;
    expr->whole = low->whole || low->houses || (range && (high->whole || high->houses));
    tn_check_compared_sum(check, low);
    if (range)
        tn_check_compared_sum(check, high);
}

static void report_remainder(tn_check *check, tn_span span, const char *what, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_REMAINDER, span, "%s", what);
    tn_help(check->diagnostics, d, "%s", help);
}

/* A whole number, of a length in nanometres to its power; false: it is none, or too large. */
static bool whole_constant(const tn_sum_parts *s, int64_t *number)
{
    bool whole = s->count == 0 && !strchr(s->constant.value, '/') && strlen(s->constant.value) < 19;
    *number = whole ? strtoll(s->constant.value, NULL, 10) : 0;
    return whole;
}

/* No quotient, and nothing that may have no value. */
static bool adds_up_only(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *sides, size_t count)
{
    bool good = true;
    for (size_t i = 0; i < count; i++)
        good = good && !sides[i].over && !tn_sum_has_extremes(&sides[i]);
    if (!good)
        report_remainder(check, expr->node.span, "a remainder is one of a sum",
                         "divide a count or a sum: `quantity(a) mod 2 = 0`");
    return good;
}

void tn_check_remainder(tn_check *check, tn_ast_expr *expr)
{
    const tn_ast_expr *left = (const tn_ast_expr *)expr->parts.first, *middle = (const tn_ast_expr *)left->node.next,
                      *right = (const tn_ast_expr *)expr->parts.last;
    tn_sum_parts sides[SIDES];
    size_t count = 0;
    bool good = true;
    int64_t modulus, rest;
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        good &= tn_sum_eval(check, part, &sides[count++]);
    if (!good || !few_cases(check, expr, sides, count) || !adds_up_only(check, expr, sides, count))
        return;
    tn_sum_amount both;
    if (!tn_same_power(check, sides[0].constant, left->node.span, sides[1].constant, middle->node.span, "a divisor of",
                       &both) ||
        !tn_same_power(check, both, left->node.span, sides[2].constant, right->node.span, "compared with", &both))
        return;
    if (expr->op != TN_EQUAL && expr->op != TN_UNEQUAL)
        report_remainder(check, expr->node.span, "a remainder is compared by `=` or `!=` only",
                         "join several by `or`: `quantity(a) mod 3 = 0 or quantity(a) mod 3 = 1`");
    else if (!whole_constant(&sides[1], &modulus) || modulus <= 0)
        report_remainder(check, middle->node.span, "a remainder is by a whole number above 0",
                         "`quantity(a) mod 2 = 0` means an even number of them");
    else if (!whole_constant(&sides[2], &rest) || rest < 0 || rest >= modulus)
        report_remainder(check, right->node.span, "no remainder is ever this",
                         "a remainder is a whole number from 0 up to, and without, what is divided by");
    else if ((expr->sum = difference(check, expr, left, right, &sides[0], &sides[2]))) {
        expr->modulus = modulus;
        expr->whole = expr->sum->whole || expr->sum->houses;
        tn_check_compared_sum(check, expr->sum);
        if (expr->sum->houses)
            report_remainder(check, expr->node.span, "what is added up over a house has no remainder here",
                             "compare it with numbers, or count the trays of its plan");
    }
}
