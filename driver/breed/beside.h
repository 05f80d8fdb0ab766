/* Files that a study names. */
#ifndef TARTAN_DRIVER_BREED_BESIDE_H
#define TARTAN_DRIVER_BREED_BESIDE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A path that a study names lies relative to the study. The caller frees it; NULL where out of memory. */
static inline char *tn_study_beside(const char *study, const char *path)
{
    const char *slash = path[0] == '/' ? NULL : strrchr(study, '/');
    size_t folder = slash ? (size_t)(slash - study) + 1 : 0, size = folder + strlen(path) + 1;
    char *joined = malloc(size);
    if (joined)
        snprintf(joined, size, "%.*s%s", (int)folder, study, path);
    return joined;
}

#endif
