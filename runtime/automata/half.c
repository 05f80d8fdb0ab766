/* The construction reads u and keeps (p, R): p is where the automaton is after u, R are the states from which it
 * accepts u reversed. The palindrome of even length is accepted iff p is in R. For odd lengths, reading a letter from
 * (p, R) remembers whether that letter leads from p into R: then it may be the middle. */
#include "runtime/automata/half.h"

#include <stdlib.h>

#include "runtime/automata/explore.h"

typedef struct tn_halving {
    const tn_dfa *dfa;
    tn_join join;
    bool odd;
    uint64_t effort;
} tn_halving;

/* A key is p, whether the last letter may be the middle (odd only), and R ascending. */
enum { PLACE, MIDDLE, SET };

static bool in_set(const uint32_t *key, size_t size, uint32_t state)
{
    size_t low = SET, high = size;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (key[middle] < state)
            low = middle + 1;
        else
            high = middle;
    }
    return low < size && key[low] == state;
}

static bool halving_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_halving *halving = context;
    const tn_dfa *dfa = halving->dfa;
    uint32_t own = halving->join.pick[column];
    uint32_t place = dfa->delta[(size_t)key[PLACE] * dfa->columns + own];
    halving->effort += dfa->states;
    bool ok = tn_key_push(next, place) && tn_key_push(next, halving->odd && in_set(key, size, place));
    for (uint32_t q = 0; ok && q < dfa->states; q++)
        if (in_set(key, size, dfa->delta[(size_t)q * dfa->columns + own]))
            ok = tn_key_push(next, q);
    return ok;
}

static bool halving_accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_halving *halving = context;
    return halving->odd ? key[MIDDLE] : in_set(key, size, key[PLACE]);
}

tn_status tn_half(const tn_dfa *dfa, bool odd, tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    tn_halving halving = {.dfa = dfa, .odd = odd};
    tn_key start = {0};
    tn_status status = tn_join_make(&halving.join, &dfa, 1, dfa->letters, NULL, false, error);
    bool ok = tn_key_push(&start, 0) && tn_key_push(&start, 0);
    for (uint32_t q = 0; ok && q < dfa->states; q++)
        if (dfa->accept[q])
            ok = tn_key_push(&start, q);
    if (status == TN_OK && !ok)
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        tn_construction construction = {"rule on palindromes", &halving.join, &halving, halving_step, halving_accepts};
        status = tn_explore(&construction, &start, &halving.effort, bounds, out, error);
    }
    free(start.data);
    tn_join_clear(&halving.join);
    return status;
}
