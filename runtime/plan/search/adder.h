/* Numbers added up over gates: a layered diagram of the sums so far, as the clauses of pseudo-Boolean constraints are
 * made from decision diagrams (Eén and Sörensson: Translating pseudo-Boolean constraints into SAT, 2006). A sum so far
 * is a gate; sums from which the outcome is certain are followed no further.
 *
 * A tn_adder owns its lists and borrows the circuit. Zero it but for the circuit, and clear it in any case. */
#ifndef TARTAN_PLAN_SEARCH_ADDER_H
#define TARTAN_PLAN_SEARCH_ADDER_H

#include "runtime/plan/search/circuit.h"

typedef struct tn_adder_choice {
    int64_t adds;
    tn_signal gate; /* or, of sums so far, that it is this one */
} tn_adder_choice;

typedef struct tn_adder {
    tn_circuit *circuit;
    tn_adder_choice *choices; /* of all steps, one step after another: exactly one of a step's gates is true */
    size_t choice_count, choice_capacity;
    size_t *steps; /* where each step begins */
    size_t step_count, step_capacity;
    struct tn_adder_rest {
        int64_t low, high;
    } * rest; /* [step_count + 1]: the least and the most that the steps from each on add */
    size_t rest_capacity;
    tn_adder_choice *sums, *next; /* those so far, ascending; and those after a step, before they are joined */
    size_t sum_count, sum_capacity, next_capacity;
    tn_signal *gates; /* room */
    size_t gate_capacity;
} tn_adder;

void tn_adder_clear(tn_adder *adder);

/* Begins again, without steps. */
void tn_adder_begin(tn_adder *adder);

/* A step: adds so much if the gate is true. */
tn_status tn_adder_add(tn_adder *adder, tn_signal gate, int64_t adds, tn_error *error);

/* A step: if `gate` is true, what the choices say (exactly one of whose gates is true), and else nothing. */
tn_status tn_adder_add_one_of(tn_adder *adder, tn_signal gate, const tn_adder_choice *choices, size_t count,
                              tn_error *error);

/* Whether a sum is as wanted: of all sums from `low` to `high` (TN_ADDER_YES, TN_ADDER_NO), or of some alone. */
typedef enum tn_adder_outcome { TN_ADDER_NO, TN_ADDER_YES, TN_ADDER_SOME } tn_adder_outcome;
typedef tn_adder_outcome tn_adder_judge(const void *context, int64_t low, int64_t high);

/* *gate: `from` and all that is added are as wanted. modulus: sums are told apart by their remainders alone, 0: they
 * are not. TN_LIMIT: too large a circuit, or too many sums. */
tn_status tn_adder_test(tn_adder *adder, int64_t from, int64_t modulus, tn_adder_judge *judge, const void *context,
                        tn_signal *gate, tn_error *error);

/* All sums there may be, in adder->sums, each with its gate. */
tn_status tn_adder_sums(tn_adder *adder, int64_t from, tn_error *error);

#endif
