/* tartan draw: plans as a picture sheet, rules as a picture, surfaces shaded. */
#include "cli/draw/draw.h"
#include "ask/form/form.h"
#include "cli/common/option_rows.h"
#include "cli/measure/wishes.h"
#include "cli/mesh/draw_surface.h"
#include "cli/plan/library_job.h"
#include "cli/solid/solid.h"
#include "driver/house/judge.h"
#include "runtime/plan/picture/draw.h"

static const tn_draw_settings *settings_of(const tn_job *job)
{
    return (const tn_draw_settings *)job->settings;
}

static bool is_sampled(const tn_draw_settings *settings)
{
    return settings->sample.given || settings->per_length.given;
}

static bool from_library(const tn_draw_settings *settings)
{
    return is_sampled(settings) || settings->best.given;
}

/* What --best goes with. */
static bool check_best(tn_job *job)
{
    const tn_draw_settings *settings = settings_of(job);
    if (settings->best.given && (is_sampled(settings) || settings->rules.count || settings->common.operands.count > 1))
        tn_job_usage(job,
                     "--best draws the best plans of a library: give it without --sample, --rule and a file of plans");
    else if (settings->best.given && settings->best.value > tn_draw_max_plans(settings))
        tn_help(tn_job_diagnostics(job),
                tn_job_usage(job, "a picture shows at most %zu plans", tn_draw_max_plans(settings)),
                "ask for fewer, or raise the limit with --max-plans");
    else if (!settings->best.given && (settings->wanted.count || settings->mirror))
        tn_job_usage(job, "--least, --most and --mirror say which plans are best: give --best N too");
    else
        return true;
    return false;
}

static bool check_options(tn_job *job)
{
    const tn_draw_settings *settings = settings_of(job);
    if (!settings->output)
        tn_job_usage(job, "say which picture to draw: -o FILE.svg, FILE.png or FILE.pdf");
    else if (settings->rules.count && (is_sampled(settings) || settings->common.operands.count > 1))
        tn_job_usage(job, "draw either rules or plans, not both");
    else if (is_sampled(settings) && settings->common.operands.count > 1)
        tn_job_usage(job, "draw either a file of plans or a --sample, not both");
    else if (!is_sampled(settings) && (settings->seed.given || settings->length.given || settings->diverse))
        tn_job_usage(job, "--seed, --length and --diverse say what is sampled: give --sample N too");
    else if (!from_library(settings) && settings->plans.trays.given)
        tn_job_usage(job, "--trays says which plans are taken from the library: give --sample N or --best N too");
    else
        return check_best(job);
    return false;
}

/* ---- forms */

/* Is the library that is named one of houses? */
static bool of_houses(const tn_job *job)
{
    const char *name = settings_of(job)->plans.library;
    return name && tn_house_library_find(job->opened.module, name) != TN_NO_RECORD;
}

/* Options that say something about one or two of the subjects only. */
static bool check_use(tn_job *job)
{
    const tn_draw_settings *s = settings_of(job);
    const tn_asked_use uses[] = {
        {s->rules.count > 0, TN_OF_PLANS, "rule"},
        {s->plans.library != NULL, TN_OF_PLANS, "library"},
        {s->sample.given, TN_OF_PLANS, "sample"},
        {s->best.given, TN_OF_PLANS, "best"},
        {s->per_length.given, TN_OF_PLANS, "per-length"},
        {s->paper != NULL, TN_OF_PLANS, "paper"},
        {s->scale.given, TN_OF_PLANS, "scale"},
        {s->max_plans.given, TN_OF_PLANS, "max-plans"},
        {s->columns.given, TN_OF_PLANS | TN_OF_SOLIDS, "columns"},
        {s->solid != NULL, TN_OF_SOLIDS, "solid"},
        {s->sheet, TN_OF_SOLIDS, "sheet"},
        {s->before, TN_OF_SOLIDS, "before"},
        {s->exploded, TN_OF_SOLIDS, "exploded"},
        {s->max_boxes.given, TN_OF_SOLIDS, "max-boxes"},
        {s->azimuth.given && !of_houses(job), TN_OF_SOLIDS | TN_OF_FIELDS, "azimuth"},
        {s->elevation.given && !of_houses(job), TN_OF_SOLIDS | TN_OF_FIELDS, "elevation"},
        {s->width.given, TN_OF_SOLIDS | TN_OF_FIELDS, "width"},
        {s->surface != NULL, TN_OF_FIELDS, "surface"},
        {s->grid.given, TN_OF_FIELDS, "grid"},
        {s->sharp, TN_OF_FIELDS, "sharp"},
        {s->open, TN_OF_FIELDS, "open"},
    };
    if (!tn_job_answered(job, tn_session_check_uses(&job->session, uses, sizeof uses / sizeof *uses)))
        return false;
    if (s->sheet + s->before + s->exploded > 1) {
        tn_job_usage(job, "one picture shows one thing: give one of --sheet, --before and --exploded");
        return false;
    }
    return true;
}

