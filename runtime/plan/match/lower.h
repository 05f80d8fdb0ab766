/* Lowers rule functions to automata over tray classes: plans that the function holds of as a whole.
 *
 * A lowering keeps the automata of the functions met so far, in each direction in which they are called, so that
 * functions that many rules share are lowered once. It owns them, borrows the classes, and belongs to one thread.
 */
#ifndef TARTAN_PLAN_MATCH_LOWER_H
#define TARTAN_PLAN_MATCH_LOWER_H

#include "runtime/automata/marked.h"
#include "runtime/automata/sparse.h"
#include "runtime/module/code.h"
#include "runtime/plan/schema/classes.h"

#define TN_STATES_DEFAULT 20000u /* of any intermediate automaton */

typedef struct tn_lowering tn_lowering;

/* max_states: of any intermediate automaton (0: TN_STATES_DEFAULT). The classes must be those of the functions to be
 * lowered. */
tn_status tn_lowering_new(const tn_classes *classes, uint32_t max_states, tn_lowering **lowering, tn_error *error);
void tn_lowering_free(tn_lowering *lowering);

/* The plans that the automata will be asked about have at most so many trays: comparisons of sums are made for these,
 * and so is what would pass the limit of states for plans of every length. They may be wrong of longer ones. Only
 * before the first function is lowered. */
void tn_lowering_within(tn_lowering *lowering, uint32_t max_trays);

/* Makes what the instructions at these code offsets give the empty relation, for coverage. Only before the first
 * function is lowered; the offsets are borrowed. */
void tn_lowering_disable(tn_lowering *lowering, const uint32_t *offsets, size_t count);

/* What makes the relation of an instruction about houses (tn_code_asks_house), over marked words; reversed: of the plan
 * turned round. The letters are then classes of trays with what stands on them: the caller makes such tn_classes. Only
 * before the first function is lowered; rules about houses are TN_INVALID (E1616) without it. */
typedef tn_status tn_lowering_ask(void *house, const tn_marked *marked, const tn_instruction *op, bool reversed,
                                  tn_dfa **out, tn_error *error);
void tn_lowering_house(tn_lowering *lowering, tn_lowering_ask *ask, void *house);

/* The minimal automaton, over the classes, of the plans whose whole stretch [0, N) is in the function's relation. The
 * caller frees *out. TN_LIMIT (E0802) where an intermediate automaton passes the bounds; the error's code_offset is the
 * instruction in whose construction that was. */
tn_status tn_lower(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error);

/* The same of the function on the reversed plan: the plans whose reverse tn_lower's automaton accepts. */
tn_status tn_lower_reversed(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error);

/* The automaton (over the classes and the marker, see marked.h) of the relation of a function of M. */
tn_status tn_lower_marked(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error);

/* The automata (over the classes and the marker, see marked.h) of the relations that the instruction at `offset`, one
 * of the function's that makes a relation, takes from the stack: parts has room for TN_OPERANDS_MAX. The caller frees
 * them. */
tn_status tn_lower_operands(tn_lowering *lowering, uint32_t function, uint32_t offset, tn_dfa **parts, size_t *count,
                            tn_error *error);

/* The automaton (over the classes and the marker, see marked.h) of the relation that a term of the function's code
 * leaves on the stack; reversed: of the plan turned round. The caller frees *out. */
tn_status tn_lower_term(tn_lowering *lowering, uint32_t function, uint32_t code_begin, uint32_t code_end, bool reversed,
                        tn_dfa **out, tn_error *error);

/* Of a projection: the plans that meet the clauses of its library, over the newer classes (tn_classes_above).
 * max_states: of the automata of a clause. max_trays: of plans that are asked about, 0: of any. (image.c) */
tn_status tn_lower_above(const tn_projection *projection, const tn_classes *newer, uint32_t max_states,
                         uint32_t max_trays, tn_sparse **out, tn_error *error);

/* What the constructions of this lowering share, and the bounds that they keep. */
const tn_marked *tn_lowering_marked(const tn_lowering *lowering);
const tn_classes *tn_lowering_classes(const tn_lowering *lowering);

#endif
