/* Running the test blocks of a rule file, each case with both engines. */
#ifndef TARTAN_DRIVER_PLAN_TESTS_H
#define TARTAN_DRIVER_PLAN_TESTS_H

#include "compiler/plan/syntax/program.h"
#include "driver/open/open.h"
#include "runtime/module/module.h"
#include "runtime/plan/schema/schema.h"

typedef struct tn_plan_vm tn_plan_vm; /* runtime/plan/match/vm.h */

/* Whether a case of a test comes out, from what its rules say of the plan. */

/* Has the plan of the case fewer or more trays than those of the library? */
static inline bool tn_length_drops(const tn_library_record *library, const tn_test_case *test)
{
    return test->length < library->trays_min || test->length > library->trays_max;
}

/* bits: of a rule's test, bit 0 says whether it matches; of a library's, bit i whether its clause i holds. Not for
 * houses and measures. */
bool tn_case_comes_out(const tn_module *module, const tn_test_block *block, const tn_test_case *test,
                       const uint64_t *bits);

/* Test cases of measures: `value [PLAN] = NUMBER`. */

typedef struct tn_value_tests {
    tn_opened *opened;
    const tn_test_block *tests;
    tn_schema *schema;
    tn_plan_vm *vm;
    tn_tray *trays;
} tn_value_tests;

/* Clear in any case. */
tn_status tn_value_tests_new(tn_value_tests *values, tn_opened *opened, const tn_test_block *tests, tn_error *error);
void tn_value_tests_clear(tn_value_tests *values);

/* Does case i come out? One that does not, and is not marked `todo`, is reported; *message is then what was said, and
 * else NULL. */
tn_status tn_value_test(tn_value_tests *values, size_t i, bool *good, const char **message, tn_error *error);

typedef struct tn_test_counts {
    size_t passed, failed, todo; /* todo: failed as they are expected to */
} tn_test_counts;

/* What became of a case. */
typedef enum tn_test_outcome {
    TN_TEST_PASSED,
    TN_TEST_FAILED,
    TN_TEST_TODO, /* failed, as its mark `todo` expects */
    TN_TEST_DONE, /* passed in spite of its mark, which counts as failed */
} tn_test_outcome;

/* Whoever looks on: called for each case in order. message: why it failed; NULL where it did not. */
typedef struct tn_test_watcher {
    void (*seen)(void *context, const tn_test_block *block, const tn_test_case *test, tn_test_outcome outcome,
                 const char *message);
    void *context;
} tn_test_watcher;

/* Runs the blocks of the file itself (not of those it uses). Failures become diagnostics (E0590) with the plan, what
 * was expected of it, the rule, and how its parts came out. A case marked `todo` is expected to fail, and fails where
 * it comes out after all. TN_INVALID where a case failed or there is none (a module holds no tests), TN_INTERNAL where
 * the two engines disagree. max_states as in tn_rules_options; watcher may be NULL. */
tn_status tn_tests_run(tn_opened *opened, uint32_t max_states, const tn_test_watcher *watcher, tn_test_counts *counts);

/* Says what does not compile with the values that the file's tests give params; that is no failure. */
tn_status tn_tests_check(tn_opened *opened, tn_error *error);

#endif
