/* Out of memory while something is drawn: each of our allocations fails once, and then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"
#include "tests/support/failing_memory.h"

static void draw_symbol(tn_paint *paint, const void *of)
{
    (void)of;
    tn_paint_rectangle(paint, 0, 0, 4, 2);
    tn_paint_fill(paint);
}

/* Symbols, hatches and dimensions, some more than once. */
static void draw_meanings(tn_paint *paint)
{
    static const tn_dimension dimension = {{10, 10}, {60, 10}, 8, "50", false, false};
    static const tn_drawn_view view = {"view", 0, 0, 100, 100, {0, 100}, 1};
    tn_paint_view_begin(paint, &view);
    for (int i = 0; i < 30; i++) {
        char name[16];
        snprintf(name, sizeof name, "BOX-%d", i / 2);
        const tn_drawn_symbol symbol = {name, draw_symbol, NULL};
        tn_paint_symbol(paint, &symbol, 50, 50, i, i % 2);
        tn_paint_rectangle(paint, i, i, 20, 10);
        tn_paint_hatch(paint, (tn_hatch)(i % TN_HATCH_COUNT), 1 + i / 2);
        tn_paint_dimension(paint, &dimension);
    }
    tn_paint_view_end(paint);
}

/* Long paths, states within states, clips within clips: all that grows grows more than once. */
static void draw(tn_paint *paint)
{
    for (int i = 0; i < 150; i++) {
        tn_paint_save(paint);
        tn_paint_rectangle(paint, 0, 0, 100 - i * 0.5, 100);
        tn_paint_clip(paint);
        tn_paint_group_begin(paint, TN_PAINT_PART, (size_t)i);
    }
    for (int i = 0; i < 1000; i++)
        tn_paint_line_to(paint, i % 100, i / 10.0);
    tn_paint_fill_keep(paint);
    tn_paint_stroke(paint);
    tn_type_line(paint, 5, 5, TN_ALIGN_LEFT, "text");
    for (int i = 0; i < 150; i++) {
        tn_paint_group_end(paint);
        tn_paint_restore(paint);
    }
    draw_meanings(paint);
    tn_paint_arc(paint, 50, 50, 10, 0, 6);
    tn_paint_fill(paint);
}

static tn_status make(tn_canvas_format format, tn_error *error)
{
    const tn_canvas_options options = {.width = 100, .height = 100, .title = "title", .scale = 50};
    tn_picture picture = {.format = format};
    tn_canvas *canvas = NULL;
    tn_status status = tn_canvas_open(&picture, &options, &canvas, error);
    if (status == TN_OK) {
        draw(tn_canvas_paint(canvas));
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    assert_int_equal(picture.element != NULL, status == TN_OK);
    free(picture.element);
    return status;
}

static void fails_cleanly(void **state)
{
    static const tn_canvas_format formats[] = {TN_CANVAS_BY_PATH, TN_CANVAS_SVG, TN_CANVAS_PNG, TN_CANVAS_PDF,
                                               TN_CANVAS_DXF};
    (void)state;
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        size_t failures = 0;
        bool here = true; /* this build makes such pictures */
        for (int all_after = 0; all_after < 2; all_after++) {
            for (size_t number = 0;; number++) {
                tn_error error = {0};
                fail_allocation(number, all_after);
                tn_status status = make(formats[i], &error);
                here = here && error.code != E_PART_ABSENT;
                if (stop_failing() <= number) {
                    if (status != TN_OK && error.code != E_PART_ABSENT)
                        fail_msg("format %zu: %s", i, error.message);
                    break;
                }
                if (status == TN_OK || error.code == E_PART_ABSENT)
                    continue;
                if (status != TN_MEMORY || error.code != E_OUT_OF_MEMORY)
                    fail_msg("format %zu, allocation %zu: %s", i, number, error.message);
                failures++;
            }
        }
        assert_true(!here || failures > 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fails_cleanly)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
