/* tartan pareto: lists the best trade-offs of two or three measures. */
#include <stdlib.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"
#include "driver/open/digits.h"

typedef struct pareto_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_search_settings search;
    tn_option_list wanted; /* wishes */
    bool json;
    const char *output;
    const char *plan;
} pareto_settings;

static const pareto_settings *settings_of(const tn_job *job)
{
    return (const pareto_settings *)job->settings;
}

static void write_text(const tn_found_front *front, bool houses, FILE *out)
{
    for (size_t k = 0; k < front->measures.count; k++)
        fprintf(out, "%18s", front->measures.items[k]);
    fprintf(out, "  %20s  %s\n", houses ? "houses" : "plans", "the first of them");
    for (size_t i = 0; i < front->points.count; i++) {
        const tn_front_point *point = &front->points.items[i];
        bool known = houses || point->has_plans; /* not of plans that are searched */
        char *count = known ? tn_digits(houses ? point->houses : point->plans, true) : NULL;
        for (size_t k = 0; k < point->shown.count; k++)
            fprintf(out, "%18s", point->shown.items[k]);
        fprintf(out, "  %20s  %s\n", count ? count : known ? "?" : "-", houses ? point->house : point->plan);
        free(count);
    }
}

static void write(tn_job *job, const tn_reply *answer, bool houses)
{
    tn_output output;
    if (!tn_job_output(job, settings_of(job)->output, &output))
        return;
    if (settings_of(job)->json)
        tn_job_write_json(answer, output.stream);
    else
        write_text(answer->value, houses, output.stream);
    tn_job_commit(job, &output);
}

static void find_front(tn_job *job, const tn_pareto_request *request, bool houses)
{
    tn_reply answer;
    bool found = tn_job_answered(job, tn_ask_pareto(&job->session, request, &answer));
    tn_job_show(job);
    if (found)
        write(job, &answer, houses);
    tn_reply_clear(&answer);
}

static void pareto(tn_job *job)
{
    const pareto_settings *settings = settings_of(job);
    const char *output = settings->output;
    const tn_library_asked subject = tn_job_asked(&settings->plans);
    tn_wished wished;
    if ((settings->json && !tn_job_takes_text(job, output)) || !tn_job_wishes(job, &settings->wanted, 2, &wished))
        return;
    const tn_pareto_request request = {.subject = subject,
                                       .by = {wished.items, wished.count},
                                       .search = tn_search_settings_asked(&settings->search),
                                       .plan = settings->plan};
    const tn_draw_request drawn = {.format = tn_picture_choice(output),
                                   .subject = subject,
                                   .front = true,
                                   .by = {wished.items, wished.count},
                                   .plan = settings->plan};
    if (tn_job_draws(output))
        tn_job_draw(job, &drawn, output);
    else
        find_front(job, &request, settings->plan || tn_job_of_houses(job, &settings->plans));
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const pareto_settings *settings = (const pareto_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        pareto(&job);
    return tn_job_end(&job);
}

#define SETTINGS pareto_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    WISH("least", wanted, "prefer plans with less of MEASURE"),
    WISH("most", wanted, "prefer plans with more of MEASURE"),
    FLAG("json", 0, json, "write JSON, every value exactly and every count as a string of digits"),
    TEXT("plan", 0, "PLAN", plan, "the front of the houses on one plan: a plan in any spelling, or # and its rank"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTION_MAX_HOUSES(WALKED_HOUSES_HELP),
    OPTIONS_LIBRARY_LIMITS,
    OPTIONS_SEARCH,
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
        "With --library HOUSES, or --plan, it is the front of the houses, by measures of houses (of walks with --plan) "
        "or of plans "
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
