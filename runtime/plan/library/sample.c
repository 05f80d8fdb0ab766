/* Uniform samples of ranks without replacement, a function of the seed and the arguments alone. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"
#include "runtime/plan/library/library_data.h"

/* Numbers below a bound, of one size in limbs, in a hash table: those drawn so far. */
typedef struct tn_drawn {
    size_t limbs;
    mp_limb_t *values; /* [count][limbs], in the order drawn */
    size_t *slots;     /* number + 1; 0 is free */
    size_t count, capacity;
    mp_limb_t *candidate; /* [limbs] */
} tn_drawn;

static bool drawn_make(tn_drawn *drawn, const mpz_t bound, size_t count)
{
    drawn->limbs = mpz_size(bound);
    drawn->capacity = 64;
    while (drawn->capacity < 2 * count)
        drawn->capacity *= 2;
    drawn->values = malloc((count * drawn->limbs + 1) * sizeof *drawn->values);
    drawn->slots = calloc(drawn->capacity, sizeof *drawn->slots);
    drawn->candidate = malloc((drawn->limbs + 1) * sizeof *drawn->candidate);
    return drawn->values && drawn->slots && drawn->candidate;
}

static void drawn_clear(tn_drawn *drawn)
{
    free(drawn->values);
    free(drawn->slots);
    free(drawn->candidate);
}

/* Adds the candidate unless it is there already. */
static void drawn_add(tn_drawn *drawn)
{
    uint64_t hash = drawn->limbs;
    for (size_t i = 0; i < drawn->limbs; i++)
        hash = tn_mix64(hash ^ drawn->candidate[i]);
    size_t at = hash & (drawn->capacity - 1), bytes = drawn->limbs * sizeof *drawn->candidate;
    for (; drawn->slots[at]; at = (at + 1) & (drawn->capacity - 1))
        if (memcmp(drawn->values + (drawn->slots[at] - 1) * drawn->limbs, drawn->candidate, bytes) == 0)
            return;
    memcpy(drawn->values + drawn->count * drawn->limbs, drawn->candidate, bytes);
    drawn->slots[at] = ++drawn->count;
}

/* Draws `count` different numbers below the bound. Attempt a takes random words a * limbs and following of stream
 * `stream`, cut to as many bits as the bound has; attempts at or past the bound are thrown away, so the rest are
 * uniform. */
static void draw(tn_drawn *drawn, uint64_t seed, uint64_t stream, const mpz_t bound, size_t count)
{
    size_t bits = mpz_sizeinbase(bound, 2), spare = drawn->limbs * 64 - bits;
    for (uint64_t attempt = 0; drawn->count < count; attempt++) {
        for (size_t i = 0; i < drawn->limbs; i++)
            drawn->candidate[i] = tn_random64(seed, stream, attempt * drawn->limbs + i);
        drawn->candidate[drawn->limbs - 1] >>= spare;
        if (mpn_cmp(drawn->candidate, mpz_limbs_read(bound), (mp_size_t)drawn->limbs) < 0)
            drawn_add(drawn);
    }
}

static int compare_integers(const void *a, const void *b)
{
    mpz_srcptr x = a, y = b;
    return mpz_cmp(x, y);
}

/* Gives the numbers drawn, ascending. */
static void give_drawn(const tn_drawn *drawn, mpz_t *ranks)
{
    for (size_t i = 0; i < drawn->count; i++)
        mpz_import(ranks[i], drawn->limbs, -1, sizeof(mp_limb_t), 0, 0, drawn->values + i * drawn->limbs);
    qsort(ranks, drawn->count, sizeof *ranks, compare_integers);
}

/* Gives all numbers below `bound` but those drawn; the bound is less than twice the number given, so it fits a word. */
static bool give_others(const tn_drawn *drawn, uint64_t bound, mpz_t *ranks)
{
    uint8_t *out = calloc(bound / 8 + 1, 1);
    if (!out)
        return false;
    for (size_t i = 0; i < drawn->count; i++)
        out[drawn->values[i] / 8] |= (uint8_t)(1u << (drawn->values[i] % 8));
    for (uint64_t n = 0, i = 0; n < bound; n++)
        if (!(out[n / 8] >> (n % 8) & 1))
            mpz_set_ui(ranks[i++], n);
    free(out);
    return true;
}

/* Where more than half are wanted, those left out are drawn. */
tn_status tn_ranks_sample(uint64_t seed, uint64_t stream, const mpz_t bound, size_t count, mpz_t *ranks, size_t *found,
                          tn_error *error)
{
    uint64_t all = mpz_fits_ulong_p(bound) ? mpz_get_ui(bound) : UINT64_MAX;
    *found = count < all ? count : (size_t)all;
    if (*found == 0)
        return TN_OK;
    bool others = *found > all / 2;
    tn_drawn drawn = {0};
    size_t wanted = others ? (size_t)(all - *found) : *found;
    bool ok = drawn_make(&drawn, bound, wanted);
    if (ok)
        draw(&drawn, seed, stream, bound, wanted);
    if (ok && others)
        ok = give_others(&drawn, all, ranks);
    else if (ok)
        give_drawn(&drawn, ranks);
    drawn_clear(&drawn);
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_library_sample(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                            size_t *found, tn_error *error)
{
    mpz_t bound;
    mpz_init(bound);
    tn_library_kept(library, length, bound);
    /* Each length has a stream of its own, so that samples by length do not resemble one another. */
    tn_status status = tn_ranks_sample(seed, length, bound, count, ranks, found, error);
    bool shift = status == TN_OK && length != TN_ALL_LENGTHS && length <= library->max;
    for (size_t i = 0; shift && i < *found; i++)
        mpz_add(ranks[i], ranks[i], library->before[length]);
    mpz_clear(bound);
    return status;
}
