/* Arrays grow by doubling; a size that cannot be had changes nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/base/array.h"

static void test_growth(void **state)
{
    (void)state;
    uint32_t *items = NULL;
    size_t capacity = 0;
    for (uint32_t i = 0; i < 1000; i++) {
        assert_true(tn_array_reserve_from(&items, &capacity, 3, i, 1, sizeof *items));
        items[i] = i;
    }
    assert_int_equal(capacity, 3 * 512);
    for (uint32_t i = 0; i < 1000; i++)
        assert_int_equal(items[i], i);
    assert_true(tn_array_reserve(&items, &capacity, 1000, 5000, sizeof *items)); /* more than twice as many */
    assert_int_equal(capacity, 6000);
    uint32_t *before = items;
    assert_true(tn_array_reserve(&items, &capacity, 6000, 0, sizeof *items));
    assert_ptr_equal(items, before);
    assert_int_equal(capacity, 6000);
    assert_true(tn_array_resize(&items, 10, sizeof *items));
    assert_int_equal(items[9], 9);
    free(items);
}

static void test_nothing(void **state)
{
    (void)state;
    char *items = NULL;
    size_t capacity = 0;
    assert_true(tn_array_reserve(&items, &capacity, 0, 0, 1));
    assert_null(items);
    assert_true(tn_array_resize(&items, 0, 1));
    assert_non_null(items); /* no items are not out of memory */
    free(items);
}

static void test_too_large(void **state)
{
    (void)state;
    uint64_t *items = malloc(2 * sizeof *items), *before = items;
    assert_non_null(items);
    items[1] = 7;
    size_t capacity = 2;
    assert_false(tn_array_reserve(&items, &capacity, SIZE_MAX, 1, sizeof *items));
    assert_false(tn_array_reserve(&items, &capacity, 2, SIZE_MAX - 2, sizeof *items));
    assert_false(tn_array_reserve(&items, &capacity, 2, SIZE_MAX / sizeof *items, sizeof *items));
    assert_false(tn_array_resize(&items, SIZE_MAX / 8 + 2, sizeof *items));
    assert_false(tn_array_resize(&items, SIZE_MAX / 2 + 1, 1));
    assert_ptr_equal(items, before);
    assert_int_equal(capacity, 2);
    assert_int_equal(items[1], 7);
    free(items);
    assert_int_equal(tn_array_larger(SIZE_MAX / 2 + 1, 0, 4), SIZE_MAX);
}

/* What a size cannot count is refused, and is no small number instead, however many bits a size has. */
static void test_sizes(void **state)
{
    (void)state;
    assert_int_equal(tn_as_size(0), 0);
    assert_int_equal(tn_as_size(100000), 100000);
    assert_true(tn_as_size(UINT64_MAX) == TN_SIZE_MOST);
    assert_int_equal(tn_size_of(300, 7), 2100);
    assert_int_equal(tn_size_of(SIZE_MAX, 0), 0);
    assert_true(tn_size_of(SIZE_MAX / 2, 3) == TN_SIZE_MOST);
    assert_true(tn_size_of(SIZE_MAX, 1) == TN_SIZE_MOST);
    assert_null(tn_array_new(UINT64_MAX, 1));
    assert_null(tn_array_new(UINT64_C(1) << 62, 8));
    assert_null(tn_array_new((uint64_t)tn_size_of(SIZE_MAX, SIZE_MAX) + 1, sizeof(uint64_t)));
    uint64_t *items = tn_array_new(3, sizeof *items);
    assert_non_null(items);
    items[2] = 1;
    free(items);
    items = tn_array_new(0, sizeof *items);
    assert_non_null(items);
    free(items);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_too_large),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
