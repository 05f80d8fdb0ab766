/* Reads models from LDraw files: parts with their places, sub-files put in theirs.
 *
 * A tn_ldraw owns its parts and their names; clear it in any case. */
#ifndef TARTAN_PLACE_READ_H
#define TARTAN_PLACE_READ_H

#include "runtime/place/grow.h"

typedef struct tn_ldraw {
    tn_placed_model model; /* in cells of the unit; names in small letters, without .dat */
    char *text;            /* of the names */
    size_t snapped;        /* parts that were turned a little, or lay beside the cells by less than a tenth */
    size_t tilted, beside; /* parts left out: turned otherwise than they may be, or beside the cells */
    const char *first_tilted, *first_beside; /* their first name; NULL: none */
} tn_ldraw;

/* Reads a text, with sub-files after `0 FILE` lines. unit: a cell's sides in LDU. turns: 4
 * where parts stay upright, else 24. E1319 with the line for what cannot
 * be read, or sub-files that contain themselves; TN_LIMIT (E1313) past 1,000,000 parts. */
tn_status tn_ldraw_read(const char *text, size_t size, const double unit[3], uint32_t turns, tn_ldraw *ldraw,
                        tn_error *error);
void tn_ldraw_clear(tn_ldraw *ldraw);

#endif
