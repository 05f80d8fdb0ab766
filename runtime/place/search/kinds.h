/* The parts of a kit as a search needs them: their boxes for each heading, and in which headings and images they look
 * the same. */
#ifndef TARTAN_PLACE_SEARCH_KINDS_H
#define TARTAN_PLACE_SEARCH_KINDS_H

#include "runtime/place/search/choices.h"

/* Fills choices->kinds and choices->boxes from the records of the rules' module. TN_MEMORY or TN_OK. */
tn_status tn_kinds_make(tn_site_choices *choices, tn_error *error);

/* The part in an image at x = 0 (axis 0) or z = 0 (axis 1), whose mirrored[axis] is below 4. */
tn_frame tn_kind_mirror(const tn_kind_of_part *kind, const tn_frame *frame, int axis);

#endif
