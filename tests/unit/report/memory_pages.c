/* Out of memory in the page of a kit: each of our allocations fails once, and then all from there on. What fails says
 * so, what does not is the page that it is with memory enough. And what became of the kit's models. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/report/kit_report.h"
#include "tests/support/same_or_memory.h"
#include "tests/support/test_schema.h"

static const char text[] =
    "connector peg joins hole; connector hole joins peg; unit 10 x 10 x 10;\n"
    "part 1 \"<one>\" { fill 20 x 20 x 20; peg right at (10, -10, 0); hole left at (-10, -10, 0); mass 2; }\n"
    "rule row at peg = 1;\n"
    "model line { inside box(60, 20, 20) at (30, 0, 0); start peg right at (0, 10, 0) by row;\n"
    "  require elements = 3, count(1) >= 4; }\n"
    "model none { inside box(20, 20, 20); start peg right at (0, 10, 0) by row; }\n";

static void open_kit(tn_opened *opened)
{
    if (tn_open_bytes("pegs.kit", (const uint8_t *)text, strlen(text), false, opened) != TN_OK)
        fail_msg("%s", tn_first_error(opened));
}

static tn_status write_page(void *context, tn_buffer *out, tn_error *error)
{
    static const tn_kit_report_options options = {.seed = 3};
    tn_kit_report_tally tally;
    return tn_kit_report_page(context, &options, out, &tally, error);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    tn_opened opened;
    open_kit(&opened);
    same_or_memory(write_page, &opened, 6);
    tn_close(&opened);
}

/* What placing finds goes into the page, and not into the file's diagnostics. */
static void tells_what_became_of_models(void **state)
{
    (void)state;
    static const tn_kit_report_options options = {.pictures = 1};
    tn_opened opened;
    tn_kit_report_tally tally;
    tn_buffer page = {0};
    tn_error error = {0};
    open_kit(&opened);
    size_t before = opened.compilation.diagnostics.count;
    test_ok(tn_kit_report_page(&opened, &options, &page, &tally, &error), &error);
    assert_int_equal(tally.models, 2);
    assert_int_equal(tally.unplaced, 1);
    assert_int_equal(tally.unmet, 1);
    assert_int_equal(opened.compilation.diagnostics.count, before);
    assert_int_equal(opened.compilation.diagnostics.error_count, 0);
    free(page.data);
    tn_close(&opened);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail),
                                       cmocka_unit_test(tells_what_became_of_models)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
