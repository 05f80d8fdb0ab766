/* What the clauses have read of a row, and which completions of it they would keep.
 *
 * ==== completions of a clause's states
 *
 * A completion of a row is what can follow it up to the end; a row has a least and a most number of trays. After a
 * given number of trays, states of a clause that keep the same completions are merged, and a state that keeps none ends
 * the row at once, even if a longer row than is allowed could be kept. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"
#include "runtime/plan/match/vm.h"

/* ---- states */

/* Which completions a state keeps after so many letters; next: the same after one letter more, or NULL. *any: does it
 * keep any? */
static bool describe(const tn_frontier_clause *clause, uint32_t state, bool last, const uint32_t *next, tn_key *key,
                     bool *any)
{
    const tn_dfa *dfa = clause->dfa;
    bool accepts = last && dfa->accept[state];
    key->size = 0;
    bool ok = tn_key_push(key, accepts);
    *any = accepts;
    for (uint32_t c = 0; ok && next && c < dfa->columns; c++) {
        uint32_t to = next[dfa->delta[(size_t)state * dfa->columns + c]];
        *any = *any || to != TN_NO_STATE;
        ok = tn_key_push(key, to);
    }
    return ok;
}

static uint32_t *merge_states(const tn_frontier_clause *clause, bool last, const uint32_t *next, tn_key *key)
{
    uint32_t states = clause->dfa->states;
    uint32_t *alike = malloc(((size_t)states + 1) * sizeof *alike),
             *first = malloc(((size_t)states + 1) * sizeof *first);
    tn_interner classes = {0};
    bool ok = alike && first;
    for (uint32_t s = 0; ok && s < states; s++) {
        uint32_t before = classes.count;
        bool any;
        ok = describe(clause, s, last, next, key, &any);
        uint32_t class = ok ? tn_intern(&classes, key->data, key->size) : UINT32_MAX;
        ok = class != UINT32_MAX;
        if (ok && class == before)
            first[class] = any ? s : TN_NO_STATE;
        if (ok)
            alike[s] = first[class];
    }
    tn_interner_clear(&classes);
    free(first);
    if (ok)
        return alike;
    free(alike);
    return NULL;
}

/* Far from the end of the row nothing changes any more: such numbers of letters share what is known. */
static bool merge_clause(const tn_frontier *frontier, tn_frontier_clause *clause, tn_key *key)
{
    uint32_t most = frontier->trays_most, least = frontier->trays_least;
    clause->completions = calloc((size_t)most + 1, sizeof *clause->completions);
    if (!clause->completions)
        return false;
    for (uint32_t k = most + 1; k-- > 0;) {
        tn_frontier_completions *here = &clause->completions[k], *next = k < most ? here + 1 : NULL;
        bool settled = k + 2 <= most && here[1].alike == here[2].alike && (k >= least) == (k + 1 >= least);
        here->alike = settled ? next->alike : merge_states(clause, k >= least, next ? next->alike : NULL, key);
        if (!here->alike)
            return false;
        if (!settled && next && (k >= least) == (k + 1 >= least) &&
            memcmp(here->alike, next->alike, clause->dfa->states * sizeof *here->alike) == 0) {
            free(here->alike);
            here->alike = next->alike;
        }
    }
    return true;
}

tn_status tn_frontier_find_completions(tn_frontier *frontier, tn_error *error)
{
    for (uint32_t i = 0; i < frontier->clause_count; i++)
        if (!merge_clause(frontier, &frontier->clauses[i], &frontier->key))
            return tn_fail_memory(error);
    return TN_OK;
}

void tn_frontier_completions_free(const tn_frontier *frontier, tn_frontier_clause *clause)
{
    for (uint32_t k = 0; clause->completions && k <= frontier->trays_most; k++) {
        tn_frontier_completions *here = &clause->completions[k];
        if (k == frontier->trays_most || here->alike != here[1].alike)
            free(here->alike);
        tn_numbering_clear(&here->pairs);
        tn_interner_clear(&here->classes);
        free(here->of_pair);
        free(here->first);
    }
    free(clause->completions);
}

