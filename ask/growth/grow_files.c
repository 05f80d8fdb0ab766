/* The files of a surface that grows: meshes and pictures. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "ask/growth/grow.h"
#include "ask/session/made.h"
#include "driver/mesh/mesh_file.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/surface.h"
#include "runtime/scene/apng.h"

enum { NOTE_SIZE = 240 };

/* One line on how it was made, the same wherever it is made. */
static void describe(const tn_growing *g, char text[NOTE_SIZE])
{
    const tn_module *module = g->session->opened->module;
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    snprintf(text, NOTE_SIZE, "%.60s, step %u, seed %" PRIu64 ", rules %016" PRIx64 ", %.40s",
             tn_growth_rules(g->growth)->name, tn_growth_steps(g->growth), tn_growth_settings(g->growth)->seed,
             producer ? (uint64_t)producer->sources_hash : 0, producer ? tn_text(module, producer->version) : "tartan");
}

/* ---- meshes */

static tn_status write_mesh(const tn_growing *g, const tn_mesh *mesh, const char *name, tn_error *error)
{
    char text[NOTE_SIZE];
    const char *note = text;
    tn_making making;
    tn_made_file *file = TN_ADD(made_file, g->grown->files, error);
    if (!file)
        return TN_MEMORY;
    describe(g, text);
    const tn_mesh_style style = {
        .notes = &note, .note_count = 1, .normals = g->request->normals, .y_up = g->request->up == 1};
    tn_status status = tn_making_begin(&making, g->session, g->format, name, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, tn_mesh_file_write(mesh, g->format, &style, making.stream, error), error);
    return status;
}

