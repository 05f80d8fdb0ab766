/* What rules compile to: the instructions of each kind of expression, sharing, order, places, limits. Every module made
 * here goes through the loader. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/plan/syntax/program.h"
#include "runtime/load.h"
#include "runtime/module/code.h"
#include "tests/support/compile_file.h"

#define SCHEMA                                                                                                         \
    "schema s {\n"                                                                                                     \
    "  width = 4' | 8' | 12'\n"                                                                                        \
    "  height \"how high\" role level = single | double \"two storeys\"\n"                                             \
    "  public = flag\n"                                                                                                \
    "  zone machine role band = dense(4', 8') \"full\" role solid | empty role absent\n"                               \
    "  forbid tray(4', double)\n"                                                                                      \
    "}\n"

typedef struct compiled {
    tn_compilation compilation;
    tn_module *module;
} compiled;

static compiled compile_sized(const char *text, size_t size)
{
    compiled c = {0};
    library_folders options = {0};
    tn_error error;
    tn_status status = compile_text("test.plan", text, size, &options, &c.compilation);
    if (c.compilation.diagnostics.count > 0 && status != TN_OK)
        print_message("%s\n", c.compilation.diagnostics.items[0].message);
    assert_int_equal(status, TN_OK);
    assert_int_equal(tn_module_load(c.compilation.module, c.compilation.module_size, NULL, &c.module, &error), TN_OK);
    return c;
}

static compiled compile(const char *text)
{
    return compile_sized(text, strlen(text));
}

static void drop(compiled *c)
{
    tn_module_free(c->module);
    tn_compilation_clear(&c->compilation);
}

/* The names of a function's instructions, separated by blanks. */
static const char *listing(const tn_module *module, uint32_t function)
{
    static char text[4096];
    const tn_function_record *record = &module->FUNCTION_records[function];
    size_t used = 0;
    for (uint32_t at = record->code_begin; at < record->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, at);
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", used ? " " : "",
                                 tn_opcode_describe((uint8_t)instruction.opcode)->name);
        at += instruction.length;
    }
    return text;
}

static tn_instruction instruction(const tn_module *module, uint32_t function, unsigned n)
{
    uint32_t at = module->FUNCTION_records[function].code_begin;
    while (n-- > 0)
        at += tn_code_read(module->code, at).length;
    return tn_code_read(module->code, at);
}

/* The last rule of the text: what its two functions hold. */
static void expect(const char *rules, const char *whole, const char *holds)
{
    char text[2000];
    snprintf(text, sizeof text, SCHEMA "%s", rules);
    compiled c = compile(text);
    const tn_rule_record *rule = &c.module->RULE_records[c.module->RULE_count - 1];
    assert_string_equal(listing(c.module, rule->whole), whole);
    assert_string_equal(listing(c.module, rule->holds), holds);
    drop(&c);
}

static void expressions(void **state)
{
    (void)state;
    expect("rule r = tray(4')", "TRAY RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = any", "TRAY RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = tray(4') and any or tray(8')", "TRAY TRAY AND TRAY OR RETURN",
           "TRAY SOMEWHERE TRAY SOMEWHERE AND TRAY SOMEWHERE OR RETURN");
    expect("rule r = not tray(4')", "TRAY SOMEWHERE NOT RETURN", "TRAY SOMEWHERE NOT RETURN");
    expect("rule r = not not any", "TRAY SOMEWHERE NOT NOT RETURN", "TRAY SOMEWHERE NOT NOT RETURN");
    expect("rule r = neighbour(tray(4'), tray(8'), any)",
           "TRAY NONEMPTY TRAY NONEMPTY CHAIN TRAY NONEMPTY CHAIN RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = neighbor(beginning, any, end)", "TRAY NONEMPTY BEGINNING END RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = neighbour(any, optional(any))", "TRAY NONEMPTY TRAY NONEMPTY OPTIONAL CHAIN RETURN",
           "CALL SOMEWHERE RETURN");
    expect("rule r = neighbour(not any, quantity(any, n = 0))",
           "TRAY SOMEWHERE NOT NONEMPTY TRAY QUANTITY NONEMPTY CHAIN RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = quantity(any, n > 1)", "TRAY QUANTITY RETURN", "CALL RETURN");
    expect("rule r = occurrences(any, n > 1)", "TRAY OCCURRENCES RETURN", "CALL RETURN");
    expect("rule r = sum(width, w > 4')", "TRAY SUM RETURN", "CALL RETURN");
    expect("rule r = sum(machine depth of tray(4'), w > 4')", "TRAY SUM RETURN", "CALL RETURN");
    expect("rule r = many(any)", "TRAY MANY RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = repeat(any, 2..)", "TRAY REPEATED RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = any or neighbour(any, r)", "TRAY TRAY NONEMPTY AGAIN NONEMPTY CHAIN OR RETURN",
           "TRAY SOMEWHERE TRAY NONEMPTY CALL NONEMPTY CHAIN SOMEWHERE OR RETURN");
    expect("rule r = any implies any", "TRAY SOMEWHERE NOT TRAY OR RETURN",
           "TRAY SOMEWHERE NOT TRAY SOMEWHERE OR RETURN");
    expect("rule r = any implies any\nlibrary l { trays 1..2 generate r or any }",
           "TRAY SOMEWHERE NOT TRAY OR ONCE RETURN", "TRAY SOMEWHERE NOT TRAY SOMEWHERE OR RETURN");
    expect("rule r = distance(from tray(4'), to any, by quantity(any, n > 2))",
           "TRAY TRAY TRAY QUANTITY DISTANCE RETURN", "CALL SOMEWHERE RETURN");
    expect("rule r = symmetric neighbour(beginning, tray(4'))", "CALL MIRROR OR RETURN", "CALL SOMEWHERE RETURN");
}

