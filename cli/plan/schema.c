/* tartan schema: what a file of rules has. */
#include <inttypes.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/option_rows.h"

typedef struct schema_settings {
    tn_settings common;
    bool used, json;
} schema_settings;

static void write_doc(bool has, const char *doc, FILE *out)
{
    if (has)
        fprintf(out, "  \"%s\"", doc);
    fputc('\n', out);
}

static void write_field(const tn_shown_field *field, int width, FILE *out)
{
    fprintf(out, "  %-*s  %-6s ", width, field->name, field->kind);
    for (size_t i = 0; i < field->values.count; i++)
        fprintf(out, "%s%s", i ? ", " : " ", field->values.items[i].spelling);
    write_doc(field->has_doc, field->doc, out);
}

static void write_schema(const tn_shown_schema *schema, FILE *out)
{
    int width = 0;
    for (size_t i = 0; i < schema->fields.count; i++) {
        int wide = (int)strlen(schema->fields.items[i].name);
        width = wide > width ? wide : width;
    }
    fprintf(out, "schema %s: %" PRIu64 " trays", schema->name, schema->trays);
    if (schema->trays < schema->combinations)
        fprintf(out, " of %" PRIu64 " combinations", schema->combinations);
    write_doc(schema->has_doc, schema->doc, out);
    for (size_t i = 0; i < schema->fields.count; i++)
        write_field(&schema->fields.items[i], width, out);
    for (size_t i = 0; i < schema->forbidden.count; i++)
        fprintf(out, "  forbid %s\n", schema->forbidden.items[i]);
}

static void write_library(const tn_shown_library *library, FILE *out)
{
    if (library->has_trays)
        fprintf(out, "library %s of %s, %" PRIu64 " to %" PRIu64 " trays", library->name, library->schema,
                library->trays.from, library->trays.to);
    else
        fprintf(out, "library %s of houses on %s in %s", library->name, library->plans, library->form);
    write_doc(library->has_doc, library->doc, out);
    for (size_t i = 0; i < library->clauses.count; i++) {
        const tn_shown_clause *clause = &library->clauses.items[i];
        fprintf(out, "  %-7s %s", clause->kind, clause->name);
        write_doc(clause->has_doc, clause->doc, out);
    }
    for (size_t i = 0; i < library->preferences.count; i++) {
        const tn_shown_preference *preference = &library->preferences.items[i];
        fprintf(out, "  %-7s %s %s", "prefer", preference->name, preference->shown);
        write_doc(preference->has_doc, preference->doc, out);
    }
    for (size_t i = 0; i < library->weights.count; i++)
        fprintf(out, "  %-7s %s %s\n", "weight", library->weights.items[i].name, library->weights.items[i].shown);
}

/* As in the file. */
static void write_param(const tn_shown_param *param, FILE *out)
{
    fprintf(out, "param %s = %s", param->name, param->value);
    if (param->has_least)
        fprintf(out, " in %s..%s", param->least, param->most);
    for (size_t i = 0; param->has_words && i < param->words.count; i++)
        fprintf(out, "%s%s", i == 0 ? ", one of " : ", ", param->words.items[i]);
    write_doc(param->has_doc, param->doc, out);
}

static void write_text(const tn_shown_file *file, FILE *out)
{
    for (size_t i = 0; i < file->schemas.count; i++)
        write_schema(&file->schemas.items[i], out);
    for (size_t i = 0; i < file->rules.count; i++) {
        const tn_shown_rule *rule = &file->rules.items[i];
        fprintf(out, "rule %s about %s", rule->name, rule->has_schema ? rule->schema : rule->form);
        write_doc(rule->has_doc, rule->doc, out);
    }
    for (size_t i = 0; i < file->libraries.count; i++)
        write_library(&file->libraries.items[i], out);
    for (size_t i = 0; i < file->measures.count; i++) {
        const tn_shown_measure *measure = &file->measures.items[i];
        fprintf(out, "measure %s of %s%s%s", measure->name, measure->has_schema ? measure->schema : measure->form,
                *measure->unit ? " in " : "", measure->unit);
        write_doc(measure->has_doc, measure->doc, out);
    }
    for (size_t i = 0; i < file->params.count; i++)
        write_param(&file->params.items[i], out);
}

static void show(tn_job *job, const schema_settings *settings)
{
    const tn_schema_request request = {.used = settings->used};
    tn_reply answer;
    tn_output output;
    if (tn_job_answered(job, tn_ask_schema(&job->session, &request, &answer)) && tn_job_output(job, NULL, &output)) {
        if (settings->json)
            tn_job_write_json(&answer, output.stream);
        else
            write_text(answer.value, output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open(&job, common->operands.items[0]))
        show(&job, (const schema_settings *)common);
    return tn_job_end(&job);
}

#define SETTINGS schema_settings
static const tn_option options[] = {
    FLAG("used", 0, used, "also the rules, libraries and measures of files that it uses"),
    OPTION_SET,
    FLAG("json", 0, json, "write JSON"),
};

const tn_command tn_command_schema = {
    .name = "schema",
    .summary = "list what a rule file has: fields, values, rules, libraries, measures",
    .usage = "FILE [--used] [--json]",
    .description =
        "Lists the schemas of a rule file with the fields of their trays, the values of each and what is forbidden, "
        "then its rules, its libraries with their clauses, and its measures with their units, each with what its "
        "author says of it. Schemas of files that it uses are listed, too; with --used also the rest of these files.",
    .example = "$ tartan schema terrace",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