static tn_status write_surface(const tn_growing *g, const char *name, tn_error *error)
{
    const tn_grow_request *r = g->request;
    bool dxf = g->format == TN_FILE_DXF;
    const tn_mesh_changes changes = {.subdivide = (unsigned)r->rework.subdivide,
                                     .smooth = (unsigned)r->rework.smooth,
                                     .decimate = (size_t)r->rework.decimate,
                                     .triangulate = r->triangulate};
    const tn_surface_options options = {.groups = r->groups, .lines = r->lines || dxf, .layers = dxf && !r->groups};
    tn_mesh mesh;
    tn_status status = tn_surface_mesh(g->growth, &options, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_change(g->session->opened, &changes, g->format, &mesh, error);
    if (status == TN_OK)
        status = write_mesh(g, &mesh, name, error);
    tn_mesh_clear(&mesh);
    return status;
}

/* ---- pictures */

tn_camera tn_grown_camera(const tn_growing *g)
{
    const tn_grow_picture *asked = &g->request->picture;
    tn_camera camera = tn_camera_default();
    if (asked->has_azimuth)
        camera.azimuth = asked->azimuth;
    if (asked->has_elevation)
        camera.elevation = asked->elevation;
    if (asked->has_width)
        camera.width = (double)asked->width;
    return camera;
}

bool tn_grown_surrounded(const tn_growing *g)
{
    enum { AUTO, YES };
    const tn_environment *environment = &g->shown->study.environment;
    unsigned asked = g->request->picture.surroundings;
    bool any = environment->force_count > 0 || environment->boundary_count > 0;
    return asked == YES || (asked == AUTO && any);
}

/* caption: or NULL */
static tn_view_options view_options(const tn_growing *g, const char *caption)
{
    const tn_grow_picture *asked = &g->request->picture;
    return (tn_view_options){.title = asked->title ? asked->title : g->shown->study.title,
                             .caption = caption,
                             .scaled = true,
                             .fades = true,
                             .dpi = (uint32_t)asked->dpi,
                             .legend = tn_growth_legend(tn_growth_rules(g->growth))};
}

static void note_depth(const tn_growing *g, const tn_view *view)
{
    if (tn_view_by_depth(view) > 0)
        tn_session_note(g->session,
                        "%u faces pass through one another so often that they are drawn by their depth alone",
                        tn_view_by_depth(view));
}

static tn_status draw_views(const tn_growing *g, tn_view *const *views, size_t count, const tn_view_options *options,
                            const char *name, tn_error *error)
{
    tn_picture picture = tn_picture_asked(g->format);
    tn_made_file *file = TN_ADD(made_file, g->grown->files, error);
    if (!file)
        return TN_MEMORY;
    tn_status status = tn_views_draw(views, count, options, &picture, error);
    if (status == TN_OK)
        return tn_made_picture(g->session, &picture, g->format, name, file, error);
    free(picture.element);
    return status;
}

tn_status tn_grown_sheet(const tn_growing *g, tn_view *const *views, size_t count, tn_error *error)
{
    char caption[NOTE_SIZE];
    describe(g, caption);
    tn_view_options options = view_options(g, caption);
    options.columns = (uint32_t)g->request->picture.columns;
    for (size_t i = 0; i < count; i++)
        note_depth(g, views[i]);
    return count ? draw_views(g, views, count, &options, NULL, error) : TN_OK;
}

static tn_status draw_display(const tn_growing *g, tn_display_list *display, const char *name, tn_error *error)
{
    const tn_camera camera = tn_grown_camera(g);
    char caption[NOTE_SIZE];
    tn_view *view = NULL;
    describe(g, caption);
    const tn_view_options options = view_options(g, caption);
    tn_status status = tn_grown_surrounded(g) ? tn_growth_display_surround(g->growth, display, error) : TN_OK;
    if (status == TN_OK)
        status = tn_view_take(display, &camera, &view, error);
    if (status == TN_OK) {
        note_depth(g, view);
        status = draw_views(g, &view, 1, &options, name, error);
    }
    tn_view_free(view);
    return status;
}

tn_status tn_grown_overlay(const tn_growing *g, tn_display_list *display, tn_error *error)
{
    return draw_display(g, display, NULL, error);
}

tn_status tn_grown_write(const tn_growing *g, const char *name, tn_error *error)
{
    tn_display_list display = {0};
    if (!(TN_WRITES_PICTURES >> g->format & 1))
        return write_surface(g, name, error);
    tn_status status = tn_growth_display_add(g->growth, &display, error);
    if (status == TN_OK)
        status = draw_display(g, &display, name, error);
    tn_display_list_clear(&display);
    return status;
}

/* ---- from all around */

enum { TURN_TIME = 4000, SLOWEST = 1000 }; /* thousandths of a second: a whole turn, and the longest for one picture */

static tn_status take_view(const tn_growing *g, const tn_camera *camera, tn_view **view, tn_error *error)
{
    tn_display_list display = {0};
    tn_status status = tn_growth_display_add(g->growth, &display, error);
    if (status == TN_OK && tn_grown_surrounded(g))
        status = tn_growth_display_surround(g->growth, &display, error);
    display.turns = true;
    if (status == TN_OK)
        status = tn_view_take(&display, camera, view, error);
    tn_display_list_clear(&display);
    return status;
}

static tn_status take_frame(const tn_growing *g, uint64_t frame, tn_view **view, tn_error *error)
{
    tn_camera camera = tn_grown_camera(g);
    camera.azimuth += 360.0 * (double)frame / (double)g->request->turn;
    return take_view(g, &camera, view, error);
}

static tn_status draw_each(const tn_growing *g, tn_error *error)
{
    const tn_view_options options = view_options(g, NULL);
    tn_status status = TN_OK;
    for (uint64_t i = 0; i < g->request->turn && status == TN_OK; i++) {
        char name[40];
        tn_view *view = NULL;
        snprintf(name, sizeof name, "turn-%03u.png", (unsigned)i);
        status = take_frame(g, i, &view, error);
        if (status == TN_OK)
            status = draw_views(g, &view, 1, &options, name, error);
        tn_view_free(view);
    }
    return status;
}

static tn_status write_moving(const tn_growing *g, const tn_picture *frames, size_t count, tn_error *error)
{
    unsigned delay = TURN_TIME / (unsigned)count;
    tn_making making;
    tn_made_file *file = TN_ADD(made_file, g->grown->files, error);
    if (!file)
        return TN_MEMORY;
    tn_status status = tn_making_begin(&making, g->session, g->format, NULL, file, error);
    if (status == TN_OK)
        status = tn_making_end(
            &making, tn_apng_write(frames, count, delay < SLOWEST ? delay : SLOWEST, making.stream, error), error);
    return status;
}

static tn_status draw_moving(const tn_growing *g, tn_error *error)
{
    const tn_view_options options = view_options(g, NULL);
    size_t count = (size_t)g->request->turn;
    tn_picture *frames = calloc(count, sizeof *frames);
    tn_status status = frames ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        tn_view *view = NULL;
        frames[i] = tn_picture_asked(g->format);
        status = take_frame(g, i, &view, error);
        if (status == TN_OK)
            status = tn_views_draw(&view, 1, &options, &frames[i], error);
        tn_view_free(view);
    }
    if (status == TN_OK)
        status = write_moving(g, frames, count, error);
    for (size_t i = 0; i < count && frames; i++)
        free(frames[i].element);
    free(frames);
    return status;
}

tn_status tn_grown_turn(const tn_growing *g, tn_error *error)
{
    return g->request->moving ? draw_moving(g, error) : draw_each(g, error);
}
