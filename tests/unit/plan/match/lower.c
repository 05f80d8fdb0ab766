/* Laws of the rule language, as equality of the automata that rules lower to: these are canonical, so equal rules give
 * equal arrays. */
#include "runtime/plan/match/lower.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_rule.h"

#define CASES 12

/* Writes the code of a law's two sides about the functions of a random rule's M and H. */
typedef struct law {
    const char *name;
    void (*left)(tn_builder *builder, const uint32_t *functions, uint32_t spec, uint32_t zero);
    void (*right)(tn_builder *builder, const uint32_t *functions, uint32_t spec, uint32_t zero);
} law;

/* functions: M and H of one random rule, then of another. spec: a specifier. zero: the condition n = 0. */
enum { M1, H1, M2, H2 };

static void call(tn_builder *builder, uint32_t function)
{
    tn_builder_emit(builder, TN_OP_CALL, function, 0);
}

static void op(tn_builder *builder, tn_opcode opcode)
{
    tn_builder_emit(builder, opcode, 0, 0);
}

#define SIDE(NAME) static void NAME(tn_builder *b, const uint32_t *f, uint32_t spec, uint32_t zero)
#define UNUSED (void)f, (void)spec, (void)zero

SIDE(not_both)
{
    UNUSED;
    call(b, f[H1]);
    call(b, f[H2]);
    op(b, TN_OP_AND);
    op(b, TN_OP_NOT);
}

SIDE(either_not)
{
    UNUSED;
    call(b, f[H1]);
    op(b, TN_OP_NOT);
    call(b, f[H2]);
    op(b, TN_OP_NOT);
    op(b, TN_OP_OR);
}

SIDE(somewhere_either)
{
    UNUSED;
    call(b, f[M1]);
    call(b, f[M2]);
    op(b, TN_OP_OR);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(either_somewhere)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_SOMEWHERE);
    call(b, f[M2]);
    op(b, TN_OP_SOMEWHERE);
    op(b, TN_OP_OR);
}

/* As relations, not at the plan's level: what is somewhere in a stretch somewhere in the plan is somewhere in the plan.
 */
SIDE(somewhere)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(somewhere_twice)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_SOMEWHERE);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(none_of_tray)
{
    UNUSED;
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    op(b, TN_OP_SOMEWHERE);
    op(b, TN_OP_NOT);
}

SIDE(zero_trays)
{
    UNUSED;
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    tn_builder_emit(b, TN_OP_QUANTITY, zero, 0);
}

/* For stretches of one tray, occurrences are quantities, and so are ends mirrored. */
SIDE(zero_occurrences)
{
    UNUSED;
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    tn_builder_emit(b, TN_OP_OCCURRENCES, zero, 0);
}

SIDE(symmetric)
{
    UNUSED;
    call(b, f[M1]);
    tn_builder_emit(b, TN_OP_MIRROR, f[M1], 0);
    op(b, TN_OP_OR);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(symmetric_other_way)
{
    UNUSED;
    tn_builder_emit(b, TN_OP_MIRROR, f[M1], 0);
    call(b, f[M1]);
    op(b, TN_OP_OR);
    op(b, TN_OP_SOMEWHERE);
}

/* Two or three non-empty stretches, and any number of them. */
SIDE(repeated)
{
    UNUSED;
    call(b, f[M1]);
    tn_builder_emit(b, TN_OP_REPEATED, 2, 3);
}

SIDE(chained_twice_or_thrice)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
    op(b, TN_OP_CHAIN);
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
    op(b, TN_OP_OPTIONAL);
    op(b, TN_OP_CHAIN);
}

SIDE(repeated_and_once_more)
{
    UNUSED;
    call(b, f[M1]);
    tn_builder_emit(b, TN_OP_REPEATED, 1, 0);
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
    op(b, TN_OP_OPTIONAL);
    op(b, TN_OP_CHAIN);
}

SIDE(repeated_without_end)
{
    UNUSED;
    call(b, f[M1]);
    tn_builder_emit(b, TN_OP_REPEATED, 1, 0);
}

