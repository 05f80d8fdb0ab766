/* What measures come to over the libraries of a module, for hovering. Owns its texts. */
#ifndef TARTAN_LSP_MEASURES_H
#define TARTAN_LSP_MEASURES_H

#include <stdio.h>

#include "lsp/index.h"
#include "runtime/plan/library/library.h"

typedef struct tn_measure_fact {
    char *library, *measure;
    char *text; /* "146.88 m2 to 248.4 m2, 229.396 m2 on average" */
} tn_measure_fact;

typedef struct tn_measure_facts {
    tn_measure_fact *items;
    size_t count, capacity;
} tn_measure_facts;

/* Adds every measure of the library's trays; one that passes a limit is left out. `index`: of the LIBRARY record. */
void tn_measure_facts_add(tn_measure_facts *facts, const tn_module *module, const tn_library *library, uint32_t index);
void tn_measure_facts_clear(tn_measure_facts *facts);

/* Those of a measure over each library, or of a library by each measure, as items of a Markdown list. */
void tn_measure_facts_write(const tn_measure_facts *facts, const tn_symbol *symbol, FILE *out);

#endif
