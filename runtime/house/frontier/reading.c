/* What the clauses have read so far, as one number, and how it goes on: each combination is worked out once.
 *
 * At a plane clauses read in two goes: first what the slice behind it says by itself, of the clauses that wait for
 * nothing; then what the plane says, of those that had waited for the right side of the slice before it. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

/* Words of what has been read: the state of each clause, then the base of each (0 where it waits for nothing). Words
 * between the two goes: where in the row, the states, the bases that waited, the bases that will wait. */
enum { AT_BEGIN, AT_PLANE, AT_END };
enum { BETWEEN_WHERE, BETWEEN_STATES };

tn_status tn_strip_known_at(tn_strip_known *known, uint32_t first, uint32_t second, size_t words, uint32_t **result,
                            bool *met, tn_error *error)
{
    uint32_t before = known->pairs.count;
    if (!tn_array_reserve(&known->results, &known->room, before * words, words, sizeof *known->results))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&known->pairs, (uint64_t)first << 32 | second);
    *result = &known->results[at == UINT32_MAX ? 0 : at * words];
    *met = at < before;
    return at == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

void tn_strip_known_clear(tn_strip_known *known)
{
    tn_numbering_clear(&known->pairs);
    free(known->results);
}

/* A letter of a clause, after which it has read so many. Does the clause keep something then? */
static bool read_letter(const tn_strip_clause *clause, uint32_t letter, uint32_t letters, bool last, uint32_t *state)
{
    *state = tn_dfa_read(clause->dfa, *state, letter);
    if (last)
        return clause->dfa->accept[*state];
    *state = clause->horizons[letters].alike[*state];
    return *state != TN_NO_STATE;
}

/* ---- the slice by itself */

/* strip->key := what is between the two goes. *keeps: does each clause keep something? */
static bool read_slice(tn_strip *strip, uint32_t trays, uint32_t read, const uint32_t *bases, bool *keeps)
{
    size_t size;
    uint32_t count = strip->clause_count;
    const uint32_t *before = read == TN_STRIP_NONE ? NULL : tn_interned(&strip->readings, read, &size);
    tn_key *key = &strip->key;
    key->size = 0;
    bool ok = tn_key_push(key, !before ? AT_BEGIN : bases ? AT_PLANE : AT_END);
    *keeps = true;
    for (uint32_t i = 0; ok && *keeps && i < count; i++) {
        const tn_strip_clause *clause = &strip->clauses[i];
        uint32_t state = before ? before[i] : 0;
        if (clause->radix == 1)
            *keeps = bases ? read_letter(clause, bases[i], trays + 1, false, &state) : clause->dfa->accept[state];
        ok = tn_key_push(key, state);
    }
    for (uint32_t i = 0; ok && *keeps && i < count; i++)
        ok = tn_key_push(key, before ? before[count + i] : 0);
    for (uint32_t i = 0; ok && *keeps && i < count; i++)
        ok = tn_key_push(key, bases && strip->clauses[i].radix > 1 ? bases[i] : 0);
    return ok;
}

tn_status tn_strip_read_slice(tn_strip *strip, uint32_t trays, uint32_t read, uint32_t slice, uint32_t *between,
                              tn_error *error)
{
    uint32_t *result, number = slice == TN_STRIP_NONE ? slice : strip->slices[slice].bases;
    bool met, keeps;
    tn_status status = tn_strip_known_at(&strip->after_slice[trays], read, number, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        size_t size;
        const uint32_t *bases = slice == TN_STRIP_NONE ? NULL : tn_interned(&strip->letters, number, &size);
        bool ok = read_slice(strip, trays, read, bases, &keeps);
        *result = ok && keeps ? tn_intern(&strip->between, strip->key.data, strip->key.size) : TN_STRIP_NONE;
        if (!ok || (keeps && *result == UINT32_MAX))
            return tn_fail_memory(error);
    }
    *between = status == TN_OK ? *result : TN_STRIP_NONE;
    return status;
}

/* ---- the plane */

/* Merges what the clause cannot tell apart, once it waits for the right side of the slice. */
static tn_status wait_for_right(tn_strip *strip, uint32_t clause, uint32_t trays, uint32_t *state, uint32_t *base,
                                bool *keeps, tn_error *error)
{
    uint64_t pair;
    if (strip->clauses[clause].radix == 1)
        return TN_OK;
    tn_status status = tn_strip_pair(strip, &strip->clauses[clause], trays, *state, *base, &pair, error);
    *keeps = status == TN_OK && pair != TN_STRIP_NO_PAIR;
    *state = tn_high(pair);
    *base = tn_low(pair);
    return status;
}

/* strip->scratch := the states, then the bases. */
static tn_status read_plane(tn_strip *strip, uint32_t trays, const uint32_t *between, const uint32_t *values,
                            bool *keeps, tn_error *error)
{
    uint32_t count = strip->clause_count, where = between[BETWEEN_WHERE];
    uint32_t *states = strip->scratch, *bases = states + count;
    const uint32_t *waited = between + BETWEEN_STATES + count;
    tn_status status = TN_OK;
    memcpy(states, between + BETWEEN_STATES, count * sizeof *states);
    memcpy(bases, waited + count, count * sizeof *bases);
    *keeps = true;
    for (uint32_t i = 0; status == TN_OK && *keeps && i < count; i++) {
        const tn_strip_clause *clause = &strip->clauses[i];
        if (clause->radix > 1 && where != AT_BEGIN)
            *keeps = read_letter(clause, waited[i] * clause->radix + values[i], trays, where == AT_END, &states[i]);
        if (*keeps && where != AT_END)
            status = wait_for_right(strip, i, trays + 1, &states[i], &bases[i], keeps, error);
    }
    return status;
}

tn_status tn_strip_read_plane(tn_strip *strip, uint32_t trays, uint32_t between, uint32_t values, uint32_t *read,
                              tn_error *error)
{
    uint32_t *result;
    bool met, keeps;
    tn_status status = tn_strip_known_at(&strip->after_plane[trays], between, values, 1, &result, &met, error);
    if (status == TN_OK && !met) {
        size_t size;
        const uint32_t *words = values == TN_STRIP_NONE ? NULL : tn_interned(&strip->values, values, &size);
        status = read_plane(strip, trays, tn_interned(&strip->between, between, &size), words, &keeps, error);
        *result = TN_STRIP_NONE;
        if (status == TN_OK && keeps) {
            *result = tn_intern(&strip->readings, strip->scratch, 2 * (size_t)strip->clause_count);
            status = *result == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
        }
    }
    *read = status == TN_OK ? *result : TN_STRIP_NONE;
    return status;
}
