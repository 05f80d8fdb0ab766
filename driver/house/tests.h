/* Running the test blocks about houses. */
#ifndef TARTAN_DRIVER_HOUSE_TESTS_H
#define TARTAN_DRIVER_HOUSE_TESTS_H

#include "compiler/plan/syntax/program.h"
#include "driver/open/open.h"

/* Runs one block. Failures become diagnostics (E0590), and so does a line that is no house (E1611). Adds to what
 * passed, failed, and failed as it is expected to. */
tn_status tn_house_tests_run(tn_opened *opened, const tn_test_block *block, size_t *passed, size_t *failed,
                             size_t *todo, tn_error *error);

#endif
