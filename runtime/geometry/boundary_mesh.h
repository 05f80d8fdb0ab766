/* A triangle mesh as a boundary: a tree of boxes over its triangles, for the questions that moving vertices ask.
 *
 * A mesh whose edges all have two triangles is a solid, with an inside. Any other (a sheet, a mesh with holes) is a
 * membrane: it stops what crosses it from either side and has no inside.
 *
 * Immutable once built; may be shared between threads. Owns copies of what it was built from.
 */
#ifndef TARTAN_GEOMETRY_BOUNDARY_MESH_H
#define TARTAN_GEOMETRY_BOUNDARY_MESH_H

#include "runtime/base/error.h"
#include "runtime/geometry/mesh.h"
#include "runtime/geometry/vector.h"

#define TN_NO_TRIANGLE UINT32_MAX

typedef struct tn_boundary_mesh tn_boundary_mesh;

/* Builds from positions [vertex_count][3] and triangles [triangle_count][3]. Triangles without area are left out.
 * TN_INVALID if an index is out of range, a coordinate is not finite or nothing remains. */
tn_status tn_boundary_mesh_new(const double *positions, size_t vertex_count, const uint32_t *triangles,
                               size_t triangle_count, tn_boundary_mesh **mesh, tn_error *error);
void tn_boundary_mesh_free(tn_boundary_mesh *mesh);

bool tn_boundary_mesh_is_solid(const tn_boundary_mesh *mesh);

typedef struct tn_mesh_hit {
    double t;         /* along the segment, in [0, 1) */
    tn_vector normal; /* unit, towards the side that the segment comes from */
    uint32_t triangle;
} tn_mesh_hit;

/* The first triangle other than `except` that the segment from x to x + d meets, coming from the allowed side
 * (`inside`: of a solid; a membrane is met from either side); ties go to the lowest triangle. A start that is up to
 * 1e-9 behind a triangle counts as on it. */
bool tn_boundary_mesh_hit(const tn_boundary_mesh *mesh, bool inside, tn_vector x, tn_vector d, uint32_t except,
                          tn_mesh_hit *hit);

/* Signed distance of x (negative inside a solid; never negative for a membrane) and, where `nearest` is not NULL, the
 * nearest point. */
double tn_boundary_mesh_distance(const tn_boundary_mesh *mesh, tn_vector x, tn_vector *nearest);

/* A quick answer: is x so deep inside (sign < 0) or so far outside (sign > 0) that nothing within `reach` of it can
 * touch the mesh? False if that is not known without looking closer. */
bool tn_boundary_mesh_clear(const tn_boundary_mesh *mesh, tn_vector x, double reach, int *sign);

/* The corners of its triangles, three of each; *count: triangles. Borrowed. */
const tn_vector *tn_boundary_mesh_corners(const tn_boundary_mesh *mesh, size_t *count);

/* Of its shape, from `seed` on: two of the same triangles have the same. */
uint64_t tn_boundary_mesh_hash(const tn_boundary_mesh *mesh, uint64_t seed);

/* Boundary meshes from files that a rule file names. */

/* Reads mesh files: runtime/mesh has one (tn_openmesh_reader), where that part is there. */
typedef struct tn_mesh_reader {
    tn_status (*read)(void *context, const char *path, tn_mesh *mesh, tn_error *error);
    void *context;
} tn_mesh_reader;

/* The mesh that is called `name` beside the file that was opened, or else beside `source`, where the rules lay when
 * they were compiled. `what` and `rules` are for messages: a "boundary" of a "study". The caller frees the mesh. */
tn_status tn_boundary_mesh_find(const tn_mesh_reader *reader, const char *opened, const char *source, const char *name,
                                const char *what, const char *rules, tn_boundary_mesh **result, tn_error *error);

#endif
