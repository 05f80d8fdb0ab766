/* tartan draw: plans as a picture sheet, rules as a picture, surfaces shaded. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/common/subject.h"
#include "cli/mesh/draw_surface.h"
#include "cli/plan/plan_input.h"
#include "cli/plan/sampled.h"
#include "cli/plan/sheet.h"
#include "cli/solid/solid.h"
#include "driver/open/digits.h"
#include "runtime/base/picture.h"
#include "runtime/plan/picture/draw_rule.h"

typedef struct draw_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    tn_sampled_settings sampled;
    const char *output, *title, *paper;
    tn_option_list rules;
    tn_option_number sample, scale, columns, dpi, max_plans;
    /* of forms */
    const char *solid, *surface;
    bool sheet, before, exploded, sharp;
    tn_option_real azimuth, elevation;
    tn_option_number width, max_boxes, grid;
} draw_settings;

static const draw_settings *settings_of(const tn_job *job)
{
    return (const draw_settings *)job->settings;
}

enum { NOTE_COUNT = 3, NOTE_SIZE = 256 };

/* A sheet being made. */
typedef struct sheet {
    tn_job *job;
    const tn_schema *schema;
    const tn_library_record *library; /* or NULL */
    tn_plan_sheet drawn;
    bool ranked; /* numbers are ranks, not lines */
    char notes[NOTE_COUNT][NOTE_SIZE];
    size_t note_count;
} sheet;

static size_t max_plans(const draw_settings *settings)
{
    return settings->max_plans.given ? (size_t)settings->max_plans.value : TN_DRAW_PLANS_DEFAULT;
}

/* The number below a plan that was read: its rank where the file gives one, otherwise its line. */
static char *number_of(sheet *s, const tn_plan_reader *reader)
{
    char *text = NULL;
    mpz_t rank;
    mpz_init(rank);
    if (s->drawn.count == 0)
        s->ranked = tn_plan_reader_rank(reader, rank);
    if (s->ranked && tn_plan_reader_rank(reader, rank)) {
        text = mpz_get_str(NULL, 10, rank);
    } else {
        char line[24];
        snprintf(line, sizeof line, "%" PRIu64, tn_plan_reader_line(reader));
        text = strdup(line);
    }
    mpz_clear(rank);
    return text;
}

/* Reads the plans, one more than the limit at most, which drawing then refuses. False where the sheet is not to be
 * drawn. */
static bool read_plans(sheet *s, const char *path)
{
    tn_plan_reader *reader;
    const tn_plan *plan;
    tn_error error;
    const draw_settings *settings = settings_of(s->job);
    const tn_plans_source source = {path, &settings->input, &settings->plans};
    bool going = tn_job_reader(s->job, s->schema, &source, &reader);
    if (!going)
        return false;
    while (going && s->drawn.count <= max_plans(settings)) {
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        if (status == TN_OK && !plan)
            break;
        if (status == TN_OK)
            status = tn_sheet_add(&s->drawn, plan->trays, plan->length, number_of(s, reader), NULL, NULL, &error);
        else if (error.line > 0) {
            size_t size = 0;
            const char *text = tn_plan_reader_text(reader, &size);
            going = tn_job_bad_plan(s->job, &source, &error, text, size);
            continue;
        }
        if (status != TN_OK) {
            tn_job_fail(s->job, &error);
            going = false;
        }
    }
    tn_plan_reader_free(reader);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "%zu plan%s from %s", s->drawn.count, s->drawn.count == 1 ? "" : "s",
             strcmp(path, "-") == 0 ? "standard input" : path);
    return going;
}

static bool unrank_all(sheet *s, const tn_ready_library *ready, const tn_sampled *sampled)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(ready->library) + 1));
    tn_error error;
    tn_status status = trays ? TN_OK : tn_fail_memory(&error);
    for (size_t i = 0; status == TN_OK && i < sampled->count; i++) {
        uint32_t length = 0;
        tn_library_unrank(ready->library, sampled->ranks[i], trays, &length);
        status = tn_sheet_add(&s->drawn, trays, length, mpz_get_str(NULL, 10, sampled->ranks[i]), NULL, NULL, &error);
    }
    free(trays);
    if (status != TN_OK)
        tn_job_fail(s->job, &error);
    return status == TN_OK;
}

