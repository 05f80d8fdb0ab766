/* Edges and faces worked out in rows, and faces stamped in lanes, are what one by one gives, to the bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/growth/join/stamp.h"
#include "runtime/growth/pass/rows.h"

static uint64_t draws;

static uint32_t draw(uint32_t below)
{
    return (uint32_t)(tn_random64(7, 0, draws++) % below);
}

/* Coarse, so that vectors are often zero, equal, opposed or along one another. */
static tn_vector some_vector(void)
{
    double scale = draw(4) ? 1 : 1e-200;
    return (tn_vector){scale * (draw(5) - 2.0), scale * (draw(3) - 1.0), scale * (draw(3) - 1.0)};
}

static void assert_same(tn_vector a, tn_vector b)
{
    assert_memory_equal(&a, &b, sizeof a);
}

static void axes_of_rows_are_those_of_edges(void **state)
{
    (void)state;
    tn_axes_rows *rows = malloc(sizeof *rows);
    tn_row turned[3], placed[3];
    tn_vector centre = {0.5, -1, 2};
    for (uint32_t round = 0; round < 2000; round++) {
        uint32_t count = 1 + draw(TN_ROW);
        double turn[3] = {draw(9) - 4.0, draw(9) / 3.0, draw(9) / 7.0};
        for (uint32_t i = 0; i < count; i++) {
            tn_rows_put(rows->from, i, some_vector());
            tn_rows_put(rows->to, i, some_vector());
            tn_rows_put(rows->left_normal, i, tn_normalised(some_vector()));
            tn_rows_put(rows->right_normal, i, tn_normalised(some_vector()));
        }
        tn_axes_of_rows(rows, count, centre);
        tn_axes_turn(rows, count, turn, turned);
        tn_axes_place(rows, count, turn, placed);
        for (uint32_t i = 0; i < count; i++) {
            tn_vector from = tn_rows_at(rows->from, i), to = tn_rows_at(rows->to, i);
            tn_axes axes =
                tn_axes_of(from, to, tn_rows_at(rows->left_normal, i), tn_rows_at(rows->right_normal, i), centre);
            assert_same(axes.heading, tn_rows_at(rows->heading, i));
            assert_same(axes.left, tn_rows_at(rows->left, i));
            assert_same(axes.up, tn_rows_at(rows->up, i));
            assert_memory_equal(&axes.length, &rows->length[i], sizeof axes.length);
            assert_true(isfinite(axes.up.x + axes.up.y + axes.up.z + axes.heading.x));
            tn_vector direction =
                tn_along(tn_along(tn_scale(axes.heading, turn[0]), axes.left, turn[1]), axes.up, turn[2]);
            assert_same(direction, tn_rows_at(turned, i));
            assert_same(tn_along(from, direction, axes.length), tn_rows_at(placed, i));
        }
    }
    free(rows);
}

enum { FACES = 400, VERTICES = 60 };

static void normals_together_are_those_of_each(void **state)
{
    (void)state;
    double positions[3 * VERTICES], together[3 * FACES], alone[3 * FACES];
    uint32_t first[FACES + 1], origin[8 * FACES];
    for (uint32_t round = 0; round < 50; round++) {
        tn_map map = {.positions = positions, .origin = origin, .face_first = first, .face_count = FACES};
        uint32_t darts = 0, sizes = 1 + draw(4);
        for (uint32_t v = 0; v < VERTICES; v++)
            tn_vector_put(positions + 3 * (size_t)v, some_vector());
        for (uint32_t f = 0; f < FACES; f++) {
            first[f] = darts;
            for (uint32_t i = 3 + draw(sizes); i-- > 0;)
                origin[darts++] = draw(VERTICES);
        }
        first[FACES] = darts;
        tn_normals *normals = malloc(sizeof *normals);
        tn_normals_start(normals, &map, together);
        for (uint32_t f = 0; f < FACES; f++)
            tn_normals_add(normals, f);
        tn_normals_finish(normals);
        tn_normals_start(normals, &map, alone);
        for (uint32_t f = 0; f < FACES; f++) {
            tn_normals_add(normals, f);
            tn_normals_finish(normals);
        }
        free(normals);
        assert_memory_equal(together, alone, sizeof together);
    }
}

enum { EDGES = 50, DARTS = 40 };

static void lanes_stamp_as_one_by_one_does(void **state)
{
    (void)state;
    if (!tn_stamp_has_lanes())
        skip();
    static _Alignas(64) uint32_t bases[TN_LANES_DARTS * TN_BASES];
    for (uint32_t round = 0; round < 5000; round++) {
        tn_record records[EDGES];
        uint32_t side[DARTS], origin[DARTS], size = 3 + draw(TN_LANES_DARTS - 2), first = draw(DARTS - size);
        uint32_t count = 1 + draw(DARTS), references[2][DARTS], stamped[2][DARTS + 1], expected[2][DARTS + 1];
        tn_map old = {.side = side, .origin = origin, .edge_count = EDGES};
        tn_pass pass = {.old = &old, .records = records};
        for (uint32_t e = 0; e < EDGES; e++)
            records[e] = draw(3) ? (tn_record){2 * draw(99999), draw(99999), draw(99999), (uint16_t)draw(65000),
                                               (int16_t)(draw(65535) - 32767)}
                                 : (tn_record){.side = 2 * draw(99999), .template = TN_NO_TEMPLATE};
        for (uint32_t d = 0; d < DARTS; d++) {
            side[d] = draw(2 * EDGES);
            origin[d] = draw(99999);
        }
        memset(stamped, 0xee, sizeof stamped);
        memset(expected, 0xee, sizeof expected);
        uint32_t table[TN_LANES_DARTS * TN_BASES];
        for (uint32_t d = 0; d < size; d++)
            tn_dart_bases(&pass, first + d, table + d * TN_BASES);
        for (uint32_t i = 0; i < count; i++) {
            for (uint32_t k = 0; k < 2; k++) {
                references[k][i] = tn_refer(draw(size), draw(TN_BASES), draw(65536));
                expected[k][i] = tn_referred(table, references[k][i]);
            }
        }
        tn_stamp_lanes(&pass, first, size, references[0], references[1], count, stamped[0], stamped[1], bases);
        assert_memory_equal(bases, table, size * TN_BASES * sizeof *bases);
        assert_memory_equal(stamped, expected, sizeof stamped); /* and nothing behind */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_of_rows_are_those_of_edges),
        cmocka_unit_test(normals_together_are_those_of_each),
        cmocka_unit_test(lanes_stamp_as_one_by_one_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
