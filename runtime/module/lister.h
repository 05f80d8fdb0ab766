/* What engines list their part of a module with (engine.h). Texts from the module are shortened and cleaned of what
 * would upset a terminal: a module from anywhere must not make the listing endless. */
#ifndef TARTAN_MODULE_LISTER_H
#define TARTAN_MODULE_LISTER_H

#include <stdio.h>

#include "runtime/module/engine.h"

/* The lines of a module's sources, for a listing that shows them beside the code: found when first needed. */

typedef struct tn_source_lines tn_source_lines;

tn_source_lines *tn_source_lines_new(const tn_module *module); /* NULL if out of memory */
void tn_source_lines_free(tn_source_lines *lines);

/* The line (from 0) of a source that holds a byte of it; false if out of memory. */
bool tn_source_line(tn_source_lines *lines, uint32_t source, uint32_t offset, size_t *line);

/* Where the text of a line that was found begins. */
const char *tn_source_line_text(const tn_source_lines *lines, uint32_t source, size_t line);

enum { TN_TEXT_SHOWN = 240 };

struct tn_lister {
    const tn_module *module;
    const tn_engines *engines;
    const tn_operand_rules *operands[TN_OPERANDS_COUNT];
    FILE *out;
    tn_source_lines *lines;
    uint32_t shown_file; /* the source line that was shown last */
    size_t shown_line;
    uint32_t function; /* whose instructions are being listed */
    bool failed;       /* out of memory */
};

void tn_list_text(tn_lister *lister, const char *text);
void tn_list_name(tn_lister *lister, tn_string name);

/* ` "what it is"`, or nothing if there is no text. */
void tn_list_doc(tn_lister *lister, tn_string doc);

/* Ends a line with where the record comes from. */
void tn_list_place(tn_lister *lister, uint32_t file, uint32_t begin);

/* A line of a record, field by field: "  boundary 0  kind sphere, mode slide ...". */
void tn_list_record(tn_lister *lister, tn_section section, uint32_t index);

/* "function 3 (holds pair)". */
void tn_list_function(tn_lister *lister, uint32_t function);

/* The instructions of a stretch of code, beside the source lines that they come from: those of the map, or that of the
 * one place of all. */
void tn_list_code(tn_lister *lister, uint32_t begin, uint32_t end, const tn_source_map_record *place);

/* ---- listing a module: tables, then each function's code beside the source lines it comes from. runtime/load.h does
 * it with all engines. */

/* Writes the listing to `out`; false if writing failed or memory ran out. */
bool tn_module_list(const tn_module *module, const tn_engines *engines, FILE *out);

/* The same, but only a record and the functions that it needs. */
bool tn_module_list_record(const tn_module *module, const tn_engines *engines, tn_section section, uint32_t index,
                           FILE *out);

#endif
