/* OpenMesh behind a C face: reading any mesh file that it knows, writing OFF, STL and OM, and its algorithms.
 *
 * Nothing of OpenMesh reaches the caller: no exceptions, nothing on standard error.
 */
#ifndef TARTAN_MESH_OPENMESH_H
#define TARTAN_MESH_OPENMESH_H

#include "runtime/base/formats.h"
#include "runtime/geometry/boundary_mesh.h"

/* Reads OBJ, PLY, STL, OFF or OM. OpenMesh splits vertices where faces meet otherwise than on a surface; they are
 * welded again. E0901 if the file cannot be read; TN_INVALID if it is no mesh. */
tn_status tn_openmesh_read(const char *path, tn_mesh *mesh, tn_error *error);

/* The same for whoever takes a reader. */
extern const tn_mesh_reader tn_openmesh_reader;

/* The file's bytes, which the caller frees with free(): OFF, STL or OM. STL is triangles, binary. */
tn_status tn_openmesh_write(const tn_mesh *mesh, tn_file_format format, bool y_up, unsigned char **bytes, size_t *size,
                            tn_error *error);

/* Jacobi Laplace smoothing; the outline stays. */
tn_status tn_openmesh_smooth(tn_mesh *mesh, unsigned iterations, tn_error *error);

/* Catmull-Clark for polygons, Loop where all faces are triangles; each round makes four faces of one. */
tn_status tn_openmesh_subdivide(tn_mesh *mesh, unsigned rounds, tn_error *error);

/* Quadric decimation of triangles (others are cut up first) to about `faces`. */
tn_status tn_openmesh_decimate(tn_mesh *mesh, size_t faces, tn_error *error);

#endif
