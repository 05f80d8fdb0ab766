/* A small form with two libraries of houses, `all` without clauses and `some` with clauses of every kind, for tests.
 * Asserts with cmocka. */
#ifndef TARTAN_TEST_HOUSE_H
#define TARTAN_TEST_HOUSE_H

#include "compiler/compile.h"
#include "runtime/house/house.h"
#include "runtime/house/rule/asked.h"

typedef struct test_house {
    tn_compilation compilation;
    tn_module *module;
    tn_schema *schema;
    tn_house_form form;
    const tn_house_library_record *all, *some;
} test_house;

void test_house_make(test_house *made);

/* The same of another text: with one form, and two libraries of houses. */
void test_house_compile(test_house *made, const char *written);

void test_house_clear(test_house *made);

/* A plan of the schema. The caller frees its trays. */
tn_plan test_house_plan(const test_house *made, const char *line);

#endif
