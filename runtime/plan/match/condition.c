/* Evaluates conditions on a number, finds where they repeat, and writes them back as text. */
#include "runtime/plan/match/condition.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/module/opcodes.h"

/* ---- as text */

enum { PARTS_MAX = 8 };

/* How strongly a part binds: an operand that binds less than its operator needs parentheses. */
typedef enum condition_binding { BINDS_OR, BINDS_AND, BINDS_NOT, BINDS_COMPARISON } condition_binding;

typedef struct tn_condition_part {
    char text[TN_CONDITION_TEXT_MAX];
    condition_binding binding;
} tn_condition_part;

typedef struct tn_condition_parts {
    tn_condition_part items[PARTS_MAX];
    size_t count;
    bool overflow;
} tn_condition_parts;

/* Pushes what was printed; TN_CONDITION_TEXT_MAX or more means that it did not fit. */
static void push_part(tn_condition_parts *parts, const tn_condition_part *part, int printed)
{
    parts->overflow |= printed < 0 || printed >= TN_CONDITION_TEXT_MAX || parts->count == PARTS_MAX;
    if (!parts->overflow)
        parts->items[parts->count++] = *part;
}

static void combine(tn_condition_parts *parts, condition_binding binding, const char *operator)
{
    const tn_condition_part *right = &parts->items[--parts->count], *left = &parts->items[--parts->count];
    bool left_open = left->binding >= binding, right_open = right->binding >= binding;
    tn_condition_part part = {.binding = binding};
    int printed = snprintf(part.text, sizeof part.text, "%s%s%s %s %s%s%s", left_open ? "" : "(", left->text,
                           left_open ? "" : ")", operator, right_open ? "" : "(", right->text, right_open ? "" : ")");
    push_part(parts, &part, printed);
}

static void negate(tn_condition_parts *parts)
{
    const tn_condition_part *inner = &parts->items[--parts->count];
    bool open = inner->binding >= BINDS_NOT;
    tn_condition_part part = {.binding = BINDS_NOT};
    int printed = snprintf(part.text, sizeof part.text, "not %s%s%s", open ? "" : "(", inner->text, open ? "" : ")");
    push_part(parts, &part, printed);
}

static void push_comparison(tn_condition_parts *parts, const tn_instruction *instruction)
{
    tn_condition_part part = {.binding = BINDS_COMPARISON};
    long long first = instruction->first, second = instruction->second;
    int printed = 0;
    switch (instruction->opcode) {
    case TN_OP_LESS:
        printed = snprintf(part.text, sizeof part.text, "n < %lld", first);
        break;
    case TN_OP_EQUAL:
        printed = snprintf(part.text, sizeof part.text, "n = %lld", first);
        break;
    case TN_OP_GREATER:
        printed = snprintf(part.text, sizeof part.text, "n > %lld", first);
        break;
    case TN_OP_WITHIN:
        printed = snprintf(part.text, sizeof part.text, "n in %lld..%lld", first, second);
        break;
    default:
        printed = snprintf(part.text, sizeof part.text, "n mod %lld = %lld", first, second);
        break;
    }
    push_part(parts, &part, printed);
}

void tn_condition_text(const tn_module *module, uint32_t function, char text[TN_CONDITION_TEXT_MAX])
{
    tn_condition_parts parts = {.count = 0};
    uint32_t offset = module->FUNCTION_records[function].code_begin;
    for (;;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        if (parts.overflow || instruction.opcode == TN_OP_ANSWER)
            break;
        if (instruction.opcode == TN_OP_BOTH)
            combine(&parts, BINDS_AND, "and");
        else if (instruction.opcode == TN_OP_EITHER)
            combine(&parts, BINDS_OR, "or");
        else if (instruction.opcode == TN_OP_NEITHER)
            negate(&parts);
        else
            push_comparison(&parts, &instruction);
        offset += instruction.length;
    }
    strcpy(text, parts.overflow ? "..." : parts.items[0].text);
}

/* Truth values as bits, so that the deepest stack that a module may ask for fits the C stack. */
typedef struct truth_stack {
    uint64_t bits[TN_STACK_MAX / 64];
    size_t size;
} truth_stack;

static inline void push(truth_stack *stack, bool truth)
{
    uint64_t bit = UINT64_C(1) << (stack->size % 64);
    uint64_t *word = &stack->bits[stack->size / 64];
    if (stack->size % 64 == 0)
        *word = 0;
    *word = truth ? *word | bit : *word & ~bit;
    stack->size++;
}

static inline bool pop(truth_stack *stack)
{
    stack->size--;
    return stack->bits[stack->size / 64] >> (stack->size % 64) & 1;
}

/* The truth of a comparison; false for the opcodes that are none. */
static bool compare(tn_opcode opcode, int64_t first, int64_t second, int64_t n)
{
    switch (opcode) {
    case TN_OP_LESS:
        return n < first;
    case TN_OP_EQUAL:
        return n == first;
    case TN_OP_GREATER:
        return n > first;
    case TN_OP_WITHIN:
        return first <= n && n <= second;
    case TN_OP_REMAINDER:
        return n % first == second;
    default:
        return false;
    }
}

