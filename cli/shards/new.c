/* tartan shards new: divides a library into shards that are to be written. */
#include "cli/plan/new_set.h"
#include "cli/shards/shards.h"

static bool check_options(tn_job *job, const tn_new_set *what)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    tn_diagnostics *list = tn_job_diagnostics(job);
    if (settings->inputs.count > 0 || settings->rules.count > 0)
        tn_help(list,
                tn_job_usage(job, "--input and --rule are about files of plans, and --task says what to do with "
                                  "them"),
                "add --task match or --task prune");
    else if (settings->input.format || settings->input.on_error)
        tn_help(list, tn_job_usage(job, "--input-format and --on-error are about files of plans"),
                "leave them out, or add --task match or --task prune, and --input");
    else if (settings->written.format >= TN_FORMAT_COUNT)
        tn_help(list, tn_job_usage(job, "a plan is written as names, bits or any only by --task match"),
                "choose lines, json, csv, bin or parquet");
    else if (settings->sample.given && (settings->from || settings->to || settings->each.given))
        tn_help(list, tn_job_usage(job, "a sample is drawn from all ranks, and --shards divides it"),
                "leave out --from, --to and --plans");
    else if (settings->seed.given && !settings->sample.given)
        tn_help(list, tn_job_usage(job, "--seed says which sample, and none is asked for"),
                "add --sample N, or leave out --seed");
    else if (settings->uniform && !settings->sample.given)
        tn_help(list, tn_job_usage(job, "--uniform is about samples, and none is asked for"),
                "add --sample N, or leave out --uniform");
    else if (settings->shards.given == settings->each.given)
        tn_help(list,
                tn_job_usage(job, settings->shards.given ? "--shards and --plans say the same thing twice"
                                                         : "nothing says how large the shards are to be"),
                "write --shards N for so many shards, or --plans N for so many plans in each");
    else
        return tn_new_set_fits(job, what);
    return false;
}

void tn_shards_new(tn_job *job)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    tn_ready_library ready = {0};
    const tn_new_set what = {.path = job->settings->operands.items[1],
                             .plans = &settings->plans,
                             .written = &settings->written,
                             .from = settings->from,
                             .to = settings->to,
                             .shards = settings->shards.value,
                             .each = settings->each.value,
                             .compress = settings->compress != 0,
                             .sampled = settings->sample.given,
                             .sample = settings->sample.value,
                             .seed = settings->seed.value,
                             .uniform = settings->uniform};
    if (check_options(job, &what) && tn_job_library(job, what.path, &settings->plans, &ready))
        tn_job_new_set(job, &ready, &what);
    tn_library_close(&ready);
}
