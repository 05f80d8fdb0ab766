/* Named pipes among a command's operands: opening one waits for whoever writes to it, without a word. */
#ifndef TARTAN_CLI_COMMON_PIPES_H
#define TARTAN_CLI_COMMON_PIPES_H

#include "cli/common/options.h"

/* For a person at a terminal: waits a second for something to come from each pipe, and says so where nothing does.
 * Nothing is read. */
void tn_pipes_announce(const tn_settings *settings);

#endif
