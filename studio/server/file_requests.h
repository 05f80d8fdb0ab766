/* What a window asks about files: which there are, their texts, writing one, and being told when one that it shows is
 * changed by somebody else.
 *
 *   tartan/files {}                     {"folder", "readOnly", "open", "files": [{"path", "size", "notation"}], "cut"}
 *   tartan/read  {"path"}               {"path", "text", "hash"}
 *   tartan/write {"path", "text", "hash": the one last seen, null for a new file}      {"path", "hash"}
 *   tartan/watch {"paths": [{"path", "hash"}]}      null; from then on notifications tartan/changed {"path", "hash"}
 *
 * Paths are below the folder, without a first slash. A window's, on one thread. */
#ifndef TARTAN_STUDIO_SERVER_FILE_REQUESTS_H
#define TARTAN_STUDIO_SERVER_FILE_REQUESTS_H

#include <jansson.h>

#include "studio/server/folder.h"

enum { TN_WATCHED_MAX = 256 }; /* files of a window */

typedef struct tn_watched_file {
    char *name;
    tn_file_hash hash; /* that the window knows of */
    tn_file_stamp stamp;
} tn_watched_file;

typedef struct tn_file_requests {
    tn_studio_folder *folder; /* borrowed */
    const char *open;         /* the file that the command line named, or NULL; borrowed */
    tn_watched_file watched[TN_WATCHED_MAX];
    size_t watched_count;
} tn_file_requests;

void tn_file_requests_clear(tn_file_requests *requests);

/* Is it one of these methods? */
bool tn_file_requests_takes(const char *method);

/* Answers a message of such a method, which stays the caller's. The answer is the caller's; NULL: it wants none, or out
 * of memory. */
json_t *tn_file_requests_answer(tn_file_requests *requests, const json_t *message);

/* Looks at what is watched, from the file *next on (0 to begin with). The notification for the next that has changed is
 * the caller's; NULL: no other has. */
json_t *tn_file_requests_changed(tn_file_requests *requests, size_t *next);

/* That notification for another file, whose hash the window does not know; NULL if it is watched, or out of memory. */
json_t *tn_file_requests_tell(const tn_file_requests *requests, const char *name);

#endif
