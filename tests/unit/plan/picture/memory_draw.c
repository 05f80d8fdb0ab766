/* Out of memory while drawing: each of our allocations fails once, and then all from there on. What fails must say so,
 * and leave neither memory nor files behind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/plan/picture/draw.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_schema.h"

typedef tn_status operation(const tn_schema *schema, tn_error *error);

static tn_status draw(const tn_schema *schema, const char *extension, tn_error *error)
{
    static const tn_tray trays[] = {1, 5, 9, 200};
    const tn_drawn_plan plans[] = {
        {trays, 4, "1", "some", "7 m"}, {trays, 2, "2", NULL, NULL}, {trays, 0, NULL, "others", NULL}};
    const tn_draw_options options = {.title = "title", .number_name = "line", .dpi = 20};
    char path[64];
    snprintf(path, sizeof path, "/tmp/tartan-memory-draw-%ld.%s", (long)getpid(), extension);
    tn_status status = tn_plans_draw(schema, plans, 3, &options, &(tn_picture){.path = path}, error);
    assert_int_equal(access(path, F_OK) == 0, status == TN_OK);
    remove(path);
    return status;
}

static tn_status draw_svg(const tn_schema *schema, tn_error *error)
{
    return draw(schema, "svg", error);
}

static tn_status draw_png(const tn_schema *schema, tn_error *error)
{
    return draw(schema, "png", error);
}

static tn_status draw_pdf(const tn_schema *schema, tn_error *error)
{
    return draw(schema, "pdf", error);
}

static void fails_cleanly(void **state)
{
    static operation *const operations[] = {draw_svg, draw_png, draw_pdf};
    const tn_schema *schema = *state;
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        size_t failures = 0;
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number++) {
                tn_error error = {0};
                fail_allocation(number, all_after);
                tn_status status = operations[i](schema, &error);
                if (stop_failing() <= number) {
                    test_ok(status, &error);
                    break;
                }
                if (status == TN_OK)
                    continue;
                if (status != TN_MEMORY || error.code != E_OUT_OF_MEMORY)
                    fail_msg("operation %zu, allocation %zu: %s", i, number, error.message);
                failures++;
            }
        }
        assert_true(failures > 2);
    }
}

static tn_module *module;

static int open_schema(void **state)
{
    tn_builder *builder = tn_builder_new();
    uint32_t index = test_schema_add(builder, &test_schema_paper);
    module = test_module(builder);
    *state = test_schema_open(module, index);
    return 0;
}

static int close_schema(void **state)
{
    tn_schema_free(*state);
    tn_module_free(module);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(fails_cleanly, open_schema, close_schema)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
