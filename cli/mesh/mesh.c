/* tartan mesh: meshes a surface of a .field file, or a design of boxes of a .solid file. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ask/form/mesh.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"

/* ---- evaluates a field at the places that the lines of a file name */

/* Three numbers and nothing else. The program's locale is C's. */
static bool read_place(const char *line, double place[3])
{
    for (int axis = 0; axis < 3; axis++) {
        char *end;
        line += strspn(line, " \t,");
        place[axis] = strtod(line, &end);
        if (end == line)
            return false;
        line = end;
    }
    return line[strspn(line, " \t\r\n")] == '\0';
}

static void write_lines(tn_job *job, const tn_probe *probe, const char *path, FILE *in)
{
    char line[1000];
    double place[3], gradient[3];
    tn_file_state before = tn_file_state_of(fileno(in));
    tn_error error;
    for (size_t number = 1; fgets(line, sizeof line, in); number++) {
        if (tn_interrupt_check(&error) != TN_OK) {
            tn_job_fail(job, &error);
            return;
        }
        if (line[strspn(line, " \t\r\n")] == '\0')
            continue;
        if (!read_place(line, place)) {
            if (tn_file_state_same(&before, fileno(in), path, &error) == TN_OK) {
                tn_fail(&error, TN_INVALID, E_EXPRESSION, "line %zu of %.200s is not three numbers", number, path);
                tn_error_help(&error, "write x, y and z with blanks between them");
            }
            tn_job_fail(job, &error);
            return;
        }
        double value = tn_probe_at(probe, place, gradient);
        printf("%.17g %.17g %.17g %.17g %s\n", tn_without_sign(value), tn_without_sign(gradient[0]),
               tn_without_sign(gradient[1]), tn_without_sign(gradient[2]), value < 0 ? "inside" : "outside");
    }
    if (ferror(in)) {
        tn_cannot_read(path, errno, &error);
        tn_job_fail(job, &error);
    } else if (tn_file_state_same(&before, fileno(in), path, &error) != TN_OK) {
        tn_job_fail(job, &error);
    }
}

/* Writes the field, its gradient and whether it is inside for each line of a file, or (-) of standard input. */
static void mesh_write_points(tn_job *job, const tn_mesh_request *request, const char *path)
{
    tn_probe probe;
    bool standard = strcmp(path, "-") == 0;
    if (tn_job_answered(job, tn_probe_open(&job->session, request, &probe))) {
        FILE *in = standard ? stdin : tn_file_stream(path);
        tn_error error;
        if (in) {
            write_lines(job, &probe, path, in);
        } else {
            tn_cannot_read(path, errno, &error);
            tn_job_fail(job, &error);
        }
        if (in && !standard)
            fclose(in);
    }
    tn_probe_close(&probe);
}

/* ---- writes what a mesh measures as a table */

static double largest(const tn_space_point *p, double most)
{
    return fmax(fmax(most, fabs(p->x)), fmax(fabs(p->y), fabs(p->z)));
}

/* What only rounding left, beside numbers as large as `scale`, is written as 0. */
static double shown(double number, double scale)
{
    return fabs(number) < 1e-12 * scale ? 0 : number;
}

static void write_triple(FILE *out, const char *word, const tn_space_point *p, double scale)
{
    fprintf(out, "%s %.6g %.6g %.6g\n", word, shown(p->x, scale), shown(p->y, scale), shown(p->z, scale));
}

static void write_count(FILE *out, const char *word, bool given, uint64_t count)
{
    if (given)
        fprintf(out, "%-9s  %" PRIu64 "\n", word, count);
}

/* Of a closed mesh. */
static void write_moments(FILE *out, const tn_measured_mesh *m)
{
    const tn_space_tensor *i = &m->inertia;
    double scale = largest(&i->xs, largest(&i->ys, largest(&i->zs, 0)));
    write_triple(out, "centroid  ", &m->centroid, largest(&m->bounds.low, largest(&m->bounds.high, 0)));
    write_triple(out, "inertia   ", &i->xs, scale);
    write_triple(out, "          ", &i->ys, scale);
    write_triple(out, "          ", &i->zs, scale);
}

/* What a mesh measures, as a table. */
static void mesh_table(const tn_measured_mesh *m, FILE *out)
{
    const char *unit = m->unit, *space = *unit ? " " : "", *square = *unit ? "^2" : "", *cube = *unit ? "^3" : "";
    const tn_space_point *low = &m->bounds.low, *high = &m->bounds.high;
    fprintf(out, "%-9s  %s\n", m->has_solid ? "solid" : "surface", m->has_solid ? m->solid : m->surface);
    write_count(out, "vertices", true, m->vertices);
    write_count(out, "triangles", true, m->triangles);
    write_count(out, "parts", true, m->parts);
    if (m->has_volume)
        fprintf(out, "Euler      %" PRId64 "\nvolume     %.12g%s%s%s\n", m->euler, m->volume, space, unit, cube);
    if (m->has_volume_bounds)
        fprintf(out, "proven     %.12g to %.12g%s%s%s\n", m->volume_bounds.least, m->volume_bounds.most, space, unit,
                cube);
    if (m->has_thickness)
        fprintf(out, "thickness  at least %.6g%s%s; 99 %% of the wall at least %.6g%s%s\n", m->thickness.least, space,
                unit, m->thickness.hundredth, space, unit);
    fprintf(out, "area       %.12g%s%s%s\n", m->area, space, unit, square);
    if (m->has_centroid)
        write_moments(out, m);
    fprintf(out, "bounds     %.6g %.6g %.6g to %.6g %.6g %.6g\n", low->x, low->y, low->z, high->x, high->y, high->z);
    write_count(out, "jumps", m->has_jumps, m->jumps);
    write_count(out, "moved", m->has_moved, m->moved);
    write_count(out, "sharp", m->has_sharp, m->sharp);
    write_count(out, "crossings", m->has_crossings, m->crossings);
    write_count(out, "boxes", m->has_boxes, m->boxes);
    write_count(out, "doubled", m->has_doubled, m->doubled);
    if (m->has_seconds)
        fprintf(out, "seconds    samples %.3f, vertices %.3f, triangles %.3f\n", m->seconds.samples,
                m->seconds.vertices, m->seconds.triangles);
}

