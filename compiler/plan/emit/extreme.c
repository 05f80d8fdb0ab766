/* The greatest and the least number of a tray, and gaps.
 *
 * `max(X of a)` has no code of its own. For each number that X can be there is a function: some tray that is a has at
 * least this number. In comparisons they tell the cases apart; in a measure the greatest number is the first one, and
 * for each further one that is reached what it is more.
 */
#include "compiler/plan/check/amount.h"
#include "compiler/plan/emit/emit.h"

const char *tn_emit_added(tn_emit *emit, const char *left, const char *right)
{
    tn_check check = {.arena = emit->arena};
    const char *sum = tn_amount_apply(&check, TN_EXPR_PLUS, left, right);
    return sum ? sum : left;
}

const char *tn_emit_times(tn_emit *emit, const char *left, const char *right)
{
    tn_check check = {.arena = emit->arena};
    const char *product = tn_amount_apply(&check, TN_EXPR_TIMES, left, right);
    return product ? product : left;
}

/* A part as a term that counts it. */
static tn_checked_term of_part(tn_ast_expr *part)
{
    tn_checked_term term = {.kind = TN_TERM_SINGLES, .factor = "1"};
    if (part->kind == TN_EXPR_NAME)
        term.rule = part->rule;
    else
        term.part = part;
    return term;
}

/* What is chosen from, as a term: single trays that are a, or any tray. */
static tn_checked_term chosen_from(const tn_ast_expr *extreme)
{
    tn_ast_expr *part = (tn_ast_expr *)extreme->parts.first;
    return part ? of_part(part) : (tn_checked_term){.kind = TN_TERM_SINGLES, .factor = "1", .any = extreme->spec};
}

/* The stretches with a tray, of those that are chosen from, whose number is this or a better one. A single tray's sum
 * is its number; the sum counts those trays only, since others may divide by zero. */
static uint32_t emit_reached(tn_emit *emit, const tn_ast_expr *extreme, size_t i, const tn_checked_term *from,
                             const char *name)
{
    tn_span span = extreme->node.span;
    const char *less = tn_emit_times(emit, extreme->numbers->values[i], "-1");
    uint32_t part = tn_emit_part(emit, from, name), first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TERM);
    tn_builder_add_TERM(emit->builder, &(tn_term_record){.kind = TN_SUM_SINGLES,
                                                         .factor = tn_builder_string(emit->builder, "1"),
                                                         .part = part,
                                                         .tally = tn_emit_tally(emit, extreme->figure, name),
                                                         .other = TN_NO_RECORD});
    uint32_t sum =
        tn_builder_add_SUM(emit->builder, &(tn_sum_record){.schema = emit->schema,
                                                           .constant = tn_builder_string(emit->builder, less),
                                                           .term_first = first,
                                                           .term_count = 1});
    tn_emit_begin(emit, emit->schema);
    tn_emit_op(emit, span, TN_OP_TRAY, tn_emit_spec(emit, extreme->spec), 0);
    tn_emit_op(emit, span, TN_OP_CALL, part, 0);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, span, extreme->extreme == TN_EXTREME_MOST ? TN_OP_BELOW : TN_OP_ABOVE, sum, 0);
    tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
    tn_emit_op(emit, span, TN_OP_SOMEWHERE, 0, 0);
    tn_emit_op(emit, span, TN_OP_RETURN, 0, 0);
    return tn_emit_end(emit, name, TN_FUNCTION_HOLDS);
}

/* What lies between is added up by a field, or its trays are counted. */
static void emit_gap_needs(tn_emit *emit, tn_ast_expr *gap, const char *name)
{
    for (TN_EACH(tn_ast_expr, part, gap->parts)) {
        tn_checked_term term = of_part(part);
        tn_emit_part(emit, &term, name);
    }
    if (gap->field == TN_NONE || gap->tally)
        return;
    tn_emit_begin(emit, emit->schema);
    tn_emit_op(emit, gap->node.span, TN_OP_EXTENT, emit->checked->schemas[emit->schema]->field_first + gap->field, 0);
    tn_emit_op(emit, gap->node.span, TN_OP_TALLY, 0, 0);
    gap->tally = tn_emit_end(emit, name, TN_FUNCTION_TALLY) + 1;
}

