/* Claims shards, writes them, and waits for those that others write. */
#include "driver/shards/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "driver/plan/made.h"
#include "driver/shards/claim.h"
#include "driver/shards/hash.h"
#include "driver/shards/record.h"
#include "driver/shards/write.h"
#include "runtime/base/crew.h"
#include "runtime/base/watch.h"

#define WAIT_FIRST 0.05 /* seconds until it is looked again whether others are done */
#define WAIT_MOST 2.0   /* and at most */

/* Why a thread could not go on. */
typedef struct failure {
    uint32_t shard;
    tn_status status; /* TN_OK: it could */
    tn_error error;
} failure;

typedef struct running {
    const tn_shards_job *job;
    const tn_made *made;
    mpz_t ranks;      /* how many the library has */
    tn_claimant self; /* this process */
    double start;
    bool *done;        /* [shards]: known to be there; each is written by the thread that has the shard */
    failure *failures; /* [threads] */
    atomic_uint next;  /* the first shard that no thread has looked at in this pass, where there is one rank */
    atomic_uint written;
    _Atomic uint64_t unread; /* plans */
    atomic_uint held;        /* by others, in this pass */
    atomic_bool failed;      /* no further shard is begun here */
    atomic_bool out_of_time, ended;
    _Atomic double longest; /* seconds that a shard took */
} running;

/* ---- one shard */

/* The file of a shard, whose bytes `written` sees; `read` is filled for answers. */
static tn_status write_file(const running *run, uint32_t shard, tn_claim *claim, const tn_seen_bytes *written,
                            tn_shard_read *read, tn_error *error)
{
    const tn_shards_job *job = run->job;
    const tn_shard_writing_now now = {shard, claim, job->stale, job->watch, written};
    return tn_shard_set_answers(job->set)
               ? tn_shard_answer(job->set, job->answering, &now, read, error)
               : tn_shard_enumerate(job->set, job->ready, &run->made->metadata, run->ranks, &now, error);
}

/* A shard, and its record. It is hashed while it is written, so that it need not be read again. */
static tn_status write_shard(running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    bool answers = tn_shard_set_answers(run->job->set);
    tn_shard_read *read = answers ? calloc(1, sizeof *read) : NULL;
    tn_hashing *hashing = tn_hashing_new();
    tn_shard_record record = {0};
    tn_status status = hashing && (read || !answers) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        const tn_seen_bytes written = tn_hashing_seen(hashing);
        status = write_file(run, shard, claim, &written, read, error);
        tn_hashing_end(hashing, record.hash, &record.bytes);
    }
    if (status == TN_OK)
        status = tn_shard_record_write(run->job->set, shard, &record, read, error);
    if (status == TN_OK && read)
        run->unread += read->unread;
    tn_hashing_free(hashing);
    free(read);
    return status;
}

/* Is nothing there but a file, which a shard and its record replace? What a link leads to may belong to another set. */
static tn_status check_place(const tn_shard_set *set, uint32_t shard, const char *ending, tn_error *error)
{
    struct stat known;
    char *path = tn_shard_path(set, shard, ending);
    tn_status status = path ? TN_OK : tn_fail_memory(error);
    if (path && lstat(path, &known) == 0 && !S_ISREG(known.st_mode))
        status = tn_shard_wrong(set, shard, error, "cannot be written: %s is there, and is no regular file",
                                *ending ? "a " TN_SHARD_RECORD : "something");
    free(path);
    return status;
}

/* A shard that is claimed. One that is there without its record is written again: its worker was killed between the
 * two, or it came from elsewhere. */
