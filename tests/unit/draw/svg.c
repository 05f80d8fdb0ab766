/* The SVG that is written: numbers, paths, pens, colours, lettering, clips, groups, states within states. */
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/draw/canvas.h"

#define PI 3.14159265358979323846

typedef struct drawing {
    tn_picture picture;
    tn_canvas *canvas;
    tn_paint *paint;
} drawing;

static void begin(drawing *d)
{
    static const tn_canvas_options options = {.width = 200, .height = 99.5};
    tn_error error;
    *d = (drawing){.picture = {.format = TN_CANVAS_SVG}};
    assert_int_equal(tn_canvas_open(&d->picture, &options, &d->canvas, &error), TN_OK);
    d->paint = tn_canvas_paint(d->canvas);
}

/* The picture without its head, its ground and its end. */
static char *end(drawing *d)
{
    static const char head[] =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200pt\" height=\"99.5pt\" viewBox=\"0 0 200 99.5\" "
        "font-family=\"DejaVu Sans,Verdana,sans-serif\" stroke-miterlimit=\"10\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    tn_error error;
    assert_int_equal(tn_canvas_commit(d->canvas, &error), TN_OK);
    tn_canvas_free(d->canvas);
    assert_int_equal(strlen(d->picture.element), d->picture.size);
    assert_int_equal(strncmp(d->picture.element, head, strlen(head)), 0);
    char *rest = strdup(d->picture.element + strlen(head));
    free(d->picture.element);
    assert_non_null(rest);
    size_t size = strlen(rest), tail = strlen("</svg>\n");
    assert_true(size >= tail);
    assert_string_equal(rest + size - tail, "</svg>\n");
    rest[size - tail] = '\0';
    return rest;
}

static void holds(drawing *d, const char *expected)
{
    char *written = end(d);
    assert_string_equal(written, expected);
    free(written);
}

/* ---- paths */

static void writes_short_numbers(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_move_to(d.paint, 0.5, -0.25);
    tn_paint_line_to(d.paint, 10.12345, 7); /* to thousandths */
    tn_paint_line_to(d.paint, 10.12345, 9);
    tn_paint_line_to(d.paint, 12.12349, 9);
    tn_paint_line_to(d.paint, 12.12349, 9); /* goes nowhere */
    tn_paint_close_path(d.paint);
    tn_paint_fill(d.paint);
    holds(&d, "<path d=\"M.5-.25l9.623 7.25v2h2h0z\"/>\n");
}

/* Small steps add up to where they lead, however they are rounded. */
static void adds_up_no_errors(void **state)
{
    (void)state;
    drawing d;
    double x = 0;
    begin(&d);
    tn_paint_move_to(d.paint, 0, 0);
    for (int i = 1; i <= 3000; i++)
        tn_paint_line_to(d.paint, i / 3.0, 5);
    tn_paint_fill(d.paint);
    char *written = end(&d);
    for (const char *at = strchr(written, 'l') + 1; at; at = strchr(at, 'h'), at += at != NULL)
        x += strtod(at, NULL);
    assert_true(fabs(x - 1000) < 1e-6);
    free(written);
}

static void writes_no_strange_numbers(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_move_to(d.paint, NAN, -INFINITY);
    tn_paint_line_to(d.paint, 1e300, -1e-300);
    tn_paint_stroke(d.paint);
    holds(&d, "<path fill=\"none\" stroke=\"#000\" d=\"M0 0h1000000000\"/>\n");
}

/* What a program's locale has for a point is nothing to a picture. */
static void asks_no_locale(void **state)
{
    (void)state;
    drawing d;
    const char *before = setlocale(LC_NUMERIC, NULL);
    setlocale(LC_NUMERIC, "de_DE.UTF-8"); /* where there is none, nothing is tested */
    begin(&d);
    tn_paint_rectangle(d.paint, 1.5, 2, 3.25, 4);
    tn_paint_fill(d.paint);
    holds(&d, "<path d=\"M1.5 2h3.25v4h-3.25z\"/>\n");
    setlocale(LC_NUMERIC, before);
}

