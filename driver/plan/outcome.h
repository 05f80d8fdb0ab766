/* Whether a case of a test comes out, from what its rules say of the plan. */
#ifndef TARTAN_DRIVER_PLAN_OUTCOME_H
#define TARTAN_DRIVER_PLAN_OUTCOME_H

#include "compiler/plan/syntax/program.h"
#include "runtime/module/module.h"

/* Has the plan of the case fewer or more trays than those of the library? */
static inline bool tn_length_drops(const tn_library_record *library, const tn_test_case *test)
{
    return test->length < library->trays_min || test->length > library->trays_max;
}

/* bits: of a rule's test, bit 0 says whether it matches; of a library's, bit i whether its clause i holds. Not for
 * houses and measures. */
bool tn_case_comes_out(const tn_module *module, const tn_test_block *block, const tn_test_case *test,
                       const uint64_t *bits);

#endif
