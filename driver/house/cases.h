/* The houses that a file's own tests are about, read once: for what tests reach, and for what they notice.
 *
 * A tn_house_cases borrows the opened file. Tests that give params values are left out: their
 * houses are judged by other code than that of the file.
 */
#ifndef TARTAN_DRIVER_HOUSE_CASES_H
#define TARTAN_DRIVER_HOUSE_CASES_H

#include "compiler/plan/syntax/program.h"
#include "driver/house/judge.h"
#include "runtime/house/house.h"

typedef struct tn_house_case {
    const tn_test_block *block;
    const tn_test_case *test;
    uint32_t form; /* a FORM record */
    tn_house house;
} tn_house_case;

typedef struct tn_house_cases {
    const tn_opened *opened;
    tn_house_judge *judges; /* [FORM records], opened where a case is about the form */
    tn_house_case *items;
    size_t count, capacity;
} tn_house_cases;

/* Reads the houses of the tests of the file itself. What is no house of its form is left out: running the tests reports
 * it. Clear in any case. */
tn_status tn_house_cases_read(const tn_opened *opened, tn_house_cases *cases, tn_error *error);
void tn_house_cases_clear(tn_house_cases *cases);

/* Does a case about a rule or a library come out otherwise when what the instructions at these code offsets make is
 * empty? A case of a library does where it is kept then and not before, or the other way round, and where a clause does
 * whose name stands after `by`. */
tn_status tn_house_cases_notice(tn_house_cases *cases, const uint32_t *offsets, size_t count, bool *notice,
                                tn_error *error);

#endif
