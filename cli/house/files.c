/* Writes a house to files: its line, tables, models and drawings. */
#include "cli/house/files.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "runtime/geometry/write.h"
#include "runtime/house/export/export.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/describe.h"

typedef enum tn_house_file {
    FILE_LINE,
    FILE_JSON,
    FILE_CSV,
    FILE_PARTS,
    FILE_OBJ,
    FILE_PLY,
    FILE_GLB,
    FILE_IFC,
    FILE_DXF,
    FILE_SVG,
    FILE_PDF,
    FILE_PNG,
    FILE_KINDS
} tn_house_file;
static const char *const endings[] = {NULL,   ".json", ".csv", ".parts.csv", ".obj", ".ply",
                                      ".glb", ".ifc",  ".dxf", ".svg",       ".pdf", ".png"};
#define ENDINGS ".json, .csv, .parts.csv, .obj, .ply, .glb, .ifc, .dxf, .svg, .pdf or .png"

/* A house on its way to files. */
typedef struct tn_house_writer {
    tn_job *job;
    const tn_house *house;
    const tn_solids *solids;
    const tn_house_outputs *outputs;
} tn_house_writer;

static bool is_folder(const char *path)
{
    struct stat known;
    size_t size = strlen(path);
    return (size > 1 && path[size - 1] == '/') || (stat(path, &known) == 0 && S_ISDIR(known.st_mode));
}

/* FILE_KINDS where the name says nothing. */
static tn_house_file file_kind(const char *path)
{
    size_t size = strlen(path);
    if (strcmp(path, "-") == 0)
        return FILE_LINE;
    for (int i = FILE_KINDS - 1; i > 0; i--) /* `.parts.csv` before `.csv` */
        if (size > strlen(endings[i]) && strcasecmp(path + size - strlen(endings[i]), endings[i]) == 0)
            return (tn_house_file)i;
    return FILE_KINDS;
}

/* An option that is only for drawings and was given; NULL where there is none. A title is for IFC, too. */
static const char *drawing_option(const tn_house_outputs *outputs)
{
    const struct {
        const char *name;
        bool given;
    } options[] = {{"view", outputs->views.count > 0},  {"cut", outputs->cut},
                   {"furnish", outputs->furnish == 1},  {"scale", outputs->scale.given},
                   {"azimuth", outputs->azimuth.given}, {"elevation", outputs->elevation.given},
                   {"dpi", outputs->dpi.given}};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (options[i].given)
            return options[i].name;
    return NULL;
}

static bool has_drawing(const tn_house_outputs *outputs)
{
    for (size_t i = 0; i < outputs->files.count; i++) {
        tn_house_file kind = file_kind(outputs->files.items[i]);
        if ((kind >= FILE_DXF && kind <= FILE_PNG) || is_folder(outputs->files.items[i]))
            return true;
    }
    return false;
}

bool tn_house_files_known(tn_job *job, const tn_house_outputs *outputs)
{
    bool known = true;
    for (size_t i = 0; i < outputs->files.count; i++) {
        const char *path = outputs->files.items[i];
        if (file_kind(path) != FILE_KINDS || is_folder(path))
            continue;
        tn_diagnostic *d = tn_job_usage(job, "the name of `%s` says no format that a house can be written in", path);
        tn_help(tn_job_diagnostics(job), d, "let it end in " ENDINGS ", or in / for all of them in a folder");
        known = false;
    }
    const char *option = drawing_option(outputs);
    if (!known || !option || has_drawing(outputs))
        return known;
    tn_diagnostic *d = tn_job_usage(job, "--%s is about drawings, and no file is one", option);
    tn_help(tn_job_diagnostics(job), d, "add `-o NAME.svg`, or .pdf, .png or .dxf");
    return false;
}

/* What a form says of itself. */
static const char *form_name(const tn_house *house)
{
    const tn_form_record *form = house->form->record;
    const char *doc = tn_text(house->form->module, form->doc);
    return doc[0] ? doc : tn_text(house->form->module, form->name);
}

/* What the house is called in files and on sheets. */
static const char *title_of(const tn_house_writer *w)
{
    if (w->outputs->title)
        return w->outputs->title;
    return w->outputs->name ? w->outputs->name : form_name(w->house);
}

/* Drawings as lines. TN_STOPPED: a view is wrong, which is recorded. */
static tn_status write_dxf(const tn_house_writer *w, FILE *out, tn_error *error)
{
    tn_aspect aspects[TN_HOUSE_VIEWS_MAX];
    size_t count = tn_house_views(w->job, w->house, w->outputs, aspects);
    return count ? tn_house_write_dxf(w->house, w->solids, aspects, count, out, error) : TN_STOPPED;
}

