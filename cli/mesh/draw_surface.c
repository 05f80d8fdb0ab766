/* Draws a surface: a mesh of it, seen from where the options say. */
#include "cli/mesh/draw_surface.h"

#include <stdlib.h>

#include "cli/mesh/mesh.h"
#include "runtime/field/normals.h"

/* The doc text of a surface, or its name. */
static const char *title_of(const tn_field *field)
{
    return tn_text(field->module, field->record->doc ? field->record->doc : field->record->name);
}

void tn_job_draw_surface(tn_job *job, const tn_drawn_surface *surface, const tn_mesh_picture *picture,
                         const char *output)
{
    tn_open_field open = {0};
    tn_contour contour = {0};
    tn_error error;
    double *normals = NULL;
    char note[TN_FORM_NOTE_SIZE];
    tn_status status = tn_open_field_of(&job->opened, surface->name, &open, &error);
    if (status == TN_OK) {
        tn_contour_options options = {
            .threads = (unsigned)picture->threads, .sharp = surface->sharp, .open = surface->open, .between = true};
        tn_field_grid samples = tn_field_grid_of(&open.field, surface->grid);
        status = tn_contour_new(&open.field, &samples, &options, &contour, &error);
    }
    if (status == TN_OK)
        status = tn_field_normals(&open.field, &contour.mesh, contour.spacing, &normals, &error);
    if (status == TN_OK) {
        tn_mesh_picture whole = *picture;
        tn_field_warn_of_contour(&job->opened, &contour, "there the mesh is a wall between samples");
        tn_job_show(job);
        tn_form_note(&job->opened, open.field.record->name, note);
        whole.title = picture->title ? picture->title : title_of(&open.field);
        whole.caption = note;
        whole.normals = normals;
        whole.open = surface->open;
        whole.watch = job->opened.module->watch;
        status = tn_mesh_draw(&contour.mesh, &whole, &(tn_picture){.path = output}, &error);
    }
    if (status != TN_OK)
        tn_job_fail(job, &error);
    free(normals);
    tn_contour_clear(&contour);
    tn_open_field_close(&open);
}
