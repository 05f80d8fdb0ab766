/* Writes a shard of enumerated plans. */
#include <stdlib.h>
#include <string.h>

#include "driver/plan/made.h"
#include "driver/shards/write.h"
#include "runtime/base/integers.h"

#define LOOK_EVERY 4096u /* plans between looks at the clock and for interruptions */

static char *words_of(const tn_shard_set *set, uint32_t shard)
{
    if (set->task == TN_TASK_SAMPLE)
        return strdup(set->command);
    char *from = mpz_get_str(NULL, 10, set->bounds[shard]), *to = mpz_get_str(NULL, 10, set->bounds[shard + 1]);
    const tn_enumerated asked = {.from = from,
                                 .to = to,
                                 .trays_given = set->options.override_trays,
                                 .trays_min = set->options.trays_min,
                                 .trays_max = set->options.trays_max};
    char *words = from && to ? tn_enumerated_words(&asked) : NULL;
    free(from);
    free(to);
    return words;
}

static tn_status write_sampled(const tn_shard_set *set, const tn_ready_library *ready, mpz_srcptr ranks,
                               const tn_shard_writing_now *now, tn_plan_writer *writer, tn_error *error)
{
    mpz_t *sampled;
    size_t count;
    tn_tray *trays = malloc(((size_t)tn_library_max(ready->library) + 1) * sizeof *trays);
    tn_status status = tn_shard_sampled(set, ranks, now->shard, &sampled, &count, now->watch, error);
    if (status == TN_OK && !trays)
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t length;
        status = tn_library_unrank(ready->library, sampled[i], trays, &length)
                     ? tn_plan_writer_write(writer, sampled[i], trays, length, error)
                     : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a sampled rank is not in the library");
        if (status == TN_OK && (i + 1) % LOOK_EVERY == 0) {
            tn_claim_touch(now->claim, now->stale);
            status = tn_watch_check(now->watch, error);
        }
    }
    tn_integers_free(sampled, count);
    free(trays);
    return status;
}

static tn_status write_plans(const tn_shard_set *set, const tn_ready_library *ready, const tn_shard_writing_now *now,
                             tn_plan_writer *writer, tn_error *error)
{
    uint32_t shard = now->shard;
    tn_cursor *cursor;
    const tn_tray *trays;
    uint32_t length;
    size_t seen = 0;
    tn_status status = tn_cursor_new(ready->library, set->bounds[shard], set->bounds[shard + 1], &cursor, error);
    if (status != TN_OK)
        return status;
    mpz_t rank;
    mpz_init_set(rank, set->bounds[shard]);
    while (status == TN_OK && tn_cursor_next(cursor, &trays, &length)) {
        status = tn_plan_writer_write(writer, rank, trays, length, error);
        mpz_add_ui(rank, rank, 1);
        if (status == TN_OK && ++seen % LOOK_EVERY == 0) {
            tn_claim_touch(now->claim, now->stale);
            status = tn_watch_check(now->watch, error);
        }
    }
    mpz_clear(rank);
    tn_cursor_free(cursor);
    return status;
}

tn_status tn_shard_enumerate(const tn_shard_set *set, const tn_ready_library *ready, const tn_plan_metadata *metadata,
                             mpz_srcptr ranks, const tn_shard_writing_now *now, tn_error *error)
{
    char *path = tn_shard_path(set, now->shard, ""), *words = words_of(set, now->shard);
    tn_plan_writer *writer = NULL;
    tn_writer_options options = tn_shard_writing(set, metadata, ranks);
    options.metadata.command = words;
    options.written = now->written;
    tn_status status =
        path && words ? tn_plan_writer_open(ready->schema, path, &options, &writer, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = set->task == TN_TASK_SAMPLE ? write_sampled(set, ready, ranks, now, writer, error)
                                             : write_plans(set, ready, now, writer, error);
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    free(path);
    free(words);
    return status;
}
