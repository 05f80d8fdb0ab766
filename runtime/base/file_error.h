/* What is said of a file that could not be read or written: why, and what to do about it, in plain words. */
#ifndef TARTAN_BASE_FILE_ERROR_H
#define TARTAN_BASE_FILE_ERROR_H

#include "runtime/base/error.h"

/* E0901, TN_IO. `reason` is the errno of what failed. */
tn_status tn_cannot_read(const char *path, int reason, tn_error *error);

/* E0902, TN_IO; E0903 where the reader of a pipe went away; TN_MEMORY where memory was what lacked. A `reason` of 0 is
 * an input or output error. */
tn_status tn_cannot_write(const char *path, int reason, tn_error *error);

/* E0902, TN_IO: a folder that could not be made. */
tn_status tn_cannot_make(const char *path, int reason, tn_error *error);

#endif
