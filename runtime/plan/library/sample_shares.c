/* Finds how far a sample is drawn, and which of its numbers lie in a stretch. */
#include "runtime/plan/library/sample_shares.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/plan/library/drawn.h"

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
    tn_status status =
        tn_drawn_make(&drawn, d->bound, tn_as_size(to_draw(d) / c->rounds)) ? TN_OK : tn_fail_memory(error);
    for (uint64_t a = 0; status == TN_OK && a < c->limit; a++) {
        bool fresh = false;
        status = look(c->watch, a, error);
        if (status == TN_OK && tn_drawn_try(&drawn, d->seed, d->stream, a) &&
            (c->rounds == 1 || tn_drawn_hash(&drawn) % c->rounds == round))
            status = tn_drawn_add(&drawn, &fresh, error);
        c->fresh[a / 64] |= (uint64_t)fresh << a % 64;
    }
    tn_drawn_clear(&drawn);
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
    tn_status status = tn_drawn_make(&drawn, d->bound, 0) ? TN_OK : tn_fail_memory(error);
    memset(counts, 0, shares * sizeof *counts);
    for (uint64_t a = 0; status == TN_OK && a < d->attempts; a++) {
        status = look(c->watch, a, error);
        if (!(c->fresh[a / 64] >> a % 64 & 1) || !tn_drawn_try(&drawn, d->seed, d->stream, a))
            continue;
        mpz_import(number, drawn.limbs, -1, sizeof(mp_limb_t), 0, 0, drawn.candidate);
        counts[share_of(bounds, shares, number)]++;
    }
    for (uint32_t i = 0; status == TN_OK && draws_others(d) && i < shares; i++) {
        mpz_sub(number, bounds[i + 1], bounds[i]);
        counts[i] = mpz_get_ui(number) - counts[i];
    }
    tn_drawn_clear(&drawn);
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
static void give_others(const mpz_t *drawn, size_t count, const mpz_t from, mpz_t *ranks, size_t wanted)
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
        if (status != TN_OK || !tn_drawn_try(drawn, d->seed, d->stream, a))
            continue;
        mpz_import(number, drawn->limbs, -1, sizeof(mp_limb_t), 0, 0, drawn->candidate);
        if (mpz_cmp(number, from) >= 0 && mpz_cmp(number, to) < 0)
            status = tn_drawn_add(drawn, &fresh, error);
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
    tn_status status = tn_drawn_make(&drawn, d->bound, 0) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw_between(d, from, to, &drawn, watch, error);
    size_t found = drawn.count;
    if (status == TN_OK && !(given = tn_integers_new(found)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        tn_drawn_give(&drawn, given);
    tn_drawn_clear(&drawn);
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
        give_others((const mpz_t *)given, found, from, *ranks, *count);
    tn_integers_free(given, found);
    return *ranks ? TN_OK : tn_fail_memory(error);
}
