/* Uniform samples of ranks without replacement, a function of the seed and the arguments alone. */
#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/error.h"
#include "runtime/base/hash_table.h"
#include "runtime/base/integers.h"
#include "runtime/base/random.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/library/sample.h"

/* Numbers of one size in limbs, those drawn so far. Begin with drawn_make; clear in any case. */
typedef struct tn_drawn {
    mpz_srcptr bound;
    size_t limbs;
    unsigned spare;    /* bits of the highest limb that the bound does not have */
    mp_limb_t *values; /* [count][limbs], in the order drawn */
    size_t count, room;
    tn_hash_table table;
    mp_limb_t *candidate; /* [limbs] */
} tn_drawn;

/* ---- numbers below a bound, without drawing one twice */

/* count: how many there will be at least. The bound is above 0, and borrowed. */
static bool drawn_make(tn_drawn *drawn, const mpz_t bound, size_t count)
{
    *drawn = (tn_drawn){.bound = bound, .limbs = mpz_size(bound)};
    drawn->spare = (unsigned)(drawn->limbs * 64 - mpz_sizeinbase(bound, 2));
    drawn->candidate = malloc((drawn->limbs + 1) * sizeof *drawn->candidate);
    return drawn->candidate && tn_hash_reserve(&drawn->table, count, NULL) == TN_OK &&
           tn_array_reserve(&drawn->values, &drawn->room, 0, tn_size_of(count, drawn->limbs) + 1,
                            sizeof *drawn->values);
}

static void drawn_clear(tn_drawn *drawn)
{
    free(drawn->values);
    tn_hash_clear(&drawn->table);
    free(drawn->candidate);
    *drawn = (tn_drawn){0};
}

/* Attempt a takes random words a * limbs and following of a stream, cut to as many bits as the bound has. Is the
 * candidate below the bound? Attempts at or past it are thrown away, so that the rest are uniform. */
static bool drawn_try(tn_drawn *drawn, uint64_t seed, uint64_t stream, uint64_t attempt)
{
    for (size_t i = 0; i < drawn->limbs; i++)
        drawn->candidate[i] = tn_random64(seed, stream, attempt * drawn->limbs + i);
    drawn->candidate[drawn->limbs - 1] >>= drawn->spare;
    return mpn_cmp(drawn->candidate, mpz_limbs_read(drawn->bound), (mp_size_t)drawn->limbs) < 0;
}

static uint64_t drawn_hash(const tn_drawn *drawn)
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

/* Adds the candidate. *fresh: it was not there. TN_MEMORY. */
static tn_status drawn_add(tn_drawn *drawn, bool *fresh, tn_error *error)
{
    size_t used = drawn->count * drawn->limbs;
    if (!tn_array_reserve(&drawn->values, &drawn->room, used, drawn->limbs, sizeof *drawn->values))
        return tn_fail_memory(error);
    uint32_t number = (uint32_t)drawn->count;
    tn_status status = tn_hash_enter(&drawn->table, drawn_hash(drawn), is_candidate, drawn, &number, error);
    if (status != TN_OK)
        return status;
    *fresh = number == drawn->count;
    if (*fresh) {
        memcpy(drawn->values + used, drawn->candidate, drawn->limbs * sizeof *drawn->candidate);
        drawn->count++;
    }
    return TN_OK;
}

/* Gives the numbers drawn, ascending; ranks are [count], initialised. */
static void drawn_give(const tn_drawn *drawn, mpz_t *ranks)
{
    for (size_t i = 0; i < drawn->count; i++)
        mpz_import(ranks[i], drawn->limbs, -1, sizeof(mp_limb_t), 0, 0, drawn->values + i * drawn->limbs);
    if (drawn->count > 0)
        qsort(ranks, drawn->count, sizeof *ranks, tn_integers_compare);
}

/* ---- a sample that is divided: which of its numbers lie in a stretch */

/* Where more than half are wanted, those left out are drawn. */
static bool draws_others(const tn_draws *d)
{
    return mpz_cmp_ui(d->bound, 2 * d->wanted) < 0;
}

static uint64_t to_draw(const tn_draws *d)
{
    return draws_others(d) ? mpz_get_ui(d->bound) - d->wanted : d->wanted;
}

static tn_status look(tn_watch *watch, uint64_t attempt, tn_error *error)
{
    return tn_watch_stopped_at(watch, (size_t)attempt) ? tn_fail_stopped(watch, error) : TN_OK;
}

