/* From the rules of one or several .pcfg files to symbols that can be emitted: lines of one symbol are put together,
 * names found, terminals and probabilities read; and warnings about what is probably wrong. */
#ifndef TARTAN_COMPILER_PCFG_CHECK_H
#define TARTAN_COMPILER_PCFG_CHECK_H

#include "compiler/common/names.h"
#include "compiler/pcfg/ast.h"
#include "runtime/module/builder.h"

typedef struct tn_pcfg_symbol {
    const char *name;
    tn_span span; /* of its first rule's name */
    tn_pcfg_alternatives alternatives;
    uint32_t count;   /* of these */
    uint32_t index;   /* among all symbols */
    uint32_t emitted; /* among those that are reached */
    bool drawn;       /* by probability */
    bool reached;     /* from the start symbol */
    bool nullable;    /* may come to nothing */
    bool visited;     /* a mark of the search at hand */
} tn_pcfg_symbol;

typedef struct tn_pcfg_grammar {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_pcfg_symbol **symbols; /* in the order of their first rules; the first is the start symbol */
    uint32_t count;
    tn_names names;
    bool partial; /* other files may have the rules that this one lacks */
} tn_pcfg_grammar;

/* Puts the rules together and checks them. Out of memory is the arena's to remember. */
void tn_pcfg_check(tn_pcfg_grammar *grammar, const tn_pcfg_file *file);

/* Warns about what is allowed but probably wrong, in a grammar without errors (warn.c). */
void tn_pcfg_warn(const tn_pcfg_grammar *grammar);

/* Adds the grammar's records and code; `name` is what it is called (emit.c). */
void tn_pcfg_emit(const tn_pcfg_grammar *grammar, const char *name, size_t length, tn_builder *builder);

/* The symbol that an item names. */
static inline tn_pcfg_symbol *tn_pcfg_symbol_of(const tn_pcfg_grammar *grammar, const tn_pcfg_item *item)
{
    return grammar->symbols[item->step.index];
}

#endif
