/* Places of the language server protocol as JSON (compiler/common/source.h). */
#ifndef TARTAN_LSP_LINES_H
#define TARTAN_LSP_LINES_H

#include <jansson.h>

#include "compiler/common/source.h"

/* {"line", "character"} of a byte; {"start", "end"} of a stretch. */
json_t *tn_lines_position(const tn_lines *lines, size_t offset);
json_t *tn_lines_range(const tn_lines *lines, size_t begin, size_t end);

/* Reads a position; false where it is none. */
bool tn_lines_read(const tn_lines *lines, const json_t *position, size_t *offset);

#endif
