/* Sums on the stretches of a plan, as the interpreter finds them. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/match/relation.h"
#include "runtime/plan/match/vm_data.h"

tn_status tn_plan_vm_summed(tn_plan_vm *vm, uint32_t index, const tn_sum **sum, tn_error *error)
{
    if (!vm->summed && !(vm->summed = calloc(vm->module->SUM_count + 1, sizeof(tn_sum *))))
        return tn_fail_memory(error);
    tn_status status = vm->summed[index] ? TN_OK : tn_sum_new(vm->schema, index, &vm->summed[index], error);
    *sum = vm->summed[index];
    return status;
}

bool tn_plan_vm_sum_needs(const tn_plan_vm *vm, const tn_sum *sum, bool reversed, uint32_t *function)
{
    for (uint32_t i = 0; i < sum->count; i++) {
        if (tn_plan_vm_found(vm, sum->terms[i].part, reversed))
            continue;
        *function = sum->terms[i].part;
        return true;
    }
    return false;
}

/* A sum being compared on all stretches. */
typedef struct tn_compared {
    const tn_plan_vm *vm;
    const tn_sum *sum;
    bool reversed;
    int64_t *gain; /* [N + 1]: what a stretch gains by ending at j instead of j - 1 */
} tn_compared;

static const uint64_t *row_of(const tn_compared *c, const tn_sum_term *term, size_t k)
{
    return tn_plan_vm_found(c->vm, term->part, c->reversed) + k * c->vm->words;
}

/* What place k counts in a term that ends at `last` at most, and where its match ends first (TN_NO_BIT: nowhere). */
static int64_t count_place(const tn_compared *c, const tn_sum_term *term, size_t k, size_t last, size_t *end)
{
    const uint64_t *row = row_of(c, term, k);
    bool singles = term->kind == TN_SUM_SINGLES;
    *end = singles ? (tn_relation_row_has(row, k + 1) ? k + 1 : TN_NO_BIT)
                   : tn_relation_row_next(row, k + 1, c->vm->words);
    if (*end == TN_NO_BIT || *end > last)
        return 0;
    return tn_term_steps(term, c->vm->trays[c->reversed ? c->vm->length - 1 - k : k]);
}

/* Place k has a tray that is to be there: from now on it is the first one, and no more the one behind it. */
static void add_present(const tn_compared *c, const tn_sum_term *term, size_t k)
{
    if (!tn_relation_row_has(row_of(c, term, k), k + 1))
        return;
    c->gain[k + 1] += term->each;
    for (size_t next = k + 1; next < c->vm->length; next++)
        if (tn_relation_row_has(row_of(c, term, next), next + 1)) {
            c->gain[next + 1] -= term->each;
            return;
        }
}

/* What place k adds to every stretch that starts at k or before and ends at j or later goes into gain[j]. */
static void add_place(const tn_compared *c, size_t k)
{
    for (uint32_t i = 0; i < c->sum->count; i++) {
        const tn_sum_term *term = &c->sum->terms[i];
        size_t end;
        if (term->region != TN_REGION_STRETCH)
            continue;
        if (term->kind == TN_SUM_PRESENT) {
            add_present(c, term, k);
            continue;
        }
        int64_t steps = count_place(c, term, k, c->vm->length, &end);
        if (end != TN_NO_BIT)
            c->gain[end] += steps;
    }
}

/* What the terms of a region count from place `first` to place `last`. */
static int64_t region_value(const tn_compared *c, tn_sum_region region, size_t first, size_t last)
{
    int64_t value = 0;
    size_t end;
    for (uint32_t i = 0; i < c->sum->count; i++)
        for (size_t k = first; c->sum->terms[i].region == region && k < last; k++)
            value += count_place(c, &c->sum->terms[i], k, last, &end);
    return value;
}

/* A stretch that ends at j instead of j - 1 no more has place j - 1 behind it. */
static void lose_places_behind(const tn_compared *c)
{
    for (size_t j = 1; j <= c->vm->length; j++)
        c->gain[j] -=
            region_value(c, TN_REGION_AFTER, j - 1, c->vm->length) - region_value(c, TN_REGION_AFTER, j, c->vm->length);
}

static bool looks_around(const tn_sum *sum)
{
    for (uint32_t i = 0; i < sum->count; i++)
        if (sum->terms[i].region != TN_REGION_STRETCH)
            return true;
    return false;
}

