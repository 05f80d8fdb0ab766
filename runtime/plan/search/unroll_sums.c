/* Counts and sums on stretches, as gates. */
#include "runtime/plan/search/unroll_data.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/condition.h"

void tn_unroll_clear_sums(tn_unrolled *u)
{
    for (size_t i = 0; i < u->count_count; i++) {
        free(u->counts[i].lengths);
        tn_tray_counts_clear(&u->counts[i].counts);
        free(u->counts[i].gates);
    }
    for (size_t i = 0; u->sums && i < u->module->SUM_count; i++)
        tn_sum_free(u->sums[i]);
    free(u->counts);
    free(u->sums);
    free(u->choices);
    tn_adder_clear(&u->adder);
}

tn_status tn_unroll_summed(tn_unrolled *u, uint32_t index, const tn_sum **sum, tn_error *error)
{
    if (!u->sums && !(u->sums = calloc(u->module->SUM_count + 1, sizeof(tn_sum *))))
        return tn_fail_memory(error);
    tn_status status = u->sums[index] ? TN_OK : tn_sum_new(u->schema, index, &u->sums[index], error);
    *sum = u->sums[index];
    return status;
}

/* ---- what trays count */

/* Makes it for every place. */
static tn_status make_counts(tn_unrolled *u, unroll_counts *made, const int64_t *of_tray, tn_error *error)
{
    tn_status status = tn_tray_counts_make(&made->counts, u->schema, of_tray, error);
    size_t room = tn_size_of(u->length, made->counts.count);
    if (status == TN_OK && !(made->gates = tn_array_new((uint64_t)room + 1, sizeof *made->gates)))
        status = tn_fail_memory(error);
    for (uint32_t k = 0; status == TN_OK && k < u->length; k++)
        status = tn_letters_count(u->letters, k, &made->counts, made->gates + (size_t)k * made->counts.count, error);
    return status;
}

static unroll_counts *add_counts(tn_unrolled *u)
{
    if (!tn_array_reserve(&u->counts, &u->count_capacity, u->count_count, 1, sizeof *u->counts))
        return NULL;
    unroll_counts *made = &u->counts[u->count_count++];
    *made = (unroll_counts){.field = UINT32_MAX};
    return made;
}

/* Of a function of trays that lives as long as `u`. */
static tn_status find_counts(tn_unrolled *u, const int64_t *of_tray, const unroll_counts **found, tn_error *error)
{
    for (size_t i = 0; i < u->count_count; i++)
        if (u->counts[i].of_tray == of_tray) {
            *found = &u->counts[i];
            return TN_OK;
        }
    unroll_counts *made = add_counts(u);
    if (!made)
        return tn_fail_memory(error);
    made->of_tray = of_tray;
    *found = made;
    return make_counts(u, made, of_tray, error);
}

/* Of the lengths of a field. */
static tn_status find_lengths(tn_unrolled *u, uint32_t field, const unroll_counts **found, tn_error *error)
{
    for (size_t i = 0; i < u->count_count; i++)
        if (u->counts[i].field == field) {
            *found = &u->counts[i];
            return TN_OK;
        }
    tn_status status = tn_schema_listed(u->schema, "searching plans by sums goes", error);
    if (status != TN_OK)
        return status;
    unroll_counts *made = add_counts(u);
    if (!made || !(made->lengths = tn_array_new((uint64_t)u->schema->tray_count + 1, sizeof *made->lengths)))
        return tn_fail_memory(error);
    for (tn_tray t = 0; t < u->schema->tray_count; t++)
        made->lengths[t] = tn_tray_value_record(u->schema, t, field)->length;
    made->field = field;
    *found = made;
    return make_counts(u, made, made->lengths, error);
}

/* A step: what the tray at a place counts, if the gate is true. */
static tn_status add_weighed(tn_unrolled *u, tn_adder *adder, tn_signal gate, const unroll_counts *counts,
                             uint32_t place, tn_error *error)
{
    uint32_t count = counts->counts.count;
    if (!tn_array_reserve(&u->choices, &u->choice_capacity, 0, count, sizeof *u->choices))
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        u->choices[i] = (tn_adder_choice){counts->counts.counts[i], counts->gates[(size_t)place * count + i]};
    return tn_adder_add_one_of(adder, gate, u->choices, count, error);
}

static uint32_t place_of(const tn_unrolled *u, bool reversed, uint32_t k)
{
    return reversed ? u->length - 1 - k : k;
}

/* ---- terms of sums */

/* That a match starts at k and ends at `last` or before. */
static tn_signal starts(tn_unrolled *u, const tn_symbolic *relation, uint32_t k, uint32_t last)
{
    size_t some = 0;
    for (uint32_t e = k + 1; e <= last; e++)
        u->gates[some++] = tn_symbolic_at(u, relation, k, e);
    return tn_circuit_any(u->circuit, u->gates, some);
}

