/* Sums: their terms' functions, comparisons, measures. */
#include <stdio.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/emit/emit.h"

/* ---- what a tray counts */

/* What the tray's value is by its order, a place or a measured number: from the first on, each picked over what is
 * there so far. A number of a schema is also one of those that are made from it: what its figures ask is of the schema
 * at hand. */
static void emit_place(tn_emit *emit, const tn_ast_expr *figure)
{
    tn_checked_schema *schema = emit->checked->schemas[emit->schema];
    const tn_checked_field *field = &schema->fields[figure->field];
    tn_span span = figure->node.span;
    tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, field->values[0].number), 0);
    for (uint32_t v = 1; v < field->value_count; v++) {
        tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, field->values[v].number), 0);
        tn_checked_spec *spec = tn_value_spec(emit->arena, schema, figure->field, v, span);
        if (spec)
            tn_emit_op(emit, span, TN_OP_PICK, tn_emit_spec(emit, spec), 0);
    }
}

static void emit_figure(tn_emit *emit, const tn_ast_expr *figure)
{
    static const tn_opcode opcodes[] = {
        [TN_EXPR_PLUS] = TN_OP_PLUS, [TN_EXPR_MINUS] = TN_OP_MINUS,  [TN_EXPR_TIMES] = TN_OP_TIMES,
        [TN_EXPR_OVER] = TN_OP_OVER, [TN_EXPR_LEAST] = TN_OP_LESSER, [TN_EXPR_MOST] = TN_OP_LARGER};
    tn_span span = figure->node.span;
    if (figure->kind == TN_EXPR_NUMBER) {
        tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, figure->constant), 0);
    } else if (figure->kind == TN_EXPR_NEGATIVE) {
        tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, "0"), 0);
        emit_figure(emit, (const tn_ast_expr *)figure->parts.first);
        tn_emit_op(emit, span, TN_OP_MINUS, 0, 0);
    } else if (figure->kind == TN_EXPR_FIGURE && figure->place) {
        emit_place(emit, figure);
    } else if (figure->kind == TN_EXPR_FIGURE && !figure->number) {
        tn_emit_op(emit, span, TN_OP_EXTENT, emit->checked->schemas[emit->schema]->field_first + figure->field, 0);
    } else if (figure->kind == TN_EXPR_FIGURE) {
        tn_emit_number(emit, figure->number, span);
    } else {
        emit_figure(emit, (const tn_ast_expr *)figure->parts.first);
        emit_figure(emit, (const tn_ast_expr *)figure->parts.last);
        tn_emit_op(emit, span, opcodes[figure->kind], 0, 0);
    }
}

/* From the last case to the first, each picked over what is there so far. */
void tn_emit_number(tn_emit *emit, const tn_checked_number *number, tn_span span)
{
    const tn_ast_number_case *cases[TN_NUMBER_CASES_MAX];
    size_t count = 0;
    for (TN_EACH(const tn_ast_number_case, c, number->ast->cases))
        cases[count++] = c;
    tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, "0"), 0);
    for (size_t i = count; i-- > 0;) {
        for (size_t k = 0; k < number->cases[i].count; k++) {
            emit_figure(emit, cases[i]->sum);
            tn_emit_op(emit, cases[i]->node.span, TN_OP_PICK, tn_emit_spec(emit, number->cases[i].boxes[k]), 0);
        }
    }
}

uint32_t tn_emit_tally(tn_emit *emit, tn_ast_expr *figure, const char *name)
{
    if (!figure)
        return TN_NO_RECORD;
    if (figure->tally)
        return figure->tally - 1;
    tn_emit_begin(emit, emit->schema);
    emit_figure(emit, figure);
    tn_emit_op(emit, figure->node.span, TN_OP_TALLY, 0, 0);
    figure->tally = tn_emit_end(emit, name, TN_FUNCTION_TALLY) + 1;
    return figure->tally - 1;
}

/* ---- terms */

