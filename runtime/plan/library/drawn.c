/* Draws numbers below a bound, and keeps those that were drawn. */
#include "runtime/plan/library/drawn.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"

bool tn_drawn_make(tn_drawn *drawn, const mpz_t bound, size_t count)
{
    *drawn = (tn_drawn){.bound = bound, .limbs = mpz_size(bound), .capacity = 64};
    drawn->spare = (unsigned)(drawn->limbs * 64 - mpz_sizeinbase(bound, 2));
    while (drawn->capacity < 2 * count)
        drawn->capacity *= 2;
    drawn->slots = calloc(drawn->capacity, sizeof *drawn->slots);
    drawn->candidate = malloc((drawn->limbs + 1) * sizeof *drawn->candidate);
    return drawn->slots && drawn->candidate &&
           tn_array_reserve(&drawn->values, &drawn->room, 0, tn_size_of(count, drawn->limbs) + 1,
                            sizeof *drawn->values);
}

void tn_drawn_clear(tn_drawn *drawn)
{
    free(drawn->values);
    free(drawn->slots);
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

static uint64_t hash_of(const tn_drawn *drawn, const mp_limb_t *value)
{
    uint64_t hash = drawn->limbs;
    for (size_t i = 0; i < drawn->limbs; i++)
        hash = tn_mix64(hash ^ value[i]);
    return hash;
}

uint64_t tn_drawn_hash(const tn_drawn *drawn)
{
    return hash_of(drawn, drawn->candidate);
}

static bool grow(tn_drawn *drawn)
{
    size_t capacity = drawn->capacity * 2;
    size_t *slots = calloc(capacity, sizeof *slots);
    if (!slots)
        return false;
    for (size_t i = 0; i < drawn->count; i++) {
        size_t at = hash_of(drawn, drawn->values + i * drawn->limbs) & (capacity - 1);
        while (slots[at])
            at = (at + 1) & (capacity - 1);
        slots[at] = i + 1;
    }
    free(drawn->slots);
    drawn->slots = slots;
    drawn->capacity = capacity;
    return true;
}

tn_status tn_drawn_add(tn_drawn *drawn, bool *fresh, tn_error *error)
{
    size_t used = drawn->count * drawn->limbs, bytes = drawn->limbs * sizeof *drawn->candidate;
    if ((2 * drawn->count >= drawn->capacity && !grow(drawn)) ||
        !tn_array_reserve(&drawn->values, &drawn->room, used, drawn->limbs, sizeof *drawn->values))
        return tn_fail_memory(error);
    size_t at = tn_drawn_hash(drawn) & (drawn->capacity - 1);
    *fresh = false;
    for (; drawn->slots[at]; at = (at + 1) & (drawn->capacity - 1))
        if (memcmp(drawn->values + (drawn->slots[at] - 1) * drawn->limbs, drawn->candidate, bytes) == 0)
            return TN_OK;
    *fresh = true;
    memcpy(drawn->values + used, drawn->candidate, bytes);
    drawn->slots[at] = ++drawn->count;
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
