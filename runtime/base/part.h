/* The parts that a build may leave out, and the error of whoever asks for one that is not there.
 *
 * A folder that is a part has a file absent.c, which is built in place of the others where the part is left out
 * (cmake/folder.cmake): its functions fail with this error.
 */
#ifndef TARTAN_BASE_PART_H
#define TARTAN_BASE_PART_H

#include "runtime/base/error.h"

typedef enum tn_optional_part { TN_WITH_DRAW, TN_WITH_MESH, TN_WITH_STORE } tn_optional_part;

/* TN_INVALID (E0907), naming the part, what wants it ("drawing pictures"), and how to get it. */
tn_status tn_part_absent(tn_optional_part part, const char *wanted, tn_error *error);

#endif
