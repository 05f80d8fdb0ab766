/* tartan shards run: writes the shards that are not there yet. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/shards/shards.h"
#include "driver/shards/run.h"

/* Reads I/N of --part: 1 <= I <= N. */
static bool read_part(const char *text, uint64_t *part, uint64_t *parts)
{
    char first[24];
    size_t digits = strcspn(text, "/");
    if (text[digits] != '/' || digits >= sizeof first)
        return false;
    memcpy(first, text, digits);
    first[digits] = '\0';
    return tn_number_read(first, part) && tn_number_read(text + digits + 1, parts) && *part >= 1 && *part <= *parts &&
           *parts <= UINT32_MAX;
}

/* Which shards: all, one, or one of several equal parts. */
static bool choose_shards(tn_job *job, tn_shards_job *work)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    uint64_t part = 1, parts = 1, count = work->set->count;
    tn_diagnostic *d = NULL;
    if (settings->shard.given && settings->part)
        d = tn_job_usage(job, "--shard and --part cannot be given together");
    else if (settings->shard.given && settings->shard.value >= count)
        tn_help(tn_job_diagnostics(job), d = tn_job_usage(job, "there is no shard %" PRIu64, settings->shard.value),
                "the shards are 0 to %" PRIu64, count - 1);
    else if (settings->part && !read_part(settings->part, &part, &parts))
        tn_help(tn_job_diagnostics(job), d = tn_job_usage(job, "--part needs I/N, not `%.60s`", settings->part),
                "the first of four parts is 1/4, the last 4/4");
    bool one = settings->shard.given;
    work->begin = one ? (uint32_t)settings->shard.value : (uint32_t)(count * (part - 1) / parts);
    work->end = one ? work->begin + 1 : (uint32_t)(count * part / parts);
    return !d;
}

static bool choose_time(tn_job *job, tn_shards_job *work)
{
    const char *text = tn_shards_settings_of(job)->time;
    if (!tn_shards_stale(job, &work->stale))
        return false;
    if (!text || tn_time_read(text, &work->seconds))
        return true;
    tn_help(tn_job_diagnostics(job), tn_job_usage(job, "--for needs a time, not `%.60s`", text),
            "write 90s, 55m or 2h");
    return false;
}

static void tell(tn_job *job, const tn_shards_done *done)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    const char *plural = done->written == 1 ? "" : "s",
               *asked = settings->part || settings->shard.given ? " that were asked for" : "";
    if (done->unread > 0)
        tn_job_status(job, TN_INVALID);
    job->said = true; /* also on ranks that leave it to the first */
    if (!tn_ranks_lead(job->settings->ranks))
        return;
    if (job->stopped)
        tn_job_interrupted(job, "interrupted; %u shard%s written, %u to go: `tartan shards run` goes on with them",
                           done->written, plural, done->left);
    else if (done->left > 0)
        tn_job_note(job, "%u shard%s written, %u to go%s", done->written, plural, done->left,
                    done->ended         ? ": a signal asked for the end; `tartan shards run` goes on with them"
                    : done->out_of_time ? ": time is up"
                                        : "");
    else if (done->written == 0)
        tn_job_note(job, "all shards%s are there already", asked);
    else
        tn_job_note(job, "%u shard%s written; all%s are there", done->written, plural, asked);
    if (done->unread > 0)
        tn_job_note(job, "%" PRIu64 " plan%s could not be read; `tartan shards status` lists them", done->unread,
                    done->unread == 1 ? "" : "s");
}

/* Do all ranks work on the same set? */
static bool same_set(tn_job *job, const tn_shard_set *set)
{
    tn_error error;
    if (tn_ranks_same(job->settings->ranks, "the shard set", set->hash, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

void tn_shards_run_set(tn_job *job, tn_shards_open *open)
{
    const tn_ranks *ranks = job->settings->ranks;
    tn_shards_job work = {.set = &open->set,
                          .opened = &job->opened,
                          .ready = &open->ready,
                          .answering = &open->answering,
                          .threads = tn_shards_threads(job),
                          .watch = tn_interrupt_waiting(),
                          .last = tn_interrupt_gently(ranks != NULL, false),
                          .ranks = ranks};
    tn_progress progress;
    tn_shards_done done;
    tn_error error;
    if (!choose_shards(job, &work) || !choose_time(job, &work) || !same_set(job, &open->set))
        return;
    tn_interrupt_last_words("interrupted; shards are there whole or not at all: `tartan shards run` goes on");
    tn_progress_begin(&progress, "shards", 0, 0);
    if (tn_ranks_lead(ranks))
        tn_progress_watch(&progress, "shards", work.watch);
    tn_status status = tn_shards_run(&work, &done, &error);
    if (tn_ranks_lead(ranks))
        tn_progress_unwatch(&progress, work.watch);
    if (status == TN_STOPPED)
        tn_interrupt_answered();
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tell(job, &done);
}
