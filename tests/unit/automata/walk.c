/* The layered walk: counts forwards, backwards and along a path, against all words one by one. */
#include "tests/unit/automata/walk_graph.h"

/* Words from a state with so many layers behind it, and how many of them end there. */
static uint64_t count_slowly(const walk_graph *graph, uint32_t state, uint32_t left)
{
    uint64_t words = graph->accepts[state];
    for (uint32_t to = 0; left > 0 && to < WALK_STATES; to++)
        if (graph->symbols[state][to] > 0)
            words += graph->symbols[state][to] * count_slowly(graph, to, left - 1);
    return words;
}

static uint64_t count_all_slowly(const walk_graph *graph)
{
    uint64_t words = 0;
    for (uint32_t n = 0; n <= WALK_LAST; n++)
        if (graph->starts[n])
            words += count_slowly(graph, 0, WALK_LAST - n);
    return words;
}

static void test_forwards(void **state)
{
    test_random random = {1, 0};
    (void)state;
    for (int i = 0; i < 200; i++) {
        walk_graph graph;
        tn_layers walk = {0};
        tn_error error = {0};
        walk_graph_random(&random, &graph);
        assert_int_equal(walk_count(&walk, &graph, false, &error), TN_OK);
        assert_int_equal(graph.all, count_all_slowly(&graph));
        tn_walk_clear(&walk, &walk_counts, NULL);
    }
}

static void test_backwards(void **state)
{
    test_random random = {2, 0};
    (void)state;
    for (int i = 0; i < 200; i++) {
        walk_graph graph;
        tn_layers walk = {0};
        tn_error error = {0};
        uint64_t words = 0;
        walk_graph_random(&random, &graph);
        assert_int_equal(walk_count(&walk, &graph, true, &error), TN_OK);
        for (uint32_t n = 0; n <= WALK_LAST; n++) {
            const tn_walk_layer *layer = tn_walk_at(&walk, n);
            assert_int_equal(layer->start != TN_NO_STATE, graph.starts[n]);
            if (graph.starts[n])
                words += walk_number(tn_walk_backward_of(&walk, n, layer->start));
            for (uint32_t k = 0; k < layer->count; k++)
                assert_int_equal(walk_number(tn_walk_backward_of(&walk, n, k)),
                                 count_slowly(&graph, layer->states[k], WALK_LAST - n));
        }
        assert_int_equal(words, graph.all);
        tn_walk_clear(&walk, &walk_counts, &walk_counts_back);
    }
}

/* What goes through the edges from a node, in words. */
typedef struct passing {
    const tn_layers *walk;
    uint64_t words;
} passing;

static tn_status pass(void *context, const tn_walk_edge *edge, tn_error *error)
{
    passing *p = context;
    (void)error;
    p->words += *(const uint64_t *)edge->label * walk_number(tn_walk_backward_of(p->walk, edge->layer + 1, edge->to));
    return TN_OK;
}

static void test_path(void **state)
{
    test_random random = {3, 0};
    (void)state;
    for (int i = 0; i < 50; i++) {
        walk_graph graph;
        tn_layers walk = {0};
        tn_error error = {0};
        walk_graph_random(&random, &graph);
        assert_int_equal(walk_count(&walk, &graph, true, &error), TN_OK);
        for (uint32_t n = 0; n < WALK_LAST; n++)
            for (uint32_t k = 0; k < tn_walk_at(&walk, n)->count; k++) {
                passing p = {.walk = &walk, .words = graph.accepts[tn_walk_at(&walk, n)->states[k]]};
                assert_int_equal(tn_walk_from(&walk, &walk_test_graph, &graph, n, k, pass, &p, &error), TN_OK);
                assert_int_equal(p.words, walk_number(tn_walk_backward_of(&walk, n, k)));
            }
        tn_walk_clear(&walk, &walk_counts, &walk_counts_back);
    }
}

/* The example of walk.h: words of a and b without two b side by side. */
static void test_example(void **state)
{
    walk_graph graph = {.symbols = {{1, 1}, {1, 0}}, .accepts = {true, true}, .starts = {true}};
    tn_layers walk = {0};
    tn_error error = {0};
    static const uint64_t sums[] = {1, 2, 3, 5, 8, 13, 21, 34};
    (void)state;
    assert_int_equal(walk_count(&walk, &graph, true, &error), TN_OK);
    for (uint32_t n = 0; n <= WALK_LAST; n++) {
        uint64_t words = 0;
        for (uint32_t k = 0; k < tn_walk_at(&walk, n)->count; k++)
            words += walk_number(tn_walk_forward_of(&walk, n, k));
        assert_int_equal(words, sums[n]);
    }
    tn_walk_clear(&walk, &walk_counts, &walk_counts_back);
}

/* Layers whose states are all there from the beginning. */
static void test_filled(void **state)
{
    test_random random = {4, 0};
    walk_graph graph;
    tn_layers walk = {0};
    tn_error error = {0};
    (void)state;
    walk_graph_random(&random, &graph);
    assert_int_equal(tn_walk_begin(&walk, WALK_LAST, true, &error), TN_OK);
    for (uint32_t n = 0; n <= WALK_LAST; n++)
        assert_int_equal(tn_walk_fill(&walk, n, WALK_STATES, &error), TN_OK);
    assert_int_equal(
        tn_walk_backward(&walk, &walk_test_graph, &graph, &walk_counts_back, &graph, sizeof(uint64_t *), &error),
        TN_OK);
    for (uint32_t n = 0; n <= WALK_LAST; n++)
        for (uint32_t s = 0; s < WALK_STATES; s++)
            assert_int_equal(walk_number(tn_walk_backward_of(&walk, n, s)), count_slowly(&graph, s, WALK_LAST - n));
    tn_walk_clear(&walk, NULL, &walk_counts_back);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_forwards), cmocka_unit_test(test_backwards),
                                       cmocka_unit_test(test_path), cmocka_unit_test(test_example),
                                       cmocka_unit_test(test_filled)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
