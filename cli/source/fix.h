/* Applies to a rule file what its diagnostics suggest, as editors do: every replacement of a place in the file itself.
 */
#ifndef TARTAN_CLI_SOURCE_FIX_H
#define TARTAN_CLI_SOURCE_FIX_H

#include "cli/common/job.h"

/* Shows what would change as a difference, and writes the file where `yes` says so or a person at the terminal does.
 * The file is replaced whole. What is wrong with it is left for the caller to say. False: do not go on. */
bool tn_fix_file(tn_job *job, const char *path, bool yes);

#endif
