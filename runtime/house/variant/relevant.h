/* Which faces clauses can tell apart, when the functions are given. Internal to runtime/house/variant.
 *
 * An outside face is never walked through and joins no rooms, so clauses see what is in it only through them:
 * `room(living, not by window)`. Where no such question is open about the room of its cell (the cell is no living
 * room), all of the face's kinds are the same to the clauses: they only change which tiles fit into that one cell
 * (where none of them is `open`). A void is of the room below it.
 */
#ifndef TARTAN_HOUSE_RELEVANT_H
#define TARTAN_HOUSE_RELEVANT_H

#include "runtime/house/house.h"

/* The functions of kind ROOM that ask for faces: all of the module, which is only too careful. Owns the array. */
typedef struct tn_room_questions {
    uint32_t *functions;
    size_t count;
} tn_room_questions;

tn_status tn_room_questions_find(const tn_module *module, tn_room_questions *questions, tn_error *error);
void tn_room_questions_clear(tn_room_questions *questions);

/* Can a clause depend on what is in the face? Cells have their functions. */
bool tn_face_relevant(const tn_house *house, const tn_room_questions *questions, const tn_face *face);

#endif
