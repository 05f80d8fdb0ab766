/* The reference engine: interprets a rule function straight from the equations, on bit relations.
 *
 * A vm holds the memory that evaluating needs; it grows to the largest plan seen and is reused, so that
 * matching allocates nothing per plan. It belongs to one thread and borrows the schema.
 */
#ifndef TARTAN_PLAN_VM_H
#define TARTAN_PLAN_VM_H

#include "runtime/plan/schema.h"

typedef struct tn_plan_vm tn_plan_vm;

/* max_length: the longest plan (0: TN_VM_LENGTH_DEFAULT); a longer one is TN_LIMIT, E0805. */
#define TN_VM_LENGTH_DEFAULT 4096u
tn_status tn_plan_vm_new(const tn_schema *schema, size_t max_length, tn_plan_vm **vm, tn_error *error);
void tn_plan_vm_free(tn_plan_vm *vm);

/* Starts on a plan; forgets what was found for the one before. */
tn_status tn_plan_vm_plan(tn_plan_vm *vm, const tn_tray *trays, size_t length, tn_error *error);

/* H(r, 0, N) for a rule function of kind HOLDS. */
tn_status tn_plan_vm_holds(tn_plan_vm *vm, uint32_t function, bool *holds, tn_error *error);

/* Is [begin, end) in the relation of a function (WHOLE or HOLDS)? */
tn_status tn_plan_vm_relation(tn_plan_vm *vm, uint32_t function, size_t begin, size_t end, bool *in, tn_error *error);

#endif
