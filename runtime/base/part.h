/* Optional parts: what draws, reworks meshes, keeps databases and searches by libraries of others.
 *
 * A build may leave a part out (TARTAN_WITH_DRAW and so on). A program may leave it out of itself, too, and load it
 * when it is first needed (TARTAN_LOAD_PARTS): looking up the symbols of cairo, OpenMesh and SQLite takes three
 * quarters of the time that a small command takes. The part is then the shared library that is installed beside the
 * program: libtartan-draw, libtartan-mesh, libtartan-store, libtartan-search.
 *
 * A folder that is a part has a file loaded.c, which is linked in place of the others in both cases
 * (cmake/folder.cmake). Its functions find the real ones by their names, or fail. */
#ifndef TARTAN_BASE_PART_H
#define TARTAN_BASE_PART_H

#include "runtime/base/error.h"

typedef enum tn_optional_part { TN_WITH_DRAW, TN_WITH_MESH, TN_WITH_STORE, TN_WITH_SEARCH } tn_optional_part;

/* TN_INVALID (E0907): names the part, what wants it ("drawing pictures"), and how to get it. */
tn_status tn_part_absent(tn_optional_part part, const char *wanted, tn_error *error);

/* A function of a part by its name, to be cast to its type; loads the part if that was not done before. It stays loaded
 * until the program ends. NULL if it cannot be loaded, or is not of this build: the error is that of tn_part_absent. */
typedef void tn_part_function(void);
tn_part_function *tn_part_find(tn_optional_part part, const char *function, const char *wanted, tn_error *error);

/* The version of Tartan that a part's library is of; it is loaded by the program of the same version alone. */
const char *tn_part_version(void);

#endif
