#include "tests/support/test_rule.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/base/random.h"

uint64_t test_random_next(test_random *random)
{
    return tn_random64(random->seed, 0, random->index++);
}

uint32_t test_random_below(test_random *random, uint32_t bound)
{
    return (uint32_t)((test_random_next(random) >> 32) * bound >> 32);
}

static bool chance(test_random *random, uint32_t one_in)
{
    return test_random_below(random, one_in) == 0;
}

/* ---- conditions */

static int64_t number(test_random *random, int64_t unit)
{
    int64_t n = (int64_t)test_random_below(random, 5) * unit;
    return unit > 1 && chance(random, 6) ? n + unit / 2 : n;
}

test_condition *test_condition_random(test_random *random, int64_t unit, unsigned depth)
{
    test_condition *condition = calloc(1, sizeof *condition);
    assert_non_null(condition);
    static const tn_opcode opcodes[] = {TN_OP_LESS,      TN_OP_EQUAL, TN_OP_GREATER, TN_OP_WITHIN,
                                        TN_OP_REMAINDER, TN_OP_BOTH,  TN_OP_EITHER,  TN_OP_NEITHER};
    uint32_t pick = test_random_below(random, depth > 0 ? 8 : 5);
    condition->opcode = opcodes[pick];
    condition->first = number(random, unit);
    condition->second = condition->first + number(random, unit);
    if (condition->opcode == TN_OP_REMAINDER) {
        condition->first = unit * (1 + (int64_t)test_random_below(random, 4));
        condition->second = unit * (int64_t)test_random_below(random, 4);
    }
    uint32_t parts = condition->opcode == TN_OP_NEITHER ? 1 : pick >= 5 ? 2 : 0;
    for (uint32_t i = 0; i < parts; i++)
        condition->parts[i] = test_condition_random(random, unit, depth - 1);
    return condition;
}

void test_condition_free(test_condition *condition)
{
    if (!condition)
        return;
    test_condition_free(condition->parts[0]);
    test_condition_free(condition->parts[1]);
    free(condition);
}

/* ---- rules */

typedef struct generator {
    test_random *random;
    const test_schema *schema;
    bool extensions;
    uint32_t nodes;
} generator;

static test_rule *random_node(generator *g, unsigned depth);

static uint64_t random_mask(generator *g)
{
    uint64_t mask = 0;
    uint32_t bit = 0;
    for (uint32_t f = 0; f < g->schema->field_count; f++) {
        uint32_t count = g->schema->fields[f].value_count;
        uint64_t all = (UINT64_C(1) << count) - 1;
        uint64_t some = chance(g->random, 2) ? all : test_random_next(g->random) & all;
        mask |= (some ? some : all) << bit;
        bit += count;
    }
    return mask;
}

static test_rule *new_node(generator *g, test_rule_kind kind)
{
    test_rule *rule = calloc(1, sizeof *rule);
    assert_non_null(rule);
    assert_true(g->nodes < TEST_NODES_MAX);
    rule->kind = kind;
    rule->id = g->nodes++;
    rule->apart = chance(g->random, 3);
    return rule;
}

static test_rule *random_tray(generator *g)
{
    test_rule *rule = new_node(g, TEST_TRAY);
    rule->mask = random_mask(g);
    return rule;
}

static test_rule *random_neighbour(generator *g, unsigned depth)
{
    test_rule *rule = new_node(g, TEST_NEIGHBOUR);
    rule->beginning = chance(g->random, 4);
    rule->end = chance(g->random, 4);
    rule->part_count = 1 + test_random_below(g->random, 3);
    uint32_t required = test_random_below(g->random, rule->part_count);
    for (uint32_t i = 0; i < rule->part_count; i++) {
        rule->parts[i] = random_node(g, depth - 1);
        rule->optional[i] = g->extensions && i != required && chance(g->random, 3);
    }
    return rule;
}

/* A quantity or, with extensions, a sum. */
static test_rule *random_separator(generator *g, unsigned depth)
{
    test_rule *rule = new_node(g, g->extensions && chance(g->random, 3) ? TEST_SUM : TEST_QUANTITY);
    rule->parts[rule->part_count++] = random_node(g, depth - 1);
    int64_t unit = 1;
    if (rule->kind == TEST_SUM) {
        do
            rule->field = test_random_below(g->random, g->schema->field_count);
        while (g->schema->fields[rule->field].kind != TN_FIELD_LENGTH &&
               g->schema->fields[rule->field].kind != TN_FIELD_ZONE);
        unit = 4 * TN_FOOT_NM;
    }
    rule->condition = test_condition_random(g->random, unit, 2);
    return rule;
}

static test_rule *random_node(generator *g, unsigned depth)
{
    static const test_rule_kind kinds[] = {TEST_TRAY,        TEST_AND,       TEST_OR,       TEST_NOT,
                                           TEST_NEIGHBOUR,   TEST_SYMMETRIC, TEST_QUANTITY, TEST_DISTANCE,
                                           TEST_OCCURRENCES, TEST_MANY};
    if (depth == 0 || g->nodes > TEST_NODES_MAX / 2)
        return random_tray(g);
    test_rule_kind kind = kinds[test_random_below(g->random, g->extensions ? 10 : 8)];
    if (kind == TEST_TRAY)
        return random_tray(g);
    if (kind == TEST_NEIGHBOUR)
        return random_neighbour(g, depth);
    if (kind == TEST_QUANTITY)
        return random_separator(g, depth);
    test_rule *rule = new_node(g, kind);
    rule->part_count = kind == TEST_AND || kind == TEST_OR ? 2 : 1;
    for (uint32_t i = 0; i < rule->part_count; i++)
        rule->parts[i] = kind == TEST_SYMMETRIC ? random_neighbour(g, depth) : random_node(g, depth - 1);
    if (kind == TEST_OCCURRENCES)
        rule->condition = test_condition_random(g->random, 1, 2);
    if (kind == TEST_DISTANCE) {
        rule->parts[rule->part_count++] = random_node(g, depth - 1);
        rule->parts[rule->part_count++] = random_separator(g, depth);
    }
    return rule;
}

test_rule *test_rule_random(test_random *random, const test_schema *schema, unsigned depth, bool extensions)
{
    generator g = {.random = random, .schema = schema, .extensions = extensions};
    return random_node(&g, depth);
}

void test_rule_free(test_rule *rule)
{
    if (!rule)
        return;
    for (uint32_t i = 0; i < rule->part_count; i++)
        test_rule_free(rule->parts[i]);
    test_condition_free(rule->condition);
    free(rule);
}

void test_plan_of(const tn_schema *schema, const tn_tray *trays, uint32_t length, test_plan *plan)
{
    plan->length = length;
    for (uint32_t k = 0; k < length; k++) {
        for (uint32_t f = 0; f < schema->field_count; f++)
            plan->values[k][f] = (uint8_t)tn_tray_value(schema, trays[k], f);
    }
}

void test_plan_random(test_random *random, const tn_schema *schema, uint32_t length, test_plan *plan, tn_tray *trays)
{
    for (uint32_t k = 0; k < length; k++)
        trays[k] = test_random_below(random, schema->tray_count);
    test_plan_of(schema, trays, length, plan);
}
