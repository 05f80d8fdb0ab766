/* Finds the rooms of a house: cells of one function that open faces join, with the voids above them; measures their
 * areas and windows. */
#include <stdlib.h>

#include "runtime/house/house.h"

/* The lowest cell of a group; the path to it becomes shorter. */
static uint32_t find(uint32_t *groups, uint32_t cell)
{
    while (groups[cell] != cell) {
        groups[cell] = groups[groups[cell]];
        cell = groups[cell];
    }
    return cell;
}

static void join(uint32_t *groups, uint32_t a, uint32_t b)
{
    a = find(groups, a);
    b = find(groups, b);
    groups[a > b ? a : b] = a < b ? a : b;
}

tn_status tn_house_rooms(const tn_house *house, uint32_t **rooms, tn_error *error)
{
    uint32_t *groups = malloc((house->cell_count + 1) * sizeof *groups);
    if (!groups)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < house->cell_count; i++)
        groups[i] = i;
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->second == TN_NO_CELL)
            continue;
        const tn_cell *a = &house->cells[face->first], *b = &house->cells[face->second];
        bool above = face->relation == TN_FACE_UNDER && b->open;
        bool same = face->kind == TN_FACE_OPEN && !a->open && !b->open && a->function == b->function;
        if (above || same)
            join(groups, face->first, face->second);
    }
    for (uint32_t i = 0; i < house->cell_count; i++)
        groups[i] = find(groups, i);
    *rooms = groups;
    return TN_OK;
}

tn_int128 tn_face_glazing(const tn_house *house, const tn_face *face)
{
    const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
    bool glazed = opening && opening->flags & TN_GLAZED && tn_face_sheltered(house, face) != TN_NO_CELL;
    return glazed ? (tn_int128)opening->wide * opening->high : 0;
}

uint32_t tn_room_areas(const tn_house *house, const uint32_t *rooms, uint32_t room, tn_int128 *gross, tn_int128 *net)
{
    uint32_t cells = 0;
    *gross = *net = 0;
    for (uint32_t i = room; i < house->cell_count; i++) {
        if (rooms[i] != room || house->cells[i].open)
            continue;
        tn_rectangle clear = tn_cell_clear(house, i);
        *gross += tn_cell_area(&house->cells[i]);
        *net += (tn_int128)(clear.x1 - clear.x0) * (clear.y1 - clear.y0);
        cells++;
    }
    return cells;
}

tn_int128 tn_room_glazing(const tn_house *house, const uint32_t *rooms, uint32_t room)
{
    tn_int128 glazed = 0;
    for (size_t i = 0; i < house->face_count; i++) {
        uint32_t cell = tn_face_sheltered(house, &house->faces[i]);
        if (cell != TN_NO_CELL && rooms[cell] == room)
            glazed += tn_face_glazing(house, &house->faces[i]);
    }
    return glazed;
}
