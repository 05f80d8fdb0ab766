/* What the files of the served folder's module share. */
#ifndef TARTAN_STUDIO_SERVER_FOLDER_PARTS_H
#define TARTAN_STUDIO_SERVER_FOLDER_PARTS_H

#include <pthread.h>
#include <sys/types.h>

#include "studio/server/folder.h"

struct tn_studio_folder {
    int root; /* the folder's descriptor */
    bool read_only;
    bool walks; /* the kernel has no openat2 */
    char *path;
    pthread_mutex_t writing; /* one writer at a time compares and renames */
};

/* Opens what `name` says below the folder; -1 and errno. EXDEV: it lies outside. */
int tn_open_below(const tn_studio_folder *folder, const char *name, int flags);

/* Reads an open file. 0, or why not: ENODEV or EISDIR if it is none that holds text, EFBIG if it is larger than the
 * limit. */
int tn_read_regular(int file, size_t limit, uint8_t **bytes, size_t *size);

#endif
