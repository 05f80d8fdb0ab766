/* tartan mesh: meshes a design of boxes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/common/option_rows.h"
#include "cli/solid/solid.h"
#include "runtime/geometry/union.h"
#include "runtime/geometry/write.h"
#include "runtime/mesh/openmesh.h"

typedef struct mesh_settings {
    tn_settings common;
    const char *output, *solid;
    bool cells;
    int up, stats;
} mesh_settings;

static const mesh_settings *settings_of(const tn_job *job)
{
    return (const mesh_settings *)job->settings;
}

typedef enum mesh_format {
    MESH_OBJ,
    MESH_PLY,
    MESH_STL,
    MESH_OFF,
    MESH_OM,
    MESH_GLB,
    MESH_SCAD,
    MESH_FORMATS
} mesh_format;

static bool format_of(tn_job *job, mesh_format *format)
{
    static const char *const words[MESH_FORMATS] = {"obj", "ply", "stl", "off", "om", "glb", "scad"};
    const char *path = settings_of(job)->output, *dot = path ? strrchr(path, '.') : NULL;
    if (!path)
        return true;
    for (int f = 0; dot && f < MESH_FORMATS; f++) {
        if (strcasecmp(dot + 1, words[f]) != 0)
            continue;
        *format = (mesh_format)f;
        return true;
    }
    tn_diagnostic *d = tn_job_usage(job, "%s does not say what is to be written", path);
    tn_help(tn_job_diagnostics(job), d, "end its name in .obj, .ply, .stl, .off, .om, .glb or .scad");
    return false;
}

/* ---- files */

/* y is up in designs, and z in files: (x, y, z) becomes (x, -z, y). */
static void turn_up(tn_mesh *mesh)
{
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double *p = mesh->positions + 3 * v, y = p[1];
        p[1] = -p[2];
        p[2] = y;
    }
}

/* A union of polyhedra, one for each group of faces. OpenSCAD wants faces clockwise from outside. */
static void write_scad(const tn_mesh *mesh, const char *note, bool y_up, FILE *out)
{
    fprintf(out, "// %s\nunion() {\n", note);
    for (size_t f = 0; f < mesh->face_count;) {
        uint32_t group = mesh->face_group[f];
        size_t last = f;
        uint32_t low = UINT32_MAX, high = 0;
        for (; last < mesh->face_count && mesh->face_group[last] == group; last++)
            for (uint32_t c = mesh->face_first[last]; c < mesh->face_first[last + 1]; c++) {
                low = mesh->corners[c] < low ? mesh->corners[c] : low;
                high = mesh->corners[c] > high ? mesh->corners[c] : high;
            }
        fprintf(out, "polyhedron(points = [");
        for (uint32_t v = low; v <= high; v++) {
            const double *p = mesh->positions + 3 * (size_t)v;
            fprintf(out, "%s[%.17g, %.17g, %.17g]", v > low ? ", " : "", p[0], y_up ? p[2] : p[1], y_up ? -p[1] : p[2]);
        }
        fprintf(out, "], faces = [");
        for (size_t face = f; face < last; face++) {
            fprintf(out, "%s[", face > f ? ", " : "");
            for (uint32_t c = mesh->face_first[face + 1]; c-- > mesh->face_first[face];)
                fprintf(out, "%u%s", mesh->corners[c] - low, c > mesh->face_first[face] ? ", " : "");
            fputc(']', out);
        }
        fprintf(out, "]); // %s\n", mesh->group_names[group]);
        f = last;
    }
    fputs("}\n", out);
}

static tn_status write_by_openmesh(const tn_mesh *mesh, mesh_format format, bool y_up, FILE *out, tn_error *error)
{
    unsigned char *bytes = NULL;
    size_t size;
    tn_openmesh_format kind = format == MESH_OFF   ? TN_OPENMESH_OFF
                              : format == MESH_STL ? TN_OPENMESH_STL
                                                   : TN_OPENMESH_OM;
    tn_status status = tn_openmesh_write(mesh, kind, y_up, &bytes, &size, error);
    if (status == TN_OK)
        fwrite(bytes, 1, size, out); /* failing shows when the output is committed */
    free(bytes);
    return status;
}

