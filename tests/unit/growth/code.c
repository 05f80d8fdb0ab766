/* The code of rewrite systems: what the compiler makes of a file, what the verifier refuses, and what becomes of code
 * that was changed at random. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/bytes.h"
#include "runtime/base/random.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/model/system.h"
#include "runtime/growth/study.h"
#include "runtime/load.h"
#include "runtime/mesh/openmesh.h"
#include "runtime/module/builder.h"
#include "runtime/module/code.h"
#include "tests/support/compile_file.h"
#include "tests/support/test_system.h"

/* ---- modules made by hand */

typedef struct instruction {
    tn_opcode opcode;
    int64_t first, second;
} instruction;

#define CODE(...) (const instruction[]){__VA_ARGS__}, sizeof((const instruction[]){__VA_ARGS__}) / sizeof(instruction)
#define MOVE(NAME)                                                                                                     \
    {                                                                                                                  \
        TN_OP_##NAME, 0, 0                                                                                             \
    }
#define TAKES(NAME, FIRST)                                                                                             \
    {                                                                                                                  \
        TN_OP_##NAME, (FIRST), 0                                                                                       \
    }
#define EDGE_OF(LABEL, AGE)                                                                                            \
    {                                                                                                                  \
        TN_OP_DRAW, (LABEL), (AGE)                                                                                     \
    }
#define BY(NAME, NUMBER)                                                                                               \
    {                                                                                                                  \
        TN_OP_##NAME, (int64_t)tn_bits_of(NUMBER), 0                                                                   \
    }

static uint32_t add(tn_builder *builder, tn_function_kind kind, uint32_t depth, const instruction *code, size_t count)
{
    tn_function_record function = {.kind = kind, .code_begin = tn_builder_offset(builder), .stack_max = depth};
    for (size_t i = 0; i < count; i++)
        tn_builder_emit(builder, code[i].opcode, code[i].first, code[i].second);
    function.code_end = tn_builder_offset(builder);
    return tn_builder_add_FUNCTION(builder, &function);
}

static const instruction triangle[] = {EDGE_OF(0, 0), EDGE_OF(0, 0), MOVE(FLIP), EDGE_OF(1, 0), MOVE(LAND)};
static const instruction plain[] = {EDGE_OF(0, TN_AGE_KEEP), EDGE_OF(1, 0), MOVE(LAND)};
static const instruction always[] = {TAKES(LABEL, 0), TAKES(REPLACE, 1), MOVE(PASS)};

/* Labels A and B, and functions of each kind. */
static tn_builder *with(const instruction *seed, size_t seed_count, const instruction *successor,
                        size_t successor_count, const instruction *guard, size_t guard_count)
{
    tn_builder *builder = tn_builder_new();
    tn_builder_add_SOURCE(builder, &(tn_source_record){0});
    tn_builder_add_EDGE_LABEL(builder, &(tn_edge_label_record){tn_builder_string(builder, "A"), 0});
    tn_builder_add_EDGE_LABEL(builder, &(tn_edge_label_record){tn_builder_string(builder, "B"), 1});
    tn_builder_add_GROWTH(builder, &(tn_growth_record){.branch_angle = 30});
    add(builder, TN_FUNCTION_SEED, 0, seed, seed_count);
    add(builder, TN_FUNCTION_SUCCESSOR, 4, successor, successor_count);
    add(builder, TN_FUNCTION_GUARD, 0, guard, guard_count);
    tn_builder_add_REWRITE_RULE(builder, &(tn_rewrite_rule_record){.guard = 2});
    tn_builder_add_REWRITE_GROUP(builder, &(tn_rewrite_group_record){.rule_count = 1});
    return builder;
}

#define SIZE(LIST) (LIST), sizeof(LIST) / sizeof *(LIST)

static tn_builder *with_seed(const instruction *code, size_t count)
{
    return with(code, count, SIZE(plain), SIZE(always));
}

static tn_builder *with_successor(const instruction *code, size_t count)
{
    return with(SIZE(triangle), code, count, SIZE(always));
}

static tn_builder *with_guard(const instruction *code, size_t count)
{
    return with(SIZE(triangle), SIZE(plain), code, count);
}

