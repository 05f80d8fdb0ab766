/* Sums over a plan: from arithmetic to a constant and terms, each a factor times something that is counted or added up.
 *
 * Equal terms are one, so that measures of measures do not grow: a term is known by the expressions it is made of,
 * which a measure's uses share.
 */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/form.h"

enum { MEASURE_POWER_MAX = 3, TERMS_MAX = 1000 };

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
    case TN_EXPR_EXTREME:
    case TN_EXPR_GAP:
    case TN_EXPR_WALK:
    case TN_EXPR_EXITS:
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
    case TN_EXPR_EXTREME:
    case TN_EXPR_GAP:
        tn_check_extreme(check, expr);
        break;
    case TN_EXPR_WALK:
    case TN_EXPR_EXITS:
        tn_check_ask(check, expr);
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

static bool depends(const tn_sum_parts *s)
{
    return s->count > 0 || s->over;
}

static bool add_term(tn_check *check, tn_sum_parts *to, tn_checked_term term)
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

static bool one_term(tn_check *check, tn_term_kind kind, tn_ast_expr *expr, int power, tn_sum_parts *out)
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
    *out = (tn_sum_parts){.constant = {.value = "0", .power = power}};
    return add_term(check, out, term);
}

/* What is added up over a house. `of` asks for it. */
static bool house_term(tn_check *check, tn_term_kind kind, tn_ast_expr *of, int power, tn_sum_parts *out)
{
    *out = (tn_sum_parts){.constant = {.value = "0", .power = power}};
    return of->ask && add_term(check, out, (tn_checked_term){.kind = kind, .factor = "1", .part = of});
}

static bool eval_quantity(tn_check *check, tn_ast_expr *quantity, tn_sum_parts *out)
{
    tn_ast_expr *of = tn_counts_house(quantity);
    if (quantity->condition)
        return false;
    return of ? house_term(check, of->kind == TN_EXPR_CELL ? TN_TERM_CELLS : TN_TERM_ROOMS, of, 0, out)
              : one_term(check, TN_TERM_SINGLES, quantity, 0, out);
}

/* How many different values of a field there are: 1 for each that is there. */
static bool eval_values(tn_check *check, const tn_ast_expr *expr, tn_sum_parts *out)
{
    *out = (tn_sum_parts){.constant = {.value = "0"}};
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

/* The greatest or least number, or gap: one term. */
static bool eval_extreme(tn_check *check, tn_ast_expr *expr, tn_sum_parts *out)
{
    bool gap = expr->kind == TN_EXPR_GAP;
    tn_checked_term term = {
        .kind = gap ? TN_TERM_GAP : TN_TERM_EXTREME, .factor = "1", .part = expr, .span = expr->node.span};
    *out =
        (tn_sum_parts){.constant = {.value = "0", .power = gap ? expr->field != TN_NONE : expr->figure_amount.power}};
    return (gap ? !expr->name || expr->field != TN_NONE : tn_extreme_values(check, expr) != NULL) &&
           add_term(check, out, term);
}

static bool eval_sum(tn_check *check, tn_ast_expr *expr, tn_sum_parts *out)
{
    if (expr->condition)
        return false;
    if (tn_sums_areas(expr))
        return house_term(check, TN_TERM_AREAS, expr, 2, out);
    if (tn_sums_cost(check, expr))
        return house_term(check, TN_TERM_COST, expr, 0, out);
    return expr->figure_good && one_term(check, TN_TERM_SINGLES, expr, expr->figure_amount.power, out);
}

bool tn_sum_scale(tn_check *check, tn_sum_parts *s, tn_expr_kind kind, tn_sum_amount by)
{
    s->constant.value = tn_amount_apply(check, kind, s->constant.value, by.value);
    s->constant.power += kind == TN_EXPR_TIMES ? by.power : -by.power;
    s->constant.any = false;
    bool good = s->constant.value != NULL;
    for (size_t i = 0; i < s->count; i++) {
        s->terms[i].factor = tn_amount_apply(check, kind, s->terms[i].factor, by.value);
        good &= s->terms[i].factor != NULL;
    }
    if (tn_amount_is_zero(by.value) && !s->over)
        s->count = 0;
    return good;
}

bool tn_sum_eval(tn_check *check, tn_ast_expr *expr, tn_sum_parts *out);

static void report_product(tn_check *check, const tn_ast_expr *expr, bool divides)
{
    tn_diagnostic *d = divides ? tn_report(check->diagnostics, E_NOT_ADDITIVE, expr->node.span,
                                           "this divides by what depends on the plan")
                               : tn_report(check->diagnostics, E_NOT_ADDITIVE, expr->node.span,
                                           "both sides of this product depend on the plan");
    tn_help(check->diagnostics, d,
            divides ? "a quotient of two sums stands alone: as a measure, or on one side of a comparison"
                    : "over the plan sums are only added, and multiplied by constants; inside `sum(...)` any "
                      "arithmetic over one tray is allowed: `sum(FIELD * FIELD)`");
}

bool tn_sum_has_extremes(const tn_sum_parts *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->terms[i].kind == TN_TERM_EXTREME || s->terms[i].kind == TN_TERM_GAP)
            return true;
    return false;
}

