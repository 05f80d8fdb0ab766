/* tartan report: a library as an HTML page. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/plan/library_job.h"
#include "driver/open/findings.h"
#include "driver/report/report.h"
#include "runtime/plan/library/alone.h"

typedef struct report_settings {
    tn_settings common;
    tn_plan_settings plans;
    const char *output; /* a folder */
    tn_option_number sample, seed;
} report_settings;

static const report_settings *settings_of(const tn_job *job)
{
    return (const report_settings *)job->settings;
}

#define SAMPLES_DEFAULT 24
#define SAMPLES_MAX 2000

static bool make_folder(tn_job *job, const char *path)
{
    tn_error error;
    if (tn_folder_make(path, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

static void write_page(tn_job *job, const char *path, const tn_buffer *page)
{
    tn_output output;
    if (!tn_job_output(job, path, &output))
        return;
    fwrite(page->data, 1, page->size, output.stream);
    tn_job_commit(job, &output);
}

static void report(tn_job *job, const tn_ready_library *ready, const char *folder)
{
    const report_settings *settings = settings_of(job);
    char path[4096];
    tn_buffer page = {0};
    tn_error error;
    snprintf(path, sizeof path, "%s/index.html", folder);
    tn_report_options options = {.seed = settings->seed.value,
                                 .samples = settings->sample.given ? settings->sample.value : SAMPLES_DEFAULT,
                                 .max_states = (uint32_t)settings->plans.max_states.value};
    const tn_coverage_options coverage = {.library = tn_text(job->opened.module, ready->record->name),
                                          .max_states = options.max_states,
                                          .automaton = ready->library,
                                          .imported = true};
    const tn_plan_analysis_options analysis = {
        .max_states = options.max_states, .library = ready->library, .threads = tn_job_threads(&settings->plans)};
    tn_plan_analyses analyses = {0};
    tn_covered covered = {0};
    tn_progress progress;
    tn_progress_watch(&progress, "clauses counted", tn_interrupt_waiting());
    tn_status status = tn_library_find_alone(ready->library, &error);
    if (status != TN_OK)
        tn_finding_error(&job->opened, &error);
    else
        status = tn_plan_analyse(&job->opened, &analysis, &analyses);
    progress.what = "rules measured";
    if (status == TN_OK)
        status = tn_coverage_measure(&job->opened, &coverage, &covered);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    tn_job_status(job, status);
    if (status == TN_OK && tn_report_page(&job->opened, ready, &analyses, &covered, &options, &page, &error) == TN_OK)
        write_page(job, path, &page);
    else if (status == TN_OK)
        tn_job_fail(job, &error);
    tn_covered_clear(&covered);
    tn_plan_analyses_free(&analyses);
    free(page.data);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const report_settings *settings = (const report_settings *)common;
    tn_job job;
    tn_ready_library ready;
    tn_job_begin(&job, common);
    const char *folder = settings->output;
    if (!folder || strcmp(folder, "-") == 0 || strlen(folder) > 4000) {
        tn_job_usage(&job, "report needs -o FOLDER, a folder to write into");
        return tn_job_end(&job);
    }
    tn_interrupt_last_words("interrupted; %.400s/index.html is not written", folder);
    if (tn_job_library(&job, common->operands.items[0], &settings->plans, &ready) && make_folder(&job, folder))
        report(&job, &ready, folder);
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS report_settings
static const tn_option options[] = {
    TEXT("output", 'o', "FOLDER", output, "write FOLDER/index.html; the folder is made where it is not there"),
    NUMBER("sample", 0, "N", sample, 1, SAMPLES_MAX,
           "show N plans that are kept, and of N that are generated those that are dropped (default 24)"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which sample (default 0)"),
    OPTIONS_LIBRARY,
    OPTION_MAX_STATES,
    OPTION_THREADS(plans.threads),
    OPTION_WERROR,
};

const tn_command tn_command_report = {
    .name = "report",
    .summary = "write a library as an HTML page",
    .usage = "FILE -o FOLDER",
    .description =
        "Writes one page that needs no server and no network. It shows the library's counts by length as a chart; "
        "every rule with its picture, its text, its counts, how it relates to the other rules, the plans that "
        "prove it, and which of its parts the tests notice; the warnings of checking; and a sample of plans, kept "
        "and dropped, with the reasons. The sample can be filtered.",
    .example = "$ tartan report lahave-houses -o report",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
