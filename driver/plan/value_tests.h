/* Test cases of measures: `value [PLAN] = NUMBER`. */
#ifndef TARTAN_DRIVER_PLAN_VALUE_TESTS_H
#define TARTAN_DRIVER_PLAN_VALUE_TESTS_H

#include "compiler/plan/syntax/program.h"
#include "driver/open/findings.h"
#include "runtime/plan/match/vm.h"

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

#endif