/* ---- letters of which a part is not known yet */

/* Where each value of the letter leads, and the first pair that leads there. */
static uint64_t merge_pair(tn_frontier *frontier, tn_frontier_clause *clause, tn_frontier_completions *completions,
                           uint32_t state, uint32_t base, bool *ok)
{
    bool any = false;
    uint32_t before = completions->classes.count;
    frontier->key.size = 0;
    for (uint32_t v = 0; *ok && v < clause->radix; v++) {
        uint32_t to = completions->alike[tn_dfa_read(clause->dfa, state, base * clause->radix + v)];
        any = any || to != TN_NO_STATE;
        *ok = tn_key_push(&frontier->key, to);
    }
    uint32_t class = *ok ? tn_intern(&completions->classes, frontier->key.data, frontier->key.size) : UINT32_MAX;
    *ok = class != UINT32_MAX &&
          tn_array_reserve(&completions->first, &completions->first_room, before, 1, sizeof *completions->first);
    if (*ok && class == before)
        completions->first[class] = any ? (uint64_t)state << 32 | base : TN_FRONTIER_NO_PAIR;
    return *ok ? completions->first[class] : 0;
}

tn_status tn_frontier_pair(tn_frontier *frontier, tn_frontier_clause *clause, uint32_t trays, uint32_t state,
                           uint32_t base, uint64_t *pair, tn_error *error)
{
    tn_frontier_completions *completions = &clause->completions[trays];
    uint32_t before = completions->pairs.count;
    if (!tn_array_reserve(&completions->of_pair, &completions->pair_room, before, 1, sizeof *completions->of_pair))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&completions->pairs, (uint64_t)state << 32 | base);
    bool ok = at != UINT32_MAX;
    if (ok && at == before)
        completions->of_pair[at] = merge_pair(frontier, clause, completions, state, base, &ok);
    *pair = ok ? completions->of_pair[at] : 0;
    return ok ? TN_OK : tn_fail_memory(error);
}

/* ==== reading
 *
 * What the clauses have read so far, as one number, and how it goes on: each combination is worked out once.
 *
 * At an interface clauses read in two steps. First the slice at its right, for clauses whose letters a slice knows by
 * itself. Then the interface, for the other clauses: it completes the letter of the slice at its left, which was
 * pending. */

/* Words of what has been read: the state of each clause, then the base of each clause's pending letter (0: none is).
 * Words between the two steps: where in the row, the states, the bases that were pending, those that are pending from
 * now on. */
enum { AT_BEGIN, AT_PLANE, AT_END };
enum { BETWEEN_WHERE, BETWEEN_STATES };

tn_status tn_frontier_known_at(tn_frontier_known *known, uint32_t first, uint32_t second, size_t words,
                               uint32_t **result, bool *met, tn_error *error)
{
    uint32_t before = known->pairs.count;
    if (!tn_array_reserve(&known->results, &known->room, before * words, words, sizeof *known->results))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&known->pairs, (uint64_t)first << 32 | second);
    *result = &known->results[at == UINT32_MAX ? 0 : at * words];
    *met = at < before;
    return at == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

void tn_frontier_known_clear(tn_frontier_known *known)
{
    tn_numbering_clear(&known->pairs);
    free(known->results);
}

/* Reads a letter, of `letters` so far. Does the clause keep a completion then? */
static bool read_letter(const tn_frontier_clause *clause, uint32_t letter, uint32_t letters, bool last, uint32_t *state)
{
    *state = tn_dfa_read(clause->dfa, *state, letter);
    if (last)
        return clause->dfa->accept[*state];
    *state = clause->completions[letters].alike[*state];
    return *state != TN_NO_STATE;
}

