/* One running program: its input, its answers line by line, and the end of what it says on standard error. Its files
 * never block. Used by one thread at a time. */
#ifndef TARTAN_DRIVER_PROGRAM_PROCESS_H
#define TARTAN_DRIVER_PROGRAM_PROCESS_H

#include <sys/types.h>

#include "runtime/base/error.h"

#define TN_ANSWER_BYTES 65536u /* the longest line that is an answer */

/* Zero it to begin with: nothing runs. */
typedef struct tn_process {
    pid_t pid; /* and its group; 0: none */
    int in, out, err;
    char *unread; /* [TN_ANSWER_BYTES]: what came, and was not taken; owned */
    size_t unread_size;
    char said[240]; /* the end of what it said on standard error */
    size_t said_size;
    bool over; /* its output has ended */
} tn_process;

/* Runs the file at `path`, a whole path, in its folder, as a group of its own. E1254 (TN_IO) where that fails. */
tn_status tn_process_start(const char *path, tn_process *process, tn_error *error);

/* Waits at most so many milliseconds for answers, and, with `writes`, for room in its input; takes in what comes. */
void tn_process_wait(tn_process *process, bool writes, int milliseconds);

/* Writes as much as there is room for: how many bytes. It is no error here if nobody reads them: that shows in the
 * answers. */
size_t tn_process_write(tn_process *process, const char *bytes, size_t size);

/* The line that has come first, without its end; NULL where none is whole. Take it before the next call. A line without
 * an end counts where the output has ended. */
const char *tn_process_line(const tn_process *process, size_t *size);
void tn_process_take(tn_process *process, size_t size);

/* A line that is longer than an answer can be has come. */
bool tn_process_overlong(const tn_process *process);

/* Closes its input, by which it knows that nothing more is asked. */
void tn_process_close(tn_process *process);

/* Closes its input, and waits a moment for its end if it is polite; then ends its group. Its exit status, as waitpid
 * gives it. */
int tn_process_end(tn_process *process, bool polite);

/* The last line that it said on standard error, in `room` bytes; empty where it said nothing. */
void tn_process_last_words(const tn_process *process, char *text, size_t room);

#endif
