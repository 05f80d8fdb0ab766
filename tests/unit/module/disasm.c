/* The listing of a module, to the letter; and that nothing in a module makes it endless or upsets a terminal. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/plan/match/condition.h"
#include "tests/support/sample_module.h"

static char *listing(tn_builder *builder)
{
    uint8_t *bytes;
    size_t size;
    char *text;
    tn_module *module;
    tn_error error;
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, NULL), TN_OK);
    if (tn_module_load(bytes, size, NULL, &module, &error) != TN_OK)
        fail_msg("%s", error.message);
    FILE *out = open_memstream(&text, &size);
    assert_true(tn_module_disassemble(module, out));
    fclose(out);
    tn_module_free(module);
    tn_builder_free(builder);
    free(bytes);
    return text;
}

static void test_sample(void **state)
{
    (void)state;
    char *text = listing(sample_builder());
    char *rest = strchr(text, '\n'); /* after the line with the hash */
    assert_memory_equal(text, "module: format 2, hash ", 23);
    assert_string_equal(
        rest,
        "\n"
        "written by tartan 0.0.0 from sources with hash 000000000000004d\n"
        "source 0  toy.plan\n"
        "\n"
        "schema 0  toy \"small trays\"  (toy.plan:1)\n"
        "  field 0  width: length, role length \"a field\"\n"
        "      4'  1219200000 nm\n"
        "      8'  2438400000 nm\n"
        "  field 1  height: choice, role level \"a field\"\n"
        "      single\n"
        "      double\n"
        "  field 2  public: flag, role public-end \"a field\"\n"
        "      -\n"
        "      public\n"
        "  field 3  body: zone, role band \"a field\"\n"
        "      open:8'  fill open, 2438400000 nm, void\n"
        "      empty  fill empty, 0 nm, absent\n"
        "  forbids specifier 0\n"
        "\n"
        "specifiers\n"
        "  0  width 8', body empty\n"
        "  1  width 4'\n"
        "\n"
        "rules\n"
        "  0  pair \"two 4' trays\": whole function 1, holds function 2  (toy.plan:4)\n"
        "\n"
        "library 0  toys using toy: 1..6 trays  (toy.plan:5)\n"
        "  prune pair: function 2  (toy.plan:1)\n"
        "  require require@5: function 3  (toy.plan:1)\n"
        "\n"
        "function 0 (condition (n < 5 or n = -1) and n > 1 and not n in 2..4 or n mod 3 = 1), stack 2\n"
        "       0  LESS        5\n"
        "       9  EQUAL       -1\n"
        "      18  EITHER\n"
        "      19  GREATER     1\n"
        "      28  BOTH\n"
        "      29  WITHIN      2, 4\n"
        "      46  NEITHER\n"
        "      47  BOTH\n"
        "      48  REMAINDER   3, 1\n"
        "      65  EITHER\n"
        "      66  ANSWER\n"
        "\n"
        "function 1 (whole pair) of toy, stack 2\n"
        "  ; toy.plan:4: rule pair = neighbour(tray(4'), tray(4'))\n"
        "      67  TRAY        spec 1  width 4'\n"
        "      72  NONEMPTY\n"
        "      73  TRAY        spec 1  width 4'\n"
        "      78  CHAIN\n"
        "      79  RETURN\n"
        "\n"
        "function 2 (holds pair) of toy, stack 1\n"
        "  ; toy.plan:4: rule pair = neighbour(tray(4'), tray(4'))\n"
        "      80  CALL        function 1 (whole pair)\n"
        "      85  SOMEWHERE\n"
        "      86  RETURN\n"
        "\n"
        "function 3 (holds everything) of toy, stack 3\n"
        "  ; toy.plan:5: library toys using toy { trays 1..6 prune pair }\n"
        "      87  MIRROR      function 1 (whole pair)\n"
        "      92  QUANTITY    function 0 (condition (n < 5 or n = -1) and n > 1 and not n in 2..4 or n mod 3 = 1)\n"
        "      97  CALL        function 1 (whole pair)\n"
        "     102  SUM         field 0 (width), function 0 (condition (n < 5 or n = -1) and n > 1 and not n in 2..4 or "
        "n mod 3 = 1)\n"
        "     111  AND\n"
        "     112  OCCURRENCES function 0 (condition (n < 5 or n = -1) and n > 1 and not n in 2..4 or n mod 3 = 1)\n"
        "     117  NOT\n"
        "     118  BEGINNING\n"
        "     119  TRAY        spec 1  width 4'\n"
        "     124  MANY\n"
        "     125  REPEATED    2, 3\n"
        "     142  OPTIONAL\n"
        "     143  END\n"
        "     144  CALL        function 2 (holds pair)\n"
        "     149  DISTANCE\n"
        "     150  TRAY        spec 1  width 4'\n"
        "     155  TRAY        spec 1  width 4'\n"
        "     160  NEAR\n"
        "     161  TRAY        spec 1  width 4'\n"
        "     166  TRAY        spec 1  width 4'\n"
        "     171  FAR\n"
        "     172  MIRRORED    field 0  width\n"
        "     177  WHERE\n"
        "     178  TRAY        spec 1  width 4'\n"
        "     183  OR\n"
        "     184  ONCE\n"
        "     185  RETURN\n"
        "\n"
        "function 4 (circle row) of toy, stack 2\n"
        "  ; toy.plan:4: rule pair = neighbour(tray(4'), tray(4'))\n"
        "     186  TRAY        spec 1  width 4'\n"
        "     191  NONEMPTY\n"
        "     192  AGAIN       function 4 (circle row)\n"
        "     197  OPTIONAL\n"
        "     198  CHAIN\n"
        "     199  RETURN\n"
        "\n"
        "function 5 (holds toys) of toy, stack 1\n"
        "  ; toy.plan:5: library toys using toy { trays 1..6 prune pair }\n"
        "     200  IMAGE       library toys onto toy\n"
        "     209  RETURN\n");
    free(text);
}

