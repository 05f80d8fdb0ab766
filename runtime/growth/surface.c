/* Makes a mesh of a grown surface. */
#include "runtime/growth/surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/growth/stats.h"

/* The index of an age class among the statistics' (by label, then age). */
static uint32_t group_of(const tn_stats *stats, tn_edge_state state)
{
    uint32_t label = tn_state_label(state);
    int32_t age = tn_state_age(state);
    size_t low = 0, high = stats->age_count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        const tn_age_count *one = &stats->ages[middle];
        if (one->label < label || (one->label == label && one->age <= age))
            low = middle;
        else
            high = middle;
    }
    return (uint32_t)low;
}

static tn_status name_groups(const tn_growth *growth, const tn_stats *stats, tn_mesh *mesh, tn_error *error)
{
    mesh->group_count = (uint32_t)stats->age_count;
    mesh->group_names = calloc(stats->age_count + 1, sizeof *mesh->group_names);
    mesh->face_group = malloc((mesh->face_count + 1) * sizeof *mesh->face_group);
    if (!mesh->group_names || !mesh->face_group)
        return tn_fail_memory(error);
    for (size_t i = 0; i < stats->age_count; i++)
        snprintf(mesh->group_names[i], sizeof *mesh->group_names, "Edge%u_%d",
                 tn_growth_rules(growth)->labels[stats->ages[i].label].number, stats->ages[i].age);
    return TN_OK;
}

static tn_status name_layers(const tn_growth *growth, tn_mesh *mesh, tn_error *error)
{
    const tn_growth_system *system = tn_growth_rules(growth);
    mesh->group_count = system->label_count;
    mesh->group_names = calloc(system->label_count + 1, sizeof *mesh->group_names);
    if (!mesh->group_names)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < system->label_count; i++)
        snprintf(mesh->group_names[i], sizeof *mesh->group_names, "%s", system->labels[i].name);
    return TN_OK;
}

static void write_face(const tn_map *map, uint32_t face, uint32_t start, tn_mesh *mesh, uint32_t *corner)
{
    uint32_t first = map->face_first[face], size = tn_face_size(map, face);
    for (uint32_t i = 0; i < size; i++) {
        uint32_t d = start + i;
        mesh->corners[(*corner)++] = map->origin[d < first + size ? d : d - size];
    }
}

static void write_faces(const tn_map *map, const tn_stats *stats, const uint32_t *dart, const uint32_t *face,
                        unsigned char *done, tn_mesh *mesh)
{
    uint32_t corner = 0;
    size_t written = 0;
    done[TN_OUTER_FACE] = 1;
    for (size_t side = 0; side < 2 * (size_t)map->edge_count; side++) {
        if (done[face[side]])
            continue;
        done[face[side]] = 1;
        mesh->face_first[written] = corner;
        if (mesh->face_group)
            mesh->face_group[written] = group_of(stats, map->states[side / 2]);
        write_face(map, face[side], dart[side], mesh, &corner);
        written++;
    }
    mesh->face_first[written] = corner;
}

static tn_status write_lines(const tn_map *map, const tn_stats *stats, const uint32_t *dart,
                             const tn_surface_options *options, tn_mesh *mesh, tn_error *error)
{
    bool groups = options->groups || options->layers;
    mesh->lines = malloc(2 * (size_t)map->edge_count * sizeof *mesh->lines);
    mesh->line_group = groups ? malloc((size_t)map->edge_count * sizeof *mesh->line_group) : NULL;
    if (!mesh->lines || (groups && !mesh->line_group))
        return tn_fail_memory(error);
    mesh->line_count = map->edge_count;
    for (uint32_t e = 0; e < map->edge_count; e++) {
        mesh->lines[2 * (size_t)e] = map->origin[dart[2 * (size_t)e]];
        mesh->lines[2 * (size_t)e + 1] = map->origin[dart[2 * (size_t)e + 1]];
        if (groups)
            mesh->line_group[e] = options->layers ? tn_state_label(map->states[e]) : group_of(stats, map->states[e]);
    }
    return TN_OK;
}

static tn_status fill(const tn_growth *growth, const tn_surface_options *options, const tn_stats *stats, tn_mesh *mesh,
                      tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    uint32_t *dart = NULL, *face = NULL;
    unsigned char *done = calloc(map->face_count, 1);
    tn_status status = done ? tn_map_twins(map, &dart, &face, error) : tn_fail_memory(error);
    if (status == TN_OK && options->groups)
        status = name_groups(growth, stats, mesh, error);
    else if (status == TN_OK && options->layers)
        status = name_layers(growth, mesh, error);
    if (status == TN_OK) {
        memcpy(mesh->positions, map->positions, 3 * (size_t)map->vertex_count * sizeof *mesh->positions);
        write_faces(map, stats, dart, face, done, mesh);
        if (options->lines)
            status = write_lines(map, stats, dart, options, mesh, error);
    }
    free(done);
    free(dart);
    free(face);
    return status;
}

tn_status tn_surface_mesh(const tn_growth *growth, const tn_surface_options *options, tn_mesh *mesh, tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    size_t corners = 2 * (size_t)map->edge_count - tn_face_size(map, TN_OUTER_FACE);
    tn_stats stats = {0};
    *mesh = (tn_mesh){0};
    tn_status status = options->groups ? tn_stats_measure(growth, &stats, error) : TN_OK;
    if (status == TN_OK)
        status = tn_mesh_new(map->vertex_count, map->face_count - 1, corners, mesh, error);
    if (status == TN_OK)
        status = fill(growth, options, &stats, mesh, error);
    mesh->watch = tn_growth_settings(growth)->watch;
    tn_stats_clear(&stats);
    if (status != TN_OK)
        tn_mesh_clear(mesh);
    return status;
}
