/* How thick a closed mesh is: from the middle of each triangle straight inward to where the form ends. */
#ifndef TARTAN_GEOMETRY_THICKNESS_H
#define TARTAN_GEOMETRY_THICKNESS_H

#include "runtime/geometry/mesh.h"

typedef struct tn_thickness {
    double least;
    double hundredth; /* a hundredth of the surface, by area, is thinner */
} tn_thickness;

/* Of a closed mesh of triangles, counter-clockwise from outside. Both are 0 where it has no triangles. TN_OK or
 * TN_MEMORY. */
tn_status tn_mesh_thickness(const tn_mesh *mesh, tn_thickness *thickness, tn_error *error);

#endif