static void draws_arcs(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_arc(d.paint, 50, 50, 10, 0, 2 * PI); /* whole */
    tn_paint_fill(d.paint);
    tn_paint_move_to(d.paint, 50, 50); /* goes on to the arc */
    tn_paint_arc(d.paint, 50, 50, 10, 0, PI / 2);
    tn_paint_fill(d.paint);
    tn_paint_arc(d.paint, 50, 50, 10, PI / 2, 0); /* three quarters, forwards */
    tn_paint_fill(d.paint);
    tn_paint_arc_negative(d.paint, 50, 50, 10, PI / 2, 0);
    tn_paint_fill(d.paint);
    holds(&d, "<path d=\"M60 50a10 10 0 0 1-20 0a10 10 0 0 1 20 0\"/>\n"
              "<path d=\"M50 50h10a10 10 0 0 1-10 10\"/>\n"
              "<path d=\"M50 60a10 10 0 1 1 10-10\"/>\n"
              "<path d=\"M50 60a10 10 0 0 0 10-10\"/>\n");
}

static void keeps_paths(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_rectangle(d.paint, 0, 0, 2, 2);
    tn_paint_line_to(d.paint, 5, 5); /* goes on from where the rectangle began */
    tn_paint_new_sub_path(d.paint);
    tn_paint_line_to(d.paint, 7, 7); /* begins anew */
    tn_paint_move_to(d.paint, 8, 8); /* so that nothing began there */
    tn_paint_line_to(d.paint, 9, 8);
    tn_paint_fill_keep(d.paint);
    tn_paint_stroke(d.paint);
    tn_paint_fill(d.paint); /* nothing */
    holds(&d, "<path d=\"M0 0h2v2h-2zm0 0l5 5m3 3h1\"/>\n"
              "<path fill=\"none\" stroke=\"#000\" d=\"M0 0h2v2h-2zm0 0l5 5m3 3h1\"/>\n");
}

/* ---- pens and colours */

static void line(const drawing *d, double y)
{
    tn_paint_move_to(d->paint, 0, y);
    tn_paint_line_to(d->paint, 5, y);
    tn_paint_stroke(d->paint);
}

static void describes_pens(void **state)
{
    static const double dashes[] = {3, 1.25};
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_line_width(d.paint, 0.22);
    tn_paint_dash(d.paint, dashes, 2, 0.5);
    tn_paint_line_cap(d.paint, TN_CAP_ROUND);
    tn_paint_line_join(d.paint, TN_JOIN_ROUND);
    tn_paint_colour(d.paint, 1, 0.2, 0.4);
    line(&d, 1);
    tn_paint_dash(d.paint, NULL, 0, 0);
    tn_paint_line_cap(d.paint, TN_CAP_BUTT);
    tn_paint_line_join(d.paint, TN_JOIN_MITRE);
    tn_paint_translucent(d.paint, 0.5, 0.25, 2, 0.45);
    line(&d, 2);
    holds(&d, "<path fill=\"none\" stroke=\"#f36\" stroke-width=\".22\" stroke-linecap=\"round\" "
              "stroke-linejoin=\"round\" stroke-dasharray=\"3 1.25\" stroke-dashoffset=\".5\" d=\"M0 1h5\"/>\n"
              "<path fill=\"none\" stroke=\"#8040ff\" stroke-opacity=\".45\" stroke-width=\".22\" "
              "d=\"M0 2h5\"/>\n");
}

/* Strokes of one pen are one element until something else is drawn; those that can be seen through never are. */
static void joins_strokes(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    line(&d, 1);
    line(&d, 2);
    tn_paint_line_width(d.paint, 2);
    line(&d, 3);
    tn_paint_rectangle(d.paint, 0, 0, 1, 1);
    tn_paint_fill(d.paint);
    line(&d, 4);
    tn_paint_translucent(d.paint, 0, 0, 0, 0.5);
    line(&d, 5);
    line(&d, 6);
    holds(&d, "<path fill=\"none\" stroke=\"#000\" d=\"M0 1h5m-5 1h5\"/>\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-width=\"2\" d=\"M0 3h5\"/>\n"
              "<path d=\"M0 0h1v1h-1z\"/>\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-width=\"2\" d=\"M0 4h5\"/>\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-opacity=\".5\" stroke-width=\"2\" d=\"M0 5h5\"/>\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-opacity=\".5\" stroke-width=\"2\" d=\"M0 6h5\"/>\n");
}

