/* Filled cells, bounds and draws, against definitions that are slow and plain. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/memory.h"
#include "runtime/base/random.h"
#include "runtime/place/cells.h"
#include "runtime/place/derivation.h"

enum { SIDE = 80, HALF = SIDE / 2 };
static bool filled[SIDE][SIDE][SIDE];

static bool *cell_at(int x, int y, int z)
{
    return &filled[x + HALF][y + HALF][z + HALF];
}

static tn_cell_box random_box(uint64_t *random, int longest)
{
    tn_cell_box box;
    for (int k = 0; k < 3; k++) {
        *random = tn_mix64(*random);
        box.low[k] = (int32_t)(*random % (SIDE - longest)) - HALF;
        box.high[k] = box.low[k] + (int32_t)(*random >> 32) % longest;
    }
    return box;
}

static bool any_filled(const tn_cell_box *box, int32_t first[3])
{
    for (first[0] = box->low[0]; first[0] < box->high[0]; first[0]++)
        for (first[1] = box->low[1]; first[1] < box->high[1]; first[1]++)
            for (first[2] = box->low[2]; first[2] < box->high[2]; first[2]++)
                if (*cell_at(first[0], first[1], first[2]))
                    return true;
    return false;
}

static uint64_t fill_all(const tn_cell_box *box)
{
    uint64_t fresh = 0;
    for (int x = box->low[0]; x < box->high[0]; x++)
        for (int y = box->low[1]; y < box->high[1]; y++)
            for (int z = box->low[2]; z < box->high[2]; z++) {
                fresh += !*cell_at(x, y, z);
                *cell_at(x, y, z) = true;
            }
    return fresh;
}

static void test_boxes(void **state)
{
    (void)state;
    tn_error error;
    tn_cells *cells = tn_cells_new(NULL);
    uint64_t random = 1, count = 0;
    memset(filled, 0, sizeof filled);
    for (int turn = 0; turn < 4000; turn++) {
        int32_t wanted[3], found[3];
        tn_cell_box box = random_box(&random, turn % 7 == 0 ? 70 : 6);
        bool any = any_filled(&box, wanted);
        assert_int_equal(tn_cells_any(cells, &box), any);
        assert_int_equal(tn_cells_first(cells, &box, found), any);
        if (any)
            assert_memory_equal(found, wanted, sizeof found);
        if (turn % 5 == 0 && turn < 3000) {
            box = random_box(&random, 5);
            count += fill_all(&box);
            assert_int_equal(tn_cells_fill(cells, &box, &error), TN_OK);
        }
        assert_int_equal(tn_cells_count(cells), count);
    }
    tn_cells_free(cells);
}

/* Compares all cells with those that `is_there` has. */
static void compare(tn_cells *cells, bool (*is_there)(const int32_t cell[3], const int32_t a[3]), const int32_t a[3])
{
    uint64_t count = 0;
    for (int x = -HALF; x < HALF; x++)
        for (int y = -HALF; y < HALF; y++)
            for (int z = -HALF; z < HALF; z++) {
                tn_cell_box one = {{x, y, z}, {x + 1, y + 1, z + 1}};
                bool wanted = is_there((int32_t[]){x, y, z}, a);
                count += wanted;
                assert_int_equal(tn_cells_any(cells, &one), wanted);
            }
    assert_int_equal(tn_cells_count(cells), count);
}

static bool in_ball(const int32_t c[3], const int32_t a[3])
{
    int r = a[0], square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    bool near = c[0] >= -r && c[0] < r && c[1] >= -r && c[1] < r && c[2] >= -r && c[2] < r;
    return near && square <= r * r && square > (r - 1) * (r - 1);
}

static bool in_shell(const int32_t c[3], const int32_t a[3])
{
    bool end = false;
    for (int k = 0; k < 3; k++) {
        if (c[k] < -a[k] - 1 || c[k] > a[k])
            return false;
        end |= c[k] == a[k] || c[k] == -a[k] - 1;
    }
    return end;
}

static void test_bounds(void **state)
{
    (void)state;
    tn_error error;
    for (int32_t r = -2; r <= 20; r++) {
        tn_cells *cells = tn_cells_new(NULL);
        assert_int_equal(tn_bound_ball(cells, r, &error), TN_OK);
        compare(cells, in_ball, (int32_t[]){r, 0, 0});
        tn_cells_free(cells);
    }
    const int32_t sizes[][3] = {{0, 0, 0}, {1, 2, 3}, {8, 9, 8}, {-1, 4, 4}, {20, 0, 7}, {-5, -5, -5}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        tn_cells *cells = tn_cells_new(NULL);
        tn_step step = {.kind = TN_STEP_BOUND_BOX, .a = {sizes[i][0], sizes[i][1], sizes[i][2]}};
        tn_frame frame = {0};
        assert_int_equal(tn_bound_box(cells, &frame, &step, &error), TN_OK);
        compare(cells, in_shell, sizes[i]);
        tn_cells_free(cells);
    }
}

/* More cells than any machine has room for. */
static void test_memory_limit(void **state)
{
    (void)state;
    tn_error error;
    tn_watch watch;
    tn_watch_begin(&watch, NULL, NULL);
    watch.memory_limit = tn_memory_used() + (32 << 20);
    tn_cells *cells = tn_cells_new(&watch);
    tn_cell_box box = {{0, 0, 0}, {1 << 20, 1 << 20, 1 << 20}};
    assert_int_equal(tn_cells_fill(cells, &box, &error), TN_STOPPED);
    assert_int_equal(error.code, E_MEMORY_LIMIT);
    assert_true(tn_memory_used() < watch.memory_limit + (128 << 20));
    tn_cells_free(cells);
}

/* The reference implementation's known values: the 10,000th word of seed 5489 is 4123659995. */
static void test_draws(void **state)
{
    (void)state;
    tn_mersenne generator;
    tn_mersenne_seed(&generator, 5489);
    double last = 0;
    for (int i = 0; i < 5000; i++)
        last = tn_mersenne_draw(&generator);
    assert_true(last >= 0 && last < 1);
    uint32_t y = generator.state[generator.next - 1]; /* tempered as a draw does */
    y ^= y >> 11;
    y ^= y << 7 & 0x9d2c5680u;
    y ^= y << 15 & 0xefc60000u;
    assert_int_equal(y ^ y >> 18, 4123659995u);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_memory_limit),
        cmocka_unit_test(test_draws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
