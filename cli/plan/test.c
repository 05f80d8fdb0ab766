/* tartan test: runs the test blocks of rule files. */
#include "cli/plan/test.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"
#include "driver/coverage/coverage.h"
#include "runtime/base/bytes.h"
#include "runtime/base/utf8.h"

/* ---- writes how tests come out */

void tn_tested_counts_text(const tn_tested *tested, FILE *out)
{
    fprintf(out, "%" PRIu64 " passed, %" PRIu64 " failed", tested->passed, tested->failed);
    if (tested->todo)
        fprintf(out, ", %" PRIu64 " to do", tested->todo);
    fputc('\n', out);
}

void tn_tested_designs_text(const tn_tested *tested, FILE *out)
{
    for (size_t i = 0; i < tested->solids.count; i++) {
        const tn_tested_design *design = &tested->solids.items[i];
        if (design->measures.count > 0)
            fprintf(out, "%s\n", design->name);
        for (size_t k = 0; k < design->measures.count; k++)
            fprintf(out, "  %-16s %.10g\n", design->measures.items[k].name,
                    tn_without_sign(design->measures.items[k].value));
    }
}

/* ---- tartan test */

typedef struct test_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool coverage, write_tests, json;
    tn_option_number max_boxes;
} test_settings;

static const test_settings *settings_of(const tn_job *job)
{
    return (const test_settings *)job->settings;
}

/* What is written when all files are done: a line, or in JSON everything. */
typedef struct test_report {
    tn_tested all;             /* how many, of all files */
    tn_buffer files;           /* in JSON: the coverage of each file, items of a list */
    tn_buffer solids;          /* in JSON: designs of boxes, likewise */
    tn_json covered, measured; /* write the two */
} test_report;

static void write_items(tn_json *json, const char *key, const tn_buffer *items)
{
    if (items->size == 0)
        return;
    tn_json_list(json, key);
    tn_json_written(json, items->data, items->size);
    tn_json_list_end(json);
}

static void write_json(const test_report *report, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_count(&json, "passed", report->all.passed);
    tn_json_count(&json, "failed", report->all.failed);
    tn_json_count(&json, "todo", report->all.todo);
    write_items(&json, "coverage", &report->files);
    write_items(&json, "solids", &report->solids);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_report(tn_job *job, const test_report *report)
{
    tn_output output;
    tn_error error;
    if (report->files.failed || report->solids.failed) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, NULL, &output)) {
        if (settings_of(job)->json)
            write_json(report, output.stream);
        else if (!settings_of(job)->write_tests)
            tn_tested_counts_text(&report->all, output.stream);
        tn_job_commit(job, &output);
    }
}

/* ---- a file: its texts are those of the file, which is closed before the next one */

static void add_json(const tn_tested *tested, test_report *report)
{
    for (size_t i = 0; i < tested->coverage.count; i++)
        tn_message_write(&tn_message_measured_coverage, &tested->coverage.items[i], NULL, &report->covered);
    for (size_t i = 0; i < tested->solids.count; i++)
        tn_message_write(&tn_message_tested_design, &tested->solids.items[i], NULL, &report->measured);
}

static void write_text(tn_job *job, const tn_tested *tested)
{
    tn_buffer text = {0};
    tn_output output;
    tn_error error;
    bool written = true;
    for (size_t i = 0; written && i < tested->coverage.count; i++)
        written = (settings_of(job)->write_tests ? tn_covered_tests
                                                 : tn_covered_text)(tested->coverage.items[i].shown.value, &text);
    if (!written) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    } else if ((text.size > 0 || tested->solids.count > 0) && tn_job_output(job, NULL, &output)) {
        tn_tested_designs_text(tested, output.stream);
        tn_write_shown(output.stream, text.data ? text.data : "", text.size);
        tn_job_commit(job, &output);
    }
    free(text.data);
}

static void test_file(tn_job *job, test_report *report)
{
    const test_settings *settings = settings_of(job);
    const tn_test_request request = {.subject = {.library = settings->plans.library,
                                                 .has_max_states = settings->plans.max_states.given,
                                                 .max_states = settings->plans.max_states.value},
                                     .coverage = settings->coverage || settings->write_tests,
                                     .has_max_boxes = settings->max_boxes.given,
                                     .max_boxes = settings->max_boxes.value};
    tn_reply answer;
    bool answered = tn_job_answered(job, tn_ask_test(&job->session, &request, &answer));
    const tn_tested *tested = answer.value;
    if (tested) {
        report->all.passed += tested->passed;
        report->all.failed += tested->failed;
        report->all.todo += tested->todo;
    }
    if (tested && tested->failed > 0)
        tn_job_status(job, TN_INVALID);
    if (answered && settings->json)
        add_json(tested, report);
    else if (answered)
        write_text(job, tested);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    test_report report = {.all = {0}};
    report.covered = tn_json_text(&report.files, TN_JSON_TIGHT);
    report.measured = tn_json_text(&report.solids, TN_JSON_TIGHT);
    tn_job_begin(&job, common);
    for (size_t i = 0; i < common->operands.count; i++) {
        const char *path = common->operands.items[i];
        if (i == 0 ? tn_job_open(&job, path) : tn_job_reopen(&job, path))
            test_file(&job, &report);
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
    FLAG("coverage", 0, coverage, "make small changes of the rules, and say which of them no test notices"),
    FLAG("write-tests", 0, write_tests,
         "write only test cases that tell the changes which no test notices, to be appended to the file"),
    FLAG("json", 0, json, "write JSON: how many passed and failed, and the coverage"),
    OPTION_LIBRARY,
    OPTION_SET,
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
        "With --coverage, small changes are made of each rule about plans and each clause, one at a time: a part "
        "never or always matches, an item is left out, a bound is a step lower or higher, a value is the next one, a "
        "symmetric matches only one way, a clause is left out. Of each it is found out exactly how many plans are "
        "decided otherwise, of all of the library's lengths or, without a library, of 1 to 4 trays. Changes that "
        "pass every test are listed first, with the shortest plan that would tell them. Then come those that decide "
        "every plan as before, which no test can tell, and the numbers of each rule.\n\n"
        "--write-tests does the same and writes only that shortest plan for each change that passes every test, as a "
        "case of a test block that says what the rules decide now. Read each, and append those that are right: "
        "`tartan test FILE --write-tests >>FILE` appends them all. Nothing is written into a file by itself.\n\n"
        "Of rules about houses --coverage lists each part with the number of houses of the library that uses them "
        "that would be decided otherwise if it never matched, as far as counts of 100,000 states (or --max-states) "
        "know it, and whether a test would notice. Of a form each line is listed, with the number of tests whose "
        "houses have what it says.\n\n"
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
