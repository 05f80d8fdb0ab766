/* tartan rank: a plan's place in its library. */
#include <stdio.h>

#include "ask/house/numbered.h"
#include "ask/session/questions.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"

typedef struct rank_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool of_all, ways, rows, json;
} rank_settings;

static void write_text(const tn_reply *answer, FILE *out)
{
    const tn_ranked_plan *plan = TN_REPLY(ranked_plan, answer);
    const tn_ranked_house *house = TN_REPLY(ranked_house, answer);
    fputs(plan ? "" : "#", out);
    mpz_out_str(out, 10, plan ? plan->rank : house->has_rank ? house->rank : house->plan);
    if (!plan && !house->has_rank) {
        fputc(':', out);
        mpz_out_str(out, 10, house->variant);
    }
    if (plan && plan->has_ways) {
        fputc('\t', out);
        mpz_out_str(out, 10, plan->ways);
    }
    fputc('\n', out);
}

static void rank(tn_job *job, const rank_settings *settings, const char *text)
{
    bool house = !settings->rows && tn_is_house_line(text);
    const tn_rank_request request = {.subject = tn_job_asked(&settings->plans),
                                     .plan = house ? NULL : text,
                                     .house = house ? text : NULL,
                                     .of_all = settings->of_all,
                                     .ways = settings->ways,
                                     .plans = settings->rows};
    tn_reply answer;
    tn_output output;
    if (tn_job_answered(job, tn_ask_rank(&job->session, &request, &answer)) && tn_job_output(job, NULL, &output)) {
        if (settings->json)
            tn_job_write_json(&answer, output.stream);
        else
            write_text(&answer, output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const rank_settings *settings = (const rank_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        rank(&job, settings, common->operands.items[1]);
    return tn_job_end(&job);
}

#define SETTINGS rank_settings
static const tn_option options[] = {
    OPTION_LIBRARY,
    OPTION_WHERE,
    OPTION_SET,
    OPTION_TRAYS,
    FLAG("of-all", 0, of_all, "of a house: its rank among all houses, #R, in place of #P:V"),
    FLAG("ways", 0, ways, "of a plan: behind its rank, in how many ways it is derived by what the library generates"),
    FLAG("plans", 0, rows,
         "of a row of plans, of a library whose trays stand for plans: PLAN is a line of trays, each with its plan in "
         "brackets"),
    FLAG("json", 0, json, "write the number as JSON"),
    OPTION_MAX_LENGTH,
    OPTION_MAX_STATES,
    OPTION_THREADS(plans.threads),
};

const tn_command tn_command_rank = {
    .name = "rank",
    .summary = "print the number of a plan in its library",
    .usage = "FILE PLAN [--library NAME]\nFILE HOUSE [--library HOUSES] [--of-all]",
    .description = "Writes the rank of a plan: how many plans of the library come before it, in the order of length "
                   "and then tray by tray. "
                   "PLAN is a plan line, a plan in brackets as tests have it, an open plan that stands for one, or a "
                   "JSON object, in quotes. For a plan that the library does not hold, the "
                   "exit code is 1 and "
                   "the message says which clause it fails. "
                   "HOUSE is a house line, in which values may be left out (docs/houses.md), or a JSON object with "
                   "one; of it the command writes #P:V: the rank of its "
                   "plan, and how many houses on that plan come "
                   "before it. With --of-all it writes #R: how many houses of the library come before it.",
    .example = "$ tartan rank terrace \"$(tartan unrank terrace 1000)\"\n1000",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "a FILE and a PLAN",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