static void names(void **state)
{
    (void)state;
    expect("rule a = any\nrule r = a", "CALL RETURN", "CALL RETURN");
    expect("rule a = any\nrule r = a and not a", "CALL CALL NOT AND RETURN", "CALL CALL NOT AND RETURN");
    expect("rule q = quantity(any, n > 2)\nrule p = q\nrule r = distance(from any, to any, by p)",
           "TRAY TRAY CALL DISTANCE RETURN", "CALL SOMEWHERE RETURN");
    expect("rule n = neighbour(any, any)\nrule r = symmetric n", "CALL MIRROR OR RETURN", "CALL SOMEWHERE RETURN");
}

/* Which of a name's functions is called: in a neighbour that of the whole stretch, under `not` and at the top that of
 * somewhere. */
static void judgements(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule r = neighbour(a, not a) or not a\nrule a = any");
    const tn_module *m = c.module;
    const tn_rule_record *r = &m->RULE_records[0], *a = &m->RULE_records[1];
    assert_string_equal(listing(m, r->whole), "CALL NONEMPTY CALL NOT NONEMPTY CHAIN CALL NOT OR RETURN");
    assert_int_equal(instruction(m, r->whole, 0).first, a->whole);
    assert_int_equal(instruction(m, r->whole, 2).first, a->holds);
    assert_int_equal(instruction(m, r->whole, 6).first, a->holds);
    assert_true(a->whole < a->holds && a->holds < r->whole && r->whole < r->holds);
    drop(&c);
}