static void test_long_texts_are_cut(void **state)
{
    (void)state;
    tn_builder *builder = sample_builder();
    char doc[5001];
    memset(doc, 'd', 5000);
    doc[5000] = '\0';
    doc[100] = '\x1b';
    tn_schema_record schema = {.name = tn_builder_string(builder, "toy"),
                               .doc = tn_builder_string(builder, doc),
                               .field_count = 4,
                               .forbid_count = 1,
                               .from = TN_NO_RECORD,
                               .of = TN_NO_RECORD};
    tn_builder_set_SCHEMA(builder, 0, &schema);
    char *text = listing(builder);
    assert_null(strchr(text, '\x1b'));
    for (char *line = text, *end; (end = strchr(line, '\n')); line = end + 1)
        assert_true(end - line < 400);
    free(text);
}

/* Conditions are written back with the parentheses that they need and no others; long ones are not written at all. */
static void expect_condition(const int64_t *code, const char *wanted)
{
    tn_builder *builder = tn_builder_new();
    for (; code[0] >= 0; code += 3)
        tn_builder_emit(builder, (tn_opcode)code[0], code[1], code[2]);
    tn_builder_emit(builder, TN_OP_ANSWER, 0, 0);
    tn_builder_add_FUNCTION(
        builder,
        &(tn_function_record){.kind = TN_FUNCTION_CONDITION, .code_end = tn_builder_offset(builder), .stack_max = 100});
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, NULL), TN_OK);
    assert_int_equal(tn_module_load(bytes, size, NULL, &module, NULL), TN_OK);
    char text[TN_CONDITION_TEXT_MAX];
    tn_condition_text(module, 0, text);
    assert_string_equal(text, wanted);
    tn_module_free(module);
    tn_builder_free(builder);
    free(bytes);
}

#define CODE(...) ((const int64_t[]){__VA_ARGS__, -1})
#define LESS(k) TN_OP_LESS, (k), 0
#define BOTH TN_OP_BOTH, 0, 0
#define EITHER TN_OP_EITHER, 0, 0
#define NEITHER TN_OP_NEITHER, 0, 0

static void test_conditions(void **state)
{
    (void)state;
    expect_condition(CODE(LESS(1)), "n < 1");
    expect_condition(CODE(LESS(1), NEITHER), "not n < 1");
    expect_condition(CODE(LESS(1), NEITHER, NEITHER), "not not n < 1");
    expect_condition(CODE(LESS(1), LESS(2), EITHER, NEITHER), "not (n < 1 or n < 2)");
    expect_condition(CODE(LESS(1), LESS(2), BOTH, LESS(3), EITHER), "n < 1 and n < 2 or n < 3");
    expect_condition(CODE(LESS(1), LESS(2), LESS(3), EITHER, BOTH), "n < 1 and (n < 2 or n < 3)");
    int64_t code[3 * 200 + 1];
    size_t at = 0;
    for (int i = 0; i < 100; i++) { /* wide: 100 comparisons joined from the left */
        code[at] = TN_OP_LESS;
        code[at + 1] = i;
        at += 3;
        if (i > 0) {
            code[at] = TN_OP_EITHER;
            at += 3;
        }
    }
    code[at] = -1;
    expect_condition(code, "...");
    for (at = 0; at < 3 * 50; at += 3) { /* deep: 50 on the stack */
        code[at] = TN_OP_LESS;
        code[at + 1] = 1;
    }
    for (; at < 3 * 99; at += 3)
        code[at] = TN_OP_BOTH;
    code[at] = -1;
    expect_condition(code, "...");
}

static void test_failed_writing_is_told(void **state)
{
    (void)state;
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    tn_builder *builder = sample_builder();
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, NULL), TN_OK);
    assert_int_equal(tn_module_load(bytes, size, NULL, &module, NULL), TN_OK);
    FILE *full = fopen("/dev/full", "w");
    setvbuf(full, NULL, _IONBF, 0);
    assert_false(tn_module_disassemble(module, full));
    fclose(full);
    tn_module_free(module);
    tn_builder_free(builder);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sample),
        cmocka_unit_test(test_long_texts_are_cut),
        cmocka_unit_test(test_conditions),
        cmocka_unit_test(test_failed_writing_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