/* What a term counts from place `first` to place `last`. */
static tn_status add_places(tn_unrolled *u, tn_adder *adder, const tn_sum_term *term, bool reversed, uint32_t first,
                            uint32_t last, tn_error *error)
{
    const tn_symbolic *relation = tn_unroll_known(u, term->part, reversed);
    const unroll_counts *counts = NULL;
    tn_status status = term->weight ? find_counts(u, term->weight, &counts, error) : TN_OK;
    for (uint32_t k = first; status == TN_OK && k < last; k++) {
        tn_signal gate =
            term->kind == TN_SUM_SINGLES ? tn_symbolic_at(u, relation, k, k + 1) : starts(u, relation, k, last);
        status = counts ? add_weighed(u, adder, gate, counts, place_of(u, reversed, k), error)
                        : tn_adder_add(adder, gate, term->each, error);
    }
    return status;
}

static tn_status add_present(tn_unrolled *u, tn_adder *adder, const tn_sum_term *term, bool reversed, uint32_t first,
                             uint32_t last, tn_error *error)
{
    const tn_symbolic *relation = tn_unroll_known(u, term->part, reversed);
    size_t some = 0;
    for (uint32_t k = first; k < last; k++)
        u->gates[some++] = tn_symbolic_at(u, relation, k, k + 1);
    return tn_adder_add(adder, tn_circuit_any(u->circuit, u->gates, some), term->each, error);
}

/* What a term counts for the stretch [i, j). */
static tn_status add_term(tn_unrolled *u, tn_adder *adder, const tn_sum_term *term, bool reversed, uint32_t i,
                          uint32_t j, tn_error *error)
{
    uint32_t first = i, last = j;
    if (term->region == TN_REGION_BEFORE) {
        first = 0;
        last = i;
    } else if (term->region == TN_REGION_AFTER) {
        first = j;
        last = u->length;
    }
    return (term->kind == TN_SUM_PRESENT ? add_present : add_places)(u, adder, term, reversed, first, last, error);
}

/* ---- comparisons of sums */

static bool compares(tn_opcode opcode, int64_t value)
{
    return opcode == TN_OP_BELOW ? value < 0 : opcode == TN_OP_ABOVE ? value > 0 : value == 0;
}

/* BELOW and ABOVE are so of all numbers between two of which they are, and ZERO of one. */
static tn_adder_outcome judge_sign(const void *context, int64_t low, int64_t high)
{
    tn_opcode opcode = *(const tn_opcode *)context;
    bool least = compares(opcode, low), most = compares(opcode, high);
    if (low == high || (opcode != TN_OP_ZERO && least == most))
        return least ? TN_ADDER_YES : TN_ADDER_NO;
    return opcode == TN_OP_ZERO && (low > 0 || high < 0) ? TN_ADDER_NO : TN_ADDER_SOME;
}

/* Remainders are 0 or not at the end alone. */
static tn_adder_outcome judge_remainder(const void *context, int64_t low, int64_t high)
{
    int64_t modulus = *(const int64_t *)context;
    if (low != high)
        return TN_ADDER_SOME;
    return low % modulus == 0 ? TN_ADDER_YES : TN_ADDER_NO;
}

static tn_status compare_stretch(tn_unrolled *u, const tn_instruction *op, const tn_sum *sum, bool reversed, uint32_t i,
                                 uint32_t j, tn_signal *gate, tn_error *error)
{
    tn_status status = TN_OK;
    tn_adder_begin(&u->adder);
    for (uint32_t t = 0; status == TN_OK && t < sum->count; t++)
        status = add_term(u, &u->adder, &sum->terms[t], reversed, i, j, error);
    if (status != TN_OK)
        return status;
    if (op->opcode == TN_OP_MULTIPLE) {
        int64_t modulus = tn_sum_modulus(sum, op->second);
        return tn_adder_test(&u->adder, sum->constant, modulus, judge_remainder, &modulus, gate, error);
    }
    return tn_adder_test(&u->adder, sum->constant, 0, judge_sign, &op->opcode, gate, error);
}

tn_status tn_unroll_compare(tn_unrolled *u, const tn_instruction *op, const tn_sum *sum, bool reversed,
                            tn_symbolic *out, tn_error *error)
{
    if (out->plain)
        return compare_stretch(u, op, sum, reversed, 0, u->length, out->cells, error);
    tn_status status = TN_OK;
    for (uint32_t i = 0; i <= u->length; i++)
        for (uint32_t j = i; status == TN_OK && j <= u->length; j++)
            status = compare_stretch(u, op, sum, reversed, i, j, &out->cells[u->row[i] + j], error);
    return status;
}