static tn_status finish_shard(running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    double begun = tn_seconds();
    if (tn_shard_recorded(run->job->set, shard)) /* by another, while it was being claimed */
        return tn_shard_done(run->job->set, shard, error);
    tn_status status = check_place(run->job->set, shard, "", error);
    if (status == TN_OK)
        status = check_place(run->job->set, shard, TN_SHARD_RECORD, error);
    if (status == TN_OK)
        status = write_shard(run, shard, claim, error);
    if (status == TN_OK) {
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
    bool recorded = tn_shard_recorded(job->set, shard), taken = recorded;
    tn_status status = path ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && recorded)
        status = tn_shard_done(job->set, shard, error);
    else if (status == TN_OK)
        status = tn_claim_take(path, &run->self, job->stale, &claim, &taken, error);
    if (status == TN_OK && recorded)
        unlink(path); /* left by a worker that was killed behind its last step */
    else if (status == TN_OK && taken)
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
    (void)thread, (void)error;
    running *run = context;
    failure *mine = &run->failures[item];
    uint32_t count = run->job->end - run->job->begin;
    *mine = (failure){.status = TN_OK};
    while (mine->status == TN_OK && goes_on(run)) {
        uint64_t taken = take(run);
        if (taken >= count)
            break;
        mine->shard = (uint32_t)taken;
        mine->status = tn_watch_check(run->job->watch, &mine->error);
        if (mine->status == TN_OK)
            mine->status = do_shard(run, run->job->begin + mine->shard, &mine->error);
        tn_watch_tell(run->job->watch, (double)taken + 1, count);
    }
    if (run->ended && tn_ranks_several(run->job->ranks))
        run->job->ranks->take(run->job->ranks->context, count); /* the others begin none either */
    if (mine->status != TN_OK)
        run->failed = true;
    return TN_OK;
}

/* The failure of the first shard that has one, whichever thread came to its end first: shards are taken in order, and
 * what is taken is tried, so this is the same in every run. */
static tn_status first_failure(const running *run, unsigned threads, tn_error *error)
{
    const failure *first = NULL;
    for (const failure *f = run->failures; f < run->failures + threads; f++)
        if (f->status != TN_OK && (!first || f->shard < first->shard))
            first = f;
    if (first && error)
        *error = first->error;
    return first ? first->status : TN_OK;
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
    uint64_t unread;
    bool failed, out_of_time, ended;
} passed;

/* Together: how the pass went for all of them. Where a rank came to its end by `last` or its time, all do. */
static passed all_passed(const running *run)
{
    const tn_ranks *ranks = run->job->ranks;
    passed sum = {run->held, run->written, run->unread, run->failed, run->out_of_time, run->ended}, one;
    if (!tn_ranks_several(ranks))
        return sum;
    tn_gathered all;
    ranks->gather(ranks->context, &sum, sizeof sum, &all);
    sum = (passed){0};
    for (unsigned r = 0; r < ranks->count; r++) {
        memcpy(&one, all.bytes + all.begins[r], sizeof one);
        sum.held += one.held;
        sum.written += one.written;
        sum.unread += one.unread;
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
    if (status == TN_OK)
        status = first_failure(run, tn_crew_threads(crew), error);
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

static bool is_done(const tn_shard_set *set, uint32_t shard)
{
    return tn_shard_recorded(set, shard) && tn_shard_done(set, shard, NULL) == TN_OK;
}

static uint32_t count_left(const running *run)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < run->job->end - run->job->begin; i++)
        left += !run->done[i] && !is_done(run->job->set, run->job->begin + i);
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
    bool answers = tn_shard_set_answers(job->set);
    if (!answers)
        tn_made_describe(job->opened, job->ready, job->set->rules_path, NULL, &made);
    running run = {.job = job,
                   .made = &made,
                   .self = tn_claimant_self(),
                   .start = tn_seconds(),
                   .done = calloc(count + 1, sizeof *run.done)};
    mpz_init(run.ranks);
    if (!answers)
        tn_library_kept(job->ready->library, TN_ALL_LENGTHS, run.ranks);
    tn_crew *crew = tn_crew_new(job->threads, NULL);
    run.failures = crew ? calloc(tn_crew_threads(crew), sizeof *run.failures) : NULL;
    tn_status status = tn_ranks_agree(job->ranks, run.done && run.failures ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = run_all(&run, crew, &now, error);
    *done = (tn_shards_done){
        .written = now.written, .unread = now.unread, .out_of_time = now.out_of_time, .ended = now.ended};
    if (run.done && tn_ranks_lead(job->ranks)) {
        done->left = count_left(&run);
        if (status == TN_OK)
            status = see_all(&run, &now, done->left, error);
    }
    tn_crew_free(crew);
    mpz_clear(run.ranks);
    free(run.failures);
    free(run.done);
    return tn_ranks_agree(job->ranks, status, error);
}
