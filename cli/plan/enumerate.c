/* tartan enumerate: every plan of a library, once, in rank order. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ask/session/questions.h"
#include "cli/common/option_rows.h"
#include "cli/place/enumerate_kit.h"
#include "cli/place/kit_options.h"
#include "cli/plan/found_rows.h"
#include "driver/plan/made.h"

typedef struct enumerate_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    const char *from, *to, *plan;
    tn_option_number limit;
    bool mirror;
    tn_kit_options kit;
} enumerate_settings;

static const enumerate_settings *settings_of(const tn_job *job)
{
    return (const enumerate_settings *)job->settings;
}

/* Is the library that is named one of houses, or a plan given whose houses are wanted? */
static bool is_about_houses(const tn_job *job)
{
    const enumerate_settings *settings = settings_of(job);
    return settings->plan || tn_job_of_houses(job, &settings->plans);
}

/* What decides the result (malloc). The limit is left out: a library can be resumed to go on past it. Of plans the
 * requirements are in the library's hash. */
static char *describe(const tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    bool houses = is_about_houses(job);
    const tn_enumerated asked = {.from = s->from,
                                 .to = s->to,
                                 .mirror = s->mirror,
                                 .trays_given = s->plans.trays.given,
                                 .trays_min = s->plans.trays.low,
                                 .trays_max = s->plans.trays.high,
                                 .plan = s->plan,
                                 .wheres = s->plans.wheres.items,
                                 .where_count = houses ? s->plans.wheres.count : 0};
    return tn_enumerated_words(&asked);
}

static bool check_options(tn_job *job)
{
    const enumerate_settings *settings = settings_of(job);
    if (!settings->written.resume || (settings->written.output && strcmp(settings->written.output, "-") != 0))
        return true;
    tn_job_usage(job, "--resume needs the database to continue: -o FILE.sqlite");
    return false;
}

static tn_enumerate_request request_of(const enumerate_settings *s)
{
    return (tn_enumerate_request){.subject = tn_job_asked(&s->plans),
                                  .from = s->from,
                                  .to = s->to,
                                  .has_limit = s->limit.given,
                                  .limit = s->limit.value,
                                  .plan = s->plan,
                                  .mirror = s->mirror,
                                  .kit = tn_kit_options_asked(&s->kit)};
}

static void enumerate(tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    const tn_enumerate_request request = request_of(s);
    tn_found_rows rows;
    tn_reply answer = {0};
    tn_error error;
    char *made = describe(job);
    tn_found_rows_begin(&rows, job, &s->written, made);
    rows.enumerates = true;
    rows.all_ranks = !s->mirror;
    rows.most = s->limit;
    if (!made) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    }
    tn_found_rows_end(&rows, made ? tn_ask_enumerate(&job->session, &request, &answer) : TN_MEMORY);
    tn_reply_clear(&answer);
    free(made);
}

/* What is said of how plans are written. */
static bool writes_plans(tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    const char *option = s->written.columns    ? "columns"
                         : s->written.csv_safe ? "csv-safe"
                         : s->written.resume   ? "resume"
                                               : NULL;
    if (option)
        tn_job_usage(job, "--%s is about a library of plans, and %.200s is a kit", option, s->common.operands.items[0]);
    return option != NULL;
}

static void enumerate_kit(tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    const tn_enumerate_request request = request_of(s);
    int format = s->written.format;
    if (writes_plans(job) || !tn_job_writes(job, "a list of buildings", s->written.output,
                                            TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES(MPD) | TN_WRITES(LDR)))
        return;
    if (format != TN_FORMAT_AUTO && format != TN_FORMAT_LINES && format != TN_FORMAT_JSON) {
        tn_diagnostic *d = tn_job_usage(job, "buildings are written as lines or as JSON");
        tn_help(tn_job_diagnostics(job), d, "-o FILE.mpd writes a sub-file for each");
        return;
    }
    tn_job_enumerate_kit(job, &request, format == TN_FORMAT_JSON, s->written.output);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const enumerate_settings *settings = (const enumerate_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    bool open = check_options(&job) && tn_job_open_plans(&job, common->operands.items[0], &settings->plans);
    if (open && job.opened.module->KIT_count > 0)
        enumerate_kit(&job);
    else if (open)
        enumerate(&job);
    return tn_job_end(&job);
}

#define SETTINGS enumerate_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    RANK("from", 0, "RANK", from, "the first rank (default 0)"),
    RANK("to", 0, "RANK", to, "one past the last rank (default: all)"),
    NUMBER("limit", 'n', "N", limit, 0, 0, "at most N plans or houses"),
    TEXT("plan", 0, "PLAN", plan, "the houses on one plan: a plan in any spelling, or # and its rank"),
    OPTIONS_KIT("list"),
    FLAG("mirror", 0, mirror,
         "one of each pair of plans that mirror each other; ranks stay those of the whole library"),
    OPTION_PLAN_FORMAT,
    OPTION_COLUMNS,
    OPTION_CSV_SAFE,
    OPTION_PLAN_LINES,
    OPTION_ROW_GROUP,
    OUTPUT(
        written.output, TN_WRITES_ROWS | TN_WRITES(MPD) | TN_WRITES(LDR),
        "write to FILE instead of standard output, as its ending says: .json, .csv, .bin, .sqlite and .db, .parquet; "
        "of a kit .json, or .mpd or .ldr, with a sub-file for each building; otherwise as lines"),
    FLAG("resume", 0, written.resume, "continue a database that was interrupted; no plan is left out or written twice"),
    OPTION_LDRAW,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_enumerate = {
    .name = "enumerate",
    .summary = "write all plans of a library",
    .usage = "FILE [--from RANK] [--to RANK] [--limit N] [-o FILE]\nFILE --library HOUSES [--plan PLAN] [--from RANK] "
             "[--to RANK] [--limit N]\n"
             "FILE.kit --parts N [--part NAME]... [--fixed | --inside MODEL] [-o FILE]",
    .description =
        "Writes the plans of the library in the order of their ranks: by the number of trays, then tray by tray. "
        "--from and --to choose a part; ranks may have any number of digits. A database (-o FILE.sqlite) is "
        "written in batches that survive a crash, and --resume continues it. If any other output is interrupted, "
        "the plans written so far are kept, and a note says from which rank to continue.\n\n"
        "With --library HOUSES, or --plan, houses are written, plan by plan: as house lines, JSON, CSV, or into a "
        "database. Ranks are then among all houses of the library, or among those on the plan.\n\n"
        "Of a kit (docs/kit-language.md) it lists the buildings that `tartan count` counts, a line for each: its parts "
        "from the lowest up, each with its name, its place in LDU as LDraw has it (y points down) and its quarter "
        "turns. -o FILE.mpd writes an LDraw file with a sub-file for each. Ranks are counted on the way, so that a "
        "late stretch takes as long as all before it.",
    .example = "$ tartan enumerate terrace --from 1000000 --limit 100 --format csv",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