/* A sum divided by another one. */
static bool eval_quotient(tn_check *check, const tn_ast_expr *expr, const tn_sum_parts *a, const tn_sum_parts *b,
                          tn_sum_parts *out)
{
    tn_sum_parts *over = TN_NEW(check->arena, tn_sum_parts);
    if (!over)
        return false;
    *over = *b;
    *out = *a;
    out->over = over;
    out->constant.power = a->constant.power - b->constant.power;
    out->constant.any = false;
    if (!tn_sum_has_extremes(a) && !tn_sum_has_extremes(b))
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_QUOTIENT, expr->node.span,
                                 "a quotient is of two sums, and this has `max(...)` or `min(...)` in it");
    tn_help(check->diagnostics, d, "compare it with a number: `max(width of a) <= 3 * sum(...)` is possible");
    return false;
}

static bool eval_product(tn_check *check, tn_ast_expr *expr, tn_sum_parts *a, tn_sum_parts *b, tn_sum_parts *out)
{
    bool divides = expr->kind == TN_EXPR_OVER;
    if (divides && b->count > 0 && !a->over && !b->over)
        return eval_quotient(check, expr, a, b, out);
    if (depends(b) && (divides || depends(a))) {
        report_product(check, expr, divides);
        return false;
    }
    if (divides && tn_amount_is_zero(b->constant.value)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_DIVIDED_BY_ZERO,
                                     ((tn_ast_expr *)expr->parts.last)->node.span, "this divides by 0");
        tn_help(check->diagnostics, d, "divide by another number");
        return false;
    }
    *out = depends(b) ? *b : *a;
    if (tn_sum_scale(check, out, expr->kind, depends(b) ? a->constant : b->constant))
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_FINE, expr->node.span,
                                 "this number has more digits than sums are made with");
    tn_help(check->diagnostics, d, "use rounder numbers");
    return false;
}

void tn_report_quotient(tn_check *check, tn_span span)
{
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_QUOTIENT, span, "a quotient of two sums stands alone, and here there is more");
    tn_help(check->diagnostics, d,
            "as a measure it is `A / B`; compared it is so with a constant: `A / B < 3`, or `A / B in 2..3`");
}

