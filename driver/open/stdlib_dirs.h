/* Where `use "name"` looks: the folders of $TARTAN_PATH (separated by colons), `stdlib` beside the executable (the
 * build tree), `../share/tartan/stdlib` from it (an installed tree, wherever it was moved), and the configured prefix.
 */
#ifndef TARTAN_DRIVER_OPEN_STDLIB_DIRS_H
#define TARTAN_DRIVER_OPEN_STDLIB_DIRS_H

#include "runtime/base/error.h"

typedef struct tn_stdlib_dirs {
    char **dirs;
    size_t count;
} tn_stdlib_dirs;

/* Clear in any case. */
tn_status tn_stdlib_dirs_find(tn_stdlib_dirs *found, tn_error *error);
void tn_stdlib_dirs_clear(tn_stdlib_dirs *found);

#endif
