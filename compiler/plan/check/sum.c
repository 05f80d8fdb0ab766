/* Sums over a plan: from arithmetic to a constant and terms, each a factor times something that is counted or added up.
 *
 * Equal terms are one, so that measures of measures do not grow: a term is known by the expressions it is made of,
 * which a measure's uses share.
 */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/form.h"

enum { MEASURE_POWER_MAX = 3, TERMS_MAX = 1000, MATCHES_MAX = 10 };

bool tn_is_arithmetic(tn_expr_kind kind)
{
    return kind == TN_EXPR_PLUS || kind == TN_EXPR_MINUS || kind == TN_EXPR_TIMES || kind == TN_EXPR_OVER ||
           kind == TN_EXPR_NEGATIVE;
}

bool tn_compares_numbers(tn_expr_kind kind)
{
    return kind == TN_EXPR_COMPARE || kind == TN_EXPR_WITHIN || kind == TN_EXPR_REMAINDER;
}

bool tn_is_constant(const tn_ast_expr *expr)
{
    bool constant = expr->kind == TN_EXPR_NUMBER || tn_is_arithmetic(expr->kind);
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        constant = constant && tn_is_constant(part);
    return constant;
}

bool tn_is_sum(const tn_ast_expr *expr)
{
    if (tn_is_arithmetic(expr->kind))
        return true;
    switch (expr->kind) {
    case TN_EXPR_NUMBER:
    case TN_EXPR_TRAYS:
    case TN_EXPR_MATCHES:
    case TN_EXPR_VALUES:
        return true;
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
    case TN_EXPR_SUM:
        return !expr->condition;
    case TN_EXPR_NAME:
        return expr->rule && expr->rule->is_measure;
    default:
        return false;
    }
}

/* ---- names and specifiers in sums */

static void report_rule(tn_check *check, const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_BROKEN || (expr->kind == TN_EXPR_NAME && !expr->rule))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_RULE_OR_NUMBER, expr->node.span,
                                 "a number has to stand here, and this is a rule");
    tn_help(check->diagnostics, d,
            "`quantity(...)` counts trays, `occurrences(...)` places, and `matches(...)` is 1 or 0");
}

static void check_sum_expr(tn_check *check, tn_ast_expr *sum)
{
    bool areas = tn_sums_areas(sum), cost = tn_sums_cost(check, sum);
    if (areas || cost) {
        (cost ? tn_check_cost : tn_check_areas)(check, sum);
        return;
    }
    if (sum->parts.first)
        tn_check_expr(check, (tn_ast_expr *)sum->parts.first);
    if (check->schema)
        sum->figure_good = tn_check_figure(check, check->schema, sum->figure, &sum->figure_amount);
}

void tn_check_sum_expr(tn_check *check, tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_NAME)
        tn_check_expr_name(check, expr);
    if (!tn_is_sum(expr)) {
        tn_check_expr_known(check, expr);
        report_rule(check, expr);
        return;
    }
    switch (expr->kind) {
    case TN_EXPR_QUANTITY:
    case TN_EXPR_OCCURRENCES:
    case TN_EXPR_MATCHES:
        tn_check_expr(check, (tn_ast_expr *)expr->parts.first);
        break;
    case TN_EXPR_SUM:
        check_sum_expr(check, expr);
        break;
    case TN_EXPR_VALUES:
        expr->field = check->schema ? tn_check_field_named(check, expr->name) : TN_NONE;
        break;
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
    case TN_EXPR_NEGATIVE:
        for (TN_EACH(tn_ast_expr, part, expr->parts))
            tn_check_sum_expr(check, part);
        break;
    default:
        break;
    }
    bool counts = expr->kind == TN_EXPR_TRAYS || (expr->kind == TN_EXPR_SUM && !expr->parts.first);
    if (counts && check->schema)
        expr->spec = tn_check_any(check, check->schema, expr->node.span);
}

/* ---- sums as constant and terms */

typedef struct sum {
    tn_checked_term *terms;
    size_t count;
    tn_sum_amount constant;
} sum;

static bool add_term(tn_check *check, sum *to, tn_checked_term term)
{
    for (size_t i = 0; i < to->count; i++) {
        tn_checked_term *t = &to->terms[i];
        if (t->kind != term.kind || t->region != term.region || t->part != term.part || t->rule != term.rule ||
            t->any != term.any || t->figure != term.figure)
            continue;
        t->factor = tn_amount_apply(check, TN_EXPR_PLUS, t->factor, term.factor);
        if (t->factor && tn_amount_is_zero(t->factor))
            *t = to->terms[--to->count];
        return t->factor != NULL;
    }
    if (!term.factor || to->count == TERMS_MAX)
        return false;
    if (to->count % 8 == 0) {
        tn_checked_term *terms = TN_NEW_ARRAY(check->arena, tn_checked_term, to->count + 8);
        if (!terms)
            return false;
        if (to->count)
            memcpy(terms, to->terms, to->count * sizeof *terms);
        to->terms = terms;
    }
    to->terms[to->count++] = term;
    return true;
}

