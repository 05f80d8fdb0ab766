/* tartan test: runs the test blocks of rule files. */
#include <stdlib.h>

#include "cli/library_job.h"
#include "cli/option_rows.h"
#include "driver/coverage.h"
#include "driver/tests.h"

/* The closing line goes to standard output, like any result. */
static void write_counts(tn_job *job, const tn_test_counts *counts)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    fprintf(output.stream, "%zu passed, %zu failed", counts->passed, counts->failed);
    if (counts->todo)
        fprintf(output.stream, ", %zu to do", counts->todo);
    fputc('\n', output.stream);
    tn_job_commit(job, &output);
}

/* The coverage of the file that is open, before the closing line. */
static void write_coverage(tn_job *job)
{
    tn_buffer text = {0};
    tn_output output;
    tn_job_status(job, tn_coverage_report(&job->opened, job->settings->library,
                                          (uint32_t)job->settings->max_states.value, &text));
    if (text.size && tn_job_output(job, NULL, &output)) {
        fwrite(text.data, 1, text.size, output.stream);
        tn_job_commit(job, &output);
    }
    free(text.data);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_test_counts counts = {0};
    tn_job_begin(&job, settings);
    for (size_t i = 0; i < settings->operands.count; i++) {
        const char *path = settings->operands.items[i];
        if (!(i == 0 ? tn_job_open(&job, path) : tn_job_reopen(&job, path)))
            continue;
        tn_job_status(&job, tn_tests_run(&job.opened, (uint32_t)settings->max_states.value, &counts));
        if (settings->coverage)
            write_coverage(&job);
    }
    tn_job_show(&job);
    if (job.exit_code <= TN_EXIT_INVALID)
        write_counts(&job, &counts);
    return tn_job_end(&job);
}

static const tn_option options[] = {
    FLAG("coverage", 0, coverage,
         "say of each part of each rule how many plans it decides, and whether a test notices"),
    OPTION_LIBRARY,
    OPTION_MAX_STATES,
    OPTION_WERROR,
};

const tn_command tn_command_test = {
    .name = "test",
    .summary = "run the test blocks of rule files",
    .usage = "FILE...",
    .description = "Runs every test block of the files, each case by the interpreter and by the automata. A failure "
                   "shows the plan, what "
                   "was expected of it, the rule with its place, and how the rule's parts came out. A case marked "
                   "`todo` is expected to fail; once it passes, that is a failure. The last line says how many passed "
                   "and failed; the exit code is 1 where one failed. With --coverage, for each part of each rule: how "
                   "many of the plans that the library generates (without a library: of all plans of up to 4 trays) "
                   "would be decided otherwise if it never matched, counted exactly, and whether a test case would "
                   "notice. Tests of files that are only used (`use`) do not run.",
    .example = "$ tartan test lahave.plan",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
