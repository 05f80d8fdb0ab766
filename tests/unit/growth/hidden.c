/* Hidden faces: whatever is painted last at a place in the picture is what is nearest there. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/hidden/hidden.h"

enum { FACES = 60, CORNERS = 4 * FACES };

typedef struct stage {
    double points[CORNERS][3];
    uint32_t first[FACES + 1];
    tn_scene scene;
    tn_painting painting;
} stage;

static void add_face(stage *s, uint32_t count, double (*points)[3])
{
    uint32_t at = s->first[s->scene.face_count];
    memcpy(s->points[at], points, count * sizeof *points);
    s->first[++s->scene.face_count] = at + count;
}

static void paint(stage *s)
{
    tn_error error = {0};
    s->scene.points = s->points;
    s->scene.first = s->first;
    if (tn_painting_make(&s->scene, &s->painting, &error) != TN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(s->painting.by_depth, 0);
}

static bool covers(double (*points)[3], uint32_t count, double x, double y)
{
    bool inside = false;
    for (uint32_t i = 0, j = count - 1; i < count; j = i++) {
        const double *p = points[i], *q = points[j];
        if ((p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
            inside = !inside;
    }
    return inside;
}

/* The face painted last at a place, or FACES. */
static uint32_t painted_at(const stage *s, double x, double y)
{
    for (size_t i = s->painting.patch_count; i-- > 0;) {
        const tn_patch *patch = &s->painting.patches[i];
        double(*points)[3] = (patch->piece ? s->painting.points : s->scene.points) + patch->first;
        if (covers(points, patch->count, x, y))
            return patch->face;
    }
    return FACES;
}

/* The nearest face there; *clear where no other comes close to it. Faces are flat. */
static uint32_t nearest_at(const stage *s, double x, double y, bool *clear)
{
    uint32_t best = FACES;
    double depth = -INFINITY, second = -INFINITY;
    for (uint32_t f = 0; f < s->scene.face_count; f++) {
        double(*p)[3] = s->scene.points + s->first[f];
        if (!covers(p, s->first[f + 1] - s->first[f], x, y))
            continue;
        double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1], vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1];
        double area = ux * vy - uy * vx, rx = x - p[0][0], ry = y - p[0][1];
        double a = (rx * vy - ry * vx) / area, b = (ux * ry - uy * rx) / area;
        double z = p[0][2] + a * (p[1][2] - p[0][2]) + b * (p[2][2] - p[0][2]);
        second = fmax(second, fmin(z, depth));
        if (z > depth) {
            depth = z;
            best = f;
        }
    }
    *clear = depth - second > 1e-6;
    return best;
}

static void check_everywhere(const stage *s)
{
    for (int i = 0; i < 2000; i++) {
        double x = fmod(i * 0.6180339887498949, 1) - 0.5, y = fmod(i * 0.7548776662466927, 1) - 0.5;
        bool clear;
        uint32_t nearest = nearest_at(s, x, y, &clear), painted = painted_at(s, x, y);
        if (clear && nearest != painted)
            fail_msg("at %.17g %.17g face %u is painted over face %u", x, y, painted, nearest);
    }
}

static double place(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 - 0.5;
}

static void test_faces_that_pass_through_one_another(void **state)
{
    (void)state;
    stage s = {.scene.face_count = 0};
    add_face(&s, 4, (double[4][3]){{-.4, -.4, -.3}, {.4, -.4, .3}, {.4, .4, .3}, {-.4, .4, -.3}});
    add_face(&s, 4, (double[4][3]){{-.3, -.3, .2}, {.3, -.3, -.2}, {.3, .3, -.2}, {-.3, .3, .2}});
    paint(&s);
    assert_true(s.painting.patch_count > 2);
    check_everywhere(&s);
    tn_painting_clear(&s.painting);
}

static void test_faces_in_a_circle(void **state)
{
    (void)state;
    stage s = {.scene.face_count = 0};
    for (int i = 0; i < 3; i++) { /* three boards, each over the next */
        static const double sine[3] = {0, 0.8660254037844387, -0.8660254037844387}, cosine[3] = {1, -0.5, -0.5};
        static const double board[4][3] = {{-.3, -.25, -.1}, {.4, -.25, .1}, {.4, -.1, .1}, {-.3, -.1, -.1}};
        double turned[4][3];
        for (int c = 0; c < 4; c++) {
            turned[c][0] = board[c][0] * cosine[i] - board[c][1] * sine[i];
            turned[c][1] = board[c][0] * sine[i] + board[c][1] * cosine[i];
            turned[c][2] = board[c][2];
        }
        add_face(&s, 4, turned);
    }
    paint(&s);
    assert_true(s.painting.patch_count > 3);
    check_everywhere(&s);
    /* Pieces know which of their sides are the face's. */
    for (size_t i = 0; i < s.painting.patch_count; i++)
        for (uint32_t c = s.painting.patches[i].first; s.painting.patches[i].piece && c < s.painting.corner_count; c++)
            assert_true(s.painting.sides[c] == TN_CUT || s.painting.sides[c] < s.first[3]);
    tn_painting_clear(&s.painting);
}

