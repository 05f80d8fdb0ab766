/* Walks where memory runs out at each allocation in turn: an error, and nothing is lost. */
#include "tests/support/failing_memory.h"
#include "tests/unit/automata/walk_graph.h"

static void fail_each(bool kept)
{
    test_random random = {5, 0};
    walk_graph graph;
    walk_graph_random(&random, &graph);
    for (size_t failing = 0;; failing++) {
        tn_layers walk = {0};
        tn_error error = {0};
        fail_allocation(failing, 0);
        tn_status status = walk_count(&walk, &graph, kept, &error);
        size_t asked = stop_failing();
        tn_walk_clear(&walk, &walk_counts, &walk_counts_back);
        if (asked <= failing) {
            assert_int_equal(status, TN_OK);
            assert_true(failing >= 20);
            break;
        }
        assert_int_equal(status, TN_MEMORY);
        assert_int_equal(error.status, status);
    }
}

static void test_two_layers(void **state)
{
    (void)state;
    fail_each(false);
}

static void test_kept_layers(void **state)
{
    (void)state;
    fail_each(true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_two_layers), cmocka_unit_test(test_kept_layers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
