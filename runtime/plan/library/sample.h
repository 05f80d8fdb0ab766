/* Samples of ranks that are too large for one machine: each worker finds those of its own stretch of ranks.
 *
 * They are the numbers of tn_ranks_sample. To know where drawing ends, all are drawn once (tn_draws_count), in as many
 * rounds as memory asks for; a stretch then needs no more memory than its own numbers take.
 */
#ifndef TARTAN_PLAN_LIBRARY_SAMPLE_H
#define TARTAN_PLAN_LIBRARY_SAMPLE_H

#include <gmp.h>

#include "runtime/base/error.h"
#include "runtime/base/watch.h"

typedef struct tn_draws {
    uint64_t seed, stream;
    mpz_srcptr bound;  /* borrowed */
    uint64_t wanted;   /* at most the bound */
    uint64_t attempts; /* how many drawing takes: filled by tn_draws_count */
} tn_draws;

/* Fills attempts, and how many numbers are wanted of each share: those from bounds[i] on, before bounds[i + 1]; bounds
 * ascend from 0 to the bound. memory: bytes that a round may take for numbers. The result does not depend on it.
 * TN_MEMORY, TN_STOPPED. */
tn_status tn_draws_count(tn_draws *draws, const mpz_t *bounds, uint32_t shares, uint64_t *counts, size_t memory,
                         tn_watch *watch, tn_error *error);

/* The numbers of a stretch, ascending; free them by tn_integers_free. TN_MEMORY, TN_STOPPED. */
tn_status tn_draws_between(const tn_draws *draws, const mpz_t from, const mpz_t to, mpz_t **ranks, size_t *count,
                           tn_watch *watch, tn_error *error);

#endif