/* ---- how far it is drawn */

typedef struct tn_drawing {
    const tn_draws *draws;
    tn_watch *watch;
    uint64_t limit; /* attempts that are looked at */
    uint64_t rounds;
    uint64_t *fresh; /* a bit for each: is its number a new one? */
} tn_drawing;

/* About so many attempts are needed: some are at or past the bound, some meet a number again. */
static uint64_t expect(const tn_draws *d)
{
    long exponent;
    double all = mpz_get_d(d->bound), wanted = (double)to_draw(d), below = mpz_get_d_2exp(&exponent, d->bound);
    double draws = isfinite(all) ? -all * log1p(-wanted / all) : wanted;
    return (uint64_t)(fmax(draws, wanted) / below * 1.01) + 4096;
}

/* A round sees the numbers of one class: equal numbers are of one class. */
static tn_status count_round(tn_drawing *c, uint64_t round, tn_error *error)
{
    tn_drawn drawn;
    const tn_draws *d = c->draws;
    tn_status status = drawn_make(&drawn, d->bound, tn_as_size(to_draw(d) / c->rounds)) ? TN_OK : tn_fail_memory(error);
    for (uint64_t a = 0; status == TN_OK && a < c->limit; a++) {
        bool fresh = false;
        status = look(c->watch, a, error);
        if (status == TN_OK && drawn_try(&drawn, d->seed, d->stream, a) &&
            (c->rounds == 1 || drawn_hash(&drawn) % c->rounds == round))
            status = drawn_add(&drawn, &fresh, error);
        c->fresh[a / 64] |= (uint64_t)fresh << a % 64;
    }
    drawn_clear(&drawn);
    return status;
}

/* *attempts: those up to the last new number that is needed; false where the limit comes before. */
static bool find_end(const tn_drawing *c, uint64_t needed, uint64_t *attempts)
{
    for (*attempts = 0; needed > 0 && *attempts < c->limit; ++*attempts)
        needed -= c->fresh[*attempts / 64] >> *attempts % 64 & 1;
    return needed == 0;
}

static tn_status find_attempts(tn_drawing *c, uint64_t *attempts, tn_error *error)
{
    bool found = false;
    for (c->limit = expect(c->draws); !found; c->limit += c->limit / 8) {
        free(c->fresh);
        c->fresh = calloc(tn_as_size(c->limit / 64 + 1), sizeof *c->fresh);
        tn_status status = c->fresh ? TN_OK : tn_fail_memory(error);
        for (uint64_t round = 0; status == TN_OK && round < c->rounds; round++)
            status = count_round(c, round, error);
        if (status != TN_OK)
            return status;
        found = find_end(c, to_draw(c->draws), attempts);
    }
    return TN_OK;
}

/* ---- shares */

static uint32_t share_of(const mpz_t *bounds, uint32_t shares, const mpz_t number)
{
    uint32_t low = 0, high = shares; /* bounds[low] <= number < bounds[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (mpz_cmp(bounds[middle], number) <= 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static tn_status count_shares(const tn_drawing *c, const mpz_t *bounds, uint32_t shares, uint64_t *counts,
                              tn_error *error)
{
    tn_drawn drawn;
    mpz_t number;
    const tn_draws *d = c->draws;
    mpz_init(number);
    tn_status status = drawn_make(&drawn, d->bound, 0) ? TN_OK : tn_fail_memory(error);
    memset(counts, 0, shares * sizeof *counts);
    for (uint64_t a = 0; status == TN_OK && a < d->attempts; a++) {
        status = look(c->watch, a, error);
        if (!(c->fresh[a / 64] >> a % 64 & 1) || !drawn_try(&drawn, d->seed, d->stream, a))
            continue;
        mpz_import(number, drawn.limbs, -1, sizeof(mp_limb_t), 0, 0, drawn.candidate);
        counts[share_of(bounds, shares, number)]++;
    }
    for (uint32_t i = 0; status == TN_OK && draws_others(d) && i < shares; i++) {
        mpz_sub(number, bounds[i + 1], bounds[i]);
        counts[i] = mpz_get_ui(number) - counts[i];
    }
    drawn_clear(&drawn);
    mpz_clear(number);
    return status;
}

tn_status tn_draws_count(tn_draws *draws, const mpz_t *bounds, uint32_t shares, uint64_t *counts, size_t memory,
                         tn_watch *watch, tn_error *error)
{
    /* A number, its place among the slots, of which half are free, and the room that arrays grow into. */
    size_t each = 2 * (mpz_size(draws->bound) * sizeof(mp_limb_t) + 4 * sizeof(size_t));
    tn_drawing c = {.draws = draws, .watch = watch, .rounds = to_draw(draws) / (memory / each + 1) + 1};
    draws->attempts = 0;
    tn_status status = to_draw(draws) > 0 ? find_attempts(&c, &draws->attempts, error) : TN_OK;
    if (status == TN_OK)
        status = count_shares(&c, bounds, shares, counts, error);
    free(c.fresh);
    return status;
}

