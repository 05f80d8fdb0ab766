/* The tree of boxes against looking at all of them: random boxes, many of them on a lattice, flat ones and points. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/geometry/union/box_tree.h"

enum { MOST = 400 };

static uint64_t state = 7;

static double draw(double low, double high, bool lattice)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    double x = low + (high - low) * ((double)(state >> 11) / 9007199254740992.0);
    return lattice ? (double)(int)(x * 2) / 2 : x;
}

static bool meet(const tn_box_bounds *p, const tn_box_bounds *q)
{
    for (int k = 0; k < 3; k++)
        if (p->low[k] > q->high[k] || q->low[k] > p->high[k])
            return false;
    return true;
}

static void check_search(const tn_box_tree *tree, const tn_box_bounds *box)
{
    bool found[MOST] = {false};
    tn_box_search search;
    uint32_t at;
    tn_box_tree_search(tree, box, &search);
    while (tn_box_search_next(&search, &at)) {
        assert_true(at < tree->count && !found[at]);
        found[at] = true;
    }
    for (uint32_t i = 0; i < tree->count; i++)
        assert_int_equal(found[i], meet(&tree->boxes[i], box));
}

static void test_searches(void **unused)
{
    (void)unused;
    static tn_box_bounds boxes[MOST];
    for (uint32_t count = 0; count < MOST; count = count < 20 ? count + 1 : count * 3 / 2) {
        bool lattice = count % 2;
        tn_error error = {0};
        tn_box_tree tree;
        for (uint32_t i = 0; i < count; i++)
            for (int k = 0; k < 3; k++) {
                boxes[i].low[k] = draw(0, 9, lattice);
                boxes[i].high[k] = boxes[i].low[k] + (i % 7 ? draw(0, 3, lattice) : 0);
            }
        assert_int_equal(tn_box_tree_make(boxes, count, &tree, &error), TN_OK);
        for (uint32_t i = 0; i < count; i++)
            check_search(&tree, &boxes[i]);
        check_search(&tree, &(tn_box_bounds){{-9, -9, -9}, {99, 99, 99}});
        check_search(&tree, &(tn_box_bounds){{-9, -9, -9}, {-8, 99, 99}});
        tn_box_tree_clear(&tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_searches)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
