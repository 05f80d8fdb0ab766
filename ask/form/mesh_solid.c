/* mesh, of a design of boxes: as one surface, or box by box. */
#include <stdlib.h>

#include "ask/form/mesh.h"
#include "driver/solid/solid.h"
#include "runtime/geometry/measure.h"
#include "runtime/geometry/union/union.h"

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
        status = tn_meshing_answer(m, &u->mesh, &measures, true, &measured, error);
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
    const tn_mesh_changes changes = tn_rework_asked(&m->request->rework);
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
    return tn_meshing_finish(m, &u->mesh, &form, error);
}

tn_status tn_mesh_solid(const tn_meshing *m)
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
