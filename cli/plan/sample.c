/* tartan sample: plans drawn evenly from a library. */
#include <inttypes.h>
#include <stdio.h>

#include "ask/session/questions.h"
#include "cli/common/options.h"
#include "cli/plan/found_rows.h"
#include "cli/plan/new_set.h"

/* The most plans that are drawn at once: their ranks are all in memory. */
#define SAMPLE_MAX 50000000u

typedef struct sample_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    tn_option_number seed, length, per_length, shards;
    bool diverse; /* plans that differ, instead of even chances */
    bool uniform; /* even chances, instead of weights */
    bool ways;
    bool rows; /* of plans */
    const char *plan;
    tn_search_settings search;
} sample_settings;

static const sample_settings *settings_of(const tn_job *job)
{
    return (const sample_settings *)job->settings;
}

/* What decides the result, for the record in the file. */
static void describe(const sample_settings *settings, size_t wanted, char *text, size_t size)
{
    int used = settings->per_length.given
                   ? snprintf(text, size, "sample --per-length %" PRIu64, settings->per_length.value)
                   : snprintf(text, size, "sample %zu", wanted);
    used += snprintf(text + used, size - (size_t)used, "%s%s --seed %" PRIu64, settings->diverse ? " --diverse" : "",
                     settings->uniform ? " --uniform" : "", settings->seed.value);
    if (settings->length.given)
        snprintf(text + used, size - (size_t)used, " --length %" PRIu64, settings->length.value);
}

static void sample(tn_job *job, size_t wanted)
{
    const sample_settings *s = settings_of(job);
    const tn_sample_request request = {.subject = tn_job_asked(&s->plans),
                                       .has_count = !s->per_length.given,
                                       .count = wanted,
                                       .seed = s->seed.value,
                                       .has_length = s->length.given,
                                       .length = s->length.value,
                                       .has_per_length = s->per_length.given,
                                       .per_length = s->per_length.value,
                                       .diverse = s->diverse,
                                       .uniform = s->uniform,
                                       .ways = s->ways,
                                       .plans = s->rows,
                                       .plan = s->plan,
                                       .search = tn_search_settings_asked(&s->search)};
    tn_found_rows rows;
    tn_reply answer;
    char made[128];
    describe(s, wanted, made, sizeof made);
    tn_found_rows_begin(&rows, job, &s->written, made);
    rows.sample = true;
    tn_found_rows_end(&rows, tn_ask_sample(&job->session, &request, &answer));
    tn_reply_clear(&answer);
}

/* The operand N; it and --per-length say the same thing in two ways. */
static bool read_wanted(tn_job *job, size_t *wanted)
{
    const sample_settings *settings = settings_of(job);
    uint64_t number = 0, most = settings->shards.given ? TN_SHARDS_SAMPLE_MAX : SAMPLE_MAX;
    if ((settings->common.operands.count > 1) == settings->per_length.given) {
        tn_job_usage(job, "say how many plans: either N after the file, or --per-length N");
        return false;
    }
    if (settings->per_length.given && settings->length.given) {
        tn_job_usage(job, "--length and --per-length exclude each other");
        return false;
    }
    if (settings->common.operands.count > 1 &&
        (!tn_number_read(settings->common.operands.items[1], &number) || number > most)) {
        tn_diagnostic *d = tn_job_usage(job, "the number of plans is a number from 0 to %" PRIu64 ", not `%.60s`", most,
                                        settings->common.operands.items[1]);
        tn_help(tn_job_diagnostics(job), d, "the file comes first: tartan sample FILE N");
        return false;
    }
    *wanted = (size_t)number;
    return true;
}

/* Is the library that is named one of houses, or a plan given whose houses are wanted? */
static bool samples_houses(const tn_job *job, const sample_settings *settings)
{
    return settings->plan || tn_job_of_houses(job, &settings->plans);
}

/* ---- --shards: a set, whose workers draw the same plans */

static bool can_share(tn_job *job)
{
    const sample_settings *s = settings_of(job);
    tn_diagnostics *list = tn_job_diagnostics(job);
    if (s->length.given || s->per_length.given || s->diverse)
        tn_help(list, tn_job_usage(job, "a shard set has a sample of all plans"),
                "leave out --length, --per-length and --diverse; `tartan shards new --trays L` takes one length");
    else if (s->ways || s->rows)
        tn_help(list, tn_job_usage(job, "a shard set has plans alone"), "leave out --%s", s->ways ? "ways" : "plans");
    else if (s->written.columns || s->written.csv_safe)
        tn_help(list, tn_job_usage(job, "the shards of a set have the usual columns"),
                "leave out --columns and --csv-safe");
    else if (samples_houses(job, s))
        tn_help(list, tn_job_usage(job, "a shard set has plans, and houses are drawn here"),
                "leave out --shards, or name a library of plans");
    else
        return true;
    return false;
}