typedef struct label {
    char text[TN_NAME_MAX + 1];
} label;

/* What the function of a term in `name` is called. */
static label label_of(const char *name)
{
    static const char suffix[] = " (part)";
    label made;
    snprintf(made.text, sizeof made.text, "%.*s%s", (int)(TN_NAME_MAX - sizeof suffix), name, suffix);
    return made;
}

static uint32_t any_of(tn_emit *emit, tn_checked_spec *any, const char *name)
{
    if (any->function)
        return any->function - 1;
    tn_emit_begin(emit, emit->schema);
    tn_emit_op(emit, any->span, TN_OP_TRAY, tn_emit_spec(emit, any), 0);
    tn_emit_op(emit, any->span, TN_OP_RETURN, 0, 0);
    any->function = tn_emit_end(emit, label_of(name).text, TN_FUNCTION_WHOLE) + 1;
    return any->function - 1;
}

uint32_t tn_emit_part(tn_emit *emit, const tn_checked_term *term, const char *name)
{
    bool holds = term->kind == TN_TERM_MATCHES;
    if (term->any)
        return any_of(emit, term->any, name);
    if (term->rule)
        return holds ? term->rule->holds : term->rule->whole;
    tn_ast_expr *part = term->part;
    uint32_t *function = holds ? &part->part_holds : &part->part_whole;
    if (*function)
        return *function - 1;
    tn_emit_needs(emit, part, name);
    tn_emit_begin(emit, emit->schema);
    if (holds)
        tn_emit_holds(emit, part);
    else
        tn_emit_whole(emit, part);
    tn_emit_op(emit, part->node.span, TN_OP_RETURN, 0, 0);
    *function = tn_emit_end(emit, label_of(name).text, holds ? TN_FUNCTION_HOLDS : TN_FUNCTION_WHOLE) + 1;
    return *function - 1;
}

void tn_emit_sum_needs(tn_emit *emit, tn_checked_sum *sum, const char *name)
{
    for (size_t i = 0; sum && i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (term->kind == TN_TERM_COST)
            continue;
        if (term->kind == TN_TERM_EXTREME || term->kind == TN_TERM_GAP) {
            tn_emit_extreme_needs(emit, term->part, name);
            continue;
        }
        if (term->kind >= TN_TERM_CELLS) {
            tn_emit_ask_needs(emit, term->part);
            continue;
        }
        tn_emit_part(emit, term, name);
        tn_emit_tally(emit, term->figure, name);
    }
}

/* What is counted, and where. */
static tn_sum_kind kind_of(const tn_checked_term *term)
{
    static const tn_sum_kind singles[] = {TN_SUM_SINGLES, TN_SUM_SINGLES_BEFORE, TN_SUM_SINGLES_AFTER},
                             starts[] = {TN_SUM_STARTS, TN_SUM_STARTS_BEFORE, TN_SUM_STARTS_AFTER};
    return term->kind == TN_TERM_SINGLES   ? singles[term->region]
           : term->kind == TN_TERM_STARTS  ? starts[term->region]
           : term->kind == TN_TERM_MATCHES ? TN_SUM_MATCHES
                                           : TN_SUM_PRESENT;
}

static void emit_term(tn_emit *emit, const tn_checked_term *term)
{
    tn_builder_add_TERM(emit->builder, &(tn_term_record){
                                           .kind = kind_of(term),
                                           .factor = tn_builder_string(emit->builder, term->factor),
                                           .part = tn_emit_part(emit, term, ""),
                                           .tally = tn_emit_tally(emit, term->figure, ""),
                                           .other = TN_NO_RECORD,
                                       });
}

/* whole: of the whole plan: `matches` and extremes are written out as well. The power is kept of what can be
 * shown to people. needed: a function without which it has no value, or TN_NO_RECORD. */
