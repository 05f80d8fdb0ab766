/* What a clause can still tell apart when only so many trays may follow.
 *
 * A row has a least and a most number of trays. After so many of them, states of a clause that keep the same of all
 * that can follow are one, and a state that keeps nothing of it ends the row at once, though a longer row might still
 * have mended it. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

/* ---- states */

/* What a state keeps after so many letters; next: of one letter more, or NULL. *any: does it keep anything? */
static bool describe(const tn_strip_clause *clause, uint32_t state, bool last, const uint32_t *next, tn_key *key,
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

static uint32_t *merge_states(const tn_strip_clause *clause, bool last, const uint32_t *next, tn_key *key)
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
static bool merge_clause(const tn_strip *strip, tn_strip_clause *clause, tn_key *key)
{
    uint32_t most = strip->trays_most, least = strip->trays_least;
    clause->horizons = calloc((size_t)most + 1, sizeof *clause->horizons);
    if (!clause->horizons)
        return false;
    for (uint32_t k = most + 1; k-- > 0;) {
        tn_strip_horizon *here = &clause->horizons[k], *next = k < most ? here + 1 : NULL;
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

tn_status tn_strip_horizons(tn_strip *strip, tn_error *error)
{
    for (uint32_t i = 0; i < strip->clause_count; i++)
        if (!merge_clause(strip, &strip->clauses[i], &strip->key))
            return tn_fail_memory(error);
    return TN_OK;
}

void tn_strip_horizons_free(const tn_strip *strip, tn_strip_clause *clause)
{
    for (uint32_t k = 0; clause->horizons && k <= strip->trays_most; k++) {
        tn_strip_horizon *here = &clause->horizons[k];
        if (k == strip->trays_most || here->alike != here[1].alike)
            free(here->alike);
        tn_numbering_clear(&here->pairs);
        tn_interner_clear(&here->classes);
        free(here->of_pair);
        free(here->first);
    }
    free(clause->horizons);
}

/* ---- letters of which a part is not known yet */

/* Where each value of the letter leads, and the first pair that leads there. */
static uint64_t merge_pair(tn_strip *strip, tn_strip_clause *clause, tn_strip_horizon *horizon, uint32_t state,
                           uint32_t base, bool *ok)
{
    bool any = false;
    uint32_t before = horizon->classes.count;
    strip->key.size = 0;
    for (uint32_t v = 0; *ok && v < clause->radix; v++) {
        uint32_t to = horizon->alike[tn_dfa_read(clause->dfa, state, base * clause->radix + v)];
        any = any || to != TN_NO_STATE;
        *ok = tn_key_push(&strip->key, to);
    }
    uint32_t class = *ok ? tn_intern(&horizon->classes, strip->key.data, strip->key.size) : UINT32_MAX;
    *ok = class != UINT32_MAX &&
          tn_array_reserve(&horizon->first, &horizon->first_room, before, 1, sizeof *horizon->first);
    if (*ok && class == before)
        horizon->first[class] = any ? (uint64_t)state << 32 | base : TN_STRIP_NO_PAIR;
    return *ok ? horizon->first[class] : 0;
}

tn_status tn_strip_pair(tn_strip *strip, tn_strip_clause *clause, uint32_t trays, uint32_t state, uint32_t base,
                        uint64_t *pair, tn_error *error)
{
    tn_strip_horizon *horizon = &clause->horizons[trays];
    uint32_t before = horizon->pairs.count;
    if (!tn_array_reserve(&horizon->of_pair, &horizon->pair_room, before, 1, sizeof *horizon->of_pair))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&horizon->pairs, (uint64_t)state << 32 | base);
    bool ok = at != UINT32_MAX;
    if (ok && at == before)
        horizon->of_pair[at] = merge_pair(strip, clause, horizon, state, base, &ok);
    *pair = ok ? horizon->of_pair[at] : 0;
    return ok ? TN_OK : tn_fail_memory(error);
}
