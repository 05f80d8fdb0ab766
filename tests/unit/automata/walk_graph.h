/* A small random automaton as a graph in layers, and counting its words by the layered walk. */
#ifndef TARTAN_TESTS_WALK_GRAPH_H
#define TARTAN_TESTS_WALK_GRAPH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/automata/walk.h"
#include "tests/support/test_rule.h"

enum { WALK_STATES = 9, WALK_LAST = 7 };

typedef struct walk_graph {
    uint64_t symbols[WALK_STATES][WALK_STATES]; /* that lead from one state to another */
    bool accepts[WALK_STATES];
    bool starts[WALK_LAST + 1]; /* by layer */
    uint64_t all;               /* words that ended, forwards */
} walk_graph;

static inline void walk_graph_random(test_random *random, walk_graph *graph)
{
    *graph = (walk_graph){0};
    for (uint32_t p = 0; p < WALK_STATES; p++) {
        graph->accepts[p] = test_random_below(random, 3) == 0;
        for (uint32_t q = 0; q < WALK_STATES; q++)
            graph->symbols[p][q] = test_random_below(random, 3) == 0 ? 1 + test_random_below(random, 3) : 0;
    }
    for (uint32_t n = 0; n <= WALK_LAST; n++)
        graph->starts[n] = test_random_below(random, 3) == 0;
}

static bool walk_starts(void *context, uint32_t layer)
{
    const walk_graph *graph = context;
    return graph->starts[layer];
}

static tn_status walk_edges(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                            tn_error *error)
{
    const walk_graph *graph = context;
    tn_status status = TN_OK;
    assert_true(layer < WALK_LAST);
    for (uint32_t to = 0; status == TN_OK && to < WALK_STATES; to++)
        if (graph->symbols[state][to] > 0)
            status = seen(walk, to, &graph->symbols[state][to], error);
    return status;
}

static const tn_walk_graph walk_test_graph = {walk_starts, walk_edges};

/* An element is a number that it owns, so that one which is not freed is noticed. */
static void walk_zero(const void *context, void *element)
{
    (void)context;
    *(uint64_t **)element = NULL;
}

static void walk_free(void *element)
{
    free(*(uint64_t **)element);
}

static inline uint64_t walk_number(const void *element)
{
    uint64_t *number = *(uint64_t *const *)element;
    return number ? *number : 0;
}

static tn_status walk_more(void *element, uint64_t more, tn_error *error)
{
    uint64_t **number = element;
    if (!*number && !(*number = calloc(1, sizeof **number)))
        return tn_fail_memory(error);
    **number += more;
    return TN_OK;
}

static tn_status walk_one(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    (void)context, (void)layer;
    assert_int_equal(state, 0);
    return walk_more(element, 1, error);
}

static tn_status walk_add(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    (void)context;
    return walk_more(sum, walk_number(element) * *(const uint64_t *)edge->label, error);
}

static tn_status walk_settle(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    walk_graph *graph = context;
    (void)layer, (void)error;
    if (graph->accepts[state])
        graph->all += walk_number(element);
    return TN_OK;
}

static tn_status walk_end(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const walk_graph *graph = context;
    (void)layer;
    return graph->accepts[state] ? walk_more(element, 1, error) : TN_OK;
}

TN_WALK_ALGEBRA(walk_counts, walk_zero, walk_free, walk_one, walk_add, walk_settle);
TN_WALK_ALGEBRA(walk_counts_back, walk_zero, walk_free, walk_end, walk_add, NULL);

/* Counts in one direction, or in both if layers are kept. Clear the walk in any case. */
static inline tn_status walk_count(tn_layers *walk, walk_graph *graph, bool kept, tn_error *error)
{
    tn_status status = tn_walk_begin(walk, WALK_LAST, kept, error);
    if (status == TN_OK)
        status = tn_walk_forward(walk, &walk_test_graph, graph, &walk_counts, graph, sizeof(uint64_t *), error);
    if (status == TN_OK && kept)
        status = tn_walk_backward(walk, &walk_test_graph, graph, &walk_counts_back, graph, sizeof(uint64_t *), error);
    return status;
}

#endif
