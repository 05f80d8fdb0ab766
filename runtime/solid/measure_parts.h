/* What the files that measure designs share. Internal to runtime/solid. */
#ifndef TARTAN_SOLID_MEASURE_PARTS_H
#define TARTAN_SOLID_MEASURE_PARTS_H

#include "runtime/geometry/mesh.h"
#include "runtime/solid/measure.h"

/* The area of the silhouette along an axis. */
tn_status tn_built_shadow(const tn_built *built, int axis, double *area, tn_error *error);

/* The part of the plan's area whose highest surface is not level: it rises by more than `level`. */
tn_status tn_built_sloping(const tn_built *built, double level, double *area, tn_error *error);

/* The area of a mesh's faces that look down by more than 45 degrees and do not lie on the ground. */
double tn_mesh_overhang(const tn_mesh *mesh, double ground, double level);

#endif