static tn_status write_mesh(const tn_house_writer *w, tn_house_file kind, FILE *out, tn_error *error)
{
    tn_mesh mesh;
    unsigned char colours[TN_HOUSE_GROUPS_MAX][3];
    tn_mesh_style style = {.unit = TN_MESH_UNIT_M, .colours = (const unsigned char(*)[3])colours};
    tn_house_mesh_colours(w->house->form, colours);
    tn_status status = tn_house_mesh(w->house, w->solids, &mesh, error);
    if (status == TN_OK)
        status = kind == FILE_OBJ   ? tn_mesh_write_obj(&mesh, &style, out, error)
                 : kind == FILE_PLY ? tn_mesh_write_ply(&mesh, &style, out, error)
                                    : tn_mesh_write_glb(&mesh, &style, out, error);
    tn_mesh_clear(&mesh);
    return status;
}

/* ---- drawings */

static void draw(const tn_house_writer *w, const char *path)
{
    tn_aspect aspects[TN_HOUSE_VIEWS_MAX];
    tn_buffer line = {0};
    tn_error error = {0};
    size_t count = tn_house_views(w->job, w->house, w->outputs, aspects);
    if (count == 0)
        return;
    tn_status status = tn_house_write(w->house, &line, &error);
    const char *notes[] = {line.data ? line.data : ""};
    tn_house_drawing drawing = {.aspects = aspects,
                                .count = count,
                                .title = title_of(w),
                                .notes = notes,
                                .note_count = count > 1,
                                .scale = (uint32_t)w->outputs->scale.value};
    tn_picture to = {.path = path, .dpi = (uint32_t)w->outputs->dpi.value};
    if (status == TN_OK)
        status = tn_house_draw(w->house, w->solids, &drawing, &to, &error);
    if (status != TN_OK)
        tn_job_fail(w->job, &error);
    free(line.data);
}

/* ---- files */

static tn_status write_text(const tn_house_writer *w, tn_house_file kind, FILE *out, tn_error *error)
{
    tn_buffer text = {0};
    tn_status status = kind == FILE_JSON    ? tn_house_describe(w->house, w->solids, &text, error)
                       : kind == FILE_CSV   ? tn_house_schedule(w->house, &text, error)
                       : kind == FILE_PARTS ? tn_house_parts(w->house, w->solids, &text, error)
                                            : tn_house_write(w->house, &text, error);
    if (status == TN_OK && kind == FILE_LINE)
        tn_buffer_append(&text, "\n", 1);
    if (status == TN_OK && text.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        fwrite(text.data, 1, text.size, out);
    free(text.data);
    return status;
}

static void write_file(const tn_house_writer *w, const char *path)
{
    tn_house_file kind = file_kind(path);
    tn_output output;
    tn_error error;
    if (kind == FILE_SVG || kind == FILE_PDF || kind == FILE_PNG) {
        draw(w, path);
        return;
    }
    if (!tn_job_output(w->job, path, &output))
        return;
    tn_status status = kind < FILE_OBJ    ? write_text(w, kind, output.stream, &error)
                       : kind < FILE_IFC  ? write_mesh(w, kind, output.stream, &error)
                       : kind == FILE_IFC ? tn_house_write_ifc(w->house, w->solids, title_of(w), output.stream, &error)
                                          : write_dxf(w, output.stream, &error);
    if (status != TN_OK && status != TN_STOPPED) /* a wrong view is said already */
        tn_job_fail(w->job, &error);
    tn_job_close(w->job, &output, status == TN_OK);
}

/* A file of every format, called house. */
static void write_folder(const tn_house_writer *w, const char *folder)
{
    char path[4096];
    tn_error error = {0};
    size_t size = strlen(folder);
    if (tn_folder_make(folder, &error) != TN_OK) {
        tn_job_fail(w->job, &error);
        return;
    }
    for (int i = 1; i < FILE_KINDS && w->job->exit_code == TN_EXIT_DONE; i++) {
        if ((size_t)snprintf(path, sizeof path, "%s%shouse%s", folder, folder[size - 1] == '/' ? "" : "/", endings[i]) <
            sizeof path)
            write_file(w, path);
    }
}

void tn_house_files_write(tn_job *job, const tn_house *house, const tn_house_outputs *outputs)
{
    tn_solids solids = {0};
    tn_error error;
    const tn_house_writer w = {job, house, &solids, outputs};
    tn_status status = tn_house_solids(house, &solids, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    for (size_t i = 0; status == TN_OK && i < outputs->files.count; i++) {
        const char *path = outputs->files.items[i];
        if (file_kind(path) == FILE_KINDS)
            write_folder(&w, path);
        else
            write_file(&w, path);
    }
    if (status == TN_OK && outputs->files.count == 0)
        write_file(&w, "-");
    tn_solids_clear(&solids);
}
