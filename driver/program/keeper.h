/* A process that stands by to clear up. It holds one end of a pipe; when the other end is gone, however the program
 * ended, it ends the groups of processes that it was told of and removes a folder. */
#ifndef TARTAN_DRIVER_PROGRAM_KEEPER_H
#define TARTAN_DRIVER_PROGRAM_KEEPER_H

#include <sys/types.h>

#include "runtime/base/error.h"

typedef struct tn_keeper {
    pid_t pid; /* 0: there is none */
    int pipe;
} tn_keeper;

/* Starts it for `slots` groups, none of which is there yet, and the folder, a path of its own. */
tn_status tn_keeper_start(unsigned slots, const char *folder, tn_keeper *keeper, tn_error *error);

/* Tells it which group is in a slot from now on; 0: none. By several threads at once. */
void tn_keeper_tell(const tn_keeper *keeper, unsigned slot, pid_t group);

/* Has it clear up, and waits for that. */
void tn_keeper_end(tn_keeper *keeper);

/* Removes a folder and all that is in it, as far as that can be. */
void tn_folder_remove(const char *path);

/* Writes without SIGPIPE: -1 and EPIPE where nobody reads. */
ssize_t tn_write_quietly(int file, const void *bytes, size_t size);

#endif
