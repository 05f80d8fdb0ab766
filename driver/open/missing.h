/* A `use` that leads to no file: what to say, and what was likely meant. And the paths that a `use` stands for. */
#ifndef TARTAN_DRIVER_OPEN_MISSING_H
#define TARTAN_DRIVER_OPEN_MISSING_H

#include "compiler/common/compilation.h"
#include "driver/open/stdlib_dirs.h"

/* Is it a name of the standard library: without folder and extension? */
bool tn_path_is_bare(const char *path);

/* Is there something to read? What it is (a folder, a file that may not be read) reading will say. */
bool tn_path_exists(const char *path);

/* "FOLDER/NAMEEXTENSION", and a path relative to the folder of the file `user`. The caller frees them; NULL where out
 * of memory. */
char *tn_path_join(const char *folder, const char *name, const char *extension);
char *tn_path_beside(const char *user, const char *path, const char *extension);

/* Fills the error (E0101) for a request that leads to no file, and returns its status. `meant` (compilation.h) is
 * given the path that was likely meant, where there is one. */
tn_status tn_missing(const tn_stdlib_dirs *dirs, const tn_request *request, char *meant, tn_error *error);

#endif