static uint32_t emit_sum(tn_emit *emit, const tn_checked_sum *sum, const char *constant, bool whole, uint32_t needed)
{
    bool shown = whole || (sum->power >= 0 && sum->power <= 3);
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TERM);
    if (needed != TN_NO_RECORD)
        tn_emit_needed(emit, needed);
    for (size_t i = 0; i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (whole && term->kind == TN_TERM_EXTREME)
            constant = tn_emit_extreme_terms(emit, term, constant);
        else if (whole && term->kind == TN_TERM_GAP)
            tn_emit_gap_term(emit, term);
        else if (term->kind < TN_TERM_EXTREME && (whole || term->kind != TN_TERM_MATCHES))
            emit_term(emit, term);
    }
    uint32_t count = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TERM) - first;
    return tn_builder_add_SUM(emit->builder, &(tn_sum_record){
                                                 .schema = emit->schema,
                                                 .power = shown ? (uint32_t)sum->power : 0,
                                                 .constant = tn_builder_string(emit->builder, constant),
                                                 .term_first = first,
                                                 .term_count = count,
                                             });
}

/* ---- comparisons */

/* How a sum is compared with 0; or, modulus above 0, with the multiples of it. */
typedef struct comparing {
    tn_span span;
    const tn_checked_sum *sum;
    tn_operator op;
    int64_t modulus;
} comparing;

static void emit_cases(tn_emit *emit, const comparing *c, size_t from, const char *constant);

/* Is what the term is worth told case by case? */
static bool makes_cases(const tn_checked_term *term)
{
    return term->kind == TN_TERM_MATCHES || term->kind == TN_TERM_EXTREME;
}

static void emit_plain(tn_emit *emit, const comparing *c, const char *constant)
{
    static const tn_opcode opcodes[][2] = {
        [TN_LESS] = {TN_OP_BELOW, TN_OP_HOUSE_BELOW},     [TN_AT_MOST] = {TN_OP_ABOVE, TN_OP_HOUSE_ABOVE},
        [TN_EQUAL] = {TN_OP_ZERO, TN_OP_HOUSE_ZERO},      [TN_UNEQUAL] = {TN_OP_ZERO, TN_OP_HOUSE_ZERO},
        [TN_AT_LEAST] = {TN_OP_BELOW, TN_OP_HOUSE_BELOW}, [TN_GREATER] = {TN_OP_ABOVE, TN_OP_HOUSE_ABOVE},
    };
    static const tn_opcode walked[] = {
        [TN_LESS] = TN_OP_HOUSE_BELOW,         [TN_AT_MOST] = TN_OP_HOUSE_NOT_ABOVE,
        [TN_EQUAL] = TN_OP_HOUSE_ZERO,         [TN_UNEQUAL] = TN_OP_HOUSE_NOT_ZERO,
        [TN_AT_LEAST] = TN_OP_HOUSE_NOT_BELOW, [TN_GREATER] = TN_OP_HOUSE_ABOVE,
    };
    uint32_t number = emit_sum(emit, c->sum, constant, false, TN_NO_RECORD);
    if (c->sum->houses)
        number = tn_emit_house_sum(emit, c->sum, number);
    if (c->sum->walks) { /* what has no value meets no bound */
        tn_emit_op(emit, c->span, walked[c->op], number, 0);
        return;
    }
    tn_emit_op(emit, c->span, c->modulus > 0 ? TN_OP_MULTIPLE : opcodes[c->op][c->sum->houses], number, c->modulus);
    if (c->op == TN_AT_MOST || c->op == TN_UNEQUAL || c->op == TN_AT_LEAST)
        tn_emit_op(emit, c->span, TN_OP_NOT, 0, 0);
}

