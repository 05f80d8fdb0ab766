/* tartan report: a library, or a kit, as an HTML page. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "runtime/base/formats.h"
#include "cli/common/interrupt.h"
#include "cli/common/option_rows.h"
#include "cli/common/progress.h"
#include "cli/plan/library_job.h"
#include "driver/house/judge.h"
#include "driver/open/findings.h"
#include "driver/report/kit_report.h"
#include "driver/report/report.h"
#include "runtime/plan/library/alone.h"

typedef struct report_settings {
    tn_settings common;
    tn_plan_settings plans;
    const char *output; /* a folder, or a page */
    tn_option_number sample, seed;
    tn_option_number pictures, part_limit, step_limit, search_limit; /* of a kit */
} report_settings;

static const report_settings *settings_of(const tn_job *job)
{
    return (const report_settings *)job->settings;
}

#define SAMPLES_DEFAULT 24
#define SAMPLES_MAX 2000
#define HOUSES_DEFAULT 6

/* ---- where the page goes */

typedef struct page_path {
    char text[4200];
} page_path;

static bool is_page(const char *path)
{
    return tn_file_format_of(path) == TN_FILE_HTML;
}

/* What -o names: a page, or a folder for index.html. */
static bool take_path(tn_job *job, page_path *path)
{
    const char *output = settings_of(job)->output;
    if (strlen(output) <= 4000)
        snprintf(path->text, sizeof path->text, is_page(output) ? "%s" : "%s/index.html", output);
    else
        tn_job_usage(job, "the name that -o gives is longer than 4,000 bytes");
    if (strlen(output) <= 4000)
        tn_interrupt_last_words("interrupted; %.420s is not written", path->text);
    return strlen(output) <= 4000;
}

