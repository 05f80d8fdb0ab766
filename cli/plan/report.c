/* tartan report: a library, or a kit, as an HTML page. */
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"
#include "runtime/base/formats.h"

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

static bool is_page(const char *path)
{
    return tn_file_format_of(path) == TN_FILE_HTML;
}

/* Does -o name a page, or a folder for index.html? Of a kit the page may go to standard output. */
static bool check_path(tn_job *job)
{
    const char *output = settings_of(job)->output;
    const tn_module *module = job->opened.module;
    bool standard = !output || strcmp(output, "-") == 0, plans = module->LIBRARY_count || module->SCHEMA_count;
    if (standard && plans && module->KIT_count == 0)
        tn_job_usage(job, "report needs -o FOLDER, a folder to write into");
    else if (!standard && strlen(output) > 4000)
        tn_job_usage(job, "the name that -o gives is longer than 4,000 bytes");
    else
        return true;
    return false;
}

static void report(tn_job *job)
{
    const report_settings *s = settings_of(job);
    const char *output = s->output ? s->output : "-";
    bool folder = !is_page(output) && strcmp(output, "-") != 0;
    const tn_report_request request = {.subject = tn_job_asked(&s->plans),
                                       .houses = {s->common.operands.items + 1, s->common.operands.count - 1},
                                       .has_sample = s->sample.given,
                                       .sample = s->sample.value,
                                       .seed = s->seed.value,
                                       .has_pictures = s->pictures.given,
                                       .pictures = s->pictures.value,
                                       .has_part_limit = s->part_limit.given,
                                       .part_limit = s->part_limit.value,
                                       .has_step_limit = s->step_limit.given,
                                       .step_limit = s->step_limit.value,
                                       .has_search_limit = s->search_limit.given,
                                       .search_limit = s->search_limit.value};
    tn_made_outputs outputs;
    tn_reply answer;
    if (strcmp(output, "-") != 0)
        tn_interrupt_last_words("interrupted; %.400s%s is not written", output, folder ? "/index.html" : "");
    tn_job_files(job, &outputs, &output, 1, folder);
    tn_job_answered(job, tn_ask_report(&job->session, &request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const report_settings *settings = (const report_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans) && check_path(&job))
        report(&job);
    return tn_job_end(&job);
}

#define SETTINGS report_settings
static const tn_option options[] = {
    WRITTEN(
        "output", 'o', "FOLDER", output, TN_WRITES(HTML) | TN_WRITES_FOLDER | TN_WRITES_STANDARD,
        "write FOLDER/index.html, or a page whose name ends in .html; the folder is made where it is not there; of a "
        "kit, "
        "- or nothing is standard output"),
    NUMBER("sample", 0, "N", sample, 1, TN_REPORTED_MAX,
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
    .usage = "FILE -o FOLDER\nFILE --library HOUSES -o FOLDER\nFILE HOUSE... -o FOLDER\nFILE.kit [-o PAGE.html]",
    .description =
        "Writes one page that needs no server and no network. It begins with a sheet of plans, the brief in figures "
        "(how many plans there are, what is asked for, what each measure comes to), and a chart of each measure. Then "
        "come counts by length; every rule with its picture, its text, its counts, how it relates to the other rules, "
        "the plans that prove it, and which of its parts the tests notice; and a sample of plans, kept and dropped, "
        "with the reasons, which can be filtered. Warnings of checking and limits are at the end, once.\n\n"
        "Of a library of houses, the page shows how many houses there are and what each clause keeps out; some of the "
        "houses, drawn, each with its plans and views, its rooms, its parts and their prices; and the form: its "
        "storeys, its functions and where they may be, its openings, and its tiles, drawn with their boxes. With "
        "HOUSE, a line or a number (#P:V or #R), the page is about that house; with several, up to 12, it has them "
        "side by side: in space, in a table of areas, rooms, choices, measures and prices in which what differs is "
        "marked, and one by one.\n\n"
        "Of a kit, the page shows its models, each placed with the seed, drawn, measured and held to what it requires; "
        "which connectors join; which rule places which parts; and every part with a picture of its connectors. Limits "
        "keep this short: what could not be placed within them is said on the page, and the exit code is 0.",
    .example = "$ tartan report lahave-houses -o report",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and perhaps houses",
    .operands_min = 1,
    .operands_max = 1 + TN_REPORTED_HOUSES_MAX,
    .run = run,
};
