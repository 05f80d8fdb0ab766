/* tartan shards new: divides a library into shards that are to be written. */
#include "cli/plan/new_set.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/house/judged.h"
#include "cli/shards/shards.h"
#include "driver/shards/inputs.h"
#include "runtime/plan/text/pack.h"

/* ---- tartan shards new --task match, prune */

static const char *const tasks[TN_TASK_COUNT] = {[TN_TASK_MATCH] = "match", [TN_TASK_PRUNE] = "prune"};

/* ---- what is asked for */

/* The options of the other tasks. */
static const char *foreign_option(const tn_shards_settings *s)
{
    bool matches = s->task == TN_TASK_MATCH;
    return s->each.given                          ? "--plans"
           : s->sample.given                      ? "--sample"
           : s->seed.given                        ? "--seed"
           : s->uniform                           ? "--uniform"
           : s->from                              ? "--from"
           : s->to                                ? "--to"
           : s->compress                          ? "--compress"
           : s->written.plan_lines                ? "--plan-lines"
           : s->written.row_group.given           ? "--row-group"
           : !matches && s->rules.count > 0       ? "--rule"
           : matches && s->plans.library          ? "--library"
           : matches && s->plans.wheres.count > 0 ? "--where"
           : matches && s->plans.trays.given      ? "--trays"
                                                  : NULL;
}

static bool choose_answer(tn_job *job, tn_answer_format *answer)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    bool matches = settings->task == TN_TASK_MATCH;
    int format = settings->written.format;
    *answer = matches ? TN_ANSWER_NAMES : TN_ANSWER_LINES;
    if (format == TN_FORMAT_JSON)
        *answer = TN_ANSWER_JSON;
    else if (matches && format == TN_SHARDS_BITS)
        *answer = TN_ANSWER_BITS;
    else if (matches && format == TN_SHARDS_ANY)
        *answer = TN_ANSWER_ANY;
    else if (format != TN_FORMAT_AUTO && format != (matches ? (int)TN_SHARDS_NAMES : (int)TN_FORMAT_LINES)) {
        tn_help(tn_job_diagnostics(job),
                tn_job_usage(job, "`tartan %s` does not write that format", tasks[settings->task]),
                matches ? "choose names, json, bits or any" : "choose lines or json");
        return false;
    }
    return true;
}

static bool check_answer_options(tn_job *job)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    tn_diagnostics *list = tn_job_diagnostics(job);
    const char *foreign = foreign_option(settings);
    if (settings->inputs.count == 0)
        tn_help(list, tn_job_usage(job, "--task %s needs files of plans", tasks[settings->task]),
                "name them: --input FILE...");
    else if (foreign)
        tn_help(list, tn_job_usage(job, "--task %s takes no %s", tasks[settings->task], foreign), "leave it out");
    else if (!settings->shards.given)
        tn_help(list, tn_job_usage(job, "nothing says how large the shards are to be"),
                "write --shards N for about so many");
    else
        return tn_new_set_named(job, tn_shards_settings_of(job)->written.output, job->settings->operands.items[1]);
    return false;
}

/* The names of --rule, which the set owns. */
static bool keep_rules(const tn_option_list *rules, tn_shard_inputs *inputs)
{
    inputs->rules = calloc(rules->count + 1, sizeof *inputs->rules);
    for (size_t i = 0; inputs->rules && i < rules->count; i++) {
        inputs->rules[i] = strdup(rules->items[i]);
        if (!inputs->rules[i])
            return false;
        inputs->rule_count++;
    }
    return inputs->rules != NULL;
}

static bool describe(tn_job *job, tn_shard_set *set)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    set->task = (tn_shard_task)settings->task;
    set->folder = strdup(settings->written.output);
    set->rules_path = strdup(job->settings->operands.items[1]);
    set->command = strdup(tasks[set->task]);
    set->options = tn_job_library_options(&settings->plans);
    set->inputs.skips = settings->input.on_error == 1;
    if (settings->plans.library)
        set->library = strdup(settings->plans.library);
    return set->folder && set->rules_path && set->command && (set->library || !settings->plans.library) &&
           keep_rules(&settings->rules, &set->inputs);
}

/* The files of --input, and those behind the rule file. */
static tn_status find_inputs(tn_job *job, tn_shard_set *set, tn_error *error)
{
    const tn_option_list *named = &tn_shards_settings_of(job)->inputs, *more = &job->settings->operands;
    size_t count = named->count + more->count - 2;
    const char **paths = malloc(count * sizeof *paths);
    if (!paths)
        return tn_fail_memory(error);
    memcpy(paths, named->items, named->count * sizeof *paths);
    for (size_t i = 2; i < more->count; i++)
        paths[named->count + i - 2] = more->items[i];
    tn_status status = tn_shard_inputs_find(set, paths, count, error);
    free(paths);
    return status;
}

/* ---- making the set */

static bool open_rules(tn_job *job, tn_shards_open *open)
{
    const char *path = job->settings->operands.items[1];
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    if (open->set.task == TN_TASK_PRUNE)
        return tn_job_open_plans(job, path, &settings->plans) && tn_shards_ready_answers(job, open);
    if (!tn_job_open(job, path))
        return false;
    if (tn_session_matches_houses(&job->session, &(tn_texts){settings->rules.items, settings->rules.count})) {
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "a set has no shards of houses"),
                "choose rules about plans with --rule, or match houses by `tartan match`");
        return false;
    }
    return tn_shards_ready_answers(job, open);
}

static tn_status keep_names(tn_job *job, tn_shards_open *open, tn_error *error)
{
    tn_shard_set *set = &open->set;
    snprintf(set->schema_hash, sizeof set->schema_hash, "%016" PRIx64, tn_pack_schema_hash(open->answering.schema));
    if (set->task == TN_TASK_PRUNE && !set->library)
        set->library = strdup(tn_text(job->opened.module, open->ready.record->name));
    return set->library || set->task == TN_TASK_MATCH ? TN_OK : tn_fail_memory(error);
}

static void make_set(tn_job *job, tn_shards_open *open)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    tn_shard_set *set = &open->set;
    tn_error error;
    tn_status status = find_inputs(job, set, &error);
    if (status == TN_OK)
        status = keep_names(job, open, &error);
    if (status == TN_OK)
        status = tn_shard_inputs_divide(set, open->answering.schema, (tn_plan_format)settings->input.format,
                                        settings->shards.value, &error);
    if (status == TN_OK)
        status = tn_new_set_create(job, set, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    tn_job_fallbacks(job, &open->answering);
    tn_job_note(job, "%.200s has %u shard%s for %u file%s; `tartan shards run %.100s` writes them", set->folder,
                set->count, set->count == 1 ? "" : "s", set->inputs.count, set->inputs.count == 1 ? "" : "s",
                set->folder);
}

void tn_shards_new_answers(tn_job *job, tn_shards_open *open)
{
    tn_error error;
    if (!check_answer_options(job) || !choose_answer(job, &open->set.inputs.answer))
        return;
    if (!describe(job, &open->set))
        tn_job_fail(job, (tn_fail_memory(&error), &error));
    else if (open_rules(job, open))
        make_set(job, open);
}

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
    if (!check_options(job, &what) || !tn_job_open_plans(job, what.path, &settings->plans))
        return;
    if (tn_shards_of_houses(job, settings->plans.library))
        tn_shards_new_houses(job, &what);
    else if (tn_job_opened_library(job, &settings->plans, &ready))
        tn_job_new_set(job, &ready, &what);
    tn_library_close(&ready);
}