/* The module is refused with these words among others; NULL: it loads. */
static void expect(tn_builder *builder, const char *words)
{
    uint8_t *bytes;
    size_t size;
    tn_error error = {0};
    tn_module *module = NULL;
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, &error), TN_OK);
    tn_status status = tn_module_load(bytes, size, NULL, &module, &error);
    if (words ? status != TN_INVALID || !strstr(error.message, words) : status != TN_OK)
        fail_msg("wanted \"%s\", got \"%s\"", words ? words : "no error", error.message);
    if (words)
        assert_int_equal(error.code, E_REFUSED_MODULE);
    tn_module_free(module);
    tn_builder_free(builder);
    free(bytes);
}

/* ---- what is refused */

static void test_operands(void **state)
{
    (void)state;
    expect(with_successor(SIZE(plain)), NULL);
    expect(with_successor(CODE(EDGE_OF(2, 0), MOVE(LAND))), "function 1, code offset 29: there is no edge label 2");
    expect(with_successor(CODE(EDGE_OF(0, TN_AGE_CHANGE_COUNT), MOVE(LAND))), "4 says nothing of an age");
    expect(with_successor(CODE(BY(TURN, 360.5), EDGE_OF(0, 0), BY(TURN, -360.5), MOVE(LAND))), "beyond 360 degrees");
    expect(with_successor(CODE(BY(ROLL, (double)NAN), EDGE_OF(0, 0), MOVE(LAND))), "a number that is not finite");
    expect(with_guard(CODE(TAKES(LABEL, 7), TAKES(REPLACE, 1), MOVE(PASS))), "there is no edge label 7");
    expect(with_guard(CODE(TAKES(LABEL, 0), TAKES(BEHIND, 2), TAKES(REPLACE, 1), MOVE(PASS))),
           "there is no edge label 2");
    expect(with_guard(CODE(TAKES(LABEL, 0), TAKES(REPLACE, 0), MOVE(PASS))), "function 0 is not a successor");
    expect(with_guard(CODE(TAKES(LABEL, 0), TAKES(REPLACE, 3), MOVE(PASS))), "there is no function 3");
    expect(with_guard(CODE(TAKES(LABEL, 0), BY(YOUNGER, (double)INFINITY), TAKES(REPLACE, 1), MOVE(PASS))),
           "a number that is not finite");
}

static void test_turtle(void **state)
{
    (void)state;
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(CLOSE), MOVE(LAND))), "CLOSE takes 1 from a stack of 0");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(OPEN), EDGE_OF(1, 0), MOVE(LAND))), "LAND leaves 1 on the stack");
    expect(with_successor(CODE(MOVE(OPEN), MOVE(OPEN), MOVE(OPEN), MOVE(OPEN), MOVE(OPEN), MOVE(LAND))),
           "the stack passes the 4");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(OPEN), MOVE(CLOSE), MOVE(LAND))), "the branch draws no edge");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(OPEN), EDGE_OF(1, 0), EDGE_OF(1, 0), MOVE(CLOSE), MOVE(LAND))),
           "the branch has drawn its edge already");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(OPEN), EDGE_OF(1, 0), MOVE(OPEN), EDGE_OF(1, 0), MOVE(CLOSE),
                               MOVE(CLOSE), MOVE(LAND))),
           "the branch has drawn its edge already");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(FLIP), MOVE(LAND))), "no edge follows a FLIP");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(OPEN), EDGE_OF(1, 0), MOVE(FLIP), MOVE(CLOSE), MOVE(LAND))),
           "no edge follows a FLIP");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(FLIP), MOVE(FLIP), MOVE(LAND))), NULL);
    expect(with_successor(CODE(MOVE(OPEN), EDGE_OF(1, 0), MOVE(CLOSE), MOVE(LAND))), "no edge outside the branches");
    expect(with_successor(CODE(BY(TURN, 30.0), EDGE_OF(0, 0), BY(TURN, -31.0), MOVE(LAND))),
           "the turtle does not end in the direction in which it started");
    expect(with_successor(CODE(BY(TURN, 30.0), EDGE_OF(0, 0), BY(TURN, -30.0), MOVE(LAND))), NULL);
    expect(with_successor(CODE(EDGE_OF(0, 0), TAKES(LABEL, 0), MOVE(LAND))), "does not belong in this kind of code");
    expect(with_successor(CODE(EDGE_OF(0, 0), MOVE(PASS))), "does not belong in this kind of code");
}

