/* Conditions that are always or never true.
 *
 * Between two constants of its comparisons a condition depends on remainders only, so that trying each constant, its
 * neighbours, and one period after each decides it. Where that would take too long nothing is said.
 */
#include <stdlib.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/check.h"

enum { WORK_MAX = 1000000 }; /* steps taken in all: a few milliseconds */

static bool holds(const tn_checked_condition *condition, int64_t n)
{
    bool stack[TN_NESTING_MAX + 2];
    size_t top = 0;
    for (size_t i = 0; i < condition->count; i++) {
        const tn_condition_step *step = &condition->steps[i];
        switch (step->opcode) {
        case TN_OP_LESS:
            stack[top++] = n < step->first;
            break;
        case TN_OP_EQUAL:
            stack[top++] = n == step->first;
            break;
        case TN_OP_GREATER:
            stack[top++] = n > step->first;
            break;
        case TN_OP_WITHIN:
            stack[top++] = step->first <= n && n <= step->second;
            break;
        case TN_OP_REMAINDER:
            stack[top++] = n % step->first == step->second;
            break;
        case TN_OP_BOTH:
            top--;
            stack[top - 1] = stack[top - 1] && stack[top];
            break;
        case TN_OP_EITHER:
            top--;
            stack[top - 1] = stack[top - 1] || stack[top];
            break;
        default:
            stack[top - 1] = !stack[top - 1];
            break;
        }
    }
    return stack[0];
}

static int64_t divisor(int64_t a, int64_t b)
{
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* What sums are multiples of: the greatest common divisor of the field's lengths; 1 for counts, 0 where all are 0. */
static int64_t unit_of(const tn_checked_schema *schema, uint32_t field)
{
    if (field == TN_NONE)
        return 1;
    int64_t unit = 0;
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++)
        unit = divisor(unit, schema->fields[field].values[v].length);
    return unit;
}

/* The number of units after which all remainders repeat; 0 where it is more than WORK_MAX. */
static int64_t period_of(const tn_checked_condition *condition, int64_t unit)
{
    int64_t period = 1;
    for (size_t i = 0; i < condition->count; i++) {
        if (condition->steps[i].opcode != TN_OP_REMAINDER)
            continue;
        int64_t modulus = condition->steps[i].first / divisor(condition->steps[i].first, unit);
        modulus /= divisor(modulus, period);
        if (modulus > WORK_MAX / period)
            return 0;
        period *= modulus;
    }
    return period;
}

typedef struct tn_trial {
    const tn_checked_condition *condition;
    int64_t unit, period;
    bool seen[2]; /* false, true */
} tn_trial;

/* Tries one period of multiples of the unit from around `constant`; and one from 0. */
static void try_around(tn_trial *trial, int64_t constant)
{
    int64_t start = constant / trial->unit - 1;
    if (start < 0)
        start = 0;
    for (int64_t k = start; k <= start + trial->period + 2 && !(trial->seen[0] && trial->seen[1]); k++) {
        int64_t n;
        if (__builtin_mul_overflow(k, trial->unit, &n))
            return;
        trial->seen[holds(trial->condition, n)] = true;
    }
}

void tn_check_truth(tn_check *check, const tn_checked_condition *condition, const char *variable, uint32_t field)
{
    tn_trial trial = {.condition = condition,
                      .unit = check->schema && !check->schema->broken ? unit_of(check->schema, field) : 0};
    if (trial.unit == 0)
        return;
    trial.period = period_of(condition, trial.unit);
    if (trial.period == 0 || (int64_t)condition->count > WORK_MAX / (int64_t)condition->count / (trial.period + 3))
        return;
    try_around(&trial, 0);
    for (size_t i = 0; i < condition->count; i++) {
        const tn_condition_step *step = &condition->steps[i];
        if (step->opcode == TN_OP_LESS || step->opcode == TN_OP_EQUAL || step->opcode == TN_OP_GREATER ||
            step->opcode == TN_OP_WITHIN)
            try_around(&trial, step->first);
        if (step->opcode == TN_OP_WITHIN)
            try_around(&trial, step->second);
    }
    if (trial.seen[0] && trial.seen[1])
        return;
    tn_code code = trial.seen[1] ? W_ALWAYS_TRUE : W_NEVER_TRUE;
    if (!tn_check_wanted(check, code))
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, code, condition->span, "this is %s true", trial.seen[1] ? "always" : "never");
    if (field == TN_NONE)
        tn_help(check->diagnostics, d, "`%s` is a whole number, 0 or more: compare it with another one", variable);
    else {
        char text[400];
        tn_say_values(&check->schema->fields[field], NULL, text, sizeof text);
        tn_help(check->diagnostics, d, "`%s` adds values of `%s`: %s", variable, check->schema->fields[field].name,
                text);
    }
}
