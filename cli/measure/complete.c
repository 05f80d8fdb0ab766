/* tartan complete: what may still be chosen in an open plan. */
#include <stdlib.h>

#include "cli/common/option_rows.h"
#include "cli/measure/complete_why.h"
#include "cli/measure/wishes.h"
#include "compiler/plan/syntax/program.h"
#include "driver/open/digits.h"
#include "runtime/plan/measure/bins.h"
#include "runtime/plan/measure/complete.h"
#include "runtime/plan/picture/draw_open.h"

typedef struct complete_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_option_list wanted; /* wishes */
    bool json;
    const char *output;
} complete_settings;

static const complete_settings *settings_of(const tn_job *job)
{
    return (const complete_settings *)job->settings;
}

/* What was found, of plans or of houses. library: of the plans; NULL: of houses. */
typedef struct paper {
    const tn_schema *schema;
    const tn_library *library;
    const char *title, *doc, *what;
    const tn_open_plan *open;
    const tn_completions *found;
    const char *measure; /* NULL: none */
    bool most;
    mpq_srcptr step; /* of the measure, in nanometres to its power */
    tn_amount_unit unit;
} paper;

static mpz_t *count_at(const paper *p, uint32_t tray, uint32_t field, uint32_t value)
{
    return &p->found->counts[(size_t)tray * p->found->values + p->schema->value_start[field] + value];
}

static bool write_amount(const paper *p, int64_t steps, bool write(tn_amount_unit, const mpq_t, tn_buffer *),
                         tn_buffer *text)
{
    mpq_t value;
    mpq_init(value);
    mpq_set_si(value, steps, 1);
    mpq_mul(value, value, p->step);
    bool ok = write(p->unit, value, text);
    mpq_clear(value);
    return ok;
}

/* The best that the measure can still be with the value, for people; nothing where none is asked for, or the value
 * cannot stand there. */
static bool write_best(const paper *p, uint32_t tray, uint32_t field, uint32_t value, tn_buffer *text)
{
    size_t at = (size_t)tray * p->found->values + p->schema->value_start[field] + value;
    if (!p->found->best || mpz_sgn(p->found->counts[at]) == 0)
        return true;
    return write_amount(p, p->found->best[at], tn_amount_write, text);
}

/* "least cost" */
static void name_best(const paper *p, char *text, size_t size)
{
    snprintf(text, size, "%s %.200s", p->most ? "most" : "least", p->measure);
}

static const char *spelling(const paper *p, uint32_t field, uint32_t value)
{
    return tn_text(p->schema->module, p->schema->values[p->schema->value_start[field] + value].spelling);
}

/* The count; with a measure the best value beside it. */
static void choice_json(const paper *p, uint32_t tray, uint32_t field, uint32_t value, tn_json *json)
{
    const char *key = spelling(p, field, value);
    mpz_srcptr count = *count_at(p, tray, field, value);
    if (!p->found->best) {
        tn_json_digits(json, key, count);
        return;
    }
    tn_buffer exact = {0};
    size_t at = (size_t)tray * p->found->values + p->schema->value_start[field] + value;
    bool any = mpz_sgn(count) > 0 && write_amount(p, p->found->best[at], tn_amount_write_exact, &exact);
    tn_json_object(json, key);
    tn_json_digits(json, p->what, count);
    tn_json_string(json, "best", any ? exact.data : NULL);
    tn_json_object_end(json);
    free(exact.data);
}

static void write_json(const paper *p, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_LINES);
    tn_json_object(&json, NULL);
    tn_json_digits(&json, p->what, p->found->plans);
    tn_json_list(&json, "trays");
    for (uint32_t t = 0; t < p->found->trays; t++) {
        tn_json_object(&json, NULL);
        for (uint32_t f = 0; f < p->schema->field_count; f++) {
            tn_json_object(&json, tn_text(p->schema->module, p->schema->fields[f].name));
            for (uint32_t v = 0; v < p->schema->fields[f].value_count; v++)
                choice_json(p, t, f, v, &json);
            tn_json_object_end(&json);
        }
        tn_json_object_end(&json);
    }
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
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
        tn_buffer best = {0};
        bool told = write_best(p, tray, field, v, &best) && best.data;
        fprintf(out, "%s%s: %s%s%s%s", any ? ",  " : "", spelling(p, field, v), digits ? digits : "", told ? " (" : "",
                told ? best.data : "", told ? ")" : "");
        free(best.data);
        free(digits);
        any = true;
    }
    fputs(any ? "\n" : "-\n", out);
}

