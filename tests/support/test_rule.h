/* Random rules for tests: a tree that a brute force decides straight from the equations of docs/plan-language.md, and
 * the same rule emitted as a module's functions for the engines. The brute force shares nothing with the engines: it
 * recurses over the tree and the stretch, and a plan is a list of field values, not of tray numbers.
 */
#ifndef TARTAN_TEST_RULE_H
#define TARTAN_TEST_RULE_H

#include <stdio.h>

#include "tests/support/test_schema.h"

/* ---- randomness: the same numbers on every machine */
typedef struct test_random {
    uint64_t seed, index;
} test_random;

uint64_t test_random_next(test_random *random);
uint32_t test_random_below(test_random *random, uint32_t bound); /* bound > 0 */

/* ---- the tree */
typedef enum test_rule_kind {
    TEST_TRAY,
    TEST_AND,
    TEST_OR,
    TEST_NOT,
    TEST_NEIGHBOUR,
    TEST_SYMMETRIC, /* of a neighbour */
    TEST_QUANTITY,
    TEST_SUM,
    TEST_OCCURRENCES,
    TEST_MANY,
    TEST_DISTANCE /* parts: source, destination, separator */
} test_rule_kind;

typedef struct test_condition {
    tn_opcode opcode; /* a comparison, BOTH, EITHER or NEITHER */
    int64_t first, second;
    struct test_condition *parts[2];
} test_condition;

#define TEST_PARTS_MAX 4
#define TEST_NODES_MAX 200

typedef struct test_rule {
    test_rule_kind kind;
    uint32_t id;   /* below TEST_NODES_MAX, counted from the root */
    uint64_t mask; /* TRAY: allowed values, as in a MASK record */
    struct test_rule *parts[TEST_PARTS_MAX];
    uint32_t part_count;
    bool beginning, end;           /* NEIGHBOUR */
    bool optional[TEST_PARTS_MAX]; /* NEIGHBOUR; at least one part is not */
    uint32_t field;                /* SUM: within the schema */
    test_condition *condition;
    bool apart; /* emitted as functions of its own, and called */
} test_rule;

/* A random rule of at most `depth` levels. extensions: also sum, occurrences, many, optional. Free with test_rule_free.
 */
test_rule *test_rule_random(test_random *random, const test_schema *schema, unsigned depth, bool extensions);
void test_rule_free(test_rule *rule);

/* Writes the rule, a specifier, a schema in the plan language: for messages, and for the compiler to read. */
void test_rule_print(const test_schema *schema, const test_rule *rule, FILE *out);
void test_mask_print(const test_schema *schema, uint64_t mask, FILE *out);
void test_schema_print(const test_schema *schema, FILE *out);

/* ---- emitting */

/* Emits the functions of M and H. The rule's schema must be the module's first. */
void test_rule_emit(tn_builder *builder, const test_rule *rule, uint32_t *whole, uint32_t *holds);

/* The same, and a RULE record of that name; its index. */
uint32_t test_rule_add(tn_builder *builder, const char *name, const test_rule *rule);

/* ---- the brute force */
#define TEST_LENGTH_MAX 70 /* past one word of a row */

typedef struct test_plan {
    uint32_t length;
    uint8_t values[TEST_LENGTH_MAX][TEST_FIELDS_MAX]; /* per tray and field, the value's index within the field */
} test_plan;

/* A random plan of `length` legal trays; as tray numbers in `trays` too. */
void test_plan_random(test_random *random, const tn_schema *schema, uint32_t length, test_plan *plan, tn_tray *trays);

/* The plan as values from tray numbers. */
void test_plan_of(const tn_schema *schema, const tn_tray *trays, uint32_t length, test_plan *plan);

/* Some megabytes: allocate it. */
typedef struct test_brute {
    const test_schema *schema;
    const test_plan *plan;
    /* [node][judgement][reversed][i][j] for the plan's length: 0 unknown, 1 false, 2 true */
    int8_t memo[TEST_NODES_MAX * 4 * (TEST_LENGTH_MAX + 1) * (TEST_LENGTH_MAX + 1)];
} test_brute;

/* Starts on a rule and a plan. */
void test_brute_start(test_brute *brute, const test_schema *schema, const test_plan *plan);
bool test_brute_whole(test_brute *brute, const test_rule *rule, uint32_t i, uint32_t j); /* M(r, i, j) */
bool test_brute_holds(test_brute *brute, const test_rule *rule, uint32_t i, uint32_t j); /* H(r, i, j) */

/* E(n). */
bool test_condition_holds(const test_condition *condition, int64_t n);

/* A random condition; unit: what its numbers are multiples of, more or less (1 for counts). */
test_condition *test_condition_random(test_random *random, int64_t unit, unsigned depth);
void test_condition_free(test_condition *condition);
uint32_t test_condition_emit(tn_builder *builder, const test_condition *condition);

#endif
