/* Views: lines that end at seams and at corners of faces painted after them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/geometry/render.h"
#include "runtime/scene/seen.h"

typedef struct shape {
    uint32_t group, count;
    double points[5][2];
    uint16_t edges[5]; /* that start there */
} shape;

#define LINE TN_EDGE_DARK
#define SEAM TN_EDGE_NONE

/* Looks straight down at shapes that lie on the ground, or one of them so far above it. */
static tn_view *look_at(const shape *shapes, size_t count, size_t raised, double above)
{
    tn_display_list display;
    tn_view *view;
    tn_error error;
    uint32_t corner = 0;
    assert_int_equal(tn_display_list_new(count, 5 * count, true, &display, &error), TN_OK);
    for (size_t i = 0; i < count; i++) {
        display.first[display.face_count] = corner;
        display.groups[display.face_count++] = shapes[i].group;
        for (uint32_t k = 0; k < shapes[i].count; k++, corner++) {
            const double at[3] = {shapes[i].points[k][0], shapes[i].points[k][1], i == raised ? above : 0};
            memcpy(display.points[corner], at, sizeof at);
            display.edges[corner] = shapes[i].edges[k];
        }
    }
    display.first[display.face_count] = corner;
    tn_camera camera = tn_camera_default();
    camera.azimuth = -90;
    camera.elevation = 90;
    assert_int_equal(tn_view_take(&display, &camera, &view, &error), TN_OK);
    tn_display_list_clear(&display);
    return view;
}

/* A line from left to right, of two pieces that meet in the middle: a slab below it, two wedges above it, and between
 * these a flat triangle that touches the line with its lowest corner alone. */
static const shape slab[] = {
    {0, 5, {{0, -1}, {2, -1}, {2, 0}, {1, 0}, {0, 0}}, {LINE, LINE, LINE, LINE, LINE}},
    {1, 3, {{0, 0}, {1, 0}, {0, 0.2}}, {LINE, SEAM, LINE}},
    {1, 3, {{1, 0}, {2, 0}, {2, 0.2}}, {LINE, LINE, SEAM}},
    {2, 3, {{1, 0}, {2, 0.2}, {0, 0.2}}, {SEAM, LINE, SEAM}},
};
enum { SLAB_COUNT = sizeof slab / sizeof *slab, TRIANGLE = SLAB_COUNT - 1 };

static const tn_seen_face *face_of(const tn_view *view, uint32_t group)
{
    for (size_t f = 0; f < view->face_count; f++)
        if (view->faces[f].group == group)
            return &view->faces[f];
    fail();
    return NULL;
}

static void seams_know_how_sharply_lines_meet_them(void **state)
{
    (void)state;
    tn_view *view = look_at(slab, SLAB_COUNT, SLAB_COUNT, 0);
    const tn_seen_face *triangle = face_of(view, 2);
    const float shallow = (float)(1 / hypot(1, 0.2));
    assert_non_null(view->sharpest);
    for (uint32_t i = 0; i < triangle->size; i++) {
        uint32_t corner = triangle->first + i;
        if (view->edges[corner] != TN_EDGE_NONE)
            continue;
        assert_float_equal(view->sharpest[2 * corner], shallow, 1e-5f);
        assert_float_equal(view->sharpest[2 * corner + 1], shallow, 1e-5f);
    }
    tn_view_free(view);
}

/* Both pieces of the line, once each, at the lowest corner of the triangle, which lies above them. */
static void lines_are_mended_at_bare_corners(void **state)
{
    (void)state;
    tn_view *view = look_at(slab, SLAB_COUNT, SLAB_COUNT, 0);
    const tn_seen_face *triangle = face_of(view, 2);
    size_t found[2] = {0, 0}; /* to the left, to the right */
    for (size_t i = 0; i < view->mend_count; i++) {
        const tn_mend *mend = &view->mends[i];
        if (mend->corner < triangle->first || mend->corner >= triangle->first + triangle->size)
            continue;
        bool right = mend->along[0] > 0;
        found[right]++;
        assert_int_equal(mend->edge, LINE);
        assert_float_equal(mend->length, 1, 1e-5f);
        assert_float_equal(mend->tangent, right ? 0.2f : -0.2f, 1e-5f);
        assert_float_equal(view->points[mend->corner][1], view->points[triangle->first][1], 1.0f);
    }
    assert_int_equal(found[0], 1);
    assert_int_equal(found[1], 1);
    tn_view_free(view);
}

/* What only seems to meet, since one lies over the other, does not. */
static void what_lies_above_meets_nothing(void **state)
{
    (void)state;
    tn_view *view = look_at(slab, SLAB_COUNT, TRIANGLE, 0.5);
    const tn_seen_face *triangle = face_of(view, 2);
    for (size_t i = 0; i < view->mend_count; i++)
        assert_false(view->mends[i].corner >= triangle->first &&
                     view->mends[i].corner < triangle->first + triangle->size);
    tn_view_free(view);
}

/* Where all sides are lines, there is nothing to find. */
static void lines_alone_need_nothing(void **state)
{
    (void)state;
    tn_view *view = look_at(slab, 1, 1, 0);
    assert_null(view->sharpest);
    assert_int_equal(view->mend_count, 0);
    tn_view_free(view);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seams_know_how_sharply_lines_meet_them),
        cmocka_unit_test(lines_are_mended_at_bare_corners),
        cmocka_unit_test(what_lies_above_meets_nothing),
        cmocka_unit_test(lines_alone_need_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