/* ---- the slice by itself */

/* frontier->key := what is between the two steps. *keeps: does each clause keep a completion? */
static bool read_slice(tn_frontier *frontier, uint32_t trays, uint32_t read, const uint32_t *bases, bool *keeps)
{
    size_t size;
    uint32_t count = frontier->clause_count;
    const uint32_t *before = read == TN_FRONTIER_NONE ? NULL : tn_interned(&frontier->reading.readings, read, &size);
    tn_key *key = &frontier->key;
    key->size = 0;
    bool ok = tn_key_push(key, !before ? AT_BEGIN : bases ? AT_PLANE : AT_END);
    *keeps = true;
    for (uint32_t i = 0; ok && *keeps && i < count; i++) {
        const tn_frontier_clause *clause = &frontier->clauses[i];
        uint32_t state = before ? before[i] : 0;
        if (clause->radix == 1)
            *keeps = bases ? read_letter(clause, bases[i], trays + 1, false, &state) : clause->dfa->accept[state];
        ok = tn_key_push(key, state);
    }
    for (uint32_t i = 0; ok && *keeps && i < count; i++)
        ok = tn_key_push(key, before ? before[count + i] : 0);
    for (uint32_t i = 0; ok && *keeps && i < count; i++)
        ok = tn_key_push(key, bases && frontier->clauses[i].radix > 1 ? bases[i] : 0);
    return ok;
}

tn_status tn_frontier_read_slice(tn_frontier *frontier, uint32_t trays, uint32_t read, uint32_t slice,
                                 uint32_t *between, tn_error *error)
{
    uint32_t *result, number = slice == TN_FRONTIER_NONE ? slice : frontier->slices.items[slice].bases;
    bool met, keeps;
    tn_status status =
        tn_frontier_known_at(&frontier->reading.after_slice[trays], read, number, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        size_t size;
        const uint32_t *bases = slice == TN_FRONTIER_NONE ? NULL : tn_interned(&frontier->slices.bases, number, &size);
        bool ok = read_slice(frontier, trays, read, bases, &keeps);
        *result = ok && keeps ? tn_intern(&frontier->reading.between, frontier->key.data, frontier->key.size)
                              : TN_FRONTIER_NONE;
        if (!ok || (keeps && *result == UINT32_MAX))
            return tn_fail_memory(error);
    }
    *between = status == TN_OK ? *result : TN_FRONTIER_NONE;
    return status;
}

/* ---- the interface */

/* Merges what the clause cannot tell apart, now that the slice's letter is pending. */
static tn_status merge_pending(tn_frontier *frontier, uint32_t clause, uint32_t trays, uint32_t *state, uint32_t *base,
                               bool *keeps, tn_error *error)
{
    uint64_t pair;
    if (frontier->clauses[clause].radix == 1)
        return TN_OK;
    tn_status status = tn_frontier_pair(frontier, &frontier->clauses[clause], trays, *state, *base, &pair, error);
    *keeps = status == TN_OK && pair != TN_FRONTIER_NO_PAIR;
    *state = tn_high(pair);
    *base = tn_low(pair);
    return status;
}

/* frontier->scratch := the states, then the bases. */
static tn_status read_interface(tn_frontier *frontier, uint32_t trays, const uint32_t *between, const uint32_t *values,
                                bool *keeps, tn_error *error)
{
    uint32_t count = frontier->clause_count, where = between[BETWEEN_WHERE];
    uint32_t *states = frontier->reading.scratch, *bases = states + count;
    const uint32_t *last_bases = between + BETWEEN_STATES + count;
    tn_status status = TN_OK;
    memcpy(states, between + BETWEEN_STATES, count * sizeof *states);
    memcpy(bases, last_bases + count, count * sizeof *bases);
    *keeps = true;
    for (uint32_t i = 0; status == TN_OK && *keeps && i < count; i++) {
        const tn_frontier_clause *clause = &frontier->clauses[i];
        if (clause->radix > 1 && where != AT_BEGIN)
            *keeps = read_letter(clause, last_bases[i] * clause->radix + values[i], trays, where == AT_END, &states[i]);
        if (*keeps && where != AT_END)
            status = merge_pending(frontier, i, trays + 1, &states[i], &bases[i], keeps, error);
    }
    return status;
}

