/* What the names in a compilation's files mean, and where they stand: from the syntax trees, so that a file with errors
 * has an index too. Lives in the compilation's arena. */
#ifndef TARTAN_LSP_INDEX_H
#define TARTAN_LSP_INDEX_H

#include "compiler/compile.h"
#include "compiler/plan/check/check.h"

typedef enum tn_symbol_kind {
    TN_SYMBOL_SCHEMA,
    TN_SYMBOL_FIELD,
    TN_SYMBOL_VALUE,
    TN_SYMBOL_RULE,
    TN_SYMBOL_LIBRARY,
    TN_SYMBOL_CLAUSE, /* `prune ... as NAME` */
    TN_SYMBOL_MEASURE,
    TN_SYMBOL_PARAM,
    TN_SYMBOL_FORM,
    TN_SYMBOL_STOREY,
    TN_SYMBOL_FUNCTION,
    TN_SYMBOL_OPENING, /* a flight of stairs, too */
    TN_SYMBOL_TILE,
    TN_SYMBOL_LAYER,  /* of walls, partitions and decks; all of a name are one */
    TN_SYMBOL_CHOICE, /* of a section; a zone's is called "body roof" */
} tn_symbol_kind;

typedef struct tn_symbol {
    struct tn_symbol *next;
    tn_symbol_kind kind;
    const char *name, *doc; /* doc may be NULL */
    tn_span name_span, span;
    const struct tn_symbol *parent; /* of a field its schema, of a value its field, of a clause its library, of a
                                       storey, function, opening, tile, layer or choice its form */
    const struct tn_symbol *schema; /* of a rule, measure, library or form, or what a schema is made from; NULL: none,
                                       or not known */
    const struct tn_symbol *form;   /* of a rule, measure or library about houses; NULL: none, or not known */
    const tn_ast_node *ast;
} tn_symbol;

typedef struct tn_occurrence {
    tn_span span;
    const tn_symbol *symbol;
} tn_occurrence;

typedef struct tn_index {
    tn_arena *arena;
    tn_symbol *first, *last;      /* all symbols, in the order of files and text */
    const tn_symbol *last_schema; /* of those, or NULL */
    tn_occurrence *occurrences;
    size_t count, capacity;
    const tn_symbol *last_form;
    tn_names schemas, forms, names, clauses; /* names: rules, measures, params and libraries */
} tn_index;

/* Does nothing where there is nothing to index. False where out of memory. */
bool tn_index_build(tn_index *index, const tn_compilation *compilation);

/* The occurrence at a byte of a file (or just before it); NULL where there is none. */
const tn_occurrence *tn_index_at(const tn_index *index, uint32_t file, size_t offset);

/* Of a schema; NULL where it has none of that name. A value is looked for in one field, or, where that is NULL, in the
 * one field that has it. */
const tn_symbol *tn_index_field(const tn_symbol *schema, const char *name);

/* The schema that a specifier in a rule or library of that name is about; else the last schema there is; or NULL. */
const tn_symbol *tn_index_schema(const tn_index *index, const char *owner);

#endif
