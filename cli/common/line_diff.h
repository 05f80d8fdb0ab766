/* What changed between two texts, in lines, as patch reads it. */
#ifndef TARTAN_CLI_COMMON_LINE_DIFF_H
#define TARTAN_CLI_COMMON_LINE_DIFF_H

#include <stdbool.h>
#include <stdio.h>

/* Writes the unified difference, with three lines around each change; nothing where the texts are equal. Texts are
 * zero-ended. how: what the new one is called, "formatted". False where out of memory. */
bool tn_line_diff(const char *path, const char *how, const char *old_text, const char *new_text, FILE *out);

#endif
