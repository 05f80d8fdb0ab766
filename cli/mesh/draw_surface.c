/* Draws a surface: a mesh of it, seen from where the options say. */
#include "cli/mesh/draw_surface.h"

#include "cli/mesh/mesh.h"
#include "runtime/geometry/picture/draw_mesh.h"

bool tn_job_has_surface(const tn_job *job)
{
    return job->opened.module->SURFACE_count > 0;
}

static tn_camera camera_of(const tn_surface_settings *settings)
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

/* The doc text of a surface, or its name. */
static const char *title_of(const tn_field *field)
{
    return tn_text(field->module, field->record->doc ? field->record->doc : field->record->name);
}

void tn_job_draw_surface(tn_job *job, const tn_surface_settings *settings, const char *title, uint32_t dpi,
                         unsigned threads, const char *output)
{
    tn_open_field open = {0};
    tn_contour contour = {0};
    tn_error error;
    char note[240];
    tn_status status = tn_open_field_of(job, settings->surface, &open, &error);
    if (status == TN_OK) {
        tn_contour_options options = {.threads = threads};
        tn_field_grid grid = tn_field_grid_of(&open.field, (uint32_t)settings->grid.value);
        status = tn_contour_new(&open.field, &grid, &options, &contour, &error);
    }
    if (status == TN_OK) {
        tn_job_warn_of_contour(job, &contour, "there the mesh is a wall between samples");
        tn_job_show(job);
        tn_mesh_note(job, open.field.record->name, note, sizeof note);
        tn_mesh_picture picture = {.camera = camera_of(settings),
                                   .title = title ? title : title_of(&open.field),
                                   .caption = note,
                                   .dpi = dpi,
                                   .threads = (int)threads,
                                   .watch = job->opened.module->watch};
        status = tn_mesh_draw(&contour.mesh, &picture, &(tn_picture){.path = output}, &error);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_contour_clear(&contour);
    tn_open_field_close(&open);
}
