/* A file that is not there: which one was likely meant. */
#ifndef TARTAN_DRIVER_OPEN_SUGGEST_FILE_H
#define TARTAN_DRIVER_OPEN_SUGGEST_FILE_H

#include "runtime/base/error.h"

/* Where no file `path` exists, puts the file of the same folder with the nearest name into the error's help. False
 * where there is none; then the help stays as it is. */
bool tn_suggest_file(const char *path, tn_error *error);

#endif
