/* A file that is not there, named by its path or by a `use`: what to say, and which one was likely meant. And the paths
 * that a `use` stands for. */
#ifndef TARTAN_DRIVER_OPEN_MISSING_H
#define TARTAN_DRIVER_OPEN_MISSING_H

#include "compiler/common/compilation.h"
#include "driver/open/stdlib.h"
#include "runtime/base/error.h"

/* A file that is not there: which one was likely meant. */

/* Where no file `path` exists, puts the file of the same folder with the nearest name into the error's help. False
 * where there is none; then the help stays as it is. */
bool tn_suggest_file(const char *path, tn_error *error);

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