static void test_seed(void **state)
{
    (void)state;
    expect(with_seed(CODE(EDGE_OF(0, 0), EDGE_OF(0, 0), MOVE(LAND))), "the seed has 2 edges; 3 to 100000");
    expect(with_seed(CODE(EDGE_OF(0, 0), EDGE_OF(0, 0), EDGE_OF(0, TN_AGE_KEEP), MOVE(LAND))), "is new");
    expect(with_seed(CODE(EDGE_OF(0, 0), EDGE_OF(0, 0), EDGE_OF(0, 0), MOVE(FLIP), MOVE(LAND))), "follows a FLIP");
    expect(with_seed(CODE(EDGE_OF(0, 0), BY(TURN, 90.0), EDGE_OF(0, 0), EDGE_OF(0, 0), MOVE(LAND))),
           "a seed only draws edges");
    expect(with_seed(CODE(EDGE_OF(0, 0), EDGE_OF(0, 0), EDGE_OF(0, 0), MOVE(PASS))), "PASS does not belong");
}

static void test_guards(void **state)
{
    (void)state;
#define A_LABEL TAKES(LABEL, 0)
#define TAKEN TAKES(REPLACE, 1)
    expect(with_guard(CODE(TAKEN, MOVE(PASS))), "a predecessor has 0 edges");
    expect(with_guard(CODE(A_LABEL, A_LABEL, TAKES(AHEAD, 1), TAKEN, MOVE(PASS))), "a chain of edges has a context");
    expect(with_guard(CODE(A_LABEL, TAKES(AHEAD, 1), TAKES(BEHIND, 1), TAKEN, MOVE(PASS))), "too few successors");
    expect(with_guard(CODE(A_LABEL, MOVE(PASS))), "too few successors");
    expect(with_guard(CODE(A_LABEL, TAKEN, TAKEN, MOVE(PASS))), "does not stand here in a guard");
    expect(with_guard(CODE(A_LABEL, BY(YOUNGER, 3.0), MOVE(PASS))), "no successor follows");
    expect(with_guard(CODE(A_LABEL, BY(OLDER, 1e13), TAKEN, MOVE(PASS))), "out of range");
    expect(with_guard(CODE(A_LABEL, BY(CHANCE, 2.0), TAKEN, MOVE(PASS))), "too few successors");
    expect(with_guard(CODE(A_LABEL, BY(CHANCE, 2.0), BY(WEIGHT, 1.0), TAKEN, MOVE(PASS))), "too few successors");
    expect(with_guard(CODE(A_LABEL, BY(CHANCE, -2.0), BY(WEIGHT, 1.0), TAKEN, TAKEN, MOVE(PASS))), "below 0");
    expect(with_guard(CODE(A_LABEL, BY(CHANCE, 2.0), BY(WEIGHT, -1.0), TAKEN, TAKEN, MOVE(PASS))), "out of range");
    expect(with_guard(CODE(A_LABEL, BY(CHANCE, 2.0), BY(AGED, 1.0), TAKEN, TAKEN, MOVE(PASS))), "too few successors");
    expect(with_guard(CODE(A_LABEL, TAKEN, MOVE(LAND))), "LAND does not belong");
    expect(with_guard(CODE(A_LABEL, EDGE_OF(0, 0), MOVE(PASS))), "DRAW does not belong");
    expect(with_guard(CODE(A_LABEL, BY(CHANCE, 2.0), BY(WEIGHT, 1.0), TAKEN, TAKEN, MOVE(PASS))), NULL);
    expect(with_guard(CODE(A_LABEL, TAKES(BEHIND, 1), TAKES(AHEAD, 0), BY(AGED, 1.0), TAKEN, MOVE(PASS))), NULL);
    expect(with_guard(CODE(A_LABEL, A_LABEL, BY(AGED, 1.0), TAKEN, TAKEN, MOVE(PASS))), NULL);
}

