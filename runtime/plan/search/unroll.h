/* Rules on a plan of a given length whose trays are not known: what the interpreter (runtime/plan/match/vm.h) works out
 * for one plan, with a gate in place of each bit of a relation. That is symbolic simulation, as bounded model checking
 * does it (Biere, Cimatti, Clarke, Zhu: Symbolic model checking without BDDs, 1999): the same equations, for every plan
 * of the length at once, polynomial in the length, and for every rule that the interpreter runs on a plan alone.
 *
 * A relation is a gate for each stretch [i, j). What is asked of the plan as a whole (H of a clause, and what `and`,
 * `or` and `not` of it are made of) is one gate, so that a count over the plan is not made for its stretches.
 *
 * A tn_unrolled owns what it has worked out; it borrows schema, letters and circuit. Free it with tn_unrolled_free. */
#ifndef TARTAN_PLAN_SEARCH_UNROLL_H
#define TARTAN_PLAN_SEARCH_UNROLL_H

#include "runtime/plan/schema/sum.h"
#include "runtime/plan/search/adder.h"
#include "runtime/plan/search/letters.h"

typedef struct tn_unrolled tn_unrolled;

tn_status tn_unrolled_new(const tn_letters *letters, tn_unrolled **unrolled, tn_error *error);
void tn_unrolled_free(tn_unrolled *unrolled);

/* *gate: H(r, 0, N) of a function of kind HOLDS. TN_LIMIT (E0809): its circuit passes a limit, or it is about what a
 * plan does not say; what was made for it stays, and others can be asked. */
tn_status tn_unrolled_holds(tn_unrolled *unrolled, uint32_t function, tn_signal *gate, tn_error *error);

/* The value of a SUM record on the plan, in steps of the sum: all that there may be, ascending, each with its gate, in
 * *adder, whose circuit is that of the letters. *has: the sum has a value. As above; also for sums of gaps. */
tn_status tn_unrolled_value(tn_unrolled *unrolled, const tn_sum *sum, tn_adder *adder, tn_signal *has, tn_error *error);

#endif