/* ---- a stretch */

/* Gives the numbers from `from` on that were not drawn. */
static void give_the_others(const mpz_t *drawn, size_t count, const mpz_t from, mpz_t *ranks, size_t wanted)
{
    mpz_t number;
    mpz_init_set(number, from);
    for (size_t i = 0, at = 0; i < wanted; mpz_add_ui(number, number, 1)) {
        if (at < count && mpz_cmp(drawn[at], number) == 0)
            at++;
        else
            mpz_set(ranks[i++], number);
    }
    mpz_clear(number);
}

static tn_status draw_between(const tn_draws *d, const mpz_t from, const mpz_t to, tn_drawn *drawn, tn_watch *watch,
                              tn_error *error)
{
    tn_status status = TN_OK;
    bool fresh;
    mpz_t number;
    mpz_init(number);
    for (uint64_t a = 0; status == TN_OK && a < d->attempts; a++) {
        status = look(watch, a, error);
        if (status != TN_OK || !drawn_try(drawn, d->seed, d->stream, a))
            continue;
        mpz_import(number, drawn->limbs, -1, sizeof(mp_limb_t), 0, 0, drawn->candidate);
        if (mpz_cmp(number, from) >= 0 && mpz_cmp(number, to) < 0)
            status = drawn_add(drawn, &fresh, error);
    }
    mpz_clear(number);
    return status;
}

tn_status tn_draws_between(const tn_draws *d, const mpz_t from, const mpz_t to, mpz_t **ranks, size_t *count,
                           tn_watch *watch, tn_error *error)
{
    tn_drawn drawn = {0};
    mpz_t *given = NULL;
    *ranks = NULL;
    *count = 0;
    if (mpz_cmp(from, to) >= 0)
        return (*ranks = tn_integers_new(0)) ? TN_OK : tn_fail_memory(error);
    tn_status status = drawn_make(&drawn, d->bound, 0) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw_between(d, from, to, &drawn, watch, error);
    size_t found = drawn.count;
    if (status == TN_OK && !(given = tn_integers_new(found)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        drawn_give(&drawn, given);
    drawn_clear(&drawn);
    if (status != TN_OK || !draws_others(d)) {
        *ranks = given;
        *count = given ? found : 0;
        return status;
    }
    mpz_t all;
    mpz_init(all);
    mpz_sub(all, to, from);
    *count = (mpz_fits_ulong_p(all) ? tn_as_size(mpz_get_ui(all)) : TN_SIZE_MOST) - found;
    mpz_clear(all);
    *ranks = tn_integers_new(*count);
    if (*ranks)
        give_the_others((const mpz_t *)given, found, from, *ranks, *count);
    tn_integers_free(given, found);
    return *ranks ? TN_OK : tn_fail_memory(error);
}

/* Draws `count` different numbers below the bound. */
static tn_status draw(tn_drawn *drawn, uint64_t seed, uint64_t stream, size_t count, tn_error *error)
{
    tn_status status = TN_OK;
    bool fresh;
    for (uint64_t attempt = 0; status == TN_OK && drawn->count < count; attempt++)
        if (drawn_try(drawn, seed, stream, attempt))
            status = drawn_add(drawn, &fresh, error);
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
    tn_status status = drawn_make(&drawn, bound, wanted) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw(&drawn, seed, stream, wanted, error);
    if (status == TN_OK && others)
        status = give_others(&drawn, all, ranks) ? TN_OK : tn_fail_memory(error);
    else if (status == TN_OK)
        drawn_give(&drawn, ranks);
    drawn_clear(&drawn);
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
