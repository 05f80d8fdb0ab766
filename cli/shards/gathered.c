/* tartan shards cat, merge: all shards as one file. */
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/shards/shards.h"
#include "driver/shards/gather.h"

static void gather(tn_job *job, tn_shards_open *open, const char *output, tn_plan_format format)
{
    const tn_gathering gathering = {&open->set, &job->opened,          &open->ready, output ? output : "-",
                                    format,     tn_interrupt_waiting()};
    tn_progress progress;
    tn_error error;
    tn_progress_watch(&progress, "shards read", gathering.watch);
    tn_status status = tn_shards_gather(&gathering, &error);
    tn_progress_unwatch(&progress, gathering.watch);
    if (status != TN_OK)
        tn_job_fail(job, &error);
}

/* What the shards hold is written as it is. */
static tn_file_formats format_of(const tn_shard_set *set)
{
    static const tn_file_formats formats[TN_FORMAT_COUNT] = {[TN_FORMAT_LINES] = TN_WRITES_TEXT,
                                                             [TN_FORMAT_JSON] = TN_WRITES(JSON),
                                                             [TN_FORMAT_CSV] = TN_WRITES(CSV),
                                                             [TN_FORMAT_BIN] = TN_WRITES(BIN),
                                                             [TN_FORMAT_PARQUET] = TN_WRITES(PARQUET)};
    if (tn_shard_set_answers(set))
        return TN_WRITES_TEXT | (set->inputs.answer == TN_ANSWER_JSON ? TN_WRITES(JSON) : 0);
    return TN_WRITES_TEXT | formats[set->format];
}

void tn_shards_cat(tn_job *job, tn_shards_open *open)
{
    const char *output = tn_shards_settings_of(job)->written.output;
    if (tn_job_writes(job, "what this set holds", output, format_of(&open->set)))
        gather(job, open, output, open->set.format);
}

void tn_shards_merge(tn_job *job, tn_shards_open *open)
{
    const char *output = tn_shards_settings_of(job)->written.output;
    if (tn_shard_set_answers(&open->set))
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "the shards hold answers, of which no database is made"),
                "`tartan shards cat SET -o FILE` writes all of them");
    else if (output && strcmp(output, "-") != 0) {
        if (tn_job_writes(job, "a database", output, TN_WRITES(SQLITE) | TN_WRITES_ASKED))
            gather(job, open, output, TN_FORMAT_SQLITE);
    } else
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "a database is a file, and none is named"),
                "name it: -o FILE.sqlite; `tartan shards cat` writes to standard output");
}
