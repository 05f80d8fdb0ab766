/* tartan test: runs the test blocks of rule files. */
#include "cli/library_session.h"
#include "cli/option_rows.h"
#include "driver/tests.h"

/* The closing line goes to standard output, like any result. */
static void write_counts(tn_session *session, const tn_test_counts *counts)
{
    tn_output output;
    if (!tn_session_output(session, NULL, &output))
        return;
    fprintf(output.stream, "%zu passed, %zu failed\n", counts->passed, counts->failed);
    tn_session_commit(session, &output);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_session session;
    tn_test_counts counts = {0};
    tn_session_begin(&session, settings);
    for (size_t i = 0; i < settings->operands.count; i++) {
        const char *path = settings->operands.items[i];
        if (i == 0 ? tn_session_open(&session, path) : tn_session_reopen(&session, path))
            tn_session_status(&session, tn_tests_run(&session.opened, (uint32_t)settings->max_states.value, &counts));
    }
    tn_session_show(&session);
    if (session.exit_code <= TN_EXIT_INVALID)
        write_counts(&session, &counts);
    return tn_session_end(&session);
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
