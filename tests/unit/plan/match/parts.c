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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cut)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
