/* The instructions of the plan language on bit relations, each compiled for one word a row (plans of up to 63 trays)
 * and for many. */
#include <string.h>

#include "runtime/plan/match/condition.h"
#include "runtime/plan/match/relation.h"
#include "runtime/plan/match/vm_data.h"

TN_RELATION_INLINE tn_tray tray_at(const tn_plan_vm *vm, bool reversed, size_t k)
{
    return vm->trays[reversed ? vm->length - 1 - k : k];
}

TN_RELATION_INLINE void run_tray(const tn_plan_vm *vm, uint64_t *relation, uint32_t spec, bool reversed, size_t words)
{
    memset(relation, 0, (vm->length + 1) * words * sizeof *relation);
    const tn_mask_record *mask = vm->module->MASK_records + vm->module->SPEC_records[spec].mask_first;
    for (size_t k = 0; !vm->schema->legal && k < vm->length; k++) {
        const uint64_t *bits = tn_tray_mask(vm->schema, tray_at(vm, reversed, k));
        uint64_t missing = 0;
        for (uint32_t w = 0; w < vm->schema->mask_words; w++)
            missing |= bits[w] & ~(uint64_t)mask[w].bits;
        if (!missing)
            tn_relation_row_set(relation + k * words, k + 1);
    }
    for (size_t k = 0; vm->schema->legal && k < vm->length; k++)
        if (tn_spec_meets(vm->schema, spec, tray_at(vm, reversed, k)))
            tn_relation_row_set(relation + k * words, k + 1);
}

/* relation := { [i, j) : the trays at i + t and j - 1 - t have the same value for all t }: those inside of [i + 1, j -
 * 1) whose ends are alike. */
TN_RELATION_INLINE void run_mirrored(const tn_plan_vm *vm, uint64_t *relation, uint32_t field, bool reversed,
                                     size_t words)
{
    field -= vm->schema->record->field_first;
    memset(relation, 0, (vm->length + 1) * words * sizeof *relation);
    for (size_t i = vm->length + 1; i-- > 0;) {
        uint64_t *row = relation + i * words;
        tn_relation_row_set(row, i);
        if (i == vm->length)
            continue;
        uint32_t value = tn_tray_value(vm->schema, tray_at(vm, reversed, i), field);
        tn_relation_row_set(row, i + 1);
        for (size_t j = i + 2; j <= vm->length; j++)
            if (tn_relation_row_has(row + words, j - 1) &&
                tn_tray_value(vm->schema, tray_at(vm, reversed, j - 1), field) == value)
                tn_relation_row_set(row, j);
    }
}

/* relation := { [i, j) : E(sums[j] - sums[i]) } for sums that count: truths has E of every number up to the last sum.
 */
TN_RELATION_INLINE void keep_counts(tn_plan_vm *vm, uint64_t *relation, uint32_t condition, size_t words)
{
    size_t trays = vm->length;
    for (int64_t n = 0; n <= vm->sums[trays]; n++)
        vm->truths[n] = tn_condition_holds(vm->module, condition, n);
    memset(relation, 0, (trays + 1) * words * sizeof *relation);
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = relation + i * words;
        if (i > 0 && vm->sums[i] == vm->sums[i - 1]) { /* the tray before does not count: the row before, from i on */
            for (size_t w = 0; w < words; w++)
                row[w] = relation[(i - 1) * words + w] & tn_bits_from(i, w);
            continue;
        }
        for (size_t j = i; j <= trays; j++)
            row[j / 64] |= (uint64_t)vm->truths[vm->sums[j] - vm->sums[i]] << (j % 64);
    }
}

TN_RELATION_INLINE void run_quantity(tn_plan_vm *vm, uint64_t *relation, uint32_t condition, size_t words)
{
    vm->sums[0] = 0;
    for (size_t k = 0; k < vm->length; k++)
        vm->sums[k + 1] = vm->sums[k] + tn_relation_single(relation, k, words);
    keep_counts(vm, relation, condition, words);
}

/* A place k counts for [i, j) once j reaches the first end of a stretch that starts at k. */
TN_RELATION_INLINE void run_occurrences(tn_plan_vm *vm, uint64_t *relation, uint32_t condition, size_t words)
{
    size_t trays = vm->length;
    for (size_t n = 0; n <= trays; n++)
        vm->truths[n] = tn_condition_holds(vm->module, condition, (int64_t)n);
    memset(vm->places, 0, (trays + 1) * sizeof *vm->places); /* per end: the starts from i on that first end there */
    for (size_t i = trays + 1; i-- > 0;) {
        uint64_t *row = relation + i * words;
        size_t end = tn_relation_row_next(row, i + 1, words);
        if (end != TN_NO_BIT)
            vm->places[end]++;
        memset(row, 0, words * sizeof *row);
        size_t n = 0;
        for (size_t j = i; j <= trays; j++) {
            n += vm->places[j];
            row[j / 64] |= (uint64_t)vm->truths[n] << (j % 64);
        }
    }
}

