/* tartan prune: filters plans through a library. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"
#include "driver/plan/clauses.h"

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
    tn_rules *rules;
    uint32_t trays_min, trays_max;
    tn_output kept, dropped;
    FILE *dropped_stream; /* NULL where nobody asked */
} pruning;

static const char *clause_name(const void *context, size_t i)
{
    const pruning *p = context;
    const tn_module *module = p->job->opened.module;
    return tn_text(module, module->CLAUSE_records[p->ready.record->clause_first + i].name);
}

static bool length_drops(const pruning *p, const tn_sifted *plan)
{
    return plan->length < p->trays_min || plan->length > p->trays_max;
}

static bool drops(const pruning *p, const tn_sifted *plan, size_t i)
{
    return tn_clause_drops(p->job->opened.module, p->ready.record, i, plan->bits);
}

static bool is_kept(const pruning *p, const tn_sifted *plan)
{
    if (length_drops(p, plan))
        return false;
    for (size_t i = 0; i < p->ready.record->clause_count; i++)
        if (drops(p, plan, i))
            return false;
    return true;
}

/* The names of what drops the plan, each between quotes. */
static bool append_reasons(const pruning *p, const tn_sifted *plan, const char *quote, tn_buffer *out)
{
    const char *between = "";
    bool done = true;
    if (length_drops(p, plan)) {
        done = tn_buffer_printf(out, "%strays%s", quote, quote);
        between = ", ";
    }
    for (size_t i = 0; done && i < p->ready.record->clause_count; i++) {
        if (!drops(p, plan, i))
            continue;
        done = tn_buffer_printf(out, "%s%s%s%s", between, quote, clause_name(p, i), quote);
        between = ", ";
    }
    return done;
}

/* A dropped plan: as plan lines, a comment with the reasons before it, so that the file can be read again; as JSON, the
 * object
 * {"trays": [...], "dropped_by": [...]}. Names hold nothing that JSON would escape. */
static bool append_dropped(const pruning *p, const tn_sifted *plan, tn_buffer *out)
{
    const tn_schema *schema = p->ready.schema;
    if (settings_of(p->job)->format == FORMAT_LINES)
        return tn_buffer_printf(out, "# dropped by ") && append_reasons(p, plan, "", out) &&
               tn_buffer_append(out, "\n", 1) && tn_plan_write_line(schema, plan->trays, plan->length, out);
    if (!tn_plan_write_json(schema, plan->trays, plan->length, out))
        return false;
    out->size -= out->data[out->size - 1] == '}';
    return tn_buffer_printf(out, ",\"dropped_by\":[") && append_reasons(p, plan, "\"", out) &&
           tn_buffer_printf(out, "]}");
}

static bool append_kept(const pruning *p, const tn_sifted *plan, tn_buffer *out)
{
    const tn_schema *schema = p->ready.schema;
    return settings_of(p->job)->format == FORMAT_JSON ? tn_plan_write_json(schema, plan->trays, plan->length, out)
                                                      : tn_plan_write_line(schema, plan->trays, plan->length, out);
}

/* Plans that go to the same stream are in the same text, in the order they came. */
static bool describe(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const pruning *p = context;
    bool kept = is_kept(p, plan);
    if (!kept && !p->dropped_stream)
        return true;
    tn_buffer *out = &texts[!kept && p->dropped_stream != p->kept.stream];
    return (kept ? append_kept(p, plan, out) : append_dropped(p, plan, out)) && tn_buffer_append(out, "\n", 1);
}

static bool compile_clauses(pruning *p)
{
    const prune_settings *settings = settings_of(p->job);
    tn_rules_options options = {.engine = (tn_matching_engine)settings->engine,
                                .max_states = (uint32_t)settings->plans.max_states.value,
                                .max_length = tn_job_max_length(&settings->plans)};
    tn_error error;
    p->trays_min = settings->plans.trays.given ? (uint32_t)settings->plans.trays.low : p->ready.record->trays_min;
    p->trays_max = settings->plans.trays.given ? (uint32_t)settings->plans.trays.high : p->ready.record->trays_max;
    if (tn_clause_rules_new(p->ready.schema, p->ready.record, &options, &p->rules, &error) == TN_OK) {
        tn_job_fallbacks(p->job, p->rules, clause_name, p);
        return true;
    }
    tn_job_fail(p->job, &error);
    return false;
}

/* Kept and dropped plans may both go to standard output, in the order they came. */
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
        return true;
    }
    if (tn_job_output(p->job, settings->dropped, &p->dropped)) {
        p->dropped_stream = p->dropped.stream;
        return true;
    }
    tn_output_discard(&p->kept);
    return false;
}

static void prune_plans(pruning *p)
{
    tn_sifting sifting = {.job = p->job,
                          .source = {p->path, &settings_of(p->job)->input, &settings_of(p->job)->plans},
                          .schema = p->ready.schema,
                          .rules = p->rules,
                          .open = open_outputs,
                          .plan = describe,
                          .streams = {&p->kept.stream, &p->dropped_stream},
                          .context = p};
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
    tn_rules_free(p.rules);
    tn_library_close(&p.ready);
    return tn_job_end(&job);
}

#define SETTINGS prune_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    TEXT("dropped", 'd', "FILE", dropped,
         "write the plans that are dropped to FILE, each with the clauses that drop it"),
    CHOICE("format", 'f', "FORMAT", format, "lines|json", "write plan lines (default) or JSON lines"),
    OPTION_OUTPUT,
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