static bool one_term(tn_check *check, tn_term_kind kind, tn_ast_expr *expr, int power, sum *out)
{
    tn_ast_expr *part = (tn_ast_expr *)expr->parts.first;
    tn_checked_term term = {.kind = kind,
                            .region = expr->region,
                            .factor = "1",
                            .figure = expr->figure,
                            .span = (part ? part : expr)->node.span};
    if (!part)
        term.any = expr->spec;
    else if (part->kind == TN_EXPR_NAME)
        term.rule = part->rule;
    else
        term.part = part;
    *out = (sum){.constant = {.value = "0", .power = power}};
    return add_term(check, out, term);
}

/* What is added up over a house. `of` asks for it. */
static bool house_term(tn_check *check, tn_term_kind kind, tn_ast_expr *of, int power, sum *out)
{
    *out = (sum){.constant = {.value = "0", .power = power}};
    return of->ask && add_term(check, out, (tn_checked_term){.kind = kind, .factor = "1", .part = of});
}

static bool eval_quantity(tn_check *check, tn_ast_expr *quantity, sum *out)
{
    tn_ast_expr *of = tn_counts_house(quantity);
    if (quantity->condition)
        return false;
    return of ? house_term(check, of->kind == TN_EXPR_CELL ? TN_TERM_CELLS : TN_TERM_ROOMS, of, 0, out)
              : one_term(check, TN_TERM_SINGLES, quantity, 0, out);
}

/* How many different values of a field there are: 1 for each that is there. */
static bool eval_values(tn_check *check, const tn_ast_expr *expr, sum *out)
{
    *out = (sum){.constant = {.value = "0"}};
    if (expr->field == TN_NONE)
        return false;
    for (uint32_t v = 0; v < check->schema->fields[expr->field].value_count; v++) {
        tn_checked_spec *spec = tn_check_value_spec(check, check->schema, expr->field, v, expr->node.span);
        tn_checked_term term = {.kind = TN_TERM_PRESENT, .factor = "1", .any = spec, .span = expr->node.span};
        if (!spec || !add_term(check, out, term))
            return false;
    }
    return true;
}

static bool eval_sum(tn_check *check, tn_ast_expr *expr, sum *out)
{
    if (expr->condition)
        return false;
    if (tn_sums_areas(expr))
        return house_term(check, TN_TERM_AREAS, expr, 2, out);
    if (tn_sums_cost(check, expr))
        return house_term(check, TN_TERM_COST, expr, 0, out);
    return expr->figure_good && one_term(check, TN_TERM_SINGLES, expr, expr->figure_amount.power, out);
}

static bool scale(tn_check *check, sum *s, tn_expr_kind kind, tn_sum_amount by)
{
    s->constant.value = tn_amount_apply(check, kind, s->constant.value, by.value);
    s->constant.power += kind == TN_EXPR_TIMES ? by.power : -by.power;
    s->constant.any = false;
    bool good = s->constant.value != NULL;
    for (size_t i = 0; i < s->count; i++) {
        s->terms[i].factor = tn_amount_apply(check, kind, s->terms[i].factor, by.value);
        good &= s->terms[i].factor != NULL;
    }
    if (tn_amount_is_zero(by.value))
        s->count = 0;
    return good;
}

static bool eval(tn_check *check, tn_ast_expr *expr, sum *out);

static void report_product(tn_check *check, const tn_ast_expr *expr, bool divides)
{
    tn_diagnostic *d = divides ? tn_report(check->diagnostics, E_NOT_ADDITIVE, expr->node.span,
                                           "this divides by what depends on the plan")
                               : tn_report(check->diagnostics, E_NOT_ADDITIVE, expr->node.span,
                                           "both sides of this product depend on the plan");
    tn_help(check->diagnostics, d,
            divides ? "over the plan sums are only added, and multiplied by constants; a comparison `A / B < 3` is "
                      "written `A < 3 * B`"
                    : "over the plan sums are only added, and multiplied by constants; inside `sum(...)` any "
                      "arithmetic over one tray is allowed: `sum(FIELD * FIELD)`");
}

