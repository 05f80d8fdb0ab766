/* Gathers the rooms of a house, and decides on one of them: by its cells, its faces, its area. */
#include <stdlib.h>

#include "runtime/house/house.h"
#include "runtime/house/rule/asked_data.h"

tn_status tn_rooms_gather(tn_house_rules *rules, tn_error *error)
{
    const tn_house *house = rules->house;
    if (rules->gathered)
        return TN_OK;
    free(rules->room_of);
    rules->room_of = NULL;
    rules->room_count = 0;
    tn_status status = tn_house_rooms(house, &rules->room_of, error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        if (rules->room_of[i] == i) { /* a room is named by its first cell */
            rules->todo[i] = (uint32_t)rules->room_count;
            rules->rooms[rules->room_count++] = (tn_room_span){.room = i, .begin = cell->tray};
        }
        tn_room_span *room = &rules->rooms[rules->todo[rules->room_of[i]]];
        room->end = cell->tray + 1; /* cells go by trays */
        room->cells += !cell->open;
        room->area += cell->open ? 0 : tn_cell_area(cell);
    }
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        uint32_t cell = tn_face_sheltered(house, &house->faces[i]);
        if (cell != TN_NO_CELL)
            rules->rooms[rules->todo[rules->room_of[cell]]].glazed += tn_face_glazing(house, &house->faces[i]);
    }
    rules->gathered = status == TN_OK;
    return status;
}

typedef struct tn_asked_room {
    const tn_house_rules *rules;
    const tn_room_span *room;
} tn_asked_room;

static bool all_cells(const tn_asked_room *asked, uint32_t function)
{
    const tn_house *house = asked->rules->house;
    for (uint32_t i = 0; i < house->cell_count; i++)
        if (asked->rules->room_of[i] == asked->room->room && !house->cells[i].open &&
            !tn_house_decide(house, function, &house->cells[i]))
            return false;
    return true;
}

static bool has_face(const tn_asked_room *asked, int64_t kind)
{
    const tn_house *house = asked->rules->house;
    const uint32_t *room_of = asked->rules->room_of;
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if ((int64_t)face->kind == kind && (room_of[face->first] == asked->room->room ||
                                            (face->second != TN_NO_CELL && room_of[face->second] == asked->room->room)))
            return true;
    }
    return false;
}

/* Does what is glazed to the outside compare so with a part of the floor? Square nanometres, times at most 1000: they
 * stay within 128 bits, because a house is at most 2^43 long and deep. */
static bool glazing_compares(const tn_asked_room *asked, int64_t test, int64_t ratio)
{
    return tn_area_compares(asked->room->glazed * (ratio & UINT32_MAX) - asked->room->area * (ratio >> 32), test, 0);
}

static bool ask_room(const void *context, const tn_instruction *instruction)
{
    const tn_asked_room *asked = context;
    enum { SQUARE_MICROMETRE = 1000000 };
    switch (instruction->opcode) {
    case TN_OP_EVERY:
        return true;
    case TN_OP_ALL_CELLS:
        return all_cells(asked, (uint32_t)instruction->first);
    case TN_OP_HAS_FACE:
        return has_face(asked, instruction->first);
    case TN_OP_ROOM_GLAZING:
        return glazing_compares(asked, instruction->first, instruction->second);
    case TN_OP_ROOM_AREA:
        return tn_area_compares(asked->room->area, instruction->first, instruction->second);
    case TN_OP_ROOM_CELLS: /* a number is compared as an area of so many square micrometres */
        return tn_area_compares((tn_int128)asked->room->cells * SQUARE_MICROMETRE, instruction->first,
                                instruction->second);
    default:
        return false;
    }
}

bool tn_room_decide(const tn_house_rules *rules, uint32_t function, const tn_room_span *room)
{
    tn_asked_room asked = {rules, room};
    return tn_decision_run(rules->house->form->module, function, ask_room, &asked);
}
