/* The texts that `tartan new` writes. */
#ifndef TARTAN_CLI_SOURCE_STARTS_H
#define TARTAN_CLI_SOURCE_STARTS_H

#define TN_START_NAMES "own|lahave|terrace"

extern const char *const tn_starts[]; /* in the order of the names */

#endif
