/* Signed distances to closed meshes: on which side a place is, against how much of all directions the mesh fills there;
 * near edges and corners above all, however sharp, and also where a triangle of no area lies beside one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/geometry/boundary_mesh.h"
#include "tests/support/share.h"

enum { VERTICES_MAX = 200, TRIANGLES_MAX = 400 };

typedef struct form {
    double points[VERTICES_MAX][3];
    uint32_t triangles[TRIANGLES_MAX][3];
    size_t vertex_count, triangle_count;
} form;

typedef struct dice {
    uint64_t seed, count;
} dice;

static double between(dice *d, double low, double high)
{
    return low + (high - low) * (double)(tn_random64(17, d->seed, d->count++) >> 11) * 0x1p-53;
}

static tn_vector corner(const form *f, size_t triangle, int k)
{
    return tn_vector_at(f->points[f->triangles[triangle][k]]);
}

/* How many times the mesh winds round x: the sum of the solid angles of its triangles (Van Oosterom and Strackee, "The
 * solid angle of a plane triangle", 1983). */
static double winding(const form *f, tn_vector x)
{
    double sum = 0;
    for (size_t t = 0; t < f->triangle_count; t++) {
        tn_vector a = tn_sub(corner(f, t, 0), x), b = tn_sub(corner(f, t, 1), x), c = tn_sub(corner(f, t, 2), x);
        double la = tn_norm(a), lb = tn_norm(b), lc = tn_norm(c);
        sum += 2 * atan2(tn_dot(a, tn_cross(b, c)),
                         la * lb * lc + tn_dot(a, b) * lc + tn_dot(b, c) * la + tn_dot(c, a) * lb);
    }
    return sum / (4 * 3.14159265358979323846);
}

/* A place near a triangle: beside a corner, beside an edge, over its middle, or anywhere. */
static tn_vector place_near(const form *f, dice *d)
{
    size_t t = (size_t)between(d, 0, (double)f->triangle_count);
    double kind = between(d, 0, 4), u = kind < 1 ? 0 : between(d, 0, 1), v = kind < 2 ? 0 : between(d, 0, 1 - u);
    tn_vector p = corner(f, t, 0);
    p = tn_along(tn_along(p, tn_sub(corner(f, t, 1), p), u), tn_sub(corner(f, t, 2), p), v);
    double reach = kind < 3 ? pow(10, between(d, -4, 0)) : 3;
    return tn_add(p, (tn_vector){between(d, -reach, reach), between(d, -reach, reach), between(d, -reach, reach)});
}

static void check_form(const form *f, dice *d, int places)
{
    tn_boundary_mesh *mesh;
    tn_error error;
    assert_int_equal(
        tn_boundary_mesh_new(&f->points[0][0], f->vertex_count, &f->triangles[0][0], f->triangle_count, &mesh, &error),
        TN_OK);
    assert_true(tn_boundary_mesh_is_solid(mesh));
    for (int i = 0; i < places; i++) {
        tn_vector x = place_near(f, d), nearest;
        double wanted = winding(f, x), distance = tn_boundary_mesh_distance(mesh, x, &nearest);
        if (fabs(distance) < 1e-9)
            continue;
        if (fabs(wanted) > 0.5 ? distance > 0 : distance < 0)
            fail_msg("form %llu: at (%.17g, %.17g, %.17g) the distance is %g, and the mesh winds round it %g times",
                     (unsigned long long)d->seed, x.x, x.y, x.z, distance, wanted);
        assert_true(fabs(tn_norm(tn_sub(x, nearest)) - fabs(distance)) < 1e-12);
    }
    tn_boundary_mesh_free(mesh);
}

static void add_point(form *f, double x, double y, double z)
{
    memcpy(f->points[f->vertex_count++], (double[]){x, y, z}, sizeof f->points[0]);
}

static void add_triangle(form *f, uint32_t a, uint32_t b, uint32_t c)
{
    memcpy(f->triangles[f->triangle_count++], (uint32_t[]){a, b, c}, sizeof f->triangles[0]);
}

static void turn_inside_out(form *f)
{
    for (size_t t = 0; t < f->triangle_count; t++) {
        uint32_t other = f->triangles[t][1];
        f->triangles[t][1] = f->triangles[t][2];
        f->triangles[t][2] = other;
    }
}

/* A ball whose vertices lie at any distance from its middle: spikes and notches. */
static void make_spiky(form *f, dice *d)
{
    enum { ROUND = 7, BANDS = 5 };
    *f = (form){0};
    add_point(f, 0, 0, between(d, 0.1, 3));
    for (int band = 0; band < BANDS; band++)
        for (int i = 0; i < ROUND; i++) {
            double a = 6.283185307179586 * i / ROUND, b = 3.141592653589793 * (band + 1) / (BANDS + 1);
            double r = between(d, 0.1, 3);
            add_point(f, r * sin(b) * cos(a), r * sin(b) * sin(a), r * cos(b));
        }
    add_point(f, 0, 0, -between(d, 0.1, 3));
    uint32_t last = (uint32_t)f->vertex_count - 1;
    for (uint32_t i = 0; i < ROUND; i++) {
        uint32_t next = (i + 1) % ROUND;
        add_triangle(f, 0, 1 + i, 1 + next);
        add_triangle(f, last, last - ROUND + next, last - ROUND + i);
        for (uint32_t band = 0; band + 1 < BANDS; band++) {
            uint32_t a = 1 + band * ROUND + i, b = 1 + band * ROUND + next;
            add_triangle(f, a, a + ROUND, b);
            add_triangle(f, b, a + ROUND, b + ROUND);
        }
    }
}

/* A tetrahedron of any shape, needles and plates among them. */
static void make_sliver(form *f, dice *d)
{
    *f = (form){0};
    double scale[3];
    for (int k = 0; k < 3; k++)
        scale[k] = pow(10, between(d, -2, 1));
    for (int i = 0; i < 4; i++)
        add_point(f, scale[0] * between(d, -1, 1), scale[1] * between(d, -1, 1), scale[2] * between(d, -1, 1));
    add_triangle(f, 0, 2, 1);
    add_triangle(f, 0, 1, 3);
    add_triangle(f, 0, 3, 2);
    add_triangle(f, 1, 2, 3);
}

static void test_sides(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < (uint64_t)test_share(400); seed++) {
        dice d = {seed, 0};
        form f;
        if (seed % 2)
            make_spiky(&f, &d);
        else
            make_sliver(&f, &d);
        if (seed % 3 == 0)
            turn_inside_out(&f);
        check_form(&f, &d, 400);
    }
}

/* A wedge; on its long edge lies a vertex of one side only, with a triangle of no area between. */
static void test_no_area(void **state)
{
    (void)state;
    dice d = {1000, 0};
    form f = {0};
    add_point(&f, 0, 0, 0);
    add_point(&f, 4, 0, 0);
    add_point(&f, 0, 3, 0.25);
    add_point(&f, 0, 3, -0.25);
    add_point(&f, 1.5, 0, 0);
    add_triangle(&f, 0, 4, 2);
    add_triangle(&f, 4, 1, 2);
    add_triangle(&f, 0, 1, 4); /* no area: 0, 4 and 1 are on one line */
    add_triangle(&f, 0, 3, 1);
    add_triangle(&f, 0, 2, 3);
    add_triangle(&f, 1, 3, 2);
    check_form(&f, &d, 4000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sides), cmocka_unit_test(test_no_area)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
