/* What the programs of these commands have in common: tartan, and tartan-mpi, in which several processes do a command.
 */
#ifndef TARTAN_CLI_COMMON_PROGRAM_H
#define TARTAN_CLI_COMMON_PROGRAM_H

#include "cli/common/options.h"
#include "runtime/ranks/ranks.h"

/* For the beginning of main: the standard descriptors are there, and signals about pipes and sizes show as errors. */
void tn_program_begin(void);

/* Reads the words behind the command's name, which is one of `commands`, and runs it, with those ranks (NULL: this
 * process alone). The exit code. */
int tn_program_run(const tn_commands *commands, const tn_command *command, int count, char **words,
                   const tn_ranks *ranks);

/* Says what is wrong with the command line. The exit code. */
int tn_program_refuse(const tn_settings *settings, const tn_error *error);

/* Ends what was printed to standard output: a full disk is an error, a closed pipe is not. The exit code. */
int tn_program_printed(void);

#endif
