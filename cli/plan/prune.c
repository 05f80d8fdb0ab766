/* tartan prune: filters plans through a library. */
#include <string.h>

#include "cli/common/options.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"
#include "driver/plan/answering.h"

typedef struct prune_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    const char *output, *dropped;
    int format;
    int engine; /* a tn_matching_engine */
} prune_settings;

static const prune_settings *settings_of(const tn_job *job)
{
    return (const prune_settings *)job->settings;
}

enum { FORMAT_LINES, FORMAT_JSON };

typedef struct pruning {
    tn_job *job;
    const char *path; /* of the plans */
    tn_ready_library ready;
    tn_pruned pruned;
    tn_output kept, dropped;
    FILE *dropped_stream; /* NULL where nobody asked */
} pruning;

static bool compile_clauses(pruning *p)
{
    const prune_settings *settings = settings_of(p->job);
    const tn_library_options lengths = tn_job_library_options(&settings->plans);
    const tn_rules_options options = {.engine = (tn_matching_engine)settings->engine,
                                      .max_states = (uint32_t)settings->plans.max_states.value,
                                      .max_length = tn_job_max_length(&settings->plans)};
    tn_answer_format format = settings->format == FORMAT_JSON ? TN_ANSWER_JSON : TN_ANSWER_LINES;
    tn_error error;
    tn_status status = tn_pruned_new(p->job->opened.module, &p->ready, &lengths, &options, format, &p->pruned, &error);
    if (status != TN_OK)
        tn_job_fail(p->job, &error);
    return status == TN_OK;
}

/* Kept and dropped plans may both go to standard output, in the order they came: then they are in the same text. */
static bool open_outputs(void *context)
{
    pruning *p = context;
    const prune_settings *settings = settings_of(p->job);
    if (!tn_job_output(p->job, settings->output, &p->kept))
        return false;
    if (!settings->dropped)
        return true;
    if (strcmp(settings->dropped, "-") == 0) {
        p->dropped_stream = stdout;
    } else if (tn_job_output(p->job, settings->dropped, &p->dropped)) {
        p->dropped_stream = p->dropped.stream;
    } else {
        tn_output_discard(&p->kept);
        return false;
    }
    p->pruned.dropped = p->dropped_stream != p->kept.stream;
    return true;
}

static void prune_plans(pruning *p)
{
    const prune_settings *settings = settings_of(p->job);
    const tn_answering answering = tn_pruned_answering(&p->pruned);
    tn_sifting sifting = {.job = p->job,
                          .source = {p->path, &settings->input, &settings->plans},
                          .answering = &answering,
                          .open = open_outputs,
                          .streams = {&p->kept.stream, &p->dropped_stream},
                          .context = p};
    tn_job_fallbacks(p->job, &answering);
    if (!tn_job_sift(&sifting))
        return;
    tn_job_close(p->job, &p->kept, !sifting.stopped);
    if (p->dropped.stream)
        tn_job_close(p->job, &p->dropped, !sifting.stopped);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const prune_settings *settings = (const prune_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    pruning p = {.job = &job, .path = tn_job_plans_path(&job)};
    if (p.path && tn_job_library_schema(&job, common->operands.items[0], &settings->plans, &p.ready) &&
        compile_clauses(&p))
        prune_plans(&p);
    tn_pruned_clear(&p.pruned);
    tn_library_close(&p.ready);
    return tn_job_end(&job);
}

#define SETTINGS prune_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WRITTEN("dropped", 'd', "FILE", dropped, TN_WRITES_TEXT | TN_WRITES(JSON),
            "write the plans that are dropped to FILE, each with the clauses that drop it"),
    CHOICE("format", 'f', "FORMAT", format, "lines|json", "write plan lines (default) or JSON lines"),
    OPTION_OUTPUT_BY(TN_WRITES_TEXT | TN_WRITES(JSON), "; .json is JSON"),
    OPTION_INPUT_FORMAT,
    OPTION_ON_ERROR,
    OPTION_TRAYS,
    OPTION_ENGINE,
    OPTION_MAX_STATES,
    OPTION_MAX_LENGTH,
    OPTION_THREADS(plans.threads),
};

const tn_command tn_command_prune = {
    .name = "prune",
    .summary = "keep the plans that a library keeps",
    .usage = "FILE [PLANS] [--library NAME] [--dropped FILE]",
    .description =
        "Reads plans (from standard input if no file or - is given) and writes those that the library keeps. It "
        "drops a plan that a pruning rule matches, that does not meet a requirement or total, or that has too few "
        "or too many trays. --dropped writes the reasons for each dropped plan.",
    .example = "$ tartan prune lahave-houses plans.txt --dropped why.txt",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a rule file and a file of plans",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
