/* Mesh files: what is done to a mesh before it is written, and who writes which format. */
#ifndef TARTAN_DRIVER_MESH_MESH_FILE_H
#define TARTAN_DRIVER_MESH_MESH_FILE_H

#include "driver/open/open.h"
#include "runtime/base/formats.h"
#include "runtime/geometry/write.h"

/* Each of these is left out if it is 0. */
typedef struct tn_mesh_changes {
    unsigned subdivide, smooth; /* rounds */
    size_t decimate;            /* triangles */
    bool triangulate;
} tn_mesh_changes;

/* Does these in this order, and what the format needs; TN_FILE_OTHER needs nothing. If more triangles are left than
 * were asked for, a note of the file says so. TN_INVALID if the mesh is no surface (E0845), TN_MEMORY. */
tn_status tn_mesh_change(tn_opened *opened, const tn_mesh_changes *changes, tn_file_format format, tn_mesh *mesh,
                         tn_error *error);

/* Writes the mesh: OBJ, PLY, GLB, 3MF, DXF, SCAD, STL, OFF or OM. What cannot be written shows when the file is
 * closed. */
tn_status tn_mesh_file_write(const tn_mesh *mesh, tn_file_format format, const tn_mesh_style *style, FILE *out,
                             tn_error *error);

#endif
