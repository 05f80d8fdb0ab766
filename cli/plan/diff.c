/* tartan diff: what an edit does to a library. */
#include "ask/session/questions.h"
#include "cli/common/made_outputs.h"
#include "cli/common/option_rows.h"
#include "cli/plan/answers.h"
#include "cli/plan/diff_text.h"

typedef struct diff_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_option_number sample, seed, max_houses;
    bool json, without_measures;
    const char *output, *title;
} diff_settings;

static const diff_settings *settings_of(const tn_job *job)
{
    return (const diff_settings *)job->settings;
}

static void write(tn_job *job, const tn_reply *answer, bool json)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (json)
        tn_job_write_json(answer, output.stream);
    else
        tn_diff_text(answer->value, output.stream);
    tn_job_commit(job, &output);
}

static tn_status give_other(void *context, const char *path, tn_session **other)
{
    (void)path; /* it is open there */
    *other = context;
    return TN_OK;
}

bool tn_job_diff(tn_job *job, tn_session *before, const tn_diff_request *request, tn_reply *answer)
{
    job->session.other = give_other;
    job->session.other_context = before;
    bool answered = tn_job_answered(job, tn_ask_diff(&job->session, request, answer));
    tn_job_show(job);
    return answered;
}

void tn_job_diff_text(tn_job *job, tn_session *before, const tn_diff_request *request)
{
    tn_reply answer;
    if (tn_job_diff(job, before, request, &answer))
        write(job, &answer, false);
    tn_reply_clear(&answer);
}

static void compare(tn_job *job, tn_session *before)
{
    const diff_settings *settings = settings_of(job);
    const tn_diff_request request = {.subject = tn_job_asked(&settings->plans),
                                     .before = settings->common.operands.items[0],
                                     .has_sample = settings->sample.given,
                                     .sample = settings->sample.value,
                                     .seed = settings->seed.value,
                                     .no_measures = settings->without_measures,
                                     .has_max_houses = settings->max_houses.given,
                                     .max_houses = settings->max_houses.value,
                                     .drawn = {.picture = tn_answer_picture_choice(settings->output)},
                                     .title = settings->title};
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &settings->output, 1, false);
    if (tn_job_diff(job, before, &request, &answer))
        write(job, &answer, settings->json);
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

/* Is the library that is named one of houses, in either file? */
static bool is_about_houses(const tn_job jobs[2])
{
    const tn_plan_settings *plans = &settings_of(&jobs[0])->plans;
    return tn_job_of_houses(&jobs[0], plans) || tn_job_of_houses(&jobs[1], plans);
}

/* Two files are open at once, each with diagnostics of its own. */
static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const diff_settings *settings = (const diff_settings *)common;
    const char *const *paths = common->operands.items;
    tn_job jobs[2];
    tn_job_begin(&jobs[0], common);
    tn_job_begin(&jobs[1], common);
    bool open = tn_job_open_plans(&jobs[0], paths[0], &settings->plans) &&
                tn_job_open_plans(&jobs[1], paths[1], &settings->plans);
    if (open && settings->output && is_about_houses(jobs))
        tn_help(tn_job_diagnostics(&jobs[0]), tn_job_usage(&jobs[0], "houses that are compared are not drawn"),
                "leave out -o; `tartan house` draws a house by its line");
    else if (open)
        compare(&jobs[1], &jobs[0].session);
    int first = tn_job_end(&jobs[0]), second = tn_job_end(&jobs[1]);
    return first > second ? first : second;
}

#define SETTINGS diff_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    NUMBER("sample", 0, "N", sample, 0, TN_DIFF_SHOWN_MAX, "show the first plan of each and N at random (default 3)"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which random ones (default 0)"),
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    FLAG("no-measures", 0, without_measures, "leave out how measures change, which takes most of the time"),
    OUTPUT(output, TN_WRITES_PICTURES, "also draw the plans shown, removed, added and kept: .svg, .png or .pdf"),
    TEXT("title", 0, "TEXT", title, "the picture's title"),
    NUMBER("max-houses", 0, "N", max_houses, 1, 0, "the most houses that are compared one by one (default 1000000)"),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_diff = {
    .name = "diff",
    .summary = "compare a library before and after an edit",
    .usage = "OLD NEW [--library NAME] [--json] [-o SHEET.svg]\nOLD NEW --library HOUSES [--json] [--max-houses N]",
    .description =
        "Compares the plans of a library before and after an edit. It counts exactly how many plans the edit "
        "removes, adds and keeps, for each number of trays and in all. It shows the first plans of each kind and "
        "some at random, and the clauses that are responsible. Clauses are compared by their names. For each "
        "clause that is not the same, `removes` counts the removed plans that it keeps out now, and `adds` counts "
        "the added plans that it kept out before. Several clauses may keep out the same plan. Both libraries must "
        "have the same trays.\n\n"
        "Of each measure that both files have, it shows the least, the mean and the most before and after.\n\n"
        "With --library HOUSES it compares libraries of houses. A house is the same where its line is. Houses that "
        "only "
        "one library has are counted and shown by the clauses that keep them out of the other, or by `plans` or `form` "
        "where these differ. If the form is the same and one library has all clauses of the other, all houses are "
        "counted together. Otherwise the houses on plans of both are compared one by one, up to --max-houses.",
    .example = "$ tartan diff before.plan after.plan\n$ tartan diff before.plan after.plan --sample 12 -o edit.pdf",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "two files, OLD and NEW",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
