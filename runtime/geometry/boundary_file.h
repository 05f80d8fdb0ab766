/* Boundary meshes from files that a rule file names. */
#ifndef TARTAN_GEOMETRY_BOUNDARY_FILE_H
#define TARTAN_GEOMETRY_BOUNDARY_FILE_H

#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/mesh.h"

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
