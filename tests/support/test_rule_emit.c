#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/test_rule.h"

#include "runtime/module/code.h"

#define NOT_EMITTED UINT32_MAX

#define SCHEMA 0 /* rules are of the module's first schema, whose first field is the first of all */

typedef struct emitter {
    tn_builder *builder;
    uint32_t specs[TEST_NODES_MAX];
    uint32_t conditions[TEST_NODES_MAX];
    uint32_t functions[TEST_NODES_MAX][2]; /* [node][judgement]: 0 whole, 1 holds */
    uint32_t depth, depth_max;             /* of the stack of the function in hand */
} emitter;

static void emit(emitter *e, tn_opcode opcode, int64_t first, int64_t second)
{
    tn_opcode_effect effect = tn_code_effect((uint8_t)opcode);
    e->depth = e->depth - effect.pops + effect.pushes;
    if (e->depth > e->depth_max)
        e->depth_max = e->depth;
    tn_builder_emit(e->builder, opcode, first, second);
}

/* ---- conditions */

static void emit_condition_code(emitter *e, const test_condition *condition)
{
    for (uint32_t i = 0; i < 2 && condition->parts[i]; i++)
        emit_condition_code(e, condition->parts[i]);
    emit(e, condition->opcode, condition->first, condition->second);
}

uint32_t test_condition_emit(tn_builder *builder, const test_condition *condition)
{
    emitter e = {.builder = builder};
    uint32_t begin = tn_builder_offset(builder);
    emit_condition_code(&e, condition);
    emit(&e, TN_OP_ANSWER, 0, 0);
    return tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, "E"),
                                                                  .kind = TN_FUNCTION_CONDITION,
                                                                  .code_begin = begin,
                                                                  .code_end = tn_builder_offset(builder),
                                                                  .stack_max = e.depth_max});
}

/* ---- rules: what a node needs of other functions is emitted first, in post-order, then its own code */

static void emit_code(emitter *e, const test_rule *rule, bool holds);

static uint32_t emit_function(emitter *e, const test_rule *rule, bool holds)
{
    e->depth = 0;
    e->depth_max = 0;
    uint32_t begin = tn_builder_offset(e->builder);
    emit_code(e, rule, holds);
    emit(e, TN_OP_RETURN, 0, 0);
    tn_function_record record = {.name = tn_builder_string(e->builder, holds ? "H" : "M"),
                                 .kind = holds ? TN_FUNCTION_HOLDS : TN_FUNCTION_WHOLE,
                                 .schema = SCHEMA,
                                 .code_begin = begin,
                                 .code_end = tn_builder_offset(e->builder),
                                 .stack_max = e->depth_max};
    return tn_builder_add_FUNCTION(e->builder, &record);
}

/* First the parts, then whatever the rule's own code refers to: its specifier, its condition, and (where it is to be
 * called, or is the neighbour that a symmetric rule mirrors) functions of both judgements. */
static void prepare(emitter *e, const test_rule *rule, bool apart)
{
    for (uint32_t i = 0; i < rule->part_count; i++)
        prepare(e, rule->parts[i], rule->parts[i]->apart || rule->kind == TEST_SYMMETRIC);
    if (rule->kind == TEST_TRAY)
        e->specs[rule->id] = test_spec_add(e->builder, SCHEMA, rule->mask);
    if (rule->condition)
        e->conditions[rule->id] = test_condition_emit(e->builder, rule->condition);
    for (int judgement = 0; apart && judgement < 2; judgement++) {
        uint32_t function = emit_function(e, rule, judgement == 1);
        e->functions[rule->id][judgement] = function;
    }
}

static void emit_part(emitter *e, const test_rule *rule, bool holds)
{
    uint32_t function = e->functions[rule->id][holds];
    if (function == NOT_EMITTED)
        emit_code(e, rule, holds);
    else
        emit(e, TN_OP_CALL, function, 0);
}

static void emit_neighbour(emitter *e, const test_rule *rule)
{
    for (uint32_t i = 0; i < rule->part_count; i++) {
        emit_part(e, rule->parts[i], false);
        emit(e, TN_OP_NONEMPTY, 0, 0);
        if (rule->optional[i])
            emit(e, TN_OP_OPTIONAL, 0, 0);
        if (i > 0)
            emit(e, TN_OP_CHAIN, 0, 0);
    }
    if (rule->beginning)
        emit(e, TN_OP_BEGINNING, 0, 0);
    if (rule->end)
        emit(e, TN_OP_END, 0, 0);
}

static void emit_counted(emitter *e, const test_rule *rule)
{
    uint32_t condition = e->conditions[rule->id];
    emit_part(e, rule->parts[0], false);
    if (rule->kind == TEST_SUM) {
        emit(e, TN_OP_SUM, rule->field, condition);
        return;
    }
    emit(e, rule->kind == TEST_QUANTITY ? TN_OP_QUANTITY : TN_OP_OCCURRENCES, condition, 0);
}

static void emit_code(emitter *e, const test_rule *rule, bool holds)
{
    switch (rule->kind) {
    case TEST_TRAY:
        emit(e, TN_OP_TRAY, e->specs[rule->id], 0);
        break;
    case TEST_AND:
    case TEST_OR:
        emit_part(e, rule->parts[0], holds);
        emit_part(e, rule->parts[1], holds);
        emit(e, rule->kind == TEST_AND ? TN_OP_AND : TN_OP_OR, 0, 0);
        return;
    case TEST_NOT:
        emit_part(e, rule->parts[0], true);
        emit(e, TN_OP_NOT, 0, 0);
        return;
    case TEST_NEIGHBOUR:
        emit_neighbour(e, rule);
        break;
    case TEST_SYMMETRIC:
        emit_part(e, rule->parts[0], false);
        emit(e, TN_OP_MIRROR, e->functions[rule->parts[0]->id][0], 0);
        emit(e, TN_OP_OR, 0, 0);
        break;
    case TEST_QUANTITY:
    case TEST_SUM:
    case TEST_OCCURRENCES:
        emit_counted(e, rule);
        return;
    case TEST_MANY:
        emit_part(e, rule->parts[0], false);
        emit(e, TN_OP_MANY, 0, 0);
        break;
    case TEST_DISTANCE:
        for (uint32_t i = 0; i < 3; i++)
            emit_part(e, rule->parts[i], false);
        emit(e, TN_OP_DISTANCE, 0, 0);
        break;
    }
    if (holds)
        emit(e, TN_OP_SOMEWHERE, 0, 0);
}

void test_rule_emit(tn_builder *builder, const test_rule *rule, uint32_t *whole, uint32_t *holds)
{
    emitter *e = calloc(1, sizeof *e);
    assert_non_null(e);
    e->builder = builder;
    for (size_t i = 0; i < TEST_NODES_MAX; i++)
        e->functions[i][0] = e->functions[i][1] = NOT_EMITTED;
    prepare(e, rule, true);
    *whole = e->functions[rule->id][0];
    *holds = e->functions[rule->id][1];
    free(e);
}

uint32_t test_rule_add(tn_builder *builder, const char *name, const test_rule *rule)
{
    tn_rule_record record = {.name = tn_builder_string(builder, name), .schema = SCHEMA};
    test_rule_emit(builder, rule, &record.whole, &record.holds);
    return tn_builder_add_RULE(builder, &record);
}
