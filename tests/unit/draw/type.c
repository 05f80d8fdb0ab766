/* Lettering: how wide it is, where lines break, texts of any kind. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/device/lettering.h"
#include "runtime/draw/type.h"

static bool near(double a, double b)
{
    return fabs(a - b) < 1e-9;
}

/* The advances of DejaVu Sans are those of its file: 2048 units are the font's size. */
static void measures_by_the_table(void **state)
{
    (void)state;
    assert_true(near(tn_lettering_width("", false), 0));
    assert_true(near(tn_lettering_width(" ", false), 651 / 2048.0));
    assert_true(near(tn_lettering_width("aM~", false), (1255 + 1767 + 1716) / 2048.0));
    assert_true(near(tn_lettering_width("aM", true), (1382 + 2038) / 2048.0));
    assert_true(near(tn_lettering_width("\xc3\xa9", false), 1260 / 2048.0));      /* e with an acute accent */
    assert_true(near(tn_lettering_width("\xce\xa3", false), 1294 / 2048.0));      /* sigma */
    assert_true(near(tn_lettering_width("\xe2\x80\xa6", false), 2048 / 2048.0));  /* an ellipsis */
    assert_true(near(tn_lettering_width("\xe2\x86\x92", false), 1716 / 2048.0));  /* an arrow */
    assert_true(near(tn_lettering_width("a\xcc\x81", false) - 1255 / 2048.0, 0)); /* a combining accent */
    assert_true(near(tn_lettering_width("\xe5\xae\xb6", true), 1));               /* a character of Chinese */
    assert_true(near(tn_lettering_width("\xe1\x80\x80", false), 1229 / 2048.0));  /* one that the table lacks */
    assert_true(near(tn_lettering_width("\xff\xfe", false), 2 * tn_lettering_width("\xef\xbf\xbd", false)));
    assert_true(near(tn_lettering_height(false), 2384 / 2048.0));
}

static void widths_go_by_the_face(void **state)
{
    (void)state;
    tn_paint *paint = tn_paint_new(NULL);
    assert_non_null(paint);
    tn_paint_face(paint, 20.48, false);
    assert_true(near(tn_type_width(paint, "M"), 17.67));
    tn_paint_face(paint, 20.48, true);
    assert_true(near(tn_type_width(paint, "M"), 20.38));
    tn_paint_scale(paint, 3); /* in units of the state */
    assert_true(near(tn_type_width(paint, "M"), 20.38));
    assert_true(tn_type_width(paint, "a\x1b") > tn_type_width(paint, "aaa")); /* shown as an escape */
    tn_paint_free(paint);
}

static char *set(void (*draw)(tn_paint *paint))
{
    tn_picture picture = {.format = TN_CANVAS_SVG};
    tn_canvas *canvas;
    tn_error error;
    assert_int_equal(tn_canvas_begin(&picture, 100, 100, NULL, &canvas, &error), TN_OK);
    draw(tn_canvas_paint(canvas));
    assert_int_equal(tn_canvas_commit(canvas, &error), TN_OK);
    tn_canvas_free(canvas);
    return picture.element;
}

static void any_text(tn_paint *paint)
{
    static const char *const texts[] = {
        "", "plain", "\xff\xfe\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "caf\xc3\xa9", "\xc3", "a\nb\tc"};
    char huge[5000];
    memset(huge, 'x', sizeof huge - 1);
    huge[sizeof huge - 1] = '\0';
    tn_paint_face(paint, 8, false);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        tn_type_line(paint, 1, 10, TN_ALIGN_CENTRE, texts[i]);
        tn_type_fit(paint, 1, 10, TN_ALIGN_RIGHT, 3, texts[i]);
        tn_type_paragraph(paint, 1, 10, 5, 5, 3, texts[i]);
    }
    tn_type_fit(paint, 0, 20, TN_ALIGN_LEFT, 40, huge);
    tn_type_digits(paint, 0, 30, 100, "1234567");
    tn_type_digits(paint, 0, 30, 2, "12345678901234567890");
    assert_int_equal(tn_type_paragraph(paint, 0, 30, 1000, 8, 3, "one line"), 1);
    assert_int_equal(tn_type_paragraph(paint, 0, 30, 1, 8, 3, "five short words in lines"), 3);
}

static void sets_any_text(void **state)
{
    (void)state;
    free(set(any_text));
}

static void long_paragraphs(tn_paint *paint)
{
    char words[20000] = "";
    for (size_t i = 0; i + 8 < sizeof words; i += 7)
        memcpy(words + i, "pantry ", 8);
    tn_paint_face(paint, 8, false);
    assert_int_equal(tn_type_paragraph(paint, 0, 10, 300, 8, 3, words), 3);
    assert_int_equal(tn_type_paragraph(paint, 0, 10, 1e6, 8, 3, words), 1);
}

/* A paragraph with more words than its lines hold ends with a whole word, also where it is longer than any line. */
static void ends_with_a_whole_word(void **state)
{
    (void)state;
    char *said = set(long_paragraphs);
    const char *end = said;
    for (size_t paragraph = 0; paragraph < 2; paragraph++) {
        end = strstr(end, "\xe2\x80\xa6</text>");
        assert_true(end && end - said > 8);
        assert_memory_equal(end - 7, "pantry ", 7);
        end++;
    }
    free(said);
}

static void veil(tn_paint *paint)
{
    tn_type_line(paint, 0, 10, TN_ALIGN_LEFT, "below");
    tn_type_veil(paint, 0, 0, 10, 10, 0.6);
    tn_type_line(paint, 0, 10, TN_ALIGN_LEFT, "above");
}

static void veils_what_lies_below(void **state)
{
    (void)state;
    char *said = set(veil);
    const char *below = strstr(said, ">below<"), *between = strstr(said, "fill=\"#fff\" fill-opacity=\".6\""),
               *above = strstr(said, "font-size=\"10\">above<");
    assert_true(below && between && above && below < between && between < above);
    free(said);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_by_the_table), cmocka_unit_test(widths_go_by_the_face),
        cmocka_unit_test(sets_any_text),         cmocka_unit_test(ends_with_a_whole_word),
        cmocka_unit_test(veils_what_lies_below),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
