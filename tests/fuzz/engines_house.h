/* What is asked of a library of houses, on a form from anywhere or with a house from anywhere, within small limits. */
#ifndef TARTAN_TESTS_FUZZ_ENGINES_HOUSE_H
#define TARTAN_TESTS_FUZZ_ENGINES_HOUSE_H

#include "runtime/house/house.h"
#include "runtime/plan/library/library.h"

/* Counts the houses on a plan one by one and by their automaton, which have to agree; then ranks, changes, costs and
 * measures of a few of them. plans: the library that the plan is of; NULL: no automaton. */
void fuzz_houses_on(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans,
                    const tn_tray *trays, size_t length);

#endif
