/* Reads models from LDraw files: parts with their places, sub-files put in theirs.
 *
 * A tn_ldraw owns its parts and their names; clear it in any case. */
#ifndef TARTAN_PLACE_READ_H
#define TARTAN_PLACE_READ_H

#include "runtime/place/grow.h"

typedef struct tn_ldraw {
    tn_placed_model model; /* in cells of the unit; names in small letters, without .dat */
    char **texts;          /* of the names */
    size_t text_count;
    size_t snapped;        /* parts that were turned a little, or lay beside the cells by less than a tenth */
    size_t tilted, beside; /* parts left out: turned otherwise than they may be, or beside the cells */
    const char *first_tilted, *first_beside; /* their first name; NULL: none */
} tn_ldraw;

/* Files that a text names as sub-files and does not hold itself. find: the bytes of the file of this name, which the
 * reader frees, or NULL if there is none; the name is spelled as in the text, with / for \\. Parts, which are .dat
 * files, are not asked for. */
typedef struct tn_ldraw_files {
    tn_status (*find)(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error);
    void *context;
} tn_ldraw_files;

/* Reads a text, with sub-files after `0 FILE` lines, and those that lie beside it (NULL: none do). unit: a cell's sides
 * in LDU. turns: 4 where parts stay upright, else 24. E1319 with the file and line for what cannot be read, or
 * sub-files that contain themselves; TN_LIMIT (E1313) past 1,000,000 parts. */
tn_status tn_ldraw_read(const char *text, size_t size, const double unit[3], uint32_t turns,
                        const tn_ldraw_files *beside, tn_ldraw *ldraw, tn_error *error);
void tn_ldraw_clear(tn_ldraw *ldraw);

#endif