/* What only touches, or does not overlap, keeps its faces whole. */
static void test_faces_with_an_order_stay_whole(void **state)
{
    (void)state;
    stage s = {.scene.face_count = 0};
    for (int i = 0; i < 6; i++) { /* a folded strip, seen from the side: each face touches the next along an edge */
        double x = -.3 + .1 * (i % 2), z = .1 * i, w = -.3 + .1 * ((i + 1) % 2);
        add_face(&s, 4, (double[4][3]){{x, -.2, z}, {w, -.2, z + .1}, {w, .2, z + .1}, {x, .2, z}});
    }
    add_face(&s, 3, (double[3][3]){{-.35, -.3, -.5}, {.3, -.3, -.4}, {-.3, .3, -.45}});
    paint(&s);
    assert_int_equal(s.painting.patch_count, 7);
    check_everywhere(&s);
    tn_painting_clear(&s.painting);
}

static void test_random_faces(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int round = 0; round < 40; round++) {
        stage s = {.scene.face_count = 0};
        uint32_t count = 2 + (uint32_t)round;
        for (uint32_t f = 0; f < count; f++) {
            double p[4][3], size = round % 3 ? 1 : 0.3;
            for (int k = 0; k < 3; k++) { /* a parallelogram, or a triangle */
                double middle = place(&random) * (1 - size), u = place(&random) * size, v = place(&random) * size;
                p[0][k] = middle - u / 2;
                p[1][k] = middle + u / 2;
                p[2][k] = middle + u / 2 + v;
                p[3][k] = middle - u / 2 + v;
            }
            add_face(&s, f % 2 ? 4 : 3, p);
        }
        paint(&s);
        check_everywhere(&s);
        tn_painting_clear(&s.painting);
    }
}

/* Seen edge on, without an area, or twice the same: nothing to compare, and nothing goes wrong. */
static void test_degenerate_faces(void **state)
{
    (void)state;
    stage s = {.scene.face_count = 0};
    add_face(&s, 4, (double[4][3]){{0, 0, -.5}, {0, .4, -.5}, {0, .4, .5}, {0, 0, .5}});
    add_face(&s, 3, (double[3][3]){{.1, .1, 0}, {.1, .1, 0}, {.1, .1, 0}});
    add_face(&s, 3, (double[3][3]){{-.4, -.1, 0}, {.4, -.1, 0}, {0, .3, 0}});
    add_face(&s, 3, (double[3][3]){{-.4, -.1, 0}, {.4, -.1, 0}, {0, .3, 0}});
    add_face(&s, 3, (double[3][3]){{-.2, -.2, -.2}, {0, 0, 0}, {.2, .2, .2}});
    paint(&s);
    assert_true(s.painting.patch_count >= 3);
    tn_painting_clear(&s.painting);
}

/* So many that parts of the picture are searched side by side. */
static void test_any_number_of_threads_paints_the_same(void **state)
{
    (void)state;
    enum { MANY = 6000 };
    static double points[3 * MANY][3];
    static uint32_t first[MANY + 1];
    uint64_t random = 11;
    for (uint32_t f = 0; f < MANY; f++) {
        double middle[3] = {place(&random), place(&random), place(&random)};
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                points[3 * f + (uint32_t)c][k] = middle[k] + 0.05 * place(&random);
        first[f + 1] = 3 * (f + 1);
    }
    tn_painting paintings[2] = {0};
    tn_error error = {0};
    for (int i = 0; i < 2; i++) {
        tn_scene scene = {.points = points, .first = first, .face_count = MANY, .threads = i ? 4 : 1};
        assert_int_equal(tn_painting_make(&scene, &paintings[i], &error), TN_OK);
    }
    assert_int_equal(paintings[0].patch_count, paintings[1].patch_count);
    assert_int_equal(paintings[0].corner_count, paintings[1].corner_count);
    for (size_t i = 0; i < paintings[0].patch_count; i++) {
        const tn_patch *a = &paintings[0].patches[i], *b = &paintings[1].patches[i];
        assert_true(a->face == b->face && a->first == b->first && a->count == b->count && a->piece == b->piece);
    }
    assert_memory_equal(paintings[0].points, paintings[1].points, paintings[0].corner_count * sizeof(double[3]));
    tn_painting_clear(&paintings[0]);
    tn_painting_clear(&paintings[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_faces_that_pass_through_one_another),
        cmocka_unit_test(test_faces_in_a_circle),
        cmocka_unit_test(test_faces_with_an_order_stay_whole),
        cmocka_unit_test(test_random_faces),
        cmocka_unit_test(test_degenerate_faces),
        cmocka_unit_test(test_any_number_of_threads_paints_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
