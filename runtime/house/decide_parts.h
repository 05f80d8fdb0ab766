/* What the files that decide on faces share. Internal to runtime/house. */
#ifndef TARTAN_HOUSE_DECIDE_PARTS_H
#define TARTAN_HOUSE_DECIDE_PARTS_H

#include "runtime/house/solids.h"

/* Is a form's line of faces about the face? All functions are given. */
bool tn_face_line_is_about(const tn_house *house, const tn_face_line_record *line, const tn_face *face);

/* Is the face as wide and high as the opening needs: with half a wall at either side, and a deck above? */
bool tn_opening_has_room(const tn_house *house, const tn_face *face, const tn_opening_record *opening);

/* Does a lower roof stand above the sill of the opening, somewhere along it? NULL: of an open side, which is as wide as
 * the face. Heights above the lowest floor; *top is set where there is a lower roof. */
bool tn_face_behind(const tn_house *house, const tn_face *face, const tn_opening_record *opening, int64_t *sill,
                    tn_fraction *top);

#endif