/* `matches` is 1 or 0: either of the two, each with what the rest of the sum then has to be. */
static void emit_matches_cases(tn_emit *emit, const comparing *c, size_t at, const char *constant)
{
    const tn_checked_term *term = &c->sum->terms[at];
    uint32_t function = tn_emit_part(emit, term, "");
    tn_emit_op(emit, c->span, TN_OP_CALL, function, 0);
    emit_cases(emit, c, at + 1, tn_emit_added(emit, constant, term->factor));
    tn_emit_op(emit, c->span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, c->span, TN_OP_CALL, function, 0);
    tn_emit_op(emit, c->span, TN_OP_NOT, 0, 0);
    emit_cases(emit, c, at + 1, constant);
    tn_emit_op(emit, c->span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, c->span, TN_OP_OR, 0, 0);
}

/* Does a number with that sign, 0 for 0, compare so with 0? */
static bool compares(tn_operator op, int sign)
{
    switch (op) {
    case TN_LESS:
        return sign < 0;
    case TN_AT_MOST:
        return sign <= 0;
    case TN_EQUAL:
        return sign == 0;
    case TN_UNEQUAL:
        return sign != 0;
    case TN_AT_LEAST:
        return sign >= 0;
    default:
        return sign > 0;
    }
}

static int sign_of(const char *number)
{
    return *number == '-' ? -1 : !tn_amount_is_zero(number);
}

/* Does the rest of the sum, from a term on and all that is no case, depend on the plan? */
static bool is_alone(const tn_checked_sum *sum, size_t at)
{
    for (size_t i = 0; i < sum->count; i++)
        if (i != at && (i > at || !makes_cases(&sum->terms[i])))
            return false;
    return true;
}

/* No tray is chosen from: the sum is below or above all numbers. Then each number that the extreme can be, with what
 * the rest of the sum then has to be. Where there is no rest, neighbouring numbers that both compare so are one case.
 */
static void emit_extreme_cases(tn_emit *emit, const comparing *c, size_t at, const char *constant)
{
    const tn_checked_term *term = &c->sum->terms[at];
    const tn_checked_extreme *numbers = term->part->numbers;
    bool least = term->part->extreme == TN_EXTREME_LEAST, alone = is_alone(c->sum, at);
    tn_emit_extreme_none(emit, c->span, numbers, compares(c->op, least == (*term->factor != '-') ? 1 : -1));
    for (size_t i = 0; i < numbers->count;) {
        const char *sum = tn_emit_added(emit, constant, tn_emit_times(emit, numbers->values[i], term->factor));
        size_t last = i;
        bool holds = compares(c->op, sign_of(sum));
        while (alone && last + 1 < numbers->count &&
               compares(c->op, sign_of(tn_emit_added(emit, constant,
                                                     tn_emit_times(emit, numbers->values[last + 1], term->factor)))) ==
                   holds)
            last++;
        if (!alone || holds) {
            tn_emit_extreme_is(emit, c->span, numbers, i, last);
            if (!alone) {
                emit_cases(emit, c, at + 1, sum);
                tn_emit_op(emit, c->span, TN_OP_AND, 0, 0);
            }
            tn_emit_op(emit, c->span, TN_OP_OR, 0, 0);
        }
        i = last + 1;
    }
}

static void emit_cases(tn_emit *emit, const comparing *c, size_t from, const char *constant)
{
    const tn_checked_sum *sum = c->sum;
    while (from < sum->count && !makes_cases(&sum->terms[from]))
        from++;
    if (from == sum->count)
        emit_plain(emit, c, constant);
    else if (sum->terms[from].kind == TN_TERM_MATCHES)
        emit_matches_cases(emit, c, from, constant);
    else
        emit_extreme_cases(emit, c, from, constant);
}

/* A quotient compares so with a number if what is divided less so many times what it is divided by compares so with 0,
 * where that is above 0, and the other way round where it is below 0. By 0 it has no value, and no comparison holds. */
static void emit_quotient_side(tn_emit *emit, const tn_ast_expr *expr, tn_operator side, tn_operator low,
                               tn_operator high)
{
    tn_span span = expr->node.span;
    comparing over = {.span = span, .sum = expr->over, .op = side}, first = {.span = span, .sum = expr->sum, .op = low},
              second = {.span = span, .sum = expr->high, .op = high};
    emit_cases(emit, &over, 0, expr->over->constant);
    emit_cases(emit, &first, 0, expr->sum->constant);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
    if (!expr->high)
        return;
    emit_cases(emit, &second, 0, expr->high->constant);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
}

