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

/* gain[j] += what place k of the plan adds to every stretch that starts at k or before and ends at j or later. */
static void add_place(const tn_plan_vm *vm, const tn_sum *sum, size_t k, bool reversed, int64_t *gain)
{
    tn_tray tray = vm->trays[reversed ? vm->length - 1 - k : k];
    for (uint32_t i = 0; i < sum->count; i++) {
        const tn_sum_term *term = &sum->terms[i];
        const uint64_t *row = tn_plan_vm_found(vm, term->part, reversed) + k * vm->words;
        if (term->kind == TN_SUM_SINGLES && tn_relation_row_has(row, k + 1))
            gain[k + 1] += term->weight ? term->weight[tray] : term->each;
        size_t end = term->kind == TN_SUM_STARTS ? tn_relation_row_next(row, k + 1, vm->words) : TN_NO_BIT;
        if (end != TN_NO_BIT)
            gain[end] += term->each;
    }
}

void tn_plan_vm_compare(tn_plan_vm *vm, tn_opcode opcode, const tn_sum *sum, uint64_t *relation, bool reversed)
{
    int64_t *gain = vm->sums;
    memset(gain, 0, (vm->length + 1) * sizeof *gain);
    memset(relation, 0, vm->relation_size * sizeof *relation);
    for (size_t i = vm->length + 1; i-- > 0;) {
        if (i < vm->length)
            add_place(vm, sum, i, reversed, gain);
        int64_t value = sum->constant;
        for (size_t j = i; j <= vm->length; j++) {
            value += j > i ? gain[j] : 0;
            if (opcode == TN_OP_BELOW ? value < 0 : opcode == TN_OP_ZERO ? value == 0 : value > 0)
                tn_relation_row_set(relation + i * vm->words, j);
        }
    }
}

/* Adds what a term is worth over the whole plan, in steps of its sum's unit. */
static tn_status add_term(tn_plan_vm *vm, const tn_sum_term *term, int64_t *steps, tn_error *error)
{
    bool in = false;
    tn_status status = tn_plan_vm_relation(vm, term->part, 0, vm->length, &in, error);
    if (status != TN_OK)
        return status;
    const uint64_t *relation = tn_plan_vm_found(vm, term->part, false);
    if (term->kind == TN_SUM_MATCHES)
        *steps += in ? term->each : 0;
    for (size_t k = 0; k < vm->length; k++) {
        const uint64_t *row = relation + k * vm->words;
        if (term->kind == TN_SUM_SINGLES && tn_relation_row_has(row, k + 1))
            *steps += term->weight ? term->weight[vm->trays[k]] : term->each;
        if (term->kind == TN_SUM_STARTS && tn_relation_row_next(row, k + 1, vm->words) != TN_NO_BIT)
            *steps += term->each;
    }
    return TN_OK;
}

tn_status tn_plan_vm_value(tn_plan_vm *vm, uint32_t index, mpq_t value, tn_error *error)
{
    const tn_sum *sum = NULL;
    tn_status status = tn_plan_vm_summed(vm, index, &sum, error);
    if (status != TN_OK)
        return status;
    int64_t steps = sum->constant;
    for (uint32_t i = 0; status == TN_OK && i < sum->count; i++)
        status = add_term(vm, &sum->terms[i], &steps, error);
    if (status != TN_OK)
        return status;
    mpz_set_si(mpq_numref(value), steps);
    mpz_set_ui(mpq_denref(value), 1);
    mpq_mul(value, value, sum->unit);
    return TN_OK;
}
