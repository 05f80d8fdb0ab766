/* Where the names of rooms stand in a drawing. */
#ifndef TARTAN_HOUSE_MARKS_NAMES_H
#define TARTAN_HOUSE_MARKS_NAMES_H

#include "runtime/house/model/marks.h"
#include "runtime/house/model/swings.h"

/* The names of the rooms of a storey, each with its area: in the middle of its largest cell there, or as near to that
 * as nothing is below it. */
tn_status tn_marks_names(const tn_house *house, uint32_t storey, double lettering, const tn_taken *taken,
                         tn_marks *marks, tn_error *error);

#endif