/* Just before the work, so that a folder that cannot be made is told first. */
static bool make_folder(tn_job *job)
{
    const char *output = settings_of(job)->output;
    tn_error error;
    if (is_page(output) || tn_folder_make(output, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

static bool write_page(tn_job *job, const char *path, const tn_buffer *page)
{
    tn_output output;
    if (!tn_job_output(job, path, &output))
        return false;
    fwrite(page->data, 1, page->size, output.stream);
    tn_job_commit(job, &output);
    return true;
}

static void report(tn_job *job, const tn_ready_library *ready, const char *path)
{
    const report_settings *settings = settings_of(job);
    tn_buffer page = {0};
    tn_error error;
    tn_report_options options = {.seed = settings->seed.value,
                                 .samples = settings->sample.given ? settings->sample.value : SAMPLES_DEFAULT,
                                 .max_states = (uint32_t)settings->plans.max_states.value};
    const tn_coverage_options coverage = {.library = tn_text(job->opened.module, ready->record->name),
                                          .max_states = options.max_states,
                                          .automaton = ready->library,
                                          .imported = true};
    const tn_plan_analysis_options analysis = {
        .max_states = options.max_states, .library = ready->library, .threads = tn_job_threads(&settings->plans)};
    tn_plan_analyses analyses = {0};
    tn_covered covered = {0};
    tn_progress progress;
    tn_progress_watch(&progress, "clauses counted", tn_interrupt_waiting());
    tn_status status = tn_library_find_alone(ready->library, &error);
    if (status != TN_OK)
        tn_finding_error(&job->opened, &error);
    else
        status = tn_plan_analyse(&job->opened, &analysis, &analyses);
    progress.what = "rules measured";
    if (status == TN_OK)
        status = tn_coverage_measure(&job->opened, &coverage, &covered);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    tn_job_status(job, status);
    if (status == TN_OK && tn_report_page(&job->opened, ready, &analyses, &covered, &options, &page, &error) == TN_OK)
        write_page(job, path, &page);
    else if (status == TN_OK)
        tn_job_fail(job, &error);
    tn_covered_clear(&covered);
    tn_plan_analyses_free(&analyses);
    free(page.data);
}

/* Is the library that is named one of houses; or, where none is, is all that the file itself has one of these? */
static bool is_about_houses(const tn_job *job)
{
    const tn_module *module = job->opened.module;
    const char *name = settings_of(job)->plans.library;
    bool plans = false;
    for (uint32_t i = 0; i < module->LIBRARY_count; i++)
        plans = plans || !(module->LIBRARY_records[i].flags & TN_IMPORTED);
    return (name || !plans) && tn_house_library_find(module, name) != TN_NO_RECORD;
}

static void report_houses(tn_job *job)
{
    const report_settings *settings = settings_of(job);
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    const tn_plan_analysis_options analysis = {.max_states = (uint32_t)settings->plans.max_states.value,
                                               .threads = tn_job_threads(&settings->plans)};
    tn_plan_analyses analyses = {0};
    page_path path;
    tn_buffer page = {0};
    if (take_path(job, &path) && make_folder(job)) {
        tn_status status = tn_plan_analyse(&job->opened, &analysis, &analyses); /* its warnings are on the page */
        tn_job_status(job, status);
        if (status == TN_OK &&
            tn_job_report_houses(job, &houses, settings->sample.given ? settings->sample.value : HOUSES_DEFAULT,
                                 settings->seed.value, &page))
            write_page(job, path.text, &page);
    }
    tn_plan_analyses_free(&analyses);
    free(page.data);
}

static void report_library(tn_job *job)
{
    const report_settings *settings = settings_of(job);
    tn_ready_library ready = {0};
    page_path path;
    if (!settings->output || strcmp(settings->output, "-") == 0)
        tn_job_usage(job, "report needs -o FOLDER, a folder to write into");
    else if (is_about_houses(job))
        report_houses(job);
    else if (take_path(job, &path) && tn_job_opened_library(job, &settings->plans, &ready) && make_folder(job))
        report(job, &ready, path.text);
    tn_library_close(&ready);
}

/* ---- kits */

/* The first option that is given and about a kit, or about anything else. */
static const char *option_given(const report_settings *s, bool of_kit)
{
    const struct {
        const char *name;
        bool given, of_kit;
    } all[] = {{"library", s->plans.library != NULL, false}, {"where", s->plans.wheres.count > 0, false},
               {"sample", s->sample.given, false},           {"max-states", s->plans.max_states.given, false},
               {"threads", s->plans.threads.given, false},   {"pictures", s->pictures.given, true},
               {"part-limit", s->part_limit.given, true},    {"step-limit", s->step_limit.given, true},
               {"search-limit", s->search_limit.given, true}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].given && all[i].of_kit == of_kit)
            return all[i].name;
    return NULL;
}

static void note_models(tn_job *job, const tn_kit_report_tally *tally)
{
    if (tally->unplaced)
        tn_job_note(job, "%zu of %zu model%s could not be placed to the end: the page says why", tally->unplaced,
                    tally->models, tally->models == 1 ? "" : "s");
    if (tally->unmet)
        tn_job_note(job, "%zu requirement%s of models do%s not hold: the page says which", tally->unmet,
                    tally->unmet == 1 ? "" : "s", tally->unmet == 1 ? "es" : "");
}

static void report_kit(tn_job *job)
{
    const report_settings *settings = settings_of(job);
    const tn_kit_report_options options = {.seed = (uint32_t)settings->seed.value,
                                           .pictures = (size_t)settings->pictures.value,
                                           .part_limit = settings->part_limit.value,
                                           .step_limit = settings->step_limit.value,
                                           .search_limit = settings->search_limit.value,
                                           .watch = tn_interrupt_waiting()};
    bool standard = !settings->output || strcmp(settings->output, "-") == 0;
    tn_kit_report_tally tally;
    tn_buffer page = {0};
    tn_error error;
    page_path path;
    if (settings->seed.value > UINT32_MAX)
        tn_job_usage(job, "the --seed of a kit is at most %u", (unsigned)UINT32_MAX);
    else if (standard || (take_path(job, &path) && make_folder(job))) {
        if (tn_kit_report_page(&job->opened, &options, &page, &tally, &error) == TN_OK) {
            if (write_page(job, standard ? NULL : path.text, &page))
                note_models(job, &tally);
        } else {
            tn_job_fail(job, &error);
        }
    }
    free(page.data);
}

/* Is there neither a library nor a kit, and nothing that could have become one? */
static bool has_nothing(tn_job *job)
{
    const tn_module *module = job->opened.module;
    tn_error error;
    if (module->KIT_count || module->LIBRARY_count || module->SCHEMA_count)
        return false;
    tn_fail(&error, TN_INVALID, E_NOT_IN_FILE, "%.200s has neither a library nor a kit to show", job->opened.path);
    tn_error_help(&error, "report takes .plan files with a library, and .kit files; %s",
                  tn_opened_help(&job->opened, "this file holds neither").text);
    tn_job_fail(job, &error);
    return true;
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const report_settings *settings = (const report_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    const char *path = common->operands.items[0];
    if (tn_job_open_plans(&job, path, &settings->plans) && !has_nothing(&job)) {
        bool kit = job.opened.module->KIT_count > 0;
        const char *option = option_given(settings, !kit);
        if (option)
            tn_job_usage(&job, "--%s is about %s, and %.200s is %s", option, kit ? "a library of plans" : "a kit", path,
                         kit ? "a kit" : "none");
        else
            (kit ? report_kit : report_library)(&job);
    }
    return tn_job_end(&job);
}

#define SETTINGS report_settings
static const tn_option options[] = {
    WRITTEN(
        "output", 'o', "FOLDER", output, TN_WRITES(HTML) | TN_WRITES_FOLDER | TN_WRITES_STANDARD,
        "write FOLDER/index.html, or a page whose name ends in .html; the folder is made where it is not there; of a "
        "kit, "
        "- or nothing is standard output"),
    NUMBER("sample", 0, "N", sample, 1, SAMPLES_MAX,
           "show N plans that are kept, and of N that are generated those that are dropped (default 24); or N houses "
           "(default 6)"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which sample; of a kit, the seed of its models (default 0)"),
    NUMBER("pictures", 0, "N", pictures, 1, SIZE_MAX, "of a kit: draw its first N parts (default 500)"),
    NUMBER("part-limit", 0, "N", part_limit, 1, UINT32_MAX, "of a kit: the most parts of a model (default 1000)"),
    NUMBER("step-limit", 0, "N", step_limit, 1, UINT64_MAX,
           "of a kit: the most steps by which a model is placed (default 20000000)"),
    NUMBER("search-limit", 0, "N", search_limit, 1, UINT64_MAX,
           "of a kit: the most models that a search looks at or gives up (default 5000)"),
    OPTIONS_LIBRARY,
    OPTION_MAX_STATES,
    OPTION_THREADS(plans.threads),
    OPTION_LDRAW,
    OPTION_WERROR,
};

const tn_command tn_command_report = {
    .name = "report",
    .summary = "write a library, or a kit, as an HTML page",
    .usage = "FILE -o FOLDER\nFILE --library HOUSES -o FOLDER\nFILE.kit [-o PAGE.html]",
    .description =
        "Writes one page that needs no server and no network. It shows the library's counts by length as a chart; "
        "every rule with its picture, its text, its counts, how it relates to the other rules, the plans that "
        "prove it, and which of its parts the tests notice; the warnings of checking; and a sample of plans, kept "
        "and dropped, with the reasons. The sample can be filtered.\n\n"
        "Of a library of houses, the page shows how many houses there are and what each clause keeps out; some of the "
        "houses, drawn; and the form: its storeys, its functions and where they may be, its openings, and its tiles, "
        "drawn with their boxes.\n\n"
        "Of a kit, the page shows its models, each placed with the seed, drawn, measured and held to what it requires; "
        "which connectors join; which rule places which parts; and every part with a picture of its connectors. Limits "
        "keep this short: what could not be placed within them is said on the page, and the exit code is 0.",
    .example = "$ tartan report lahave-houses -o report",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