tn_status tn_frontier_read_interface(tn_frontier *frontier, uint32_t trays, uint32_t between, uint32_t values,
                                     uint32_t *read, tn_error *error)
{
    uint32_t *result;
    bool met, keeps;
    tn_status status =
        tn_frontier_known_at(&frontier->reading.after_interface[trays], between, values, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        size_t size;
        const uint32_t *words =
            values == TN_FRONTIER_NONE ? NULL : tn_interned(&frontier->reading.values, values, &size);
        status = read_interface(frontier, trays, tn_interned(&frontier->reading.between, between, &size), words, &keeps,
                                error);
        *result = TN_FRONTIER_NONE;
        if (status == TN_OK && keeps) {
            *result =
                tn_intern(&frontier->reading.readings, frontier->reading.scratch, 2 * (size_t)frontier->clause_count);
            status = *result == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
        }
    }
    *read = status == TN_OK ? *result : TN_FRONTIER_NONE;
    return status;
}

void tn_frontier_reading_clear(tn_frontier_reading *reading, uint32_t trays_most)
{
    for (uint32_t k = 0; reading->after_slice && reading->after_interface && k <= trays_most; k++) {
        tn_frontier_known_clear(&reading->after_slice[k]);
        tn_frontier_known_clear(&reading->after_interface[k]);
    }
    free(reading->after_slice);
    free(reading->after_interface);
    tn_interner_clear(&reading->readings);
    tn_interner_clear(&reading->between);
    tn_interner_clear(&reading->values);
    free(reading->scratch);
}

/* ==== comparisons
 *
 * What clauses compare with 0: numbers that are added up along the row. Their values are known only at its end, but
 * their signs earlier if no completion can change them.
 *
 * A state has the number of its totals, one for each compared number, in its steps. At the end of the row they say
 * which comparisons hold: to a clause that is a part of the last letter's value. */

enum { TOTAL_WORDS = sizeof(tn_int128) / sizeof(uint32_t) };

static uint32_t compared_count(const tn_frontier *frontier)
{
    return frontier->added->count - frontier->added->measures;
}

uint32_t tn_frontier_compared(const tn_frontier *frontier, uint32_t sum)
{
    uint32_t k = frontier->added->measures;
    while (frontier->added->sums[k] != sum)
        k++;
    return k;
}

/* ---- the plan's part */

/* value := what the number is of a plan of one tray, or (TN_FRONTIER_NONE) of none. */
static tn_status value_of_plan(tn_frontier *frontier, uint32_t number, tn_tray tray, mpq_t value, tn_error *error)
{
    tn_status status = frontier->compared.plan_vm
                           ? TN_OK
                           : tn_plan_vm_new(frontier->form->schema, 1, &frontier->compared.plan_vm, error);
    if (status == TN_OK)
        status = tn_plan_vm_plan(frontier->compared.plan_vm, &tray, tray != TN_FRONTIER_NONE, error);
    bool has; /* what is added up of a house always has a value */
    return status == TN_OK
               ? tn_plan_vm_value(frontier->compared.plan_vm, frontier->added->of[number]->of.sum, value, &has, error)
               : status;
}

