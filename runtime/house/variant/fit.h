/* How many tiles fit in a cell, kept for cells of one function and storey that are equally large and have the same in
 * and near their faces: plans of a library have few kinds of these. Internal to runtime/house/variant. */
#ifndef TARTAN_HOUSE_VARIANT_FIT_H
#define TARTAN_HOUSE_VARIANT_FIT_H

#include "runtime/house/house.h"
#include "runtime/plan/automata/numbering.h"

enum { TN_FITS_MAX = 1 << 16 }; /* kinds of cells: with more the counts are forgotten */

/* Owns its arrays. */
typedef struct tn_fits {
    bool *wanted; /* [functions] a tile is for it */
    tn_interner cells;
    tn_key key;
    size_t *counts; /* [cells] */
    size_t room;
} tn_fits;

/* TN_MEMORY. Clear it in any case. */
tn_status tn_fits_begin(const tn_house_form *form, tn_fits *fits, tn_error *error);
void tn_fits_clear(tn_fits *fits);

/* Does the cell have to have a tile? */
bool tn_fits_wanted(const tn_fits *fits, const tn_cell *cell);

/* How many tiles fit in such a cell of a house whose faces are all known. TN_MEMORY. */
tn_status tn_fits_count(tn_fits *fits, const tn_house *house, uint32_t cell, size_t *count, tn_error *error);

#endif
