/* tartan check: says what is wrong with rule files, without running them. */
#include "cli/job.h"
#include "cli/option_rows.h"

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, settings);
    for (size_t i = 0; i < settings->operands.count; i++) {
        if (i == 0)
            tn_job_open(&job, settings->operands.items[i]);
        else
            tn_job_reopen(&job, settings->operands.items[i]);
    }
    return tn_job_end(&job);
}

static const tn_option options[] = {OPTION_WERROR};

const tn_command tn_command_check = {
    .name = "check",
    .summary = "say what is wrong with rule files",
    .usage = "FILE...",
    .description =
        "Compiles each rule file and all that it uses, and shows every error and warning with its place and a "
        "suggestion. Nothing is written or run. A module (.tnb) is checked as it is for loading.",
    .example = "$ tartan check houses.plan",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
