/* Writes what `tartan grow` made: meshes and pictures. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/made.h"
#include "cli/growth/grow.h"
#include "runtime/growth/surface.h"

static bool is_picture(tn_file_format format)
{
    return TN_WRITES_PICTURES >> format & 1;
}

/* Options that say something about some formats only: used with another one they would do nothing. */
static bool check_use(tn_job *job, tn_file_format format)
{
    enum { MESH = 1, SURFACE = 2, LINES = 4, NORMALS = 8, GROUPS = 16, AXIS = 32, PICTURE = 64 };
    static const unsigned can[TN_FILE_FORMATS + 1] = {
        [TN_FILE_OBJ] = MESH | SURFACE | LINES | NORMALS | GROUPS | AXIS,
        [TN_FILE_PLY] = MESH | SURFACE | LINES | NORMALS | GROUPS | AXIS,
        [TN_FILE_STL] = MESH | SURFACE | AXIS,
        [TN_FILE_OFF] = MESH | SURFACE | AXIS,
        [TN_FILE_OM] = MESH | SURFACE | AXIS,
        [TN_FILE_GLB] = MESH | SURFACE | NORMALS | GROUPS,
        [TN_FILE_DXF] = MESH | LINES | GROUPS | AXIS,
        [TN_FILE_SVG] = PICTURE,
        [TN_FILE_PNG] = PICTURE,
        [TN_FILE_PDF] = PICTURE,
    };
    const tn_grow_settings *s = tn_grow_settings_of(job);
    const struct {
        bool given;
        unsigned needs;
        const char *name, *help;
    } uses[] = {
        {s->subdivide.given, SURFACE, "subdivide", "write a surface: .obj, .ply, .stl, .off, .om or .glb"},
        {s->decimate.given, SURFACE, "decimate", "write a surface: .obj, .ply, .stl, .off, .om or .glb"},
        {s->smooth.given, MESH, "smooth", "write a mesh: .obj, .ply, .stl, .off, .om, .glb or .dxf"},
        {s->triangulate, SURFACE, "triangulate", "write a surface: .obj, .ply, .stl, .off, .om or .glb"},
        {s->lines, LINES, "lines", "only .obj, .ply and .dxf hold lines"},
        {s->normals, NORMALS, "normals", "only .obj, .ply and .glb hold normals of vertices"},
        {s->groups, GROUPS, "groups", "only .obj, .ply, .glb and .dxf hold groups"},
        {s->up != 0, AXIS, "up", "a .glb has y up always; a picture is turned with --azimuth and --elevation"},
        {s->azimuth.given, PICTURE, "azimuth", "write a picture: .svg, .png or .pdf"},
        {s->elevation.given, PICTURE, "elevation", "write a picture: .svg, .png or .pdf"},
        {s->width.given, PICTURE, "width", "write a picture: .svg, .png or .pdf"},
        {s->columns.given, PICTURE, "columns", "write a --sheet: .svg, .png or .pdf"},
        {s->dpi.given, PICTURE, "dpi", "write a picture: .png"},
        {s->surroundings != 0, PICTURE, "surroundings", "write a picture: .svg, .png or .pdf"},
        {s->turn.given, PICTURE, "turn", "name a folder, as -o turn, or one moving picture, as -o turn.png"},
        {s->title != NULL, PICTURE, "title", "write a picture: .svg, .png or .pdf"},
        {s->sheet, PICTURE, "sheet", "write a picture: .svg, .png or .pdf"},
        {s->overlay != NULL, PICTURE, "overlay", "write a picture: .svg, .png or .pdf"},
        {s->each_step, PICTURE | MESH, "each-step", "name one with -o"},
        {s->format != 0, PICTURE | MESH, "format", "name one with -o"},
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        if (!uses[i].given || (can[format] & uses[i].needs))
            continue;
        tn_diagnostic *d = tn_job_usage(
            job, s->output ? "--%s does nothing for this kind of file" : "--%s does nothing without a file",
            uses[i].name);
        tn_help(tn_job_diagnostics(job), d, "%s", s->output ? uses[i].help : "name one with -o");
        return false;
    }
    if ((s->subdivide.given || s->decimate.given) && (s->lines || s->groups)) {
        tn_diagnostic *d = tn_job_usage(job, "--subdivide and --decimate make new faces, which have no edges of the "
                                             "rules: --lines and --groups have nothing to show");
        tn_help(tn_job_diagnostics(job), d, "leave one or the other out");
        return false;
    }
    return true;
}

