/* Help and manual pages (man), written from the tables of options.h. */
#ifndef TARTAN_CLI_COMMON_HELP_H
#define TARTAN_CLI_COMMON_HELP_H

#include "cli/common/options.h"

/* ---- manual pages (man), written from the tables of options.h */

/* tartan(1) */
void tn_manual_overview(const tn_commands *commands, FILE *out);

/* tartan-COMMAND(1) */
void tn_manual_command(const tn_command *command, FILE *out);

/* What `tartan` alone and `tartan help` show: the commands. */
void tn_help_overview(const tn_commands *commands, FILE *out);

/* What `tartan help COMMAND` and `tartan COMMAND --help` show. */
void tn_help_command(const tn_command *command, FILE *out);

#endif
