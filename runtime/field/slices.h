/* Slices of a field: in level layers, the closed lines around what is inside (docs/field-language.md).
 *
 * They are found on the field itself, as the mesh's vertices are, and no triangle is asked. Lines are closed, cross
 * neither themselves nor each other, and have the inside on their left: outer ones run counter-clockwise seen from
 * above, those of holes clockwise.
 */
#ifndef TARTAN_FIELD_SLICES_H
#define TARTAN_FIELD_SLICES_H

#include "runtime/field/contour.h"
#include "runtime/slices/slices.h"

typedef struct tn_field_slices {
    tn_slices slices;
    tn_contour contour; /* what was found on the way: jumps, sides of the box that cut the form; no mesh */
} tn_field_slices;

/* Layers fill the box (runtime/slices/slices.h). Samples of the grid's x and y. Clear the slices in any case.
 * TN_INVALID (E1416) for a thickness that is no part of the box, TN_LIMIT (E1414), TN_MEMORY. */
tn_status tn_field_slices_new(const tn_field *field, const tn_field_grid *grid, double thickness,
                              const tn_contour_options *options, tn_field_slices *slices, tn_error *error);
void tn_field_slices_clear(tn_field_slices *slices);

#endif
