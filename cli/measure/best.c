/* tartan best: the best plans of a library by measures, in order. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/measure/best_search.h"
#include "cli/plan/plan_output.h"

enum { BEST_DEFAULT = 10, BEST_MAX = 1000000 };

typedef struct best_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    tn_option_list wanted; /* wishes */
    bool mirror;
    const char *plan;
} best_settings;

static const best_settings *settings_of(const tn_job *job)
{
    return (const best_settings *)job->settings;
}

/* Where the plans go: onto a sheet that is drawn, into lines with their values, JSON with them, or what `sample`
 * writes. */
typedef struct sink {
    tn_job *job;
    const tn_best_search *search;
    tn_plan_writer *writer; /* NULL: `output` */
    tn_output output;
    bool json, draws;
    tn_buffer text;
    tn_buffer values; /* as text: many plans in a row have the same */
    int64_t written[TN_WEIGHED_MAX];
} sink;

/* "value":"3/2" or "values":["3/2","4"] */
static bool values_json(sink *s, const int64_t *values)
{
    const tn_wishes *wishes = &s->search->wishes;
    tn_json json = tn_json_text(&s->values, TN_JSON_TIGHT);
    tn_buffer exact = {0};
    bool list = wishes->count > 1, ok = true;
    if (list)
        tn_json_list(&json, "values");
    for (uint32_t k = 0; ok && k < wishes->count; k++) {
        exact.size = 0;
        ok = tn_wishes_exact(wishes, s->search->weighed, k, values[k], &exact);
        tn_json_bytes(&json, list ? NULL : "value", exact.data, exact.size);
    }
    if (list)
        tn_json_list_end(&json);
    free(exact.data);
    return ok && !s->values.failed;
}

/* A comment in lines: "# 3 m  4". */
static bool values_text(sink *s, const int64_t *values)
{
    const tn_wishes *wishes = &s->search->wishes;
    bool ok = tn_buffer_printf(&s->values, "# ");
    for (uint32_t k = 0; ok && k < wishes->count; k++)
        ok = (k == 0 || tn_buffer_printf(&s->values, "  ")) &&
             tn_wishes_text(wishes, s->search->weighed, k, values[k], &s->values);
    return ok;
}

/* Makes s->values those of a plan. */
static bool make_values(sink *s, const int64_t *values)
{
    size_t size = s->search->wishes.count * sizeof *values;
    if (s->values.size > 0 && memcmp(values, s->written, size) == 0)
        return true;
    memcpy(s->written, values, size);
    s->values.size = 0;
    return (s->json ? values_json : values_text)(s, values);
}