void tn_emit_extreme_needs(tn_emit *emit, tn_ast_expr *extreme, const char *name)
{
    for (TN_EACH(tn_ast_expr, part, extreme->parts))
        tn_emit_needs(emit, part, name);
    if (extreme->kind == TN_EXPR_GAP) {
        emit_gap_needs(emit, extreme, name);
        return;
    }
    tn_checked_term from = chosen_from(extreme);
    tn_emit_part(emit, &from, name);
    tn_emit_tally(emit, extreme->figure, name);
    for (size_t i = 0; i < extreme->numbers->count; i++)
        if (!extreme->numbers->reached[i])
            extreme->numbers->reached[i] = emit_reached(emit, extreme, i, &from, name) + 1;
}

/* ---- comparisons */

void tn_emit_extreme_none(tn_emit *emit, tn_span span, const tn_checked_extreme *numbers, bool holds)
{
    tn_emit_op(emit, span, TN_OP_CALL, numbers->reached[0] - 1, 0);
    tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
    if (holds)
        return;
    tn_emit_op(emit, span, TN_OP_CALL, numbers->reached[0] - 1, 0);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
}

void tn_emit_extreme_is(tn_emit *emit, tn_span span, const tn_checked_extreme *numbers, size_t first, size_t last)
{
    tn_emit_op(emit, span, TN_OP_CALL, numbers->reached[first] - 1, 0);
    if (last + 1 == numbers->count)
        return;
    tn_emit_op(emit, span, TN_OP_CALL, numbers->reached[last + 1] - 1, 0);
    tn_emit_op(emit, span, TN_OP_NOT, 0, 0);
    tn_emit_op(emit, span, TN_OP_AND, 0, 0);
}

/* ---- measures */

static void add_term(tn_emit *emit, tn_sum_kind kind, const char *factor, uint32_t part)
{
    tn_builder_add_TERM(emit->builder, &(tn_term_record){.kind = kind,
                                                         .factor = tn_builder_string(emit->builder, factor),
                                                         .part = part,
                                                         .tally = TN_NO_RECORD,
                                                         .other = TN_NO_RECORD});
}

void tn_emit_needed(tn_emit *emit, uint32_t function)
{
    add_term(emit, TN_SUM_NEEDED, "1", function);
}

const char *tn_emit_extreme_terms(tn_emit *emit, const tn_checked_term *term, const char *constant)
{
    const tn_checked_extreme *numbers = term->part->numbers;
    tn_emit_needed(emit, numbers->reached[0] - 1);
    for (size_t i = 1; i < numbers->count; i++) {
        const char *more = tn_emit_added(emit, numbers->values[i], tn_emit_times(emit, numbers->values[i - 1], "-1"));
        add_term(emit, TN_SUM_MATCHES, tn_emit_times(emit, more, term->factor), numbers->reached[i] - 1);
    }
    return tn_emit_added(emit, constant, tn_emit_times(emit, numbers->values[0], term->factor));
}

void tn_emit_gap_term(tn_emit *emit, const tn_checked_term *term)
{
    tn_ast_expr *gap = term->part;
    tn_checked_term source = of_part((tn_ast_expr *)gap->parts.first),
                    destination = of_part((tn_ast_expr *)gap->parts.last);
    tn_builder_add_TERM(emit->builder, &(tn_term_record){.kind = gap->extreme == TN_EXTREME_MOST ? TN_SUM_LONGEST_GAP
                                                                                                 : TN_SUM_SHORTEST_GAP,
                                                         .factor = tn_builder_string(emit->builder, term->factor),
                                                         .part = tn_emit_part(emit, &source, ""),
                                                         .tally = gap->tally ? gap->tally - 1 : TN_NO_RECORD,
                                                         .other = tn_emit_part(emit, &destination, "")});
}
