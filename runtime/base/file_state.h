/* Has a file changed while it was read? What was read then may be of two files. */
#ifndef TARTAN_BASE_FILE_STATE_H
#define TARTAN_BASE_FILE_STATE_H

#include <sys/stat.h>

#include "runtime/base/error.h"

typedef struct tn_file_state {
    bool regular; /* others, such as pipes, have no state */
    off_t size;
    struct timespec changed;
} tn_file_state;

/* Of the open file, when reading begins. */
static inline tn_file_state tn_file_state_of(int file)
{
    struct stat known;
    if (fstat(file, &known) != 0 || !S_ISREG(known.st_mode))
        return (tn_file_state){0};
    return (tn_file_state){true, known.st_size, known.st_mtim};
}

/* When it has ended: TN_IO (E0901) where the file is not as it was. */
static inline tn_status tn_file_state_same(const tn_file_state *before, int file, const char *path, tn_error *error)
{
    tn_file_state now = tn_file_state_of(file);
    if (!before->regular || (now.size == before->size && now.changed.tv_sec == before->changed.tv_sec &&
                             now.changed.tv_nsec == before->changed.tv_nsec))
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_READ, "%.300s was changed while it was read", path);
    tn_error_help(error, "see that nobody writes to it, and begin again");
    return TN_IO;
}

#endif
