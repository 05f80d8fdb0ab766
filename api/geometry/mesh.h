/* What the files of the C interface to meshes share. */
#ifndef TARTAN_API_GEOMETRY_MESH_H
#define TARTAN_API_GEOMETRY_MESH_H

#include "api/base/api.h"
#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/write.h"

struct tartan_mesh {
    tn_mesh mesh;
    tn_mesh_unit unit; /* what a unit of length is, for formats that say it */
};

/* A mesh under its public type, which takes it over in any case. */
tartan_status tn_api_mesh(tn_mesh *made, tartan_mesh **mesh, tartan_error *error);

/* The caller's reader of mesh files as the engines take one; *read may be NULL, and reading then says so. It stays the
 * caller's, and there until the reading is done. */
tn_mesh_reader tn_api_mesh_reader(tartan_mesh_reader **read);

#endif