static bool eval_product(tn_check *check, tn_ast_expr *expr, sum *a, sum *b, sum *out)
{
    bool divides = expr->kind == TN_EXPR_OVER;
    if (b->count > 0 && (divides || a->count > 0)) {
        report_product(check, expr, divides);
        return false;
    }
    if (divides && tn_amount_is_zero(b->constant.value)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_DIVIDED_BY_ZERO,
                                     ((tn_ast_expr *)expr->parts.last)->node.span, "this divides by 0");
        tn_help(check->diagnostics, d, "divide by another number");
        return false;
    }
    *out = b->count > 0 ? *b : *a;
    if (scale(check, out, expr->kind, b->count > 0 ? a->constant : b->constant))
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_FINE, expr->node.span,
                                 "this number has more digits than sums are made with");
    tn_help(check->diagnostics, d, "use rounder numbers");
    return false;
}

static bool add_up(tn_check *check, const tn_ast_expr *expr, tn_expr_kind kind, const char *verb, const sum *a,
                   const sum *b, sum *out)
{
    tn_span left = ((const tn_ast_expr *)expr->parts.first)->node.span,
            right = ((const tn_ast_expr *)expr->parts.last)->node.span;
    tn_sum_amount both;
    if (!tn_same_power(check, a->constant, left, b->constant, right, verb, &both))
        return false;
    *out = (sum){.constant = both};
    out->constant.any = a->constant.any && b->constant.any;
    out->constant.value = tn_amount_apply(check, kind, a->constant.value, b->constant.value);
    bool good = out->constant.value != NULL;
    for (size_t i = 0; i < a->count; i++)
        good &= add_term(check, out, a->terms[i]);
    for (size_t i = 0; i < b->count; i++) {
        tn_checked_term term = b->terms[i];
        if (kind == TN_EXPR_MINUS)
            term.factor = tn_amount_apply(check, TN_EXPR_MINUS, "0", term.factor);
        good &= add_term(check, out, term);
    }
    if (good)
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_FINE, expr->node.span,
                                 "this sum has more than %d terms, or numbers of too many digits", TERMS_MAX);
    tn_help(check->diagnostics, d, "leave some out, or use rounder numbers");
    return false;
}

static bool eval_two(tn_check *check, tn_ast_expr *expr, sum *out)
{
    sum a, b;
    bool good = eval(check, (tn_ast_expr *)expr->parts.first, &a);
    good &= eval(check, (tn_ast_expr *)expr->parts.last, &b);
    if (!good)
        return false;
    if (expr->kind == TN_EXPR_TIMES || expr->kind == TN_EXPR_OVER)
        return eval_product(check, expr, &a, &b, out);
    return add_up(check, expr, expr->kind, expr->kind == TN_EXPR_PLUS ? "added to" : "taken from", &a, &b, out);
}

static bool eval_measure(tn_check *check, const tn_checked_rule *measure, sum *out)
{
    const tn_checked_sum *of = measure->sum;
    if (!of)
        return false;
    *out = (sum){.constant = {.value = of->constant, .power = of->power}};
    for (size_t i = 0; i < of->count; i++)
        if (!add_term(check, out, of->terms[i]))
            return false;
    return true;
}

static bool eval(tn_check *check, tn_ast_expr *expr, sum *out)
{
    *out = (sum){0};
    switch (expr->kind) {
    case TN_EXPR_NUMBER:
        out->constant = tn_amount_read(check, expr->name);
        return out->constant.value != NULL;
    case TN_EXPR_TRAYS:
        return one_term(check, TN_TERM_SINGLES, expr, 0, out);
    case TN_EXPR_QUANTITY:
        return eval_quantity(check, expr, out);
    case TN_EXPR_OCCURRENCES:
        return !expr->condition && one_term(check, TN_TERM_STARTS, expr, 0, out);
    case TN_EXPR_MATCHES:
        return one_term(check, TN_TERM_MATCHES, expr, 0, out);
    case TN_EXPR_SUM:
        return eval_sum(check, expr, out);
    case TN_EXPR_VALUES:
        return eval_values(check, expr, out);
    case TN_EXPR_NAME:
        return expr->rule && expr->rule->is_measure && eval_measure(check, expr->rule, out);
    case TN_EXPR_NEGATIVE:
        if (!eval(check, (tn_ast_expr *)expr->parts.first, out))
            return false;
        return scale(check, out, TN_EXPR_TIMES, (tn_sum_amount){.value = "-1"});
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
        return eval_two(check, expr, out);
    default:
        return false; /* already reported */
    }
}

