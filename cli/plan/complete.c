/* tartan complete: what may still be chosen in an open plan. */
#include <jansson.h>
#include <stdlib.h>

#include "cli/common/option_rows.h"
#include "cli/plan/library_job.h"
#include "compiler/plan/syntax/program.h"
#include "driver/open/digits.h"
#include "runtime/plan/measure/complete.h"

typedef struct complete_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool json;
    const char *output;
} complete_settings;

static const complete_settings *settings_of(const tn_job *job)
{
    return (const complete_settings *)job->settings;
}

typedef struct paper {
    const tn_schema *schema;
    const tn_completions *found;
} paper;

static mpz_t *count_at(const paper *p, uint32_t tray, uint32_t field, uint32_t value)
{
    return &p->found->counts[(size_t)tray * p->found->values + p->schema->value_start[field] + value];
}

static const char *spelling(const paper *p, uint32_t field, uint32_t value)
{
    return tn_text(p->schema->module, p->schema->values[p->schema->value_start[field] + value].spelling);
}

static void write_json(const paper *p, FILE *out)
{
    json_t *root = json_object(), *trays = json_array();
    char *plans = tn_digits(p->found->plans, false);
    json_object_set_new(root, "plans", json_string(plans ? plans : ""));
    free(plans);
    for (uint32_t t = 0; t < p->found->trays; t++) {
        json_t *tray = json_object();
        for (uint32_t f = 0; f < p->schema->field_count; f++) {
            json_t *values = json_object();
            for (uint32_t v = 0; v < p->schema->fields[f].value_count; v++) {
                char *digits = tn_digits(*count_at(p, t, f, v), false);
                json_object_set_new(values, spelling(p, f, v), json_string(digits ? digits : ""));
                free(digits);
            }
            json_object_set_new(tray, tn_text(p->schema->module, p->schema->fields[f].name), values);
        }
        json_array_append_new(trays, tray);
    }
    json_object_set_new(root, "trays", trays);
    json_dumpf(root, out, JSON_INDENT(2));
    fputc('\n', out);
    json_decref(root);
}

static void write_field(const paper *p, uint32_t tray, uint32_t field, FILE *out)
{
    fprintf(out, "  %-16s", tn_text(p->schema->module, p->schema->fields[field].name));
    bool any = false;
    for (uint32_t v = 0; v < p->schema->fields[field].value_count; v++) {
        mpz_t *count = count_at(p, tray, field, v);
        if (mpz_sgn(*count) == 0)
            continue;
        char *digits = tn_digits(*count, true);
        fprintf(out, "%s%s: %s", any ? ",  " : "", spelling(p, field, v), digits ? digits : "");
        free(digits);
        any = true;
    }
    fputs(any ? "\n" : "-\n", out);
}

static void write_text(const paper *p, FILE *out)
{
    char *plans = tn_digits(p->found->plans, true);
    fprintf(out, "%s plans complete it\n", plans ? plans : "");
    free(plans);
    for (uint32_t t = 0; t < p->found->trays && mpz_sgn(p->found->plans) > 0; t++) {
        fprintf(out, "\nwritten tray %u\n", t + 1);
        for (uint32_t f = 0; f < p->schema->field_count; f++)
            write_field(p, t, f, out);
    }
}

static void complete(tn_job *job, const tn_ready_library *ready)
{
    const tn_program *program = job->opened.compilation.program;
    tn_completions found;
    tn_error error;
    tn_output output;
    tn_status status = tn_complete(&found, ready->library, program->pattern, program->pattern_count, &error);
    paper p = {ready->schema, &found};
    tn_job_show(job);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, settings_of(job)->output, &output)) {
        (settings_of(job)->json ? write_json : write_text)(&p, output.stream);
        tn_job_commit(job, &output);
    }
    tn_completions_clear(&found);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const complete_settings *settings = (const complete_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    tn_job_begin(&job, common);
    if (tn_job_library_open_plan(&job, common->operands.items[0], &settings->plans, common->operands.items[1], &ready))
        complete(&job, &ready);
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS complete_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    OPTION_OUTPUT,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_complete = {
    .name = "complete",
    .summary = "count the plans that complete an open plan",
    .usage = "FILE PATTERN [--library NAME] [--json]",
    .description = "An open plan is trays between bars: what is written of a tray in the words of `tray(...)`, `?` for "
                   "any tray, `...` "
                   "for any number of trays, also none. Says how many plans of the library complete it, and of each "
                   "written tray how "
                   "many of these have which value there. Where a plan fits in several ways, the leftmost counts. To "
                   "list completions, "
                   "give other commands --where \"plan [PATTERN]\".",
    .example = "$ tartan complete lahave-houses \"8' public | ? | great | ...\"",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a PATTERN",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