static void note_sample(sheet *s, const tn_ready_library *ready)
{
    char hash[33];
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    tn_library_hash(ready->library, hash);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "%zu of %s plans, drawn with seed %" PRIu64, s->drawn.count,
             digits ? digits : "?", settings_of(s->job)->sampled.seed.value);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "library %s", hash);
    free(digits);
    mpz_clear(kept);
}

static bool sample_plans(sheet *s, const tn_ready_library *ready)
{
    tn_sampled sampled;
    bool drawn = tn_job_sample(s->job, ready, &settings_of(s->job)->sampled, (size_t)settings_of(s->job)->sample.value,
                               &sampled) &&
                 unrank_all(s, ready, &sampled);
    tn_sampled_clear(&sampled);
    s->ranked = true;
    if (drawn)
        note_sample(s, ready);
    return drawn;
}

static void draw_sheet(sheet *s)
{
    const draw_settings *settings = settings_of(s->job);
    const tn_module *module = s->job->opened.module;
    const char *notes[NOTE_COUNT];
    tn_error error;
    tn_sheet_note_rules(s->job, s->notes[s->note_count++], NOTE_SIZE);
    for (size_t i = 0; i < s->note_count; i++)
        notes[i] = s->notes[i];
    tn_string name = s->library ? s->library->name : s->schema->record->name,
              doc = s->library ? s->library->doc : s->schema->record->doc;
    tn_draw_options options = {.title = settings->title ? settings->title : tn_text(module, name),
                               .doc = doc ? tn_text(module, doc) : NULL,
                               .number_name = s->ranked ? "rank" : "line",
                               .notes = notes,
                               .note_count = s->note_count,
                               .paper = settings->paper,
                               .scale = (uint32_t)settings->scale.value,
                               .columns = (uint32_t)settings->columns.value,
                               .dpi = (uint32_t)settings->dpi.value,
                               .max_plans = max_plans(settings)};
    tn_job_show(s->job);
    if (tn_plans_draw(s->schema, s->drawn.plans, s->drawn.count, &options, &(tn_picture){.path = settings->output},
                      &error) != TN_OK)
        tn_job_fail(s->job, &error);
}

static void draw_sample(tn_job *job)
{
    tn_ready_library ready;
    if (tn_job_library(job, job->settings->operands.items[0], &settings_of(job)->plans, &ready)) {
        sheet s = {.job = job, .schema = ready.schema, .library = ready.record};
        if (sample_plans(&s, &ready))
            draw_sheet(&s);
        tn_sheet_clear(&s.drawn);
    }
    tn_library_close(&ready);
}

static void draw_file(tn_job *job, const char *path)
{
    tn_schema *schema = NULL;
    uint32_t index, library = UINT32_MAX;
    tn_error error;
    if (!job->opened.module && !tn_job_open(job, job->settings->operands.items[0]))
        return;
    tn_status status = tn_schema_choose(&job->opened, settings_of(job)->plans.library, &index, &library);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    if (tn_schema_new(job->opened.module, index, 0, &schema, &error) == TN_OK) {
        sheet s = {.job = job, .schema = schema};
        if (library != UINT32_MAX)
            s.library = &job->opened.module->LIBRARY_records[library];
        if (read_plans(&s, path)) {
            if (s.drawn.count == 0 && job->exit_code == TN_EXIT_DONE)
                tn_job_note(job, "no plans came from %.200s: the sheet is empty",
                            strcmp(path, "-") == 0 ? "standard input" : path);
            draw_sheet(&s);
        }
        tn_sheet_clear(&s.drawn);
    } else {
        tn_job_fail(job, &error);
    }
    tn_schema_free(schema);
}

