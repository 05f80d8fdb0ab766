/* How many houses of a library depend on a part of a rule: they are kept, and would not be if the part never matched;
 * or the other way round. Exact, and counted together: nothing goes through them.
 *
 * A tn_dependents borrows the module.
 */
#ifndef TARTAN_DRIVER_HOUSE_DEPENDENTS_H
#define TARTAN_DRIVER_HOUSE_DEPENDENTS_H

#include <gmp.h>

#include "runtime/house/count/houses.h"

/* The states of one count if nobody says another limit; of all counts: driver/house/counter.h. */
#define TN_DEPENDENTS_STATES 100000u

typedef struct tn_dependents tn_dependents;

/* library: a HOUSE_LIBRARY record. max_states: 0 is the default. TN_LIMIT where its plans pass a limit. */
tn_status tn_dependents_new(const tn_module *module, uint32_t library, uint32_t max_states, tn_dependents **dependents,
                            tn_error *error);
void tn_dependents_free(tn_dependents *dependents);

/* Is the function (HOLDS, of a rule) in a clause of the library, or called by one? */
tn_status tn_dependents_concern(const tn_module *module, uint32_t library, uint32_t function, bool *concern,
                                tn_error *error);

/* How many houses depend on what the instructions at these code offsets make. TN_LIMIT (E1640) where that takes more
 * states, or all counts together do. */
tn_status tn_dependents_count(tn_dependents *dependents, const uint32_t *offsets, size_t count, mpz_t houses,
                              tn_error *error);

#endif
