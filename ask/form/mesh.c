/* mesh: a surface or a design of boxes as a mesh, measured and as a file. */
#include "ask/form/mesh.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "ask/form/form.h"
#include "ask/session/made.h"
#include "driver/solid/solid.h"
#include "runtime/base/bytes.h"
#include "runtime/field/field.h"
#include "runtime/geometry/crossing.h"
#include "runtime/geometry/measure.h"
#include "runtime/geometry/union/union.h"

static tn_status mesh_request_check(tn_session *session, const tn_mesh_request *request);
static tn_status mesh_solid(const tn_meshing *m);

/* ---- mesh, asked for places */

tn_status tn_probe_open(tn_session *session, const tn_mesh_request *request, tn_probe *probe)
{
    tn_error error;
    *probe = (tn_probe){0};
    tn_status status = mesh_request_check(session, request);
    if (status != TN_OK)
        return status;
    status = tn_open_field_of(session->opened, request->field.surface, &probe->open, &error);
    if (status == TN_OK) {
        probe->registers = calloc((size_t)probe->open.field.samples.register_count * 4 + 1, sizeof *probe->registers);
        status = probe->registers ? TN_OK : tn_fail_memory(&error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

void tn_probe_close(tn_probe *probe)
{
    free(probe->registers);
    tn_open_field_close(&probe->open);
    *probe = (tn_probe){0};
}

double tn_probe_at(const tn_probe *probe, const double place[3], double gradient[3])
{
    const tn_field *field = &probe->open.field;
    return tn_tape_gradient(&field->samples, place, &field->distances, probe->registers, gradient);
}

static void set_point(const tn_probe *probe, const tn_space_point *at, tn_valued_point *to)
{
    const double place[3] = {at->x, at->y, at->z};
    double gradient[3];
    to->value = tn_probe_at(probe, place, gradient);
    to->has_value = isfinite(to->value);
    to->has_gradient = isfinite(gradient[0]) && isfinite(gradient[1]) && isfinite(gradient[2]);
    to->gradient =
        (tn_space_point){tn_without_sign(gradient[0]), tn_without_sign(gradient[1]), tn_without_sign(gradient[2])};
    to->inside = to->value < 0;
    to->value = tn_without_sign(to->value);
}

static tn_status set_points(const tn_probe *probe, const tn_mesh_request *request, tn_reply *answer, tn_error *error)
{
    const tn_field *field = &probe->open.field;
    tn_status status = tn_reply_new(&tn_message_valued_points, answer, error);
    tn_valued_points *points = answer->value;
    if (status == TN_OK)
        status = TN_NEW_LIST(valued_point, points->points, request->points.count, error);
    if (status != TN_OK)
        return status;
    points->surface = tn_text(field->module, field->record->name);
    for (size_t i = 0; i < request->points.count && status == TN_OK; i++) {
        if (tn_watch_stopped_at(field->module->watch, i))
            status = tn_fail_stopped(field->module->watch, error);
        else
            set_point(probe, &request->points.items[i], &points->points.items[i]);
    }
    return status;
}

/* The answer for mesh_request.points. */
static tn_status mesh_points(tn_session *session, const tn_mesh_request *request, tn_reply *answer)
{
    tn_probe probe;
    tn_error error;
    tn_status status = tn_probe_open(session, request, &probe);
    if (status == TN_OK) {
        status = set_points(&probe, request, answer, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_probe_close(&probe);
    return status;
}

/* ---- mesh */

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

/* And for the file that is open? */
static tn_status mesh_request_check(tn_session *session, const tn_mesh_request *request)
{
    tn_status status = tn_mesh_request_fits(session, request);
    return status == TN_OK ? check_subject(session, request) : status;
}

/* What is done to the mesh when it is finished. */
static tn_mesh_changes rework_asked(const tn_mesh_rework *asked)
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

/* Begins the answer: its measures if they are asked for, and what they say of any mesh. *measured is NULL if they are
 * not asked for. */
static tn_status meshing_answer(const tn_meshing *m, const tn_mesh *mesh, const tn_mesh_measures *measures, bool closed,
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

/* Tells what was measured, then makes the file if one is asked for. */
static tn_status meshing_finish(const tn_meshing *m, tn_mesh *mesh, const tn_meshed_form *form, tn_error *error)
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
    const tn_mesh_changes changes = rework_asked(&m->request->rework);
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
        status = meshing_answer(m, &contour->mesh, &measures, !r->open && !options.jumps_open, &measured, error);
    if (status == TN_OK && measured)
        set_field(r, field, contour, &asked, measured);
    const tn_meshed_form form = {.name = field->record->name,
                                 .unit = (tn_mesh_unit)field->record->unit,
                                 .field = field,
                                 .spacing = contour->spacing};
    return status == TN_OK ? meshing_finish(m, &contour->mesh, &form, error) : status;
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
        request->has_points ? mesh_points(session, request, answer) : mesh_request_check(session, request);
    if (request->has_points || status != TN_OK)
        return status;
    const tn_meshing m = {.session = session,
                          .request = request,
                          .format = tn_mesh_formats[request->format],
                          .measures = request->stats || request->bounds || request->thickness || request->times ||
                                      request->format == 0,
                          .answer = answer};
    return session->opened->module->SOLID_count ? mesh_solid(&m) : mesh_field(&m);
}

/* ---- mesh, of a design of boxes */

static const char *name_of(const tn_module *module, uint32_t solid, const tn_built *built, uint32_t cell, bool image,
                           tn_box_words *words)
{
    uint32_t n = built->built.box_count;
    *words = tn_box_named(module, solid, cell % n, image ? tn_design_image(&built->built, cell / n) : 0);
    return words->text;
}

/* Names groups, of which there are `count`; `images`: those of images say so. */
static tn_status name_groups(const tn_module *module, uint32_t solid, const tn_built *built, bool images,
                             uint32_t count, tn_mesh *mesh, tn_error *error)
{
    tn_box_words words;
    mesh->group_count = count;
    mesh->group_names = calloc(count + 1, sizeof *mesh->group_names);
    if (!mesh->group_names)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        snprintf(mesh->group_names[i], sizeof mesh->group_names[i], "%.23s",
                 name_of(module, solid, built, i, images, &words));
    return TN_OK;
}

/* The union: with a group for each box and its images if the format has layers, else without groups. */
static tn_status make_union(const tn_module *module, uint32_t solid, const tn_built *built, bool layers, tn_union *u,
                            tn_error *error)
{
    tn_status status = tn_union_make(built->cells, built->cell_count, u, error);
    if (status != TN_OK)
        return status;
    for (size_t f = 0; f < u->mesh.face_count && layers; f++)
        u->mesh.face_group[f] %= built->built.box_count;
    if (layers)
        return name_groups(module, solid, built, false, built->built.box_count, &u->mesh, error);
    free(u->mesh.face_group);
    u->mesh.face_group = NULL;
    u->mesh.group_count = 0;
    return TN_OK;
}

/* Each cell by itself, with its name. */
static tn_status make_cells(const tn_module *module, uint32_t solid, const tn_built *built, tn_union *u,
                            tn_error *error)
{
    *u = (tn_union){0};
    tn_status status = tn_union_cells(built->cells, built->cell_count, &u->mesh, error);
    return status == TN_OK ? name_groups(module, solid, built, true, (uint32_t)built->cell_count, &u->mesh, error)
                           : status;
}

static tn_status measure(const tn_meshing *m, const tn_built *built, const tn_mesh *mesh, tn_mesh_measures *measures,
                         tn_error *error)
{
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    if (!m->measures)
        return TN_OK;
    tn_status status = tn_mesh_measure(mesh, 0, measures, error);
    if (status == TN_OK)
        status = tn_built_measure(built, UINT64_C(1) << TN_SOLID_PARTS_MEASURED, values, error);
    measures->parts = (uint32_t)values[TN_SOLID_PARTS_MEASURED]; /* a hollow has a surface of its own, but is no part */
    return status;
}

static tn_status begin_answer(const tn_meshing *m, uint32_t solid, const tn_built *built, const tn_union *u,
                              tn_error *error)
{
    const tn_module *module = m->session->opened->module;
    tn_mesh_measures measures = {0};
    tn_measured_mesh *measured = NULL;
    tn_status status = measure(m, built, &u->mesh, &measures, error);
    if (status == TN_OK)
        status = meshing_answer(m, &u->mesh, &measures, true, &measured, error);
    if (status != TN_OK || !measured)
        return status;
    measured->has_solid = measured->has_boxes = measured->has_doubled = true;
    measured->solid = tn_text(module, module->SOLID_records[solid].name);
    measured->boxes = built->cell_count;
    measured->doubled = u->doubled;
    return TN_OK;
}

/* STL tells vertices by their places: those that share one are moved apart, unless they are to stay. */
static tn_status pull_apart(const tn_meshing *m, tn_mesh *mesh, tn_error *error)
{
    size_t moved;
    if (m->format != TN_FILE_STL || m->request->exact)
        return TN_OK;
    tn_status status = tn_mesh_pull_apart(mesh, 1e-5, &moved, error);
    if (status == TN_OK && moved)
        tn_session_note(m->session,
                        "%zu vertices that share a place moved into their own boxes by 0.00001 of the diagonal; "
                        "--exact leaves them",
                        moved);
    return status;
}

static tn_status mesh_design(const tn_meshing *m, uint32_t solid, tn_built *built, tn_union *u, tn_error *error)
{
    const tn_module *module = m->session->opened->module;
    const tn_solid_record *record = &module->SOLID_records[solid];
    const tn_mesh_changes changes = rework_asked(&m->request->rework);
    tn_status status = tn_built_make(module, solid, (uint32_t)m->request->solid.max_boxes, built, error);
    if (status == TN_OK)
        status = m->request->cells || m->format == TN_FILE_SCAD
                     ? make_cells(module, solid, built, u, error)
                     : make_union(module, solid, built, m->format == TN_FILE_DXF, u, error);
    if (status == TN_OK)
        status = tn_mesh_change(m->session->opened, &changes, m->format, &u->mesh, error);
    if (status == TN_OK)
        status = begin_answer(m, solid, built, u, error);
    if (status == TN_OK)
        status = pull_apart(m, &u->mesh, error);
    if (status != TN_OK)
        return status;
    tn_solid_turn_up(&u->mesh);
    const tn_meshed_form form = {.name = record->name, .unit = (tn_mesh_unit)record->model};
    return meshing_finish(m, &u->mesh, &form, error);
}

/* Meshes a design of boxes; what is wrong is said. */
static tn_status mesh_solid(const tn_meshing *m)
{
    tn_opened *opened = m->session->opened;
    tn_built built = {0};
    tn_union u = {0};
    tn_error error;
    uint32_t solid;
    tn_status status = tn_solid_choose(opened, m->request->solid.solid, &solid);
    if (status != TN_OK)
        return status;
    status = mesh_design(m, solid, &built, &u, &error);
    if (status != TN_OK)
        status = tn_solid_fail(opened, solid, &error);
    tn_union_clear(&u);
    tn_built_clear(&built);
    return status;
}
