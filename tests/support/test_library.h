/* Libraries of random clauses for tests, and what the reference engine says of their plans. Asserts with cmocka. */
#ifndef TARTAN_TEST_LIBRARY_H
#define TARTAN_TEST_LIBRARY_H

#include "runtime/plan/library/library.h"
#include "runtime/plan/match/vm.h"
#include "tests/support/test_rule.h"

#define TEST_CLAUSES_MAX 6

typedef struct test_library {
    test_rule *rules[TEST_CLAUSES_MAX + 1]; /* of the clauses, and one that is beside them */
    tn_module *module;
    tn_schema *schema;
    tn_library *library;
    tn_plan_vm *vm;
} test_library;

/* A library of at most TEST_CLAUSES_MAX random clauses, and a rule (the last RULE record) that is no clause; free it
 * with test_library_clear, whatever this returns. false where a clause passes the limit of 2,000 states, as some random
 * ones do. */
bool test_library_make(test_library *made, uint64_t seed, const test_schema *schema, uint32_t min, uint32_t max);

/* The same library, built within its lengths. */
bool test_library_make_within(test_library *made, uint64_t seed, const test_schema *schema, uint32_t min, uint32_t max);
void test_library_clear(test_library *made);

typedef bool test_library_maker(test_library *made, uint64_t seed, const test_schema *schema, uint32_t min,
                                uint32_t max);
typedef uint64_t test_library_check(const test_library *made, uint32_t min, uint32_t max);

/* Checks the libraries of seeds 1 to `seeds` of plans of `seed % shortest` trays and up to `longer` more. How many of
 * the checks gave more than `least`. */
uint32_t test_libraries(test_library_maker *maker, test_library_check *check, uint64_t seeds, uint32_t shortest,
                        uint32_t longer, uint64_t least);

/* What the reference engine says of a plan: bit i for clause i, and the next bit for the rule beside them. */
uint32_t test_library_clauses(const test_library *made, const tn_tray *trays, uint32_t length);

/* Is clause i a pruning one? */
bool test_library_prunes(const test_library *made, uint32_t clause);

/* Is a plan of these clauses kept (its length aside)? */
bool test_library_keeps(const test_library *made, uint32_t clauses);

#endif
