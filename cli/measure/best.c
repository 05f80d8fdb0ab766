/* tartan best: the best plans of a library by measures, in order. */
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/found_rows.h"
#include "cli/plan/library_job.h"
#include "runtime/plan/picture/draw.h"

enum { BEST_MAX = 1000000 };

typedef struct best_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    tn_option_list wanted; /* wishes */
    bool mirror, diverse;
    const char *plan;
    tn_search_settings search;
} best_settings;

static const best_settings *settings_of(const tn_job *job)
{
    return (const best_settings *)job->settings;
}

/* ---- as text or JSON, with values: the other formats are those of `sample` */

typedef struct listing {
    tn_job *job;
    tn_output output;
    bool json, open;
    tn_found_of of;
    tn_buffer text, exact;
} listing;

static bool begins(void *context, tn_found_of *of)
{
    listing *l = context;
    l->of = *of;
    tn_job_show(l->job);
    l->open = tn_job_output(l->job, settings_of(l->job)->written.output, &l->output);
    return l->open;
}

/* "value":"3/2" or "values":["3/2","4"] */
static bool write_values(listing *l, mpq_t *values, tn_json *json)
{
    const tn_wishes *wishes = l->of.wishes;
    bool list = wishes->count > 1, ok = true;
    if (list)
        tn_json_list(json, "values");
    for (uint32_t k = 0; ok && k < wishes->count; k++) {
        l->exact.size = 0;
        ok = tn_amount_write_exact(wishes->units[k], values[k], &l->exact);
        tn_json_bytes(json, list ? NULL : "value", l->exact.data, l->exact.size);
    }
    if (list)
        tn_json_list_end(json);
    return ok;
}

static tn_status write_json(listing *l, const tn_found_one *found, tn_error *error)
{
    tn_json json = tn_json_text(&l->text, TN_JSON_TIGHT);
    char *line = NULL;
    tn_status status = found->house ? tn_found_house_texts(found->house, &line, NULL, error) : TN_OK;
    tn_json_object(&json, NULL);
    bool ok = write_values(l, found->values, &json);
    if (found->house) {
        tn_json_string(&json, "house", line);
    } else {
        if (found->rank)
            tn_json_digits(&json, "rank", found->rank);
        tn_plan_write_trays(l->of.plans->schema, found->trays, found->length, &json);
    }
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    free(line);
    return status == TN_OK && !(ok && !l->text.failed) ? tn_fail_memory(error) : status;
}

/* A comment in lines: "# 3 m  4", of plans with the rank; and the line. */
static tn_status write_text(listing *l, const tn_found_one *found, tn_error *error)
{
    const tn_wishes *wishes = l->of.wishes;
    char *line = NULL;
    tn_status status = found->house
                           ? tn_found_house_texts(found->house, &line, NULL, error)
                           : tn_found_plan_texts(l->of.plans->schema, found->trays, found->length, &line, NULL, error);
    bool ok = tn_buffer_printf(&l->text, "# ");
    for (uint32_t k = 0; ok && k < wishes->count; k++)
        ok = tn_buffer_printf(&l->text, k ? "  " : "") && tn_amount_write(wishes->units[k], found->values[k], &l->text);
    char *rank = found->rank ? mpz_get_str(NULL, 10, found->rank) : NULL;
    if (ok && rank)
        ok = tn_buffer_printf(&l->text, "  rank %s", rank);
    if (ok && status == TN_OK)
        ok = tn_buffer_printf(&l->text, "\n%s\n", line);
    free(rank);
    free(line);
    return status == TN_OK && !ok ? tn_fail_memory(error) : status;
}

static bool takes(void *context, const tn_found_one *found)
{
    listing *l = context;
    tn_error error;
    l->text.size = 0;
    tn_status status = (l->json ? write_json : write_text)(l, found, &error);
    if (status == TN_OK)
        fwrite(l->text.data, 1, l->text.size, l->output.stream); /* a failure is said when the output is closed */
    else
        tn_job_fail(l->job, &error);
    return status == TN_OK;
}

static void list(tn_job *job, const tn_best_request *request)
{
    listing l = {.job = job, .json = settings_of(job)->written.format == TN_FORMAT_JSON};
    const tn_taker taker = {.begins = begins, .takes = takes, .context = &l};
    tn_reply answer;
    job->session.taker = &taker;
    bool found = tn_job_answered(job, tn_ask_best(&job->session, request, &answer));
    job->session.taker = NULL;
    if (l.open)
        tn_job_close(job, &l.output, found && job->exit_code == TN_EXIT_DONE);
    tn_reply_clear(&answer);
    free(l.text.data);
    free(l.exact.data);
}