static tn_status write_mesh(const tn_job *job, const tn_mesh *mesh, mesh_format format, const char *note, FILE *out,
                            tn_error *error)
{
    const tn_mesh_style style = {.notes = &note, .note_count = 1, .y_up = settings_of(job)->up == 1};
    switch (format) {
    case MESH_OBJ:
        return tn_mesh_write_obj(mesh, &style, out, error);
    case MESH_PLY:
        return tn_mesh_write_ply(mesh, &style, out, error);
    case MESH_GLB:
        return tn_mesh_write_glb(mesh, &style, out, error);
    case MESH_SCAD:
        write_scad(mesh, note, style.y_up, out);
        return TN_OK;
    default:
        return write_by_openmesh(mesh, format, style.y_up, out, error);
    }
}

/* One line on how it was made. */
static void describe(const tn_job *job, uint32_t solid, char *text, size_t size)
{
    const tn_module *module = job->opened.module;
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    snprintf(text, size, "%.60s, design %016llx, %.40s", tn_text(module, module->SOLID_records[solid].name),
             producer ? (unsigned long long)producer->sources_hash : 0,
             producer ? tn_text(module, producer->version) : "tartan");
}

/* ---- meshes */

static tn_status name_groups(const tn_job *job, uint32_t solid, const tn_built *built, tn_mesh *mesh, tn_error *error)
{
    uint32_t n = built->built.box_count;
    mesh->group_names = calloc(built->cell_count + 1, sizeof *mesh->group_names);
    if (!mesh->group_names)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < built->cell_count; i++) {
        tn_box_words words = tn_box_named(job->opened.module, solid, i % n, tn_design_image(&built->built, i / n));
        snprintf(mesh->group_names[i], sizeof mesh->group_names[i], "%.23s", words.text);
    }
    return TN_OK;
}

/* The union without groups, or each cell by itself with its name. */
static tn_status make_mesh(const tn_job *job, uint32_t solid, const tn_built *built, bool cells, tn_union *u,
                           tn_error *error)
{
    if (!cells) {
        tn_status status = tn_union_make(built->cells, built->cell_count, u, error);
        free(u->mesh.face_group);
        u->mesh.face_group = NULL;
        u->mesh.group_count = 0;
        return status;
    }
    *u = (tn_union){0};
    tn_status status = tn_union_cells(built->cells, built->cell_count, &u->mesh, error);
    return status == TN_OK ? name_groups(job, solid, built, &u->mesh, error) : status;
}

