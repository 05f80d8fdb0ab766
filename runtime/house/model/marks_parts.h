/* The parts of making marks. Internal to runtime/house/model. */
#ifndef TARTAN_HOUSE_MARKS_PARTS_H
#define TARTAN_HOUSE_MARKS_PARTS_H

#include "runtime/house/model/marks.h"
#include "runtime/house/solids.h"

/* A quarter of a circle. */
void tn_marks_arc(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1);

/* What of a storey's floor is taken in plan: by furniture and steps, by stairs as large as their cells, and by doors
 * that swing. */
typedef struct tn_taken {
    tn_rectangles items, stairs, swings;
} tn_taken;

/* All but doors. Clear it in any case. */
tn_status tn_taken_find(const tn_house *house, uint32_t storey, tn_taken *taken, tn_error *error);
void tn_taken_clear(tn_taken *taken);

/* The leaves of a face's opening, where it has any: they swing into the room that comes first, unless only the other is
 * free, and hang where they meet no furniture, no stair and no other door, if that can be. Adds where they swing to
 * what is taken. */
tn_status tn_marks_door(const tn_house *house, const tn_face *face, tn_taken *taken, tn_marks *marks, tn_error *error);

/* The names of the rooms of a storey, each with its area: in the middle of its largest cell there, or as near to that
 * as nothing is below it. */
tn_status tn_marks_names(const tn_house *house, uint32_t storey, double lettering, const tn_taken *taken,
                         tn_marks *marks, tn_error *error);

#endif
