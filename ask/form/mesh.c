/* mesh: a surface or a design of boxes as a mesh, measured and as a file. */
#include "ask/form/mesh.h"

#include <inttypes.h>
#include <stdlib.h>

#include "ask/form/form.h"
#include "ask/session/made.h"
#include "runtime/field/field.h"
#include "runtime/geometry/crossing.h"
#include "runtime/geometry/measure.h"

const tn_file_format tn_mesh_formats[TN_MESH_FORMAT_COUNT] = {TN_FILE_OTHER, TN_FILE_OBJ, TN_FILE_PLY, TN_FILE_STL,
                                                              TN_FILE_OFF,   TN_FILE_OM,  TN_FILE_GLB, TN_FILE_SCAD,
                                                              TN_FILE_3MF,   TN_FILE_DXF};

/* ---- does it make sense? */

static tn_status refuse_for_file(tn_session *session, const char *name, const char *help)
{
    return tn_session_refuse(session, help, "--%s does nothing for this kind of file", name);
}

tn_status tn_mesh_request_fits(tn_session *session, const tn_mesh_request *r)
{
    tn_file_format format = tn_mesh_formats[r->format];
    bool holds_normals = format == TN_FILE_OBJ || format == TN_FILE_PLY || format == TN_FILE_GLB;
    if (r->thickness && (r->open || r->jumps))
        return tn_session_refuse(session, r->open ? "leave out --open" : "leave out --jumps open",
                                 "--thickness is of a closed mesh");
    if (r->format == 0)
        return TN_OK;
    if (r->has_points)
        return tn_session_refuse(session, "leave out -o", "--points evaluates the field, and makes no mesh");
    if (r->normals && !holds_normals)
        return refuse_for_file(session, "normals", "only .obj, .ply and .glb hold normals of vertices");
    if (r->up && format == TN_FILE_GLB)
        return refuse_for_file(session, "up", "a .glb has y up always");
    if (r->up && format == TN_FILE_3MF)
        return refuse_for_file(session, "up", "a .3mf has z up always");
    if (r->exact && format != TN_FILE_STL)
        return refuse_for_file(session, "exact", "only an .stl tells vertices by their places");
    return TN_OK;
}

/* Some members say something about fields only, others about designs of boxes only. */
static tn_status check_subject(tn_session *session, const tn_mesh_request *r)
{
    const tn_asked_use uses[] = {
        {r->field.surface != NULL, TN_OF_FIELDS, "surface"},
        {r->field.has_grid, TN_OF_FIELDS, "grid"},
        {r->has_points, TN_OF_FIELDS, "points"},
        {r->open, TN_OF_FIELDS, "open"},
        {r->bounds, TN_OF_FIELDS, "bounds"},
        {r->thickness, TN_OF_FIELDS, "thickness"},
        {r->jumps != 0, TN_OF_FIELDS, "jumps"},
        {r->sharp, TN_OF_FIELDS, "sharp"},
        {r->times, TN_OF_FIELDS, "times"},
        {r->field.engine != 0, TN_OF_FIELDS, "engine"},
        {r->field.has_max_samples, TN_OF_FIELDS, "max-samples"},
        {r->has_max_triangles, TN_OF_FIELDS, "max-triangles"},
        {r->field.has_threads, TN_OF_FIELDS, "threads"},
        {r->solid.solid != NULL, TN_OF_SOLIDS, "solid"},
        {r->cells, TN_OF_SOLIDS, "cells"},
        {r->exact, TN_OF_SOLIDS, "exact"},
        {r->solid.has_max_boxes, TN_OF_SOLIDS, "max-boxes"},
    };
    bool neither =
        tn_subject_of(session->opened->module) == TN_SUBJECT_PLANS; /* what is missing is said where it is looked for */
    return neither ? TN_OK : tn_session_check_uses(session, uses, sizeof uses / sizeof *uses);
}

tn_status tn_mesh_request_check(tn_session *session, const tn_mesh_request *request)
{
    tn_status status = tn_mesh_request_fits(session, request);
    return status == TN_OK ? check_subject(session, request) : status;
}

tn_mesh_changes tn_rework_asked(const tn_mesh_rework *asked)
{
    return (tn_mesh_changes){.subdivide = (unsigned)asked->subdivide,
                             .smooth = (unsigned)asked->smooth,
                             .decimate = (size_t)asked->decimate};
}

/* ---- the answer */

static tn_space_point point_of(const double p[3])
{
    return (tn_space_point){p[0], p[1], p[2]};
}

