/* Slices written to files: SVG, DXF and CLI (Common Layer Interface), whole stacks or layer by layer. */
#ifndef TARTAN_SLICES_WRITE_H
#define TARTAN_SLICES_WRITE_H

#include <stdio.h>

#include "runtime/module/values.h"
#include "runtime/slices/slices.h"

typedef struct tn_slices_style {
    const char *note; /* how they were made: a line */
    const char *name; /* of what is sliced */
    double low[3], high[3];
    uint32_t unit;      /* a tn_unit */
    size_t first, last; /* layers to write: first to last - 1 */
} tn_slices_style;

/* A group a layer, in it a path with all of its lines; as large as the box. */
tn_status tn_slices_write_svg(const tn_slices *slices, const tn_slices_style *style, FILE *out, tn_error *error);

/* A layer of the drawing for each, in it closed level polylines at its height. */
tn_status tn_slices_write_dxf(const tn_slices *slices, const tn_slices_style *style, FILE *out, tn_error *error);

/* CLI 2.0 as text: polylines that end where they begin, outer ones with direction 1 and those of holes 0. */
tn_status tn_slices_write_cli(const tn_slices *slices, const tn_slices_style *style, FILE *out, tn_error *error);

#endif
