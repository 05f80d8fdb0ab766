/* tartan enumerate: every plan of a library, once, in rank order. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/place/enumerate_kit.h"
#include "cli/plan/plan_output.h"
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

/* How often the loop looks at the clock and for interruptions. */
enum { LOOK_EVERY = 4096 };

/* One enumeration: the ranks [rank, to) that are left. */
typedef struct enumeration {
    tn_job *job;
    const tn_ready_library *ready;
    tn_plan_writer *writer;
    mpz_t rank, to;
    mpz_t first;             /* the first of all ranks, before anything was resumed */
    uint64_t written, limit; /* plans in the file, those resumed included; 0: no limit */
    bool limited;
} enumeration;

/* The ranks asked for, no further than the library goes. False where no stretch was asked for. */
static bool find_range(enumeration *e)
{
    const enumerate_settings *settings = settings_of(e->job);
    bool found = tn_job_range(e->job, e->ready->library, settings->from, settings->to, e->rank, e->to);
    mpz_set(e->first, e->rank);
    return found;
}

/* What decides the result. The limit is left out: a library can be resumed to go on past it. */
static char *describe(const enumerate_settings *settings)
{
    const tn_enumerated asked = {.from = settings->from,
                                 .to = settings->to,
                                 .mirror = settings->mirror,
                                 .trays_given = settings->plans.trays.given,
                                 .trays_min = settings->plans.trays.low,
                                 .trays_max = settings->plans.trays.high};
    return tn_enumerated_words(&asked);
}

static void resume(enumeration *e)
{
    mpz_t last;
    mpz_init(last);
    e->written = tn_plan_writer_resumed(e->writer, last);
    if (e->written > 0) {
        mpz_add_ui(e->rank, last, 1);
        tn_job_note(e->job, "%" PRIu64 " plans are there already; going on after them", e->written);
        tn_job_show(e->job);
    }
    mpz_clear(last);
}

static bool is_done(const enumeration *e)
{
    return e->limited && e->written >= e->limit;
}

/* Keeps what was written: whole batches of a database, every plan of anything else. A database that was to be replaced
 * is as it was, which is said at the end. */
static void interrupt(enumeration *e)
{
    if (tn_plan_writer_replaces(e->writer))
        return;
    tn_interrupt_answered();
    if (tn_plan_writer_resumes(e->writer)) {
        tn_job_interrupted(e->job, "interrupted; a database keeps its whole batches, and --resume goes on after them");
    } else {
        tn_job_rows_close(e->job, e->writer);
        e->writer = NULL;
        char *rank = mpz_get_str(NULL, 10, e->rank);
        if (rank)
            tn_job_interrupted(e->job, "interrupted; %" PRIu64 " plans are written, and --from %s goes on after them",
                               e->written, rank);
        free(rank);
    }
}

/* ---- progress: plans, where there is a limit of them, else ranks */

static double ranks_from_first(const enumeration *e, const mpz_t rank)
{
    mpz_t ranks;
    mpz_init(ranks);
    mpz_sub(ranks, rank, e->first);
    double count = mpz_get_d(ranks);
    mpz_clear(ranks);
    return count;
}

static double done(const enumeration *e)
{
    return e->limited ? (double)e->written : ranks_from_first(e, e->rank);
}

static void begin_progress(const enumeration *e, tn_progress *progress)
{
    const enumerate_settings *settings = settings_of(e->job);
    bool to_stdout = !settings->written.output || strcmp(settings->written.output, "-") == 0;
    double ranks = ranks_from_first(e, e->to), plans = (double)e->limit;
    bool enough = settings->mirror || plans < ranks; /* as far as can be known */
    tn_progress_begin(progress, settings->mirror && !e->limited ? "ranks" : "plans", done(e),
                      e->limited && enough ? plans : ranks);
    progress->shows = progress->shows && !(to_stdout && isatty(STDOUT_FILENO)); /* not between the plans */
}

static tn_status write_plans(enumeration *e, tn_cursor *cursor, tn_error *error)
{
    bool mirror = settings_of(e->job)->mirror;
    const tn_tray *trays;
    uint32_t length;
    uint64_t seen = 0;
    tn_progress progress;
    tn_status status = TN_OK;
    begin_progress(e, &progress);
    while (status == TN_OK && !is_done(e) && tn_cursor_next(cursor, &trays, &length)) {
        if (!mirror || tn_library_mirror_first(e->ready->library, trays, length)) {
            status = tn_plan_writer_write(e->writer, e->rank, trays, length, error);
            e->written++;
        }
        mpz_add_ui(e->rank, e->rank, 1);
        if (++seen % LOOK_EVERY == 0) {
            tn_progress_update(&progress, done(e));
            if (tn_interrupted())
                break;
        }
    }
    tn_progress_end(&progress);
    return status;
}