/* A turn is one picture from each side, as PNG. */
static bool check_turn(tn_job *job, tn_file_format format)
{
    const tn_grow_settings *s = tn_grow_settings_of(job);
    if (format != TN_FILE_PNG) {
        tn_diagnostic *d = tn_job_usage(job, "--turn writes PNG pictures, and %s is none", s->output);
        tn_help(tn_job_diagnostics(job), d, "name a folder, as -o turn, or one moving picture, as -o turn.png");
        return false;
    }
    if (s->sheet || s->overlay || s->each_step) {
        tn_job_usage(job, "--turn shows the last step: leave --sheet, --overlay and --each-step out");
        return false;
    }
    return check_use(job, format);
}

bool tn_grow_format_of(tn_job *job, tn_file_format *format)
{
    const tn_grow_settings *settings = tn_grow_settings_of(job);
    const char *path = settings->output;
    static const tn_file_format formats[] = {TN_FILE_OTHER, TN_FILE_OBJ, TN_FILE_PLY, TN_FILE_STL,
                                             TN_FILE_OFF,   TN_FILE_OM,  TN_FILE_GLB, TN_FILE_DXF,
                                             TN_FILE_SVG,   TN_FILE_PNG, TN_FILE_PDF};
    *format = formats[settings->format];
    if (!path)
        return check_use(job, TN_FILE_OTHER);
    if (*format == TN_FILE_OTHER)
        *format = tn_file_format_of(path);
    if (settings->turn.given && *format == TN_FILE_OTHER && strcmp(path, "-") != 0)
        return check_turn(job, TN_FILE_PNG);
    if (*format == TN_FILE_OTHER) {
        tn_diagnostic *d = tn_job_usage(job, "%s does not say what is to be written", path);
        tn_help(tn_job_diagnostics(job), d,
                "end its name in .obj, .ply, .stl, .off, .om, .glb, .dxf, .svg, .png or .pdf, or say --format");
        return false;
    }
    if (!check_use(job, *format) || (settings->turn.given && !check_turn(job, *format)))
        return false;
    if (strcmp(path, "-") == 0 && (settings->each_step || settings->stats)) {
        tn_job_usage(job, "standard output takes one thing only: name a file with -o");
        return false;
    }
    if (settings->overlay && (settings->sheet || settings->each_step)) {
        tn_job_usage(job, "--overlay draws one picture: leave --sheet and --each-step out");
        return false;
    }
    if (settings->sheet && settings->each_step) {
        tn_job_usage(job, "a --sheet has every step already: leave --each-step out");
        return false;
    }
    return true;
}

tn_camera tn_grow_camera(const tn_grow_settings *settings)
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

bool tn_grow_surrounded(const tn_grow_settings *settings, const tn_study *study)
{
    enum { AUTO, YES };
    bool any = study->environment.force_count > 0 || study->environment.boundary_count > 0;
    return settings->surroundings == YES || (settings->surroundings == AUTO && any);
}

/* One line on how it was made, the same wherever it is made. */
static void describe(const tn_job *job, const tn_growth *growth, char *text, size_t size)
{
    const tn_module *module = job->opened.module;
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    snprintf(text, size, "%.60s, step %u, seed %" PRIu64 ", rules %016" PRIx64 ", %.40s", tn_growth_rules(growth)->name,
             tn_growth_steps(growth), tn_growth_settings(growth)->seed, producer ? (uint64_t)producer->sources_hash : 0,
             producer ? tn_text(module, producer->version) : "tartan");
}

/* ---- meshes */