SIDE(chain_three_left)
{
    UNUSED;
    call(b, f[M1]);
    call(b, f[M2]);
    op(b, TN_OP_CHAIN);
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    op(b, TN_OP_CHAIN);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(chain_three_right)
{
    UNUSED;
    call(b, f[M1]);
    call(b, f[M2]);
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    op(b, TN_OP_CHAIN);
    op(b, TN_OP_CHAIN);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(ends_whole)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
    op(b, TN_OP_BEGINNING);
    op(b, TN_OP_END);
    op(b, TN_OP_SOMEWHERE);
}

SIDE(plan_whole)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
}

SIDE(optional_nonempty)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_NONEMPTY);
    op(b, TN_OP_OPTIONAL);
}

SIDE(optional)
{
    UNUSED;
    call(b, f[M1]);
    op(b, TN_OP_OPTIONAL);
}

/* Distributivity of a cut over alternatives. */
SIDE(chain_either)
{
    UNUSED;
    call(b, f[M1]);
    call(b, f[M2]);
    op(b, TN_OP_OR);
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    op(b, TN_OP_CHAIN);
}

SIDE(either_chain)
{
    UNUSED;
    call(b, f[M1]);
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    op(b, TN_OP_CHAIN);
    call(b, f[M2]);
    tn_builder_emit(b, TN_OP_TRAY, spec, 0);
    op(b, TN_OP_CHAIN);
    op(b, TN_OP_OR);
}

/* Mirroring a function that mirrors: the inner function is written by the test as function M1 of the mirrored rule. */
SIDE(mirrored_mirrored)
{
    UNUSED;
    tn_builder_emit(b, TN_OP_MIRROR, f[H2] + 1, 0);
    op(b, TN_OP_SOMEWHERE);
}

static const law laws[] = {
    {"De Morgan", not_both, either_not},
    {"somewhere or", somewhere_either, either_somewhere},
    {"somewhere twice", somewhere, somewhere_twice},
    {"no tray", none_of_tray, zero_trays},
    {"no occurrence", none_of_tray, zero_occurrences},
    {"symmetric", symmetric, symmetric_other_way},
    {"chains associate", chain_three_left, chain_three_right},
    {"two or three", repeated, chained_twice_or_thrice},
    {"once more", repeated_without_end, repeated_and_once_more},
    {"beginning and end", ends_whole, plan_whole},
    {"optional", optional, optional_nonempty},
    {"chains distribute", chain_either, either_chain},
    {"mirrored twice", somewhere, mirrored_mirrored},
};
#define LAWS (sizeof laws / sizeof *laws)

static uint32_t emit_function(tn_builder *builder, void (*side)(tn_builder *, const uint32_t *, uint32_t, uint32_t),
                              const uint32_t *functions, uint32_t spec, uint32_t zero)
{
    uint32_t begin = tn_builder_offset(builder);
    side(builder, functions, spec, zero);
    tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
    return tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, "law"),
                                                                  .kind = TN_FUNCTION_HOLDS,
                                                                  .code_begin = begin,
                                                                  .code_end = tn_builder_offset(builder),
                                                                  .stack_max = 3});
}

static void mirror_of_first(tn_builder *builder, const uint32_t *functions, uint32_t spec, uint32_t zero)
{
    (void)spec, (void)zero;
    tn_builder_emit(builder, TN_OP_MIRROR, functions[M1], 0);
}

/* Builds a module of two random rules and the laws about them. */
static tn_module *law_module(uint64_t seed, const test_schema *schema, uint32_t (*sides)[2])
{
    test_random random = {.seed = seed};
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, schema);
    uint32_t functions[4];
    test_condition zero = {.opcode = TN_OP_EQUAL};
    for (int i = 0; i < 2; i++) {
        test_rule *rule = test_rule_random(&random, schema, 2, true);
        uint32_t holds;
        test_rule_emit(builder, rule, &functions[2 * i], &holds);
        functions[2 * i + 1] = holds;
        test_rule_free(rule);
    }
    /* The mirrored function comes right after H2: `mirrored_mirrored` counts on it. */
    uint32_t mirror = emit_function(builder, mirror_of_first, functions, 0, 0);
    assert_int_equal(mirror, functions[H2] + 1);
    uint32_t spec = test_spec_add(builder, 0, (UINT64_C(1) << test_schema_bit(schema, schema->field_count, 0)) - 2);
    uint32_t condition = test_condition_emit(builder, &zero);
    for (size_t i = 0; i < LAWS; i++) {
        sides[i][0] = emit_function(builder, laws[i].left, functions, spec, condition);
        sides[i][1] = emit_function(builder, laws[i].right, functions, spec, condition);
    }
    return test_module(builder);
}

