/* tartan test: runs the test blocks of rule files. */
#include "cli/library_job.h"
#include "cli/option_rows.h"
#include "driver/tests.h"

/* The closing line goes to standard output, like any result. */
static void write_counts(tn_job *job, const tn_test_counts *counts)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    fprintf(output.stream, "%zu passed, %zu failed\n", counts->passed, counts->failed);
    tn_job_commit(job, &output);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_test_counts counts = {0};
    tn_job_begin(&job, settings);
    for (size_t i = 0; i < settings->operands.count; i++) {
        const char *path = settings->operands.items[i];
        if (i == 0 ? tn_job_open(&job, path) : tn_job_reopen(&job, path))
            tn_job_status(&job, tn_tests_run(&job.opened, (uint32_t)settings->max_states.value, &counts));
    }
    tn_job_show(&job);
    if (job.exit_code <= TN_EXIT_INVALID)
        write_counts(&job, &counts);
    return tn_job_end(&job);
}

static const tn_option options[] = {OPTION_MAX_STATES, OPTION_WERROR};

const tn_command tn_command_test = {
    .name = "test",
    .summary = "run the test blocks of rule files",
    .usage = "FILE...",
    .description = "Runs every test block of the files, each case by the interpreter and by the automata. A failure "
                   "shows the plan, what "
                   "was expected of it, and the rule with its place. The last line says how many passed and failed; "
                   "the exit code is 1 "
                   "where one failed. Tests of files that are only used (`use`) do not run.",
    .example = "$ tartan test lahave.plan",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