static void write_surface(tn_job *job, const tn_growth *growth, tn_file_format format, const char *path)
{
    const tn_grow_settings *settings = tn_grow_settings_of(job);
    bool dxf = format == TN_FILE_DXF;
    tn_mesh_changes changes = {(unsigned)settings->subdivide.value, (unsigned)settings->smooth.value,
                               (size_t)settings->decimate.value, settings->triangulate};
    tn_surface_options options = {
        .groups = settings->groups, .lines = settings->lines || dxf, .layers = dxf && !settings->groups};
    tn_mesh mesh;
    tn_output output;
    tn_error error;
    char note[240];
    describe(job, growth, note, sizeof note);
    tn_status status = tn_surface_mesh(growth, &options, &mesh, &error);
    if (status == TN_OK)
        status = tn_mesh_change(&job->opened, &changes, format, &mesh, &error);
    if (status == TN_OK && tn_job_output(job, path, &output)) {
        const char *notes = note;
        tn_mesh_style style = {
            .notes = &notes, .note_count = 1, .normals = settings->normals, .y_up = settings->up == 1};
        status = tn_mesh_file_write(&mesh, format, &style, output.stream, &error);
        if (status == TN_OK)
            tn_job_commit(job, &output);
        else
            tn_output_discard(&output);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_mesh_clear(&mesh);
}

/* ---- pictures */

static tn_picture picture_to(const char *path, tn_file_format format)
{
    return (tn_picture){.path = path, .format = tn_picture_asked(format).format};
}

static void note_depth(tn_job *job, const tn_view *view)
{
    if (tn_view_by_depth(view) > 0)
        tn_job_note(job, "%u faces pass through one another so often that they are drawn by their depth alone",
                    tn_view_by_depth(view));
}

void tn_grow_sheet(tn_job *job, const tn_growth *growth, const tn_study *study, tn_view *const *views, size_t count,
                   tn_file_format format)
{
    char caption[240];
    tn_error error;
    describe(job, growth, caption, sizeof caption);
    const tn_grow_settings *settings = tn_grow_settings_of(job);
    for (size_t i = 0; i < count; i++)
        note_depth(job, views[i]);
    tn_view_options options = {.title = settings->title ? settings->title : study->title,
                               .caption = caption,
                               .columns = (uint32_t)settings->columns.value,
                               .scaled = true,
                               .fades = true,
                               .dpi = (uint32_t)settings->dpi.value,
                               .legend = tn_growth_legend(tn_growth_rules(growth))};
    tn_picture to = picture_to(settings->output, format);
    if (count && tn_views_draw(views, count, &options, &to, &error) != TN_OK)
        tn_job_fail(job, &error);
}

static void write_sight(tn_job *job, const tn_growth *growth, const tn_study *study, tn_sight *sight,
                        tn_file_format format, const char *path)
{
    tn_camera camera = tn_grow_camera(tn_grow_settings_of(job));
    tn_view *view = NULL;
    tn_error error;
    char caption[240];
    describe(job, growth, caption, sizeof caption);
    tn_view_options options = {.title =
                                   tn_grow_settings_of(job)->title ? tn_grow_settings_of(job)->title : study->title,
                               .caption = caption,
                               .scaled = true,
                               .fades = true,
                               .dpi = (uint32_t)tn_grow_settings_of(job)->dpi.value,
                               .legend = tn_growth_legend(tn_growth_rules(growth))};
    tn_picture to = picture_to(path, format);
    tn_status status =
        tn_grow_surrounded(tn_grow_settings_of(job), study) ? tn_growth_sight_surround(growth, sight, &error) : TN_OK;
    if (status == TN_OK)
        status = tn_view_take(sight, &camera, &view, &error);
    if (status == TN_OK)
        note_depth(job, view);
    if (status == TN_OK)
        status = tn_views_draw(&view, 1, &options, &to, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_view_free(view);
}

void tn_grow_overlay(tn_job *job, const tn_growth *growth, const tn_study *study, tn_sight *sight,
                     tn_file_format format)
{
    write_sight(job, growth, study, sight, format, tn_grow_settings_of(job)->output);
}

static void write_picture(tn_job *job, const tn_growth *growth, const tn_study *study, tn_file_format format,
                          const char *path)
{
    tn_sight sight = {0};
    tn_error error;
    if (tn_growth_sight_add(growth, &sight, &error) == TN_OK)
        write_sight(job, growth, study, &sight, format, path);
    else
        tn_job_fail(job, &error);
    tn_sight_clear(&sight);
}

void tn_grow_write(tn_job *job, const tn_growth *growth, const tn_study *study, tn_file_format format, const char *path)
{
    if (is_picture(format))
        write_picture(job, growth, study, format, path);
    else
        write_surface(job, growth, format, path);
}