tn_status tn_frontier_tray_adds(tn_frontier *frontier, uint32_t number, tn_tray tray, int64_t *steps, tn_error *error)
{
    tn_int128 wide = 0;
    mpq_t value, constant;
    mpq_inits(value, constant, NULL);
    tn_status status = value_of_plan(frontier, number, tray, value, error);
    if (status == TN_OK)
        status = value_of_plan(frontier, number, TN_FRONTIER_NONE, constant, error);
    mpq_sub(value, value, constant);
    if (status == TN_OK && (!tn_steps_of(value, frontier->added->of[number]->unit, &wide) || wide >> 45 != wide >> 127))
        status = tn_too_fine(error);
    *steps = (int64_t)wide;
    mpq_clears(value, constant, NULL);
    return status;
}

static bool holds(tn_opcode opcode, int sign)
{
    return opcode == TN_OP_HOUSE_BELOW ? sign < 0 : opcode == TN_OP_HOUSE_ZERO ? sign == 0 : sign > 0;
}

tn_status tn_frontier_empty_meets(tn_frontier *frontier, const tn_instruction *op, bool *meets, tn_error *error)
{
    mpq_t value;
    mpq_init(value);
    tn_status status =
        value_of_plan(frontier, tn_frontier_compared(frontier, (uint32_t)op->first), TN_FRONTIER_NONE, value, error);
    *meets = holds(op->opcode, mpq_sgn(value));
    mpq_clear(value);
    return status;
}

/* ---- totals */

