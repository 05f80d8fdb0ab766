/* Where the names of rooms stand in a drawing. */
#ifndef TARTAN_HOUSE_MARKS_NAMES_H
#define TARTAN_HOUSE_MARKS_NAMES_H

#include "runtime/house/model/designations.h"
#include "runtime/house/model/marks.h"
#include "runtime/house/model/swings.h"

/* The rooms of a storey, each by its name, its number and its net area, or as much of that as has room: in the middle
 * of its largest cell there, or as near to that as nothing is below it. taken: turned as the plan is. */
tn_status tn_marks_names(const tn_house *house, uint32_t storey, const tn_mark_style *style,
                         const tn_designations *names, const tn_taken *taken, tn_marks *marks, tn_error *error);

/* A rectangle of the house in its plan, which is turned by half. */
static inline tn_rectangle tn_turned(tn_rectangle r)
{
    return (tn_rectangle){-r.x1, -r.x0, -r.y1, -r.y0};
}

#endif