static void test_references(void **state)
{
    (void)state;
    tn_builder *builder = with_guard(SIZE(always));
    tn_builder_set_GROWTH(builder, 0, &(tn_growth_record){.branch_angle = 30, .seed = 1});
    expect(builder, "its rewrite system has no seed");
    builder = with_guard(SIZE(always));
    tn_builder_set_REWRITE_RULE(builder, 0, &(tn_rewrite_rule_record){.guard = 1});
    expect(builder, "rewrite rule 0 has no guard");
    builder = with_guard(SIZE(always));
    add(builder, TN_FUNCTION_SEED, 0, SIZE(triangle));
    expect(builder, "it has 2 seeds and 1 successors");
    builder = with_guard(SIZE(always)); /* two rules that share a guard */
    tn_builder_add_REWRITE_RULE(builder, &(tn_rewrite_rule_record){.guard = 2});
    tn_builder_set_REWRITE_GROUP(builder, 0, &(tn_rewrite_group_record){.rule_count = 2});
    expect(builder, "rewrite rule 1 has no guard behind that of the rule before");
    for (int64_t label = 0; label < 2; label++) {
        builder = with_guard(SIZE(always));
        add(builder, TN_FUNCTION_GUARD, 0, CODE(TAKES(LABEL, label), TAKEN, MOVE(PASS)));
        tn_builder_add_REWRITE_RULE(builder, &(tn_rewrite_rule_record){.guard = 3});
        tn_builder_set_REWRITE_GROUP(builder, 0, &(tn_rewrite_group_record){.rule_count = 2});
        expect(builder, label ? "the rules of group 0 have different predecessors" : NULL);
        builder = with_guard(SIZE(always));
        add(builder, TN_FUNCTION_GUARD, 0, CODE(TAKES(LABEL, label), TAKEN, MOVE(PASS)));
        tn_builder_add_REWRITE_RULE(builder, &(tn_rewrite_rule_record){.guard = 3});
        tn_builder_add_REWRITE_GROUP(builder, &(tn_rewrite_group_record){.rule_first = 1, .rule_count = 1});
        expect(builder, label ? NULL : "two groups rewrite label 0");
    }
    builder = tn_builder_new();
    tn_builder_add_SOURCE(builder, &(tn_source_record){0});
    add(builder, TN_FUNCTION_SEED, 0, CODE(MOVE(FLIP), MOVE(LAND)));
    expect(builder, "code of a rewrite system that it does not have");
}

static void test_limits(void **state)
{
    (void)state;
    static instruction many[TN_TEMPLATE_ITEMS_MAX + 2], chain[TN_CHAIN_MAX + 3];
    for (size_t i = 0; i <= TN_TEMPLATE_ITEMS_MAX; i++)
        many[i] = (instruction)EDGE_OF(0, 0);
    many[TN_TEMPLATE_ITEMS_MAX + 1] = (instruction)MOVE(LAND);
    expect(with_successor(many, TN_TEMPLATE_ITEMS_MAX + 2), "more edges, branches or brackets than the limit");
    expect(with_successor(many + 1, TN_TEMPLATE_ITEMS_MAX + 1), NULL);
    for (size_t i = 0; i <= TN_CHAIN_MAX; i++)
        chain[i] = (instruction)TAKES(LABEL, 0);
    chain[TN_CHAIN_MAX + 1] = (instruction)TAKEN;
    chain[TN_CHAIN_MAX + 2] = (instruction)MOVE(PASS);
    expect(with_guard(chain, TN_CHAIN_MAX + 3), "a predecessor has 65 edges");
    expect(with_guard(chain + 1, TN_CHAIN_MAX + 2), NULL);
}

/* ---- what the compiler makes */

static tn_module *compile(const char *text, tn_compilation *compilation)
{
    tn_module *module;
    tn_error error = {0};
    assert_int_equal(compile_text("t.hemls", text, strlen(text), &(library_folders){0}, compilation), TN_OK);
    if (tn_module_load(compilation->module, compilation->module_size, NULL, &module, &error) != TN_OK)
        fail_msg("%s\n%s", error.message, text);
    return module;
}

/* The function's code is these opcodes. */
static void assert_code(const tn_module *module, uint32_t function, const tn_opcode *opcodes, size_t count)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    uint32_t offset = record->code_begin;
    for (size_t i = 0; i < count; i++) {
        assert_true(offset < record->code_end);
        assert_string_equal(tn_opcode_describe(module->code[offset])->name,
                            tn_opcode_describe((uint8_t)opcodes[i])->name);
        offset += tn_opcode_describe(module->code[offset])->length;
    }
    assert_int_equal(offset, record->code_end);
}

#define ASSERT_CODE(MODULE, FUNCTION, ...)                                                                             \
    assert_code(MODULE, FUNCTION, (const tn_opcode[]){__VA_ARGS__},                                                    \
                sizeof((const tn_opcode[]){__VA_ARGS__}) / sizeof(tn_opcode))

