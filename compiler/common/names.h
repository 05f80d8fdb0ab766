/* A table from texts to pointers, which lives in an arena and borrows the texts; and how long a name may be. */
#ifndef TARTAN_COMPILER_COMMON_NAMES_H
#define TARTAN_COMPILER_COMMON_NAMES_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "runtime/base/hash_table.h"

typedef struct tn_name_entry {
    const char *text;
    void *value;
} tn_name_entry;

typedef struct tn_names {
    tn_arena *arena;
    tn_name_entry *entries;
    size_t capacity, count;
    tn_hash_table index; /* by their texts; in the arena */
} tn_names;

void *tn_names_get(const tn_names *names, const char *text); /* NULL if it is not there */

/* Adds or replaces. Does nothing if out of memory, which the arena remembers. */
void tn_names_put(tn_names *names, const char *text, void *value);

/* False if a name is longer than a module holds: then reported. */
bool tn_name_fits(tn_diagnostics *diagnostics, const char *name, tn_span span);

#endif
