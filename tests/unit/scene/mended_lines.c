/* Lines that are mended in pictures are seen there: each is part of a line that removing hidden lines leaves, which
 * compares lines with triangles and knows nothing of an order in which faces are painted. Random designs of boxes, from
 * many sides. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/geometry/union/union.h"
#include "runtime/geometry/visible.h"
#include "runtime/scene/seen.h"
#include "runtime/solid/design.h"
#include "tests/support/share.h"

enum { BOXES = 5 };

static uint64_t seed, drawn;

static double between(double low, double high)
{
    return low + (high - low) * (double)(tn_random64(31, seed, drawn++) >> 11) * 0x1p-53;
}

/* Many faces lie in one plane. */
static double level(double low, double high)
{
    return seed % 4 ? rint(2 * between(low, high)) / 2 : between(low, high);
}

static void make_mesh(tn_union *u)
{
    tn_solid_box boxes[BOXES] = {{{0}, {0}, {0}, 0, false, false, false}};
    tn_design design = {.boxes = boxes, .box_count = BOXES, .flags = seed % 3 ? 0 : TN_SOLID_SYMMETRY_X};
    tn_cut_box cells[2 * BOXES];
    tn_error error;
    for (int i = 0; i < BOXES; i++)
        for (int k = 0; k < 3; k++) {
            boxes[i].low[k] = level(-3, 2);
            boxes[i].high[k] = boxes[i].low[k] + level(0.5, 4);
        }
    assert_int_equal(tn_design_correct(&design, NULL, &error), TN_OK);
    uint32_t count = BOXES * tn_design_images(&design);
    for (uint32_t i = 0; i < count; i++)
        tn_design_cell(&design, i % BOXES, tn_design_image(&design, i / BOXES), &cells[i]);
    assert_int_equal(tn_union_make(cells, count, u, &error), TN_OK);
}

static double distance_to(const tn_seen_line *line, const double p[2])
{
    double along[2] = {line->to[0] - line->from[0], line->to[1] - line->from[1]},
           off[2] = {p[0] - line->from[0], p[1] - line->from[1]}, length2 = along[0] * along[0] + along[1] * along[1];
    double t = length2 > 0 ? fmin(fmax((off[0] * along[0] + off[1] * along[1]) / length2, 0), 1) : 0;
    return hypot(off[0] - t * along[0], off[1] - t * along[1]);
}

/* Is the place inside a face that is painted after the one that has this corner? */
static bool is_painted_over(const tn_view *view, uint32_t corner, const double p[2])
{
    bool after = false;
    for (size_t f = 0; f < view->face_count; f++) {
        const tn_seen_face *face = &view->faces[f];
        bool inside = false;
        for (uint32_t i = 0; i < face->size && after; i++) {
            const float *a = view->points[face->first + i], *b = view->points[face->first + (i + 1) % face->size];
            double ax = (double)a[0], ay = (double)a[1], bx = (double)b[0], by = (double)b[1];
            if ((ay > p[1]) != (by > p[1]) && p[0] < ax + (p[1] - ay) / (by - ay) * (bx - ax))
                inside = !inside;
        }
        if (inside)
            return true;
        after = after || (corner >= face->first && corner < face->first + face->size);
    }
    return false;
}

/* How many mends are not on a line that is seen. */
static size_t count_stray(const tn_view *view, const tn_seen_line *lines, size_t line_count)
{
    const double step = 1e-3, near = 1e-5; /* the designs are some units large */
    size_t stray = 0;
    for (size_t i = 0; i < view->mend_count; i++) {
        const tn_mend *mend = &view->mends[i];
        const float *from = view->points[mend->corner];
        double p[2] = {(double)from[0] + step * (double)mend->along[0],
                       (double)from[1] + step * (double)mend->along[1]};
        bool seen = (double)mend->length < step || is_painted_over(view, mend->corner, p);
        for (size_t k = 0; k < line_count && !seen; k++)
            seen = distance_to(&lines[k], p) < near;
        stray += !seen;
    }
    return stray;
}

static size_t check(const tn_mesh *mesh)
{
    const tn_camera camera = {between(-180, 180), between(5, 80), 400};
    const tn_eye eye = tn_camera_eye(&camera);
    tn_display_list display;
    tn_view *view;
    tn_seen_line *lines;
    size_t count;
    tn_error error;
    assert_int_equal(tn_display_list_of_mesh(mesh, &display, &error), TN_OK);
    display.closed = true;
    assert_int_equal(tn_view_take(&display, &camera, &view, &error), TN_OK);
    assert_int_equal(tn_mesh_visible(mesh, &eye, 1e-9, &lines, &count, &error), TN_OK);
    size_t stray = count_stray(view, lines, count), mends = view->mend_count;
    if (stray)
        fail_msg("seed %llu: %zu of %zu mended lines are hidden, seen from azimuth %g, elevation %g",
                 (unsigned long long)seed, stray, mends, camera.azimuth, camera.elevation);
    free(lines);
    tn_view_free(view);
    tn_display_list_clear(&display);
    return mends;
}

static void mended_lines_are_seen(void **state)
{
    (void)state;
    size_t mends = 0;
    for (seed = 0; seed < (uint64_t)test_share(1200); seed++) {
        tn_union u;
        drawn = 0;
        make_mesh(&u);
        mends += check(&u.mesh);
        tn_union_clear(&u);
    }
    assert_true(mends > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(mended_lines_are_seen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
