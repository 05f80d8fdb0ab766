/* tartan match: which rules each plan matches. */
#include <jansson.h>
#include <stdlib.h>

#include "cli/chosen_rules.h"
#include "cli/library_job.h"
#include "cli/option_rows.h"
#include "cli/plan_input.h"

enum { FORMAT_NAMES, FORMAT_JSON, FORMAT_BITS };

/* The rules to match, and where the answers go. */
typedef struct matching {
    tn_job *job;
    const char *path; /* of the plans */
    tn_chosen_rules rules;
    tn_schema *schema;
    tn_rules *compiled;
    tn_output output;
    tn_buffer line;
    char *digits; /* [count + 1]: a line of bits */
    tn_sifting sifting;
} matching;

static const char *rule_name(const void *context, size_t i)
{
    const matching *m = context;
    const tn_module *module = m->job->opened.module;
    return tn_text(module, module->RULE_records[m->rules.indices[i]].name);
}

static bool choose_rules(matching *m)
{
    tn_error error;
    if (!tn_job_choose_rules(m->job, "name one of those it uses with --rule, or filter with `tartan prune`", &m->rules))
        return false;
    m->digits = malloc(m->rules.count + 1);
    if (!m->digits) {
        tn_fail_memory(&error);
        tn_job_fail(m->job, &error);
    }
    return m->digits != NULL;
}

static bool compile_rules(matching *m)
{
    const tn_settings *settings = m->job->settings;
    const tn_module *module = m->job->opened.module;
    tn_rules_options options = {.engine = (tn_engine)settings->engine,
                                .max_states = (uint32_t)settings->max_states.value,
                                .max_length = tn_job_max_length(settings)};
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
static void write_bits(const matching *m, const tn_sifted *plan)
{
    for (size_t i = 0; i < m->rules.count; i++)
        m->digits[i] = is_matched(plan, i) ? '1' : '0';
    m->digits[m->rules.count] = '\n';
    fwrite_unlocked(m->digits, 1, m->rules.count + 1, m->output.stream);
}

static void write_names(const matching *m, const tn_sifted *plan)
{
    const char *between = "";
    for (size_t i = 0; i < m->rules.count; i++) {
        if (!is_matched(plan, i))
            continue;
        fprintf(m->output.stream, "%s%s", between, rule_name(m, i));
        between = " ";
    }
    if (!*between)
        fputc('-', m->output.stream);
}

static bool write_object(matching *m, const tn_sifted *plan)
{
    m->line.size = 0;
    if (!tn_plan_write_line(m->schema, plan->trays, plan->length, &m->line))
        return false;
    json_t *object = json_object(), *names = json_array();
    json_object_set_new(object, "line", json_integer((json_int_t)plan->line));
    json_object_set_new(object, "plan", json_string(m->line.data ? m->line.data : ""));
    for (size_t i = 0; i < m->rules.count; i++)
        if (is_matched(plan, i))
            json_array_append_new(names, json_string(rule_name(m, i)));
    json_object_set_new(object, "rules", names);
    bool written = json_dumpf(object, m->output.stream, JSON_COMPACT) == 0;
    json_decref(object);
    return written || ferror(m->output.stream);
}

static bool take(void *context, const tn_sifted *plan)
{
    matching *m = context;
    int format = m->job->settings->format;
    if (format == FORMAT_BITS) {
        write_bits(m, plan);
        return !ferror_unlocked(m->output.stream);
    }
    if (format == FORMAT_NAMES) {
        write_names(m, plan);
    } else if (!write_object(m, plan)) {
        return tn_sifting_out_of_memory(&m->sifting);
    }
    fputc('\n', m->output.stream);
    return !ferror(m->output.stream);
}

static bool open_output(void *context)
{
    matching *m = context;
    return tn_job_output(m->job, m->job->settings->output, &m->output);
}

static void match_plans(matching *m)
{
    m->sifting = (tn_sifting){.job = m->job,
                              .path = m->path,
                              .schema = m->schema,
                              .rules = m->compiled,
                              .open = open_output,
                              .take = take,
                              .context = m};
    tn_job_fallbacks(m->job, m->compiled, rule_name, m);
    if (tn_job_sift(&m->sifting))
        tn_job_close(m->job, &m->output, !m->sifting.stopped);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, settings);
    matching m = {.job = &job, .path = tn_job_plans_path(&job)};
    tn_job_threads(settings);
    if (m.path && tn_job_open(&job, settings->operands.items[0]) && choose_rules(&m) && compile_rules(&m))
        match_plans(&m);
    tn_rules_free(m.compiled);
    tn_schema_free(m.schema);
    tn_chosen_rules_clear(&m.rules);
    free(m.line.data);
    free(m.digits);
    return tn_job_end(&job);
}

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
    OPTION_THREADS,
};

const tn_command tn_command_match = {
    .name = "match",
    .summary = "say which rules each plan matches",
    .usage = "RULES [PLANS] [--rule NAME]... [--format names|json|bits]",
    .description = "Reads plans (plan lines, JSON lines, CSV, packed or SQLite; standard input where no file or - is "
                   "given) and writes a line "
                   "for each: the rules it matches, of those that the file itself holds, in their order. The exit code "
                   "is 0 whether or "
                   "not a rule matches.",
    .example = "$ tartan match lahave plans.txt --rule narrow-pair --format bits",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "a rule file and a file of plans",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