static bool compares(tn_opcode opcode, int64_t value, int64_t modulus)
{
    switch (opcode) {
    case TN_OP_BELOW:
        return value < 0;
    case TN_OP_ZERO:
        return value == 0;
    case TN_OP_ABOVE:
        return value > 0;
    default:
        return value % modulus == 0;
    }
}

void tn_plan_vm_compare(tn_plan_vm *vm, const tn_instruction *op, const tn_sum *sum, uint64_t *relation, bool reversed)
{
    tn_compared c = {.vm = vm, .sum = sum, .reversed = reversed, .gain = vm->sums};
    int64_t modulus = op->opcode == TN_OP_MULTIPLE ? tn_sum_modulus(sum, op->second) : 1;
    bool around = looks_around(sum);
    memset(c.gain, 0, (vm->length + 1) * sizeof *c.gain);
    memset(relation, 0, vm->relation_size * sizeof *relation);
    if (around)
        lose_places_behind(&c);
    for (size_t i = vm->length + 1; i-- > 0;) {
        if (i < vm->length)
            add_place(&c, i);
        int64_t value = sum->constant;
        if (around)
            value += region_value(&c, TN_REGION_BEFORE, 0, i) + region_value(&c, TN_REGION_AFTER, i, vm->length);
        for (size_t j = i; j <= vm->length; j++) {
            value += j > i ? c.gain[j] : 0;
            if (compares(op->opcode, value, modulus))
                tn_relation_row_set(relation + i * vm->words, j);
        }
    }
}

/* ---- values of the whole plan */

/* Where stretches of a relation that are not empty end, or start: [N + 1]. */
static void find_edges(const tn_plan_vm *vm, const uint64_t *relation, bool *ends, bool *starts)
{
    memset(ends, 0, vm->length + 1);
    memset(starts, 0, vm->length + 1);
    for (size_t i = 0; i < vm->length; i++)
        for (size_t j = tn_relation_row_next(relation + i * vm->words, i + 1, vm->words); j != TN_NO_BIT;
             j = tn_relation_row_next(relation + i * vm->words, j + 1, vm->words))
            starts[i] = ends[j] = true;
}

/* What lies between place i and place j, in steps: all of one sign. */
static int64_t between(const tn_plan_vm *vm, const tn_sum_term *gap, size_t i, size_t j)
{
    int64_t steps = 0;
    for (; i < j; i++)
        steps += tn_term_steps(gap, vm->trays[i]);
    return steps;
}

/* How far the nearest stretch is from [i, j) that ends before or starts behind it; false: there is none. */
static bool nearest(const tn_plan_vm *vm, const tn_sum_term *gap, const bool *ends, const bool *starts, size_t i,
                    size_t j, int64_t *steps)
{
    size_t left = i + 1, right = j;
    while (left > 0 && !ends[left - 1])
        left--;
    while (right < vm->length && !starts[right])
        right++;
    bool before = left > 0, behind = right < vm->length;
    int64_t one = before ? between(vm, gap, left - 1, i) : 0, other = behind ? between(vm, gap, j, right) : 0;
    *steps = before && (!behind || llabs(one) < llabs(other)) ? one : other;
    return before || behind;
}

/* The longest gap, or the shortest; *has false: there is no gap, or one that leads nowhere and would be the longest. */
static tn_status add_gap(tn_plan_vm *vm, const tn_sum_term *gap, int64_t *steps, bool *has, tn_error *error)
{
    bool in, longest = gap->kind == TN_SUM_LONGEST_GAP, any = false, endless = false;
    tn_status status = tn_plan_vm_relation(vm, gap->other, 0, vm->length, &in, error);
    bool *ends = malloc(vm->length + 1), *starts = malloc(vm->length + 1);
    if (status == TN_OK && (!ends || !starts))
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        find_edges(vm, tn_plan_vm_found(vm, gap->other, false), ends, starts);
        status = tn_plan_vm_relation(vm, gap->part, 0, vm->length, &in, error);
    }
    const uint64_t *relation = status == TN_OK ? tn_plan_vm_found(vm, gap->part, false) : NULL;
    int64_t best = 0;
    for (size_t i = 0; relation && i < vm->length; i++)
        for (size_t j = tn_relation_row_next(relation + i * vm->words, i + 1, vm->words); j != TN_NO_BIT;
             j = tn_relation_row_next(relation + i * vm->words, j + 1, vm->words)) {
            int64_t here;
            bool found = nearest(vm, gap, ends, starts, i, j, &here);
            endless |= !found;
            if (found && (!any || (llabs(here) > llabs(best)) == longest))
                best = here;
            any |= found;
        }
    *steps += best;
    *has &= any && !(longest && endless);
    free(ends);
    free(starts);
    return status;
}

