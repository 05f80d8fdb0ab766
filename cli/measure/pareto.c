/* tartan pareto: lists the best trade-offs of two or three measures. */
#include <stdlib.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/measure/wishes.h"
#include "driver/measure/front.h"
#include "driver/open/digits.h"
#include "runtime/plan/text/text.h"

typedef struct pareto_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_option_list wanted; /* wishes */
    bool json;
    const char *output;
    const char *plan;
} pareto_settings;

static const pareto_settings *settings_of(const tn_job *job)
{
    return (const pareto_settings *)job->settings;
}

typedef struct paper {
    const tn_ready_library *ready;
    const tn_wishes *wishes;
    const tn_weighed *weighed;
    const tn_pareto_front *front;
} paper;

static const char *measure_name(const paper *p, uint32_t k)
{
    const tn_module *module = p->ready->schema->module;
    return tn_text(module, module->MEASURE_records[p->wishes->measures[k]].name);
}

static bool point_json(const paper *p, const tn_pareto_point *point, tn_json *json)
{
    tn_buffer text = {0}, line = {0};
    bool ok = true;
    tn_json_object(json, NULL);
    tn_json_list(json, "values");
    for (uint32_t k = 0; ok && k < p->wishes->count; k++) {
        text.size = 0;
        ok = tn_wishes_exact(p->wishes, p->weighed, k, point->values[k], &text);
        tn_json_bytes(json, NULL, text.data, text.size);
    }
    tn_json_list_end(json);
    mpz_t rank;
    mpz_init(rank);
    ok = ok && tn_library_rank(p->ready->library, point->trays, point->length, rank) &&
         tn_plan_write_line(p->ready->schema, point->trays, point->length, &line);
    tn_json_digits(json, "plans", point->plans);
    tn_json_digits(json, "rank", rank);
    tn_json_string(json, "plan", line.data ? line.data : "");
    tn_json_object_end(json);
    mpz_clear(rank);
    free(text.data);
    free(line.data);
    return ok;
}

static bool write_json(const paper *p, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_LINES);
    bool ok = true;
    tn_json_object(&json, NULL);
    tn_json_list(&json, "measures");
    for (uint32_t k = 0; k < p->wishes->count; k++)
        tn_json_string(&json, NULL, measure_name(p, k));
    tn_json_list_end(&json);
    tn_json_list(&json, "points");
    for (size_t i = 0; ok && i < p->front->count; i++)
        ok = point_json(p, &p->front->points[i], &json);
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return ok;
}

static bool write_text(const paper *p, FILE *out)
{
    bool ok = true;
    for (uint32_t k = 0; k < p->wishes->count; k++)
        fprintf(out, "%18s", measure_name(p, k));
    fprintf(out, "  %20s  %s\n", "plans", "the first of them");
    for (size_t i = 0; ok && i < p->front->count; i++) {
        const tn_pareto_point *point = &p->front->points[i];
        tn_buffer line = {0};
        for (uint32_t k = 0; ok && k < p->wishes->count; k++) {
            tn_buffer text = {0};
            ok = tn_wishes_text(p->wishes, p->weighed, k, point->values[k], &text);
            fprintf(out, "%18s", text.data ? text.data : "");
            free(text.data);
        }
        char *plans = tn_digits(point->plans, true);
        ok = ok && tn_plan_write_line(p->ready->schema, point->trays, point->length, &line);
        fprintf(out, "  %20s  %s\n", plans ? plans : "", line.data ? line.data : "");
        free(plans);
        free(line.data);
    }
    return ok;
}

static void draw_front(tn_job *job, const paper *p, tn_weighed *weighed)
{
    const tn_wishes *wishes = p->wishes;
    const tn_shown_front shown = {p->ready, wishes->count, wishes->measures, wishes->most, weighed, p->front};
    tn_error error;
    if (tn_front_picture(&shown, &(tn_picture){.path = settings_of(job)->output}, &error) != TN_OK)
        tn_job_fail(job, &error);
}

static void write_front(tn_job *job, const paper *p)
{
    tn_error error;
    tn_output output;
    if (!tn_job_output(job, settings_of(job)->output, &output))
        return;
    if (!(settings_of(job)->json ? write_json : write_text)(p, output.stream)) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    }
    tn_job_commit(job, &output);
}

static void find_front(tn_job *job, const tn_ready_library *ready)
{
    tn_wishes wishes;
    tn_weighed *weighed = NULL;
    tn_pareto_front front = {0};
    tn_error error;
    if ((settings_of(job)->json && !tn_job_takes_text(job, settings_of(job)->output)) ||
        !tn_wishes_read(job, ready, &settings_of(job)->wanted, 2, &wishes))
        return;
    tn_progress progress;
    tn_progress_watch(&progress, "looking for the front", tn_interrupt_waiting());
    tn_status status = tn_weighed_new(ready->library, wishes.measures, wishes.count, &weighed, &error);
    if (status == TN_OK)
        status = tn_pareto_make(&front, weighed, wishes.most, &error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    paper p = {ready, &wishes, weighed, &front};
    tn_job_show(job);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    else if (tn_job_draws(settings_of(job)->output))
        draw_front(job, &p, weighed);
    else
        write_front(job, &p);
    tn_pareto_clear(&front);
    tn_weighed_free(weighed);
}

static void find_houses(tn_job *job)
{
    const pareto_settings *settings = settings_of(job);
    tn_wishes wishes;
    if (!tn_wishes_names(job, &settings->wanted, 2, &wishes))
        return;
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    tn_house_wishes of = tn_wishes_of_houses(&wishes);
    of.plan = settings->plan;
    of.wanted = UINT64_MAX; /* all of it */
    of.json = settings->json;
    of.output = settings->output;
    if (tn_job_draws(of.output))
        tn_job_draw_houses(
            job, &houses,
            &(tn_house_sheet){.best = &of, .front = true, .camera = tn_house_sheet_camera(), .output = of.output});
    else
        tn_job_front_of_houses(job, &houses, &of);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const pareto_settings *settings = (const pareto_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    tn_job_begin(&job, common);
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans)) {
        if (settings->plan || tn_job_of_houses(&job, &settings->plans))
            find_houses(&job);
        else if (tn_job_opened_library(&job, &settings->plans, &ready))
            find_front(&job, &ready);
    }
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS pareto_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "prefer plans with less of MEASURE"),
    WISH("most", wanted, "prefer plans with more of MEASURE"),
    FLAG("json", 0, json, "write JSON, every value exactly and every count as a string of digits"),
    TEXT("plan", 0, "PLAN", plan, "the front of the houses on one plan: a plan line, or # and its rank"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_pareto = {
    .name = "pareto",
    .summary = "find the best trade-offs of two or three measures",
    .usage = "FILE --least MEASURE --most MEASURE [--least MEASURE] [--json | -o FRONT.svg]",
    .description =
        "Lists the front of the library: the values that no plan betters in one measure without losing in another, "
        "best "
        "first by the measures in the order named, with how many plans have them and the first of these by rank. It is "
        "found from the library's automaton, exactly; no plan is listed.\n\n"
        "With -o and the name of a picture (.svg, .png or .pdf) the front is drawn over the distribution of the "
        "measures: "
        "exact along the edges, of a sample inside. Of three measures, each two have a panel.\n\n"
        "With --library HOUSES, or --plan, it is the front of the houses, by measures of houses or of plans "
        "(docs/houses.md). A picture then shows the first house of each value, with its name #P:V.",
    .example = "$ tartan pareto lahave-houses --least cost --most area",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
