/* Makes one surface of the walls of storeys that stand above one another, and of the edges of floors between them. */
#include <math.h>

#include "runtime/house/model/aspect.h"
#include "runtime/house/model/model.h"

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

static bool is_outside_wall(const tn_house *house, const tn_face *face)
{
    return face->relation != TN_FACE_UNDER && tn_face_is_outer(house, face) && tn_face_thickness(house, face) > 0;
}

/* The face of the outside wall that covers it, or TN_NO_FACE. */
static uint32_t wall_of(const tn_house *house, const double middle[3])
{
    for (uint32_t i = 0; i < house->face_count; i++)
        if (is_outside_wall(house, &house->faces[i]) && borders(house, &house->faces[i], middle))
            return i;
    return TN_NO_FACE;
}

static bool is_in_floor(const tn_blocks *blocks, const double at[3])
{
    for (size_t i = 0; i < blocks->count; i++) {
        const tn_house_block *b = &blocks->items[i];
        bool in = b->kind == TN_SOLID_DECK;
        for (int k = 0; k < 3; k++)
            in = in && at[k] > b->low[k] && at[k] < b->high[k];
        if (in)
            return true;
    }
    return false;
}

/* Has the floor an edge in the line of a wall, at a place beyond its end? axis: along the wall. */
static bool goes_on(const tn_blocks *blocks, const double beyond[3], int axis, double half)
{
    double sides[2][3];
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < 3; k++)
            sides[side][k] = beyond[k] + (k != 1 - axis ? 0 : (side ? 1 : -1) * (half + NEAR_NM));
    return is_in_floor(blocks, beyond) && !(is_in_floor(blocks, sides[0]) && is_in_floor(blocks, sides[1]));
}

tn_status tn_house_part_floors(const tn_house *house, tn_blocks *blocks, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        int axis = face->at.x0 == face->at.x1 ? 1 : 0;
        double half = (double)tn_face_thickness(house, face) / 2, deck = (double)house->form->record->deck,
               from[2] = {(double)face->at.x0, (double)face->at.y0}, to[2] = {(double)face->at.x1, (double)face->at.y1};
        for (int k = 0; status == TN_OK && is_outside_wall(house, face) && k < 4; k++) {
            bool high = k % 2;
            double at = high ? to[axis] + half : from[axis] - half,
                   beyond[3] = {from[0], from[1], (double)house->form->level[face->storey + k / 2] - deck / 2};
            beyond[axis] = at + (high ? 2 : -2) * NEAR_NM;
            if (wall_of(house, beyond) == TN_NO_FACE && goes_on(blocks, beyond, axis, half))
                status = tn_blocks_split(blocks, TN_SOLID_DECK, axis, at, error);
        }
    }
    return status;
}

void tn_house_face_floors(const tn_house *house, const tn_grouping *grouping, int axis, double at, tn_mesh *mesh)
{
    for (size_t f = 0; f < mesh->face_count; f++) {
        double middle[3];
        uint32_t face = is_edge(mesh, f, middle) ? wall_of(house, middle) : TN_NO_FACE;
        if (face == TN_NO_FACE || (axis >= 0 && fabs(middle[axis] - at) < NEAR_NM))
            continue;
        const tn_house_block wall = {.kind = tn_face_wall(house, &house->faces[face]), .of = face};
        mesh->face_group[f] = TN_GROUP_WALL + TN_GROUP_COUNT * (grouping ? grouping->group(house, &wall) : 0);
    }
}