static bool plan_json(sink *s, const tn_best_plan *plan, const char *rank)
{
    tn_json json = tn_json_text(&s->text, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_written(&json, s->values.data, s->values.size);
    tn_json_string(&json, "rank", rank);
    tn_plan_write_trays(s->search->ready->schema, plan->trays, plan->length, &json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return !s->text.failed;
}

static bool plan_text(sink *s, const tn_best_plan *plan, const char *rank)
{
    return tn_buffer_printf(&s->text, "%s  rank %s\n", s->values.data, rank) &&
           tn_plan_write_line(s->search->ready->schema, plan->trays, plan->length, &s->text) &&
           tn_buffer_printf(&s->text, "\n");
}

static tn_status put_plan(void *to, const tn_best_plan *plan, tn_error *error)
{
    sink *s = to;
    if (s->writer)
        return tn_plan_writer_write(s->writer, plan->rank, plan->trays, plan->length, error);
    s->text.size = 0;
    char *digits = mpz_get_str(NULL, 10, plan->rank);
    bool ok = digits && make_values(s, plan->values) && (s->json ? plan_json : plan_text)(s, plan, digits);
    free(digits);
    if (!ok)
        return tn_fail_memory(error);
    fwrite(s->text.data, 1, s->text.size, s->output.stream);
    return TN_OK;
}

enum { NOTES = 3, NOTE_SIZE = 256 };

static void draw_best(tn_best_search *search, uint64_t wanted)
{
    tn_job *job = search->job;
    const tn_ready_library *ready = search->ready;
    const tn_module *module = ready->schema->module;
    char aim[NOTE_SIZE] = "", hash[33], library[NOTE_SIZE], rules[NOTE_SIZE];
    const char *notes[NOTES] = {aim, library, rules};
    tn_error error;
    tn_plan_sheet sheet = {0};
    tn_best_search_sheet(search, wanted, settings_of(job)->mirror, &sheet);
    tn_library_hash(ready->library, hash);
    snprintf(library, sizeof library, "library %s", hash);
    tn_sheet_note_rules(job, rules, sizeof rules);
    const tn_draw_options options = {.title = tn_text(module, ready->record->name),
                                     .doc = tn_text(module, ready->record->doc),
                                     .number_name = "rank",
                                     .notes = notes,
                                     .note_count = NOTES};
    tn_status status = tn_best_search_aim(search, sheet.count, aim, sizeof aim) ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK && job->exit_code == TN_EXIT_DONE)
        status = tn_plans_draw(ready->schema, sheet.plans, sheet.count, &options,
                               &(tn_picture){.path = settings_of(job)->written.output}, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_sheet_clear(&sheet);
}

/* A picture by its name; text goes out here, so that values can stand with the plans; the other formats as `sample`
 * writes them. */
static bool open_sink(sink *s, uint64_t wanted)
{
    const tn_written_settings *settings = &settings_of(s->job)->written;
    tn_plan_format format = (tn_plan_format)settings->format;
    s->draws = format == TN_FORMAT_AUTO && tn_job_draws(settings->output);
    if (s->draws && wanted > TN_DRAW_PLANS_DEFAULT) {
        tn_help(tn_job_diagnostics(s->job),
                tn_job_usage(s->job, "a picture shows at most %u plans", TN_DRAW_PLANS_DEFAULT),
                "ask for fewer, or write them to a file that is not a picture");
        return false;
    }
    s->json = format == TN_FORMAT_JSON;
    bool text = s->json || format == TN_FORMAT_LINES || (format == TN_FORMAT_AUTO && !settings->output);
    return s->draws || (text ? tn_job_output(s->job, settings->output, &s->output)
                             : tn_job_plan_writer(s->job, s->search->ready, settings, "best", &s->writer));
}

static void write_best(sink *s, tn_best_search *search, uint64_t wanted)
{
    tn_best_search_give(search, wanted, settings_of(s->job)->mirror, put_plan, s);
    if (s->writer)
        tn_job_rows_close(s->job, s->writer);
    else
        tn_job_commit(s->job, &s->output);
    free(s->text.data);
    free(s->values.data);
}

static void find_best(tn_job *job, const tn_ready_library *ready, uint64_t wanted)
{
    tn_best_search search;
    sink s = {.job = job, .search = &search};
    if (tn_best_search_open(&search, job, ready, &settings_of(job)->wanted) && open_sink(&s, wanted)) {
        if (s.draws)
            draw_best(&search, wanted);
        else
            write_best(&s, &search, wanted);
    }
    tn_best_search_close(&search);
}

/* Houses are written as lines or JSON, or drawn; what else plans may be told is wrong usage. */
static void find_houses(tn_job *job, uint64_t wanted)
{
    const best_settings *settings = settings_of(job);
    tn_plan_format format = (tn_plan_format)settings->written.format;
    tn_wishes wishes;
    bool lines = format == TN_FORMAT_AUTO || format == TN_FORMAT_JSON || format == TN_FORMAT_LINES;
    if (settings->mirror) {
        tn_job_usage(job, "--mirror is about plans, not about houses");
        return;
    }
    if (!tn_job_writes(job, "a list of the best houses", settings->written.output,
                       TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES_PICTURES))
        return;
    if (!lines) {
        tn_diagnostic *d =
            tn_job_usage(job, "the best houses are written as lines or JSON, or drawn: leave out this --format");
        tn_help(tn_job_diagnostics(job), d, "-o NAME.svg, NAME.png or NAME.pdf draws them");
        return;
    }
    if (!tn_wishes_names(job, &settings->wanted, 1, &wishes))
        return;
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    tn_house_wishes of = tn_wishes_of_houses(&wishes);
    of.plan = settings->plan;
    of.wanted = wanted;
    of.json = format == TN_FORMAT_JSON;
    of.output = settings->written.output;
    if (tn_job_draws(of.output))
        tn_job_draw_houses(
            job, &houses,
            &(tn_house_sheet){
                .wanted = (size_t)wanted, .best = &of, .camera = tn_house_sheet_camera(), .output = of.output});
    else
        tn_job_best_houses(job, &houses, &of);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const best_settings *settings = (const best_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    uint64_t wanted = BEST_DEFAULT;
    tn_job_begin(&job, common);
    if (common->operands.count > 1 && (!tn_number_read(common->operands.items[1], &wanted) || wanted > BEST_MAX)) {
        tn_diagnostic *d = tn_job_usage(&job, "the number of plans is a number from 0 to %d, not `%.60s`", BEST_MAX,
                                        common->operands.items[1]);
        tn_help(tn_job_diagnostics(&job), d, "the file comes first: tartan best FILE N --least MEASURE");
    } else if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans)) {
        if (settings->plan || tn_job_of_houses(&job, &settings->plans))
            find_houses(&job, wanted);
        else if (tn_job_opened_library(&job, &settings->plans, &ready))
            find_best(&job, &ready, wanted);
    }
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS best_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "the plans with the least MEASURE first"),
    WISH("most", wanted, "the plans with the most MEASURE first"),
    WISH("then-least", wanted, "of equal ones those with the least of this measure; may be repeated"),
    WISH("then-most", wanted, "of equal ones those with the most of this measure; may be repeated"),
    FLAG("mirror", 0, mirror, "leave out a plan whose mirror image is kept and of lower rank"),
    TEXT("plan", 0, "PLAN", plan, "the best houses on one plan: a plan line, or # and its rank"),
    OPTION_PLAN_FORMAT,
    OUTPUT(
        written.output, TN_WRITES_ROWS | TN_WRITES_PICTURES,
        "write to FILE instead of standard output, as its ending says: .json, .csv, .bin, .sqlite and .db, .parquet, "
        "or .svg, .png and .pdf, a picture; otherwise as lines"),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_best = {
    .name = "best",
    .summary = "write the best plans of a library by a measure",
    .usage = "FILE [N] --least MEASURE\nFILE [N] --most MEASURE [--then-least MEASURE]\nFILE [N] --least MEASURE -o "
             "SHEET.svg\nFILE [N] --library HOUSES [--plan PLAN] --least MEASURE",
    .description =
        "Writes the N (10) plans of the library with the least or most of a measure, in order: by the measure, then by "
        "the measures named after it, then by rank. They are found from the library's automaton; no other plan is "
        "looked "
        "at. In lines, a comment before each plan has its values and its rank; in JSON, \"value\" or \"values\" has "
        "them exactly, in feet or metres. With -o and the name of a picture (.svg, .png or .pdf) the plans are drawn, "
        "each "
        "with its place and its values.\n\n"
        "With --library HOUSES, or --plan, the best houses are written, as house lines or JSON lines, or drawn, each "
        "with its name #P:V and its values; --least and --most name measures of houses or of plans "
        "(docs/houses.md).",
    .example = "$ tartan best lahave-houses 12 --least cost --then-most daylight",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and perhaps a number N",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