/* Rules rather than plans: one picture of those asked for, which are about the same trays. */
static void draw_rules(tn_job *job)
{
    const tn_option_list *asked = &settings_of(job)->rules;
    tn_schema *schema = NULL;
    tn_error error;
    if (!tn_job_open(job, job->settings->operands.items[0]))
        return;
    const tn_module *module = job->opened.module;
    tn_drawn_rule *rules = malloc(sizeof *rules * (asked->count + 1));
    tn_status status = rules ? TN_OK : tn_fail_memory(&error);
    uint32_t trays = 0;
    for (size_t i = 0; status == TN_OK && i < asked->count; i++) {
        uint32_t rule;
        status = tn_rule_choose(&job->opened, asked->items[i], &rule);
        tn_job_status(job, status);
        if (status != TN_OK)
            break;
        rules[i] = tn_drawn_rule_of(module, rule);
        if (i > 0 && module->RULE_records[rule].schema != trays) {
            tn_job_usage(job, "the rules of one picture are about the same trays");
            status = TN_INVALID;
        }
        trays = module->RULE_records[rule].schema;
    }
    if (status == TN_OK) {
        status = tn_schema_new(module, trays, 0, &schema, &error);
        tn_picture to = {.path = settings_of(job)->output, .dpi = (uint32_t)settings_of(job)->dpi.value};
        if (status == TN_OK)
            status = tn_rules_draw(schema, rules, asked->count, &to, &error);
        if (status != TN_OK)
            tn_job_fail(job, &error);
    }
    if (!rules)
        tn_job_fail(job, &error);
    tn_schema_free(schema);
    free(rules);
}

static bool is_sampled(const draw_settings *settings)
{
    return settings->sample.given || settings->sampled.per_length.given;
}

static bool check_options(tn_job *job)
{
    const draw_settings *settings = settings_of(job);
    tn_canvas_format format;
    tn_error error;
    if (!settings->output)
        tn_job_usage(job, "say which picture to draw: -o FILE.svg, FILE.png or FILE.pdf");
    else if (tn_canvas_format_of(settings->output, &format, &error) != TN_OK)
        tn_job_fail(job, &error);
    else if (settings->rules.count && (is_sampled(settings) || settings->common.operands.count > 1))
        tn_job_usage(job, "draw either rules or plans, not both");
    else if (is_sampled(settings) && settings->common.operands.count > 1)
        tn_job_usage(job, "draw either a file of plans or a --sample, not both");
    else if (!is_sampled(settings) && (settings->sampled.seed.given || settings->sampled.length.given ||
                                       settings->sampled.diverse || settings->plans.trays.given))
        tn_job_usage(job, "--seed, --length, --diverse and --trays say what is sampled: give --sample N too");
    else
        return true;
    return false;
}

/* ---- forms */

/* Options that say something about one or two of the subjects only. */
static bool check_use(tn_job *job)
{
    const draw_settings *s = settings_of(job);
    const tn_option_use uses[] = {
        {s->rules.count > 0, TN_OF_PLANS, "rule"},
        {s->plans.library != NULL, TN_OF_PLANS, "library"},
        {s->sample.given, TN_OF_PLANS, "sample"},
        {s->sampled.per_length.given, TN_OF_PLANS, "per-length"},
        {s->paper != NULL, TN_OF_PLANS, "paper"},
        {s->scale.given, TN_OF_PLANS, "scale"},
        {s->max_plans.given, TN_OF_PLANS, "max-plans"},
        {s->columns.given, TN_OF_PLANS | TN_OF_SOLIDS, "columns"},
        {s->solid != NULL, TN_OF_SOLIDS, "solid"},
        {s->sheet, TN_OF_SOLIDS, "sheet"},
        {s->before, TN_OF_SOLIDS, "before"},
        {s->exploded, TN_OF_SOLIDS, "exploded"},
        {s->max_boxes.given, TN_OF_SOLIDS, "max-boxes"},
        {s->azimuth.given, TN_OF_SOLIDS | TN_OF_FIELDS, "azimuth"},
        {s->elevation.given, TN_OF_SOLIDS | TN_OF_FIELDS, "elevation"},
        {s->width.given, TN_OF_SOLIDS | TN_OF_FIELDS, "width"},
        {s->surface != NULL, TN_OF_FIELDS, "surface"},
        {s->grid.given, TN_OF_FIELDS, "grid"},
        {s->sharp, TN_OF_FIELDS, "sharp"},
    };
    if (!tn_job_check_uses(job, uses, sizeof uses / sizeof *uses))
        return false;
    if (s->sheet + s->before + s->exploded > 1) {
        tn_job_usage(job, "one picture shows one thing: give one of --sheet, --before and --exploded");
        return false;
    }
    return true;
}

static tn_camera camera_of(const draw_settings *settings)
{
    tn_camera camera = tn_camera_default();
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
    const draw_settings *s = settings_of(job);
    tn_solid_drawing drawing = {.views = s->sheet      ? TN_SOLID_SHEET
                                         : s->before   ? TN_SOLID_BEFORE
                                         : s->exploded ? TN_SOLID_EXPLODED
                                                       : TN_SOLID_VIEW,
                                .camera = camera_of(s),
                                .title = s->title,
                                .columns = (uint32_t)s->columns.value,
                                .dpi = (uint32_t)s->dpi.value,
                                .most = (uint32_t)s->max_boxes.value};
    tn_job_draw_solid(job, s->solid, &drawing, s->output);
}

