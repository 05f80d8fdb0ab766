/* The limit of memory that every command has (--memory-limit; by default half of what is free when it starts).
 *
 * A thread measures what the process holds. Past the limit it stops the command's work as an interrupt would, so that
 * what was finished stays, and the job reports E0841. A command that goes on to take much more is ended from without.
 */
#ifndef TARTAN_CLI_COMMON_MEMORY_GUARD_H
#define TARTAN_CLI_COMMON_MEMORY_GUARD_H

#include "cli/common/options.h"

/* From now on the command's memory is limited: work that asks the watch of interrupts, and what does not. */
void tn_memory_guard_start(const tn_command *command, const tn_settings *settings);

/* Was the limit passed? */
bool tn_memory_guard_full(void);

/* The sentence about that, and what to do. */
void tn_memory_guard_describe(const tn_command *command, tn_error *error);

#endif
