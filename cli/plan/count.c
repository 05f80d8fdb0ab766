/* tartan count: how many plans, houses or buildings there are, exactly, without making one. */
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/made_outputs.h"
#include "cli/common/option_rows.h"
#include "cli/place/kit_options.h"
#include "cli/plan/answers.h"
#include "cli/plan/count_text.h"

typedef struct count_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool json, mirror, no_effects;
    const char *plan; /* whose houses are counted */
    bool clauses;     /* and what each of theirs keeps out */
    const char *by;   /* the measure that is counted by */
    const char *step;
    tn_option_number bins;
    bool watch;
    const char *output;
    tn_kit_options kit;
} count_settings;

static tn_count_request request_of(const count_settings *s)
{
    return (tn_count_request){.subject = tn_job_asked(&s->plans),
                              .by = s->by,
                              .step = s->step,
                              .has_bins = s->bins.given,
                              .bins = s->bins.value,
                              .values = s->json,
                              .drawn = {.picture = s->by && !s->json ? tn_answer_picture_choice(s->output) : 0},
                              .plan = s->plan,
                              .clauses = s->clauses,
                              .no_effects = s->no_effects,
                              .mirror = s->mirror,
                              .kit = tn_kit_options_asked(&s->kit)};
}

/* ---- what is written, and when: the plans first, and then what each clause does, which may take far longer */

typedef struct showing {
    tn_job *job;
    bool json;
    const char *path;
    bool open; /* what stands so far is written to: */
    tn_output output;
} showing;

static void show_so_far(void *context, const tn_reply *answer)
{
    showing *s = context;
    const tn_counted_plans *plans = TN_REPLY(counted_plans, answer);
    if (s->json || !plans)
        return;
    tn_job_show(s->job);
    s->open = tn_job_output(s->job, s->path, &s->output);
    if (!s->open)
        return;
    tn_count_plans_text(plans, s->output.stream);
    fflush(s->output.stream);
}

static void write_answer(const showing *s, const tn_reply *answer, FILE *out)
{
    if (s->json)
        tn_job_write_json(answer, out);
    else if (TN_REPLY(counted_values, answer))
        tn_count_spread_text(TN_REPLY(counted_values, answer), out);
    else if (TN_REPLY(counted_houses, answer))
        tn_count_houses_text(TN_REPLY(counted_houses, answer), s->job->opened.module, out);
    else if (TN_REPLY(counted_buildings, answer))
        tn_count_buildings_text(TN_REPLY(counted_buildings, answer), out);
}

/* Nothing is left to write of plans but their clauses. */
static void show_rest(showing *s, const tn_reply *answer, bool answered)
{
    tn_error error;
    bool complete = answered;
    if (answered)
        tn_count_clauses_text(TN_REPLY(counted_plans, answer), s->output.stream);
    if (answered && tn_interrupt_check(&error) != TN_OK) { /* long plans have long numbers, and take long to write */
        tn_job_fail(s->job, &error);
        complete = false;
    }
    tn_job_close(s->job, &s->output, complete);
}

static void show(showing *s, const tn_reply *answer)
{
    tn_job_show(s->job);
    bool drawn = TN_REPLY(counted_values, answer) && tn_job_draws(s->path);
    if (!drawn && tn_job_output(s->job, s->path, &s->output)) {
        write_answer(s, answer, s->output.stream);
        tn_job_commit(s->job, &s->output);
    }
}

void tn_job_count(tn_job *job, const tn_count_request *request, bool json, const char *path)
{
    tn_reply answer;
    showing s = {.job = job, .json = json, .path = path};
    tn_made_outputs outputs;
    tn_job_files(job, &outputs, &path, 1, false);
    job->session.so_far = show_so_far;
    job->session.so_far_context = &s;
    bool answered = tn_job_answered(job, tn_ask_count(&job->session, request, &answer));
    job->session.so_far = NULL;
    tn_job_files_end(&outputs);
    if (s.open)
        show_rest(&s, &answer, answered);
    else if (answered && (json || !TN_REPLY(counted_plans, &answer)))
        show(&s, &answer);
    tn_reply_clear(&answer);
}

