/* Draws numbers below a bound, and keeps those that were drawn. */
#include "runtime/plan/library/drawn.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"

bool tn_drawn_make(tn_drawn *drawn, const mpz_t bound, size_t count)
{
    *drawn = (tn_drawn){.bound = bound, .limbs = mpz_size(bound)};
    drawn->spare = (unsigned)(drawn->limbs * 64 - mpz_sizeinbase(bound, 2));
    drawn->candidate = malloc((drawn->limbs + 1) * sizeof *drawn->candidate);
    return drawn->candidate && tn_hash_reserve(&drawn->index, count, NULL) == TN_OK &&
           tn_array_reserve(&drawn->values, &drawn->room, 0, tn_size_of(count, drawn->limbs) + 1,
                            sizeof *drawn->values);
}

void tn_drawn_clear(tn_drawn *drawn)
{
    free(drawn->values);
    tn_hash_clear(&drawn->index);
    free(drawn->candidate);
    *drawn = (tn_drawn){0};
}

bool tn_drawn_try(tn_drawn *drawn, uint64_t seed, uint64_t stream, uint64_t attempt)
{
    for (size_t i = 0; i < drawn->limbs; i++)
        drawn->candidate[i] = tn_random64(seed, stream, attempt * drawn->limbs + i);
    drawn->candidate[drawn->limbs - 1] >>= drawn->spare;
    return mpn_cmp(drawn->candidate, mpz_limbs_read(drawn->bound), (mp_size_t)drawn->limbs) < 0;
}

uint64_t tn_drawn_hash(const tn_drawn *drawn)
{
    uint64_t hash = drawn->limbs;
    for (size_t i = 0; i < drawn->limbs; i++)
        hash = tn_mix64(hash ^ drawn->candidate[i]);
    return hash;
}

static bool is_candidate(const void *context, uint32_t number)
{
    const tn_drawn *drawn = context;
    return memcmp(drawn->values + number * drawn->limbs, drawn->candidate, drawn->limbs * sizeof *drawn->candidate) ==
           0;
}

tn_status tn_drawn_add(tn_drawn *drawn, bool *fresh, tn_error *error)
{
    size_t used = drawn->count * drawn->limbs;
    if (!tn_array_reserve(&drawn->values, &drawn->room, used, drawn->limbs, sizeof *drawn->values))
        return tn_fail_memory(error);
    uint32_t number = (uint32_t)drawn->count;
    tn_status status = tn_hash_enter(&drawn->index, tn_drawn_hash(drawn), is_candidate, drawn, &number, error);
    if (status != TN_OK)
        return status;
    *fresh = number == drawn->count;
    if (*fresh) {
        memcpy(drawn->values + used, drawn->candidate, drawn->limbs * sizeof *drawn->candidate);
        drawn->count++;
    }
    return TN_OK;
}

static int compare_integers(const void *a, const void *b)
{
    mpz_srcptr x = a, y = b;
    return mpz_cmp(x, y);
}

void tn_drawn_give(const tn_drawn *drawn, mpz_t *ranks)
{
    for (size_t i = 0; i < drawn->count; i++)
        mpz_import(ranks[i], drawn->limbs, -1, sizeof(mp_limb_t), 0, 0, drawn->values + i * drawn->limbs);
    if (drawn->count > 0)
        qsort(ranks, drawn->count, sizeof *ranks, compare_integers);
}