static void set_measures(const tn_mesh_measures *measures, bool closed, tn_measured_mesh *to)
{
    to->parts = measures->parts;
    to->has_euler = to->has_volume = to->has_centroid = to->has_inertia = closed;
    to->euler = measures->euler;
    to->volume = measures->volume;
    to->area = measures->area;
    to->centroid = point_of(measures->centroid);
    to->inertia = (tn_space_tensor){point_of(measures->inertia[0]), point_of(measures->inertia[1]),
                                    point_of(measures->inertia[2])};
    to->bounds = (tn_space_box){point_of(measures->low), point_of(measures->high)};
}

tn_status tn_meshing_answer(const tn_meshing *m, const tn_mesh *mesh, const tn_mesh_measures *measures, bool closed,
                            tn_measured_mesh **measured, tn_error *error)
{
    tn_status status = tn_reply_new(m->measures ? &tn_message_measured_mesh : &tn_message_made_mesh, m->answer, error);
    *measured = status == TN_OK ? TN_REPLY(measured_mesh, m->answer) : NULL;
    if (*measured) {
        (*measured)->vertices = mesh->vertex_count;
        (*measured)->triangles = mesh->face_count;
        (*measured)->unit = "";
        set_measures(measures, closed, *measured);
    }
    return status;
}

static tn_status write_mesh(const tn_meshing *m, const tn_mesh *mesh, const tn_mesh_style *style, tn_error *error)
{
    tn_measured_mesh *measured = TN_REPLY(measured_mesh, m->answer);
    tn_made_mesh *made = TN_REPLY(made_mesh, m->answer);
    tn_list *files = measured ? (tn_list *)&measured->files : (tn_list *)&made->files;
    tn_made_file *file = tn_message_add(&tn_message_made_file, files, error);
    tn_making making;
    if (!file)
        return TN_MEMORY;
    tn_status status = tn_making_begin(&making, m->session, m->format, NULL, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, tn_mesh_file_write(mesh, m->format, style, making.stream, error), error);
    if (status == TN_OK && measured)
        measured->has_files = true;
    return status;
}

tn_status tn_meshing_finish(const tn_meshing *m, tn_mesh *mesh, const tn_meshed_form *form, tn_error *error)
{
    char text[TN_FORM_NOTE_SIZE];
    const char *note = text;
    double *normals = NULL;
    tn_made_mesh *made = TN_REPLY(made_mesh, m->answer);
    tn_status status = TN_OK;
    if (m->measures && m->session->so_far)
        m->session->so_far(m->session->so_far_context, m->answer);
    if (m->format == TN_FILE_OTHER)
        return TN_OK;
    if (made) {
        made->vertices = mesh->vertex_count;
        made->faces = mesh->face_count;
    }
    tn_form_note(m->session->opened, form->name, text);
    if (m->request->normals && form->field)
        status = tn_field_normals(form->field, mesh, form->spacing, &normals, error);
    if (status == TN_OK)
        status = write_mesh(m, mesh,
                            &(tn_mesh_style){.notes = &note,
                                             .note_count = 1,
                                             .normals = m->request->normals,
                                             .vertex_normals = normals,
                                             .y_up = m->request->up == 1,
                                             .unit = form->unit},
                            error);
    free(normals);
    return status;
}

/* ---- fields */

static void warn_of_specks(tn_session *session, const tn_mesh_measures *m)
{
    if (m->small_parts)
        tn_field_warn(session->opened, W_FIELD_COARSE, "take a finer --grid to see what they are",
                      "%u of %u parts are smaller than two cells; the first is at (%.6g, %.6g, %.6g)", m->small_parts,
                      m->parts, m->small_part[0], m->small_part[1], m->small_part[2]);
}

/* Warns of parts that the grid is too coarse for, then reworks the mesh as is asked: what is measured, is what is
 * written. */
static tn_status finish_contour(const tn_meshing *m, tn_contour *contour, tn_mesh_measures *measures, tn_error *error)
{
    const tn_mesh_changes changes = tn_rework_asked(&m->request->rework);
    tn_status status = tn_mesh_measure(&contour->mesh, 2 * contour->spacing, measures, error);
    if (status != TN_OK)
        return status;
    warn_of_specks(m->session, measures);
    if (!changes.subdivide && !changes.smooth && !changes.decimate)
        return TN_OK;
    status = tn_mesh_change(m->session->opened, &changes, m->format, &contour->mesh, error);
    return status == TN_OK ? tn_mesh_measure(&contour->mesh, 0, measures, error) : status;
}

/* What is worked out only if it is asked for. */
typedef struct asked_measures {
    tn_field_volume proven;
    tn_thickness walls;
    uint64_t crossings;
} asked_measures;

