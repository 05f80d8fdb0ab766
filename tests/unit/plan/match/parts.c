/* The parts of a rule in words: whole where there is room, cut between two characters where there is not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/plan/match/parts.h"
#include "tests/support/test_rule.h"

static const char source[] = "schema s {\n"
                             "    zone body = dense | open\n"
                             "    great = flag\n"
                             "}\n"
                             "rule r = tray(great) # einß\n"
                             "    and not tray(not great)\n";

static const char whole[] = "tray(great) and not tray(not great)";

/* What the buffer held before does not matter. */
static void root_text(const tn_parts *parts, size_t size, char *text)
{
    char other[TN_PART_TEXT_MAX];
    memset(text, 0, TN_PART_TEXT_MAX);
    memset(other, 0x80, TN_PART_TEXT_MAX);
    tn_part_text(parts, 0, text, size);
    tn_part_text(parts, 0, other, size);
    assert_string_equal(text, other);
}

static void cut(void **state)
{
    (void)state;
    tn_opened opened;
    tn_parts parts;
    tn_error error;
    char text[TN_PART_TEXT_MAX];
    assert_int_equal(tn_open_bytes("r.plan", (const uint8_t *)source, strlen(source), false, &opened), TN_OK);
    test_ok(tn_parts_read(opened.module, opened.module->RULE_records[0].holds, &parts, &error), &error);
    root_text(&parts, sizeof text, text);
    assert_string_equal(text, whole);
    for (size_t size = 8; size < sizeof whole; size++) {
        root_text(&parts, size, text);
        size_t length = strlen(text);
        assert_in_range(length, 3, size - 1);
        assert_string_equal(text + length - 3, "...");
        assert_memory_equal(text, whole, length - 3);
    }
    tn_parts_clear(&parts);
    tn_close(&opened);
}

static const char sums[] = "schema s { width = 4m | 8m  public = flag }\n"
                           "rule few = not quantity(tray(public)) <= trays - 1\n"
                           "rule spread = sum(width of tray(public)) in 8m..12m\n"
                           "rule whole = 2 * matches(few) + trays != 4\n"
                           "rule beside(a, b) = symmetric neighbour(a, b)\n"
                           "rule pair = not beside(tray(public), tray(4m))\n";

static void assert_part(const tn_parts *parts, uint32_t part, tn_part_kind kind, const char *text)
{
    char found[TN_PART_TEXT_MAX];
    assert_true(part < parts->count);
    assert_int_equal(parts->parts[part].kind, kind);
    tn_part_text(parts, part, found, sizeof found);
    assert_string_equal(found, text);
}

static void read_holds(const tn_module *module, const char *name, tn_parts *parts)
{
    tn_error error;
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (strcmp(tn_text(module, module->RULE_records[i].name), name) == 0) {
            test_ok(tn_parts_read(module, module->RULE_records[i].holds, parts, &error), &error);
            return;
        }
    fail_msg("no rule %s", name);
}

/* A comparison is one part, however many instructions it has; a call of a rule with parameters has its author's words.
 */
static void compared(void **state)
{
    (void)state;
    static const struct {
        const char *rule, *text;
    } alone[] = {{"spread", "sum(width of tray(public)) in 8m..12m"}, {"whole", "2 * matches(few) + trays != 4"}};
    tn_opened opened;
    tn_parts parts;
    assert_int_equal(tn_open_bytes("r.plan", (const uint8_t *)sums, strlen(sums), false, &opened), TN_OK);
    for (size_t i = 0; i < sizeof alone / sizeof *alone; i++) {
        read_holds(opened.module, alone[i].rule, &parts);
        assert_int_equal(parts.count, 1);
        assert_part(&parts, 0, TN_PART_COMPARISON, alone[i].text);
        tn_parts_clear(&parts);
    }
    read_holds(opened.module, "few", &parts);
    assert_int_equal(parts.count, 2);
    assert_int_equal(parts.parts[0].kind, TN_PART_NOT);
    assert_part(&parts, 1, TN_PART_COMPARISON, "quantity(tray(public)) <= trays - 1");
    tn_parts_clear(&parts);
    read_holds(opened.module, "pair", &parts);
    assert_int_equal(parts.parts[0].kind, TN_PART_NOT);
    assert_part(&parts, 1, TN_PART_RULE, "beside(tray(public), tray(4m))");
    tn_parts_clear(&parts);
    tn_close(&opened);
}

