/* tartan match: which rules each plan matches. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/house/judged.h"
#include "cli/plan/chosen_rules.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"

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

enum { FORMAT_NAMES, FORMAT_JSON, FORMAT_BITS };

/* The rules to match, and where the answers go. */
typedef struct matching {
    tn_job *job;
    const char *path; /* of the plans */
    tn_chosen_rules rules;
    tn_schema *schema;
    tn_rules *compiled;
    tn_output output;
} matching;

static const char *rule_name(const void *context, size_t i)
{
    const matching *m = context;
    const tn_module *module = m->job->opened.module;
    return tn_text(module, module->RULE_records[m->rules.indices[i]].name);
}

static bool choose_rules(matching *m)
{
    return tn_job_choose_rules(m->job, &settings_of(m->job)->rules,
                               "name one of those it uses with --rule, or filter with `tartan prune`", &m->rules);
}

static bool compile_rules(matching *m)
{
    const match_settings *settings = settings_of(m->job);
    const tn_module *module = m->job->opened.module;
    tn_rules_options options = {.engine = (tn_matching_engine)settings->engine,
                                .max_states = (uint32_t)settings->plans.max_states.value,
                                .max_length = tn_job_max_length(&settings->plans)};
    uint32_t *functions = malloc(sizeof *functions * m->rules.count);
    tn_error error;
    tn_status status =
        functions ? tn_schema_new(module, m->rules.schema, 0, &m->schema, &error) : tn_fail_memory(&error);
    for (size_t i = 0; functions && i < m->rules.count; i++)
        functions[i] = module->RULE_records[m->rules.indices[i]].holds;
    if (status == TN_OK)
        status = tn_rules_new(m->schema, functions, m->rules.count, &options, &m->compiled, &error);
    free(functions);
    if (status != TN_OK)
        tn_job_fail(m->job, &error);
    return status == TN_OK;
}

static bool is_matched(const tn_sifted *plan, size_t i)
{
    return plan->bits[i / 64] >> (i % 64) & 1;
}

/* In one piece: a plan is matched in some nanoseconds, and a call a rule would take longer. */
static bool append_bits(const matching *m, const tn_sifted *plan, tn_buffer *out)
{
    if (!tn_buffer_reserve(out, m->rules.count))
        return false;
    for (size_t i = 0; i < m->rules.count; i++)
        out->data[out->size++] = is_matched(plan, i) ? '1' : '0';
    return true;
}

static bool append_text(tn_buffer *out, const char *text)
{
    return tn_buffer_append(out, text, strlen(text));
}

/* The names of the rules that match, each between quotes. */
static bool append_names(const matching *m, const tn_sifted *plan, const char *between, const char *quote,
                         tn_buffer *out)
{
    const char *before = "";
    for (size_t i = 0; i < m->rules.count; i++) {
        if (!is_matched(plan, i))
            continue;
        if (!append_text(out, before) || !append_text(out, quote) || !append_text(out, rule_name(m, i)) ||
            !append_text(out, quote))
            return false;
        before = between;
    }
    return true;
}

static bool append_names_or_dash(const matching *m, const tn_sifted *plan, tn_buffer *out)
{
    size_t before = out->size;
    return append_names(m, plan, " ", "", out) && (out->size > before || append_text(out, "-"));
}

/* Names of rules hold nothing that JSON would escape. */
static bool append_object(const matching *m, const tn_sifted *plan, tn_buffer *out)
{
    tn_buffer line = {0};
    bool done = tn_plan_write_line(m->schema, plan->trays, plan->length, &line) &&
                tn_buffer_printf(out, "{\"line\":%" PRIu64 ",\"plan\":", plan->line) &&
                tn_buffer_append_json(out, line.data ? line.data : "") && append_text(out, ",\"rules\":[") &&
                append_names(m, plan, ",", "\"", out) && append_text(out, "]}");
    free(line.data);
    return done;
}

static bool describe(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const matching *m = context;
    tn_buffer *out = &texts[0];
    bool done;
    if (settings_of(m->job)->format == FORMAT_BITS)
        done = append_bits(m, plan, out);
    else if (settings_of(m->job)->format == FORMAT_NAMES)
        done = append_names_or_dash(m, plan, out);
    else
        done = append_object(m, plan, out);
    return done && append_text(out, "\n");
}

static bool open_output(void *context)
{
    matching *m = context;
    return tn_job_output(m->job, settings_of(m->job)->output, &m->output);
}

static void match_plans(matching *m)
{
    tn_sifting sifting = {.job = m->job,
                          .source = {m->path, &settings_of(m->job)->input, &settings_of(m->job)->plans},
                          .schema = m->schema,
                          .rules = m->compiled,
                          .numbered = settings_of(m->job)->format == FORMAT_JSON,
                          .open = open_output,
                          .plan = describe,
                          .streams = {&m->output.stream},
                          .context = m};
    tn_job_fallbacks(m->job, m->compiled, rule_name, m);
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
    if (open && tn_job_matches_houses(&job, &settings->rules))
        tn_job_match_houses(&job, &settings->rules, m.path, (tn_house_answer)settings->format, settings->output,
                            tn_job_max_length(&settings->plans));
    else if (open && choose_rules(&m) && compile_rules(&m))
        match_plans(&m);
    tn_rules_free(m.compiled);
    tn_schema_free(m.schema);
    tn_chosen_rules_clear(&m.rules);
    return tn_job_end(&job);
}

#define SETTINGS match_settings
static const tn_option options[] = {
    LIST("rule", 'r', "NAME", rules, "match this rule; may be repeated (default: all rules of the file itself)"),
    CHOICE("format", 'f', "FORMAT", format, "names|json|bits",
           "names (default): the names of the rules, or - where there is none; json: an object a line; bits: a 0 or 1 "
           "a rule"),
    OPTION_OUTPUT,
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
    .usage = "RULES [PLANS] [--rule NAME]... [--format names|json|bits]",
    .description =
        "Reads plans (plan lines, JSON lines, CSV, packed, SQLite or Parquet; from standard input if no file or - is "
        "given). For each plan it writes a line with the rules that match, of those that the file itself holds, "
        "in their order. The exit code is 0 whether or not a rule matches.\n\n"
        "If the file has rules about houses, or --rule names one, house lines are read instead (docs/houses.md). "
        "Their tiles may be left out.",
    .example = "$ tartan match lahave plans.txt --rule narrow-pair --format bits",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a rule file and a file of plans",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