/* Lengths are below 2^50 nm (TN_LENGTH_MAX); a sum past 64 bits stays at the largest number. */
TN_RELATION_INLINE void run_sum(tn_plan_vm *vm, uint64_t *relation, uint32_t field, uint32_t condition, bool reversed,
                                size_t words)
{
    size_t trays = vm->length;
    field -= vm->schema->record->field_first;
    vm->sums[0] = 0;
    for (size_t k = 0; k < trays; k++) {
        int64_t length = tn_tray_value_record(vm->schema, tray_at(vm, reversed, k), field)->length;
        length = tn_relation_single(relation, k, words) ? length : 0;
        if (__builtin_add_overflow(vm->sums[k], length, &vm->sums[k + 1]))
            vm->sums[k + 1] = INT64_MAX;
    }
    memset(relation, 0, (trays + 1) * words * sizeof *relation);
    for (size_t i = 0; i <= trays; i++) {
        bool truth = false;
        for (size_t j = i; j <= trays; j++) {
            if (j == i || vm->sums[j] != vm->sums[j - 1])
                truth = tn_condition_holds(vm->module, condition, vm->sums[j] - vm->sums[i]);
            relation[i * words + j / 64] |= (uint64_t)truth << (j % 64);
        }
    }
}

/* REPEATED: as many stretches as it needs, chained, and then as many as it may have. No stretch has more than trays.
 * The relation behind it on the stack is room. */
TN_RELATION_INLINE void run_times(tn_plan_vm *vm, uint64_t *relation, uint64_t least, uint64_t most, size_t words)
{
    size_t trays = vm->length;
    uint64_t *each = relation + vm->relation_size;
    tn_relation_nonempty(relation, trays, words);
    memcpy(each, relation, vm->relation_size * sizeof *each);
    if (least > trays) {
        memset(relation, 0, vm->relation_size * sizeof *relation);
        return;
    }
    for (uint64_t n = 1; n < least; n++)
        tn_relation_chain(relation, each, trays, words, vm->rows);
    bool any = most == 0 || most >= trays;
    if (any)
        tn_relation_star(each, trays, words, vm->rows);
    else
        tn_relation_optional(each, trays, words);
    for (uint64_t n = any ? 0 : least; n < (any ? 1 : most); n++)
        tn_relation_chain(relation, each, trays, words, vm->rows);
}

/* DISTANCE, NEAR, FAR: source, destination and separator. */
TN_RELATION_INLINE void run_gaps(tn_plan_vm *vm, tn_opcode opcode, uint64_t *source, size_t words)
{
    tn_gaps gaps = {.begins = vm->rows,
                    .ends = vm->rows + words,
                    .right_fine = vm->rows + 2 * words,
                    .left_bad = vm->rows + 3 * words,
                    .overlap_from = vm->places};
    uint64_t *destination = source + vm->relation_size, *separator = destination + vm->relation_size;
    if (opcode == TN_OP_NEAR)
        tn_relation_near(source, destination, separator, vm->length, words, &gaps);
    else if (opcode == TN_OP_FAR)
        tn_relation_far(source, destination, separator, vm->length, words, &gaps);
    else
        tn_relation_distance(source, destination, separator, vm->length, words, &gaps);
}

/* An operation on the relations at the top of the stack, that is all but CALL, MIRROR and RETURN. */
TN_RELATION_INLINE void run_operation(tn_plan_vm *vm, const tn_instruction *op, uint64_t *top, bool reversed,
                                      size_t words)
{
    size_t trays = vm->length;
    uint32_t first = (uint32_t)op->first, second = (uint32_t)op->second;
    switch (op->opcode) {
    case TN_OP_TRAY:
        run_tray(vm, top, first, reversed, words);
        break;
    case TN_OP_MIRRORED:
        run_mirrored(vm, top, first, reversed, words);
        break;
    case TN_OP_WHERE:
        tn_relation_and(top, top + vm->relation_size, trays, words);
        tn_relation_nonempty(top, trays, words);
        break;
    case TN_OP_AND:
        tn_relation_and(top, top + vm->relation_size, trays, words);
        break;
    case TN_OP_OR:
        tn_relation_or(top, top + vm->relation_size, trays, words);
        break;
    case TN_OP_NOT:
        tn_relation_not(top, trays, words);
        break;
    case TN_OP_SOMEWHERE:
        tn_relation_somewhere(top, trays, words);
        break;
    case TN_OP_ONCE:
        break;
    case TN_OP_NONEMPTY:
        tn_relation_nonempty(top, trays, words);
        break;
    case TN_OP_OPTIONAL:
        tn_relation_optional(top, trays, words);
        break;
    case TN_OP_CHAIN:
        tn_relation_chain(top, top + vm->relation_size, trays, words, vm->rows);
        break;
    case TN_OP_REPEATED:
        run_times(vm, top, (uint64_t)op->first, (uint64_t)op->second, words);
        break;
    case TN_OP_BEGINNING:
        tn_relation_beginning(top, trays, words);
        break;
    case TN_OP_END:
        tn_relation_end(top, trays, words);
        break;
    case TN_OP_MANY:
        tn_relation_many(top, trays, words);
        break;
    case TN_OP_QUANTITY:
        run_quantity(vm, top, first, words);
        break;
    case TN_OP_SUM:
        run_sum(vm, top, first, second, reversed, words);
        break;
    case TN_OP_OCCURRENCES:
        run_occurrences(vm, top, first, words);
        break;
    case TN_OP_DISTANCE:
    case TN_OP_NEAR:
    case TN_OP_FAR:
        run_gaps(vm, op->opcode, top, words);
        break;
    default: /* verifying has refused anything else */
        break;
    }
}

void tn_plan_vm_operate(tn_plan_vm *vm, const tn_instruction *op, uint64_t *top, bool reversed)
{
    if (vm->words == 1)
        run_operation(vm, op, top, reversed, 1);
    else
        run_operation(vm, op, top, reversed, vm->words);
}
