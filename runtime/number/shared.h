/* Many formulas, evaluated together at many points: what several have in common is computed once.
 *
 * Each formula's code becomes nodes, one an operation; equal operations of equal nodes are one node. The nodes are
 * evaluated by rows of TN_ROW points, in the order in which they were met; a row is used again as soon as nothing needs
 * it any more. The values are to the bit those of tn_number_run_rows.
 */
#ifndef TARTAN_NUMBER_SHARED_H
#define TARTAN_NUMBER_SHARED_H

#include "runtime/base/error.h"
#include "runtime/base/hash_table.h"

/* Zero it to begin with; it may be begun again and again, one thread at a time. */
typedef struct tn_shared {
    struct tn_shared_node *nodes; /* owned, as all below */
    tn_hash_table index;          /* of nodes */
    uint32_t *stack;
    uint32_t *roots; /* by formula */
    uint32_t *heads; /* by node: the last formula whose value it is */
    uint32_t *next;  /* by formula: the next with the same value */
    uint32_t *free;  /* rows that nothing needs */
    double *rows;
    size_t node_count, node_capacity, stack_capacity, root_count, root_capacity, head_capacity, next_capacity,
        row_count, row_capacity, free_count, free_capacity;
} tn_shared;

void tn_shared_clear(tn_shared *shared);

/* Forgets the formulas and keeps the memory. */
void tn_shared_begin(tn_shared *shared);

/* Adds the code of a formula of terms, which has been ended; formulas are numbered from 0 on. TN_MEMORY, or TN_OK. */
tn_status tn_shared_add(tn_shared *shared, const uint8_t *code, tn_error *error);

/* How many operations have to be computed at each point. */
size_t tn_shared_operations(const tn_shared *shared);

/* The values of all formulas at `count` points, columns[term][point], into values[formula * count + point]. Columns are
 * readable up to the next multiple of TN_ROW points. TN_MEMORY, or TN_OK. */
tn_status tn_shared_run(tn_shared *shared, const double *const *columns, size_t count, double *values, tn_error *error);

#endif