static void write_stats(tn_job *job, const tn_built *built, const tn_union *u)
{
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    uint64_t asked = UINT64_C(1) << TN_SOLID_AREA_MEASURED | UINT64_C(1) << TN_SOLID_PARTS_MEASURED;
    tn_error error;
    tn_output output;
    if (tn_built_measure(built, asked, values, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    if (!tn_job_output(job, NULL, &output))
        return;
    double volume = values[TN_SOLID_VOLUME_MEASURED], area = values[TN_SOLID_AREA_MEASURED],
           parts = values[TN_SOLID_PARTS_MEASURED];
    if (settings_of(job)->stats == 2)
        fprintf(output.stream,
                "{\"vertices\":%zu,\"faces\":%zu,\"doubled\":%zu,\"boxes\":%zu,\"parts\":%.0f,\"volume\":%.17g,"
                "\"area\":%.17g}\n",
                u->mesh.vertex_count, u->mesh.face_count, u->doubled, built->cell_count, parts, volume, area);
    else
        fprintf(output.stream,
                "vertices  %zu\nfaces     %zu\ndoubled   %zu\nboxes     %zu\nparts     %.0f\nvolume    %.10g\narea     "
                " %.10g\n",
                u->mesh.vertex_count, u->mesh.face_count, u->doubled, built->cell_count, parts, volume, area);
    tn_job_commit(job, &output);
}

static void write_file(tn_job *job, uint32_t solid, tn_mesh *mesh, mesh_format format)
{
    char note[200];
    tn_output output;
    tn_error error = {0};
    tn_status status = format == MESH_GLB || format == MESH_STL ? tn_mesh_triangulate(mesh, &error) : TN_OK;
    if (status == TN_OK && !tn_job_output(job, settings_of(job)->output, &output))
        return;
    if (status == TN_OK) {
        describe(job, solid, note, sizeof note);
        turn_up(mesh);
        status = write_mesh(job, mesh, format, note, output.stream, &error);
        if (status == TN_OK)
            tn_job_commit(job, &output);
        else
            tn_output_discard(&output);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
}

static void mesh_solid(tn_job *job)
{
    const mesh_settings *settings = settings_of(job);
    mesh_format format = MESH_OBJ;
    tn_built built = {0};
    tn_union u = {0};
    tn_error error;
    uint32_t solid;
    if (!format_of(job, &format))
        return;
    if (!settings->output && !settings->stats) {
        tn_job_usage(job, "there is nothing to do: name a file with -o, or ask for --stats");
        return;
    }
    tn_status status = tn_solid_choose(&job->opened, settings->solid, &solid);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    status = tn_built_make(job->opened.module, solid, &built, &error);
    if (status == TN_OK)
        status = make_mesh(job, solid, &built, settings->cells || format == MESH_SCAD, &u, &error);
    if (status != TN_OK)
        tn_job_status(job, tn_solid_fail(&job->opened, solid, &error));
    if (status == TN_OK && settings->stats)
        write_stats(job, &built, &u);
    if (status == TN_OK && settings->output)
        write_file(job, solid, &u.mesh, format);
    tn_union_clear(&u);
    tn_built_clear(&built);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_job_begin(&job, settings);
    if (!tn_job_open(&job, settings->operands.items[0]))
        return tn_job_end(&job);
    if (job.opened.module->SOLID_count) {
        mesh_solid(&job);
    } else {
        tn_error error;
        tn_fail(&error, TN_INVALID, E_UNKNOWN_SOLID, "%.200s has no design of boxes", job.opened.path);
        tn_error_help(&error, "%s", tn_opened_help(&job.opened, "designs are .solid files").text);
        tn_job_fail(&job, &error);
    }
    return tn_job_end(&job);
}

#define SETTINGS mesh_settings
static const tn_option options[] = {
    OPTION_OUTPUT,
    TEXT("solid", 0, "NAME", solid, "which design of the file; may be left out where the file has only one"),
    FLAG("cells", 0, cells, "each box closed by itself, as a group with its name, instead of one surface of all"),
    CHOICE("up", 0, "AXIS", up, "z|y", "which axis is up in the file: z (the default), or y, as the design has it"),
    MAYBE("stats", 0, "FORMAT", stats, "text|json", "print counts, volume and area"),
    OPTION_WERROR,
};

const tn_command tn_command_mesh = {
    .name = "mesh",
    .summary = "mesh a design of boxes",
    .usage = "FILE [--solid NAME] [-o MESH] [--cells] [--up AXIS] [--stats]",
    .description =
        "Squashes boxes that overlap, clips them, and writes the surface of what is built. It is closed and each edge "
        "has two triangles; boxes that touch along an edge or at a corner only come apart. The end of the file's "
        "name says what is written: .obj, .ply, .stl, .off, .om, .glb, or .scad, which is a union of polyhedra for "
        "OpenSCAD. Designs have y up; files have z up, unless --up y. A .glb always has y up.",
    .example = "$ tartan mesh table.solid -o table.obj --stats",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
