/* A surface of a .field file as a tree that can be bred (runtime/genome/tree). */
#ifndef TARTAN_DRIVER_BREED_FIELD_TREE_H
#define TARTAN_DRIVER_BREED_FIELD_TREE_H

#include "compiler/field/field.h"
#include "runtime/genome/tree/tree_kind.h"

/* Named constants of all parents. Owns the names; free with tn_constant_table_clear. */
typedef struct tn_constant_table {
    tn_gene_constant *items;
    uint32_t count;
    size_t capacity;
} tn_constant_table;

/* The constant of this name and value; a name that is there with another value gets `_2`, `_3` and so on. Its index, or
 * UINT32_MAX where out of memory. */
uint32_t tn_constant_find(tn_constant_table *table, const char *name, double value);
void tn_constant_table_clear(tn_constant_table *table);

/* Makes the genome of an expression of checked fields: functions and surfaces are put in their places, and what `let`
 * names are named constants. TN_INVALID (E1247) where it measures distances from a mesh, or is larger than `most`
 * nodes. */
tn_status tn_field_tree(const tn_checked_fields *checked, tn_arena *arena, const tn_expression *body, uint32_t most,
                        tn_constant_table *constants, tn_genome *genome, tn_error *error);

#endif
