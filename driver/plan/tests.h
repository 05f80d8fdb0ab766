/* Running the test blocks of a rule file, each case with both engines. */
#ifndef TARTAN_DRIVER_PLAN_TESTS_H
#define TARTAN_DRIVER_PLAN_TESTS_H

#include "driver/open/findings.h"

typedef struct tn_test_counts {
    size_t passed, failed, todo; /* todo: failed as they are expected to */
} tn_test_counts;

/* Runs the blocks of the file itself (not of those it uses). Failures become diagnostics (E0590) with the plan, what
 * was expected of it, the rule, and how its parts came out. A case marked `todo` is expected to fail, and fails where
 * it comes out after all. TN_INVALID where a case failed or there is none (a module holds no tests), TN_INTERNAL where
 * the two engines disagree. max_states as in tn_rules_options. */
tn_status tn_tests_run(tn_opened *opened, uint32_t max_states, tn_test_counts *counts);

#endif
