/* tartan draw: plans as a picture sheet, rules as a picture, houses and forms in space. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/draw.h"
#include "ask/plan/found.h"
#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"
#include "cli/plan/plan_input.h"
#include "runtime/base/array.h"
#include "runtime/plan/picture/draw.h"

typedef struct draw_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    const char *output, *title, *paper;
    tn_option_list rules;
    tn_option_list wanted; /* wishes of --best */
    bool mirror, diverse;
    tn_option_number best, sample, seed, length, per_length, scale, columns, dpi, max_plans;
    /* of forms */
    const char *solid, *surface;
    bool sheet, before, exploded, sharp, open;
    tn_option_real azimuth, elevation;
    tn_option_number width, max_boxes, grid;
    int profile;
    const char *plan; /* of the best houses */
} draw_settings;

static const draw_settings *settings_of(const tn_job *job)
{
    return (const draw_settings *)job->settings;
}

/* ---- plans of a file */

typedef struct given_plans {
    tn_given_plan *items; /* with their texts */
    size_t count, room;
    bool ranked; /* numbers are ranks, not lines */
} given_plans;

static void clear_given(given_plans *given)
{
    for (size_t i = 0; i < given->count; i++) {
        free((char *)(uintptr_t)given->items[i].plan);
        free((char *)(uintptr_t)given->items[i].number);
    }
    free(given->items);
}

/* The number below a plan that was read: its rank where the file gives one, otherwise its line (malloc). */
static char *number_of(given_plans *given, const tn_plan_reader *reader)
{
    char *text = NULL;
    mpz_t rank;
    mpz_init(rank);
    bool ranked = (given->count == 0 || given->ranked) && tn_plan_reader_rank(reader, rank);
    if (given->count == 0)
        given->ranked = ranked;
    if (ranked)
        text = mpz_get_str(NULL, 10, rank);
    else if (asprintf(&text, "%" PRIu64, tn_plan_reader_line(reader)) < 0)
        text = NULL;
    mpz_clear(rank);
    return text;
}

static tn_status add_plan(given_plans *given, const tn_schema *schema, const tn_plan *plan,
                          const tn_plan_reader *reader, tn_error *error)
{
    char *line = NULL, *number = number_of(given, reader);
    tn_status status = tn_found_plan_texts(schema, plan->trays, (uint32_t)plan->length, &line, NULL, error);
    if (status == TN_OK &&
        (!number || !tn_array_reserve(&given->items, &given->room, given->count, 1, sizeof *given->items)))
        status = tn_fail_memory(error);
    if (status != TN_OK) {
        free(line);
        free(number);
        return status;
    }
    given->items[given->count++] = (tn_given_plan){.plan = line, .number = number};
    return TN_OK;
}

static size_t max_plans(const draw_settings *settings)
{
    return settings->max_plans.given ? (size_t)settings->max_plans.value : TN_DRAW_PLANS_DEFAULT;
}

/* Reads the plans, one more than the limit at most, which drawing then refuses. False where nothing is to be drawn. */
static bool read_plans(tn_job *job, const tn_schema *schema, const char *path, given_plans *given)
{
    const draw_settings *settings = settings_of(job);
    const tn_plans_source source = {path, &settings->input, &settings->plans};
    tn_plan_reader *reader;
    const tn_plan *plan;
    tn_error error;
    bool going = tn_job_reader(job, schema, &source, &reader);
    if (!going)
        return false;
    while (going && given->count <= max_plans(settings)) {
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        if (status == TN_OK && !plan)
            break;
        if (status == TN_OK)
            status = add_plan(given, schema, plan, reader, &error);
        else if (error.line > 0) {
            size_t size = 0;
            const char *text = tn_plan_reader_text(reader, &size);
            going = tn_job_bad_plan(job, &source, &error, text, size);
            continue;
        }
        if (status != TN_OK) {
            tn_job_fail(job, &error);
            going = false;
        }
    }
    tn_plan_reader_free(reader);
    return going;
}

