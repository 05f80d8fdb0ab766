/* Uniform samples of ranks without replacement, a function of the seed and the arguments alone. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/drawn.h"
#include "runtime/plan/library/library_data.h"

/* Draws `count` different numbers below the bound. */
static tn_status draw(tn_drawn *drawn, uint64_t seed, uint64_t stream, size_t count, tn_error *error)
{
    tn_status status = TN_OK;
    bool fresh;
    for (uint64_t attempt = 0; status == TN_OK && drawn->count < count; attempt++)
        if (tn_drawn_try(drawn, seed, stream, attempt))
            status = tn_drawn_add(drawn, &fresh, error);
    return status;
}

/* Gives all numbers below `bound` but those drawn; the bound is less than twice the number given, so it fits a word. */
static bool give_others(const tn_drawn *drawn, uint64_t bound, mpz_t *ranks)
{
    uint8_t *out = calloc(tn_as_size(bound / 8 + 1), 1);
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
    tn_status status = tn_drawn_make(&drawn, bound, wanted) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw(&drawn, seed, stream, wanted, error);
    if (status == TN_OK && others)
        status = give_others(&drawn, all, ranks) ? TN_OK : tn_fail_memory(error);
    else if (status == TN_OK)
        tn_drawn_give(&drawn, ranks);
    tn_drawn_clear(&drawn);
    return status;
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
