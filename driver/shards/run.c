/* Claims shards, writes them, and waits for those that others write. */
#include "driver/shards/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "driver/plan/made.h"
#include "driver/shards/claim.h"
#include "driver/shards/hash.h"
#include "driver/shards/record.h"
#include "runtime/base/crew.h"

#define LOOK_EVERY 4096u /* plans between looks at the clock and for interruptions */
#define WAIT_FIRST 0.05  /* seconds until it is looked again whether others are done */
#define WAIT_MOST 2.0    /* and at most */

typedef struct running {
    const tn_shards_job *job;
    const tn_made *made;
    mpz_t ranks;      /* how many the library has */
    tn_claimant self; /* this process */
    double start;
    bool *done;       /* [shards]: known to be there; each is written by the thread that has the shard */
    atomic_uint next; /* the first shard that no thread has looked at in this pass, where there is one rank */
    atomic_uint written;
    atomic_uint held;   /* by others, in this pass */
    atomic_bool failed; /* no further shard is begun here */
    atomic_bool out_of_time, ended;
    _Atomic double longest; /* seconds that a shard took */
} running;

/* ---- one shard */

static char *words_of(const tn_shard_set *set, uint32_t shard)
{
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

static tn_status write_plans(const running *run, uint32_t shard, tn_claim *claim, tn_plan_writer *writer,
                             tn_error *error)
{
    const tn_shard_set *set = run->job->set;
    tn_cursor *cursor;
    const tn_tray *trays;
    uint32_t length;
    size_t seen = 0;
    tn_status status =
        tn_cursor_new(run->job->ready->library, set->bounds[shard], set->bounds[shard + 1], &cursor, error);
    if (status != TN_OK)
        return status;
    mpz_t rank;
    mpz_init_set(rank, set->bounds[shard]);
    while (status == TN_OK && tn_cursor_next(cursor, &trays, &length)) {
        status = tn_plan_writer_write(writer, rank, trays, length, error);
        mpz_add_ui(rank, rank, 1);
        if (status == TN_OK && ++seen % LOOK_EVERY == 0) {
            tn_claim_touch(claim, run->job->stale);
            status = tn_watch_check(run->job->watch, error);
        }
    }
    mpz_clear(rank);
    tn_cursor_free(cursor);
    return status;
}

/* The file of a shard, whose bytes `written` sees. */
static tn_status write_file(const running *run, uint32_t shard, tn_claim *claim, const tn_seen_bytes *written,
                            tn_error *error)
{
    const tn_shard_set *set = run->job->set;
    char *path = tn_shard_path(set, shard, ""), *words = words_of(set, shard);
    tn_plan_writer *writer = NULL;
    tn_writer_options options = tn_shard_writing(set, &run->made->metadata, run->ranks);
    options.metadata.command = words;
    options.written = written;
    tn_status status = path && words ? tn_plan_writer_open(run->job->ready->schema, path, &options, &writer, error)
                                     : tn_fail_memory(error);
    if (status == TN_OK)
        status = write_plans(run, shard, claim, writer, error);
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    free(path);
    free(words);
    return status;
}

/* A shard, and its record. It is hashed while it is written, so that it need not be read again. */
static tn_status write_shard(const running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    tn_hashing *hashing = tn_hashing_new();
    if (!hashing)
        return tn_fail_memory(error);
    tn_shard_record record;
    const tn_seen_bytes written = tn_hashing_seen(hashing);
    tn_status status = write_file(run, shard, claim, &written, error);
    tn_hashing_end(hashing, record.hash, &record.bytes);
    tn_hashing_free(hashing);
    return status == TN_OK ? tn_shard_record_write(run->job->set, shard, &record, error) : status;
}

/* A shard that is there without its record: whoever wrote it was killed between the two. */
static tn_status record_shard(const tn_shards_job *job, uint32_t shard, tn_error *error)
{
    tn_status status = tn_shard_read_through(job->set, job->ready, shard, job->watch, error);
    return status == TN_OK ? tn_shard_record_make(job->set, shard, error) : status;
}

/* What lacks of a claimed shard: the shard, or only its record. */
static tn_status finish_shard(running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    const tn_shards_job *job = run->job;
    double begun = tn_seconds();
    bool exists = tn_shard_exists(job->set, shard);
    if (exists && tn_shard_done(job->set, shard)) /* by another, while it was being claimed */
        return TN_OK;
    tn_status status = exists ? record_shard(job, shard, error) : write_shard(run, shard, claim, error);
    if (status == TN_OK && !exists) {
        run->written++;
        run->longest = fmax(run->longest, tn_seconds() - begun);
    }
    return status;
}

static tn_status do_shard(running *run, uint32_t shard, tn_error *error)
{
    const tn_shards_job *job = run->job;
    if (run->done[shard - job->begin])
        return TN_OK;
    char *path = tn_shard_path(job->set, shard, TN_SHARD_CLAIM);
    tn_claim claim = {0};
    bool done = tn_shard_done(job->set, shard), taken = done;
    tn_status status = path ? TN_OK : tn_fail_memory(error);
    if (path && done)
        unlink(path); /* left by a worker that was killed behind its last step */
    else if (path)
        status = tn_claim_take(path, &run->self, job->stale, &claim, &taken, error);
    if (status == TN_OK && taken && !done)
        status = finish_shard(run, shard, &claim, error);
    run->done[shard - job->begin] = status == TN_OK && taken;
    run->held += !taken;
    tn_claim_release(&claim);
    free(path);
    return status;
}

/* ---- all of them */

/* May another shard be begun? It is not where it would likely end too late. */
static bool goes_on(running *run)
{
    double used = tn_seconds() - run->start, allowed = run->job->seconds;
    if (allowed > 0 && used + run->longest > allowed)
        run->out_of_time = true;
    if (run->job->last && atomic_load(run->job->last))
        run->ended = true;
    return !run->failed && !run->out_of_time && !run->ended;
}

/* The next shard that nobody has taken in this pass, counted from the first that is asked for. */
static uint64_t take(running *run)
{
    const tn_ranks *ranks = run->job->ranks;
    return tn_ranks_several(ranks) ? ranks->take(ranks->context, 1) : run->next++;
}

/* One thread's part of a pass over the shards. */
static tn_status work(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread, (void)item;
    running *run = context;
    uint32_t count = run->job->end - run->job->begin;
    tn_status status = TN_OK;
    while (status == TN_OK && goes_on(run)) {
        uint64_t taken = take(run);
        if (taken >= count)
            break;
        status = tn_watch_check(run->job->watch, error);
        if (status == TN_OK)
            status = do_shard(run, run->job->begin + (uint32_t)taken, error);
        tn_watch_tell(run->job->watch, (double)taken + 1, count);
    }
    if (run->ended && tn_ranks_several(run->job->ranks))
        run->job->ranks->take(run->job->ranks->context, count); /* the others begin none either */
    if (status != TN_OK)
        run->failed = true;
    return status;
}

static tn_status wait_a_little(const running *run, double *seconds, tn_error *error)
{
    double until = tn_seconds() + *seconds;
    tn_status status = TN_OK;
    while (status == TN_OK && tn_seconds() < until) {
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
        status = tn_watch_check(run->job->watch, error);
    }
    *seconds = fmin(2 * *seconds, WAIT_MOST);
    return status;
}

/* What ranks tell each other behind a pass. */
typedef struct passed {
    uint32_t held, written;
    bool failed, out_of_time, ended;
} passed;

/* Together: how the pass went for all of them. Where a rank came to its end by `last` or its time, all do. */
static passed all_passed(const running *run)
{
    const tn_ranks *ranks = run->job->ranks;
    passed sum = {run->held, run->written, run->failed, run->out_of_time, run->ended}, one;
    if (!tn_ranks_several(ranks))
        return sum;
    tn_gathered all;
    ranks->gather(ranks->context, &sum, sizeof sum, &all);
    sum = (passed){0};
    for (unsigned r = 0; r < ranks->count; r++) {
        memcpy(&one, all.bytes + all.begins[r], sizeof one);
        sum.held += one.held;
        sum.written += one.written;
        sum.failed |= one.failed;
        sum.out_of_time |= one.out_of_time;
        sum.ended |= one.ended;
    }
    tn_gathered_clear(&all);
    return sum;
}

static tn_status pass(running *run, tn_crew *crew, passed *now, tn_error *error)
{
    const tn_ranks *ranks = run->job->ranks;
    run->next = 0;
    run->held = 0;
    if (tn_ranks_several(ranks))
        ranks->restart(ranks->context);
    tn_status status = tn_crew_run(crew, tn_crew_threads(crew), 1, work, run, error);
    *now = all_passed(run);
    return status;
}

/* Passes until no shard is held by others, together. */
static tn_status run_all(running *run, tn_crew *crew, passed *now, tn_error *error)
{
    double seconds = WAIT_FIRST;
    tn_status status = pass(run, crew, now, error);
    while (now->held > 0 && !now->failed && !now->out_of_time && !now->ended) {
        status = wait_a_little(run, &seconds, error);
        run->failed |= status != TN_OK;
        tn_error later;
        tn_status again = pass(run, crew, now, &later);
        if (status == TN_OK && again != TN_OK)
            *error = later;
        status = status == TN_OK ? again : status;
    }
    return tn_ranks_agree(run->job->ranks, status, error);
}

static uint32_t count_left(const running *run)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < run->job->end - run->job->begin; i++)
        left += !run->done[i] && !tn_shard_done(run->job->set, run->job->begin + i);
    return left;
}

