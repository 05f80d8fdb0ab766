/* tartan slice: the outlines of a surface or of a design of boxes, layer by layer. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/option_rows.h"
#include "cli/common/subject.h"
#include "cli/mesh/mesh.h"
#include "driver/solid/solid.h"
#include "runtime/field/slices.h"
#include "runtime/geometry/union/union.h"
#include "runtime/slices/write.h"

typedef struct slice_settings {
    tn_settings common;
    const char *output, *surface, *solid;
    int format; /* 0 by the name, then as in `writers` */
    int engine; /* 0 tape, 1 vm */
    tn_option_real layer;
    tn_option_number grid, max_samples, max_boxes, threads;
} slice_settings;

static const struct {
    const char *word;
    tn_status (*write)(const tn_slices *, const tn_slices_style *, FILE *, tn_error *);
} writers[] = {{"svg", tn_slices_write_svg}, {"dxf", tn_slices_write_dxf}, {"cli", tn_slices_write_cli}};
#define WRITER_COUNT (sizeof writers / sizeof *writers)

static const slice_settings *settings_of(const tn_job *job)
{
    return (const slice_settings *)job->settings;
}

static bool is_folder(const char *path)
{
    struct stat known;
    size_t size = strlen(path);
    return (size > 0 && path[size - 1] == '/') || (stat(path, &known) == 0 && S_ISDIR(known.st_mode));
}

/* Which writer -o and --format mean; false (reported) where they mean none. */
static bool choose_writer(tn_job *job, size_t *writer)
{
    const slice_settings *s = settings_of(job);
    const char *dot = s->output ? strrchr(s->output, '.') : NULL;
    *writer = s->format ? (size_t)s->format - 1 : WRITER_COUNT;
    if (!s->output) {
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "where are the slices to go?"),
                "-o FILE.svg, FILE.dxf or FILE.cli, or a folder, which gets a file for each layer");
        return false;
    }
    if (!s->layer.given) {
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "how high is a layer?"),
                "--layer 0.2 makes layers of 0.2, in the unit of the file");
        return false;
    }
    for (size_t i = 0; i < WRITER_COUNT && dot && !s->format; i++)
        if (strcasecmp(dot + 1, writers[i].word) == 0)
            *writer = i;
    if (*writer == WRITER_COUNT && is_folder(s->output))
        *writer = 0;
    if (*writer < WRITER_COUNT)
        return true;
    tn_help(tn_job_diagnostics(job), tn_job_usage(job, "%s does not say which file is to be written", s->output),
            "end its name in .svg, .dxf or .cli, or say --format");
    return false;
}