static void write_text(const paper *p, FILE *out)
{
    char *plans = tn_digits(p->found->plans, true);
    char best[256];
    fprintf(out, "%s %s complete it", plans ? plans : "", p->what);
    if (p->found->best) {
        name_best(p, best, sizeof best);
        fprintf(out, "; in brackets the %s that is left", best);
    }
    fputc('\n', out);
    free(plans);
    for (uint32_t t = 0; t < p->found->trays && mpz_sgn(p->found->plans) > 0; t++) {
        fprintf(out, "\nwritten tray %u\n", t + 1);
        for (uint32_t f = 0; f < p->schema->field_count; f++)
            write_field(p, t, f, out);
    }
}

/* ---- the picture */

static bool take_choices(const paper *p, tn_drawn_choice *choices)
{
    bool ok = true;
    for (uint32_t t = 0; t < p->found->trays; t++)
        for (uint32_t f = 0; f < p->schema->field_count; f++)
            for (uint32_t v = 0; ok && v < p->schema->fields[f].value_count; v++) {
                mpz_t *count = count_at(p, t, f, v);
                tn_drawn_choice *choice = choices++;
                tn_buffer best = {0};
                choice->share = tn_bins_share(*count, p->found->plans);
                choice->count = tn_digits(*count, true);
                ok = write_best(p, t, f, v, &best) && choice->count;
                choice->best = best.data;
            }
    return ok;
}

static tn_status draw_choices(const paper *p, const tn_drawn_choice *choices, tn_picture *to, tn_error *error)
{
    char about[512], best[256] = "";
    char *plans = tn_digits(p->found->plans, true);
    if (!plans)
        return tn_fail_memory(error);
    if (p->found->best)
        name_best(p, best, sizeof best);
    snprintf(about, sizeof about, "%.200s %s complete the open plan%s%s%s", plans, p->what,
             p->found->best ? "; beside each count the " : "", p->found->best ? best : "",
             p->found->best ? " that is left" : "");
    free(plans);
    const tn_drawn_open open = {.title = p->title,
                                .doc = p->doc,
                                .about = about,
                                .best_name = p->found->best ? best : NULL,
                                .functions = p->open->functions,
                                .count = p->open->count,
                                .choices = choices};
    return tn_open_plan_draw(p->schema, &open, to, error);
}

static void draw(tn_job *job, const paper *p)
{
    size_t count = (size_t)p->found->trays * p->found->values;
    tn_drawn_choice *choices = calloc(count + 1, sizeof *choices);
    tn_error error;
    tn_status status = choices && take_choices(p, choices) ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK)
        status = draw_choices(p, choices, &(tn_picture){.path = settings_of(job)->output}, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    for (size_t i = 0; choices && i < count; i++) {
        free((char *)(uintptr_t)choices[i].count);
        free((char *)(uintptr_t)choices[i].best);
    }
    free(choices);
}

/* ---- the command */

static void show(tn_job *job, const paper *p)
{
    const complete_settings *settings = settings_of(job);
    tn_output output;
    tn_job_show(job);
    if (tn_job_draws(settings->output)) {
        draw(job, p);
    } else if (tn_job_output(job, settings->output, &output)) {
        (settings->json ? write_json : write_text)(p, output.stream);
        tn_error error;
        if (!settings->json && p->library && mpz_sgn(p->found->plans) == 0 &&
            tn_complete_why(p->library, p->open, output.stream, &error) != TN_OK)
            tn_job_fail(job, &error);
        tn_job_commit(job, &output);
    }
}

static void show_plans(tn_job *job, const tn_ready_library *ready, const tn_open_plan *open, const tn_wishes *wishes,
                       const tn_completions *found)
{
    const tn_module *module = ready->schema->module;
    paper p = {.schema = ready->schema,
               .library = ready->library,
               .title = tn_text(module, ready->record->name),
               .doc = tn_text(module, ready->record->doc),
               .what = "plans",
               .open = open,
               .found = found};
    if (wishes->count) {
        p.measure = tn_weighed_name(open->weighed, 0);
        p.most = wishes->most[0];
        p.step = tn_weighed_unit(open->weighed, 0);
        p.unit = wishes->unit[0];
    }
    show(job, &p);
}

