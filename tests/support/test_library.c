#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_library.h"

static bool make(test_library *made, uint64_t seed, const test_schema *schema, uint32_t min, uint32_t max,
                 uint64_t max_eager)
{
    test_random random = {.seed = seed};
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    memset(made, 0, sizeof *made);
    test_schema_add(builder, schema);
    uint32_t count = test_random_below(&random, TEST_CLAUSES_MAX + 1);
    tn_clause_record clauses[TEST_CLAUSES_MAX] = {{0}};
    for (uint32_t i = 0; i < count; i++) {
        const char name[] = {(char)('a' + i), '\0'};
        tn_rule_record rule = {.name = tn_builder_string(builder, name)};
        made->rules[i] = test_rule_random(&random, schema, 2, true);
        test_rule_emit(builder, made->rules[i], &rule.whole, &rule.holds);
        tn_builder_add_RULE(builder, &rule);
        clauses[i].holds = rule.holds;
        clauses[i].kind = test_random_below(&random, 4) ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE;
    }
    made->rules[count] = test_rule_random(&random, schema, 2, true);
    test_rule_add(builder, "beside", made->rules[count]);
    tn_library_record record = {.name = tn_builder_string(builder, "some"),
                                .trays_min = min,
                                .trays_max = max,
                                .clause_first = (uint32_t)tn_builder_count(builder, TN_SECTION_CLAUSE),
                                .clause_count = count};
    for (uint32_t i = 0; i < count; i++) {
        clauses[i].name = tn_builder_string(builder, "clause");
        tn_builder_add_CLAUSE(builder, &clauses[i]);
    }
    tn_builder_add_LIBRARY(builder, &record);
    made->module = test_module(builder);
    made->schema = test_schema_open(made->module, 0);
    tn_error error;
    test_ok(tn_plan_vm_new(made->schema, 0, &made->vm, &error), &error);
    tn_library_options options = {.max_states = 2000, .max_eager = max_eager};
    tn_status status = tn_library_new(made->schema, 0, &options, &made->library, &error);
    if (status != TN_LIMIT)
        test_ok(status, &error);
    return status == TN_OK;
}

bool test_library_make(test_library *made, uint64_t seed, const test_schema *schema, uint32_t min, uint32_t max)
{
    return make(made, seed, schema, min, max, 0);
}

bool test_library_make_within(test_library *made, uint64_t seed, const test_schema *schema, uint32_t min, uint32_t max)
{
    return make(made, seed, schema, min, max, 1);
}

void test_library_clear(test_library *made)
{
    for (size_t i = 0; i <= TEST_CLAUSES_MAX; i++)
        test_rule_free(made->rules[i]);
    tn_library_free(made->library);
    tn_plan_vm_free(made->vm);
    tn_schema_free(made->schema);
    tn_module_free(made->module);
}

uint32_t test_library_clauses(const test_library *made, const tn_tray *trays, uint32_t length)
{
    tn_error error;
    uint32_t bits = 0;
    test_ok(tn_plan_vm_plan(made->vm, trays, length, &error), &error);
    for (uint32_t i = 0; i < made->module->RULE_count; i++) {
        bool holds;
        test_ok(tn_plan_vm_holds(made->vm, made->module->RULE_records[i].holds, &holds, &error), &error);
        bits |= (uint32_t)holds << i;
    }
    return bits;
}

bool test_library_prunes(const test_library *made, uint32_t clause)
{
    return made->module->CLAUSE_records[clause].kind == TN_CLAUSE_PRUNE;
}

bool test_library_keeps(const test_library *made, uint32_t bits)
{
    for (uint32_t i = 0; i < made->module->CLAUSE_count; i++)
        if ((bits >> i & 1) == test_library_prunes(made, i))
            return false;
    return true;
}

uint32_t test_libraries(test_library_maker *maker, test_library_check *check, uint64_t seeds, uint32_t shortest,
                        uint32_t longer, uint64_t least)
{
    uint32_t more = 0;
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        test_library made;
        uint32_t min = (uint32_t)(seed % shortest);
        if (maker(&made, seed, &test_schema_tiny, min, min + longer))
            more += check(&made, min, min + longer) > least;
        test_library_clear(&made);
    }
    return more;
}
