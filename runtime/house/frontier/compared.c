/* What clauses compare with 0: numbers that are added up along the row, and of which only the end says what they are,
 * unless nothing that is ahead can change their sign.
 *
 * A state has the number of its totals, one for each compared number, in its steps. At the end of the row they say
 * which comparisons hold: to a clause that is a part of the last letter's value. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/frontier/parts.h"

enum { TOTAL_WORDS = sizeof(tn_int128) / sizeof(uint32_t) };

static uint32_t compared_count(const tn_strip *strip)
{
    return strip->added->count - strip->added->measures;
}

uint32_t tn_strip_compared(const tn_strip *strip, uint32_t sum)
{
    uint32_t k = strip->added->measures;
    while (strip->added->sums[k] != sum)
        k++;
    return k;
}

/* ---- the plan's part */

/* value := what the number is of a plan of one tray, or (TN_STRIP_NONE) of none. */
static tn_status value_of_plan(tn_strip *strip, uint32_t number, tn_tray tray, mpq_t value, tn_error *error)
{
    tn_status status = strip->plan_vm ? TN_OK : tn_plan_vm_new(strip->form->schema, 1, &strip->plan_vm, error);
    if (status == TN_OK)
        status = tn_plan_vm_plan(strip->plan_vm, &tray, tray != TN_STRIP_NONE, error);
    bool has; /* what is added up of a house always has a value */
    return status == TN_OK ? tn_plan_vm_value(strip->plan_vm, strip->added->of[number]->of.sum, value, &has, error)
                           : status;
}

tn_status tn_strip_tray_adds(tn_strip *strip, uint32_t number, tn_tray tray, int64_t *steps, tn_error *error)
{
    tn_int128 wide = 0;
    mpq_t value, constant;
    mpq_inits(value, constant, NULL);
    tn_status status = value_of_plan(strip, number, tray, value, error);
    if (status == TN_OK)
        status = value_of_plan(strip, number, TN_STRIP_NONE, constant, error);
    mpq_sub(value, value, constant);
    if (status == TN_OK && (!tn_steps_of(value, strip->added->of[number]->unit, &wide) || wide >> 45 != wide >> 127))
        status = tn_too_fine(error);
    *steps = (int64_t)wide;
    mpq_clears(value, constant, NULL);
    return status;
}

static bool holds(tn_opcode opcode, int sign)
{
    return opcode == TN_OP_HOUSE_BELOW ? sign < 0 : opcode == TN_OP_HOUSE_ZERO ? sign == 0 : sign > 0;
}

tn_status tn_strip_empty_meets(tn_strip *strip, const tn_instruction *op, bool *meets, tn_error *error)
{
    mpq_t value;
    mpq_init(value);
    tn_status status = value_of_plan(strip, tn_strip_compared(strip, (uint32_t)op->first), TN_STRIP_NONE, value, error);
    *meets = holds(op->opcode, mpq_sgn(value));
    mpq_clear(value);
    return status;
}

/* ---- totals */