static tn_camera camera_of(const tn_draw_settings *settings, tn_camera camera)
{
    if (settings->azimuth.given)
        camera.azimuth = settings->azimuth.value;
    if (settings->elevation.given)
        camera.elevation = settings->elevation.value;
    if (settings->width.given)
        camera.width = (double)settings->width.value;
    return camera;
}

static void draw_solid(tn_job *job)
{
    const tn_draw_settings *s = settings_of(job);
    tn_solid_drawing drawing = {.views = s->sheet      ? TN_SOLID_SHEET
                                         : s->before   ? TN_SOLID_BEFORE
                                         : s->exploded ? TN_SOLID_EXPLODED
                                                       : TN_SOLID_VIEW,
                                .camera = camera_of(s, tn_camera_default()),
                                .title = s->title,
                                .columns = (uint32_t)s->columns.value,
                                .dpi = (uint32_t)s->dpi.value,
                                .most = (uint32_t)s->max_boxes.value};
    tn_job_draw_solid(job, s->solid, &drawing, s->output);
}

static void draw_field(tn_job *job)
{
    const tn_draw_settings *s = settings_of(job);
    tn_mesh_picture picture = {.camera = camera_of(s, tn_camera_default()),
                               .title = s->title,
                               .dpi = (uint32_t)s->dpi.value,
                               .threads = (int)s->plans.threads.value};
    tn_drawn_surface surface = {s->surface, (uint32_t)s->grid.value, s->sharp, s->open};
    tn_job_draw_surface(job, &surface, &picture, s->output);
}

/* What says which plans are drawn, and how they are put on paper, says nothing of houses. Is something of the kind
 * given? Then it is refused, with what does it for houses. */
