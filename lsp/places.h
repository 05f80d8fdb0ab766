/* What the declarations of forms come to, for hovering: in which cells a function may be, where a tile fits, which
 * faces an opening may be in. Owns its texts. */
#ifndef TARTAN_LSP_PLACES_H
#define TARTAN_LSP_PLACES_H

#include <stdio.h>

#include "lsp/index.h"
#include "runtime/module/module.h"

typedef struct tn_place_fact {
    tn_symbol_kind kind;
    char *form, *name;
    char *text; /* items of a Markdown list */
} tn_place_fact;

typedef struct tn_place_facts {
    tn_place_fact *items;
    size_t count, capacity;
} tn_place_facts;

/* Adds what every form of the module declares. A form with too many trays to go through is left out. Ends early as the
 * module's watch says. */
void tn_place_facts_add(tn_place_facts *facts, const tn_module *module);
void tn_place_facts_clear(tn_place_facts *facts);

/* What there is about a form or a part of one. */
void tn_place_facts_write(const tn_place_facts *facts, const tn_symbol *symbol, FILE *out);

#endif
