/* Looks for the first line of an OBJ file that cannot be meant: OpenMesh reads numbers that are none as 0, and of a
 * file whose faces name vertices that are not there it says nothing but that it failed. */
#ifndef TARTAN_MESH_OBJ_LINES_H
#define TARTAN_MESH_OBJ_LINES_H

#include "runtime/base/error.h"

/* TN_INVALID (E0901, with the number of the line in words) if a vertex has no three numbers, or a face names a
 * vertex that is not in the file; otherwise TN_OK, also where the file cannot be read: whoever reads it says so. */
tn_status tn_obj_check(const char *path, tn_error *error);

#endif