/* ---- conditions on counts */

typedef struct count_wanted {
    const tn_unrolled *u;
    uint32_t condition;
} count_wanted;

/* truths has E of every number of places. */
static tn_adder_outcome judge_count(const void *context, int64_t low, int64_t high)
{
    const tn_unrolled *u = ((const count_wanted *)context)->u;
    for (int64_t n = low + 1; n <= high; n++)
        if (u->truths[n] != u->truths[low])
            return TN_ADDER_SOME;
    return u->truths[low] ? TN_ADDER_YES : TN_ADDER_NO;
}

static tn_adder_outcome judge_length(const void *context, int64_t low, int64_t high)
{
    const count_wanted *wanted = context;
    if (low != high)
        return TN_ADDER_SOME;
    return tn_condition_holds(wanted->u->module, wanted->condition, low) ? TN_ADDER_YES : TN_ADDER_NO;
}

/* What place k of [i, j) counts. */
static tn_status add_place(tn_unrolled *u, const tn_instruction *op, bool reversed, const tn_symbolic *in,
                           const unroll_counts *lengths, uint32_t k, uint32_t j, tn_error *error)
{
    if (lengths)
        return add_weighed(u, &u->adder, tn_symbolic_at(u, in, k, k + 1), lengths, place_of(u, reversed, k), error);
    tn_signal gate = op->opcode == TN_OP_QUANTITY ? tn_symbolic_at(u, in, k, k + 1) : starts(u, in, k, j);
    return tn_adder_add(&u->adder, gate, 1, error);
}

static tn_status count_stretch(tn_unrolled *u, const tn_instruction *op, bool reversed, const tn_symbolic *in,
                               const unroll_counts *lengths, uint32_t i, uint32_t j, tn_signal *gate, tn_error *error)
{
    const count_wanted wanted = {u, (uint32_t)(lengths ? op->second : op->first)};
    tn_status status = TN_OK;
    tn_adder_begin(&u->adder);
    for (uint32_t k = i; status == TN_OK && k < j; k++)
        status = add_place(u, op, reversed, in, lengths, k, j, error);
    return status == TN_OK ? tn_adder_test(&u->adder, 0, 0, lengths ? judge_length : judge_count, &wanted, gate, error)
                           : status;
}

tn_status tn_unroll_count(tn_unrolled *u, const tn_instruction *op, bool reversed, const tn_symbolic *in,
                          tn_symbolic *out, tn_error *error)
{
    const unroll_counts *lengths = NULL;
    tn_status status = TN_OK;
    if (op->opcode == TN_OP_SUM)
        status = find_lengths(u, (uint32_t)op->first - (uint32_t)u->schema->record->field_first, &lengths, error);
    else
        for (uint32_t n = 0; n <= u->length; n++)
            u->truths[n] = tn_condition_holds(u->module, (uint32_t)op->first, n);
    if (status == TN_OK && out->plain)
        return count_stretch(u, op, reversed, in, lengths, 0, u->length, out->cells, error);
    for (uint32_t i = 0; status == TN_OK && i <= u->length; i++)
        for (uint32_t j = i; status == TN_OK && j <= u->length; j++)
            status = count_stretch(u, op, reversed, in, lengths, i, j, &out->cells[u->row[i] + j], error);
    return status;
}

/* ---- values */

/* Of a term that is asked of whole plans. */
static tn_status add_whole(tn_unrolled *u, tn_adder *adder, const tn_sum_term *term, tn_signal *has, tn_error *error)
{
    tn_signal in = tn_symbolic_at(u, tn_unroll_known(u, term->part, false), 0, u->length);
    if (term->kind == TN_SUM_MATCHES)
        return tn_adder_add(adder, in, term->each, error);
    *has = tn_circuit_and(u->circuit, *has, in);
    return TN_OK;
}

tn_status tn_unroll_values(tn_unrolled *u, const tn_sum *sum, tn_adder *adder, tn_signal *has, tn_error *error)
{
    tn_status status = TN_OK;
    *has = TN_SIGNAL_TRUE;
    tn_adder_begin(adder);
    for (uint32_t t = 0; status == TN_OK && t < sum->count; t++) {
        const tn_sum_term *term = &sum->terms[t];
        if (term->kind == TN_SUM_MATCHES || term->kind == TN_SUM_NEEDED)
            status = add_whole(u, adder, term, has, error);
        else
            status = add_term(u, adder, term, false, 0, u->length, error);
    }
    return status == TN_OK ? tn_adder_sums(adder, sum->constant, error) : status;
}