typedef struct mesh_settings {
    tn_settings common;
    const char *output, *surface, *solid, *points;
    int format; /* auto, then as the words of the request's; what a file's name ends in is taken for it */
    int engine; /* 0 tape, 1 vm */
    int stats;  /* 0 not asked for, 1 table, 2 json */
    int up;     /* 0 z, 1 y */
    int jumps;  /* 0 closed, 1 open */
    bool open, normals, cells, exact, bounds, thickness, sharp, times;
    tn_option_number subdivide, smooth, decimate;
    tn_option_number grid, max_samples, max_triangles, max_boxes, threads;
} mesh_settings;

static const mesh_settings *settings_of(const tn_job *job)
{
    return (const mesh_settings *)job->settings;
}

static tn_mesh_request request_of(const mesh_settings *s)
{
    return (tn_mesh_request){
        .format = s->output ? (unsigned)s->format : 0,
        .stats = s->stats != 0,
        .field = {.surface = s->surface,
                  .has_grid = s->grid.given,
                  .grid = s->grid.value,
                  .has_max_samples = s->max_samples.given,
                  .max_samples = s->max_samples.value,
                  .engine = (unsigned)s->engine,
                  .has_threads = s->threads.given,
                  .threads = s->threads.value},
        .has_max_triangles = s->max_triangles.given,
        .max_triangles = s->max_triangles.value,
        .open = s->open,
        .jumps = (unsigned)s->jumps,
        .sharp = s->sharp,
        .bounds = s->bounds,
        .thickness = s->thickness,
        .times = s->times,
        .has_points = s->points != NULL,
        .solid = {.solid = s->solid, .has_max_boxes = s->max_boxes.given, .max_boxes = s->max_boxes.value},
        .cells = s->cells,
        .exact = s->exact,
        .rework = {.has_subdivide = s->subdivide.given,
                   .subdivide = s->subdivide.value,
                   .has_smooth = s->smooth.given,
                   .smooth = s->smooth.value,
                   .has_decimate = s->decimate.given,
                   .decimate = s->decimate.value},
        .normals = s->normals,
        .up = (unsigned)s->up,
    };
}

static bool check_options(tn_job *job, const tn_mesh_request *request)
{
    const mesh_settings *s = settings_of(job);
    if (!tn_job_answered(job, tn_mesh_request_fits(&job->session, request)))
        return false;
    if (s->output && strcmp(s->output, "-") == 0 && (s->stats || s->bounds || s->thickness || s->times)) {
        tn_job_usage(job, "standard output takes one thing only: name a file with -o");
        return false;
    }
    return true;
}

/* What was measured is shown before the file is made. */
static void show(void *context, const tn_reply *answer)
{
    tn_job *job = context;
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (settings_of(job)->stats == 2)
        tn_job_write_json(answer, output.stream);
    else
        mesh_table(TN_REPLY(measured_mesh, answer), output.stream);
    tn_job_commit(job, &output);
}

static void mesh(tn_job *job, const tn_mesh_request *request)
{
    const mesh_settings *s = settings_of(job);
    tn_made_outputs outputs;
    tn_reply answer;
    job->session.so_far = show;
    job->session.so_far_context = job;
    tn_job_files(job, &outputs, &s->output, 1, false);
    tn_job_answered(job, tn_ask_mesh(&job->session, request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, common);
    const mesh_settings *s = settings_of(&job);
    const tn_mesh_request request = request_of(s);
    if (check_options(&job, &request) && tn_job_open(&job, common->operands.items[0])) {
        if (s->points)
            mesh_write_points(&job, &request, s->points);
        else
            mesh(&job, &request);
    }
    return tn_job_end(&job);
}

#define SETTINGS mesh_settings

static const tn_option options[] = {
    OUTPUT(output,
           TN_WRITES(OBJ) | TN_WRITES(PLY) | TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) | TN_WRITES(GLB) |
               TN_WRITES(3MF) | TN_WRITES(SCAD) | TN_WRITES(DXF),
           "the mesh: .obj, .ply, .stl, .off, .om, .glb, .3mf, .scad or .dxf; - is standard output"),
    CHOICE("format", 'f', "FORMAT", format, "auto|obj|ply|stl|off|om|glb|scad|3mf|dxf",
           "what is written, where the name of FILE does not say it"),
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
    NUMBER("subdivide", 0, "N", subdivide, 1, 8, "subdivide the finished mesh N times (Loop)"),
    NUMBER("smooth", 0, "N", smooth, 1, 10000, "smooth the finished mesh N times (Laplace; the outline stays)"),
    NUMBER("decimate", 0, "FACES", decimate, 1, UINT32_MAX,
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
