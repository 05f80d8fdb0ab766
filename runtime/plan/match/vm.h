/* The reference engine: interprets a rule function straight from the equations, on bit relations (relation.h).
 *
 * A vm holds the memory that evaluating needs; it grows to the largest plan seen and is reused, so that
 * matching allocates nothing per plan. It belongs to one thread and borrows the schema.
 *
 * A function's relation is found once for each plan and direction. Calls are kept on a stack of the vm's own, so that
 * no chain of functions overflows the C stack.
 */
#ifndef TARTAN_PLAN_MATCH_VM_H
#define TARTAN_PLAN_MATCH_VM_H

#include <gmp.h>

#include "runtime/module/code.h"
#include "runtime/plan/schema/schema.h"

typedef struct tn_plan_vm tn_plan_vm;

/* max_length: the longest plan (0: TN_VM_LENGTH_DEFAULT); a longer one is TN_LIMIT, E0805. */
#define TN_VM_LENGTH_DEFAULT 4096u
tn_status tn_plan_vm_new(const tn_schema *schema, size_t max_length, tn_plan_vm **vm, tn_error *error);
void tn_plan_vm_free(tn_plan_vm *vm);

/* Changes what evaluating may use; 0 leaves a bound as it is. memory: bytes in all (E0807 past it). work: word
 * operations, about a nanosecond each, for one call of tn_plan_vm_holds or tn_plan_vm_relation (E0808 past it). */
#define TN_VM_MEMORY_DEFAULT (UINT64_C(1) << 30)
#define TN_VM_WORK_DEFAULT (UINT64_C(1) << 37)
#define TN_VM_TRIES_MAX (1u << 18) /* newer plans that are tried for one such call (E0808 past it); see IMAGE */
void tn_plan_vm_limit(tn_plan_vm *vm, uint64_t memory, uint64_t work);

/* From the next plan on, what the instructions at these code offsets make is empty, for coverage (borrowed; count 0:
 * nothing is). */
void tn_plan_vm_disable(tn_plan_vm *vm, const uint32_t *offsets, size_t count);

/* Starts on a plan (copied); forgets what was found for the one before. */
tn_status tn_plan_vm_plan(tn_plan_vm *vm, const tn_tray *trays, size_t length, tn_error *error);

/* What answers for the house that stands on the plan: fills the relation of an instruction about houses
 * (tn_code_asks_house) on the plan, rows of `words` words (relation.h), all clear before. */
typedef tn_status tn_plan_vm_ask(void *house, const tn_instruction *instruction, uint64_t *relation, size_t words,
                                 tn_error *error);

/* Who is asked about the house on the plan; borrowed until the next plan, which has none. Rules about houses are
 * TN_INVALID (E1616) without one. */
void tn_plan_vm_house(tn_plan_vm *vm, tn_plan_vm_ask *ask, void *house);

/* H(r, 0, N) for a rule function of kind HOLDS. An error's code_offset is the instruction that it came from. */
tn_status tn_plan_vm_holds(tn_plan_vm *vm, uint32_t function, bool *holds, tn_error *error);

/* Is [begin, end) in the relation of a function (WHOLE or HOLDS)? 0 <= begin <= end <= the plan's length. */
tn_status tn_plan_vm_relation(tn_plan_vm *vm, uint32_t function, size_t begin, size_t end, bool *in, tn_error *error);

/* The relation of a stretch of a function's code that leaves one relation on the stack (a term: the code of one part of
 * a rule), on the plan or, reversed, on the plan turned round (places are then counted from its end). Rows of *words
 * words each (relation.h), valid until the vm is used again. */
tn_status tn_plan_vm_term(tn_plan_vm *vm, uint32_t code_begin, uint32_t code_end, bool reversed,
                          const uint64_t **relation, size_t *words, tn_error *error);

/* The value of a SUM record on the plan, in nanometres to its power; *has: it has one, else `value` is 0. `value` is
 * initialised. */
tn_status tn_plan_vm_value(tn_plan_vm *vm, uint32_t sum, mpq_t value, bool *has, tn_error *error);

/* The same without the sum's constant, in two parts: what terms whose factor is above 0 add, and what others do. */
tn_status tn_plan_vm_added(tn_plan_vm *vm, uint32_t sum, mpq_t above, mpq_t below, bool *has, tn_error *error);

/* The same as the first of a MEASURE record. */
tn_status tn_plan_vm_measure(tn_plan_vm *vm, uint32_t measure, mpq_t value, bool *has, tn_error *error);

#endif