/* Does rank 0 see what the others wrote? They come to an end without failure only where all shards are there. */
static tn_status see_all(const running *run, const passed *now, uint32_t left, tn_error *error)
{
    const tn_shards_job *job = run->job;
    if (!tn_ranks_several(job->ranks) || left == 0 || now->out_of_time || now->ended)
        return TN_OK;
    tn_fail(error, TN_IO, E_RANKS_APART, "rank 0 on %.60s does not see %u shards of %.200s that other ranks wrote",
            job->ranks->host, left, job->set->folder);
    tn_error_help(error, "keep the set in a folder that all machines share");
    return TN_IO;
}

tn_status tn_shards_run(const tn_shards_job *job, tn_shards_done *done, tn_error *error)
{
    uint32_t count = job->end - job->begin;
    passed now = {0};
    tn_made made;
    tn_made_describe(job->opened, job->ready, job->set->rules_path, NULL, &made);
    running run = {.job = job,
                   .made = &made,
                   .self = tn_claimant_self(),
                   .start = tn_seconds(),
                   .done = calloc(count + 1, sizeof *run.done)};
    mpz_init(run.ranks);
    tn_library_kept(job->ready->library, TN_ALL_LENGTHS, run.ranks);
    tn_crew *crew = tn_crew_new(job->threads, NULL);
    tn_status status = tn_ranks_agree(job->ranks, run.done && crew ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = run_all(&run, crew, &now, error);
    *done = (tn_shards_done){.written = now.written, .out_of_time = now.out_of_time, .ended = now.ended};
    if (run.done && tn_ranks_lead(job->ranks)) {
        done->left = count_left(&run);
        if (status == TN_OK)
            status = see_all(&run, &now, done->left, error);
    }
    tn_crew_free(crew);
    mpz_clear(run.ranks);
    free(run.done);
    return tn_ranks_agree(job->ranks, status, error);
}
