/* tartan schema: what a file of rules has. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/listed.h"
#include "cli/common/options.h"
#include "driver/open/digits.h"

static void write_field(const tn_shown_field *field, int width, FILE *out)
{
    fprintf(out, "  %-*s  %-6s ", width, field->name, field->kind);
    for (size_t i = 0; i < field->values.count; i++)
        fprintf(out, "%s%s", i ? ", " : " ", field->values.items[i].spelling);
    if (field->has_said_by)
        fprintf(out, "  %s %s", strcmp(field->kind, "flag") == 0 ? "rule" : "measure", field->said_by);
    tn_listed_write_doc(field->doc, out);
}

/* For how many plans trays stand: the first of them, for people. */
static void write_tray_plans(const tn_shown_schema *schema, FILE *out)
{
    enum { SHOWN = 20 };
    size_t count = schema->tray_plans.count, shown = count > SHOWN ? SHOWN : count;
    int trays = 0, plans = 0;
    for (size_t i = 0; i < shown; i++) {
        int width = (int)strlen(schema->tray_plans.items[i].tray),
            digits = tn_digits_width(schema->tray_plans.items[i].plans, "");
        trays = width > trays ? width : trays;
        plans = digits > plans ? digits : plans;
    }
    fprintf(out, "  stands for plans of %s\n", schema->library);
    for (size_t i = 0; i < shown; i++) {
        char *digits = tn_digits(schema->tray_plans.items[i].plans, true);
        fprintf(out, "    %-*s  %*s\n", trays, schema->tray_plans.items[i].tray, plans, digits ? digits : "?");
        free(digits);
    }
    if (count > shown)
        fprintf(out, "    and %zu more\n", count - shown);
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
    tn_listed_write_doc(schema->doc, out);
    for (size_t i = 0; i < schema->fields.count; i++)
        write_field(&schema->fields.items[i], width, out);
    for (size_t i = 0; i < schema->forbidden.count; i++)
        fprintf(out, "  forbid %s\n", schema->forbidden.items[i]);
    for (size_t i = 0; i < schema->only.count; i++)
        fprintf(out, "  only %s\n", schema->only.items[i]);
    if (schema->has_tray_plans)
        write_tray_plans(schema, out);
}

static void write_library(const tn_shown_library *library, FILE *out)
{
    if (library->has_trays)
        fprintf(out, "library %s of %s, %" PRIu64 " to %" PRIu64 " trays", library->name, library->schema,
                library->trays.from, library->trays.to);
    else
        fprintf(out, "library %s of houses on %s in %s", library->name, library->plans, library->form);
    tn_listed_write_doc(library->doc, out);
    for (size_t i = 0; i < library->clauses.count; i++) {
        const tn_shown_clause *clause = &library->clauses.items[i];
        fprintf(out, "  %-7s %s", clause->kind, clause->name);
        tn_listed_write_doc(clause->doc, out);
    }
    for (size_t i = 0; i < library->preferences.count; i++) {
        const tn_shown_preference *preference = &library->preferences.items[i];
        fprintf(out, "  %-7s %s %s", "prefer", preference->name, preference->shown);
        tn_listed_write_doc(preference->doc, out);
    }
    for (size_t i = 0; i < library->weights.count; i++)
        fprintf(out, "  %-7s %s %s\n", "weight", library->weights.items[i].name, library->weights.items[i].shown);
}

/* As in the file. */
static void write_param(const tn_shown_param *param, FILE *out)
{
    fprintf(out, "param %s = %s", param->name, param->value);
    tn_listed_write_values(param->least, param->most, param->words.items, param->words.count, out);
    tn_listed_write_doc(param->doc, out);
}

static void write_text(const void *answer, FILE *out)
{
    const tn_shown_file *file = answer;
    for (size_t i = 0; i < file->schemas.count; i++)
        write_schema(&file->schemas.items[i], out);
    for (size_t i = 0; i < file->rules.count; i++) {
        const tn_shown_rule *rule = &file->rules.items[i];
        fprintf(out, "rule %s about %s", rule->name, rule->has_schema ? rule->schema : rule->form);
        tn_listed_write_doc(rule->doc, out);
    }
    for (size_t i = 0; i < file->libraries.count; i++)
        write_library(&file->libraries.items[i], out);
    for (size_t i = 0; i < file->measures.count; i++) {
        const tn_shown_measure *measure = &file->measures.items[i];
        fprintf(out, "measure %s of %s%s%s", measure->name, measure->has_schema ? measure->schema : measure->form,
                *measure->unit ? " in " : "", measure->unit);
        tn_listed_write_doc(measure->doc, out);
    }
    for (size_t i = 0; i < file->params.count; i++)
        write_param(&file->params.items[i], out);
}

static tn_status ask(tn_session *session, bool used, tn_reply *answer)
{
    return tn_ask_schema(session, &(tn_schema_request){.used = used}, answer);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    return tn_listed_run(&(tn_listed){ask, write_text}, settings);
}

#define SETTINGS tn_listed_settings
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
