/* Faces that cross themselves or are turned over are found, and no others. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/outline.h"
#include "runtime/growth/faults.h"
#include "runtime/load.h"
#include "tests/support/compile_file.h"

typedef struct grown {
    tn_compilation compilation;
    tn_module *module;
    tn_growth_system *system;
    tn_environment environment;
    tn_growth *growth;
} grown;

static void grow(grown *g, const char *text, uint32_t steps, int threads)
{
    library_folders options = {0};
    tn_growth_options how = tn_growth_options_default();
    tn_error error = {0};
    memset(g, 0, sizeof *g);
    how.threads = threads;
    for (int k = 0; k < 3; k++)
        how.scale[k] = 1;
    assert_int_equal(compile_text("t.hemls", text, strlen(text), &options, &g->compilation), TN_OK);
    assert_int_equal(tn_module_load(g->compilation.module, g->compilation.module_size, NULL, &g->module, &error),
                     TN_OK);
    assert_int_equal(tn_growth_system_read(g->module, &g->system, &error), TN_OK);
    assert_int_equal(tn_growth_new(g->system, &g->environment, &how, &g->growth, &error), TN_OK);
    for (uint32_t n = 0; n < steps; n++)
        assert_int_equal(tn_growth_step(g->growth, &error), TN_OK);
}

static void uproot(grown *g)
{
    tn_growth_free(g->growth);
    tn_growth_system_free(g->system);
    tn_module_free(g->module);
    tn_compilation_clear(&g->compilation);
}

static tn_faults find(const grown *g)
{
    tn_faults faults;
    tn_error error;
    assert_int_equal(tn_faults_find(g->growth, &faults, &error), TN_OK);
    return faults;
}

/* The vertex at a place. */
static double *vertex_at(const grown *g, double x, double y)
{
    const tn_map *map = tn_growth_map(g->growth);
    for (uint32_t v = 0; v < map->vertex_count; v++)
        if (fabs(map->positions[3 * v] - x) < 1e-9 && fabs(map->positions[3 * v + 1] - y) < 1e-9)
            return map->positions + 3 * v;
    fail_msg("no vertex at %g %g", x, y);
    return NULL;
}

static const char square[] =
    "A + B + A + B; A -> A [ [ + B ] - B ] A; B -> B [ [ + A ] - A ] B; Angle 90; BranchAngle 90";
static const char koch[] = "A + A + A; A -> A - A + + A - A; Angle 60";

static void test_sound_surfaces_have_none(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint32_t steps;
    } sound[] = {{square, 5},
                 {koch, 6}, /* one face of 12,288 corners */
                 {"A + A + A + A; A -> A + A - A - A A + A + A - A; Angle 90", 3},
                 {"A + A + A + A; A -> & A ^ ^ A &; Angle 30", 3}};
    for (size_t i = 0; i < sizeof sound / sizeof *sound; i++) {
        grown g;
        grow(&g, sound[i].text, sound[i].steps, 2);
        tn_faults faults = find(&g);
        assert_int_equal(faults.crossed.count, 0);
        assert_int_equal(faults.inverted.count, 0);
        uproot(&g);
    }
}

/* A large face, one corner of which is pulled across the other side of the outline. */
static void test_a_large_face_that_crosses_itself(void **state)
{
    (void)state;
    for (uint32_t steps = 2; steps <= 5; steps++) {
        grown g;
        grow(&g, koch, steps, 1);
        vertex_at(&g, -0.5, -0.28867513459481287)[1] += 3;
        tn_faults faults = find(&g);
        assert_int_equal(faults.crossed.count, 1);
        assert_true(fabs(faults.crossed.place[0]) < 0.01 && faults.crossed.place[1] > 0);
        uproot(&g);
    }
}

/* One face of a grid is mirrored: it is turned over; its neighbours above and below become figures of eight. */
static void test_a_face_turned_over(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 4; threads += 3) {
        grown g;
        grow(&g, square, 5, threads);
        double s = 1.0 / 32, *low_left = vertex_at(&g, 0, 0), *low_right = vertex_at(&g, s, 0),
               *high_left = vertex_at(&g, 0, s), *high_right = vertex_at(&g, s, s);
        low_left[0] = high_left[0] = s;
        low_right[0] = high_right[0] = 0;
        tn_faults faults = find(&g);
        assert_int_equal(faults.inverted.count, 1);
        assert_true(fabs(faults.inverted.place[0] - s / 2) < 1e-12 && fabs(faults.inverted.place[1] - s / 2) < 1e-12);
        assert_int_equal(faults.crossed.count, 2); /* the neighbours above and below */
        uproot(&g);
    }
}

/* A figure of eight whose halves cancel has no normal, and is found all the same; faces without an area are not. */
static void test_faces_without_a_normal(void **state)
{
    (void)state;
    grown g;
    grow(&g, "A + A + A + A; Angle 90", 0, 1);
    double *a = vertex_at(&g, 0.5, 0.5), *b = vertex_at(&g, -0.5, 0.5);
    a[0] = -0.5;
    b[0] = 0.5;
    assert_int_equal(find(&g).crossed.count, 1);
    double *all = tn_growth_map(g.growth)->positions;
    for (int i = 0; i < 12; i++)
        all[i] = i % 3 == 0 ? i : 0;
    assert_int_equal(find(&g).crossed.count, 0);
    memset(all, 0, 12 * sizeof *all);
    assert_int_equal(find(&g).crossed.count, 0);
    assert_int_equal(find(&g).inverted.count, 0);
    uproot(&g);
}

/* ---- outlines: the grid finds what comparing all pairs finds */

static bool all_pairs_cross(const tn_outline *o)
{
    for (uint32_t i = 0; i < o->count; i++)
        for (uint32_t j = i + 1; j < o->count; j++) {
            const double *p[4] = {o->points[i], o->points[(i + 1) % o->count], o->points[j],
                                  o->points[(j + 1) % o->count]};
            double area[4];
            for (int k = 0; k < 4; k++) {
                const double *a = p[k & 2], *b = p[(k & 2) + 1], *c = p[(2 - (k & 2)) + (k & 1)];
                area[k] = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            }
            if (area[0] * area[1] < -1e-18 && area[2] * area[3] < -1e-18)
                return true;
        }
    return false;
}

static double next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static void test_outlines_against_all_pairs(void **state)
{
    (void)state;
    tn_outline outline = {0};
    uint64_t random = 3;
    int crossing = 0;
    for (int round = 0; round < 300; round++) {
        uint32_t count = 41 + (uint32_t)(next(&random) * 200);
        assert_true(tn_outline_reserve(&outline, count));
        double wide = round % 3 == 0 ? 0.001 : 1, wild = round % 4 == 0 ? 0.1 : 0;
        for (uint32_t i = 0; i < count; i++) { /* a star, now and then flattened or disturbed */
            double turn = 6.283185307179586 * (i + wild * next(&random) * count / 4) / count, far = 0.2 + next(&random);
            outline.points[i][0] = far * cos(turn);
            outline.points[i][1] = far * sin(turn) * wide;
        }
        bool crossed;
        assert_true(tn_outline_crosses(&outline, &crossed));
        assert_int_equal(crossed, all_pairs_cross(&outline));
        crossing += crossed;
    }
    assert_in_range(crossing, 20, 280);
    tn_outline_clear(&outline);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sound_surfaces_have_none),   cmocka_unit_test(test_a_large_face_that_crosses_itself),
        cmocka_unit_test(test_a_face_turned_over),         cmocka_unit_test(test_faces_without_a_normal),
        cmocka_unit_test(test_outlines_against_all_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