static tn_checked_sum *finish(tn_check *check, const sum *s, tn_span span)
{
    tn_checked_sum *made = TN_NEW(check->arena, tn_checked_sum);
    if (!made)
        return NULL;
    *made = (tn_checked_sum){.schema = check->schema,
                             .terms = s->terms,
                             .count = s->count,
                             .constant = s->constant.value,
                             .power = s->constant.power,
                             .any = s->constant.any,
                             .span = span,
                             .index = TN_NONE};
    for (size_t i = 0; i < s->count; i++) {
        made->whole |= s->terms[i].kind == TN_TERM_MATCHES;
        if (s->terms[i].kind < TN_TERM_CELLS)
            continue;
        made->houses = true;
        made->form = s->terms[i].part->ask->form;
    }
    return made;
}

tn_checked_sum *tn_check_sum(tn_check *check, tn_ast_expr *expr)
{
    sum s;
    return eval(check, expr, &s) ? finish(check, &s, expr->node.span) : NULL;
}

/* The left side less the right. */
static tn_checked_sum *difference(tn_check *check, const tn_ast_expr *expr, const tn_ast_expr *left,
                                  const tn_ast_expr *right, const sum *a, const sum *b)
{
    tn_ast_expr both = {.node.span = expr->node.span};
    tn_ast_expr one = *left, other = *right;
    both.parts = tn_ast_append(tn_ast_one(&one), &other);
    sum s;
    return add_up(check, &both, TN_EXPR_MINUS, "compared with", a, b, &s) ? finish(check, &s, expr->node.span) : NULL;
}

/* Each `matches` doubles what a comparison becomes. */
static bool few_matches(tn_check *check, const tn_ast_expr *expr, const sum *sides, size_t count)
{
    size_t matches = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t t = 0; t < sides[i].count; t++)
            matches += sides[i].terms[t].kind == TN_TERM_MATCHES;
    if (matches <= MATCHES_MAX)
        return true;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_TOO_MANY, expr->node.span,
                  "this comparison has %zu different `matches`, more than the limit of %d", matches, MATCHES_MAX);
    tn_help(check->diagnostics, d, "count fewer rules in one comparison, or join some of them by `or`");
    return false;
}

void tn_check_comparison(tn_check *check, tn_ast_expr *expr)
{
    const tn_ast_expr *left = (const tn_ast_expr *)expr->parts.first, *middle = (const tn_ast_expr *)left->node.next,
                      *right = (const tn_ast_expr *)expr->parts.last;
    sum sides[3];
    size_t count = 0;
    bool good = true;
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        good &= eval(check, part, &sides[count++]);
    if (!good)
        return;
    if (!few_matches(check, expr, sides, count))
        return;
    /* First the dimensions: what cannot be compared at all is said before what cannot be compared here. */
    bool range = expr->kind != TN_EXPR_COMPARE;
    tn_checked_sum *low = difference(check, expr, left, middle, &sides[0], &sides[1]),
                   *high = range ? difference(check, expr, left, right, &sides[0], &sides[2]) : NULL;
    if (!low || (range && !high))
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
static bool whole_constant(const sum *s, int64_t *number)
{
    bool whole = s->count == 0 && !strchr(s->constant.value, '/') && strlen(s->constant.value) < 19;
    *number = whole ? strtoll(s->constant.value, NULL, 10) : 0;
    return whole;
}

void tn_check_remainder(tn_check *check, tn_ast_expr *expr)
{
    const tn_ast_expr *left = (const tn_ast_expr *)expr->parts.first, *middle = (const tn_ast_expr *)left->node.next,
                      *right = (const tn_ast_expr *)expr->parts.last;
    sum sides[3];
    size_t count = 0;
    bool good = true;
    int64_t modulus, rest;
    for (TN_EACH(tn_ast_expr, part, expr->parts))
        good &= eval(check, part, &sides[count++]);
    if (!good || !few_matches(check, expr, sides, count))
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

void tn_check_plan_measure(tn_check *check, tn_checked_rule *measure)
{
    measure->sum = tn_check_sum(check, measure->ast->body);
    if (measure->sum && measure->form)
        tn_check_house_sum(check, measure->sum);
    if (!measure->sum || (measure->sum->power >= 0 && measure->sum->power <= MEASURE_POWER_MAX))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_DIMENSIONS, measure->ast->body->node.span,
                                 "a measure cannot be a length to the power of %d", measure->sum->power);
    tn_help(check->diagnostics, d, "it is a number, a length, an area or a volume: divide or multiply by `1m` or `1'`");
    measure->sum = NULL;
}
