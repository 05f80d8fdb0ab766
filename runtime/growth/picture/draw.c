/* Lists the faces of a growing surface for a picture, with the labels of their edges. */
#include "runtime/growth/picture/draw.h"

#include <math.h>
#include <string.h>

#include "runtime/growth/environment/environment.h"

static void add_face(const tn_map *map, uint32_t face, tn_display_list *display, uint32_t *corner)
{
    uint32_t first = map->face_first[face], size = tn_face_size(map, face);
    display->first[display->face_count++] = *corner;
    for (uint32_t d = first; d < first + size; d++, ++*corner) {
        for (size_t k = 0; k < 3; k++)
            display->points[*corner][k] = map->positions[3 * (size_t)map->origin[d] + k];
        display->edges[*corner] = (uint16_t)tn_state_label(map->states[map->side[d] / 2]);
    }
}

/* Room for more faces behind those that are there. */
static tn_status make_room(tn_display_list *display, size_t faces, size_t corners, tn_error *error)
{
    uint32_t old_faces = display->face_count, old_corners = old_faces ? display->first[old_faces] : 0;
    tn_display_list larger;
    tn_status status = tn_display_list_new(old_faces + faces, old_corners + corners, false, &larger, error);
    if (status == TN_OK && old_faces) {
        memcpy(larger.points, display->points, old_corners * sizeof *larger.points);
        memcpy(larger.edges, display->edges, old_corners * sizeof *larger.edges);
        memcpy(larger.first, display->first, (old_faces + 1u) * sizeof *larger.first);
    }
    if (status != TN_OK) {
        tn_display_list_clear(&larger);
        return status;
    }
    larger.face_count = old_faces;
    tn_display_list_clear(display);
    *display = larger;
    return TN_OK;
}

tn_status tn_growth_display_add(const tn_growth *growth, tn_display_list *display, tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    size_t corners = 2 * (size_t)map->edge_count - tn_face_size(map, TN_OUTER_FACE);
    uint32_t corner = display->face_count ? display->first[display->face_count] : 0;
    tn_status status = make_room(display, map->face_count - 1, corners, error);
    if (status != TN_OK)
        return status;
    for (uint32_t f = TN_OUTER_FACE + 1; f < map->face_count; f++)
        add_face(map, f, display, &corner);
    display->first[display->face_count] = corner;
    display->step = tn_growth_steps(growth);
    display->threads = tn_growth_settings(growth)->threads;
    display->watch = tn_growth_settings(growth)->watch;
    return TN_OK;
}

tn_status tn_growth_display_surround(const tn_growth *growth, tn_display_list *display, tn_error *error)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t c = 0; c < display->first[display->face_count]; c++)
        for (int k = 0; k < 3; k++) {
            low[k] = tn_smaller(low[k], display->points[c][k]);
            high[k] = tn_larger(high[k], display->points[c][k]);
        }
    if (display->face_count == 0)
        return TN_OK;
    return tn_surroundings_guides(tn_growth_surroundings(growth), low, high, &display->guides, error);
}

tn_status tn_growth_view(const tn_growth *growth, const tn_camera *camera, bool surrounded, tn_view **view,
                         tn_error *error)
{
    tn_display_list display = {0};
    *view = NULL;
    tn_status status = tn_growth_display_add(growth, &display, error);
    if (status == TN_OK && surrounded)
        status = tn_growth_display_surround(growth, &display, error);
    if (status == TN_OK)
        status = tn_view_take(&display, camera, view, error);
    tn_display_list_clear(&display);
    return status;
}

static const char *label_name(const void *names, uint32_t label)
{
    return ((const tn_growth_system *)names)->labels[label].name;
}

tn_legend tn_growth_legend(const tn_growth_system *system)
{
    return (tn_legend){.name = label_name, .names = system, .count = system ? system->label_count : 0};
}