static tn_status measure_asked(const tn_meshing *m, const tn_field *field, const tn_field_grid *grid,
                               const tn_mesh *mesh, asked_measures *asked, tn_error *error)
{
    const tn_mesh_request *r = m->request;
    tn_status status = r->bounds ? tn_field_volume_bounds(field, grid, &asked->proven, error) : TN_OK;
    if (status == TN_OK && r->sharp)
        status = tn_mesh_crossings(mesh, &asked->crossings, error);
    if (status == TN_OK && r->thickness)
        status = tn_mesh_thickness(mesh, &asked->walls, error);
    if (status == TN_OK && asked->crossings)
        tn_field_warn(m->session->opened, W_FIELD_CROSSING,
                      "take a finer --grid, or leave out --sharp: then no triangles cross",
                      "%" PRIu64 " pairs of triangles cross", asked->crossings);
    return status;
}

static void set_field(const tn_mesh_request *r, const tn_field *field, const tn_contour *c, const asked_measures *asked,
                      tn_measured_mesh *to)
{
    static const char *const units[TN_UNIT_COUNT] = {"", "mm", "cm", "m", "in", "ft"};
    to->has_surface = true;
    to->surface = tn_text(field->module, field->record->name);
    to->unit = units[field->record->unit];
    to->has_volume_bounds = r->bounds;
    to->volume_bounds = (tn_number_span){asked->proven.low, asked->proven.high};
    to->has_thickness = r->thickness;
    to->thickness = (tn_wall_thickness){asked->walls.least, asked->walls.hundredth};
    to->has_jumps = to->has_moved = to->has_no_values = true;
    to->jumps = c->jumps;
    to->moved = c->moved;
    to->no_values = c->no_values;
    to->has_sharp = to->has_crossings = r->sharp;
    to->sharp = c->sharp;
    to->crossings = asked->crossings;
    to->has_seconds = r->times;
    to->seconds = (tn_mesh_seconds){c->seconds[0], c->seconds[1], c->seconds[2]};
}

static tn_status mesh_surface(const tn_meshing *m, const tn_open_field *open, tn_contour *contour, tn_error *error)
{
    const tn_mesh_request *r = m->request;
    const tn_field *field = &open->field;
    tn_contour_options options = tn_contour_asked(&r->field);
    tn_field_grid grid = tn_field_grid_of(field, (uint32_t)r->field.grid);
    tn_mesh_measures measures;
    asked_measures asked = {0};
    tn_measured_mesh *measured;
    options.open = r->open;
    options.jumps_open = r->jumps == 1;
    options.sharp = r->sharp;
    options.between = true;
    options.triangles = r->max_triangles;
    tn_status status = tn_contour_new(field, &grid, &options, contour, error);
    if (status != TN_OK)
        return status;
    tn_field_warn_of_contour(m->session->opened, contour,
                             "there the mesh is a wall between samples; --jumps open leaves it out");
    status = finish_contour(m, contour, &measures, error);
    if (status == TN_OK)
        status = measure_asked(m, field, &grid, &contour->mesh, &asked, error);
    if (status == TN_OK)
        status = tn_meshing_answer(m, &contour->mesh, &measures, !r->open && !options.jumps_open, &measured, error);
    if (status == TN_OK && measured)
        set_field(r, field, contour, &asked, measured);
    const tn_meshed_form form = {.name = field->record->name,
                                 .unit = (tn_mesh_unit)field->record->unit,
                                 .field = field,
                                 .spacing = contour->spacing};
    return status == TN_OK ? tn_meshing_finish(m, &contour->mesh, &form, error) : status;
}

static tn_status mesh_field(const tn_meshing *m)
{
    tn_open_field open = {0};
    tn_contour contour = {0};
    tn_error error;
    tn_status status = tn_open_field_of(m->session->opened, m->request->field.surface, &open, &error);
    if (status == TN_OK)
        status = mesh_surface(m, &open, &contour, &error);
    tn_contour_clear(&contour);
    tn_open_field_close(&open);
    return status == TN_OK ? TN_OK : tn_session_fail(m->session, &error);
}

/* ---- asked */

tn_status tn_ask_mesh(tn_session *session, const tn_mesh_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    tn_status status =
        request->has_points ? tn_mesh_points(session, request, answer) : tn_mesh_request_check(session, request);
    if (request->has_points || status != TN_OK)
        return status;
    const tn_meshing m = {.session = session,
                          .request = request,
                          .format = tn_mesh_formats[request->format],
                          .measures = request->stats || request->bounds || request->thickness || request->times ||
                                      request->format == 0,
                          .answer = answer};
    return session->opened->module->SOLID_count ? tn_mesh_solid(&m) : mesh_field(&m);
}
