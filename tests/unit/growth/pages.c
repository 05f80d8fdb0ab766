/* Arrays that are used again from step to step: in pages that are moved, and on the heap. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/growth/pass/pages.h"

/* As where pages cannot be moved. */
#define TN_PAGES_ON_HEAP
#define tn_pages_reserve reserve_on_heap
#define tn_pages_release release_on_heap
bool reserve_on_heap(tn_pages *pages, uint64_t size);
void release_on_heap(tn_pages *pages);
#include "runtime/growth/pass/pages.c"
#undef tn_pages_reserve
#undef tn_pages_release

typedef bool reserve(tn_pages *pages, uint64_t size);
typedef void release(tn_pages *pages);

/* What was there stays, below half a megabyte, above it, and by more than two huge pages. */
static void check(reserve *more, release *end)
{
    static const size_t sizes[] = {100, 4000, 600000, 3000000, 3100000, 9000000};
    tn_pages pages = {0};
    size_t filled = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        assert_true(more(&pages, sizes[i]));
        assert_true(pages.capacity >= sizes[i]);
        uint8_t *bytes = pages.data;
        for (size_t k = 0; k < filled; k++)
            if (bytes[k] != (uint8_t)(k * 7 + k / 256))
                fail_msg("byte %zu is another after %zu", k, sizes[i]);
        for (filled = 0; filled < sizes[i]; filled++)
            bytes[filled] = (uint8_t)(filled * 7 + filled / 256);
    }
    const tn_pages before = pages;
    assert_true(more(&pages, 10));
    assert_false(more(&pages, UINT64_MAX));
    assert_false(more(&pages, (uint64_t)SIZE_MAX / 2 + 1));
    assert_ptr_equal(pages.data, before.data);
    assert_int_equal(pages.capacity, before.capacity);
    end(&pages);
    assert_null(pages.data);
    end(&pages); /* nothing is nothing to release */
}

static void test_moved(void **state)
{
    (void)state;
    check(tn_pages_reserve, tn_pages_release);
}

static void test_on_heap(void **state)
{
    (void)state;
    check(reserve_on_heap, release_on_heap);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_moved),
        cmocka_unit_test(test_on_heap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
