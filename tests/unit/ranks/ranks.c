/* What ranks agree on: any, the first failure, what the first tells, and that all have the same. */
#include "runtime/ranks/ranks.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/test_ranks.h"

#define RANKS 5u

typedef struct heard {
    bool none, one;
    tn_status status[3];
    tn_error error[3];
    uint8_t *bytes;
    size_t size;
    uint64_t taken;
} heard;

static void work(const tn_ranks *ranks, void *context)
{
    heard *h = (heard *)context + ranks->rank;
    h->none = tn_ranks_any(ranks, false);
    h->one = tn_ranks_any(ranks, ranks->rank == 3);
    h->status[0] = tn_ranks_agree(ranks, TN_OK, &h->error[0]);
    bool fails = ranks->rank == 2 || ranks->rank == 4;
    if (fails)
        tn_fail(&h->error[0], TN_IO, E_CANNOT_READ, "rank %u", ranks->rank);
    h->status[0] = tn_ranks_agree(ranks, fails ? TN_IO : TN_OK, &h->error[0]);
    if (ranks->rank == 0) {
        h->size = 1000;
        h->bytes = calloc(h->size, 1);
        h->bytes[999] = 7;
    }
    h->status[1] = tn_ranks_tell(ranks, &h->bytes, &h->size, &h->error[1]);
    h->status[2] = tn_ranks_same(ranks, "the word", ranks->rank == 3 ? "another" : "one", &h->error[2]);
    for (int round = 0; round < 50; round++) {
        ranks->restart(ranks->context);
        while (ranks->take(ranks->context, 3) < 300)
            h->taken += 3;
        tn_ranks_any(ranks, false);
    }
}

static void test_together(void **state)
{
    (void)state;
    heard all[RANKS] = {0};
    uint64_t taken = 0;
    test_ranks_run(RANKS, work, all);
    for (unsigned r = 0; r < RANKS; r++) {
        assert_false(all[r].none);
        assert_true(all[r].one);
        assert_int_equal(all[r].status[0], TN_IO);
        assert_string_equal(all[r].error[0].message, "rank 2");
        assert_int_equal(all[r].status[1], TN_OK);
        assert_int_equal(all[r].size, 1000);
        assert_int_equal(all[r].bytes[999], 7);
        assert_int_equal(all[r].status[2], TN_INVALID);
        assert_int_equal(all[r].error[2].code, E_RANKS_DIFFER);
        assert_string_equal(all[r].error[2].message, "the word is not the same on all ranks: rank 0 on here has `one`, "
                                                     "and rank 3 on here has `another`");
        taken += all[r].taken;
        free(all[r].bytes);
    }
    assert_int_equal(taken, 50 * 300); /* each number once in each round */
}

static void test_alone(void **state)
{
    (void)state;
    tn_error error;
    uint8_t byte = 1, *bytes = &byte;
    size_t size = 1;
    assert_true(tn_ranks_lead(NULL));
    assert_false(tn_ranks_several(NULL));
    assert_true(tn_ranks_any(NULL, true));
    assert_int_equal(tn_ranks_agree(NULL, TN_LIMIT, &error), TN_LIMIT);
    assert_int_equal(tn_ranks_tell(NULL, &bytes, &size, &error), TN_OK);
    assert_ptr_equal(bytes, &byte);
    assert_int_equal(tn_ranks_same(NULL, "it", "x", &error), TN_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_together), cmocka_unit_test(test_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