bool tn_condition_holds(const tn_module *module, uint32_t function, int64_t n)
{
    truth_stack stack;
    stack.size = 0; /* the words are set when a push first reaches them */
    const tn_function_record *record = &module->FUNCTION_records[function];
    for (uint32_t offset = record->code_begin; offset < record->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        switch (instruction.opcode) {
        case TN_OP_BOTH: {
            bool upper = pop(&stack), lower = pop(&stack);
            push(&stack, lower && upper);
            break;
        }
        case TN_OP_EITHER: {
            bool upper = pop(&stack), lower = pop(&stack);
            push(&stack, lower || upper);
            break;
        }
        case TN_OP_NEITHER:
            push(&stack, !pop(&stack));
            break;
        case TN_OP_ANSWER:
            return pop(&stack);
        default:
            push(&stack, compare(instruction.opcode, instruction.first, instruction.second, n));
        }
        offset += instruction.length;
    }
    return false;
}

/* Where E surely repeats: from `threshold` on with `period`, both in steps of `unit`. */
typedef struct tail {
    uint64_t threshold;
    uint64_t period;
} tail;

static uint64_t greatest_common_divisor(uint64_t a, uint64_t b)
{
    while (b != 0) {
        uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* A comparison with k no longer changes past k; a remainder by m repeats every m / gcd(m, unit) steps. */
static void tail_of_comparison(const tn_instruction *instruction, int64_t unit, uint64_t limit, tail *result)
{
    int64_t last = instruction->first;
    if (instruction->opcode == TN_OP_WITHIN && instruction->second > last)
        last = instruction->second;
    if (instruction->opcode != TN_OP_REMAINDER) {
        uint64_t steps = last < 0 ? 0 : (uint64_t)last / (uint64_t)unit + 1;
        result->threshold = steps > result->threshold ? steps : result->threshold;
        return;
    }
    uint64_t step = (uint64_t)last / greatest_common_divisor((uint64_t)last, (uint64_t)unit);
    step /= greatest_common_divisor(step, result->period);
    if (__builtin_mul_overflow(result->period, step, &result->period) || result->period > limit)
        result->period = limit + 1;
}

/* false where the bounds pass `limit`. */
static bool find_tail(const tn_module *module, const tn_function_record *record, int64_t unit, uint64_t limit,
                      tail *result)
{
    *result = (tail){.threshold = 0, .period = 1};
    for (uint32_t offset = record->code_begin; offset < record->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        tn_operands operands = tn_code_operands((uint8_t)instruction.opcode);
        if (operands == TN_OPERANDS_INT || operands == TN_OPERANDS_INT2)
            tail_of_comparison(&instruction, unit, limit, result);
        if (result->period > limit || result->threshold > limit - result->period)
            return false;
        offset += instruction.length;
    }
    int64_t last;
    return !__builtin_mul_overflow((int64_t)(result->threshold + result->period), unit, &last);
}

static bool repeats(const uint8_t *values, uint64_t size, uint64_t period)
{
    for (uint64_t i = 0; i + period < size; i++) {
        if (values[i] != values[i + period])
            return false;
    }
    return true;
}

/* The least period of a block that goes round for ever. The periods that divide its size are closed under greatest
 * common divisors, so dividing out one prime after another finds the least. */
static uint64_t least_period(const uint8_t *block, uint64_t size)
{
    uint64_t period = size, rest = size;
    for (uint64_t prime = 2; rest > 1; prime++) {
        if (prime * prime > rest)
            prime = rest;
        while (rest % prime == 0) {
            rest /= prime;
            if (period % prime == 0 && repeats(block, size, period / prime))
                period /= prime;
        }
    }
    return period;
}

tn_status tn_condition_period(const tn_module *module, uint32_t function, int64_t unit, uint64_t limit,
                              uint64_t *threshold, uint64_t *period, tn_error *error)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    tail bound;
    limit = limit < TN_CONDITION_STEPS_MAX ? limit : TN_CONDITION_STEPS_MAX;
    if (!find_tail(module, record, unit, limit, &bound)) {
        tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "a condition counts further than the limit of %llu steps",
                (unsigned long long)limit);
        tn_error_help(error, limit < TN_CONDITION_STEPS_MAX ? "raise it with --max-states" : "use smaller numbers");
        if (error)
            error->code_offset = record->code_begin;
        return TN_LIMIT;
    }
    uint64_t size = bound.threshold + bound.period;
    uint8_t *values = tn_array_new(size, 1);
    if (!values)
        return tn_fail_memory(error);
    for (uint64_t i = 0; i < size; i++)
        values[i] = tn_condition_holds(module, function, (int64_t)i * unit);
    uint64_t least = least_period(values + bound.threshold, bound.period);
    uint64_t first = bound.threshold;
    while (first > 0 && values[first - 1] == values[first - 1 + least])
        first--;
    free(values);
    *threshold = first;
    *period = least;
    return TN_OK;
}
