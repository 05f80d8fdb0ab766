/* tartan unrank: the plan at a place in its library. */
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/session/questions.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"

typedef struct unrank_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool rows, json;
} unrank_settings;

static void unrank(tn_job *job, const unrank_settings *settings, const char *text)
{
    const tn_unrank_request request = {
        .subject = tn_job_asked(&settings->plans), .rank = text, .plans = settings->rows};
    tn_reply answer;
    tn_output output;
    if (tn_job_answered(job, tn_ask_unrank(&job->session, &request, &answer)) && tn_job_output(job, NULL, &output)) {
        const tn_unranked_plan *plan = TN_REPLY(unranked_plan, &answer);
        const tn_unranked_house *house = TN_REPLY(unranked_house, &answer);
        if (settings->json)
            tn_job_write_json(&answer, output.stream);
        else
            fprintf(output.stream, "%s\n", plan ? plan->line : house->line);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const unrank_settings *settings = (const unrank_settings *)common;
    const char *text = common->operands.items[1];
    tn_job job;
    tn_job_begin(&job, common);
    if (!tn_is_rank(text) && !tn_is_house_number(text)) /* before a file is opened that may be the number */
        tn_help(tn_job_diagnostics(&job), tn_job_usage(&job, "a rank is a whole number from 0, not `%.60s`", text),
                text[strspn(text, "0123456789.,' ")] ? "the file comes first: tartan unrank FILE RANK"
                                                     : "write it without marks between its digits, such as 1000");
    else if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        unrank(&job, settings, text);
    return tn_job_end(&job);
}

#define SETTINGS unrank_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    FLAG("plans", 0, rows,
         "the row of plans of that rank among these, of a library whose trays stand for plans: each tray with its plan "
         "in brackets"),
    FLAG("json", 0, json, "write the plan or house as a JSON object"),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_unrank = {
    .name = "unrank",
    .summary = "print the plan of a number",
    .usage = "FILE RANK [--library NAME]\nFILE '#P:V' [--library HOUSES]",
    .description =
        "Writes the plan of a rank (a whole number from 0, of any size) as a plan line: the inverse of rank. "
        "#P:V is variant V of the plan of rank P in a library of houses, and is written as a house line; "
        "with --library HOUSES a number alone is the rank among all houses.",
    .example = "$ tartan unrank lahave-houses 123456789",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "a FILE and a RANK",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
