/* A rule file of the standard library, named as `use` names it: without folder and extension. */
#ifndef TARTAN_DRIVER_OPEN_STDLIB_FIND_H
#define TARTAN_DRIVER_OPEN_STDLIB_FIND_H

#include "runtime/base/error.h"

typedef struct tn_stdlib_file {
    char *path;     /* where it is; NULL where there is none */
    char *recorded; /* "<stdlib>/NAME.EXTENSION", the same wherever the standard library is installed */
} tn_stdlib_file;

/* Is it a name that can mean such a file: no folder, no extension, and no file of its own? */
bool tn_stdlib_may_mean(const char *name);

/* Looks for the name in the standard library's folders, with the extension of each notation. Clear in any case. */
tn_status tn_stdlib_find(const char *name, tn_stdlib_file *found, tn_error *error);
void tn_stdlib_file_clear(tn_stdlib_file *file);

/* Adds to the error that the file at `path` cannot be read which name of the standard library was likely meant, if
 * there is one. */
void tn_stdlib_suggest(const char *path, tn_error *error);

#endif
