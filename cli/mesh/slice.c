/* tartan slice: the outlines of a surface or of a design of boxes, layer by layer. */
#include <string.h>
#include <sys/stat.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"

typedef struct slice_settings {
    tn_settings common;
    const char *output, *surface, *solid;
    int format; /* 0 by the name, then as in `writers` */
    int engine; /* 0 tape, 1 vm */
    tn_option_real layer;
    tn_option_number grid, max_samples, max_boxes, threads;
} slice_settings;

/* What is written, in the order of the words of --format and of the request. */
static const tn_file_format formats[] = {TN_FILE_SVG, TN_FILE_DXF, TN_FILE_CLI};
#define FORMAT_COUNT (sizeof formats / sizeof *formats)

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

/* Which format -o and --format mean; false (reported) where they mean none. */
static bool choose_format(tn_job *job, unsigned *format)
{
    const slice_settings *s = settings_of(job);
    *format = s->format ? (unsigned)s->format - 1 : FORMAT_COUNT;
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
    for (unsigned i = 0; i < FORMAT_COUNT && !s->format; i++)
        if (tn_file_format_of(s->output) == formats[i])
            *format = i;
    if (*format == FORMAT_COUNT && is_folder(s->output))
        *format = 0;
    if (*format < FORMAT_COUNT)
        return true;
    tn_help(tn_job_diagnostics(job), tn_job_usage(job, "%s does not say which file is to be written", s->output),
            "end its name in .svg, .dxf or .cli, or say --format");
    return false;
}

static void slice(tn_job *job, unsigned format)
{
    const slice_settings *s = settings_of(job);
    const tn_slice_request request = {
        .layer = s->layer.value,
        .format = format,
        .each = is_folder(s->output),
        .field = {.surface = s->surface,
                  .has_grid = s->grid.given,
                  .grid = s->grid.value,
                  .has_max_samples = s->max_samples.given,
                  .max_samples = s->max_samples.value,
                  .engine = (unsigned)s->engine,
                  .has_threads = s->threads.given,
                  .threads = s->threads.value},
        .solid = {.solid = s->solid, .has_max_boxes = s->max_boxes.given, .max_boxes = s->max_boxes.value}};
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &s->output, 1, request.each);
    tn_job_answered(job, tn_ask_slice(&job->session, &request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    unsigned format;
    tn_job_begin(&job, common);
    if (choose_format(&job, &format) && tn_job_open(&job, common->operands.items[0]))
        slice(&job, format);
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
