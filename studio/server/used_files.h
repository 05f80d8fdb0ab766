/* The files that a window's texts use, which need not be open in it: what was read for it is noted, so that it can be
 * told when somebody changes one. Several threads may read. */
#ifndef TARTAN_STUDIO_SERVER_USED_FILES_H
#define TARTAN_STUDIO_SERVER_USED_FILES_H

#include <pthread.h>

#include "studio/server/folder.h"

enum { TN_USED_MAX = 256 }; /* files that are noted; of more, changes show when a text is changed */

typedef struct tn_used_file {
    char *name; /* below the folder */
    tn_file_stamp stamp;
} tn_used_file;

typedef struct tn_used_files {
    tn_studio_folder *folder; /* borrowed */
    pthread_mutex_t lock;
    tn_used_file files[TN_USED_MAX];
    size_t count;
} tn_used_files;

void tn_used_files_begin(tn_used_files *used, tn_studio_folder *folder);
void tn_used_files_clear(tn_used_files *used);

/* The folder for those who compile, with what they read noted. */
tn_served tn_used_files_served(tn_used_files *used);

/* Looks at the files from *next on (0 to begin with). The name of the next that has changed since it was read, or since
 * the last look; the caller frees it. NULL: no other has, or out of memory. */
char *tn_used_files_changed(tn_used_files *used, size_t *next);

bool tn_used_files_any(tn_used_files *used);

#endif
