/* Draws ranks of a library, as --seed, --length and --per-length say. */
#include "cli/plan/sampled.h"

#include <stdio.h>
#include <stdlib.h>

#include "cli/common/interrupt.h"
#include "runtime/base/array.h"
#include "runtime/plan/library/diverse.h"

static bool out_of_memory(tn_job *job)
{
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    return false;
}

static bool grow(tn_sampled *sampled, size_t more)
{
    if (sampled->room - sampled->count >= more && sampled->ranks)
        return true;
    size_t room = sampled->count + more;
    if (!tn_array_resize(&sampled->ranks, room, sizeof *sampled->ranks))
        return false;
    for (size_t i = sampled->room; i < room; i++)
        mpz_init(sampled->ranks[i]);
    sampled->room = room;
    return true;
}

/* What the library holds in a length where that is fewer than wanted: no room is needed for more. */
static size_t at_most(const tn_library *library, uint32_t length, size_t wanted)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, length, kept);
    if (mpz_cmp_ui(kept, wanted) < 0)
        wanted = (size_t)mpz_get_ui(kept);
    mpz_clear(kept);
    return wanted;
}

/* tn_library_sample, or tn_library_diverse. */
typedef tn_status choose_ranks(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                               size_t *found, tn_error *error);

/* A rank is drawn in limbs, marked as drawn, and given as an integer: said beforehand, as it is all at once. */
static tn_status check_memory(const tn_library *library, uint32_t length, size_t count, tn_error *error)
{
    mpz_t kept;
    char what[64];
    mpz_init(kept);
    tn_library_kept(library, length, kept);
    uint64_t limbs = mpz_size(kept), bytes = sizeof(mpz_t) + 2 * sizeof(mp_limb_t) * limbs + 16 + 4 * sizeof(size_t);
    mpz_clear(kept);
    snprintf(what, sizeof what, "drawing %zu plans", count);
    tn_status status = tn_watch_room(tn_interrupt_waiting(), bytes * count, what, error);
    if (status == TN_LIMIT)
        tn_error_help(error, "draw fewer plans, or raise the limit with --memory-limit");
    return status;
}

typedef struct drawing {
    tn_job *job;
    const tn_library *library;
    uint64_t seed;
    tn_sampled *sampled;
    choose_ranks *choose;
} drawing;

static bool draw(const drawing *d, uint32_t length, size_t wanted)
{
    tn_job *job = d->job;
    const tn_library *library = d->library;
    tn_sampled *sampled = d->sampled;
    size_t count = at_most(library, length, wanted), found = 0;
    tn_error error;
    if (check_memory(library, length, count, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    if (!grow(sampled, count))
        return out_of_memory(job);
    if (d->choose(library, d->seed, length, count, sampled->ranks + sampled->count, &found, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    sampled->count += found;
    if (found == wanted)
        return true;
    const char *plural = found == 1 ? "" : "s";
    if (length == TN_ALL_LENGTHS)
        tn_job_note(job, "the library holds %zu plan%s, fewer than the %zu asked for: these are all", found, plural,
                    wanted);
    else
        tn_job_note(job, "the library holds %zu plan%s of length %u, fewer than the %zu asked for: these are all",
                    found, plural, length, wanted);
    return true;
}

static bool may_be_diverse(tn_job *job, const tn_sampled_settings *settings, size_t wanted)
{
    if (settings->per_length.given)
        tn_job_usage(job, "--diverse and --per-length exclude each other: give --length for plans of one length");
    else if (wanted > TN_DIVERSE_MAX)
        tn_job_usage(job, "--diverse chooses at most %u plans, not %zu", TN_DIVERSE_MAX, wanted);
    return !settings->per_length.given && wanted <= TN_DIVERSE_MAX;
}

bool tn_job_sample(tn_job *job, const tn_ready_library *ready, const tn_sampled_settings *settings, size_t wanted,
                   tn_sampled *sampled)
{
    const tn_library *library = ready->library;
    *sampled = (tn_sampled){0};
    if (settings->diverse && !may_be_diverse(job, settings, wanted))
        return false;
    const drawing d = {job, library, settings->seed.value, sampled,
                       settings->diverse ? tn_library_diverse : tn_library_sample};
    if (settings->per_length.given) {
        for (uint32_t length = tn_library_min(library); length <= tn_library_max(library); length++)
            if (!draw(&d, length, (size_t)settings->per_length.value))
                return false;
        return true;
    }
    uint32_t length = settings->length.given ? (uint32_t)settings->length.value : TN_ALL_LENGTHS;
    return draw(&d, length, wanted);
}

void tn_sampled_clear(tn_sampled *sampled)
{
    for (size_t i = 0; i < sampled->room; i++)
        mpz_clear(sampled->ranks[i]);
    free(sampled->ranks);
    *sampled = (tn_sampled){0};
}
