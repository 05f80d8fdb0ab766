/* Opens the files of plans that a command line names. */
#include "cli/plan/plan_input.h"

#include <inttypes.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "cli/plan/library_job.h"
#include "driver/open/missing.h"
#include "driver/parquet/parquet.h"
#include "driver/zstd/zstd.h"
#include "runtime/plan/store/sqlite.h"

const char *tn_job_plans_path(tn_job *job)
{
    const tn_option_list *operands = &job->settings->operands;
    const char *path = operands->count > 1 ? operands->items[1] : "-";
    if (strcmp(path, "-") == 0 && strcmp(operands->items[0], "-") == 0) {
        tn_job_usage(job, "the rules and the plans cannot both come from standard input");
        return NULL;
    }
    return path;
}

bool tn_job_reader(tn_job *job, const tn_schema *schema, const tn_plans_source *source, tn_plan_reader **reader)
{
    tn_reader_options options = {.format = (tn_plan_format)source->input->format,
                                 .max_length = tn_job_max_length(source->plans),
                                 .sqlite = tn_plan_sqlite(),
                                 .parquet = tn_plan_parquet_calls(),
                                 .compression = tn_plan_zstd()};
    tn_error error;
    if (tn_plan_reader_open(schema, source->path, &options, reader, &error) == TN_OK)
        return true;
    if (error.status == TN_IO && strchr(source->path, '|')) /* no file, but a plan */
        tn_error_help(&error, "a plan itself is given to standard input: `echo \"PLAN\" | tartan %s FILE`",
                      job->settings->command->name);
    else
        tn_suggest_file(source->path, &error);
    tn_job_fail(job, &error);
    return false;
}

bool tn_job_bad_plan(tn_job *job, const tn_plans_source *source, const tn_error *error, const char *text, size_t size)
{
    const char *path = source->path;
    tn_report_error(tn_job_diagnostics(job), error, strcmp(path, "-") == 0 ? "standard input" : path, text, size);
    tn_job_status(job, error->status);
    return source->input->on_error == 1 && error->status != TN_MEMORY && error->status != TN_INTERNAL;
}

static bool describe(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const tn_sifting *s = context;
    return s->answering->plan(s->answering->context, plan, texts);
}

static bool write_texts(void *context, uint64_t plans, const tn_buffer texts[TN_RELAY_TEXTS])
{
    tn_sifting *s = context;
    bool written = true;
    for (size_t t = 0; t < TN_RELAY_TEXTS && written; t++)
        written = texts[t].size == 0 || fwrite(texts[t].data, 1, texts[t].size, *s->streams[t]) == texts[t].size;
    s->done += plans;
    tn_progress_update(&s->progress, (double)s->done);
    return written && !tn_interrupted();
}

/* Not between answers that are shown on the same terminal. */
static void begin_progress(tn_sifting *s)
{
    tn_progress_begin(&s->progress, "plans", 0, 0);
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        s->progress.shows &= !s->streams[t] || !*s->streams[t] ||
                             !isatty(*s->streams[t] == stdout ? STDOUT_FILENO : fileno(*s->streams[t]));
}

static bool complain(void *context, const tn_error *error, const char *text, size_t size)
{
    tn_sifting *s = context;
    s->stopped = !tn_job_bad_plan(s->job, &s->source, error, text, size);
    return !s->stopped;
}

bool tn_job_sift(tn_sifting *s)
{
    tn_plan_reader *reader;
    tn_error error;
    if (!tn_job_reader(s->job, s->answering->schema, &s->source, &reader))
        return false;
    bool opened = s->open(s->context);
    tn_sift_calls calls = {.context = s,
                           .numbered = s->answering->numbered,
                           .any = s->answering->any,
                           .plan = describe,
                           .write = write_texts,
                           .bad = complain};
    if (opened)
        begin_progress(s);
    if (opened && tn_sift(reader, s->answering->rules, (int)tn_job_threads(s->source.plans), &calls, &error) != TN_OK) {
        tn_job_fail(s->job, &error);
        s->stopped = true;
    }
    tn_progress_end(&s->progress);
    if (tn_interrupted() && !s->stopped) {
        s->stopped = true;
        tn_job_interrupted(s->job, "interrupted after %" PRIu64 " plans; %s", s->done,
                           tn_settings_output(s->job->settings) ? "no file is written"
                                                                : "what is said of them is written");
    }
    tn_plan_reader_free(reader);
    return opened;
}

void tn_job_fallbacks(tn_job *job, const tn_answering *answering)
{
    for (size_t i = 0; i < tn_rules_count(answering->rules); i++) {
        const tn_error *reason = tn_rules_fallback(answering->rules, i);
        if (!reason)
            continue;
        tn_diagnostic *note = tn_finding_note(&job->opened, reason);
        tn_note(tn_job_diagnostics(job), note, NULL, "`%s` is matched by the interpreter, which is slower",
                answering->rule_name(answering->context, i));
    }
    tn_job_show(job);
}
