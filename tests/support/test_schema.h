/* Small schemas for tests, described in C and written into a module with the builder.
 *
 * Everything here is for tests: it asserts with cmocka where the library reports.
 */
#ifndef TARTAN_TEST_SCHEMA_H
#define TARTAN_TEST_SCHEMA_H

#include "runtime/base/length.h"
#include "runtime/module/builder.h"
#include "runtime/plan/schema/schema.h"

#define TEST_VALUES_MAX 6
#define TEST_FIELDS_MAX 7

typedef struct test_value {
    const char *name, *spelling, *measure;
    int64_t length;
} test_value;

typedef struct test_field {
    const char *name;
    tn_field_kind kind;
    uint32_t value_count;
    test_value values[TEST_VALUES_MAX];
} test_field;

typedef struct test_schema {
    const char *name;
    uint32_t field_count;
    test_field fields[TEST_FIELDS_MAX];
    uint32_t forbid_count;
    uint64_t forbids[2]; /* one bit per value, as in a MASK record; all test schemas have fewer than 64 values */
} test_schema;

extern const test_schema test_schema_tiny;  /* 2 widths, a flag: 4 trays, none forbidden */
extern const test_schema test_schema_house; /* width, height, public, machine zone: 36 combinations, 34 legal */
extern const test_schema
    test_schema_paper; /* the oracle's 864 trays: width, height, public, great, machine, body, bay */

/* Index in the schema's values of a field's value (the bit of a specifier). */
uint32_t test_schema_bit(const test_schema *schema, uint32_t field, uint32_t value);

/* Writes the schema (and a source and a producer where there is none yet); the index of its SCHEMA record. */
uint32_t test_schema_add(tn_builder *builder, const test_schema *schema);

/* Writes a specifier; the index of its SPEC record. */
uint32_t test_spec_add(tn_builder *builder, uint32_t schema, uint64_t mask);

/* Finishes the builder (and frees it), loads the module. */
tn_module *test_module(tn_builder *builder);

/* The schema made ready; asserts that it can be. */
tn_schema *test_schema_open(const tn_module *module, uint32_t index);

/* Fails the test with the error's message where status is not TN_OK. */
void test_ok(tn_status status, const tn_error *error);

#endif