/* ---- in the other formats */

static void write_rows(tn_job *job, const tn_best_request *request)
{
    tn_found_rows rows;
    tn_reply answer;
    tn_found_rows_begin(&rows, job, &settings_of(job)->written, "best");
    tn_found_rows_end(&rows, tn_ask_best(&job->session, request, &answer));
    tn_reply_clear(&answer);
}

/* Houses, with their rooms and faces. */
static void write_tables(tn_job *job, const tn_best_request *request)
{
    tn_written_settings written = settings_of(job)->written;
    tn_found_rows rows;
    tn_reply answer;
    written.columns = true;
    tn_found_rows_begin(&rows, job, &written, "best");
    tn_found_rows_end(&rows, tn_ask_best(&job->session, request, &answer));
    tn_reply_clear(&answer);
}

/* ---- drawn */

static void draw(tn_job *job, const tn_best_request *best)
{
    const char *output = settings_of(job)->written.output;
    const tn_draw_request request = {.format = tn_picture_choice(output),
                                     .subject = best->subject,
                                     .has_best = true,
                                     .best = best->count,
                                     .by = {best->by.items, best->by.count},
                                     .plan = best->plan,
                                     .diverse = best->diverse,
                                     .mirror = best->mirror};
    tn_job_draw(job, &request, output);
}

static void draw_plans(tn_job *job, const tn_best_request *best)
{
    if (best->count > TN_DRAW_PLANS_DEFAULT)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "a picture shows at most %u plans", TN_DRAW_PLANS_DEFAULT),
                "ask for fewer, or write them to a file that is not a picture");
    else
        draw(job, best);
}

/* ---- asked */

static bool is_drawn(const char *path)
{
    return path && (TN_WRITES_PICTURES | TN_WRITES(DXF)) >> tn_file_format_of(path) & 1;
}

static void find_plans(tn_job *job, const tn_best_request *request)
{
    const tn_written_settings *written = &settings_of(job)->written;
    tn_plan_format format = (tn_plan_format)written->format;
    if (format == TN_FORMAT_AUTO && is_drawn(written->output))
        draw_plans(job, request);
    else if (format == TN_FORMAT_JSON || format == TN_FORMAT_LINES || (format == TN_FORMAT_AUTO && !written->output))
        list(job, request);
    else
        write_rows(job, request);
}

/* Houses are written as lines or JSON, as tables, or drawn; what else plans may be told is wrong usage. */
static void find_houses(tn_job *job, const tn_best_request *request)
{
    const best_settings *settings = settings_of(job);
    const char *output = settings->written.output;
    tn_plan_format format = (tn_plan_format)settings->written.format;
    bool lines = format == TN_FORMAT_AUTO || format == TN_FORMAT_JSON || format == TN_FORMAT_LINES;
    if (!tn_job_writes(job, "a list of the best houses", output,
                       TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES(CSV) | TN_WRITES(SQLITE) | TN_WRITES(PARQUET) |
                           TN_WRITES_PICTURES))
        return;
    if (format == TN_FORMAT_CSV || format == TN_FORMAT_SQLITE || format == TN_FORMAT_PARQUET) {
        write_tables(job, request);
    } else if (!lines) {
        tn_diagnostic *d = tn_job_usage(
            job, "the best houses are written as lines, JSON or tables, or drawn: leave out this --format");
        tn_help(tn_job_diagnostics(job), d, "-o NAME.svg, NAME.png or NAME.pdf draws them");
    } else if (tn_job_draws(output) && !settings->mirror) {
        draw(job, request);
    } else {
        list(job, request);
    }
}