static void sample_shards(tn_job *job, size_t wanted)
{
    const sample_settings *s = settings_of(job);
    tn_ready_library ready = {0};
    const tn_new_set what = {.path = s->common.operands.items[0],
                             .plans = &s->plans,
                             .written = &s->written,
                             .shards = s->shards.value,
                             .sampled = true,
                             .sample = wanted,
                             .seed = s->seed.value,
                             .uniform = s->uniform};
    if (can_share(job) && tn_new_set_fits(job, &what) && tn_job_opened_library(job, &s->plans, &ready))
        tn_job_new_set(job, &ready, &what);
    tn_library_close(&ready);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const sample_settings *settings = (const sample_settings *)common;
    tn_job job;
    size_t wanted;
    tn_job_begin(&job, common);
    bool open = read_wanted(&job, &wanted) && tn_job_open_plans(&job, common->operands.items[0], &settings->plans);
    if (open && settings->shards.given)
        sample_shards(&job, wanted);
    else if (open)
        sample(&job, wanted);
    return tn_job_end(&job);
}

#define SETTINGS sample_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    NUMBER("seed", 's', "S", seed, 0, 0, "which sample: the same seed gives the same plans (default 0)"),
    NUMBER("length", 0, "L", length, 0, UINT32_MAX - 1, "only plans of L trays"),
    NUMBER("per-length", 0, "N", per_length, 0, SAMPLE_MAX, "N plans of each number of trays, instead of N in all"),
    FLAG("diverse", 0, diverse, "plans or houses that differ from one another, instead of each as likely as each"),
    FLAG("uniform", 0, uniform, "each plan as likely as each, also if the library has weights"),
    NUMBER("shards", 0, "M", shards, 1, 0,
           "make a shard set of M shards, the folder that -o names: `tartan shards run` draws the same plans"),
    TEXT("plan", 0, "PLAN", plan, "draw houses on one plan: a plan in any spelling, or # and its rank"),
    OPTION_PLAN_WAYS,
    OPTION_ROWS_OF_PLANS(rows, "draw rows of plans, each as likely as each"),
    OPTION_PLAN_FORMAT,
    OPTION_COLUMNS,
    OPTION_CSV_SAFE,
    OPTION_PLAN_LINES,
    OPTION_ROW_GROUP,
    OPTION_PLAN_OUTPUT,
    OPTION_MAX_HOUSES(TRIED_HOUSES_HELP("5000")),
    OPTIONS_LIBRARY_LIMITS,
    OPTIONS_SEARCH,
};

const tn_command tn_command_sample = {
    .name = "sample",
    .summary = "choose random plans of a library",
    .usage = "FILE N [--seed S] [--length L] [--diverse] [--uniform]\nFILE --per-length N [--seed S]\nFILE N --library "
             "HOUSES "
             "[--plan PLAN] [--seed S]\nFILE N --shards M -o SET [--seed S]",
    .description =
        "Draws N different plans of the library at random, each with the same probability, and writes them in the "
        "order of their ranks. If the library has weights (`weight` in its clauses), each plan is drawn in proportion "
        "to the product of its weights, among those not drawn yet; --uniform leaves the weights out. Nearly all plans "
        "of a library have the greatest number of trays, so nearly all "
        "samples do too; --length and --per-length draw plans of other lengths. --diverse draws one plan; each next "
        "plan is the one of 1,000 fresh draws that is farthest from those before. A changed field counts 1, a tray "
        "more or less counts as many as it has fields. With --library HOUSES, or --plan, houses are drawn; --diverse "
        "then "
        "chooses among 20 N houses (200 at least), each next one as far as can be from those before: by their plans, "
        "then storeys, roofs and other choices, then which functions there are, then where these are, then faces, then "
        "tiles. The same "
        "file, seed and options give the same plans on every machine. If the library's automaton passes a limit, plans "
        "are found by search, guessing at random: not each with the same probability, and without ranks. With --shards "
        "M and -o SET a shard set is made, "
        "whose workers draw the same plans on any number of machines; see `tartan help shards`.",
    .example = "$ tartan sample lahave-houses 1000 --seed 7 -o sample.sqlite",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "draw fewer plans",
    .operands = "a FILE and a number N",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
