/* Tells whether a requirement always or never holds, whatever the design: by the values that measures can have. */
#include <math.h>

#include "compiler/solid/solid.h"
#include "runtime/number/interval.h"
#include "runtime/solid/measured.h"

/* The weakest contact has no value where nothing touches. */
static tn_interval bounds_of_measure(uint32_t term)
{
    switch ((tn_solid_measured)term) {
    case TN_SOLID_CENTRE_X_MEASURED:
    case TN_SOLID_CENTRE_Y_MEASURED:
    case TN_SOLID_CENTRE_Z_MEASURED:
    case TN_SOLID_STABLE_MEASURED:
        return (tn_interval){-INFINITY, INFINITY, false};
    case TN_SOLID_SUPPORT_MEASURED:
        return (tn_interval){0, 1, false};
    case TN_SOLID_WEAKEST_MEASURED:
        return (tn_interval){0, INFINITY, true};
    default:
        return (tn_interval){0, INFINITY, false};
    }
}

/* Expressions nest no deeper than the parser allows. */
static tn_interval bounds_of(const tn_expression *e)
{
    tn_interval values[TN_ARITY_MAX];
    const tn_interval *operands[TN_ARITY_MAX];
    size_t count = 0;
    if (e->op == TN_OP_NUMBER)
        return tn_interval_of(e->number);
    if (e->op == TN_OP_TERM)
        return bounds_of_measure(e->term);
    for (const tn_expression *operand = e->first; operand && count < TN_ARITY_MAX; operand = operand->next) {
        values[count] = bounds_of(operand);
        operands[count] = &values[count];
        count++;
    }
    return tn_operation_bounds(e->op, operands);
}

static tn_solid_answer opposite(tn_solid_answer answer)
{
    return answer == TN_SOLID_ALWAYS ? TN_SOLID_NEVER : answer == TN_SOLID_NEVER ? TN_SOLID_ALWAYS : TN_SOLID_DEPENDS;
}

static tn_solid_answer both(tn_solid_answer a, tn_solid_answer b)
{
    if (a == TN_SOLID_NEVER || b == TN_SOLID_NEVER)
        return TN_SOLID_NEVER;
    return a == TN_SOLID_ALWAYS && b == TN_SOLID_ALWAYS ? TN_SOLID_ALWAYS : TN_SOLID_DEPENDS;
}

static tn_solid_answer answer_of(bool always, bool never)
{
    return always ? TN_SOLID_ALWAYS : never ? TN_SOLID_NEVER : TN_SOLID_DEPENDS;
}

/* What may have no value does not hold there. */
static tn_solid_answer is_at_most(tn_interval a, tn_interval b)
{
    return answer_of(a.high <= b.low && !a.fails && !b.fails, a.low > b.high);
}

static tn_solid_answer is_below(tn_interval a, tn_interval b)
{
    return answer_of(a.high < b.low && !a.fails && !b.fails, a.low >= b.high);
}

static tn_solid_answer is_equal(tn_interval a, tn_interval b)
{
    bool one = a.low == a.high && b.low == b.high && a.low == b.low;
    return answer_of(one && !a.fails && !b.fails, a.high < b.low || b.high < a.low);
}

static tn_solid_answer compare(const tn_expression *e)
{
    tn_interval a = bounds_of(e->first), b = bounds_of(e->first->next);
    switch ((int)e->op) {
    case TN_OP_IS_BELOW:
        return is_below(a, b);
    case TN_OP_IS_AT_MOST:
        return is_at_most(a, b);
    case TN_OP_IS_ABOVE:
        return is_below(b, a);
    case TN_OP_IS_AT_LEAST:
        return is_at_most(b, a);
    case TN_OP_IS_EQUAL:
        return is_equal(a, b);
    case TN_OP_IS_UNEQUAL:
        return a.fails || b.fails ? TN_SOLID_DEPENDS : opposite(is_equal(a, b));
    default: /* between */
        return both(is_at_most(b, a), is_at_most(a, bounds_of(e->last)));
    }
}

static tn_solid_answer is_not_zero(tn_interval value)
{
    bool always = !value.fails && (value.low > 0 || value.high < 0);
    return answer_of(always, value.low == 0 && value.high == 0);
}

tn_solid_answer tn_solid_requirement_answer(const tn_expression *e)
{
    switch ((int)e->op) {
    case TN_OP_IS_BELOW:
    case TN_OP_IS_AT_MOST:
    case TN_OP_IS_EQUAL:
    case TN_OP_IS_UNEQUAL:
    case TN_OP_IS_AT_LEAST:
    case TN_OP_IS_ABOVE:
    case TN_OP_IS_BETWEEN:
        return compare(e);
    case TN_OP_IS_BOTH:
        return both(tn_solid_requirement_answer(e->first), tn_solid_requirement_answer(e->last));
    case TN_OP_IS_EITHER:
        return opposite(
            both(opposite(tn_solid_requirement_answer(e->first)), opposite(tn_solid_requirement_answer(e->last))));
    case TN_OP_IS_NOT:
        return opposite(tn_solid_requirement_answer(e->first));
    default:
        return is_not_zero(bounds_of(e));
    }
}
