/* Boolean circuits, and what of them a solver is told: gates are put together freely, each once (structural hashing:
 * Kuehlmann, Paruthi, Krohm, Ganai: Robust Boolean reasoning, 2002), and become clauses (Tseitin, 1968) only when
 * something of what they make is asserted or assumed.
 *
 * A gate is a number: twice its node, and 1 for its opposite. Gates 0 and 1 are the constants. What fails (memory, or
 * more nodes than the limit) is remembered, and all that is made from then on is TN_SIGNAL_FALSE: it is enough to look
 * at tn_circuit_status at the end.
 *
 * The owner frees a tn_circuit, which owns its solver; it is used by one thread. */
#ifndef TARTAN_PLAN_SEARCH_CIRCUIT_H
#define TARTAN_PLAN_SEARCH_CIRCUIT_H

#include "runtime/base/watch.h"
#include "runtime/solver/solver.h"

typedef uint32_t tn_signal;
enum { TN_SIGNAL_FALSE = 0, TN_SIGNAL_TRUE = 1 };

typedef struct tn_circuit tn_circuit;

/* max_nodes: that there may be; E0809 (TN_LIMIT) past it. */
tn_status tn_circuit_new(uint32_t max_nodes, tn_circuit **circuit, tn_error *error);
void tn_circuit_free(tn_circuit *circuit);

/* What has failed so far. */
tn_status tn_circuit_status(const tn_circuit *circuit, tn_error *error);

/* Forgets that the limit of nodes was passed: what was made before stays, and there is room for as many nodes again. */
void tn_circuit_go_on(tn_circuit *circuit);

tn_signal tn_circuit_input(tn_circuit *circuit);

static inline tn_signal tn_signal_not(tn_signal gate)
{
    return gate ^ 1;
}

/* All of the gates; none: true. The array is sorted. */
tn_signal tn_circuit_all(tn_circuit *circuit, tn_signal *gates, size_t count);
/* Any of them; none: false. */
tn_signal tn_circuit_any(tn_circuit *circuit, tn_signal *gates, size_t count);
tn_signal tn_circuit_and(tn_circuit *circuit, tn_signal a, tn_signal b);
tn_signal tn_circuit_or(tn_circuit *circuit, tn_signal a, tn_signal b);
/* a if the condition is true, else b. */
tn_signal tn_circuit_choose(tn_circuit *circuit, tn_signal condition, tn_signal a, tn_signal b);

/* From now on the gate is true. */
void tn_circuit_assert(tn_circuit *circuit, tn_signal gate);
/* From now on, any of the gates is. */
void tn_circuit_assert_any(tn_circuit *circuit, const tn_signal *gates, size_t count);

/* Where the gate has to be guessed, it is guessed true. Of an input. */
void tn_circuit_prefer(tn_circuit *circuit, tn_signal gate);

/* Can all that is asserted be true, with all of the assumed gates? As tn_solver_calls.solve; TN_STOPPED if the watch
 * (or NULL) says so. */
tn_status tn_circuit_solve(tn_circuit *circuit, const tn_signal *assumed, size_t count, uint64_t conflicts,
                           tn_watch *watch, tn_solver_answer *answer, tn_error *error);

/* After YES: is it true? Of an input, or a gate that was asserted or assumed. */
bool tn_circuit_value(tn_circuit *circuit, tn_signal gate);

/* After NO: was the assumed gate used to show that? */
bool tn_circuit_failed(tn_circuit *circuit, tn_signal assumed);

#endif
