/* Counts the houses that some clauses keep, in a form on the plans of a library: those of a library of houses, or
 * others. Each count may take so many states, and all counts together TN_COUNTER_LIMITS times as many: some seconds.
 *
 * A counter borrows the module.
 */
#ifndef TARTAN_DRIVER_HOUSE_COUNTER_H
#define TARTAN_DRIVER_HOUSE_COUNTER_H

#include <gmp.h>

#include "runtime/house/count/houses.h"

#define TN_COUNTER_LIMITS 10u

typedef struct tn_house_counter {
    const tn_module *module;
    const tn_house_library_record *library;
    tn_schema *schema;
    tn_house_form form;
    tn_library *plans;
    tn_house_clause_record *clauses; /* of the library, but for those that ask for walks: it has no more houses */
    uint32_t clause_count;
    uint32_t max_states;  /* of one count */
    uint64_t states_left; /* of all counts */
} tn_house_counter;

/* library: a HOUSE_LIBRARY record. plan_states: of the library of its plans; 0: TN_STATES_DEFAULT. TN_LIMIT if these
 * pass it. Close it in any case. */
tn_status tn_house_counter_open(const tn_module *module, uint32_t library, uint32_t plan_states, uint32_t max_states,
                                tn_house_counter *counter, tn_error *error);
void tn_house_counter_close(tn_house_counter *counter);

/* How many houses the clauses keep, without a part of them (NULL: whole). TN_LIMIT (E1640) if that takes more states,
 * or all counts together do; `houses` is initialised. */
tn_status tn_house_counter_count(tn_house_counter *counter, const tn_house_clause_record *clauses, uint32_t count,
                                 const tn_frontier_without *without, mpz_t houses, tn_error *error);

/* The first of the houses that the clauses keep; *found: there is one. Clear *house in any case. */
tn_status tn_house_counter_first(tn_house_counter *counter, const tn_house_clause_record *clauses, uint32_t count,
                                 bool *found, tn_house *house, tn_error *error);

/* How many houses of the library itself have each value of each choice: [shapes of the module], initialised; stands:
 * [the same], false, is there such a section? */
tn_status tn_house_counter_values(tn_house_counter *counter, mpz_t *houses, bool *stands, tn_error *error);

#endif