static void find_best(tn_job *job, uint64_t wanted)
{
    const best_settings *settings = settings_of(job);
    tn_wished wished;
    bool houses = settings->plan || tn_job_of_houses(job, &settings->plans);
    bool told = settings->wanted.count > 0 || houses; /* else plans are asked for that are preferred */
    if (!tn_job_wishes(job, &settings->wanted, told ? 1 : 0, &wished))
        return;
    const tn_best_request request = {.subject = tn_job_asked(&settings->plans),
                                     .by = {wished.items, wished.count},
                                     .has_count = true,
                                     .count = wanted,
                                     .plan = settings->plan,
                                     .diverse = settings->diverse,
                                     .mirror = settings->mirror,
                                     .search = tn_search_settings_asked(&settings->search)};
    (houses ? find_houses : find_plans)(job, &request);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const best_settings *settings = (const best_settings *)common;
    tn_job job;
    uint64_t wanted = TN_BEST_DEFAULT;
    tn_job_begin(&job, common);
    if (common->operands.count > 1 && (!tn_number_read(common->operands.items[1], &wanted) || wanted > BEST_MAX)) {
        tn_diagnostic *d = tn_job_usage(&job, "the number of plans is a number from 0 to %d, not `%.60s`", BEST_MAX,
                                        common->operands.items[1]);
        tn_help(tn_job_diagnostics(&job), d, "the file comes first: tartan best FILE N --least MEASURE");
    } else if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans)) {
        find_best(&job, wanted);
    }
    return tn_job_end(&job);
}

#define SETTINGS best_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "the plans with the least MEASURE first"),
    WISH("most", wanted, "the plans with the most MEASURE first"),
    WISH("then-least", wanted, "of equal ones those with the least of this measure; may be repeated"),
    WISH("then-most", wanted, "of equal ones those with the most of this measure; may be repeated"),
    FLAG("diverse", 0, diverse,
         "plans that differ from one another, among the best; houses that differ as people see it"),
    FLAG("mirror", 0, mirror, "leave out a plan whose mirror image is kept and of lower rank"),
    TEXT("plan", 0, "PLAN", plan, "the best houses on one plan: a plan in any spelling, or # and its rank"),
    OPTION_PLAN_FORMAT,
    OUTPUT(
        written.output, TN_WRITES_ROWS | TN_WRITES_PICTURES | TN_WRITES_DXF_OF_PLANS,
        "write to FILE instead of standard output, as its ending says: .json, .csv, .bin, .sqlite and .db, .parquet, "
        "or .svg, .png and .pdf, a picture, of plans also .dxf; otherwise as lines"),
    OPTION_MAX_HOUSES(WALKED_HOUSES_HELP),
    OPTIONS_LIBRARY_LIMITS,
    OPTIONS_SEARCH,
};

const tn_command tn_command_best = {
    .name = "best",
    .summary = "write the best plans of a library by a measure",
    .usage =
        "FILE [N] --least MEASURE\nFILE [N] --most MEASURE [--then-least MEASURE] [--diverse]\nFILE [N] --least "
        "MEASURE -o "
        "SHEET.svg\nFILE [N] [--library PREFERS]\nFILE [N] --library HOUSES [--plan PLAN] [--diverse] --least MEASURE",
    .description =
        "Writes the N (10) plans of the library with the least or most of a measure, in order: by the measure, then by "
        "the measures named after it, then by rank. Without a measure, plans of a library that prefers (`prefer` in "
        "its "
        "clauses) are the best by `preference`, the most first. They are found from the library's automaton; no other "
        "plan is "
        "looked "
        "at. If that passes a limit, the best by one measure are found by search, and a note says if it is not proven "
        "that there is no better one. In lines, a comment before each plan has its values and its rank; in JSON, "
        "\"value\" or \"values\" has "
        "them exactly, in feet or metres. With -o and the name of a picture (.svg, .png, .pdf or .dxf) the plans are "
        "drawn, "
        "each "
        "with its place and its values. With --diverse they are plans that differ, as `tartan sample --diverse` "
        "chooses them: the best, and then each time the one of the best 1,000 (or of 20 times N) that differs most "
        "from those before; they are written in their order.\n\n"
        "With --library HOUSES, or --plan, the best houses are written, as house lines or JSON lines, as tables (.csv "
        "or .sqlite, as `tartan sample --columns` writes them), or drawn, each "
        "with its name #P:V and its values; --least and --most name measures of houses or of plans "
        "(docs/houses.md); by measures of walks it is asked with --plan. With --diverse they are the best houses on N "
        "different plans, in order; where there are not "
        "so many plans with houses, then those whose storeys, roofs or other options differ from those "
        "of "
        "each before on their plan, then their functions, then what is in their faces, then their tiles.",
    .example = "$ tartan best lahave-houses 12 --least cost --then-most daylight",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and perhaps a number N",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
