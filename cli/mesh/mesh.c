/* tartan mesh: meshes a surface of a .field file, or a design of boxes of a .solid file. */
#include "cli/mesh/mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/form/form.h"
#include "cli/common/option_rows.h"
#include "runtime/field/normals.h"
#include "runtime/field/volume.h"
#include "runtime/geometry/crossing.h"

/* ---- writing */

/* The formats of --format's words. */
static const tn_out_format formats[] = {TN_OUT_NONE, TN_OUT_OBJ, TN_OUT_PLY,  TN_OUT_STL, TN_OUT_OFF,
                                        TN_OUT_OM,   TN_OUT_GLB, TN_OUT_SCAD, TN_OUT_3MF, TN_OUT_DXF};
#define FORMAT_WORDS "auto|obj|ply|stl|off|om|glb|scad|3mf|dxf"

static tn_out_format format_of(const tn_mesh_settings *s)
{
    tn_out_format named = s->format ? formats[s->format] : tn_out_format_of(s->output);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (formats[i] == named)
            return named;
    return TN_OUT_NONE;
}

static bool check_format(tn_job *job, tn_out_format *format)
{
    const tn_mesh_settings *s = tn_mesh_settings_of(job);
    *format = TN_OUT_NONE;
    if (s->thickness && (s->open || s->jumps == 1)) {
        tn_diagnostic *d = tn_job_usage(job, "--thickness is of a closed mesh");
        tn_help(tn_job_diagnostics(job), d, "leave out --%s", s->open ? "open" : "jumps open");
        return false;
    }
    if (!s->output)
        return true;
    *format = format_of(s);
    bool normals = *format == TN_OUT_OBJ || *format == TN_OUT_PLY || *format == TN_OUT_GLB;
    if ((s->normals && !normals) || (s->up && (*format == TN_OUT_GLB || *format == TN_OUT_3MF))) {
        tn_diagnostic *d =
            tn_job_usage(job, "--%s does nothing for this kind of file", s->normals && !normals ? "normals" : "up");
        tn_help(tn_job_diagnostics(job), d,
                s->normals && !normals  ? "only .obj, .ply and .glb hold normals of vertices"
                : *format == TN_OUT_GLB ? "a .glb has y up always"
                                        : "a .3mf has z up always");
        return false;
    }
    if (s->exact && *format != TN_OUT_STL) {
        tn_diagnostic *d = tn_job_usage(job, "--exact does nothing for this kind of file");
        tn_help(tn_job_diagnostics(job), d, "only an .stl tells vertices by their places");
        return false;
    }
    if (strcmp(s->output, "-") == 0 && (s->stats || s->bounds || s->thickness || s->times)) {
        tn_job_usage(job, "standard output takes one thing only: name a file with -o");
        return false;
    }
    return true;
}

/* Options that say something about fields only, or about designs of boxes only. */
static bool check_use(tn_job *job)
{
    const tn_mesh_settings *s = tn_mesh_settings_of(job);
    const tn_asked_use uses[] = {
        {s->surface != NULL, TN_OF_FIELDS, "surface"},
        {s->grid.given, TN_OF_FIELDS, "grid"},
        {s->points != NULL, TN_OF_FIELDS, "points"},
        {s->open, TN_OF_FIELDS, "open"},
        {s->bounds, TN_OF_FIELDS, "bounds"},
        {s->thickness, TN_OF_FIELDS, "thickness"},
        {s->jumps != 0, TN_OF_FIELDS, "jumps"},
        {s->sharp, TN_OF_FIELDS, "sharp"},
        {s->times, TN_OF_FIELDS, "times"},
        {s->engine != 0, TN_OF_FIELDS, "engine"},
        {s->max_samples.given, TN_OF_FIELDS, "max-samples"},
        {s->max_triangles.given, TN_OF_FIELDS, "max-triangles"},
        {s->threads.given, TN_OF_FIELDS, "threads"},
        {s->solid != NULL, TN_OF_SOLIDS, "solid"},
        {s->cells, TN_OF_SOLIDS, "cells"},
        {s->exact, TN_OF_SOLIDS, "exact"},
        {s->max_boxes.given, TN_OF_SOLIDS, "max-boxes"},
    };
    bool neither =
        tn_subject_of(job->opened.module) == TN_SUBJECT_PLANS; /* what is missing is said where it is looked for */
    return neither || tn_job_answered(job, tn_session_check_uses(&job->session, uses, sizeof uses / sizeof *uses));
}