static tn_dfa *lower(tn_lowering *lowering, uint32_t function)
{
    tn_dfa *dfa = NULL;
    tn_error error;
    tn_status status = tn_lower(lowering, function, &dfa, &error);
    if (status != TN_LIMIT)
        test_ok(status, &error);
    return dfa;
}

/* Compares both sides of every law; returns how many could be (neither side past the limit of states). */
static size_t check_laws(uint64_t seed, const test_schema *test)
{
    uint32_t sides[LAWS][2];
    tn_module *module = law_module(seed, test, sides);
    tn_schema *schema = test_schema_open(module, 0);
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_error error;
    test_ok(tn_classes_new(schema, sides[0], 2 * LAWS, &classes, &error), &error);
    test_ok(tn_lowering_new(classes, 2000, &lowering, &error), &error);
    size_t compared = 0;
    for (size_t i = 0; i < LAWS; i++) {
        tn_dfa *left = lower(lowering, sides[i][0]), *right = lower(lowering, sides[i][1]);
        if (left && right) {
            compared++;
            if (!tn_dfa_equal(left, right))
                fail_msg("%s: %u and %u states differ (seed %llu)", laws[i].name, left->states, right->states,
                         (unsigned long long)seed);
        }
        tn_dfa_free(left);
        tn_dfa_free(right);
    }
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    tn_schema_free(schema);
    tn_module_free(module);
    return compared;
}

static void laws_hold(void **state)
{
    (void)state;
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= CASES; seed++) {
        compared += check_laws(seed, &test_schema_tiny);
        compared += check_laws(seed + 1000, &test_schema_house);
    }
    assert_true(compared * 10 > 2 * CASES * LAWS * 9);
}

/* Thirty functions, each of which calls the one before twice, are lowered once each. */
static void shared_functions_are_lowered_once(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, &test_schema_tiny);
    uint32_t spec = test_spec_add(builder, 0, 0xB), last = 0;
    for (int i = 0; i < 40; i++) {
        uint32_t begin = tn_builder_offset(builder);
        if (i == 0) {
            tn_builder_emit(builder, TN_OP_TRAY, spec, 0);
        } else {
            tn_builder_emit(builder, TN_OP_CALL, last, 0);
            tn_builder_emit(builder, TN_OP_MIRROR, last, 0);
            tn_builder_emit(builder, i % 2 ? TN_OP_OR : TN_OP_AND, 0, 0);
        }
        if (i == 39)
            tn_builder_emit(builder, TN_OP_SOMEWHERE, 0, 0);
        tn_builder_emit(builder, TN_OP_RETURN, 0, 0);
        last = tn_builder_add_FUNCTION(builder,
                                       &(tn_function_record){.name = tn_builder_string(builder, "f"),
                                                             .kind = i == 39 ? TN_FUNCTION_HOLDS : TN_FUNCTION_WHOLE,
                                                             .code_begin = begin,
                                                             .code_end = tn_builder_offset(builder),
                                                             .stack_max = 2});
    }
    tn_module *module = test_module(builder);
    tn_schema *schema = test_schema_open(module, 0);
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_error error;
    test_ok(tn_classes_new(schema, &last, 1, &classes, &error), &error);
    assert_int_equal(classes->count, 2);
    test_ok(tn_lowering_new(classes, 0, &lowering, &error), &error);
    tn_dfa *dfa = lower(lowering, last);
    assert_int_equal(dfa->states, 2);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    tn_schema_free(schema);
    tn_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_hold),
        cmocka_unit_test(shared_functions_are_lowered_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