static void show_houses(tn_job *job, const tn_house_completed *completed)
{
    const tn_module *module = completed->schema->module;
    show(job, &(paper){.schema = completed->schema,
                       .title = tn_text(module, completed->library->name),
                       .doc = tn_text(module, completed->library->doc),
                       .what = "houses",
                       .open = completed->open,
                       .found = completed->found,
                       .measure = completed->measure,
                       .most = completed->most,
                       .step = completed->step,
                       .unit = completed->unit});
}

static bool takes_one(tn_job *job, const tn_wishes *wishes)
{
    if (wishes->count > 1)
        tn_job_usage(job, "complete looks at one measure: give one --least or --most");
    return wishes->count <= 1;
}

static void complete_houses(tn_job *job)
{
    const complete_settings *settings = settings_of(job);
    const tn_program *program = job->opened.compilation.program;
    const tn_open_plan open = {.functions = program->pattern, .count = program->pattern_count};
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    tn_wishes wishes = {0};
    if ((settings->json && !tn_job_takes_text(job, settings->output)) ||
        (settings->wanted.count > 0 && !tn_wishes_names(job, &settings->wanted, 1, &wishes)) ||
        !takes_one(job, &wishes))
        return;
    const tn_house_wishes of = tn_wishes_of_houses(&wishes);
    tn_job_complete_houses(job, &houses, &of, &open, show_houses);
}

static void complete(tn_job *job, const tn_ready_library *ready)
{
    const complete_settings *settings = settings_of(job);
    const tn_program *program = job->opened.compilation.program;
    tn_completions found;
    tn_wishes wishes = {0};
    tn_open_plan open = {.functions = program->pattern, .count = program->pattern_count};
    tn_error error;
    if ((settings->json && !tn_job_takes_text(job, settings->output)) ||
        (settings->wanted.count > 0 && !tn_wishes_read(job, ready, &settings->wanted, 1, &wishes)))
        return;
    if (!takes_one(job, &wishes))
        return;
    tn_status status = wishes.count ? tn_weighed_new(ready->library, wishes.measures, 1, &open.weighed, &error) : TN_OK;
    open.most = wishes.most[0];
    if (status != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    status = tn_complete(&found, ready->library, &open, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    else
        show_plans(job, ready, &open, &wishes, &found);
    tn_completions_clear(&found);
    tn_weighed_free(open.weighed);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const complete_settings *settings = (const complete_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    tn_job_begin(&job, common);
    if (tn_job_open_plan(&job, common->operands.items[0], &settings->plans, common->operands.items[1])) {
        if (tn_job_of_houses(&job, &settings->plans))
            complete_houses(&job);
        else if (tn_job_opened_library(&job, &settings->plans, &ready))
            complete(&job, &ready);
    }
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS complete_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "also say the least MEASURE that each value leaves"),
    WISH("most", wanted, "also say the most MEASURE that each value leaves"),
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_complete = {
    .name = "complete",
    .summary = "count the plans that complete an open plan",
    .usage = "FILE PATTERN [--library NAME] [--least MEASURE | --most MEASURE] [--json]\nFILE PATTERN -o "
             "OPEN.svg\nFILE PATTERN --library "
             "HOUSES [--least MEASURE]",
    .description =
        "An open plan is trays between bars: what is written of a tray in the words of `tray(...)`, `?` for "
        "any tray, `...` "
        "for any number of trays, also none. Says how many plans of the library complete it, and of each "
        "written tray how "
        "many of these have which value there. Where a plan fits in several ways, the leftmost counts. To "
        "list completions, "
        "give other commands --where \"plan [PATTERN]\". With --least or --most, the best value of a measure that each "
        "choice "
        "still leaves is said too.\n\n"
        "With -o and the name of a picture (.svg, .png or .pdf) the open plan is drawn, and below each written tray "
        "its choices.\n\n"
        "With --library HOUSES it counts the houses whose plans complete it (docs/houses.md).",
    .example = "$ tartan complete lahave-houses \"8' public | ? | great | ...\"",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a PATTERN",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