static void fills_by_either_rule(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_even_odd(d.paint, true);
    tn_paint_translucent(d.paint, 1, 1, 1, 0.25);
    tn_paint_rectangle(d.paint, 0, 0, 1, 1);
    tn_paint_fill(d.paint);
    holds(&d, "<path fill=\"#fff\" fill-opacity=\".25\" fill-rule=\"evenodd\" d=\"M0 0h1v1h-1z\"/>\n");
}

/* ---- the state */

/* Paths, pens and lettering are moved, scaled and turned by us: nothing is left to whoever shows the picture, so that
 * thin lines stay as wide as they are. */
static void transforms_by_itself(void **state)
{
    static const double dash = 2;
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_translate(d.paint, 10, 20);
    tn_paint_scale(d.paint, 0.5);
    tn_paint_save(d.paint);
    tn_paint_rotate(d.paint, PI / 2);
    tn_paint_dash(d.paint, &dash, 1, 0);
    tn_paint_line_width(d.paint, 0.2);
    tn_paint_move_to(d.paint, 4, 0);
    tn_paint_line_to(d.paint, 8, -2);
    tn_paint_stroke(d.paint);
    tn_paint_arc(d.paint, 0, 0, 4, 0, PI / 2);
    tn_paint_fill(d.paint);
    tn_paint_face(d.paint, 12, false);
    tn_paint_text(d.paint, 2, 0, TN_ALIGN_RIGHT, "up");
    tn_paint_restore(d.paint);
    tn_paint_rectangle(d.paint, 2, 2, 4, 4);
    tn_paint_stroke(d.paint);
    holds(&d, "<path fill=\"none\" stroke=\"#000\" stroke-width=\".1\" stroke-dasharray=\"1\" d=\"M10 22l1 2\"/>\n"
              "<path d=\"M10 22a2 2 0 0 1-2-2\"/>\n"
              "<text x=\"10\" y=\"21\" font-size=\"6\" text-anchor=\"end\" transform=\"rotate(90 10 21)\">up</text>\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-width=\".5\" d=\"M11 21h2v2h-2z\"/>\n");
}

static void restores_what_was_saved(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    for (int i = 0; i < 200; i++) { /* deeper than anything that is drawn */
        tn_paint_save(d.paint);
        tn_paint_translate(d.paint, 1, 0);
        tn_paint_line_width(d.paint, i);
        tn_paint_colour(d.paint, 0, 1, 0);
        tn_paint_face(d.paint, 5, true);
    }
    for (int i = 0; i < 201; i++) /* once too often */
        tn_paint_restore(d.paint);
    line(&d, 1);
    tn_paint_text(d.paint, 0, 9, TN_ALIGN_LEFT, "x");
    holds(&d, "<path fill=\"none\" stroke=\"#000\" d=\"M0 1h5\"/>\n<text x=\"0\" y=\"9\" font-size=\"10\">x</text>\n");
}

/* ---- lettering */

