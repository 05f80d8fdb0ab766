/* Hidden lines: what of a mesh's creases is seen from far away.
 *
 * Each crease is compared with each triangle that faces the eye: exact within `tolerance`, and quadratic where all lie
 * over one another, so this is for meshes of some ten thousand triangles.
 */
#ifndef TARTAN_GEOMETRY_VISIBLE_H
#define TARTAN_GEOMETRY_VISIBLE_H

#include "runtime/geometry/mesh.h"
#include "runtime/geometry/render.h"

/* From the eye: to the right, up, and towards it. */
typedef struct tn_seen_line {
    double from[3], to[3];
    uint32_t face;  /* one of the two triangles that meet there: where only one faces the eye, that */
    uint32_t other; /* the other one, if it faces the eye, too; or `face` again */
} tn_seen_line;

/* The lines of a closed mesh of triangles: parts of creases that no triangle hides. What lies nearer behind a triangle
 * than the tolerance is not hidden by it. The caller frees *lines, also after a failure. TN_MEMORY. */
tn_status tn_mesh_visible(const tn_mesh *mesh, const tn_eye *eye, double tolerance, tn_seen_line **lines, size_t *count,
                          tn_error *error);

#endif
