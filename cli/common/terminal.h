/* Standard output on a terminal: what came from a file does not get to tell the terminal what to do.
 *
 * Files keep their bytes. On a terminal, control characters (but for line ends and tabs), those of C1 and the ones that
 * turn the direction of text are written as escapes, \x1b and \u202e, whatever the command and the format. That is so
 * with GNU's C library; others do not let a program replace its standard output, and nothing is changed there. */
#ifndef TARTAN_CLI_COMMON_TERMINAL_H
#define TARTAN_CLI_COMMON_TERMINAL_H

/* To be called once, before anything is written. */
void tn_terminal_guard(void);

#endif
