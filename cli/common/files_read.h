/* The files that a command has read, and whether they have changed since: for --watch.
 *
 * They are looked at five times a second, by name: so it does not matter whether an editor writes into a file or puts
 * another one in its place, and it works on every file system.
 */
#ifndef TARTAN_CLI_COMMON_FILES_READ_H
#define TARTAN_CLI_COMMON_FILES_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

#include "cli/common/options.h"

/* All zero: none yet. Owns the names. */
typedef struct tn_files_read {
    struct tn_file_seen *files;
    size_t count, capacity;
} tn_files_read;

void tn_files_read_clear(tn_files_read *read);

/* Does nothing where it is there already, is no file, or memory is out. */
void tn_files_read_add(tn_files_read *read, const char *path);

/* Runs a command, and again whenever a file that it has read changes, until it is interrupted. `once` adds what it
 * reads and returns an exit code. Returns the last one; the interrupt itself is no failure, but where it cuts a run
 * short. */
int tn_watch_files(const tn_settings *settings, int (*once)(const tn_settings *settings, tn_files_read *read));

#endif
