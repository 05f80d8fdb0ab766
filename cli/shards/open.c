/* Opens the shard set that a command line names. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/shards/shards.h"
#include "driver/shards/manifest.h"

#define STALE_DEFAULT 600.0

unsigned tn_shards_threads(const tn_job *job)
{
    const tn_plan_settings *plans = &tn_shards_settings_of(job)->plans;
    return job->settings->ranks && !plans->threads.given ? 1 : tn_job_threads(plans);
}

bool tn_shards_read(tn_job *job, tn_shards_open *open)
{
    tn_error error;
    tn_status status = tn_shard_set_read(job->settings->operands.items[1], &open->set, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

static bool make_ready(tn_job *job, tn_shards_open *open)
{
    tn_library_options options = open->set.options;
    tn_progress progress;
    options.threads = tn_shards_threads(job);
    tn_progress_watch(&progress, "clauses combined", tn_interrupt_waiting());
    tn_status status = tn_library_ready(&job->opened, open->set.library, &options, &open->ready);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    tn_job_status(job, status);
    return status == TN_OK;
}

static tn_status ready_rules(tn_job *job, tn_shards_open *open, const tn_rules_options *options, tn_error *error)
{
    const tn_shard_inputs *inputs = &open->set.inputs;
    tn_status status = tn_matched_new(job->opened.module, open->rules.indices, open->rules.count, open->rules.schema,
                                      options, inputs->answer, &open->matched, error);
    open->answering = tn_matched_answering(&open->matched);
    return status;
}

static tn_status ready_clauses(tn_job *job, tn_shards_open *open, const tn_rules_options *options, tn_error *error)
{
    tn_status status = tn_pruned_new(job->opened.module, &open->ready, &open->set.options, options,
                                     open->set.inputs.answer, &open->pruned, error);
    open->answering = tn_pruned_answering(&open->pruned);
    return status;
}

bool tn_shards_ready_answers(tn_job *job, tn_shards_open *open)
{
    const tn_shard_set *set = &open->set;
    const tn_texts asked = {(void *)set->inputs.rules, set->inputs.rule_count};
    const tn_rules_options options = {.max_states = set->options.max_states, .max_length = set->options.max_length};
    bool matches = set->task == TN_TASK_MATCH;
    tn_error error;
    if (matches && !tn_job_answered(job, tn_session_rules(&job->session, &asked,
                                                          "name one of those it uses with --rule", &open->rules)))
        return false;
    if (!matches) {
        tn_status chosen = tn_library_ready(&job->opened, set->library, NULL, &open->ready);
        tn_job_status(job, chosen);
        if (chosen != TN_OK)
            return false;
    }
    tn_status status = matches ? ready_rules(job, open, &options, &error) : ready_clauses(job, open, &options, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

static bool make_ready_for(tn_job *job, tn_shards_open *open)
{
    return tn_shard_set_answers(&open->set) ? tn_shards_ready_answers(job, open) : make_ready(job, open);
}

bool tn_shards_open_rules(tn_job *job, tn_shards_open *open)
{
    tn_error error;
    open->module = tn_shard_set_path(&open->set, TN_MODULE_NAME);
    tn_status status = open->module ? tn_shard_set_module_same(&open->set, &error) : tn_fail_memory(&error);
    if (status == TN_OK) {
        if (!tn_job_open(job, open->module) || !make_ready_for(job, open))
            return false;
        const tn_schema *schema = open->ready.schema ? open->ready.schema : open->matched.schema;
        status = tn_shard_set_agrees(&open->set, schema, open->ready.library, &error);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

void tn_shards_close_library(tn_shards_open *open)
{
    tn_matched_clear(&open->matched);
    tn_pruned_clear(&open->pruned);
    tn_chosen_rules_clear(&open->rules);
    tn_library_close(&open->ready);
}

void tn_shards_clear(tn_shards_open *open)
{
    tn_shard_set_clear(&open->set);
    free(open->module);
}

/* ---- times */

bool tn_time_read(const char *text, double *seconds)
{
    static const struct {
        const char *unit;
        double seconds;
    } units[] = {{"", 1}, {"s", 1}, {"m", 60}, {"h", 3600}, {"d", 86400}};
    size_t digits = strspn(text, "0123456789.");
    char *end;
    *seconds = strtod(text, &end);
    if (digits == 0 || end != text + digits || !isfinite(*seconds) || *seconds <= 0)
        return false;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(end, units[i].unit) == 0) {
            *seconds *= units[i].seconds;
            return true;
        }
    }
    return false;
}

bool tn_shards_stale(tn_job *job, double *seconds)
{
    const char *text = tn_shards_settings_of(job)->stale;
    *seconds = STALE_DEFAULT;
    if (!text || tn_time_read(text, seconds))
        return true;
    tn_diagnostic *d = tn_job_usage(job, "--stale needs a time, not `%.60s`", text);
    tn_help(tn_job_diagnostics(job), d, "write 90s, 10m or 2h");
    return false;
}
