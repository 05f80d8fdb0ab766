/* Asks OpenMesh whether a mesh is a surface. */
#ifndef TARTAN_TESTS_OPENMESH_TAKES_H
#define TARTAN_TESTS_OPENMESH_TAKES_H

#include <stdbool.h>
#include <stdlib.h>

#include "runtime/base/error.h"
#include "runtime/mesh/openmesh.h"

/* Does OpenMesh take every face? Yes in a build without it, which tests nothing. */
static inline bool openmesh_takes(const tn_mesh *mesh)
{
    unsigned char *bytes;
    size_t size;
    tn_error error = {0};
    tn_status status = tn_openmesh_write(mesh, TN_FILE_OM, false, &bytes, &size, &error);
    free(bytes);
    return status == TN_OK || error.code == E_PART_ABSENT;
}

#endif
