/* Grows a module's rewrite system a few steps, within narrow limits; the map's promises hold after each. */
#ifndef TARTAN_TESTS_FUZZ_GROW_H
#define TARTAN_TESTS_FUZZ_GROW_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/write.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/picture/draw.h"
#include "runtime/growth/stats.h"
#include "runtime/growth/study.h"
#include "runtime/growth/surface.h"
#include "runtime/mesh/openmesh.h"

enum { GROW_STEPS = 4, GROW_EDGES = 60, GROW_CODE = 6000 };

/* Boundary meshes are files of this machine, and long successors take long: such modules are left alone. */
static inline bool is_modest(const tn_module *module)
{
    for (size_t i = 0; i < module->BOUNDARY_count; i++)
        if (module->BOUNDARY_records[i].kind == TN_BOUNDARY_MESH)
            return false;
    return module->GROWTH_count == 1 && module->code_size <= GROW_CODE && module->FORCE_count <= GROW_EDGES &&
           module->BOUNDARY_count <= GROW_EDGES;
}

/* Whatever the format, what comes out is thrown away. */
static inline void write_mesh(const tn_mesh *mesh)
{
    typedef tn_status writer(const tn_mesh *, const tn_mesh_style *, FILE *, tn_error *);
    static writer *const writers[] = {tn_mesh_write_obj, tn_mesh_write_ply, tn_mesh_write_glb, tn_mesh_write_dxf};
    tn_mesh_style style = {.normals = true};
    tn_error error;
    for (size_t i = 0; i < sizeof writers / sizeof *writers; i++) {
        char *bytes = NULL;
        size_t size;
        FILE *out = open_memstream(&bytes, &size);
        if (!out)
            return;
        writers[i](mesh, &style, out, &error);
        fclose(out);
        free(bytes);
    }
}

static inline void draw_view(const tn_growth *growth)
{
    tn_error error;
    tn_camera camera = tn_camera_default();
    tn_view *view;
    tn_view_options options = {.title = "fuzz"};
    tn_picture picture = {.format = TN_CANVAS_SVG};
    if (tn_growth_view(growth, &camera, true, &view, &error) == TN_OK)
        tn_views_draw(&view, 1, &options, &picture, &error);
    else if (error.code != E_PART_ABSENT)
        abort();
    tn_view_free(view);
    free(picture.element);
}

/* What is done with a surface afterwards: faults are looked for, it is drawn, a mesh is made and written. */
static inline void look_at(const tn_growth *growth)
{
    tn_error error;
    tn_faults faults;
    tn_mesh mesh;
    if (tn_faults_find(growth, &faults, &error) != TN_OK)
        abort();
    draw_view(growth);
    if (tn_surface_mesh(growth, &(tn_surface_options){.groups = true, .lines = true}, &mesh, &error) != TN_OK ||
        tn_mesh_triangulate(&mesh, &error) != TN_OK)
        abort();
    write_mesh(&mesh);
    tn_mesh_clear(&mesh);
}

/* False where a limit ended it. */
static inline bool grow_some(tn_growth *growth)
{
    tn_error error;
    for (int i = 0; i < GROW_STEPS; i++) {
        tn_status status = tn_growth_step(growth, &error);
        if (status == TN_LIMIT)
            return false;
        tn_stats stats;
        if (status != TN_OK || tn_map_validate(tn_growth_map(growth), &error) != TN_OK) {
            fprintf(stderr, "growing breaks the map: %s\n", error.message);
            abort();
        }
        if (tn_stats_measure(growth, &stats, &error) != TN_OK)
            abort();
        tn_stats_clear(&stats);
    }
    look_at(growth);
    return true;
}

/* Interpreting the rules' code makes the same surface. */
static inline void grow_by_code(const tn_growth *growth, const tn_growth_system *system, const tn_study *study)
{
    tn_growth_options options = study->options;
    tn_growth *other;
    tn_error error;
    options.interpret = true;
    if (tn_growth_new(system, &study->environment, &options, &other, &error) != TN_OK)
        abort();
    for (uint32_t i = 0; i < tn_growth_steps(growth); i++)
        if (tn_growth_step(other, &error) != TN_OK)
            abort();
    const tn_map *a = tn_growth_map(growth), *b = tn_growth_map(other);
    if (a->vertex_count != b->vertex_count || a->edge_count != b->edge_count || a->face_count != b->face_count ||
        memcmp(a->positions, b->positions, 3 * sizeof(double) * a->vertex_count) != 0) {
        fprintf(stderr, "the ways of growing differ\n");
        abort();
    }
    tn_growth_free(other);
}

static inline void grow_module(const tn_module *module)
{
    if (!is_modest(module))
        return;
    tn_growth_system *system = NULL;
    tn_study study = {0};
    tn_growth *growth = NULL;
    tn_error error;
    tn_status status = tn_growth_system_read(module, &system, &error);
    if (status == TN_OK)
        status = tn_study_read(module, "fuzz.study", &tn_openmesh_reader, &study, &error);
    study.options.edge_limit = GROW_EDGES;
    study.options.threads = 1;
    study.options.explain = true;
    if (status == TN_OK)
        status = tn_growth_new(system, &study.environment, &study.options, &growth, &error);
    if (status == TN_OK && grow_some(growth))
        grow_by_code(growth, system, &study);
    tn_growth_free(growth);
    tn_growth_system_free(system);
    tn_study_clear(&study);
}

#endif
