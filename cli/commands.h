/* All commands (commands.def), for the programs that run them: what needs to know all is handed them by main. */
#ifndef TARTAN_CLI_COMMANDS_H
#define TARTAN_CLI_COMMANDS_H

#include "cli/common/options.h"

extern const tn_commands tn_all_commands;

#endif
