/* Interrupting long work: after Ctrl-C (or a polite kill, or when the terminal is closed) the loop that asks ends, so
 * that what was finished stays. */
#ifndef TARTAN_CLI_COMMON_INTERRUPT_H
#define TARTAN_CLI_COMMON_INTERRUPT_H

#include <stdbool.h>

/* From here on SIGINT, SIGTERM and SIGHUP are taken note of instead of ending the program; a second one ends it. One
 * that was ignored stays so (nohup). */
void tn_interrupt_watch(void);

bool tn_interrupted(void);

/* While a person is asked for a line, an interrupt ends the reading too: true before, false after. */
void tn_interrupt_asking(bool asking);

#endif
