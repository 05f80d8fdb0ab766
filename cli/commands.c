#include "cli/commands.h"

#define COMMAND(NAME) extern const tn_command tn_command_##NAME;
#include "cli/commands.def"
#undef COMMAND

static const tn_command *const items[] = {
#define COMMAND(NAME) &tn_command_##NAME,
#include "cli/commands.def"
#undef COMMAND
};

const tn_commands tn_all_commands = {items, OPTION_COUNT(items)};