/* The plans of the file that is named beside the rules, or of standard input. */
static bool take_plans(tn_job *job, const char *path, given_plans *given)
{
    tn_schema *schema;
    uint32_t index, library = UINT32_MAX;
    tn_error error;
    tn_status status = tn_schema_choose(&job->opened, settings_of(job)->plans.library, &index, &library);
    tn_job_status(job, status);
    if (status != TN_OK)
        return false;
    if (tn_schema_new(job->opened.module, index, 0, &schema, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    bool well = read_plans(job, schema, path, given);
    tn_schema_free(schema);
    if (well && given->count == 0 && job->exit_code == TN_EXIT_DONE)
        tn_job_note(job, "no plans came from %.200s: the sheet is empty",
                    strcmp(path, "-") == 0 ? "standard input" : path);
    return well;
}

/* ---- the command */

static tn_draw_request asked(const draw_settings *s)
{
    return (tn_draw_request){
        .format = tn_picture_choice(s->output),
        .profile = (unsigned)s->profile,
        .subject = tn_job_asked(&s->plans),
        .rules = {s->rules.items, s->rules.count},
        .has_sample = s->sample.given,
        .sample = s->sample.value,
        .has_seed = s->seed.given,
        .seed = s->seed.value,
        .has_length = s->length.given,
        .length = s->length.value,
        .has_per_length = s->per_length.given,
        .per_length = s->per_length.value,
        .diverse = s->diverse,
        .has_best = s->best.given,
        .best = s->best.value,
        .plan = s->plan,
        .mirror = s->mirror,
        .title = s->title,
        .paper = s->paper,
        .has_scale = s->scale.given,
        .scale = s->scale.value,
        .has_columns = s->columns.given,
        .columns = s->columns.value,
        .has_dpi = s->dpi.given,
        .dpi = s->dpi.value,
        .has_max_plans = s->max_plans.given,
        .max_plans = s->max_plans.value,
        .surface = s->surface,
        .has_grid = s->grid.given,
        .grid = s->grid.value,
        .sharp = s->sharp,
        .open = s->open,
        .solid = {.solid = s->solid, .has_max_boxes = s->max_boxes.given, .max_boxes = s->max_boxes.value},
        .show = s->sheet      ? 1
                : s->before   ? 2
                : s->exploded ? 3
                              : 0,
        .has_azimuth = s->azimuth.given,
        .azimuth = s->azimuth.value,
        .has_elevation = s->elevation.given,
        .elevation = s->elevation.value,
        .has_width = s->width.given,
        .width = s->width.value};
}

/* What the request cannot say at once. */
static bool check_options(tn_job *job)
{
    const draw_settings *s = settings_of(job);
    if (!s->output)
        tn_job_usage(job, "say which picture to draw: -o FILE.svg, FILE.png or FILE.pdf; of plans also FILE.dxf");
    else if (s->sheet + s->before + s->exploded > 1)
        tn_job_usage(job, "one picture shows one thing: give one of --sheet, --before and --exploded");
    else
        return true;
    return false;
}

/* Is a file of plans drawn, or standard input? */
static bool draws_file(const tn_job *job)
{
    const draw_settings *s = settings_of(job);
    const tn_module *module = job->opened.module;
    bool library = s->best.given || s->sample.given || s->per_length.given;
    bool forms = module->SOLID_count > 0 || module->SURFACE_count > 0;
    return !library && !forms && s->rules.count == 0 && !tn_job_of_houses(job, &s->plans);
}

static void draw(tn_job *job)
{
    const draw_settings *s = settings_of(job);
    const char *path = NULL;
    given_plans given = {0};
    tn_wished wished = {0};
    tn_draw_request request = asked(s);
    if (s->common.operands.count > 1)
        request.from = s->common.operands.items[1];
    bool well = !(s->best.given || s->wanted.count) || tn_job_wishes(job, &s->wanted, s->wanted.count ? 1 : 0, &wished);
    request.by.items = wished.items;
    request.by.count = wished.count;
    if (well && draws_file(job)) {
        path = tn_job_plans_path(job);
        request.from = path && strcmp(path, "-") == 0 ? "standard input" : path;
        well = path && tn_job_answered(job, tn_draw_check(&job->session, &request)) && take_plans(job, path, &given);
    }
    request.plans.items = given.items;
    request.plans.count = given.count;
    request.ranked = given.ranked;
    if (well)
        tn_job_draw(job, &request, s->output);
    clear_given(&given);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const draw_settings *settings = (const draw_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (check_options(&job) && tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        draw(&job);
    return tn_job_end(&job);
}

#define SETTINGS draw_settings
static const tn_option options[] = {
    OUTPUT(output, TN_WRITES_PICTURES | TN_WRITES_DXF_OF_PLANS, "the picture: .svg, .png or .pdf; of plans also .dxf"),
    LIST("rule", 'r', "NAME", rules, "draw this rule instead of plans; may be repeated"),
    OPTIONS_LIBRARY,
    NUMBER("sample", 0, "N", sample, 1, TN_DRAW_SAMPLE_MAX, "draw N plans sampled from the library"),
    NUMBER("seed", 's', "S", seed, 0, 0, "which sample (default 0)"),
    NUMBER("length", 0, "L", length, 0, UINT32_MAX - 1, "sample only plans of L trays"),
    NUMBER("per-length", 0, "N", per_length, 0, TN_DRAW_SAMPLE_MAX, "sample N plans of each number of trays"),
    FLAG("diverse", 0, diverse, "of a sample, or of the best: plans or houses that differ from one another"),
    NUMBER("best", 0, "N", best, 1, TN_DRAW_SAMPLE_MAX,
           "draw the N best plans or houses of the library, with their values"),
    TEXT("plan", 0, "PLAN", plan,
         "with --best, of houses: those on one plan, a plan in any spelling, or # and its rank"),
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
    CHOICE("profile", 0, "WORD", profile, "auto|iso|us",
           "the names of layers of a .dxf: by ISO 13567 (iso) or by the US National CAD Standard (us); by default the "
           "latter for plans in feet"),
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
    OPTION_MAX_HOUSES(
        "if walks are asked for: the most houses that are looked at one by one (default 100000 with --plan, else "
        "5000 that are tried)"),
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