/* ---- code that no author can have written */

/* A rule of one tray, and a condition n > 1. */
enum { WHOLE, CONDITION };

static uint32_t end_function(tn_builder *builder, tn_function_kind kind, uint32_t begin)
{
    tn_builder_emit(builder, kind == TN_FUNCTION_CONDITION ? TN_OP_ANSWER : TN_OP_RETURN, 0, 0);
    return tn_builder_add_FUNCTION(
        builder, &(tn_function_record){
                     .kind = kind, .code_begin = begin, .code_end = tn_builder_offset(builder), .stack_max = 3});
}

static tn_builder *begin_module(void)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    uint32_t any = test_spec_add(builder, test_schema_add(builder, &test_schema_tiny), 0x0f);
    uint32_t begin = tn_builder_offset(builder);
    tn_builder_emit(builder, TN_OP_TRAY, any, 0);
    end_function(builder, TN_FUNCTION_WHOLE, begin);
    begin = tn_builder_offset(builder);
    tn_builder_emit(builder, TN_OP_GREATER, 1, 0);
    end_function(builder, TN_FUNCTION_CONDITION, begin);
    return builder;
}

/* The module verifies; reading the parts of its last function, the rule's, ends so. */
static void expect_parts(tn_builder *builder, tn_status wanted)
{
    tn_parts parts;
    tn_error error = {0};
    uint32_t holds = (uint32_t)tn_builder_count(builder, TN_SECTION_FUNCTION) - 1;
    tn_builder_add_RULE(builder,
                        &(tn_rule_record){.name = tn_builder_string(builder, "r"), .whole = WHOLE, .holds = holds});
    tn_module *module = test_module(builder);
    assert_int_equal(tn_parts_read(module, holds, &parts, &error), wanted);
    assert_true(wanted == TN_OK || error.code == E_REFUSED_MODULE);
    tn_parts_clear(&parts);
    tn_module_free(module);
}

/* The first instruction, `more` if it is not NOT, and a count of that. */
static void expect_counted(tn_opcode first, tn_opcode more, tn_opcode count, tn_status wanted)
{
    tn_builder *builder = begin_module();
    uint32_t begin = tn_builder_offset(builder);
    tn_builder_emit(builder, first, WHOLE, 0);
    if (more != TN_OP_NOT)
        tn_builder_emit(builder, more, 0, 0);
    tn_builder_emit(builder, count, CONDITION, 0);
    end_function(builder, TN_FUNCTION_HOLDS, begin);
    expect_parts(builder, wanted);
}

static void foreign(void **state)
{
    (void)state;
    expect_counted(TN_OP_CALL, TN_OP_NOT, TN_OP_OCCURRENCES, TN_OK);
    expect_counted(TN_OP_MIRROR, TN_OP_NOT, TN_OP_OCCURRENCES, TN_INVALID);
    expect_counted(TN_OP_MIRROR, TN_OP_NONEMPTY, TN_OP_QUANTITY, TN_INVALID);
    expect_counted(TN_OP_CALL, TN_OP_SOMEWHERE, TN_OP_QUANTITY, TN_INVALID);
}

/* Each function mirrors the one before twice: written out, they are more parts than there is memory for. */
static void doubled(void **state)
{
    (void)state;
    tn_builder *builder = begin_module();
    uint32_t before = WHOLE, begin;
    for (int i = 0; i < 40; i++) {
        begin = tn_builder_offset(builder);
        for (int twice = 0; twice < 2; twice++) {
            tn_builder_emit(builder, TN_OP_CALL, before, 0);
            tn_builder_emit(builder, TN_OP_MIRROR, before, 0);
            tn_builder_emit(builder, TN_OP_OR, 0, 0);
        }
        tn_builder_emit(builder, TN_OP_AND, 0, 0);
        before = end_function(builder, i < 39 ? TN_FUNCTION_WHOLE : TN_FUNCTION_HOLDS, begin);
    }
    expect_parts(builder, TN_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cut), cmocka_unit_test(compared), cmocka_unit_test(foreign),
                                       cmocka_unit_test(doubled)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
