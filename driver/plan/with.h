/* The file as it is for the cases of a test that gives params values: compiled once more, with these.
 *
 * A tn_with borrows the file and is kept from one block of the same test to the next. Clear it in any case, before the
 * file is closed. */
#ifndef TARTAN_DRIVER_PLAN_WITH_H
#define TARTAN_DRIVER_PLAN_WITH_H

#include "compiler/plan/syntax/program.h"
#include "driver/open/findings.h"

typedef struct tn_with {
    size_t test; /* the number of the test that it is opened for; 0: of none */
    tn_opened opened;
} tn_with;

/* Opens it for the block, unless it is. What does not compile so is said in the diagnostics of the file, TN_INVALID. */
tn_status tn_with_open(tn_with *with, tn_opened *opened, const tn_test_block *block, tn_error *error);

/* Moves what was said since to the diagnostics of the file, with a note of the values. */
void tn_with_said(tn_with *with, tn_opened *opened, const tn_test_block *block);

void tn_with_clear(tn_with *with);

#endif
