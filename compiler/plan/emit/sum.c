/* Sums: their terms' functions, comparisons, measures. */
#include <stdio.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "compiler/plan/emit/emit.h"

/* ---- what a tray counts */

/* The place of the tray's value in its order: from the first on, each picked over what is there so far. A number of a
 * schema is also one of those that are made from it: what its figures ask is of the schema at hand. */
static void emit_place(tn_emit *emit, const tn_ast_expr *figure)
{
    tn_checked_schema *schema = emit->checked->schemas[emit->schema];
    char place[16];
    tn_span span = figure->node.span;
    tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, "1"), 0);
    for (uint32_t v = 1; v < schema->fields[figure->field].value_count; v++) {
        snprintf(place, sizeof place, "%u", (unsigned)v + 1);
        tn_emit_op(emit, span, TN_OP_FIGURE, tn_builder_string(emit->builder, place), 0);
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
        emit_figure(emit, cases[i]->sum);
        tn_emit_op(emit, cases[i]->node.span, TN_OP_PICK, tn_emit_spec(emit, number->specs[i]), 0);
    }
}

static uint32_t tally_of(tn_emit *emit, tn_ast_expr *figure, const char *name)
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

static uint32_t part_of(tn_emit *emit, const tn_checked_term *term, const char *name)
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
        if (term->kind >= TN_TERM_CELLS) {
            tn_emit_ask_needs(emit, term->part);
            continue;
        }
        part_of(emit, term, name);
        tally_of(emit, term->figure, name);
    }
}

/* What is counted, and where. */
static uint32_t kind_of(const tn_checked_term *term)
{
    static const uint32_t singles[] = {TN_SUM_SINGLES, TN_SUM_SINGLES_BEFORE, TN_SUM_SINGLES_AFTER},
                          starts[] = {TN_SUM_STARTS, TN_SUM_STARTS_BEFORE, TN_SUM_STARTS_AFTER};
    return term->kind == TN_TERM_SINGLES  ? singles[term->region]
           : term->kind == TN_TERM_STARTS ? starts[term->region]
                                          : (uint32_t)term->kind;
}

/* matches: whether those terms are written out too. The power is kept of what is shown to people. */
static uint32_t emit_sum(tn_emit *emit, const tn_checked_sum *sum, const char *constant, bool matches)
{
    bool shown = matches || (sum->houses && sum->power >= 0 && sum->power <= 3);
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TERM), count = 0;
    for (size_t i = 0; i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (term->kind >= TN_TERM_CELLS || (term->kind == TN_TERM_MATCHES && !matches))
            continue;
        count++;
        tn_builder_add_TERM(emit->builder, &(tn_term_record){
                                               .kind = kind_of(term),
                                               .factor = tn_builder_string(emit->builder, term->factor),
                                               .part = part_of(emit, term, ""),
                                               .tally = tally_of(emit, term->figure, ""),
                                           });
    }
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

static void emit_plain(tn_emit *emit, const comparing *c, const char *constant)
{
    static const tn_opcode opcodes[][2] = {
        [TN_LESS] = {TN_OP_BELOW, TN_OP_HOUSE_BELOW},     [TN_AT_MOST] = {TN_OP_ABOVE, TN_OP_HOUSE_ABOVE},
        [TN_EQUAL] = {TN_OP_ZERO, TN_OP_HOUSE_ZERO},      [TN_UNEQUAL] = {TN_OP_ZERO, TN_OP_HOUSE_ZERO},
        [TN_AT_LEAST] = {TN_OP_BELOW, TN_OP_HOUSE_BELOW}, [TN_GREATER] = {TN_OP_ABOVE, TN_OP_HOUSE_ABOVE},
    };
    uint32_t number = emit_sum(emit, c->sum, constant, false);
    if (c->sum->houses)
        number = tn_emit_house_sum(emit, c->sum, number);
    tn_emit_op(emit, c->span, c->modulus > 0 ? TN_OP_MULTIPLE : opcodes[c->op][c->sum->houses], number, c->modulus);
    if (c->op == TN_AT_MOST || c->op == TN_UNEQUAL || c->op == TN_AT_LEAST)
        tn_emit_op(emit, c->span, TN_OP_NOT, 0, 0);
}

/* `matches` is 1 or 0: either of the two, each with what the rest of the sum then has to be. */
static void emit_cases(tn_emit *emit, const comparing *c, size_t from, const char *constant)
{
    const tn_checked_sum *sum = c->sum;
    while (from < sum->count && sum->terms[from].kind != TN_TERM_MATCHES)
        from++;
    if (from == sum->count) {
        emit_plain(emit, c, constant);
        return;
    }
    const tn_checked_term *term = &sum->terms[from];
    uint32_t function = part_of(emit, term, "");
    tn_check check = {.arena = emit->arena};
    const char *more = tn_amount_apply(&check, TN_EXPR_PLUS, constant, term->factor);
    tn_emit_op(emit, c->span, TN_OP_CALL, function, 0);
    emit_cases(emit, c, from + 1, more ? more : constant);
    tn_emit_op(emit, c->span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, c->span, TN_OP_CALL, function, 0);
    tn_emit_op(emit, c->span, TN_OP_NOT, 0, 0);
    emit_cases(emit, c, from + 1, constant);
    tn_emit_op(emit, c->span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, c->span, TN_OP_OR, 0, 0);
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

uint32_t tn_emit_sum(tn_emit *emit, tn_checked_sum *sum, const char *name)
{
    if (sum->index == TN_NONE) {
        emit->schema = sum->schema->index;
        tn_emit_sum_needs(emit, sum, name);
        sum->index = emit_sum(emit, sum, sum->constant, true);
    }
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
                                                  .flags = measure->unit + 1 < emit->imports->count ? TN_IMPORTED : 0,
                                                  .file = span.file,
                                                  .begin = span.begin,
                                                  .end = span.end,
                                              });
    }
}