/* Only a distribution is drawn. */
static bool may_draw(tn_job *job, const count_settings *settings)
{
    if (!tn_job_draws(settings->output) || (settings->by && !settings->json))
        return true;
    if (settings->by || job->opened.module->KIT_count > 0)
        return tn_job_takes_text(job, settings->output);
    tn_diagnostic *d = tn_job_usage(job, "counts are text, and %.200s is a picture's name", settings->output);
    tn_help(tn_job_diagnostics(job), d, "give --by MEASURE to draw a histogram, or end the file's name otherwise");
    return false;
}

static int count_once(const tn_settings *common, tn_files_read *read)
{
    const count_settings *settings = (const count_settings *)common;
    const tn_count_request request = request_of(settings);
    tn_job job;
    tn_job_begin(&job, common);
    job.read = read;
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans) && may_draw(&job, settings))
        tn_job_count(&job, &request, settings->json, settings->output);
    return tn_job_end(&job);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    if (!((const count_settings *)common)->watch)
        return count_once(common, NULL);
    return tn_watch_files(common, count_once);
}

#define SETTINGS count_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    FLAG("json", 0, json, "write JSON, every count as a string of digits"),
    TEXT("by", 0, "MEASURE", by, "how the plans are spread over the values of MEASURE, exactly"),
    TEXT("step", 0, "S", step, "with --by: show bins of S, in the measure's unit"),
    NUMBER("bins", 0, "N", bins, 1, TN_BINS_MAX, "with --by: show at most N bins"),
    FLAG("no-effects", 0, no_effects, "leave out what each clause does, which may take far longer than the counts"),
    TEXT("plan", 0, "PLAN", plan, "count the houses on one plan: a plan in any spelling, or # and its rank"),
    FLAG("clauses", 0, clauses, "of houses: also count how many of all houses each clause keeps out"),
    FLAG("mirror", 0, mirror, "also count one of each pair of plans that mirror each other"),
    OPTIONS_KIT("count"),
    FLAG("watch", 0, watch, "count again whenever the file, or one that it uses, changes; Ctrl-C ends"),
    OPTION_OUTPUT_OR_PICTURE,
    OPTION_LDRAW,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_count = {
    .name = "count",
    .summary = "count the plans of a library, exactly",
    .usage = "FILE [--library NAME] [--json] [--mirror] [--no-effects]\nFILE --by MEASURE [--step S | --bins N] "
             "[--json | -o HISTOGRAM.svg]\n"
             "FILE --library HOUSES [--plan PLAN] [--clauses | --by MEASURE] [--json]\n"
             "FILE.kit --parts N [--part NAME]... [--fixed | --inside MODEL] [--json]",
    .description =
        "Counts the plans that the library generates, prunes and keeps, for each number of trays and in all. For "
        "each pruning rule it counts the generated plans that the rule prunes; for each requirement, the plans of "
        "these lengths that it keeps out. For both it counts how many more plans there would be without that "
        "clause. The counts are written first. What each clause does may take far longer for hundreds of clauses, so "
        "each clause has an equal share of the work, and one that needs more is not counted, with a note. "
        "--no-effects leaves this out.\n\n"
        "With --by, the plans are counted by the values of a measure, with the least, the most, the mean and the "
        "quartiles. With -o and the name of a picture (.svg, .png or .pdf) that is drawn as a histogram.\n\n"
        "Counts are exact, whatever their size. They are computed from the library's automaton, without "
        "listing plans.\n\n"
        "For a library of houses (docs/houses.md) it counts the plans, the houses, and what they are without their "
        "tiles; the plans that have a house, and with how many sections and functions; the houses by length, and by "
        "each "
        "value of each choice of the section. --plan counts those on one plan. "
        "--clauses counts how many of the houses that the form allows each clause keeps out, and how many only it "
        "keeps out; where the houses are counted together, also how many states that takes for each clause by itself. "
        "--by counts the houses by a measure of houses or of plans.\n\n"
        "For a kit (docs/kit-language.md) it counts buildings: sets of N parts that hang together by their connectors. "
        "Two that differ by where they stand, or by a turn about the vertical, are one; --fixed tells turns apart. "
        "--inside counts those in the space of a model of the kit, each where it stands.",
    .example = "$ tartan count lahave-houses --json",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
