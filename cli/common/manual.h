/* Manual pages (man), written from the tables of options.h: what `tartan help --man` prints and the build installs. */
#ifndef TARTAN_CLI_COMMON_MANUAL_H
#define TARTAN_CLI_COMMON_MANUAL_H

#include "cli/common/options.h"

/* tartan(1) */
void tn_manual_overview(FILE *out);

/* tartan-COMMAND(1) */
void tn_manual_command(const tn_command *command, FILE *out);

#endif