static bool write_one(tn_job *job, const tn_slices *slices, const tn_slices_style *style, size_t writer,
                      const char *path)
{
    tn_output output;
    tn_error error;
    tn_status status = tn_output_open(path, &output, &error);
    if (status == TN_OK) {
        status = writers[writer].write(slices, style, output.stream, &error);
        if (status == TN_OK)
            tn_job_commit(job, &output);
        else
            tn_output_discard(&output);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return job->exit_code == TN_EXIT_DONE;
}

/* A file for each layer: FOLDER/layer-0001.svg and so on. */
static void write_folder(tn_job *job, const tn_slices *slices, tn_slices_style *style, size_t writer)
{
    const char *folder = settings_of(job)->output;
    char *path = NULL;
    tn_error error;
    tn_status status = tn_folder_make(folder, &error);
    for (size_t layer = 0; status == TN_OK && layer < slices->layer_count; layer++) {
        const char *between = folder[strlen(folder) - 1] == '/' ? "" : "/";
        style->first = layer;
        style->last = layer + 1;
        if (asprintf(&path, "%s%slayer-%04zu.%s", folder, between, layer + 1, writers[writer].word) < 0) {
            status = tn_fail_memory(&error);
            break;
        }
        bool well = write_one(job, slices, style, writer, path);
        free(path);
        if (!well)
            return;
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
}

static void write_slices(tn_job *job, const tn_slices *slices, tn_slices_style *style, size_t writer, uint32_t name)
{
    const char *output = settings_of(job)->output;
    char note[240];
    tn_mesh_note(job, name, note, sizeof note);
    style->note = note;
    style->name = tn_text(job->opened.module, name);
    style->last = slices->layer_count;
    if (is_folder(output))
        write_folder(job, slices, style, writer);
    else
        write_one(job, slices, style, writer, output);
}

static tn_status slice_field(tn_job *job, const tn_open_field *open, size_t writer, tn_error *error)
{
    const slice_settings *s = settings_of(job);
    tn_contour_options options = {.threads = (unsigned)s->threads.value,
                                  .interpret = s->engine == 1,
                                  .every_sample = s->engine == 1,
                                  .samples = s->max_samples.value};
    tn_field_grid grid = tn_field_grid_of(&open->field, (uint32_t)s->grid.value);
    tn_field_slices slices;
    tn_status status = tn_field_slices_new(&open->field, &grid, s->layer.value, &options, &slices, error);
    if (status == TN_OK) {
        tn_job_warn_of_contour(job, &slices.contour, "there the outline runs between samples");
        tn_slices_style style = {.unit = open->field.record->unit};
        memcpy(style.low, grid.low, sizeof style.low);
        memcpy(style.high, grid.high, sizeof style.high);
        write_slices(job, &slices.slices, &style, writer, open->field.record->name);
    }
    tn_field_slices_clear(&slices);
    return status;
}

static void answer_field(tn_job *job, size_t writer)
{
    tn_open_field open = {0};
    tn_error error;
    tn_status status = tn_open_field_of(job, settings_of(job)->surface, &open, &error);
    if (status == TN_OK)
        status = slice_field(job, &open, writer, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_open_field_close(&open);
}

/* ---- designs of boxes */

static void find_bounds(const tn_mesh *mesh, tn_slices_style *style)
{
    for (size_t k = 0; k < 3; k++) {
        style->low[k] = INFINITY;
        style->high[k] = -INFINITY;
        for (size_t v = 0; v < mesh->vertex_count; v++) {
            style->low[k] = fmin(style->low[k], mesh->positions[3 * v + k]);
            style->high[k] = fmax(style->high[k], mesh->positions[3 * v + k]);
        }
    }
}

static void answer_solid(tn_job *job, size_t writer)
{
    const slice_settings *s = settings_of(job);
    const tn_module *module = job->opened.module;
    tn_built built = {0};
    tn_union u = {0};
    tn_slices slices = {0};
    tn_error error;
    uint32_t solid;
    tn_status status = tn_solid_choose(&job->opened, s->solid, &solid);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    status = tn_built_make(module, solid, (uint32_t)s->max_boxes.value, &built, &error);
    if (status == TN_OK)
        status = tn_union_make(built.cells, built.cell_count, &u, &error);
    tn_solid_turn_up(&u.mesh);
    if (status == TN_OK)
        status = tn_slices_of_mesh(&u.mesh, s->layer.value, &slices, &error);
    if (status == TN_OK) {
        const tn_solid_record *record = &module->SOLID_records[solid];
        tn_slices_style style = {.unit = record->model}; /* none, mm, cm, m: as units are */
        find_bounds(&u.mesh, &style);
        write_slices(job, &slices, &style, writer, record->name);
    } else {
        tn_job_status(job, tn_solid_fail(&job->opened, solid, &error));
    }
    tn_slices_clear(&slices);
    tn_union_clear(&u);
    tn_built_clear(&built);
}

/* Options that say something about fields only, or about designs of boxes only. */
static bool check_use(tn_job *job)
{
    const slice_settings *s = settings_of(job);
    const tn_option_use uses[] = {
        {s->surface != NULL, TN_OF_FIELDS, "surface"},       {s->grid.given, TN_OF_FIELDS, "grid"},
        {s->max_samples.given, TN_OF_FIELDS, "max-samples"}, {s->engine != 0, TN_OF_FIELDS, "engine"},
        {s->threads.given, TN_OF_FIELDS, "threads"},         {s->solid != NULL, TN_OF_SOLIDS, "solid"},
        {s->max_boxes.given, TN_OF_SOLIDS, "max-boxes"},
    };
    bool neither = tn_job_subject(job) == TN_SUBJECT_PLANS; /* what is missing is said where it is looked for */
    return neither || tn_job_check_uses(job, uses, sizeof uses / sizeof *uses);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    size_t writer;
    tn_job_begin(&job, common);
    if (choose_writer(&job, &writer) && tn_job_open(&job, common->operands.items[0])) {
        bool solid = job.opened.module->SOLID_count > 0;
        if (check_use(&job) && solid)
            answer_solid(&job, writer);
        else if (!solid && job.exit_code == TN_EXIT_DONE)
            answer_field(&job, writer);
    }
    return tn_job_end(&job);
}

#define SETTINGS slice_settings

static const tn_option options[] = {
    REAL("layer", 'l', "HEIGHT", layer, "how high a layer is, in the unit of the file"),
    OUTPUT(output, TN_WRITES(SVG) | TN_WRITES(DXF) | TN_WRITES(CLI) | TN_WRITES_FOLDER,
           "the slices: .svg, .dxf or .cli; a folder gets a file for each layer; - is standard output"),
    CHOICE("format", 'f', "FORMAT", format, "auto|svg|dxf|cli", "what is written, where the name does not say it"),
    TEXT("surface", 's', "NAME", surface, "which surface of the file (default: the last)"),
    TEXT("solid", 0, "NAME", solid, "which design of the file; may be left out where the file has only one"),
    NUMBER("grid", 'n', "N", grid, 2, 8192,
           "samples on the longest side of the box (default: what the file says, or 50)"),
    NUMBER("max-samples", 0, "N", max_samples, 8, 1ull << 36, "the most samples of all layers (default 2000000000)"),
    OPTION_MAX_BOXES(max_boxes),
    CHOICE("engine", 0, "ENGINE", engine, "tape|vm",
           "tape (the default) evaluates rows of samples and skips what is proven; vm interprets the code at every "
           "sample: the same slices, more slowly"),
    OPTION_THREADS(threads),
    OPTION_WERROR,
};

const tn_command tn_command_slice = {
    .name = "slice",
    .summary = "cut an implicit surface or a design of boxes into layers",
    .usage = "FILE.field --layer HEIGHT -o FILE.svg|dxf|cli\nFILE.field --layer HEIGHT -o FOLDER\nFILE.solid [--solid "
             "NAME] --layer HEIGHT -o "
             "FILE.svg|dxf|cli",
    .description =
        "Cuts the box into layers from below, and writes the outlines of what is inside in the middle of each. They "
        "are "
        "found on the expression itself, not on triangles. Outlines are closed and do not cross; outer ones run "
        "counter-clockwise, those of holes clockwise. What reaches the box's sides is closed there.\n"
        "Of a design of boxes (.solid) they are the outlines of the union of its boxes, which turn only where its "
        "faces "
        "meet; z is up, as in meshes.",
    .example = "$ tartan slice pebble.field --layer 0.25 -o pebble.cli\n"
               "$ tartan slice pebble.field --layer 1 --grid 200 -o layers/ --format dxf",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
