/* A schema whose trays are kept as a diagram, its library and the best of its plans, where memory runs out at each
 * allocation in turn: an error, and nothing is lost. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/library/library.h"
#include "runtime/plan/measure/best.h"
#include "tests/support/fail_each.h"
#include "tests/support/load_plan.h"

/* Five legal trays; of two trays all but b and then a shop are kept. */
static const char text[] = "schema stall { width = 3m | 4m  use = home | shop  f = flag\n"
                           "  number rent = width / 1m where tray(shop) | 1 where tray(f) | 0\n"
                           "  forbid tray(4m, f)\n  forbid tray(home, f) }\n"
                           "rule beside using stall = neighbour(tray(4m), tray(shop))\n"
                           "measure rents using stall = sum(rent)\n"
                           "library row using stall { trays 1..2  prune beside }\n";

static struct {
    tn_compilation compilation;
    tn_module *module;
} opened;

static int setup(void **state)
{
    (void)state;
    opened.module = load_plan(text, &opened.compilation);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    tn_module_free(opened.module);
    tn_compilation_clear(&opened.compilation);
    return 0;
}

static void check_library(const tn_library *library)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    assert_int_equal(mpz_get_ui(kept), 5 + 25 - 2 * 3);
    mpz_clear(kept);
}

static tn_status best(void)
{
    static const bool most[] = {true};
    static const uint32_t measures[] = {0};
    tn_schema *schema = NULL;
    tn_library *library = NULL;
    tn_weighed *weighed = NULL;
    tn_best *made = NULL;
    tn_tray trays[2];
    uint32_t length;
    int64_t values[TN_WEIGHED_MAX];
    bool found;
    tn_error error = {0};
    tn_status status = tn_schema_new(opened.module, 0, 1, &schema, &error);
    if (status == TN_OK)
        status = tn_library_new(schema, 0, NULL, &library, &error);
    if (status == TN_OK)
        status = tn_weighed_new(library, measures, 1, &weighed, &error);
    if (status == TN_OK)
        status = tn_best_new(weighed, most, &made, &error);
    if (status == TN_OK)
        status = tn_best_next(made, trays, &length, values, &found, &error);
    if (status == TN_OK) {
        assert_non_null(schema->legal);
        check_library(library);
        assert_true(found);
        assert_int_equal(length, 2);
        assert_int_equal(values[0], 3 + 4);
    }
    assert_int_equal(error.status, status);
    tn_best_free(made);
    tn_weighed_free(weighed);
    tn_library_free(library);
    tn_schema_free(schema);
    return status;
}

static void test_memory(void **state)
{
    (void)state;
    fail_each(best, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_memory)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
