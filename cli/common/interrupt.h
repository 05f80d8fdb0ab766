/* Interrupts: SIGINT, SIGTERM and SIGHUP end every command within two seconds, and what is missing is said.
 *
 * The first signal sets a flag that loops look at (runtime/base/watch.h), and starts a clock. A command that has not
 * ended when the clock runs out is ended then and there, with its last words: output files are put in place whole or
 * not at all, and databases keep what was committed, so that this can be done at any moment. A second signal ends it at
 * once.
 */
#ifndef TARTAN_CLI_COMMON_INTERRUPT_H
#define TARTAN_CLI_COMMON_INTERRUPT_H

#include "cli/common/options.h"
#include "runtime/base/watch.h"

/* The limit of memory that every command has (--memory-limit; by default half of what is free when it starts).
 *
 * A thread measures what the process holds. Past the limit it stops the command's work as an interrupt would, so that
 * what was finished stays, and the job reports E0841. A command that goes on to take much more is ended from without.
 */

/* From now on the command's memory is limited: work that asks the watch of interrupts, and what does not. */
void tn_memory_guard_start(const tn_command *command, const tn_settings *settings);

/* Was the limit passed? */
bool tn_memory_guard_full(void);

/* The sentence about that, and what to do. */
void tn_memory_guard_describe(const tn_command *command, tn_error *error);

/* ---- signals */

/* From now on, signals are answered so. `json`: the last words are a diagnostic in JSON. */
void tn_interrupt_watch(bool json);

bool tn_interrupted(void);

/* Signals that only ask for an end in good order, as batch systems send them before time is up: from now on SIGUSR1 is
 * answered so, and SIGTERM too where `terminate` says it. They set the flag that is returned, which loops look at where
 * a piece of work is done; or, `within`, they stop the work itself as an interrupt does, but without a clock. A second
 * SIGTERM ends the program. */
const atomic_bool *tn_interrupt_gently(bool terminate, bool within);

/* The same as a status: TN_OK or TN_STOPPED. */
tn_status tn_interrupt_check(tn_error *error);

/* The watch that the signal ends, for work that is handed it. */
tn_watch *tn_interrupt_waiting(void);

/* What is said where the command is ended from without: what was written, and what is missing. */
void tn_interrupt_last_words(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Only what is finished is being put in place now, or nothing is lost by ending: the clock is stopped. */
void tn_interrupt_answered(void);

/* While a person is asked for a line, an interrupt ends the reading too: true before, false after. */
void tn_interrupt_asking(bool asking);

#endif
