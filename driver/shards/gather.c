/* Writes the plans of all shards into one file. */
#include "driver/shards/gather.h"

#include <stdlib.h>

#include "driver/plan/made.h"
#include "driver/shards/check.h"
#include "driver/shards/record.h"
#include "runtime/plan/store/sqlite.h"

/* The rank of a plan that is in the library. */
static tn_status rank_of(const tn_gathering *g, uint32_t shard, const tn_plan *plan, mpz_t rank, tn_error *error)
{
    return tn_library_rank(g->ready->library, plan->trays, plan->length, rank)
               ? TN_OK
               : tn_shard_wrong(g->set, shard, error, "has a plan that the library does not have");
}

/* Reads a shard's plans and writes them, with their ranks. */
static tn_status rewrite_shard(const tn_gathering *g, const char *path, uint32_t shard, tn_plan_writer *writer,
                               tn_error *error)
{
    const tn_reader_options options = tn_shard_reading(g->set, g->ready->library);
    tn_plan_reader *reader;
    const tn_plan *plan;
    size_t seen = 0;
    bool sampled = g->set->task == TN_TASK_SAMPLE;
    mpz_t rank, plans;
    tn_status status = tn_plan_reader_open(g->ready->schema, path, &options, &reader, error);
    if (status != TN_OK)
        return status;
    mpz_init_set(rank, g->set->bounds[shard]);
    mpz_init(plans);
    while (status == TN_OK && (status = tn_plan_reader_next(reader, &plan, error)) == TN_OK && plan) {
        if (sampled)
            status = rank_of(g, shard, plan, rank, error);
        if (status == TN_OK)
            status = tn_plan_writer_write(writer, rank, plan->trays, plan->length, error);
        mpz_add_ui(rank, rank, 1);
        if (status == TN_OK && tn_watch_stopped_at(g->watch, ++seen))
            status = tn_fail_stopped(g->watch, error);
    }
    tn_shard_plans(g->set, shard, plans);
    bool whole = mpz_cmp_ui(plans, seen) == 0;
    mpz_clears(rank, plans, NULL);
    tn_plan_reader_free(reader);
    return status == TN_OK && !whole ? tn_shard_wrong(g->set, shard, error, "does not have the plans of its ranks")
                                     : status;
}

/* Files of most formats can be put behind one another. */
static bool is_copied(const tn_gathering *g)
{
    return g->format == g->set->format && !g->set->compressed && g->format != TN_FORMAT_PARQUET;
}

static tn_status gather_shard(const tn_gathering *g, uint32_t shard, tn_plan_writer *writer, tn_error *error)
{
    char *path = tn_shard_path(g->set, shard, "");
    tn_status status = path ? tn_watch_check(g->watch, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_shard_same_as_record(g->set, shard, error);
    if (status == TN_OK)
        status =
            is_copied(g) ? tn_plan_writer_append(writer, path, error) : rewrite_shard(g, path, shard, writer, error);
    tn_watch_tell(g->watch, shard + 1, g->set->count);
    free(path);
    return status;
}

static tn_status gather_plans(const tn_gathering *g, tn_error *error)
{
    tn_made made;
    tn_plan_writer *writer = NULL;
    tn_made_describe(g->opened, g->ready, g->set->rules_path, g->set->command, &made);
    mpz_t ranks;
    mpz_init(ranks);
    tn_library_kept(g->ready->library, TN_ALL_LENGTHS, ranks);
    tn_writer_options options = tn_shard_writing(g->set, &made.metadata, ranks);
    options.format = g->format;
    options.compression = NULL;
    options.sqlite = tn_plan_sqlite();
    tn_status status = tn_plan_writer_open(g->ready->schema, g->output, &options, &writer, error);
    for (uint32_t i = 0; status == TN_OK && i < g->set->count; i++)
        status = gather_shard(g, i, writer, error);
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    mpz_clear(ranks);
    return status;
}

tn_status tn_shards_gather(const tn_gathering *g, tn_error *error)
{
    tn_status status = tn_shards_complete(g->set, error);
    for (uint32_t i = 0; status == TN_OK && i < g->set->count; i++) /* before anything is written */
        status = tn_shard_done(g->set, i, error);
    if (status != TN_OK)
        return status;
    return tn_shard_set_answers(g->set) ? tn_shards_gather_answers(g, error) : gather_plans(g, error);
}
