/* draw: a surface, meshed and shaded, or a design of boxes. */
#include <stdlib.h>

#include "ask/form/draw.h"
#include "ask/form/form.h"
#include "driver/field/field.h"
#include "driver/solid/solid.h"
#include "runtime/field/field.h"
#include "runtime/scene/draw_mesh.h"

tn_file_format tn_draw_format(const tn_draw_request *request)
{
    static const tn_file_format formats[] = {TN_FILE_SVG, TN_FILE_PNG, TN_FILE_PDF, TN_FILE_DXF};
    return formats[request->format];
}

tn_status tn_draw_give(tn_session *session, const tn_draw_request *request, tn_picture *drawn, tn_status status,
                       tn_error *error, tn_drawn_picture *made)
{
    return tn_picture_give(session, tn_draw_format(request), drawn, status, error, (tn_list *)&made->files);
}

static tn_camera camera_of(const tn_draw_request *request)
{
    tn_camera camera = tn_camera_default();
    if (request->has_azimuth)
        camera.azimuth = request->azimuth;
    if (request->has_elevation)
        camera.elevation = request->elevation;
    if (request->has_width)
        camera.width = (double)request->width;
    return camera;
}

/* ---- fields */

/* The doc text of a surface, or its name. */
static const char *title_of(const tn_field *field)
{
    return tn_text(field->module, field->record->doc ? field->record->doc : field->record->name);
}

static tn_status draw_mesh(tn_session *session, const tn_draw_request *request, const tn_open_field *open,
                           const tn_contour *contour, tn_picture *to, tn_error *error)
{
    double *normals = NULL;
    char note[TN_FORM_NOTE_SIZE];
    tn_status status = tn_field_normals(&open->field, &contour->mesh, contour->spacing, &normals, error);
    tn_form_note(session->opened, open->field.record->name, note);
    const tn_mesh_picture picture = {.camera = camera_of(request),
                                     .title = request->title ? request->title : title_of(&open->field),
                                     .caption = note,
                                     .normals = normals,
                                     .open = request->open,
                                     .dpi = (uint32_t)request->dpi,
                                     .threads = (int)request->subject.threads,
                                     .watch = session->opened->module->watch};
    if (status == TN_OK)
        status = tn_mesh_draw(&contour->mesh, &picture, to, error);
    free(normals);
    return status;
}

static tn_status draw_surface(tn_session *session, const tn_draw_request *request, const tn_open_field *open,
                              tn_picture *to, tn_error *error)
{
    const tn_contour_options options = {
        .threads = (unsigned)request->subject.threads, .sharp = request->sharp, .open = request->open, .between = true};
    tn_field_grid grid = tn_field_grid_of(&open->field, (uint32_t)request->grid);
    tn_contour contour;
    tn_status status = tn_contour_new(&open->field, &grid, &options, &contour, error);
    if (status == TN_OK) {
        tn_field_warn_of_contour(session->opened, &contour, "there the mesh is a wall between samples");
        status = draw_mesh(session, request, open, &contour, to, error);
    }
    tn_contour_clear(&contour);
    return status;
}

static tn_status draw_field(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    tn_open_field open = {0};
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_error error;
    tn_status status = tn_open_field_of(session->opened, request->surface, &open, &error);
    if (status == TN_OK)
        status = draw_surface(session, request, &open, &to, &error);
    tn_open_field_close(&open);
    return tn_draw_give(session, request, &to, status, &error, made);
}

/* ---- designs of boxes */

static tn_status draw_solid(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    static const tn_solid_views views[] = {[TN_DRAW_VIEW] = TN_SOLID_VIEW,
                                           [TN_DRAW_SHEET] = TN_SOLID_SHEET,
                                           [TN_DRAW_BEFORE] = TN_SOLID_BEFORE,
                                           [TN_DRAW_EXPLODED] = TN_SOLID_EXPLODED,
                                           [TN_DRAW_HISTORY] = TN_SOLID_HISTORY};
    const tn_solid_drawing drawing = {.views = views[request->show],
                                      .camera = camera_of(request),
                                      .title = request->title,
                                      .columns = (uint32_t)request->columns,
                                      .dpi = (uint32_t)request->dpi,
                                      .most = (uint32_t)request->solid.max_boxes};
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_error error;
    uint32_t solid;
    to.dpi = drawing.dpi;
    tn_status status = tn_solid_choose(session->opened, request->solid.solid, &solid);
    if (status == TN_OK)
        status = tn_solid_draw(session->opened, solid, &drawing, &to);
    return status == TN_OK ? tn_draw_give(session, request, &to, status, &error, made) : status;
}

tn_status tn_draw_form(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    return session->opened->module->SOLID_count ? draw_solid(session, request, made)
                                                : draw_field(session, request, made);
}