static void test_what_is_emitted(void **state)
{
    (void)state;
    tn_compilation compilation;
    tn_module *m = compile("A + ~ B + ~ ~ A\n"
                           "B < A > B -> A_i+1 ~ ~ [ + B ] If i < 3\n-> & A ^\n-> B\n"
                           "B -> \\ A / Weight 2\n-> A - ~ A + Weight 3\n"
                           "A B -> A Weight 7\nAngle 30",
                           &compilation);
    ASSERT_CODE(m, 0, TN_OP_DRAW, TN_OP_FLIP, TN_OP_DRAW, TN_OP_DRAW, TN_OP_LAND);
    ASSERT_CODE(m, 1, TN_OP_DRAW, TN_OP_OPEN, TN_OP_TURN, TN_OP_DRAW, TN_OP_CLOSE, TN_OP_LAND); /* ~ ~ is none */
    ASSERT_CODE(m, 2, TN_OP_PITCH, TN_OP_DRAW, TN_OP_PITCH, TN_OP_LAND);
    ASSERT_CODE(m, 3, TN_OP_LABEL, TN_OP_BEHIND, TN_OP_AHEAD, TN_OP_YOUNGER, TN_OP_REPLACE, TN_OP_REPLACE,
                TN_OP_PASS); /* the third is never reached */
    ASSERT_CODE(m, 4, TN_OP_ROLL, TN_OP_DRAW, TN_OP_ROLL, TN_OP_LAND);
    ASSERT_CODE(m, 5, TN_OP_DRAW, TN_OP_TURN, TN_OP_FLIP, TN_OP_DRAW, TN_OP_TURN, TN_OP_LAND);
    ASSERT_CODE(m, 6, TN_OP_LABEL, TN_OP_CHANCE, TN_OP_WEIGHT, TN_OP_REPLACE, TN_OP_REPLACE, TN_OP_PASS);
    ASSERT_CODE(m, 7, TN_OP_DRAW, TN_OP_LAND);
    ASSERT_CODE(m, 8, TN_OP_LABEL, TN_OP_LABEL, TN_OP_REPLACE, TN_OP_PASS); /* one successor needs no weight */
    assert_int_equal(m->FUNCTION_count, 9);
    assert_int_equal(m->REWRITE_GROUP_count, 3);
    const tn_source_map_record *place = tn_module_place(m, m->FUNCTION_records[5].code_begin);
    assert_memory_equal(tn_text(m, m->SOURCE_records[0].text) + place->begin, "-> A - ~ A +", 12);
    tn_module_free(m);
    tn_compilation_clear(&compilation);
}

/* Where the turtle ends up is the same as before it was moved to the runtime: Koch's curve. */
static void test_what_the_turtle_draws(void **state)
{
    (void)state;
    tn_compilation compilation;
    tn_growth_system *system;
    tn_error error;
    tn_module *m = compile("A + A + A; A -> A - A + [ - B ] + A - A; Angle 60", &compilation);
    assert_int_equal(tn_growth_system_read(m, &system, &error), TN_OK);
    assert_int_equal(system->template_count, 1);
    const tn_template *koch = &system->templates[0];
    assert_int_equal(koch->segment_count, 4);
    assert_int_equal(koch->branch_count, 1);
    assert_true(fabs(koch->segments[1].end[0] - (0.5)) < 1e-12);
    assert_true(fabs(koch->segments[1].end[1] - (-0.28867513459481288)) < 1e-12);
    assert_true(koch->segments[3].end[0] == 1 && koch->segments[3].end[1] == 0);
    assert_int_equal(koch->branches[0].at, 2);
    assert_int_equal(koch->branches[0].side, TN_SIDE_RIGHT);
    assert_true(fabs(koch->branches[0].direction[1] - (-0.86602540378443865)) < 1e-12);
    tn_growth_system_free(system);
    tn_module_free(m);
    tn_compilation_clear(&compilation);
}

/* ---- changed at random */

