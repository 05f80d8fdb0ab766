/* The arena: what it gives is zeroed, aligned, apart from everything else it gave, and stays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/common/arena.h"

enum { PIECES = 2000 };

static size_t size_of(size_t i)
{
    return i % 97 == 0 ? 40000 + i : i % 53;
}

static void test_pieces_stay_apart(void **state)
{
    (void)state;
    static unsigned char *pieces[PIECES];
    tn_arena *arena = tn_arena_new();
    for (size_t i = 0; i < PIECES; i++) {
        pieces[i] = tn_arena_alloc(arena, size_of(i));
        assert_non_null(pieces[i]);
        assert_int_equal((uintptr_t)pieces[i] % _Alignof(max_align_t), 0);
        for (size_t k = 0; k < size_of(i); k++)
            assert_int_equal(pieces[i][k], 0);
        memset(pieces[i], (int)(i % 255 + 1), size_of(i));
    }
    for (size_t i = 0; i < PIECES; i++)
        for (size_t k = 0; k < size_of(i); k++)
            assert_int_equal(pieces[i][k], i % 255 + 1);
    assert_false(tn_arena_failed(arena));
    tn_arena_free(arena);
    tn_arena_free(NULL);
}

static void test_copies(void **state)
{
    (void)state;
    tn_arena *arena = tn_arena_new();
    assert_string_equal(tn_arena_copy(arena, "tartan", 3), "tar");
    assert_string_equal(tn_arena_copy(arena, NULL, 0), "");
    int *numbers = TN_NEW_ARRAY(arena, int, 10);
    assert_int_equal(numbers[9], 0);
    tn_arena_free(arena);
}

static void test_impossible_sizes_fail(void **state)
{
    (void)state;
    static const size_t sizes[] = {SIZE_MAX, SIZE_MAX - 1, SIZE_MAX - 64};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        tn_arena *arena = tn_arena_new();
        assert_null(tn_arena_alloc(arena, sizes[i]));
        assert_true(tn_arena_failed(arena));
        assert_non_null(tn_arena_alloc(arena, 8)); /* still good for what is possible */
        assert_true(tn_arena_failed(arena));
        tn_arena_free(arena);
    }
    tn_arena *arena = tn_arena_new();
    assert_null(TN_NEW_ARRAY(arena, int, SIZE_MAX / 2)); /* the product does not fit */
    assert_true(tn_arena_failed(arena));
    assert_null(tn_arena_copy(arena, "x", SIZE_MAX));
    tn_arena_free(arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pieces_stay_apart),
        cmocka_unit_test(test_copies),
        cmocka_unit_test(test_impossible_sizes_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
