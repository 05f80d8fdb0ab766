/* The lines of a module's sources, for a listing that shows them beside the code: found when first needed. */
#ifndef TARTAN_MODULE_DISASM_LINES_H
#define TARTAN_MODULE_DISASM_LINES_H

#include "runtime/module/module.h"

typedef struct tn_source_lines tn_source_lines;

tn_source_lines *tn_source_lines_new(const tn_module *module); /* NULL where out of memory */
void tn_source_lines_free(tn_source_lines *lines);

/* The line (from 0) of a source that holds a byte of it; false where out of memory. */
bool tn_source_line(tn_source_lines *lines, uint32_t source, uint32_t offset, size_t *line);

/* Where the text of a line that was found begins. */
const char *tn_source_line_text(const tn_source_lines *lines, uint32_t source, size_t line);

#endif