static void grow_both_ways(const tn_module *module, uint32_t steps)
{
    tn_growth_system *system;
    tn_study study;
    tn_error error;
    assert_int_equal(tn_growth_system_read(module, &system, &error), TN_OK);
    assert_int_equal(tn_study_read(module, "t.study", &tn_openmesh_reader, &study, &error), TN_OK);
    tn_growth *growths[2];
    study.options.edge_limit = 400;
    study.options.threads = 1;
    for (int way = 0; way < 2; way++) {
        study.options.interpret = way;
        assert_int_equal(tn_growth_new(system, &study.environment, &study.options, &growths[way], &error), TN_OK);
    }
    bool more = true;
    for (uint32_t n = 0; n < steps && more; n++) {
        tn_status status = tn_growth_step(growths[0], &error);
        assert_int_equal(tn_growth_step(growths[1], &error), status);
        more = status == TN_OK;
        if (!more && status != TN_LIMIT)
            fail_msg("%s", error.message);
        const tn_map *a = tn_growth_map(growths[0]), *b = tn_growth_map(growths[1]);
        if (more && tn_map_validate(a, &error) != TN_OK)
            fail_msg("%s", error.message);
        assert_true(!more || (a->vertex_count == b->vertex_count &&
                              memcmp(a->positions, b->positions, 24 * (size_t)a->vertex_count) == 0 &&
                              memcmp(a->states, b->states, 4 * (size_t)a->edge_count) == 0));
    }
    tn_growth_free(growths[0]);
    tn_growth_free(growths[1]);
    tn_study_clear(&study);
    tn_growth_system_free(system);
}

/* A byte of the code or two are others: opcodes, labels, ages, angles, calls. */
static void change(uint8_t *code, size_t size, uint64_t number)
{
    for (uint64_t i = 0; i <= number % 2; i++) {
        uint8_t *place = code + tn_random64(number, i, 0) % size;
        uint8_t one = (uint8_t)tn_random64(number, i, 1);
        uint8_t opcode = (uint8_t)(TN_OP_DRAW + one % (TN_OPCODE_COUNT - TN_OP_DRAW));
        *place = number % 3 == 0 ? one : number % 3 == 1 ? one % 8 : opcode;
    }
}

static tn_module *load_sound(const tn_compilation *compilation)
{
    tn_module *module;
    tn_error error;
    assert_int_equal(tn_module_load(compilation->module, compilation->module_size, NULL, &module, &error), TN_OK);
    return module;
}

static void test_changed_code(void **state)
{
    (void)state;
    enum { SYSTEMS = 150, CHANGES = 60 };
    size_t loaded = 0, refused = 0;
    for (uint64_t number = 0; number < SYSTEMS; number++) {
        char *text = test_system_text(number);
        tn_compilation compilation;
        assert_int_equal(compile_text("t.hemls", text, strlen(text), &(library_folders){0}, &compilation), TN_OK);
        uint8_t *bytes = malloc(compilation.module_size);
        assert_non_null(bytes);
        tn_module *sound = load_sound(&compilation);
        memcpy(bytes, compilation.module, compilation.module_size);
        uint8_t *code = memmem(bytes, compilation.module_size, sound->code, sound->code_size);
        size_t code_size = sound->code_size;
        assert_non_null(code);
        tn_module_free(sound);
        for (uint64_t i = 0; i < CHANGES; i++) {
            tn_module *module;
            tn_error error;
            memcpy(bytes, compilation.module, compilation.module_size);
            change(code, code_size, number * CHANGES + i);
            tn_module_rehash(bytes, compilation.module_size);
            tn_status status = tn_module_load(bytes, compilation.module_size, NULL, &module, &error);
            if (status == TN_OK)
                grow_both_ways(module, 2);
            else if (status != TN_INVALID || error.code != E_REFUSED_MODULE)
                fail_msg("%s", error.message);
            loaded += status == TN_OK;
            refused += status != TN_OK;
            tn_module_free(module);
        }
        free(bytes);
        free(text);
        tn_compilation_clear(&compilation);
    }
    assert_true(loaded > SYSTEMS * CHANGES / 20 && refused > SYSTEMS * CHANGES / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_operands),
        cmocka_unit_test(test_turtle),
        cmocka_unit_test(test_seed),
        cmocka_unit_test(test_guards),
        cmocka_unit_test(test_references),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_what_is_emitted),
        cmocka_unit_test(test_what_the_turtle_draws),
        cmocka_unit_test(test_changed_code),
    };
    return cmocka_run_group_tests_name("code", tests, NULL, NULL);
}