static void escapes_text(void **state)
{
    static const struct {
        const char *text, *written;
    } cases[] = {
        {"a < b & \"c\" > 'd'", ">a &lt; b &amp; \"c\" &gt; 'd'<"},
        {"caf\xc3\xa9 \xe2\x80\xa6 \xf0\x9f\x8f\xa0", ">caf\xc3\xa9 \xe2\x80\xa6 \xf0\x9f\x8f\xa0<"},
        {"]]><!--", ">]]&gt;&lt;!--<"},
        {"\xff\xc0\xaf\xed\xa0\x80", ">\?\?\?\?\?\?<"},                        /* no UTF-8 */
        {"a\x01\x1b\x7f\xef\xbf\xbe\xef\xbf\xbd", ">a\?\?\x7f?\xef\xbf\xbd<"}, /* what XML cannot hold */
        {"a\tb\nc", ">a b c<"},
        {"  a", " xml:space=\"preserve\">  a<"},
        {"a  b", " xml:space=\"preserve\">a  b<"},
        {"a ", " xml:space=\"preserve\">a <"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char expected[200];
        drawing d;
        begin(&d);
        tn_paint_text(d.paint, 1, 2.5, TN_ALIGN_LEFT, cases[i].text);
        snprintf(expected, sizeof expected, "<text x=\"1\" y=\"2.5\" font-size=\"10\"%s/text>\n", cases[i].written);
        holds(&d, expected);
    }
}

static void sets_faces(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_face(d.paint, 7.25, true);
    tn_paint_colour(d.paint, 0.4, 0.4, 0.4);
    tn_paint_text(d.paint, 1, 2, TN_ALIGN_CENTRE, "bold");
    tn_paint_text(d.paint, 1, 2, TN_ALIGN_CENTRE, "");
    holds(&d, "<text x=\"1\" y=\"2\" font-size=\"7.25\" font-weight=\"bold\" text-anchor=\"middle\" "
              "fill=\"#666\">bold</text>\n");
}

/* ---- clips */

static void clip(const drawing *d, double width)
{
    tn_paint_save(d->paint);
    tn_paint_rectangle(d->paint, 0, 0, width, 1);
    tn_paint_clip(d->paint);
}

/* One that is used again, also within another, is defined once; another rule makes another clip of it. */
static void writes_clips_once(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    clip(&d, 5);
    line(&d, 1);
    clip(&d, 6);
    line(&d, 1);
    tn_paint_restore(d.paint);
    tn_paint_restore(d.paint);
    clip(&d, 5);
    line(&d, 2);
    tn_paint_restore(d.paint);
    tn_paint_even_odd(d.paint, true);
    clip(&d, 5);
    tn_paint_restore(d.paint);
    static const char stroke[] = "<path fill=\"none\" stroke=\"#000\" d=\"M0 1h5\"/>\n";
    char expected[2000];
    snprintf(expected, sizeof expected,
             "<clipPath id=\"c0\"><path d=\"M0 0h5v1h-5z\"/></clipPath>\n<g clip-path=\"url(#c0)\">\n%s"
             "<clipPath id=\"c1\"><path d=\"M0 0h6v1h-6z\"/></clipPath>\n<g clip-path=\"url(#c1)\">\n%s"
             "</g>\n</g>\n<g clip-path=\"url(#c0)\">\n<path fill=\"none\" stroke=\"#000\" d=\"M0 2h5\"/>\n</g>\n"
             "<clipPath id=\"c2\"><path d=\"M0 0h5v1h-5z\" clip-rule=\"evenodd\"/></clipPath>\n"
             "<g clip-path=\"url(#c2)\">\n</g>\n",
             stroke, stroke);
    holds(&d, expected);
}

/* A clip of nothing leaves nothing, and is no failure. */
static void clips_to_nothing(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_save(d.paint);
    tn_paint_clip(d.paint);
    line(&d, 1);
    tn_paint_restore(d.paint);
    holds(&d, "<clipPath id=\"c0\"><path d=\"\"/></clipPath>\n<g clip-path=\"url(#c0)\">\n"
              "<path fill=\"none\" stroke=\"#000\" d=\"M0 1h5\"/>\n</g>\n");
}

/* ---- groups */

static void nests_groups(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_group_begin(d.paint, TN_PAINT_PLAN, 3);
    line(&d, 1);
    tn_paint_group_begin(d.paint, TN_PAINT_TRAY, 0);
    tn_paint_scale(d.paint, 2);
    tn_paint_target(d.paint, 1, 2, 3, 4.25);
    line(&d, 1);
    tn_paint_group_end(d.paint);
    tn_paint_group_end(d.paint);
    tn_paint_group_begin(d.paint, TN_PAINT_RULE, 1);
    tn_paint_group_begin(d.paint, TN_PAINT_PART, 12);
    tn_paint_group_end(d.paint);
    tn_paint_group_end(d.paint);
    holds(&d, "<g data-plan=\"3\">\n<path fill=\"none\" stroke=\"#000\" d=\"M0 1h5\"/>\n<g data-tray=\"0\">\n"
              "<rect x=\"2\" y=\"4\" width=\"6\" height=\"8.5\" fill-opacity=\"0\"/>\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-width=\"2\" d=\"M0 2h10\"/>\n</g>\n</g>\n"
              "<g data-rule=\"1\">\n<g data-part=\"12\">\n</g>\n</g>\n");
}

/* ---- symbols, hatches, dimensions */

static void draw_hook(tn_paint *paint, const void *of)
{
    tn_paint_move_to(paint, 0, 0);
    tn_paint_line_to(paint, *(const double *)of, 0);
    tn_paint_line_to(paint, *(const double *)of, 1);
    tn_paint_stroke(paint);
}

/* A symbol is defined once for each scale, in a state of its own, and leaves the state as it was. */
static void defines_symbols_once(void **state)
{
    static const double three = 3;
    static const tn_drawn_symbol hook = {"HOOK-<3>", draw_hook, &three};
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_colour(d.paint, 1, 0, 0);
    tn_paint_symbol(d.paint, &hook, 10, 20, 0, false);
    tn_paint_symbol(d.paint, &hook, 10, 30.5, PI / 2, false);
    tn_paint_translate(d.paint, 1, 2);
    tn_paint_symbol(d.paint, &hook, 10, 20, PI, true);
    tn_paint_symbol(d.paint, &hook, 10, 20, 0, true);
    tn_paint_scale(d.paint, 2);
    tn_paint_symbol(d.paint, &hook, 10, 20, 0, false);
    line(&d, 1);
    holds(&d, "<defs><g id=\"s0\" data-name=\"HOOK-&lt;3&gt;\">\n<path fill=\"none\" stroke=\"#000\" d=\"M0 0h3v1\"/>\n"
              "</g></defs>\n<use href=\"#s0\" x=\"10\" y=\"20\"/>\n"
              "<use href=\"#s0\" transform=\"translate(10 30.5)rotate(90)\"/>\n"
              "<use href=\"#s0\" transform=\"translate(11 22)rotate(180)scale(-1 1)\"/>\n"
              "<use href=\"#s0\" transform=\"translate(11 22)scale(-1 1)\"/>\n"
              "<defs><g id=\"s1\" data-name=\"HOOK-&lt;3&gt;\">\n"
              "<path fill=\"none\" stroke=\"#000\" stroke-width=\"2\" d=\"M0 0h6v2\"/>\n</g></defs>\n"
              "<use href=\"#s1\" x=\"21\" y=\"42\"/>\n"
              "<path fill=\"none\" stroke=\"#f00\" stroke-width=\"2\" d=\"M1 4h10\"/>\n");
}

static void draw_word(tn_paint *paint, const void *of)
{
    tn_paint_text(paint, 0, 0, TN_ALIGN_LEFT, of);
}

static void refuses_words_in_symbols(void **state)
{
    static const tn_drawn_symbol word = {"WORD", draw_word, "word"};
    (void)state;
    drawing d;
    tn_error error;
    begin(&d);
    tn_paint_symbol(d.paint, &word, 10, 20, 0, false);
    assert_int_equal(tn_canvas_commit(d.canvas, &error), TN_INTERNAL);
    tn_canvas_free(d.canvas);
}

/* One pattern for all regions of one pen, counted from the state's origin, not from the region. */
static void fills_with_patterns(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    for (int i = 0; i < 3; i++) {
        tn_paint_rectangle(d.paint, 10 * i, 0, 5, 5);
        tn_paint_line_width(d.paint, i < 2 ? 0.5 : 0.25);
        tn_paint_hatch(d.paint, TN_HATCH_TILES, 0.5);
    }
    tn_paint_hatch(d.paint, TN_HATCH_TILES, 0.5); /* nothing */
    char *written = end(&d);
    assert_non_null(strstr(written, "<pattern id=\"h0\" width=\"30\" height=\"2\" patternUnits=\"userSpaceOnUse\" "
                                    "patternTransform=\"translate(0 -1)rotate(0)\"><path stroke=\"#000\" "
                                    "stroke-width=\".5\" d=\"M0 1h30\"/></pattern>\n"
                                    "<path fill=\"url(#h0)\" d=\"M0 0h5v5h-5z\"/>\n<pattern id=\"h1\""));
    assert_non_null(strstr(written, "<path fill=\"url(#h0)\" d=\"M10 0h5v5h-5z\"/>\n<path fill=\"url(#h1)\""));
    assert_non_null(strstr(written, "<pattern id=\"h3\""));
    assert_null(strstr(written, "<pattern id=\"h4\""));
    free(written);
}

/* Millimetres on paper, whatever the scale. */
static void weighs_lines_on_paper(void **state)
{
    (void)state;
    drawing d;
    begin(&d);
    tn_paint_scale(d.paint, 4);
    tn_paint_weight(d.paint, TN_WEIGHT_CUT);
    line(&d, 1);
    holds(&d, "<path fill=\"none\" stroke=\"#000\" stroke-width=\"1.417\" d=\"M0 4h20\"/>\n");
}

/* The text is above the line for who reads it from below or from the right, whichever point comes first. */
static void turns_dimensions_to_readers(void **state)
{
    static const double ends[4][2] = {{100, 50}, {0, 50}, {50, 100}, {50, 0}};
    static const char *const turns[4] = {"", "", "rotate(-90 ", "rotate(-90 "};
    (void)state;
    for (int i = 0; i < 4; i++) {
        drawing d;
        begin(&d);
        const tn_dimension dimension = {{50, 50}, {ends[i][0], ends[i][1]}, 10, "50", false, false};
        tn_paint_dimension(d.paint, &dimension);
        char *written = end(&d);
        const char *text = strstr(written, "<text ");
        assert_non_null(text);
        assert_true(turns[i][0] ? strstr(text, turns[i]) != NULL : strstr(text, "rotate") == NULL);
        free(written);
    }
}

/* ---- elements, and what an SVG does not have */

static void numbers_elements(void **state)
{
    (void)state;
    tn_picture picture = {.number = 7};
    tn_canvas *canvas;
    tn_error error;
    assert_int_equal(tn_canvas_begin(&picture, 10, 10, "title", &canvas, &error), TN_OK);
    tn_paint *paint = tn_canvas_paint(canvas);
    tn_paint_rectangle(paint, 0, 0, 1, 1);
    tn_paint_clip(paint);
    assert_int_equal(tn_canvas_commit(canvas, &error), TN_OK);
    tn_canvas_free(canvas);
    assert_int_equal(strncmp(picture.element, "<svg ", 5), 0);
    assert_non_null(strstr(picture.element, "<clipPath id=\"p7-c0\">"));
    assert_non_null(strstr(picture.element, "url(#p7-c0)"));
    free(picture.element);
}

static void has_neither_pages_nor_pixels(void **state)
{
    static const uint32_t pixel = UINT32_MAX;
    (void)state;
    drawing d;
    tn_error error;
    begin(&d);
    assert_int_equal(tn_canvas_page(d.canvas, 10, 10, &error), TN_INTERNAL);
    assert_true(tn_paint_pixel(d.paint) == 0);
    tn_paint_pixels(d.paint, &pixel, 1, 1, 0, 0, 1);
    line(&d, 1); /* nothing more is drawn, and nothing breaks */
    assert_int_equal(tn_canvas_commit(d.canvas, &error), TN_INTERNAL);
    tn_canvas_free(d.canvas);
    assert_null(d.picture.element);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(writes_short_numbers),
        cmocka_unit_test(adds_up_no_errors),
        cmocka_unit_test(writes_no_strange_numbers),
        cmocka_unit_test(asks_no_locale),
        cmocka_unit_test(draws_arcs),
        cmocka_unit_test(keeps_paths),
        cmocka_unit_test(describes_pens),
        cmocka_unit_test(joins_strokes),
        cmocka_unit_test(fills_by_either_rule),
        cmocka_unit_test(transforms_by_itself),
        cmocka_unit_test(restores_what_was_saved),
        cmocka_unit_test(escapes_text),
        cmocka_unit_test(sets_faces),
        cmocka_unit_test(writes_clips_once),
        cmocka_unit_test(clips_to_nothing),
        cmocka_unit_test(nests_groups),
        cmocka_unit_test(defines_symbols_once),
        cmocka_unit_test(refuses_words_in_symbols),
        cmocka_unit_test(fills_with_patterns),
        cmocka_unit_test(weighs_lines_on_paper),
        cmocka_unit_test(turns_dimensions_to_readers),
        cmocka_unit_test(numbers_elements),
        cmocka_unit_test(has_neither_pages_nor_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
