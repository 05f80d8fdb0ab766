/* tartan shards new: divides a library into shards that are to be written. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/shards/shards.h"
#include "driver/open/digits.h"
#include "driver/plan/made.h"
#include "runtime/base/utf8.h"
#include "runtime/plan/text/pack.h"

#define DRAWN_MEMORY ((size_t)512 << 20) /* for the numbers of a sample, while a set is made */

bool tn_shards_names_fit(tn_job *job)
{
    const char *folder = tn_shards_settings_of(job)->written.output, *path = job->settings->operands.items[1];
    tn_diagnostics *list = tn_job_diagnostics(job);
    if (!folder || strcmp(folder, "-") == 0)
        tn_help(list, tn_job_usage(job, "a shard set is a folder, and none is named"), "name it: -o SET");
    else if (!tn_is_utf8(path, strlen(path)))
        tn_help(list, tn_job_usage(job, "the name of the rule file is not UTF-8 text, and a manifest holds only that"),
                "rename the file");
    else
        return true;
    return false;
}

static bool check_options(tn_job *job)
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
    else if (settings->written.format == TN_FORMAT_SQLITE)
        tn_help(list, tn_job_usage(job, "a shard is no database"),
                "choose another --format; `tartan shards merge SET -o FILE.sqlite` makes one database of all shards");
    else if (settings->written.format == TN_FORMAT_PARQUET && settings->compress)
        tn_help(list, tn_job_usage(job, "Parquet is compressed by zstd already"), "leave out --compress");
    else if (settings->written.format != TN_FORMAT_PARQUET &&
             (settings->written.plan_lines || settings->written.row_group.given))
        tn_help(list, tn_job_usage(job, "--plan-lines and --row-group are about Parquet"), "add --format parquet");
    else if (settings->sample.given && (settings->from || settings->to || settings->each.given))
        tn_help(list, tn_job_usage(job, "a sample is drawn from all ranks, and --shards divides it"),
                "leave out --from, --to and --plans");
    else if (settings->seed.given && !settings->sample.given)
        tn_help(list, tn_job_usage(job, "--seed says which sample, and none is asked for"),
                "add --sample N, or leave out --seed");
    else if (settings->shards.given == settings->each.given)
        tn_help(list,
                tn_job_usage(job, settings->shards.given ? "--shards and --plans say the same thing twice"
                                                         : "nothing says how large the shards are to be"),
                "write --shards N for so many shards, or --plans N for so many plans in each");
    else
        return tn_shards_names_fit(job);
    return false;
}

/* As `tartan sample` describes what it does. */
static char *sample_words(const tn_shards_settings *settings)
{
    char text[80];
    snprintf(text, sizeof text, "sample %" PRIu64 " --seed %" PRIu64, settings->sample.value, settings->seed.value);
    return strdup(text);
}

/* The set's texts and what decides its plans. */
static bool describe(tn_job *job, const tn_ready_library *ready, tn_shard_set *set)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    const tn_enumerated asked = {.from = settings->from,
                                 .to = settings->to,
                                 .trays_given = settings->plans.trays.given,
                                 .trays_min = settings->plans.trays.low,
                                 .trays_max = settings->plans.trays.high};
    set->folder = strdup(settings->written.output);
    set->library = strdup(tn_text(job->opened.module, ready->record->name));
    set->rules_path = strdup(job->settings->operands.items[1]);
    set->command = settings->sample.given ? sample_words(settings) : tn_enumerated_words(&asked);
    set->format = settings->written.format ? (tn_plan_format)settings->written.format : TN_FORMAT_LINES;
    set->compressed = settings->compress != 0;
    set->row_group = (uint32_t)settings->written.row_group.value;
    set->plan_lines = settings->written.plan_lines;
    set->options = (tn_library_options){.max_states = (uint32_t)settings->plans.max_states.value,
                                        .override_trays = settings->plans.trays.given,
                                        .trays_min = (uint32_t)settings->plans.trays.low,
                                        .trays_max = (uint32_t)settings->plans.trays.high,
                                        .max_length = (uint32_t)settings->plans.max_length.value};
    tn_library_hash(ready->library, set->library_hash);
    snprintf(set->schema_hash, sizeof set->schema_hash, "%016" PRIx64, tn_pack_schema_hash(ready->schema));
    return set->folder && set->library && set->rules_path && set->command;
}

tn_status tn_shards_create(tn_job *job, tn_shard_set *set, tn_error *error)
{
    const tn_compilation *compilation = &job->opened.compilation;
    uint8_t *bytes = NULL;
    size_t size = 0;
    if (job->opened.compiled)
        return tn_shard_set_create(set, compilation->module, compilation->module_size, error);
    if (strcmp(job->opened.path, "-") == 0)
        return tn_fail(error, TN_INVALID, E_USAGE, "a module on standard input cannot be kept: name its file");
    tn_status status = tn_file_read(job->opened.path, tn_module_limits_default().bytes, &bytes, &size, error);
    if (status == TN_OK)
        status = tn_shard_set_create(set, bytes, size, error);
    free(bytes);
    return status;
}

static void tell(tn_job *job, const tn_shard_set *set)
{
    mpz_t plans;
    mpz_init(plans);
    tn_shard_set_plans(set, plans);
    char *digits = tn_digits(plans, true);
    tn_job_note(job, "%.200s has %u shard%s for %.60s plans; `tartan shards run %.100s` writes them", set->folder,
                set->count, set->count == 1 ? "" : "s", digits ? digits : "?", set->folder);
    free(digits);
    mpz_clear(plans);
}

static void make_set(tn_job *job, const tn_ready_library *ready)
{
    const tn_shards_settings *settings = tn_shards_settings_of(job);
    tn_shard_set set = {0};
    tn_error error;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    if (tn_job_range(job, ready->library, settings->from, settings->to, from, to)) {
        tn_status status = describe(job, ready, &set) ? tn_shard_set_divide(&set, from, to, settings->shards.value,
                                                                            settings->each.value, &error)
                                                      : tn_fail_memory(&error);
        if (status == TN_OK && settings->sample.given)
            status = tn_shard_set_sample(&set, to, settings->sample.value, settings->seed.value, DRAWN_MEMORY,
                                         tn_interrupt_waiting(), &error);
        if (status == TN_OK)
            status = tn_shards_create(job, &set, &error);
        if (status == TN_OK)
            tell(job, &set);
        else
            tn_job_fail(job, &error);
    }
    tn_shard_set_clear(&set);
    mpz_clears(from, to, NULL);
}

void tn_shards_new(tn_job *job)
{
    tn_ready_library ready = {0};
    const char *path = job->settings->operands.items[1];
    if (check_options(job) && tn_job_library(job, path, &tn_shards_settings_of(job)->plans, &ready))
        make_set(job, &ready);
    tn_library_close(&ready);
}
