/* The parts of making marks. Internal to runtime/house/model. */
#ifndef TARTAN_HOUSE_MARKS_PARTS_H
#define TARTAN_HOUSE_MARKS_PARTS_H

#include "runtime/house/model/marks.h"
#include "runtime/house/model/swings.h"

/* A quarter of a circle. */
void tn_marks_arc(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1);

/* The names of the rooms of a storey, each with its area: in the middle of its largest cell there, or as near to that
 * as nothing is below it. */
tn_status tn_marks_names(const tn_house *house, uint32_t storey, double lettering, const tn_taken *taken,
                         tn_marks *marks, tn_error *error);

#endif
