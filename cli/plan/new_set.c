/* Makes shard sets of the plans of a library. */
#include "cli/plan/new_set.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/enumerate.h"
#include "cli/common/interrupt.h"
#include "driver/open/digits.h"
#include "driver/plan/provenance.h"
#include "driver/shards/manifest.h"
#include "runtime/base/utf8.h"
#include "runtime/plan/text/pack.h"

#define DRAWN_MEMORY ((size_t)512 << 20) /* for the numbers of a sample, while a set is made */

bool tn_new_set_named(tn_job *job, const char *folder, const char *path)
{
    tn_diagnostics *list = tn_job_diagnostics(job);
    if (!folder || strcmp(folder, "-") == 0)
        tn_help(list, tn_job_usage(job, "a shard set is a folder, and none is named"), "name it: -o SET");
    else if (!tn_is_utf8(path, strlen(path)))
        tn_help(list, tn_job_usage(job, "the name of the rule file is not UTF-8 text, and a manifest holds only that"),
                "rename the file");
    else
        return tn_job_writes(job, "a shard set", folder, TN_WRITES_FOLDER);
    return false;
}

bool tn_new_set_fits(tn_job *job, const tn_new_set *what)
{
    const tn_written_settings *written = what->written;
    tn_diagnostics *list = tn_job_diagnostics(job);
    if (!tn_new_set_named(job, written->output, what->path))
        return false;
    if (written->format == TN_FORMAT_SQLITE)
        tn_help(list, tn_job_usage(job, "a shard is no database"),
                "choose another --format; `tartan shards merge SET -o FILE.sqlite` makes one database of all shards");
    else if (written->format == TN_FORMAT_PARQUET && what->compress)
        tn_help(list, tn_job_usage(job, "Parquet is compressed by zstd already"), "leave out --compress");
    else if (written->format != TN_FORMAT_PARQUET && (written->plan_lines || written->row_group.given))
        tn_help(list, tn_job_usage(job, "--plan-lines and --row-group are about Parquet"), "add --format parquet");
    else
        return true;
    return false;
}

/* As `tartan sample` describes what it does. */
static char *sample_words(const tn_new_set *what)
{
    char text[80];
    snprintf(text, sizeof text, "sample %" PRIu64 "%s --seed %" PRIu64, what->sample, what->uniform ? " --uniform" : "",
             what->seed);
    return strdup(text);
}

/* The set's texts and what decides its plans or houses. */
static bool describe(const tn_new_set *what, const tn_new_set_of *of, tn_shard_set *set)
{
    const tn_written_settings *written = what->written;
    const tn_plan_settings *plans = what->plans;
    const tn_enumerated asked = {.from = what->from,
                                 .to = what->to,
                                 .trays_given = plans->trays.given,
                                 .trays_min = plans->trays.low,
                                 .trays_max = plans->trays.high,
                                 .wheres = plans->wheres.items,
                                 .where_count = of->task == TN_TASK_HOUSES ? plans->wheres.count : 0};
    set->task = of->task;
    set->folder = strdup(written->output);
    set->library = strdup(of->library);
    set->rules_path = strdup(what->path);
    set->command = what->sampled ? sample_words(what) : tn_enumerated_words(&asked);
    set->format = written->format ? (tn_plan_format)written->format : of->format;
    set->compressed = what->compress;
    set->row_group = (uint32_t)written->row_group.value;
    set->plan_lines = written->plan_lines;
    set->options = tn_job_library_options(plans);
    tn_library_hash(of->plans, set->library_hash);
    snprintf(set->schema_hash, sizeof set->schema_hash, "%016" PRIx64, tn_pack_schema_hash(of->schema));
    return set->folder && set->library && set->rules_path && set->command;
}

tn_status tn_new_set_create(tn_job *job, tn_shard_set *set, tn_error *error)
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

static void tell(tn_job *job, const tn_shard_set *set, const char *things)
{
    mpz_t number;
    mpz_init(number);
    tn_shard_set_plans(set, number);
    char *digits = tn_digits(number, true);
    tn_job_note(job, "%.200s has %u shard%s for %.60s %s; `tartan shards run %.100s` writes them", set->folder,
                set->count, set->count == 1 ? "" : "s", digits ? digits : "?", things, set->folder);
    free(digits);
    mpz_clear(number);
}

static tn_status make_set(tn_job *job, const tn_new_set *what, const tn_new_set_of *of, tn_shard_set *set,
                          const mpz_t from, const mpz_t to, tn_error *error)
{
    tn_status status = describe(what, of, set) ? tn_shard_set_divide(set, from, to, what->shards, what->each, error)
                                               : tn_fail_memory(error);
    if (status == TN_OK && what->sampled)
        status = tn_shard_set_sample(set, to, what->sample, what->seed, DRAWN_MEMORY, tn_interrupt_waiting(), error);
    return status == TN_OK ? tn_new_set_create(job, set, error) : status;
}

void tn_new_set_make(tn_job *job, const tn_new_set *what, const tn_new_set_of *of)
{
    tn_shard_set set = {0};
    tn_error error;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    if (tn_job_answered(job, tn_asked_range(&job->session, of->all, of->things, what->from, what->to, from, to))) {
        if (make_set(job, what, of, &set, from, to, &error) == TN_OK)
            tell(job, &set, of->things);
        else
            tn_job_fail(job, &error);
    }
    tn_shard_set_clear(&set);
    mpz_clears(from, to, NULL);
}

/* Workers draw the numbers of plans, each as likely as each. */
static bool can_draw(tn_job *job, const tn_ready_library *ready, const tn_new_set *what)
{
    bool weights = ready->record->weight_count > 0;
    if (!what->sampled || what->uniform || !(weights || ready->schema->tray_plans))
        return true;
    tn_help(tn_job_diagnostics(job),
            tn_job_usage(job, "a shard set draws each plan as likely as each, and %slibrary `%s` %s",
                         weights ? "" : "the trays of ", tn_text(job->opened.module, ready->record->name),
                         weights ? "has weights" : "stand for different numbers of plans"),
            "add --uniform; or draw fewer plans by weight, without shards");
    return false;
}

void tn_job_new_set(tn_job *job, const tn_ready_library *ready, const tn_new_set *what)
{
    mpz_t all;
    if (!can_draw(job, ready, what))
        return;
    mpz_init(all);
    tn_library_kept(ready->library, TN_ALL_LENGTHS, all);
    const tn_new_set_of of = {.task = TN_TASK_ENUMERATE,
                              .format = TN_FORMAT_LINES,
                              .things = "plans",
                              .library = tn_text(job->opened.module, ready->record->name),
                              .plans = ready->library,
                              .schema = ready->schema,
                              .all = all};
    tn_new_set_make(job, what, &of);
    mpz_clear(all);
}
