/* tartan diff: what an edit does to a library. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/plan/answers.h"
#include "cli/plan/diff_report.h"
#include "cli/plan/sheet.h"
#include "driver/house/judge.h"
#include "driver/open/digits.h"
#include "runtime/base/picture.h"

typedef struct diff_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_compare_options compare;
    tn_option_number max_houses;
} diff_settings;

static const diff_settings *settings_of(const tn_job *job)
{
    return (const diff_settings *)job->settings;
}

enum { SHOWN = 3, SHOWN_MAX = 1000, NOTE_SIZE = 400 };

/* ---- the picture: removed plans, added ones, kept ones, each under a heading */

/* Its rank in its library stands under a plan: a removed one's in the library before, the others' in that after. */
static tn_status add_plan(const tn_diff_report *report, tn_diff_part part, const mpz_t rank, const char *heading,
                          tn_plan_sheet *s, tn_error *error)
{
    const tn_library *library = tn_library_diff_part(report->diff, part);
    tn_tray *trays = malloc(((size_t)tn_library_max(library) + 1) * sizeof *trays);
    uint32_t length = 0;
    mpz_t own;
    if (!trays)
        return tn_fail_memory(error);
    mpz_init(own);
    tn_status status = tn_diff_plan(report, part, rank, trays, &length, own, error);
    if (status == TN_OK)
        status = tn_sheet_add(s, trays, length, mpz_get_str(NULL, 10, own), heading, NULL, error);
    mpz_clear(own);
    free(trays);
    return status;
}

static void describe(const tn_diff_report *report, tn_diff_part part, char *note)
{
    mpz_t count;
    mpz_init(count);
    tn_library_kept(tn_library_diff_part(report->diff, part), TN_ALL_LENGTHS, count);
    char *digits = tn_digits(count, true);
    snprintf(note, NOTE_SIZE, "%s: %zu of %s plans", tn_diff_part_names[part], report->samples[part].count,
             digits ? digits : "?");
    free(digits);
    mpz_clear(count);
}

/* headings: of the three parts. */
static tn_status collect(const tn_diff_report *report, char headings[TN_DIFF_PARTS][NOTE_SIZE], tn_plan_sheet *s,
                         tn_error *error)
{
    tn_status status = TN_OK;
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        for (size_t i = 0; status == TN_OK && i < report->samples[part].count; i++)
            status = add_plan(report, (tn_diff_part)part, report->samples[part].ranks[i], i ? NULL : headings[part], s,
                              error);
    return status;
}

static tn_status draw(const tn_diff_report *report, const tn_compare_options *options, tn_error *error)
{
    char headings[TN_DIFF_PARTS][NOTE_SIZE], made_of[NOTE_SIZE], title[NOTE_SIZE];
    const char *lines[TN_DIFF_PARTS + 1] = {headings[0], headings[1], headings[2], made_of};
    tn_plan_sheet s = {0};
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        describe(report, (tn_diff_part)part, headings[part]);
    tn_status status = collect(report, headings, &s, error);
    snprintf(made_of, NOTE_SIZE, "%.160s to %.160s, seed %" PRIu64, report->paths[0], report->paths[1],
             options->seed.value);
    snprintf(title, sizeof title, "%.160s: what changes", tn_text(report->modules[1], report->records[1]->name));
    tn_draw_options drawing = {.title = options->title ? options->title : title,
                               .number_name = "rank",
                               .notes = lines,
                               .note_count = TN_DIFF_PARTS + 1};
    if (status == TN_OK)
        status = tn_plans_draw(tn_library_schema(tn_library_diff_part(report->diff, TN_DIFF_KEPT)), s.plans, s.count,
                               &drawing, &(tn_picture){.path = options->output}, error);
    tn_sheet_clear(&s);
    return status;
}

/* ---- the command */