/* Adds what a term is worth over the whole plan, in steps of its sum's unit. */
static tn_status add_term(tn_plan_vm *vm, const tn_sum_term *term, int64_t *steps, bool *has, tn_error *error)
{
    bool in = false;
    if (tn_term_is_gap(term->kind))
        return add_gap(vm, term, steps, has, error);
    tn_status status = tn_plan_vm_relation(vm, term->part, 0, vm->length, &in, error);
    if (status != TN_OK)
        return status;
    const uint64_t *relation = tn_plan_vm_found(vm, term->part, false);
    if (term->kind == TN_SUM_MATCHES)
        *steps += in ? term->each : 0;
    if (term->kind == TN_SUM_NEEDED)
        *has &= in;
    for (size_t k = 0; k < vm->length; k++) {
        const uint64_t *row = relation + k * vm->words;
        if (term->kind == TN_SUM_SINGLES && tn_relation_row_has(row, k + 1))
            *steps += tn_term_steps(term, vm->trays[k]);
        if (term->kind == TN_SUM_STARTS && tn_relation_row_next(row, k + 1, vm->words) != TN_NO_BIT)
            *steps += term->each;
        if (term->kind == TN_SUM_PRESENT && tn_relation_row_has(row, k + 1)) {
            *steps += term->each;
            break;
        }
    }
    return TN_OK;
}

static void set_steps(const tn_sum *sum, int64_t steps, mpq_t value)
{
    mpz_set_si(mpq_numref(value), steps);
    mpz_set_ui(mpq_denref(value), 1);
    mpq_mul(value, value, sum->unit);
}

tn_status tn_plan_vm_value(tn_plan_vm *vm, uint32_t index, mpq_t value, bool *has, tn_error *error)
{
    const tn_sum *sum = NULL;
    tn_status status = tn_plan_vm_summed(vm, index, &sum, error);
    if (status != TN_OK)
        return status;
    int64_t steps = sum->constant;
    *has = true;
    for (uint32_t i = 0; status == TN_OK && i < sum->count; i++)
        status = add_term(vm, &sum->terms[i], &steps, has, error);
    if (status != TN_OK)
        return status;
    set_steps(sum, *has ? steps : 0, value);
    return TN_OK;
}

tn_status tn_plan_vm_added(tn_plan_vm *vm, uint32_t index, mpq_t above, mpq_t below, bool *has, tn_error *error)
{
    const tn_sum *sum = NULL;
    int64_t steps[2] = {0, 0};
    tn_status status = tn_plan_vm_summed(vm, index, &sum, error);
    *has = true;
    for (uint32_t i = 0; status == TN_OK && i < sum->count; i++) {
        const tn_term_record *record = &vm->module->TERM_records[sum->record->term_first + i];
        bool minus = tn_text(vm->module, record->factor)[0] == '-';
        status = add_term(vm, &sum->terms[i], &steps[minus], has, error);
    }
    if (status != TN_OK)
        return status;
    set_steps(sum, *has ? steps[0] : 0, above);
    set_steps(sum, *has ? steps[1] : 0, below);
    return TN_OK;
}

tn_status tn_plan_vm_measure(tn_plan_vm *vm, uint32_t measure, mpq_t value, bool *has, tn_error *error)
{
    const tn_measure_record *record = &vm->module->MEASURE_records[measure];
    tn_status status = tn_plan_vm_value(vm, record->sum, value, has, error);
    if (status != TN_OK || record->over == TN_NO_RECORD)
        return status;
    bool divided = false;
    mpq_t over;
    mpq_init(over);
    status = tn_plan_vm_value(vm, record->over, over, &divided, error);
    *has = *has && divided && mpq_sgn(over) != 0;
    if (*has)
        mpq_div(value, value, over);
    else
        mpq_set_ui(value, 0, 1);
    mpq_clear(over);
    return status;
}
