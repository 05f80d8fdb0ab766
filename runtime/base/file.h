/* Whole files in, whole files out: reading with a limit, and writing beside the target and renaming,
 * so that a crash never leaves half a file. */
#ifndef TARTAN_BASE_FILE_H
#define TARTAN_BASE_FILE_H

#include <stdio.h>
#include <sys/stat.h>

#include "runtime/base/error.h"

/* Opens a file for reading; -1 and errno where that cannot be. A pipe is waited for until there is something to read:
 * what its writer wrote before it left is read too, as long as another end of the pipe kept it. */
int tn_file_open(const char *path);

/* The same, as a stream; NULL and errno. */
FILE *tn_file_stream(const char *path);

/* Reads a whole file ("-" is standard input) of at most `limit` bytes. The caller frees *bytes with
 * free(); a zero byte follows the contents and is not counted. E0901 unreadable (TN_IO), E0804 too large (TN_LIMIT). */
tn_status tn_file_read(const char *path, size_t limit, uint8_t **bytes, size_t *size, tn_error *error);

/* Makes a folder, where it is not there already. E0902 (TN_IO). */
tn_status tn_folder_make(const char *path, tn_error *error);

/* Sees all bytes that are written to a file, once they are, in their order. */
typedef struct tn_seen_bytes {
    void (*see)(void *context, const void *bytes, size_t size);
    void *context;
} tn_seen_bytes;

/* An output file under construction. */
typedef struct tn_output {
    FILE *stream;     /* write here */
    int file;         /* which the stream writes to */
    const char *path; /* the target, borrowed: must outlive the output; "-" is standard output */
    bool replaces;    /* a file, put in the target's place by the commit; others are written to directly */
    bool derived; /* set by the caller: made again where it is missing, so its name need not be on the disk at once */
    char *target; /* owned; what `path` names, links followed; NULL for standard output */
    char *temporary; /* owned; the file's name till then; NULL while it has none */
} tn_output;

/* Opens a temporary file in the folder of `path`: one without a name, where the system has that, so that nothing is
 * left of it when the program is killed. E0902 if that cannot be written. */
tn_status tn_output_open(const char *path, tn_output *output, tn_error *error);

/* The same; `written`, or NULL, sees what is written. It is copied, and its context outlives the output. */
tn_status tn_output_open_seen(const char *path, const tn_seen_bytes *written, tn_output *output, tn_error *error);

/* Flushes, syncs and renames it over its target. On failure the temporary file is removed and the target
 * stays as it was. A closed pipe on standard output is TN_IO with code 903. */
tn_status tn_output_commit(tn_output *output, tn_error *error);

/* Gives up: nothing is left of the temporary file. Harmless after a commit. */
void tn_output_discard(tn_output *output);

/* ---- has a file changed while it was read? What was read then may be of two files */

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

/* When it has ended: TN_IO (E0901) if the file is not as it was. */
static inline tn_status tn_file_state_same(const tn_file_state *before, int file, const char *path, tn_error *error)
{
    tn_file_state now = tn_file_state_of(file);
    if (!before->regular || (now.size == before->size && now.changed.tv_sec == before->changed.tv_sec &&
                             now.changed.tv_nsec == before->changed.tv_nsec))
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_READ, "%.300s was changed while it was read", path);
    tn_error_help(error, "make sure that no other program writes to it, and begin again");
    return TN_IO;
}

/* A path that a file names lies relative to that file. The caller frees it; NULL if out of memory. */
char *tn_file_beside(const char *file, const char *path);

/* What is said of a file that could not be read or written: why, and what to do about it, in plain words. */

/* E0901, TN_IO. `reason` is the errno of what failed. */
tn_status tn_cannot_read(const char *path, int reason, tn_error *error);

/* E0902, TN_IO; E0903 if the reader of a pipe went away; TN_MEMORY if memory was what lacked. A `reason` of 0 is
 * an input or output error. */
tn_status tn_cannot_write(const char *path, int reason, tn_error *error);

/* E0902, TN_IO: a folder that could not be made. */
tn_status tn_cannot_make(const char *path, int reason, tn_error *error);

#endif
