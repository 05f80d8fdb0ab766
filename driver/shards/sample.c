/* Shard sets that hold a sample. */
#include <stdlib.h>

#include "driver/shards/set.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/library/sample.h"

static tn_draws draws_of(const tn_shard_set *set, mpz_srcptr all)
{
    return (tn_draws){.seed = set->sample.seed,
                      .stream = TN_ALL_LENGTHS,
                      .bound = all,
                      .wanted = set->sample.plans,
                      .attempts = set->sample.attempts};
}

tn_status tn_shard_set_sample(tn_shard_set *set, const mpz_t all, uint64_t plans, uint64_t seed, size_t memory,
                              tn_watch *watch, tn_error *error)
{
    set->task = TN_TASK_SAMPLE;
    set->sample.seed = seed;
    set->sample.plans = mpz_cmp_ui(all, plans) < 0 ? mpz_get_ui(all) : plans;
    set->sample.of = calloc((size_t)set->count + 1, sizeof *set->sample.of);
    tn_draws draws = draws_of(set, all);
    tn_status status = set->sample.of ? tn_draws_count(&draws, (const mpz_t *)set->bounds, set->count, set->sample.of,
                                                       memory, watch, error)
                                      : tn_fail_memory(error);
    set->sample.attempts = draws.attempts;
    return status;
}

tn_status tn_shard_sampled(const tn_shard_set *set, const mpz_t all, uint32_t shard, mpz_t **ranks, size_t *count,
                           tn_watch *watch, tn_error *error)
{
    const tn_draws draws = draws_of(set, all);
    return tn_draws_between(&draws, set->bounds[shard], set->bounds[shard + 1], ranks, count, watch, error);
}