static bool refuses_for_houses(tn_job *job)
{
    static const char of_trays[] = "write it as a requirement, such as --where \"quantity(any, n = 3)\"";
    static const char one_scale[] = "leave it out: all houses of a picture are to one scale. `tartan house FILE HOUSE "
                                    "-o NAME.pdf` draws one on paper";
    const tn_draw_settings *s = settings_of(job);
    const struct {
        bool given;
        const char *what, *help;
    } refused[] = {
        {s->mirror, "--mirror", "leave it out: it is about plans, not about houses"},
        {s->rules.count > 0, "--rule", "rules about houses have no picture; `tartan report` lists them"},
        {s->common.operands.count > 1, "a file of plans",
         "--sample N draws N houses of the library, and `tartan house FILE HOUSE -o NAME.svg` one"},
        {s->length.given, "--length", of_trays},
        {s->per_length.given, "--per-length", of_trays},
        {s->diverse, "--diverse", "leave it out: each house of the library is drawn as likely as each"},
        {s->paper != NULL, "--paper", one_scale},
        {s->scale.given, "--scale", one_scale},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (refused[i].given) {
            tn_diagnostic *d =
                tn_job_usage(job, "for a library of houses, `tartan draw` does not take %s", refused[i].what);
            tn_help(tn_job_diagnostics(job), d, "%s", refused[i].help);
            return true;
        }
    return false;
}

static void draw_houses(tn_job *job)
{
    const tn_draw_settings *s = settings_of(job);
    const tn_house_settings houses = tn_job_houses(&s->plans);
    tn_wished wished;
    tn_best_request best;
    tn_house_sheet sheet = {.wanted = (size_t)(s->best.given ? s->best.value : s->sample.value),
                            .best = s->best.given ? &best : NULL,
                            .columns = (size_t)s->columns.value,
                            .seed = s->seed.value,
                            .camera = camera_of(s, tn_house_sheet_camera()),
                            .title = s->title,
                            .output = s->output,
                            .dpi = (uint32_t)s->dpi.value};
    if (refuses_for_houses(job))
        return;
    if (!s->sample.given && !s->best.given) {
        tn_diagnostic *d = tn_job_usage(job, "of a library of houses, a sample or the best are drawn");
        tn_help(tn_job_diagnostics(job), d,
                "write --sample N, or --best N --least MEASURE; `tartan house` draws one house");
        return;
    }
    if (s->best.given && !tn_job_wishes(job, &s->wanted, 1, &wished))
        return;
    best = (tn_best_request){.subject = tn_job_asked(&s->plans), .by = {wished.items, wished.count}};
    tn_job_draw_houses(job, &houses, &sheet);
}

static void draw_plans(tn_job *job)
{
    if (of_houses(job)) {
        draw_houses(job);
        return;
    }
    const char *path = from_library(settings_of(job)) ? NULL : tn_job_plans_path(job);
    if (settings_of(job)->rules.count)
        tn_job_draw_rules(job);
    else if (path)
        tn_job_draw_file(job, path);
    else if (job->exit_code == TN_EXIT_DONE)
        tn_job_draw_library(job);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const tn_draw_settings *settings = (const tn_draw_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (!check_options(&job) || !tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        return tn_job_end(&job);
    static void (*const draw[TN_SUBJECT_COUNT])(tn_job *) = {draw_plans, draw_solid, draw_field};
    if (check_use(&job))
        draw[tn_subject_of(job.opened.module)](&job);
    return tn_job_end(&job);
}

#define SETTINGS tn_draw_settings
static const tn_option options[] = {
    OUTPUT(output, TN_WRITES_PICTURES, "the picture: .svg, .png or .pdf"),
    LIST("rule", 'r', "NAME", rules, "draw this rule instead of plans; may be repeated"),
    OPTIONS_LIBRARY,
    NUMBER("sample", 0, "N", sample, 1, TN_DRAW_SAMPLE_MAX, "draw N plans sampled from the library"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which sample (default 0)"),
    NUMBER("length", 0, "L", length, 0, UINT32_MAX - 1, "sample only plans of L trays"),
    NUMBER("per-length", 0, "N", per_length, 0, TN_DRAW_SAMPLE_MAX, "sample N plans of each number of trays"),
    FLAG("diverse", 0, diverse, "plans that differ from one another, instead of each as likely as each"),
    NUMBER("best", 0, "N", best, 1, TN_DRAW_SAMPLE_MAX,
           "draw the N best plans or houses of the library, with their values"),
    WISH("least", wanted, "with --best: the plans with the least MEASURE first"),
    WISH("most", wanted, "with --best: the plans with the most MEASURE first"),
    WISH("then-least", wanted, "of equal ones those with the least of this measure; may be repeated"),
    WISH("then-most", wanted, "of equal ones those with the most of this measure; may be repeated"),
    FLAG("mirror", 0, mirror, "with --best: leave out a plan whose mirror image is kept and of lower rank"),
    TEXT("title", 0, "TEXT", title, "the sheet's title (default: the library's or schema's name)"),
    TEXT("paper", 0, "SIZE", paper,
         "a0 to a4, arch-a to arch-e, letter or tabloid (default: the smallest of three that holds all)"),
    NUMBER("scale", 0, "N", scale, 1, 1000000, "draw at 1:N (default: the largest usual scale that fits)"),
    NUMBER("columns", 0, "N", columns, 1, 1000, "N plans in a row (default: as many as fit)"),
    NUMBER("dpi", 0, "N", dpi, 10, 2400, "pixels an inch of a PNG (default 150)"),
    NUMBER("max-plans", 0, "N", max_plans, 1, 10000000, "the most plans of one drawing (default 5000)"),
    TEXT("surface", 0, "NAME", surface, "of fields: which surface (default: the last)"),
    NUMBER("grid", 'n', "N", grid, 2, 8192,
           "of fields: samples on the longest side of the box (default: what the file says, or 50)"),
    FLAG("sharp", 0, sharp, "of fields: make edges and corners of the form sharp"),
    FLAG("open", 0, open, "of fields: end the form at the box instead of closing it there, so that one sees into it"),
    TEXT("solid", 0, "NAME", solid, "which design of boxes of the file; may be left out where it has only one"),
    FLAG("sheet", 0, sheet, "of a design of boxes: plan, elevations and a view on one sheet"),
    FLAG("before", 0, before, "of a design of boxes: as it is written beside what is built, so that squashing is seen"),
    FLAG("exploded", 0, exploded, "of a design of boxes: its boxes moved apart"),
    REAL("azimuth", 0, "DEGREES", azimuth,
         "where a form or house is seen from, about the vertical (default -60; of houses 60)"),
    REAL("elevation", 0, "DEGREES", elevation, "how high from: 90 is straight above (default 30)"),
    NUMBER("width", 0, "POINTS", width, 50, 5000, "width of a picture of a form (default 480)"),
    OPTION_MAX_BOXES(max_boxes),
    OPTION_INPUT_FORMAT,
    OPTION_ON_ERROR,
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_draw = {
    .name = "draw",
    .summary = "draw plans, rules or a form in space",
    .usage = "FILE [PLANS] -o SHEET.svg\nFILE --sample N [--seed S] [--diverse] -o SHEET.pdf\nFILE --best N "
             "--least MEASURE -o SHEET.svg\nFILE --rule NAME -o RULE.svg\n"
             "FILE.solid [--solid NAME] [--sheet | --before | --exploded] -o FORM.svg\n"
             "FILE.field [--surface NAME] [--grid N] -o FORM.png",
    .description =
        "Draws plans on one sheet: from a file, from standard input, sampled from the library, or its best by a "
        "measure. Each plan is "
        "drawn to scale, with the zones, marks and dimensions that the roles in the schema ask for, its rank or "
        "line below it, and a legend. A schema whose fields have no roles is drawn as tables. A PDF has as many "
        "pages as it needs; SVG and PNG are one sheet.\n\n"
        "With --library HOUSES, --sample N and --best N draw houses instead: N of them in space. Those of a sample "
        "have "
        "their ranks, floor areas and costs below them; the best have their names #P:V and their values.\n\n"
        "With --rule, rules are drawn instead, in the manner of the LaHave paper: each part is a box with its "
        "sign, the parts of `and` side by side, those of `or` one above the other, and trays with the symbols of "
        "their zones.\n\n"
        "A design of boxes (.solid) is drawn in space: shaded, each box and its images in one colour.\n\n"
        "Of a field (.field), a surface is meshed and drawn, shaded: as a PNG of any number of triangles, as an SVG or "
        "a PDF of at most 300,000.",
    .example = "$ tartan draw lahave-houses --sample 24 --seed 7 -o sheet.svg\n"
               "$ tartan draw cottage --library cottages --sample 12 -o houses.png\n"
               "$ tartan enumerate terrace --limit 50 | tartan draw terrace - -o rows.pdf\n"
               "$ tartan draw primitives --surface klein --grid 150 -o klein.png",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "draw fewer of them",
    .operands = "a rule file and a file of plans",
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
