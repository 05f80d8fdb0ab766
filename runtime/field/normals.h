/* Normals of a field's mesh, by differentiation. */
#ifndef TARTAN_FIELD_NORMALS_H
#define TARTAN_FIELD_NORMALS_H

#include "runtime/field/field.h"
#include "runtime/geometry/mesh.h"

/* The unit gradient at each vertex, [vertex_count][3]. Where the vertex is not on the surface (where the box closes the
 * form, and at jumps), or the gradient has no value or is below 1e-9 of the median, the mean of the faces' normals.
 * spacing: of the grid. The caller frees them. TN_MEMORY. */
tn_status tn_field_normals(const tn_field *field, const tn_mesh *mesh, double spacing, double **normals,
                           tn_error *error);

/* The gradient at a vertex, and its size: 0 where it says nothing about the surface. registers: room for four times
 * field->samples.register_count. */
double tn_field_slope(const tn_field *field, const double *vertex, double spacing, double *registers,
                      double gradient[3]);

#endif
