/* Slices: in level layers, the closed lines around what is inside. Lines have the inside on their left: outer ones run
 * counter-clockwise seen from above, those of holes clockwise.
 *
 * A tn_slices owns its arrays; clear it in any case.
 */
#ifndef TARTAN_SLICES_SLICES_H
#define TARTAN_SLICES_SLICES_H

#include <stdio.h>

#include "runtime/geometry/mesh.h"
#include "runtime/module/values.h"

typedef struct tn_slices {
    double (*points)[2];   /* of one line after the other */
    uint32_t *line_first;  /* [line_count + 1]: each line's first point; the last is joined to it */
    uint32_t *layer_first; /* [layer_count + 1]: each layer's first line */
    double *heights;       /* [layer_count] */
    size_t point_count, line_count, layer_count;
} tn_slices;

void tn_slices_clear(tn_slices *slices);

/* Layers `thickness` high that fill what is between two heights, from below, each cut in its middle. No lines yet.
 * TN_INVALID (E1416) for a thickness that is no part of it. */
tn_status tn_slices_layers(double low, double high, double thickness, tn_slices *slices, tn_error *error);

/* Lines of the layers through a closed mesh of triangles, z up. A vertex at a layer's height counts as above it, so
 * that lines are closed for every mesh; they turn only where the mesh bends. */
tn_status tn_slices_of_mesh(const tn_mesh *mesh, double thickness, tn_slices *slices, tn_error *error);

/* Slices written to files: SVG, DXF and CLI (Common Layer Interface), whole stacks or layer by layer. */

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