static tn_status number_totals(tn_strip *strip, const tn_int128 *totals, uint32_t *number, tn_error *error)
{
    uint32_t words[TN_COMPARED_MAX * TOTAL_WORDS], count = compared_count(strip);
    memcpy(words, totals, count * sizeof *totals);
    *number = tn_intern(&strip->totals, words, (size_t)count * TOTAL_WORDS);
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static void read_totals(const tn_strip *strip, uint32_t number, tn_int128 *totals)
{
    size_t words;
    const uint32_t *of = tn_interned(&strip->totals, number, &words);
    memcpy(totals, of, words * sizeof *of);
}

tn_status tn_strip_first_total(tn_strip *strip, uint32_t *total, tn_error *error)
{
    tn_int128 totals[TN_COMPARED_MAX];
    tn_status status = TN_OK;
    mpq_t value;
    mpq_init(value);
    for (uint32_t i = 0; status == TN_OK && i < compared_count(strip); i++) {
        uint32_t number = strip->added->measures + i;
        status = value_of_plan(strip, number, TN_STRIP_NONE, value, error);
        if (status == TN_OK && !tn_steps_of(value, strip->units->measures[number], &totals[i]))
            status = tn_too_fine(error);
    }
    mpq_clear(value);
    return status == TN_OK ? number_totals(strip, totals, total, error) : status;
}

/* Below and above all that can be added up (are_small in runtime/house/count/units.c). */
#define SURELY_BELOW (-((tn_int128)1 << 126))
#define SURELY_ABOVE ((tn_int128)1 << 126)

static tn_int128 settle(const tn_strip *strip, uint32_t trays, uint32_t compared, tn_int128 total)
{
    const tn_strip_range *ahead = &strip->ahead[trays].all[compared];
    if (!ahead->any)
        return total;
    return total + ahead->from > 0 ? SURELY_ABOVE : total + ahead->to < 0 ? SURELY_BELOW : total;
}

tn_status tn_strip_next_total(tn_strip *strip, uint32_t trays, uint32_t total, const tn_int128 *gains, uint32_t *next,
                              tn_error *error)
{
    tn_int128 totals[TN_COMPARED_MAX];
    read_totals(strip, total, totals);
    for (uint32_t i = 0; i < compared_count(strip); i++)
        if (totals[i] != SURELY_BELOW && totals[i] != SURELY_ABOVE)
            totals[i] = settle(strip, trays, i, totals[i] + gains[i]);
    return number_totals(strip, totals, next, error);
}

/* ---- what is ahead */

tn_status tn_strip_ahead_begin(tn_strip *strip, tn_error *error)
{
    strip->ahead = calloc((size_t)strip->trays_most + 2, sizeof *strip->ahead);
    strip->looking_ahead = true;
    return strip->ahead ? TN_OK : tn_fail_memory(error);
}

static void widen(tn_strip_range *range, tn_int128 from, tn_int128 to)
{
    range->from = range->any && range->from < from ? range->from : from;
    range->to = range->any && range->to > to ? range->to : to;
    range->any = true;
}

void tn_strip_ahead_note(tn_strip *strip, uint32_t trays, bool end, uint32_t compared, tn_int128 from, tn_int128 to)
{
    tn_strip_ahead *ahead = &strip->ahead[trays];
    widen(&(end ? ahead->end : ahead->tray)[compared], from, to);
}

void tn_strip_ahead_end(tn_strip *strip)
{
    strip->looking_ahead = false;
    for (uint32_t k = strip->trays_most + 1; k-- > 0;)
        for (uint32_t i = 0; i < compared_count(strip); i++) {
            tn_strip_ahead *here = &strip->ahead[k];
            const tn_strip_range *next = &here[1].all[i];
            if (here->end[i].any)
                widen(&here->all[i], here->end[i].from, here->end[i].to);
            if (here->tray[i].any && next->any)
                widen(&here->all[i], here->tray[i].from + next->from, here->tray[i].to + next->to);
        }
    tn_strip_forget_states(strip);
}

/* ---- the end of the row */

uint32_t tn_strip_guesses(const tn_strip *strip)
{
    uint32_t guesses = 1; /* each number is below, at or above 0 */
    for (uint32_t i = 0; i < compared_count(strip); i++)
        guesses *= 3;
    return guesses;
}

/* What the clause's value is with the truth of its comparisons; signs: of each compared number. */
static uint32_t with_truths(const tn_strip *strip, const tn_strip_clause *clause, uint32_t value, const int *signs)
{
    uint32_t place = 1;
    for (size_t i = 0; i < clause->atom_count; i++) {
        const tn_strip_atom *atom = &clause->atoms[i];
        if (tn_code_compares_house(atom->op.opcode))
            value += place * (holds(atom->op.opcode, signs[atom->of - strip->added->measures]) ? TRUTH_YES : TRUTH_NO);
        place *= atom->radix;
    }
    return value;
}

tn_status tn_strip_end_values(tn_strip *strip, uint32_t values, uint32_t total, uint32_t guess, uint32_t *ends,
                              tn_error *error)
{
    int signs[TN_COMPARED_MAX];
    tn_int128 totals[TN_COMPARED_MAX];
    size_t size;
    bool ok = true;
    bool known = strip->units && !strip->looking_ahead;
    if (known)
        read_totals(strip, total, totals);
    for (uint32_t i = 0; i < compared_count(strip); i++, guess /= 3)
        signs[i] = known ? (totals[i] > 0) - (totals[i] < 0) : (int)(guess % 3) - 1;
    strip->key.size = 0;
    for (uint32_t i = 0; ok && i < strip->clause_count; i++)
        ok = tn_key_push(&strip->key,
                         with_truths(strip, &strip->clauses[i], tn_interned(&strip->values, values, &size)[i], signs));
    *ends = ok ? tn_intern(&strip->values, strip->key.data, strip->key.size) : UINT32_MAX;
    return *ends != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}