void tn_emit_quotient(tn_emit *emit, const tn_ast_expr *expr)
{
    tn_operator low = expr->high ? TN_AT_LEAST : expr->op;
    emit_quotient_side(emit, expr, TN_GREATER, low, TN_AT_MOST);
    emit_quotient_side(emit, expr, TN_LESS, tn_operator_turned(low), TN_AT_LEAST);
    tn_emit_op(emit, expr->node.span, TN_OP_OR, 0, 0);
}

void tn_emit_comparison(tn_emit *emit, tn_span span, tn_checked_sum *sum, tn_operator op)
{
    comparing c = {.span = span, .sum = sum, .op = op};
    emit_cases(emit, &c, 0, sum->constant);
}

void tn_emit_remainder(tn_emit *emit, const tn_ast_expr *expr)
{
    comparing c = {.span = expr->node.span, .sum = expr->sum, .op = expr->op, .modulus = expr->modulus};
    emit_cases(emit, &c, 0, expr->sum->constant);
}

/* ---- measures */

/* The function of the plans for which a sum is not 0, so that something can be divided by it. */
static uint32_t emit_divides(tn_emit *emit, const tn_checked_sum *over, const char *name)
{
    comparing unequal = {.span = over->span, .sum = over, .op = TN_UNEQUAL};
    tn_emit_begin(emit, emit->schema);
    emit_cases(emit, &unequal, 0, over->constant);
    tn_emit_op(emit, over->span, TN_OP_RETURN, 0, 0);
    return tn_emit_end(emit, label_of(name).text, TN_FUNCTION_HOLDS);
}

uint32_t tn_emit_sum(tn_emit *emit, tn_checked_sum *sum, const char *name)
{
    tn_checked_sum *over = sum->over;
    uint32_t divides = TN_NO_RECORD;
    if (sum->index != TN_NONE)
        return sum->index;
    emit->schema = sum->schema->index;
    tn_emit_sum_needs(emit, sum, name);
    tn_emit_sum_needs(emit, over, name);
    if (over) {
        divides = emit_divides(emit, over, name);
        over->index = emit_sum(emit, over, over->constant, true, TN_NO_RECORD);
        sum->power += over->power;
    }
    sum->index = emit_sum(emit, sum, sum->constant, true, divides);
    return sum->index;
}

void tn_emit_plan_measure(tn_emit *emit, tn_checked_rule *measure)
{
    tn_emit_sum(emit, measure->sum, measure->name);
}

void tn_emit_measures(tn_emit *emit)
{
    const tn_checked *checked = emit->checked;
    for (size_t i = 0; i < checked->rule_count; i++) {
        const tn_checked_rule *measure = checked->rules[i];
        if (!measure->is_measure || (measure->hidden && !measure->listed))
            continue;
        if (measure->form) {
            tn_emit_house_measure(emit, measure);
            continue;
        }
        tn_span span = measure->ast->top.node.span;
        const tn_ast_word *doc = measure->ast->doc;
        tn_builder_add_MEASURE(emit->builder, &(tn_measure_record){
                                                  .name = tn_builder_string(emit->builder, measure->name),
                                                  .doc = tn_builder_string(emit->builder, doc ? doc->text : NULL),
                                                  .schema = measure->schema->index,
                                                  .sum = measure->sum->index,
                                                  .over = measure->sum->over ? measure->sum->over->index : TN_NO_RECORD,
                                                  .flags = measure->unit + 1 < emit->imports->count ? TN_IMPORTED : 0,
                                                  .file = span.file,
                                                  .begin = span.begin,
                                                  .end = span.end,
                                              });
    }
}
