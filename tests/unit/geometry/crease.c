/* Creases of meshes of triangles: folds, seams of groups, and thin triangles, which say nothing of a plane. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/geometry/edges.h"

/* Three triangles in a row over the same two long sides: 0 1 4 and 2 3 4 with 1 2 4 between them, which is as thick at
 * 1 2 as is said. Points 2 and 3 are so high. */
typedef struct strip {
    double positions[15];
    uint32_t corners[9], first[4];
    tn_mesh mesh;
} strip;

static void make(strip *s, double thick, double high, double away)
{
    *s = (strip){.positions = {0, 1, 0, 0, 0, 0, 0, -thick, 0, 0, -1, high, 2, 0, 0},
                 .corners = {0, 1, 4, 1, 2, 4, 2, 3, 4},
                 .first = {0, 3, 6, 9}};
    for (size_t i = 0; i < 15; i++)
        s->positions[i] += away;
    s->mesh = (tn_mesh){
        .positions = s->positions, .corners = s->corners, .face_first = s->first, .vertex_count = 5, .face_count = 3};
}

/* Are the long sides of the triangle in the middle creases? */
static void expect(double thick, double high, double away, bool folds)
{
    strip s;
    bool *creases;
    tn_error error;
    make(&s, thick, high, away);
    assert_int_equal(tn_mesh_creases(&s.mesh, &creases, &error), TN_OK);
    assert_int_equal(creases[1], folds);   /* 1 4 of the first */
    assert_int_equal(creases[5], folds);   /* 4 1 of the second */
    assert_true(creases[0] && creases[2]); /* no second triangle has them */
    free(creases);
}

static void flat_and_folded(void **state)
{
    (void)state;
    expect(0.5, 0, 0, false);
    strip s;
    bool *creases;
    tn_error error;
    make(&s, 0.5, 1, 0);
    assert_int_equal(tn_mesh_creases(&s.mesh, &creases, &error), TN_OK);
    assert_false(creases[1]); /* the fold is at the other side of the middle */
    assert_true(creases[4] && creases[8]);
    free(creases);
}

/* What is at both sides of a thin triangle decides, whatever its own normal is. */
static void thin_triangles_are_looked_through(void **state)
{
    (void)state;
    strip s;
    bool *creases;
    tn_error error;
    make(&s, 1e-9, 0, 0);
    s.positions[8] = 1e-9; /* as if it stood upright */
    assert_int_equal(tn_mesh_creases(&s.mesh, &creases, &error), TN_OK);
    assert_false(creases[1] || creases[5] || creases[4] || creases[8]);
    free(creases);
    expect(1e-9, 1, 0, true);
}

/* How far away a mesh lies says nothing of what is thin in it. */
static void far_away(void **state)
{
    (void)state;
    strip s;
    bool *creases;
    tn_error error;
    make(&s, 0.01, 1, 1e6);
    assert_int_equal(tn_mesh_creases(&s.mesh, &creases, &error), TN_OK);
    assert_true(creases[4] && creases[8]);
    assert_false(creases[1]);
    free(creases);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_and_folded),
        cmocka_unit_test(thin_triangles_are_looked_through),
        cmocka_unit_test(far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