bool tn_sum_add_up(tn_check *check, const tn_ast_expr *expr, tn_expr_kind kind, const char *verb, const tn_sum_parts *a,
                   const tn_sum_parts *b, tn_sum_parts *out)
{
    tn_span left = ((const tn_ast_expr *)expr->parts.first)->node.span,
            right = ((const tn_ast_expr *)expr->parts.last)->node.span;
    tn_sum_amount both;
    if (!tn_same_power(check, a->constant, left, b->constant, right, verb, &both))
        return false;
    if (a->over || b->over) {
        tn_report_quotient(check, a->over ? left : right);
        return false;
    }
    *out = (tn_sum_parts){.constant = both};
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

static bool eval_two(tn_check *check, tn_ast_expr *expr, tn_sum_parts *out)
{
    tn_sum_parts a, b;
    bool good = tn_sum_eval(check, (tn_ast_expr *)expr->parts.first, &a);
    good &= tn_sum_eval(check, (tn_ast_expr *)expr->parts.last, &b);
    if (!good)
        return false;
    if (expr->kind == TN_EXPR_TIMES || expr->kind == TN_EXPR_OVER)
        return eval_product(check, expr, &a, &b, out);
    return tn_sum_add_up(check, expr, expr->kind, expr->kind == TN_EXPR_PLUS ? "added to" : "taken from", &a, &b, out);
}

static bool eval_measure(tn_check *check, const tn_checked_rule *measure, tn_sum_parts *out)
{
    const tn_checked_sum *of = measure->sum;
    if (!of)
        return false;
    *out = (tn_sum_parts){.constant = {.value = of->constant, .power = of->power}};
    for (size_t i = 0; i < of->count; i++)
        if (!add_term(check, out, of->terms[i]))
            return false;
    if (!of->over)
        return true;
    tn_sum_parts *over = TN_NEW(check->arena, tn_sum_parts);
    if (!over)
        return false;
    *over = (tn_sum_parts){.constant = {.value = of->over->constant, .power = of->over->power}};
    out->over = over;
    for (size_t i = 0; i < of->over->count; i++)
        if (!add_term(check, over, of->over->terms[i]))
            return false;
    return true;
}

bool tn_sum_eval(tn_check *check, tn_ast_expr *expr, tn_sum_parts *out)
{
    *out = (tn_sum_parts){0};
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
    case TN_EXPR_EXTREME:
    case TN_EXPR_GAP:
        return eval_extreme(check, expr, out);
    case TN_EXPR_WALK:
        return house_term(check, TN_TERM_WALK, expr, 1, out);
    case TN_EXPR_EXITS:
        return house_term(check, TN_TERM_EXITS, expr, 0, out);
    case TN_EXPR_NAME:
        return expr->rule && expr->rule->is_measure && eval_measure(check, expr->rule, out);
    case TN_EXPR_NEGATIVE:
        if (!tn_sum_eval(check, (tn_ast_expr *)expr->parts.first, out))
            return false;
        return tn_sum_scale(check, out, TN_EXPR_TIMES, (tn_sum_amount){.value = "-1"});
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
        return eval_two(check, expr, out);
    default:
        return false; /* already reported */
    }
}

tn_checked_sum *tn_sum_finish(tn_check *check, const tn_sum_parts *s, tn_span span)
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
    made->over = s->over ? tn_sum_finish(check, s->over, span) : NULL;
    for (size_t i = 0; i < s->count; i++) {
        made->whole |= s->terms[i].kind == TN_TERM_MATCHES;
        made->partial |= s->terms[i].kind == TN_TERM_EXTREME || s->terms[i].kind == TN_TERM_GAP;
        if (s->terms[i].kind < TN_TERM_CELLS)
            continue;
        made->houses = true;
        made->walks |= s->terms[i].kind == TN_TERM_WALK;
        made->form = s->terms[i].part->ask->form;
    }
    return made;
}

tn_checked_sum *tn_check_sum(tn_check *check, tn_ast_expr *expr)
{
    tn_sum_parts s;
    return tn_sum_eval(check, expr, &s) ? tn_sum_finish(check, &s, expr->node.span) : NULL;
}

static bool in_powers(int power)
{
    return power >= 0 && power <= MEASURE_POWER_MAX;
}

/* Of a quotient both sides: `rent / area` is a number by area. */
static bool power_stands(const tn_checked_sum *sum)
{
    return sum->over ? in_powers(sum->over->power) && in_powers(sum->power + sum->over->power) : in_powers(sum->power);
}

/* Houses are counted by their measures, which all of them have. */
static void refuse_partial(tn_check *check, tn_checked_rule *measure)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_QUOTIENT, measure->ast->body->node.span,
                                 "a measure of houses is a sum, which every house has");
    tn_help(check->diagnostics, d,
            "quotients, `max(...)` and `min(...)` are measures of plans; of houses they can be "
            "compared in rules");
    measure->sum = NULL;
}

void tn_check_plan_measure(tn_check *check, tn_checked_rule *measure)
{
    measure->sum = tn_check_sum(check, measure->ast->body);
    if (measure->sum && measure->form)
        tn_check_house_sum(check, measure->sum);
    if (measure->sum && measure->form && (measure->sum->over || measure->sum->partial))
        refuse_partial(check, measure);
    if (!measure->sum || power_stands(measure->sum))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_DIMENSIONS, measure->ast->body->node.span,
                                 "a measure cannot be a length to the power of %d", measure->sum->power);
    tn_help(check->diagnostics, d, "it is a number, a length, an area or a volume: divide or multiply by `1m` or `1'`");
    measure->sum = NULL;
}