static tn_status number_totals(tn_frontier *frontier, const tn_int128 *totals, uint32_t *number, tn_error *error)
{
    uint32_t words[TN_COMPARED_MAX * TOTAL_WORDS], count = compared_count(frontier);
    memcpy(words, totals, count * sizeof *totals);
    *number = tn_intern(&frontier->compared.totals, words, (size_t)count * TOTAL_WORDS);
    return *number != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static void read_totals(const tn_frontier *frontier, uint32_t number, tn_int128 *totals)
{
    size_t words;
    const uint32_t *of = tn_interned(&frontier->compared.totals, number, &words);
    memcpy(totals, of, words * sizeof *of);
}

tn_status tn_frontier_first_total(tn_frontier *frontier, uint32_t *total, tn_error *error)
{
    tn_int128 totals[TN_COMPARED_MAX];
    tn_status status = TN_OK;
    mpq_t value;
    mpq_init(value);
    for (uint32_t i = 0; status == TN_OK && i < compared_count(frontier); i++) {
        uint32_t number = frontier->added->measures + i;
        status = value_of_plan(frontier, number, TN_FRONTIER_NONE, value, error);
        if (status == TN_OK && !tn_steps_of(value, frontier->units->measures[number], &totals[i]))
            status = tn_too_fine(error);
    }
    mpq_clear(value);
    return status == TN_OK ? number_totals(frontier, totals, total, error) : status;
}

/* Below and above all that can be added up (are_small in runtime/house/count/added.c). */
#define SURELY_BELOW (-((tn_int128)1 << 126))
#define SURELY_ABOVE ((tn_int128)1 << 126)

static tn_int128 settle(const tn_frontier *frontier, uint32_t trays, uint32_t compared, tn_int128 total)
{
    const tn_frontier_range *ahead = &frontier->compared.ahead[trays].all[compared];
    if (!ahead->any)
        return total;
    return total + ahead->from > 0 ? SURELY_ABOVE : total + ahead->to < 0 ? SURELY_BELOW : total;
}

tn_status tn_frontier_next_total(tn_frontier *frontier, uint32_t trays, uint32_t total, const tn_int128 *gains,
                                 uint32_t *next, tn_error *error)
{
    tn_int128 totals[TN_COMPARED_MAX];
    read_totals(frontier, total, totals);
    for (uint32_t i = 0; i < compared_count(frontier); i++)
        if (totals[i] != SURELY_BELOW && totals[i] != SURELY_ABOVE)
            totals[i] = settle(frontier, trays, i, totals[i] + gains[i]);
    return number_totals(frontier, totals, next, error);
}

/* ---- what is ahead */

tn_status tn_frontier_ahead_begin(tn_frontier *frontier, tn_error *error)
{
    frontier->compared.ahead = calloc((size_t)frontier->trays_most + 2, sizeof *frontier->compared.ahead);
    frontier->compared.looking_ahead = true;
    return frontier->compared.ahead ? TN_OK : tn_fail_memory(error);
}

static void widen(tn_frontier_range *range, tn_int128 from, tn_int128 to)
{
    range->from = range->any && range->from < from ? range->from : from;
    range->to = range->any && range->to > to ? range->to : to;
    range->any = true;
}

void tn_frontier_ahead_note(tn_frontier *frontier, uint32_t trays, bool end, uint32_t compared, tn_int128 from,
                            tn_int128 to)
{
    tn_frontier_ahead *ahead = &frontier->compared.ahead[trays];
    widen(&(end ? ahead->end : ahead->tray)[compared], from, to);
}

void tn_frontier_ahead_end(tn_frontier *frontier)
{
    frontier->compared.looking_ahead = false;
    for (uint32_t k = frontier->trays_most + 1; k-- > 0;)
        for (uint32_t i = 0; i < compared_count(frontier); i++) {
            tn_frontier_ahead *here = &frontier->compared.ahead[k];
            const tn_frontier_range *next = &here[1].all[i];
            if (here->end[i].any)
                widen(&here->all[i], here->end[i].from, here->end[i].to);
            if (here->tray[i].any && next->any)
                widen(&here->all[i], here->tray[i].from + next->from, here->tray[i].to + next->to);
        }
    tn_frontier_forget_states(frontier);
}

/* ---- the end of the row */

uint32_t tn_frontier_guesses(const tn_frontier *frontier)
{
    uint32_t guesses = 1; /* each number is below, at or above 0 */
    for (uint32_t i = 0; i < compared_count(frontier); i++)
        guesses *= 3;
    return guesses;
}

/* What the clause's value is with the truth of its comparisons; signs: of each compared number. */
static uint32_t with_truths(const tn_frontier *frontier, const tn_frontier_clause *clause, uint32_t value,
                            const int *signs)
{
    uint32_t place = 1;
    for (size_t i = 0; i < clause->atom_count; i++) {
        const tn_frontier_atom *atom = &clause->atoms[i];
        if (tn_code_compares_house(atom->op.opcode))
            value +=
                place * (holds(atom->op.opcode, signs[atom->of - frontier->added->measures]) ? TRUTH_YES : TRUTH_NO);
        place *= atom->radix;
    }
    return value;
}

tn_status tn_frontier_end_values(tn_frontier *frontier, uint32_t values, uint32_t total, uint32_t guess, uint32_t *ends,
                                 tn_error *error)
{
    int signs[TN_COMPARED_MAX];
    tn_int128 totals[TN_COMPARED_MAX];
    size_t size;
    bool ok = true;
    bool known = frontier->units && !frontier->compared.looking_ahead;
    if (known)
        read_totals(frontier, total, totals);
    for (uint32_t i = 0; i < compared_count(frontier); i++, guess /= 3)
        signs[i] = known ? (totals[i] > 0) - (totals[i] < 0) : (int)(guess % 3) - 1;
    frontier->key.size = 0;
    for (uint32_t i = 0; ok && i < frontier->clause_count; i++)
        ok = tn_key_push(&frontier->key, with_truths(frontier, &frontier->clauses[i],
                                                     tn_interned(&frontier->reading.values, values, &size)[i], signs));
    *ends = ok ? tn_intern(&frontier->reading.values, frontier->key.data, frontier->key.size) : UINT32_MAX;
    return *ends != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

void tn_frontier_comparisons_clear(tn_frontier_comparisons *compared)
{
    for (uint32_t k = 0; k < TN_ADDED_MAX; k++)
        free(compared->weighed_rooms[k]);
    tn_plan_vm_free(compared->plan_vm);
    tn_interner_clear(&compared->totals);
    free(compared->ahead);
}
