/* tartan enumerate: every plan of a library, once, in rank order. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ask/place/kit.h"
#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/common/progress.h"
#include "cli/plan/found_rows.h"
#include "cli/plan/library_job.h"
#include "driver/plan/provenance.h"
#include "runtime/base/formats.h"
#include "runtime/base/json.h"
#include "runtime/place/write.h"

/* ---- lists the buildings of a kit's parts */

/* What `tartan enumerate` does with a kit: every building of so many of its parts, once. */

typedef enum building_format { AS_LINES, AS_JSON, AS_SUBFILES } building_format;

typedef struct enumeration {
    tn_job *job;
    const tn_module *module;
    const char *path;
    building_format format;
    uint64_t next, written; /* next: the rank after those that were listed, or the first that is asked for */
    bool begun;
    tn_output output;
    tn_progress progress;
} enumeration;

/* ---- one building */

static void write_line(const enumeration *e, uint64_t rank, const tn_placed_model *model)
{
    FILE *out = e->output.stream;
    (void)rank;
    for (size_t i = 0; i < model->count; i++) {
        fprintf(out, "%s%s ", i ? "; " : "", model->parts[i].name);
        tn_place_write_at(e->module, &model->parts[i].frame, " ", out);
        fprintf(out, " %" PRIu32, model->parts[i].frame.heading);
    }
    putc('\n', out);
}

static void write_json(const enumeration *e, uint64_t rank, const tn_placed_model *model)
{
    tn_json json = tn_json_file(e->output.stream, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_count(&json, "building", rank);
    tn_json_list(&json, "parts");
    for (size_t i = 0; i < model->count; i++) {
        double at[3];
        tn_json_object(&json, NULL);
        tn_json_string(&json, "part", model->parts[i].name);
        tn_place_at(e->module, &model->parts[i].frame, at);
        tn_json_numbers(&json, "at", at, 3);
        tn_json_count(&json, "turn", model->parts[i].frame.heading);
        tn_json_object_end(&json);
    }
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_subfile(const enumeration *e, uint64_t rank, const tn_placed_model *model)
{
    FILE *out = e->output.stream;
    fprintf(out, "0 FILE building-%" PRIu64 ".ldr\n0 building %" PRIu64 "\n", rank, rank);
    tn_place_write_ldraw(e->module, model, NULL, out);
}

/* ---- all of them */

/* Lines would mix with progress on the terminal that both go to. */
static bool begins(void *context, uint64_t from, uint64_t to)
{
    enumeration *e = context;
    bool to_stdout = !e->path || strcmp(e->path, "-") == 0;
    e->begun = tn_job_output(e->job, e->path, &e->output);
    if (!e->begun)
        return false;
    e->next = from;
    tn_job_show(e->job);
    tn_progress_begin(&e->progress, "buildings", 0, to < UINT64_MAX ? (double)to : 0);
    e->progress.shows = e->progress.shows && !(to_stdout && isatty(STDOUT_FILENO));
    return true;
}

static bool takes(void *context, uint64_t rank, const tn_placed_model *building)
{
    enumeration *e = context;
    if (building) {
        (e->format == AS_JSON ? write_json : e->format == AS_LINES ? write_line : write_subfile)(e, rank, building);
        e->written++;
        e->next = rank + 1;
    }
    tn_progress_update(&e->progress, (double)(rank + 1));
    return !ferror(e->output.stream);
}

/* What was written stays, and how to go on is said. */
static void end(enumeration *e, tn_status status)
{
    bool interrupted = tn_interrupted();
    if (!e->begun || !interrupted)
        tn_job_answered(e->job, status);
    if (!e->begun)
        return;
    tn_progress_end(&e->progress);
    tn_job_close(e->job, &e->output, status == TN_OK || interrupted);
    if (!interrupted)
        return;
    tn_interrupt_answered();
    tn_job_interrupted(e->job,
                       "interrupted; %" PRIu64 " buildings are written, and --from %" PRIu64 " goes on after them",
                       e->written, e->next);
}

/* Writes a line for each building, or an object if `json`; if `path` ends in .mpd, a sub-file for each. */
static void job_enumerate_kit(tn_job *job, const tn_enumerate_request *request, bool json, const char *path)
{
    tn_file_format format = path ? tn_file_format_of(path) : TN_FILE_OTHER;
    bool subfiles = format == TN_FILE_MPD || format == TN_FILE_LDR;
    enumeration e = {.job = job,
                     .module = job->opened.module,
                     .path = path,
                     .format = subfiles ? AS_SUBFILES
                               : json   ? AS_JSON
                                        : AS_LINES};
    const tn_building_taker taker = {begins, takes, &e};
    tn_reply answer;
    if (subfiles && json) {
        tn_job_usage(job, "%.200s has a sub-file for each building: leave out --format", path);
        return;
    }
    job->session.buildings = &taker;
    end(&e, tn_ask_enumerate(&job->session, request, &answer));
    job->session.buildings = NULL;
    tn_reply_clear(&answer);
}

/* ---- tartan enumerate */

typedef struct enumerate_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    const char *from, *to, *plan;
    tn_option_number limit;
    bool mirror, ways, rows;
    tn_kit_options kit;
    tn_search_settings search;
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
                                  .ways = s->ways,
                                  .plans = s->rows,
                                  .search = tn_search_settings_asked(&s->search),
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
    job_enumerate_kit(job, &request, format == TN_FORMAT_JSON, s->written.output);
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
    OPTION_PLAN_WAYS,
    OPTION_ROWS_OF_PLANS(rows, "write rows of plans"),
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
    OPTION_MAX_HOUSES(TRIED_HOUSES_HELP("100000")),
    OPTIONS_LIBRARY_LIMITS,
    OPTIONS_SEARCH,
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
        "the plans written so far are kept, and a note says from which rank to continue. If the library's automaton "
        "passes a limit, its plans are found one after another by search, in the same order; --from then takes as long "
        "as finding those before.\n\n"
        "With --library HOUSES, or --plan, houses are written, plan by plan: as house lines, JSON, CSV, or into a "
        "database; with --columns as tables of houses, rooms and faces. Ranks are then among all houses of the "
        "library, or "
        "among those on the plan.\n\n"
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
