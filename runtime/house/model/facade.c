/* Makes one surface of the walls of storeys that stand above one another, and of the edges of floors between them. */
#include <math.h>

#include "runtime/house/model/aspect.h"

#define NEAR_NM 1000.0
#define UPRIGHT 1e-6

/* Is it the edge of a floor? Then `middle` lies in it. */
static bool is_edge(const tn_mesh *mesh, size_t face, double middle[3])
{
    double normal[3];
    tn_mesh_face_normal(mesh, mesh->corners + 3 * face, 3, normal);
    if (mesh->face_group[face] % TN_GROUP_COUNT != TN_GROUP_FLOOR ||
        fabs(normal[2]) > UPRIGHT * hypot(normal[0], normal[1]))
        return false;
    for (int k = 0; k < 3; k++) {
        middle[k] = 0;
        for (int i = 0; i < 3; i++)
            middle[k] += mesh->positions[3 * mesh->corners[3 * face + (size_t)i] + k] / 3;
    }
    return true;
}

/* Does the wall in a face end at the floor with this place in its edge, above it or below? */
static bool borders(const tn_house *house, const tn_face *face, const double middle[3])
{
    double half = (double)tn_face_thickness(house, face) / 2 + NEAR_NM, deck = (double)house->form->record->deck,
           floor_at = (double)house->form->level[face->storey], next = (double)house->form->level[face->storey + 1];
    bool beside = middle[0] > (double)face->at.x0 - half && middle[0] < (double)face->at.x1 + half &&
                  middle[1] > (double)face->at.y0 - half && middle[1] < (double)face->at.y1 + half;
    return beside &&
           ((middle[2] > floor_at - deck && middle[2] < floor_at) || (middle[2] > next - deck && middle[2] < next));
}

/* The face of the outside wall that covers it, or TN_NO_FACE. */
static uint32_t wall_of(const tn_house *house, const double middle[3])
{
    for (uint32_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation != TN_FACE_UNDER && tn_face_is_outer(house, face) && tn_face_thickness(house, face) > 0 &&
            borders(house, face, middle))
            return i;
    }
    return TN_NO_FACE;
}

void tn_house_face_floors(const tn_house *house, const tn_grouping *grouping, tn_mesh *mesh)
{
    for (size_t f = 0; f < mesh->face_count; f++) {
        double middle[3];
        uint32_t face = is_edge(mesh, f, middle) ? wall_of(house, middle) : TN_NO_FACE;
        if (face == TN_NO_FACE)
            continue;
        const tn_house_block wall = {.kind = tn_face_wall(house, &house->faces[face]), .of = face};
        mesh->face_group[f] = TN_GROUP_WALL + TN_GROUP_COUNT * (grouping ? grouping->group(house, &wall) : 0);
    }
}