void tn_mesh_write(tn_job *job, tn_mesh *mesh, const tn_mesh_file *file)
{
    const tn_mesh_settings *s = tn_mesh_settings_of(job);
    tn_mesh_style style = {
        .notes = &file->note, .note_count = 1, .normals = s->normals, .y_up = s->up == 1, .unit = file->unit};
    double *normals = NULL;
    tn_output output;
    tn_error error;
    tn_status status = TN_OK;
    if (s->normals && file->field)
        status = tn_field_normals(file->field, mesh, file->spacing, &normals, &error);
    style.vertex_normals = normals;
    if (status == TN_OK && tn_job_output(job, s->output, &output)) {
        status = tn_out_mesh(mesh, file->format, &style, output.stream, &error);
        if (status == TN_OK)
            tn_job_commit(job, &output);
        else
            tn_output_discard(&output);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    free(normals);
}

/* What is worked out only where it is asked for. */
typedef struct asked_stats {
    double proven[2], thickness[2];
    uint64_t crossings;
} asked_stats;

static void write_stats(const tn_job *job, const tn_open_field *open, const tn_contour *c, const tn_mesh_measures *m,
                        const asked_stats *asked)
{
    static const char *const units[TN_UNIT_COUNT] = {"", "mm", "cm", "m", "in", "ft"};
    const tn_mesh_settings *s = tn_mesh_settings_of(job);
    tn_mesh_stats stats = {.what = "surface",
                           .name = tn_text(open->field.module, open->field.record->name),
                           .unit = units[open->field.record->unit],
                           .mesh = &c->mesh,
                           .measures = m,
                           .closed = !s->open && s->jumps != 1,
                           .counts = {{"jumps", c->jumps, false},
                                      {"moved", c->moved, false},
                                      {"no_values", c->no_values, true},
                                      {"sharp", c->sharp, false},
                                      {"crossings", asked->crossings, false}},
                           .count_count = s->sharp ? 5 : 3,
                           .proven = s->bounds ? asked->proven : NULL,
                           .seconds = s->times ? c->seconds : NULL,
                           .thickness = s->thickness ? asked->thickness : NULL};
    tn_mesh_stats_write(stdout, s->stats == 2, &stats);
}

static void warn_of_specks(tn_job *job, const tn_mesh_measures *m)
{
    if (m->small_parts)
        tn_field_warn(&job->opened, W_FIELD_COARSE, "take a finer --grid to see what they are",
                      "%u of %u parts are smaller than two cells; the first is at (%.6g, %.6g, %.6g)", m->small_parts,
                      m->parts, m->small_part[0], m->small_part[1], m->small_part[2]);
}

/* Warns of parts that the grid is too coarse for, then reworks the mesh as the options say: what is measured, is what
 * is written. */
static tn_status finish_mesh(tn_job *job, tn_out_format format, tn_contour *contour, tn_mesh_measures *measures,
                             tn_error *error)
{
    const tn_out_changes *changes = &tn_mesh_settings_of(job)->changes;
    tn_status status = tn_mesh_measure(&contour->mesh, 2 * contour->spacing, measures, error);
    if (status != TN_OK)
        return status;
    warn_of_specks(job, measures);
    if (!changes->subdivide.given && !changes->smooth.given && !changes->decimate.given)
        return TN_OK;
    status = tn_out_rework(job, changes, format, &contour->mesh, error);
    return status == TN_OK ? tn_mesh_measure(&contour->mesh, 0, measures, error) : status;
}

static void warn_of_crossings(tn_job *job, uint64_t crossings)
{
    if (crossings)
        tn_field_warn(&job->opened, W_FIELD_CROSSING,
                      "take a finer --grid, or leave out --sharp: then no triangles cross",
                      "%" PRIu64 " pairs of triangles cross", crossings);
}

static tn_status prove_volume(const tn_open_field *open, const tn_field_grid *grid, double proven[2], tn_error *error)
{
    tn_field_volume volume;
    tn_status status = tn_field_volume_bounds(&open->field, grid, &volume, error);
    proven[0] = status == TN_OK ? volume.low : 0;
    proven[1] = status == TN_OK ? volume.high : 0;
    return status;
}

static tn_status measure_walls(const tn_mesh *mesh, double thickness[2], tn_error *error)
{
    tn_thickness walls;
    tn_status status = tn_mesh_thickness(mesh, &walls, error);
    thickness[0] = walls.least;
    thickness[1] = walls.hundredth;
    return status;
}

static tn_status mesh_field(tn_job *job, const tn_open_field *open, tn_out_format format, tn_error *error)
{
    const tn_mesh_settings *s = tn_mesh_settings_of(job);
    tn_contour_options options = {.threads = (unsigned)s->threads.value,
                                  .interpret = s->engine == 1,
                                  .open = s->open,
                                  .jumps_open = s->jumps == 1,
                                  .sharp = s->sharp,
                                  .between = true,
                                  .samples = s->max_samples.value,
                                  .triangles = s->max_triangles.value};
    tn_field_grid grid = tn_field_grid_of(&open->field, (uint32_t)s->grid.value);
    tn_contour contour;
    tn_mesh_measures measures;
    asked_stats asked = {0};
    options.every_sample = options.interpret;
    tn_status status = tn_contour_new(&open->field, &grid, &options, &contour, error);
    if (status == TN_OK) {
        tn_field_warn_of_contour(&job->opened, &contour,
                                 "there the mesh is a wall between samples; --jumps open leaves it out");
        status = finish_mesh(job, format, &contour, &measures, error);
    }
    if (status == TN_OK && s->bounds)
        status = prove_volume(open, &grid, asked.proven, error);
    if (status == TN_OK && s->sharp)
        status = tn_mesh_crossings(&contour.mesh, &asked.crossings, error);
    if (status == TN_OK && s->thickness)
        status = measure_walls(&contour.mesh, asked.thickness, error);
    if (status == TN_OK) {
        warn_of_crossings(job, asked.crossings);
        if (s->stats || s->bounds || s->thickness || s->times || !s->output)
            write_stats(job, open, &contour, &measures, &asked);
        if (s->output) {
            char note[TN_FORM_NOTE_SIZE];
            tn_form_note(&job->opened, open->field.record->name, note);
            tn_mesh_file file = {format, note, (tn_mesh_unit)open->field.record->unit, &open->field, contour.spacing};
            tn_mesh_write(job, &contour.mesh, &file);
        }
    }
    tn_contour_clear(&contour);
    return status;
}

/* The surface, or --points. */
static void answer_field(tn_job *job, tn_out_format format)
{
    tn_open_field open = {0};
    tn_error error;
    tn_status status = tn_open_field_of(&job->opened, tn_mesh_settings_of(job)->surface, &open, &error);
    if (status == TN_OK && tn_mesh_settings_of(job)->points)
        tn_mesh_points(job, &open);
    else if (status == TN_OK)
        status = mesh_field(job, &open, format, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_open_field_close(&open);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_out_format format;
    tn_job_begin(&job, common);
    if (check_format(&job, &format) && tn_job_open(&job, common->operands.items[0]) && check_use(&job)) {
        if (job.opened.module->SOLID_count)
            tn_job_mesh_solid(&job, format);
        else
            answer_field(&job, format);
    }
    return tn_job_end(&job);
}

#define SETTINGS tn_mesh_settings

static const tn_option options[] = {
    OUTPUT(output,
           TN_WRITES(OBJ) | TN_WRITES(PLY) | TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) | TN_WRITES(GLB) |
               TN_WRITES(3MF) | TN_WRITES(SCAD) | TN_WRITES(DXF),
           "the mesh: .obj, .ply, .stl, .off, .om, .glb, .3mf, .scad or .dxf; - is standard output"),
    CHOICE("format", 'f', "FORMAT", format, FORMAT_WORDS, "what is written, where the name of FILE does not say it"),
    TEXT("surface", 's', "NAME", surface, "which surface of the file (default: the last)"),
    TEXT("solid", 0, "NAME", solid, "which design of the file; may be left out where the file has only one"),
    FLAG("cells", 0, cells,
         "of a design of boxes: each box closed by itself, as a group with its name, instead of one surface of all"),
    FLAG("exact", 0, exact,
         "of a design of boxes as .stl: leave vertices where they are, though some share a place; otherwise these move "
         "into their own boxes by 0.00001 of the diagonal"),
    NUMBER("grid", 'n', "N", grid, 2, 8192,
           "samples on the longest side of the box (default: what the file says, or 50)"),
    MAYBE("stats", 0, "[table|json]", stats, "table|json", "write what the mesh measures to standard output"),
    TEXT("points", 0, "FILE", points,
         "instead of meshing, write for each line x y z of FILE: the field, its gradient, and whether it is inside"),
    FLAG("thickness", 0, thickness,
         "print how thick the walls are, straight inward: the least, and that of which a hundredth of the surface is "
         "thinner"),
    FLAG("times", 0, times, "print also how long samples, vertices and triangles took"),
    FLAG("bounds", 0, bounds, "print two numbers that the volume of the form is proven to lie between"),
    FLAG("open", 0, open, "end the mesh at the box instead of closing it there"),
    CHOICE("jumps", 0, "KIND", jumps, "closed|open",
           "where the field jumps: closed (the default) makes a wall, open leaves it out"),
    FLAG(
        "sharp", 0, sharp,
        "make edges and corners of the form sharp, by points that lie on no edge of the grid; a few triangles may then "
        "cross, and are counted"),
    FLAG("normals", 0, normals, "write normals of the vertices (OBJ, PLY, GLB)"),
    CHOICE("up", 0, "AXIS", up, "z|y",
           "which axis points up in the file (default z; GLB is always y, 3MF always z; designs of boxes are written "
           "with y up)"),
    NUMBER("subdivide", 0, "N", changes.subdivide, 1, 8, "subdivide the finished mesh N times (Loop)"),
    NUMBER("smooth", 0, "N", changes.smooth, 1, 10000, "smooth the finished mesh N times (Laplace; the outline stays)"),
    NUMBER("decimate", 0, "FACES", changes.decimate, 1, UINT32_MAX,
           "reduce the finished mesh to about FACES triangles, or to as few as do not fold"),
    NUMBER("max-samples", 0, "N", max_samples, 8, 1ull << 36, "the most samples of a grid (default 2000000000)"),
    NUMBER("max-triangles", 0, "N", max_triangles, 1, UINT32_MAX / 3,
           "the most triangles of a mesh (default 100000000)"),
    OPTION_MAX_BOXES(max_boxes),
    CHOICE("engine", 0, "ENGINE", engine, "tape|vm",
           "tape (the default) evaluates rows of samples and skips what is proven; vm interprets the code at every "
           "sample: the same mesh, more slowly"),
    OPTION_THREADS(threads),
    OPTION_WERROR,
};

const tn_command tn_command_mesh = {
    .name = "mesh",
    .summary = "mesh an implicit surface or a design of boxes",
    .usage = "FILE.field [--surface NAME] [--grid N] -o FILE.obj\nFILE.field --points FILE\n"
             "FILE.solid [--solid NAME] [--cells] -o FILE.obj\nFILE --stats",
    .description =
        "Meshes the boundary of what is inside a surface: where its expression is below 0. The mesh is closed, its "
        "triangles are counter-clockwise seen from outside, each edge has two of them, and none cross. What reaches "
        "the box is closed there. Without -o the mesh is measured. The same input gives the same bytes at any number "
        "of threads.\n"
        "Of a design of boxes (.solid), boxes that overlap are squashed and clipped first, and the mesh is the closed "
        "surface of them all. Boxes that touch only along an edge or at a corner come apart. As .scad, each box is a "
        "polyhedron of a union for OpenSCAD.",
    .example = "$ tartan mesh pebble.field -o pebble.obj\n"
               "$ tartan mesh primitives --surface torus --grid 100 --stats\n"
               "$ echo '1 0 0' | tartan mesh pebble.field --points -\n"
               "$ tartan mesh table.solid -o table.obj",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer samples with --grid",
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
