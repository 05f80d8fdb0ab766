/* tartan check: says what is wrong with rule files, without running them. */
#include "cli/job.h"
#include "cli/option_rows.h"
#include "driver/grammar_report.h"

static void report_grammar(tn_job *job)
{
    tn_error error;
    if (tn_grammar_report(&job->opened, job->settings->figures, &error) != TN_OK)
        tn_job_fail(job, &error);
}

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
        if (job.opened.module && job.opened.module->GRAMMAR_count)
            report_grammar(&job);
        else if (job.opened.module && settings->figures)
            tn_job_usage(&job, "--figures is about grammars, and %.200s is none", settings->operands.items[i]);
    }
    return tn_job_end(&job);
}

static const tn_option options[] = {OPTION_WERROR,
                                    FLAG("figures", 0, figures, "say of a grammar how deep its sentences are, how many there are, and how fast they grow")};

const tn_command tn_command_check = {
    .name = "check",
    .summary = "say what is wrong with rule files",
    .usage = "FILE... [--figures]",
    .description =
        "Compiles each rule file and all that it uses, and shows every error and warning with its place and a "
        "suggestion. Nothing is written or run. A module (.tnb) is checked as it is for loading. "
        "Of a grammar (.bnf) it also warns where sentences tend to grow without end.",
    .example = "$ tartan check houses.plan",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
