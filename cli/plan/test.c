/* tartan test: runs the test blocks of rule files. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/plan/answers.h"
#include "cli/solid/solid.h"
#include "driver/place/kit.h"
#include "driver/plan/coverage.h"
#include "runtime/base/utf8.h"

typedef struct test_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool coverage, json;
    tn_option_number max_boxes;
} test_settings;

static const test_settings *settings_of(const tn_job *job)
{
    return (const test_settings *)job->settings;
}

/* What is written when all files are done: a line, or in JSON everything. */
typedef struct test_report {
    tn_test_counts counts;
    tn_buffer files;           /* the coverage of each file, items of a list in JSON */
    tn_buffer solids;          /* measures of designs of boxes: lines, or items of a list in JSON */
    tn_json covered, measured; /* write the two */
} test_report;

void tn_test_counts_write(const tn_test_counts *counts, FILE *out)
{
    fprintf(out, "%zu passed, %zu failed", counts->passed, counts->failed);
    if (counts->todo)
        fprintf(out, ", %zu to do", counts->todo);
    fputc('\n', out);
}

static void write_items(tn_json *json, const char *key, const char *items)
{
    if (!items)
        return;
    tn_json_list(json, key);
    tn_json_written(json, items, strlen(items));
    tn_json_list_end(json);
}

void tn_test_counts_json(const tn_test_counts *counts, const char *coverage, const char *solids, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_count(&json, "passed", counts->passed);
    tn_json_count(&json, "failed", counts->failed);
    tn_json_count(&json, "todo", counts->todo);
    write_items(&json, "coverage", coverage);
    write_items(&json, "solids", solids);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_report(tn_job *job, const test_report *report)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (settings_of(job)->json) {
        tn_test_counts_json(&report->counts, report->files.size ? report->files.data : NULL,
                            report->solids.size ? report->solids.data : NULL, output.stream);
    } else {
        if (report->solids.size)
            fwrite(report->solids.data, 1, report->solids.size, output.stream);
        tn_test_counts_write(&report->counts, output.stream);
    }
    tn_job_commit(job, &output);
}

/* The coverage of the file that is open: in JSON it waits for the others. */
static void write_coverage(tn_job *job, test_report *report)
{
    const tn_coverage_options options = {.library = settings_of(job)->plans.library,
                                         .max_states = (uint32_t)settings_of(job)->plans.max_states.value,
                                         .houses = true};
    tn_covered covered;
    tn_buffer text = {0};
    tn_output output;
    tn_error error;
    tn_progress progress;
    tn_progress_watch(&progress, "rules measured", tn_interrupt_waiting());
    tn_status status = tn_coverage_measure(&job->opened, &options, &covered);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    tn_job_status(job, status);
    bool json = settings_of(job)->json, written = true;
    if (status == TN_OK && json)
        written = tn_covered_json(&covered, &report->covered);
    else if (status == TN_OK)
        written = tn_covered_text(&covered, &text);
    if (!written) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    } else if (text.size && tn_job_output(job, NULL, &output)) {
        tn_write_shown(output.stream, text.data, text.size);
        tn_job_commit(job, &output);
    }
    free(text.data);
    tn_covered_clear(&covered);
}

/* Designs of boxes: their measures, and their requirements as cases. */
static void test_solids(tn_job *job, test_report *report)
{
    tn_solid_tally tally = {0};
    char *text = tn_job_test_solids(job, (uint32_t)settings_of(job)->max_boxes.value, settings_of(job)->json, &tally);
    tn_error error;
    report->counts.passed += tally.passed;
    report->counts.failed += tally.failed;
    if (text && settings_of(job)->json)
        tn_json_written(&report->measured, text, strlen(text));
    else if (text)
        tn_buffer_append(&report->solids, text, strlen(text));
    if (report->solids.failed) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    }
    free(text);
}

static void test_kit(tn_job *job, test_report *report)
{
    tn_kit_tally tally;
    tn_job_status(job, tn_kit_tests_run(&job->opened, tn_interrupt_waiting(), &tally));
    report->counts.passed += tally.passed;
    report->counts.failed += tally.failed;
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const test_settings *settings = (const test_settings *)common;
    tn_job job;
    test_report report = {.counts = {0}};
    report.covered = tn_json_text(&report.files, TN_JSON_TIGHT);
    report.measured = tn_json_text(&report.solids, TN_JSON_TIGHT);
    tn_job_begin(&job, common);
    for (size_t i = 0; i < common->operands.count; i++) {
        const char *path = common->operands.items[i];
        if (!(i == 0 ? tn_job_open(&job, path) : tn_job_reopen(&job, path)))
            continue;
        if (job.opened.module->SOLID_count) {
            test_solids(&job, &report);
            continue;
        }
        if (job.opened.module->KIT_count) {
            test_kit(&job, &report);
            continue;
        }
        tn_job_status(&job,
                      tn_tests_run(&job.opened, (uint32_t)settings->plans.max_states.value, NULL, &report.counts));
        if (settings->coverage && job.opened.compilation.program)
            write_coverage(&job, &report);
    }
    tn_job_show(&job);
    if (job.exit_code <= TN_EXIT_INVALID)
        write_report(&job, &report);
    free(report.files.data);
    free(report.solids.data);
    return tn_job_end(&job);
}

#define SETTINGS test_settings
static const tn_option options[] = {
    FLAG("coverage", 0, coverage,
         "say of each part of each rule how many plans it decides, and whether a test notices"),
    FLAG("json", 0, json, "write JSON: how many passed and failed, and the coverage"),
    OPTION_LIBRARY,
    OPTION_MAX_STATES,
    OPTION_MAX_BOXES(max_boxes),
    OPTION_LDRAW,
    OPTION_WERROR,
};

const tn_command tn_command_test = {
    .name = "test",
    .summary = "run the test blocks of rule files",
    .usage = "FILE...",
    .description =
        "Runs every test block of the files, each case by the interpreter and by the automata. A failure shows "
        "the plan, what was expected of it, the rule with its place, and how the rule's parts came out. A case "
        "marked `todo` is expected to fail; when it passes, that is a failure too. The last line says how many "
        "passed and failed, and the exit code is 1 if one failed. Tests of files that are only used (`use`) do "
        "not run.\n\n"
        "With --coverage, each part of each rule and clause is listed with two answers: how many plans would be "
        "decided otherwise if the part never matched, counted exactly, and whether a test would notice. The plans "
        "are those that the library generates or, without a library, all plans of up to 4 trays. Of rules about "
        "houses it is the number of houses of the library that uses them, as far as counts of 100,000 states (or "
        "--max-states) know it. Of a form each line is listed, with the number of tests whose houses have what it "
        "says.\n\n"
        "For designs of boxes it prints what they measure, and checks their requirements. Of a kit every model is "
        "placed "
        "with seed 0 and held to its requirements and its tests.",
    .example = "$ tartan test lahave",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
