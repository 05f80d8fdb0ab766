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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cut), cmocka_unit_test(compared)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
