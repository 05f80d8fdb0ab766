/* tartan match: which rules each plan matches. */
#include "ask/plan/match.h"
#include "cli/common/options.h"
#include "cli/house/judged.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"
#include "driver/plan/answering.h"

typedef struct match_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    tn_option_list rules;
    int format;
    const char *output;
    int engine; /* a tn_matching_engine */
} match_settings;

static const match_settings *settings_of(const tn_job *job)
{
    return (const match_settings *)job->settings;
}

/* The rules to match, and where the answers go. */
typedef struct matching {
    tn_job *job;
    const char *path; /* of the plans */
    tn_chosen_rules rules;
    tn_matched matched;
    tn_output output;
} matching;

static bool choose_rules(matching *m)
{
    const tn_option_list *rules = &settings_of(m->job)->rules;
    static const char otherwise[] = "name one of those it uses with --rule, or filter with `tartan prune`";
    return tn_job_answered(
        m->job, tn_session_rules(&m->job->session, &(tn_texts){rules->items, rules->count}, otherwise, &m->rules));
}

static bool compile_rules(matching *m)
{
    const match_settings *settings = settings_of(m->job);
    const tn_rules_options options = {.engine = (tn_matching_engine)settings->engine,
                                      .max_states = (uint32_t)settings->plans.max_states.value,
                                      .max_length = tn_job_max_length(&settings->plans)};
    tn_error error;
    tn_status status = tn_matched_new(m->job->opened.module, m->rules.indices, m->rules.count, m->rules.schema,
                                      &options, (tn_answer_format)settings->format, &m->matched, &error);
    if (status != TN_OK)
        tn_job_fail(m->job, &error);
    return status == TN_OK;
}

static bool open_output(void *context)
{
    matching *m = context;
    return tn_job_output(m->job, settings_of(m->job)->output, &m->output);
}

static void match_plans(matching *m)
{
    const tn_answering answering = tn_matched_answering(&m->matched);
    tn_sifting sifting = {.job = m->job,
                          .source = {m->path, &settings_of(m->job)->input, &settings_of(m->job)->plans},
                          .answering = &answering,
                          .open = open_output,
                          .streams = {&m->output.stream},
                          .context = m};
    tn_job_fallbacks(m->job, &answering);
    if (tn_job_sift(&sifting))
        tn_job_close(m->job, &m->output, !sifting.stopped);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const match_settings *settings = (const match_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    matching m = {.job = &job, .path = tn_job_plans_path(&job)};
    bool open = m.path && tn_job_open(&job, common->operands.items[0]);
    const tn_texts rules = {settings->rules.items, settings->rules.count};
    if (open && tn_session_matches_houses(&job.session, &rules))
        tn_job_match_houses(&job, &rules, m.path, (tn_house_answer)settings->format, settings->output,
                            tn_job_max_length(&settings->plans));
    else if (open && choose_rules(&m) && compile_rules(&m))
        match_plans(&m);
    tn_matched_clear(&m.matched);
    tn_chosen_rules_clear(&m.rules);
    return tn_job_end(&job);
}

#define SETTINGS match_settings
static const tn_option options[] = {
    LIST("rule", 'r', "NAME", rules, "match this rule; may be repeated (default: all rules of the file itself)"),
    OPTION_SET,
    CHOICE("format", 'f', "FORMAT", format, "names|json|bits|any",
           "names (default): the names of the rules, or - where there is none; json: an object a line; bits: a 0 or 1 "
           "a rule; any: 1 where at least one rule matches, else 0"),
    OPTION_OUTPUT_BY(TN_WRITES_TEXT | TN_WRITES(JSON), "; .json is JSON"),
    OPTION_INPUT_FORMAT,
    OPTION_ON_ERROR,
    OPTION_ENGINE,
    OPTION_MAX_STATES,
    OPTION_MAX_LENGTH,
    OPTION_THREADS(plans.threads),
};

const tn_command tn_command_match = {
    .name = "match",
    .summary = "print which rules match each plan",
    .usage = "RULES [PLANS] [--rule NAME]... [--format names|json|bits|any]",
    .description =
        "Reads plans (plan lines, JSON lines, CSV, packed, SQLite or Parquet; from standard input if no file or - is "
        "given). For each plan it writes a line with the rules that match, of those that the file itself holds, "
        "in their order. The exit code is 0 whether or not a rule matches.\n\n"
        "If the file has rules about houses, or --rule names one, house lines are read instead (docs/houses.md). "
        "Their tiles may be left out, and so may other values: a line then stands for the first house of the form that "
        "has what is typed.",
    .example = "$ tartan match lahave plans.txt --rule narrow-pair --format bits",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a rule file and a file of plans",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