static void deliver(tn_job *job, tn_diff_report *report, const tn_compare_options *options)
{
    size_t count = options->sample.given ? (size_t)options->sample.value : SHOWN;
    tn_output output;
    tn_error error;
    tn_status status = tn_diff_samples_take(report, count, options->seed.value, &error);
    tn_job_show(job);
    if (status == TN_OK && options->output)
        status = draw(report, options, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    if (!tn_job_output(job, NULL, &output))
        return;
    status = (options->json ? tn_diff_write_json : tn_diff_write_text)(report, output.stream, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_job_close(job, &output, status == TN_OK);
}

void tn_job_compare(tn_job *job, const tn_compared *compared, const tn_compare_options *options)
{
    const tn_ready_library *before = compared->before, *after = compared->after;
    tn_library_diff *diff;
    tn_error error;
    if (tn_library_diff_new(before->library, after->library, compared->max_states, NULL, &diff, &error) != TN_OK) {
        error.code_offset = TN_NO_OFFSET;
        tn_job_fail(job, &error);
        return;
    }
    tn_diff_report report = {.diff = diff,
                             .paths = {compared->paths[0], compared->paths[1]},
                             .modules = {before->schema->module, after->schema->module},
                             .records = {before->record, after->record}};
    tn_measure_changes *measures = NULL;
    if (!options->without_measures && tn_measure_changes_find(job, compared, &measures, &error) != TN_OK) {
        tn_job_fail(job, &error);
    } else {
        report.measures = measures;
        deliver(job, &report, options);
    }
    tn_measure_changes_free(measures);
    tn_diff_samples_clear(&report);
    tn_library_diff_free(diff);
}

/* Is the library that is named one of houses, in either file? */
static bool is_about_houses(const tn_job jobs[2], const char *name)
{
    return name && (tn_house_library_find(jobs[0].opened.module, name) != TN_NO_RECORD ||
                    tn_house_library_find(jobs[1].opened.module, name) != TN_NO_RECORD);
}

static void compare_houses(tn_job jobs[2])
{
    const diff_settings *settings = settings_of(&jobs[0]);
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    const tn_house_comparing comparing = {
        .shown = settings->compare.sample.given ? (size_t)settings->compare.sample.value : SHOWN,
        .seed = settings->compare.seed.value,
        .one_by_one = settings->max_houses.value,
        .json = settings->compare.json};
    if (settings->compare.output)
        tn_help(tn_job_diagnostics(&jobs[0]), tn_job_usage(&jobs[0], "houses that are compared are not drawn"),
                "leave out -o; `tartan house` draws a house by its line");
    else
        tn_jobs_compare_houses(jobs, settings->common.operands.items, &houses, &comparing);
}

static void compare_plans(tn_job jobs[2])
{
    const diff_settings *settings = settings_of(&jobs[0]);
    const char *const *paths = settings->common.operands.items;
    tn_ready_library before = {0}, after = {0};
    if (tn_job_opened_library(&jobs[0], &settings->plans, &before) &&
        tn_job_opened_library(&jobs[1], &settings->plans, &after))
        tn_job_compare(
            &jobs[1], &(tn_compared){{paths[0], paths[1]}, &before, &after, (uint32_t)settings->plans.max_states.value},
            &settings->compare);
    tn_library_close(&before);
    tn_library_close(&after);
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
    if (tn_job_open_plans(&jobs[0], paths[0], &settings->plans) &&
        tn_job_open_plans(&jobs[1], paths[1], &settings->plans)) {
        if (is_about_houses(jobs, settings->plans.library))
            compare_houses(jobs);
        else
            compare_plans(jobs);
    }
    int first = tn_job_end(&jobs[0]), second = tn_job_end(&jobs[1]);
    return first > second ? first : second;
}

#define SETTINGS diff_settings
static const tn_option options[] = {
    OPTION_LIBRARY,
    NUMBER("sample", 0, "N", compare.sample, 0, SHOWN_MAX, "show the first plan of each and N at random (default 3)"),
    NUMBER("seed", 's', "S", compare.seed, 0, 0, "which random ones (default 0)"),
    FLAG("json", 0, compare.json, "write JSON, every count as a string of digits"),
    FLAG("no-measures", 0, compare.without_measures, "leave out how measures change, which takes most of the time"),
    OUTPUT(compare.output, TN_WRITES_PICTURES,
           "also draw the plans shown, removed, added and kept: .svg, .png or .pdf"),
    TEXT("title", 0, "TEXT", compare.title, "the picture's title"),
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