static void enumerate(enumeration *e)
{
    tn_cursor *cursor;
    tn_error error;
    resume(e);
    tn_status status = tn_cursor_new(e->ready->library, e->rank, e->to, &cursor, &error);
    if (status == TN_OK) {
        status = write_plans(e, cursor, &error);
        tn_cursor_free(cursor);
    }
    if (status != TN_OK)
        tn_job_fail(e->job, &error);
    else if (tn_interrupted())
        interrupt(e);
    if (e->writer)
        tn_job_rows_close(e->job, e->writer);
}

static bool check_options(tn_job *job)
{
    const enumerate_settings *settings = settings_of(job);
    if (!settings->written.resume || (settings->written.output && strcmp(settings->written.output, "-") != 0))
        return true;
    tn_job_usage(job, "--resume needs the database to continue: -o FILE.sqlite");
    return false;
}

static void enumerate_plans(tn_job *job, const tn_ready_library *ready)
{
    const enumerate_settings *settings = settings_of(job);
    enumeration e = {.job = job, .ready = ready, .limited = settings->limit.given, .limit = settings->limit.value};
    char *made = describe(settings);
    mpz_inits(e.rank, e.to, e.first, NULL);
    if (find_range(&e) && made && tn_job_plan_writer(job, ready, &settings->written, made, &e.writer))
        enumerate(&e);
    mpz_clears(e.rank, e.to, e.first, NULL);
    free(made);
}

/* Is the library that is named one of houses, or a plan given whose houses are wanted? */
static bool is_about_houses(const tn_job *job)
{
    const enumerate_settings *settings = settings_of(job);
    return settings->plan || tn_job_of_houses(job, &settings->plans);
}

static void enumerate_houses(tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    const tn_house_settings houses = tn_job_houses(&s->plans);
    const tn_house_range range = {s->from, s->to, s->limit.value, s->limit.given};
    if (s->mirror)
        tn_job_usage(job, "--mirror is about plans: of houses all are written");
    else
        tn_job_list_houses(job, &houses, s->plan, &range, &s->written);
}

/* What only libraries of plans are asked. */
static bool asks_library(tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    const char *option = s->plans.library        ? "library"
                         : s->plans.wheres.count ? "where"
                         : s->plans.trays.given  ? "trays"
                         : s->plan               ? "plan"
                         : s->mirror             ? "mirror"
                         : s->written.columns    ? "columns"
                         : s->written.csv_safe   ? "csv-safe"
                         : s->written.resume     ? "resume"
                                                 : NULL;
    if (option)
        tn_job_usage(job, "--%s is about a library of plans, and %.200s is a kit", option, s->common.operands.items[0]);
    return option != NULL;
}

static bool asks_kit(tn_job *job)
{
    const tn_kit_asked asked = tn_kit_options_ask(&settings_of(job)->kit);
    return !tn_job_answered(job, tn_kit_none_asked(&job->session, &asked));
}

static void enumerate_kit(tn_job *job)
{
    const enumerate_settings *s = settings_of(job);
    const tn_building_range range = {s->from, s->to, s->limit};
    int format = s->written.format;
    if (asks_library(job) || !tn_job_writes(job, "a list of buildings", s->written.output,
                                            TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES(MPD) | TN_WRITES(LDR)))
        return;
    if (format != TN_FORMAT_AUTO && format != TN_FORMAT_LINES && format != TN_FORMAT_JSON) {
        tn_diagnostic *d = tn_job_usage(job, "buildings are written as lines or as JSON");
        tn_help(tn_job_diagnostics(job), d, "-o FILE.mpd writes a sub-file for each");
        return;
    }
    tn_job_enumerate_kit(job, &s->kit, format == TN_FORMAT_JSON, &range, s->written.output);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const enumerate_settings *settings = (const enumerate_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    tn_job_begin(&job, common);
    bool open = check_options(&job) && tn_job_open_plans(&job, common->operands.items[0], &settings->plans);
    if (open && job.opened.module->KIT_count > 0)
        enumerate_kit(&job);
    else if (open && asks_kit(&job))
        open = false; /* has been said */
    else if (open && is_about_houses(&job))
        enumerate_houses(&job);
    else if (open && tn_job_opened_library(&job, &settings->plans, &ready))
        enumerate_plans(&job, &ready);
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS enumerate_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    RANK("from", 0, "RANK", from, "the first rank (default 0)"),
    RANK("to", 0, "RANK", to, "one past the last rank (default: all)"),
    NUMBER("limit", 'n', "N", limit, 0, 0, "at most N plans or houses"),
    TEXT("plan", 0, "PLAN", plan, "the houses on one plan: a plan line, or # and its rank"),
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
        "of a kit .json, or .mpd, with a sub-file for each building; otherwise as lines"),
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
