/* tartan slice: the outlines of a surface, layer by layer. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/option_rows.h"
#include "cli/mesh/mesh.h"
#include "runtime/field/slices_write.h"

typedef struct slice_settings {
    tn_settings common;
    const char *output, *surface;
    int format; /* 0 by the name, then as in `writers` */
    int engine; /* 0 tape, 1 vm */
    tn_option_real layer;
    tn_option_number grid, max_samples, threads;
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

static tn_status slice(tn_job *job, const tn_open_field *open, size_t writer, tn_error *error)
{
    const slice_settings *s = settings_of(job);
    tn_contour_options options = {.threads = (unsigned)s->threads.value,
                                  .interpret = s->engine == 1,
                                  .every_sample = s->engine == 1,
                                  .samples = s->max_samples.value};
    tn_field_grid grid = tn_field_grid_of(&open->field, (uint32_t)s->grid.value);
    tn_slices slices;
    char note[240];
    tn_status status = tn_slices_new(&open->field, &grid, s->layer.value, &options, &slices, error);
    if (status == TN_OK) {
        tn_job_warn_of_contour(job, &slices.contour, "there the outline runs between samples");
        tn_mesh_note(job, open->field.record->name, note, sizeof note);
        tn_slices_style style = {.note = note,
                                 .name = tn_text(open->field.module, open->field.record->name),
                                 .unit = open->field.record->unit,
                                 .last = slices.layer_count};
        memcpy(style.low, grid.low, sizeof style.low);
        memcpy(style.high, grid.high, sizeof style.high);
        if (is_folder(s->output))
            write_folder(job, &slices, &style, writer);
        else
            write_one(job, &slices, &style, writer, s->output);
    }
    tn_slices_clear(&slices);
    return status;
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_error error;
    tn_open_field open = {0};
    size_t writer;
    tn_job_begin(&job, common);
    if (choose_writer(&job, &writer) && tn_job_open(&job, common->operands.items[0])) {
        tn_status status = tn_open_field_of(&job, settings_of(&job)->surface, &open, &error);
        if (status == TN_OK)
            status = slice(&job, &open, writer, &error);
        if (status != TN_OK)
            tn_job_fail(&job, &error);
    }
    tn_open_field_close(&open);
    return tn_job_end(&job);
}

#define SETTINGS slice_settings

static const tn_option options[] = {
    REAL("layer", 'l', "HEIGHT", layer, "how high a layer is, in the unit of the file"),
    TEXT("output", 'o', "FILE", output,
         "the slices: .svg, .dxf or .cli; a folder gets a file for each layer; - is standard output"),
    CHOICE("format", 'f', "FORMAT", format, "auto|svg|dxf|cli", "what is written, where the name does not say it"),
    TEXT("surface", 's', "NAME", surface, "which surface of the file (default: the last)"),
    NUMBER("grid", 'n', "N", grid, 2, 8192,
           "samples on the longest side of the box (default: what the file says, or 50)"),
    NUMBER("max-samples", 0, "N", max_samples, 8, 1ull << 36, "the most samples of all layers (default 2000000000)"),
    CHOICE("engine", 0, "ENGINE", engine, "tape|vm",
           "tape (the default) evaluates rows of samples and skips what is proven; vm interprets the code at every "
           "sample: the same slices, more slowly"),
    OPTION_THREADS(threads),
    OPTION_WERROR,
};

const tn_command tn_command_slice = {
    .name = "slice",
    .summary = "cut an implicit surface into layers",
    .usage = "FILE.field --layer HEIGHT -o FILE.svg|dxf|cli\nFILE.field --layer HEIGHT -o FOLDER",
    .description =
        "Cuts the box into layers from below, and writes the outlines of what is inside in the middle of each. They "
        "are "
        "found on the expression itself, not on triangles. Outlines are closed and do not cross; outer ones run "
        "counter-clockwise, those of holes clockwise. What reaches the box's sides is closed there.",
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