static void nested_symmetric(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule r = symmetric neighbour(symmetric neighbour(tray(4'), any), any)");
    const tn_module *m = c.module;
    assert_int_equal(m->FUNCTION_count, 4); /* the inner neighbour, the outer one, and the rule's two */
    assert_string_equal(listing(m, 0), "TRAY NONEMPTY TRAY NONEMPTY CHAIN RETURN");
    assert_string_equal(listing(m, 1), "CALL MIRROR OR NONEMPTY TRAY NONEMPTY CHAIN RETURN");
    assert_string_equal(tn_text(m, m->FUNCTION_records[0].name), "r (symmetric)");
    assert_int_equal(m->FUNCTION_records[0].kind, TN_FUNCTION_WHOLE);
    drop(&c);
}

static void conditions(void **state)
{
    (void)state;
    static const struct {
        const char *condition, *code;
    } cases[] = {
        {"n > 1", "GREATER ANSWER"},
        {"1 < n", "GREATER ANSWER"},
        {"n >= 1", "LESS NEITHER ANSWER"},
        {"n <= 1", "GREATER NEITHER ANSWER"},
        {"n != 1", "EQUAL NEITHER ANSWER"},
        {"1 = n", "EQUAL ANSWER"},
        {"n in 2..4", "WITHIN ANSWER"},
        {"n mod 3 = 1", "REMAINDER ANSWER"},
        {"n mod 3 != 1", "REMAINDER NEITHER ANSWER"},
        {"n = 1 or n = 2 and not n = 3", "EQUAL EQUAL EQUAL NEITHER BOTH EITHER ANSWER"},
        {"(n = 1 or n = 2) and n > 0 and n < 9", "EQUAL EQUAL EITHER GREATER BOTH LESS BOTH ANSWER"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        snprintf(text, sizeof text, SCHEMA "rule r = quantity(any, %s)", cases[i].condition);
        compiled c = compile(text);
        assert_int_equal(c.module->FUNCTION_records[0].kind, TN_FUNCTION_CONDITION);
        assert_string_equal(listing(c.module, 0), cases[i].code);
        drop(&c);
    }
    compiled c = compile(SCHEMA "rule r = quantity(any, count in 2..4 or 7 <= count)");
    assert_int_equal(instruction(c.module, 0, 0).first, 2);
    assert_int_equal(instruction(c.module, 0, 0).second, 4);
    assert_int_equal(instruction(c.module, 0, 1).first, 7);
    drop(&c);
}

static void equal_parts_are_shared(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule a = quantity(tray(8', single), n > 1)\n"
                                "rule b = quantity(tray(not double, width 8'), m > 1)\n"
                                "rule c = quantity(any, n > 1) and tray() and tray(width >= 4')\n"
                                "rule d = tray(double, 4')\n");
    const tn_module *m = c.module;
    size_t condition_count = 0;
    for (size_t i = 0; i < m->FUNCTION_count; i++)
        condition_count += m->FUNCTION_records[i].kind == TN_FUNCTION_CONDITION;
    assert_int_equal(condition_count, 1);
    assert_int_equal(m->SPEC_count, 3); /* the forbidden tray, 8' single, any */
    assert_int_equal(instruction(m, m->RULE_records[3].whole, 0).first, m->SCHEMA_records[0].forbid_first);
    drop(&c);
}

static void doublings(void **state)
{
    (void)state;
    char text[4000] = SCHEMA "rule d0 = tray(4')\n";
    for (int i = 1; i <= 30; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "rule d%d = neighbour(d%d, d%d)\n", i, i - 1, i - 1);
    compiled c = compile(text);
    assert_int_equal(c.module->FUNCTION_count, 62);
    assert_true(c.module->code_size < 1500);
    drop(&c);
}

static void schemas(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule r = tray(4', machine not dense 8')");
    const tn_module *m = c.module;
    const tn_schema_record *schema = &m->SCHEMA_records[0];
    assert_int_equal(schema->field_count, 4);
    assert_int_equal(schema->forbid_count, 1);
    assert_int_equal(m->VALUE_count, 10);
    assert_string_equal(tn_text(m, m->VALUE_records[5].name), "-");
    assert_string_equal(tn_text(m, m->VALUE_records[6].spelling), "public");
    assert_string_equal(tn_text(m, m->VALUE_records[8].name), "dense");
    assert_string_equal(tn_text(m, m->VALUE_records[8].spelling), "dense:8'");
    assert_string_equal(tn_text(m, m->VALUE_records[8].measure), "8'");
    assert_string_equal(tn_text(m, m->VALUE_records[8].doc), "full");
    assert_int_equal(m->VALUE_records[8].role, TN_FILL_SOLID);
    assert_int_equal(m->VALUE_records[8].length, INT64_C(8) * 304800000);
    assert_string_equal(tn_text(m, m->VALUE_records[9].spelling), "empty");
    assert_int_equal(m->VALUE_records[9].length, 0);
    assert_int_equal(m->FIELD_records[1].role, TN_ROLE_LEVEL);
    assert_string_equal(tn_text(m, m->FIELD_records[1].doc), "how high");
    /* bits: 4' 8' 12' single double - public dense:4' dense:8' empty */
    const tn_spec_record *spec = &m->SPEC_records[instruction(m, m->RULE_records[0].whole, 0).first];
    assert_int_equal(m->MASK_records[spec->mask_first].bits, 1 << 0 | 3 << 3 | 3 << 5 | 1 << 7 | 1 << 9);
    drop(&c);
}

/* The mask of `tray(ITEM)`, in the bits of the schema above. */
static void expect_mask(const char *item, unsigned field_bits, unsigned first, unsigned count)
{
    char text[1000];
    snprintf(text, sizeof text, SCHEMA "rule r = tray(%s)", item);
    compiled c = compile(text);
    const tn_spec_record *spec =
        &c.module->SPEC_records[instruction(c.module, c.module->RULE_records[0].whole, 0).first];
    uint64_t mask = (uint64_t)c.module->MASK_records[spec->mask_first].bits, of_field = ((UINT64_C(1) << count) - 1)
                                                                                        << first;
    if (mask != ((0x3ff & ~of_field) | (uint64_t)field_bits << first))
        fail_msg("tray(%s) has the mask %llx", item, (unsigned long long)mask);
    drop(&c);
}

static void specifiers(void **state)
{
    (void)state;
    expect_mask("4'", 1, 0, 3);
    expect_mask("4' or 12'", 5, 0, 3);
    expect_mask("width 4' or 8'", 3, 0, 3);
    expect_mask("width 4' or width 8'", 3, 0, 3);
    expect_mask("not 4'", 6, 0, 3);
    expect_mask("width not 4'", 6, 0, 3);
    expect_mask("width >= 8'", 6, 0, 3);
    expect_mask("not width >= 8'", 1, 0, 3);
    expect_mask("width < 8' or > 11'", 5, 0, 3);
    expect_mask("width != 8'", 5, 0, 3);
    expect_mask("96\"", 2, 0, 3);
    expect_mask("2.4384m", 2, 0, 3);
    expect_mask("double", 2, 3, 2);
    expect_mask("height double", 2, 3, 2);
    expect_mask("NOT double", 1, 3, 2);
    expect_mask("height = single", 1, 3, 2);
    expect_mask("public", 2, 5, 2);
    expect_mask("not public", 1, 5, 2);
    expect_mask("public or not public", 3, 5, 2);
    expect_mask("machine dense", 3, 7, 3);
    expect_mask("dense", 3, 7, 3);
    expect_mask("machine 4'", 1, 7, 3);
    expect_mask("machine dense 8'", 2, 7, 3);
    expect_mask("dense 8'", 2, 7, 3);
    expect_mask("machine not dense", 4, 7, 3);
    expect_mask("machine not dense 8'", 5, 7, 3);
    expect_mask("not machine dense 8'", 5, 7, 3);
    expect_mask("machine dense 4' or empty", 5, 7, 3);
    expect_mask("machine dense 4' or 8'", 3, 7, 3);
    expect_mask("machine depth > 4'", 2, 7, 3);
    expect_mask("machine depth < 5'", 5, 7, 3);
    expect_mask("machine dense > 4'", 2, 7, 3);
    expect_mask("machine depth 8'", 2, 7, 3);
    expect_mask("machine != empty", 3, 7, 3);
}

static const char *clause_name(const tn_module *module, uint32_t i)
{
    return tn_text(module, module->CLAUSE_records[i].name);
}

static void libraries(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule a \"of a\" = tray(4')\n"
                                "library small \"a few\" from all {\n"
                                "  total machine <= 8'\n"
                                "  prune tray(8'), tray(12') and a as both \"together\"\n"
                                "}\n"
                                "library all {\n"
                                "  require a, quantity(any, n > 0) \"not empty\"\n"
                                "  prune a as short\n"
                                "  total 8'..40'\n"
                                "  trays 2..5\n"
                                "}\n");
    const tn_module *m = c.module;
    const tn_library_record *small = &m->LIBRARY_records[0], *all = &m->LIBRARY_records[1];
    assert_int_equal(all->clause_count, 4);
    assert_int_equal(small->clause_count, 7);
    assert_int_equal(small->trays_min, 2);
    assert_int_equal(small->trays_max, 5);
    static const char *const names_of_small[] = {"a", "require@14", "short", "total", "total", "prune@11", "both"};
    for (uint32_t i = 0; i < 7; i++)
        assert_string_equal(clause_name(m, small->clause_first + i), names_of_small[i]);
    for (uint32_t i = 0; i < 4; i++)
        assert_int_equal(m->CLAUSE_records[small->clause_first + i].holds,
                         m->CLAUSE_records[all->clause_first + i].holds);
    const tn_clause_record *clause = &m->CLAUSE_records[small->clause_first];
    assert_int_equal(clause[0].kind, TN_CLAUSE_REQUIRE);
    assert_int_equal(clause[0].holds, m->RULE_records[0].holds);
    assert_string_equal(tn_text(m, clause[0].doc), "of a");
    assert_string_equal(tn_text(m, clause[1].doc), "not empty");
    assert_int_equal(clause[2].kind, TN_CLAUSE_PRUNE);
    assert_int_equal(clause[3].kind, TN_CLAUSE_TOTAL);
    assert_string_equal(listing(m, clause[3].holds), "TRAY SUM RETURN");
    assert_string_equal(tn_text(m, clause[6].doc), "together");
    assert_string_equal(listing(m, clause[6].holds), "TRAY SOMEWHERE CALL AND RETURN");
    drop(&c);
}

/* Each instruction has its place, and the stack's bound is the least. */
static void places_and_stacks(void **state)
{
    (void)state;
    compiled c = compile(
        SCHEMA
        "rule r = neighbour(tray(4'), neighbour(any, any) or distance(from any, to any, by quantity(any, n > 1)))\n"
        "library l { trays 2 prune r require sum(width, w > 8') }");
    const tn_module *m = c.module;
    size_t count = 0;
    for (size_t f = 0; f < m->FUNCTION_count; f++) {
        const tn_function_record *function = &m->FUNCTION_records[f];
        uint32_t depth = 0, most = 0;
        for (uint32_t at = function->code_begin; at < function->code_end; count++) {
            const tn_source_map_record *place = tn_module_place(m, at);
            assert_non_null(place);
            assert_int_equal(m->SOURCE_MAP_records[count].offset, at);
            assert_true(place->begin < place->end);
            tn_opcode_effect effect = tn_code_effect(m->code[at]);
            depth += effect.pushes;
            depth -= effect.pops;
            most = depth > most ? depth : most;
            at += tn_code_read(m->code, at).length;
        }
        assert_int_equal(function->stack_max, most);
    }
    assert_int_equal(count, m->SOURCE_MAP_count);
    drop(&c);
}

/* a and b and c ...: as long as the author likes, without a stack that grows. */
static void long_chains(void **state)
{
    (void)state;
    enum { TERMS = 100000 };
    static const char *const joins[] = {" and any", " or any"};
    for (int j = 0; j < 2; j++) {
        size_t size = sizeof SCHEMA + 64 + TERMS * strlen(joins[j]);
        char *text = malloc(size);
        assert_non_null(text);
        size_t used = (size_t)snprintf(text, size, SCHEMA "rule r = any");
        for (int i = 0; i < TERMS; i++, used += strlen(joins[j]))
            memcpy(text + used, joins[j], strlen(joins[j]));
        compiled c = compile_sized(text, used);
        assert_int_equal(c.module->FUNCTION_records[0].stack_max, 2);
        drop(&c);
        free(text);
    }
}

static void same_bytes(void **state)
{
    (void)state;
    static const char text[] =
        SCHEMA "rule a = symmetric neighbour(tray(4'), quantity(any, n > 1))\nlibrary l { trays 2 prune a, any }";
    compiled first = compile(text), second = compile(text);
    assert_int_equal(first.compilation.module_size, second.compilation.module_size);
    assert_memory_equal(first.compilation.module, second.compilation.module, first.compilation.module_size);
    drop(&first);
    drop(&second);
}

static void tests_of_files(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule r = any\nlibrary l { trays 2 prune r }\n"
                                "test r { match [8' | 4' public machine empty] \"why\" reject [] }\n"
                                "test l { keep [8'] drop [12' double] by r, trays }\n");
    const tn_program *program = c.compilation.program;
    assert_int_equal(program->test_count, 2);
    const tn_test_case *first = &program->tests[0].cases[0];
    static const uint8_t values[] = {1, 0, 0, 0, 0, 0, 1, 2};
    assert_int_equal(first->length, 2);
    assert_memory_equal(first->values, values, sizeof values);
    assert_string_equal(first->doc, "why");
    assert_int_equal(program->tests[0].cases[1].length, 0);
    assert_true(program->tests[1].is_library);
    const tn_test_case *dropped = &program->tests[1].cases[1];
    assert_int_equal(dropped->expectation, TN_EXPECT_DROP);
    assert_int_equal(dropped->by_count, 2);
    assert_string_equal(dropped->by[0], "r");
    assert_string_equal(dropped->by[1], "trays");
    drop(&c);
}

static void allowances(void **state)
{
    (void)state;
    compiled c = compile(SCHEMA "rule r allow W002, w011 = tray(4') and tray(single)\n"
                                "rule q = any\n");
    const tn_program *program = c.compilation.program;
    assert_int_equal(c.compilation.diagnostics.count, 0);
    tn_span r = {0, c.module->RULE_records[0].begin, c.module->RULE_records[0].end};
    tn_span q = {0, c.module->RULE_records[1].begin, c.module->RULE_records[1].end};
    assert_true(tn_program_allows(program, W_ALWAYS_MATCHES, r));
    assert_false(tn_program_allows(program, W_NEVER_MATCHES, r));
    assert_false(tn_program_allows(program, W_ALWAYS_MATCHES, q));
    drop(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(expressions),       cmocka_unit_test(names),
        cmocka_unit_test(judgements),        cmocka_unit_test(nested_symmetric),
        cmocka_unit_test(conditions),        cmocka_unit_test(equal_parts_are_shared),
        cmocka_unit_test(doublings),         cmocka_unit_test(schemas),
        cmocka_unit_test(specifiers),        cmocka_unit_test(libraries),
        cmocka_unit_test(places_and_stacks), cmocka_unit_test(long_chains),
        cmocka_unit_test(same_bytes),        cmocka_unit_test(tests_of_files),
        cmocka_unit_test(allowances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
