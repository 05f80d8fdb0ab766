/* Parameter files of PonyGE2, `POPULATION_SIZE: 500` a line, as studies. */
#ifndef TARTAN_DRIVER_PONYGE_PONYGE_H
#define TARTAN_DRIVER_PONYGE_PONYGE_H

#include <stddef.h>

#include "runtime/base/error.h"

/* The text of a study that says what the parameters at `path` say, and which of them do not apply ("CACHE, VERBOSE"; or
 * empty). Grammars and data are looked for beside the file, and in folders `grammars` and `datasets` beside its folder
 * or in it. Both are the caller's to free. TN_INVALID (E1231, E1232) with the line. */
tn_status tn_ponyge_study(const char *path, const char *text, size_t size, char **study, char **ignored,
                          tn_error *error);

#endif