static void draw_field(tn_job *job)
{
    const draw_settings *s = settings_of(job);
    tn_mesh_picture picture = {.camera = camera_of(s),
                               .title = s->title,
                               .dpi = (uint32_t)s->dpi.value,
                               .threads = (int)s->plans.threads.value};
    tn_drawn_surface surface = {s->surface, (uint32_t)s->grid.value, s->sharp};
    tn_job_draw_surface(job, &surface, &picture, s->output);
}

static void draw_plans(tn_job *job)
{
    const char *path = is_sampled(settings_of(job)) ? NULL : tn_job_plans_path(job);
    if (settings_of(job)->rules.count)
        draw_rules(job);
    else if (path)
        draw_file(job, path);
    else if (job->exit_code == TN_EXIT_DONE)
        draw_sample(job);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const draw_settings *settings = (const draw_settings *)common;
    tn_job job;
    tn_job_begin(&job, common);
    if (!check_options(&job) || !tn_job_open_plans(&job, common->operands.items[0], &settings->plans))
        return tn_job_end(&job);
    static void (*const draw[TN_SUBJECT_COUNT])(tn_job *) = {draw_plans, draw_solid, draw_field};
    if (check_use(&job))
        draw[tn_job_subject(&job)](&job);
    return tn_job_end(&job);
}

#define SETTINGS draw_settings
static const tn_option options[] = {
    TEXT("output", 'o', "FILE", output, "the picture: .svg, .png or .pdf"),
    LIST("rule", 'r', "NAME", rules, "draw this rule instead of plans; may be repeated"),
    OPTIONS_LIBRARY,
    NUMBER("sample", 0, "N", sample, 1, TN_SAMPLE_MAX, "draw N plans sampled from the library"),
    NUMBER("seed", 's', "S", sampled.seed, 0, 0, "which sample (default 0)"),
    NUMBER("length", 0, "L", sampled.length, 0, UINT32_MAX - 1, "sample only plans of L trays"),
    NUMBER("per-length", 0, "N", sampled.per_length, 0, TN_SAMPLE_MAX, "sample N plans of each number of trays"),
    OPTION_DIVERSE,
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
    TEXT("solid", 0, "NAME", solid, "which design of boxes of the file; may be left out where it has only one"),
    FLAG("sheet", 0, sheet, "of a design of boxes: plan, elevations and a view on one sheet"),
    FLAG("before", 0, before, "of a design of boxes: as it is written beside what is built, so that squashing is seen"),
    FLAG("exploded", 0, exploded, "of a design of boxes: its boxes moved apart"),
    REAL("azimuth", 0, "DEGREES", azimuth, "where a form is seen from, about the vertical (default -60)"),
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
    .usage =
        "FILE [PLANS] -o SHEET.svg\nFILE --sample N [--seed S] [--diverse] -o SHEET.pdf\nFILE --rule NAME -o RULE.svg\n"
        "FILE.solid [--solid NAME] [--sheet | --before | --exploded] -o FORM.svg\n"
        "FILE.field [--surface NAME] [--grid N] -o FORM.png",
    .description =
        "Draws plans on one sheet: from a file, from standard input, or sampled from the library. Each plan is "
        "drawn to scale, with the zones, marks and dimensions that the roles in the schema ask for, its rank or "
        "line below it, and a legend. A schema whose fields have no roles is drawn as tables. A PDF has as many "
        "pages as it needs; SVG and PNG are one sheet.\n\n"
        "With --rule, rules are drawn instead, in the manner of the LaHave paper: each part is a box with its "
        "sign, the parts of `and` side by side, those of `or` one above the other, and trays with the symbols of "
        "their zones.\n\n"
        "A design of boxes (.solid) is drawn in space: shaded, each box and its images in one colour.\n\n"
        "Of a field (.field), a surface is meshed and drawn, shaded: as a PNG of any number of triangles, as an SVG or "
        "a PDF of at most 300,000.",
    .example = "$ tartan draw lahave-houses --sample 24 --seed 7 -o sheet.svg\n"
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
