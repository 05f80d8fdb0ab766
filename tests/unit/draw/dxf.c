/* The DXF that is written: places, arcs, polylines, hatches, blocks, dimensions, layers of both profiles, texts. */
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
#include "runtime/draw/device/dxf_file.h"

#define PI 3.14159265358979323846
#define MM (72 / 25.4) /* points a millimetre */

typedef struct drawing {
    tn_picture picture;
    tn_canvas *canvas;
    tn_paint *paint;
} drawing;

static void begin(drawing *d, const tn_canvas_options *options, tn_profile profile)
{
    tn_error error;
    *d = (drawing){.picture = {.format = TN_CANVAS_DXF, .profile = profile}};
    assert_int_equal(tn_canvas_open(&d->picture, options, &d->canvas, &error), TN_OK);
    d->paint = tn_canvas_paint(d->canvas);
}

/* 100 x 50 mm of paper, not to scale. */
static void begin_plain(drawing *d)
{
    static const tn_canvas_options options = {.width = 100 * MM, .height = 50 * MM};
    begin(d, &options, TN_PROFILE_BY_MEASURES);
}

static char *end(drawing *d)
{
    tn_error error;
    assert_int_equal(tn_canvas_commit(d->canvas, &error), TN_OK);
    tn_canvas_free(d->canvas);
    assert_int_equal(strlen(d->picture.element), d->picture.size);
    return d->picture.element;
}

/* The picture has these groups, one after the other. */
static void holds(const char *written, const char *groups)
{
    if (!strstr(written, groups))
        fail_msg("there is no\n%s\nin\n%s", groups, strstr(written, "ENTITIES"));
}

static size_t count(const char *written, const char *what)
{
    size_t found = 0;
    for (; (written = strstr(written, what)); written++)
        found++;
    return found;
}

/* ---- paths */

/* y goes up, from the lower edge of the paper; numbers have no comma, whatever the locale. */
static void draws_lines(void **state)
{
    (void)state;
    drawing d;
    setlocale(LC_ALL, "de_DE.UTF-8");
    begin_plain(&d);
    tn_paint_move_to(d.paint, 10 * MM, 20 * MM);
    tn_paint_line_to(d.paint, 10 * MM, 20 * MM); /* goes nowhere */
    tn_paint_line_to(d.paint, 12.5 * MM, 49 * MM);
    tn_paint_weight(d.paint, TN_WEIGHT_SEEN);
    tn_paint_stroke(d.paint);
    tn_paint_layer(d.paint, TN_LAYER_WALL_CUT);
    tn_paint_rectangle(d.paint, 0, 0, 10 * MM, 5 * MM);
    tn_paint_weight(d.paint, TN_WEIGHT_CUT);
    tn_paint_stroke(d.paint);
    setlocale(LC_ALL, "C");
    char *written = end(&d);
    holds(written, "8\n0\n370\n35\n100\nAcDbLine\n10\n10.0\n20\n30.0\n30\n0.0\n11\n12.5\n21\n1.0\n31\n0.0\n");
    holds(written,
          "8\nA-21C---E-\n370\n50\n100\nAcDbPolyline\n90\n4\n70\n1\n10\n0.0\n20\n50.0\n10\n10.0\n20\n50.0\n10\n"
          "10.0\n20\n45.0\n10\n0.0\n20\n45.0\n0\n");
    assert_int_equal(count(written, "0\nLINE\n"), 1);
    free(written);
}

/* Arcs of a DXF run against the clock. One alone is an arc or a circle; in a line it is a bulge. */
static void draws_arcs(void **state)
{
    (void)state;
    drawing d;
    begin_plain(&d);
    tn_paint_arc(d.paint, 50 * MM, 25 * MM, 10 * MM, -PI / 2, 0); /* from above the middle to its right */
    tn_paint_stroke(d.paint);
    tn_paint_arc_negative(d.paint, 50 * MM, 25 * MM, 10 * MM, 0, -PI / 2);
    tn_paint_stroke(d.paint);
    tn_paint_arc(d.paint, 50 * MM, 25 * MM, 4 * MM, 0, 2 * PI);
    tn_paint_stroke(d.paint);
    tn_paint_move_to(d.paint, 0, 50 * MM);
    tn_paint_arc(d.paint, 20 * MM, 50 * MM, 10 * MM, PI, 2 * PI); /* a bridge */
    tn_paint_stroke(d.paint);
    char *written = end(&d);
    static const char arc[] = "AcDbCircle\n10\n50.0\n20\n25.0\n30\n0.0\n40\n10.0\n100\nAcDbArc\n50\n0.0\n51\n90.0\n";
    holds(written, arc);
    assert_int_equal(count(written, arc), 2);
    holds(written, "0\nCIRCLE\n");
    holds(written, "90\n3\n70\n0\n10\n0.0\n20\n0.0\n10\n10.0\n20\n0.0\n42\n-1.0\n10\n30.0\n20\n0.0\n");
    free(written);
}

static void trace(const drawing *d, double x0, double y0, double x1, double y1)
{
    tn_paint_move_to(d->paint, x0 * MM, (50 - y0) * MM);
    tn_paint_line_to(d->paint, x1 * MM, (50 - y1) * MM);
}

/* Lines that end where exactly one other does are one polyline, a ring is closed; of three that meet, none is joined.
 */
static void joins_lines(void **state)
{
    (void)state;
    drawing d;
    begin_plain(&d);
    trace(&d, 20, 10, 10, 10); /* a ring, in no order */
    trace(&d, 10, 20, 20, 20);
    trace(&d, 20, 10, 20, 20);
    trace(&d, 10, 20, 10, 10);
    trace(&d, 40, 10, 50, 10); /* a chain of two */
    trace(&d, 50, 20, 50, 10);
    trace(&d, 70, 10, 80, 10); /* a star */
    trace(&d, 70, 10, 70, 20);
    trace(&d, 70, 10, 60, 10);
    tn_paint_stroke(d.paint);
    char *written = end(&d);
    holds(written, "AcDbPolyline\n90\n3\n70\n0\n10\n40.0\n20\n10.0\n10\n50.0\n20\n10.0\n10\n50.0\n20\n20.0\n");
    holds(written,
          "AcDbPolyline\n90\n4\n70\n1\n10\n20.0\n20\n10.0\n10\n10.0\n20\n10.0\n10\n10.0\n20\n20.0\n10\n20.0\n20\n"
          "20.0\n");
    assert_int_equal(count(written, "0\nLWPOLYLINE\n"), 2);
    assert_int_equal(count(written, "0\nLINE\n"), 3);
    free(written);
}

/* What is white or can be seen through covers something elsewhere, and is left out here. */
static void fills_solidly(void **state)
{
    (void)state;
    drawing d;
    begin_plain(&d);
    assert_false(tn_paint_covers(d.paint));
    tn_paint_colour(d.paint, 1, 1, 1);
    tn_paint_rectangle(d.paint, 0, 0, 10, 10);
    tn_paint_fill(d.paint);
    tn_paint_translucent(d.paint, 0, 0, 0, 0.5);
    tn_paint_rectangle(d.paint, 0, 0, 10, 10);
    tn_paint_fill(d.paint);
    tn_paint_colour(d.paint, 1, 0, 0.2);
    tn_paint_rectangle(d.paint, 0, 40 * MM, 10 * MM, 10 * MM);
    tn_paint_fill(d.paint);
    char *written = end(&d);
    assert_int_equal(count(written, "0\nHATCH\n"), 1);
    holds(written, "420\n16711731\n100\nAcDbHatch\n"); /* 0xff0033 */
    holds(written, "2\nSOLID\n70\n1\n71\n0\n91\n1\n92\n3\n72\n0\n73\n1\n93\n4\n10\n0.0\n20\n10.0\n");
    free(written);
}

/* ---- drawings to scale */

/* In feet: inches, layers of the AIA; the origin of the view is that of model space. What is in no view is on the
 * sheet. */
static void stands_in_model_space(void **state)
{
    static const tn_canvas_options options = {.width = 720, .height = 360, .title = "A/B", .scale = 48, .feet = true};
    static const tn_drawn_view first = {"ground", 36, 36, 288, 288, {72, 288}, 1},
                               second = {"above", 360, 36, 288, 288, {400, 288}, 2};
    (void)state;
    drawing d;
    begin(&d, &options, TN_PROFILE_BY_MEASURES);
    tn_paint_layer(d.paint, TN_LAYER_DOOR);
    tn_paint_view_begin(d.paint, &first);
    tn_paint_move_to(d.paint, 72, 288);
    tn_paint_line_to(d.paint, 144, 216);
    tn_paint_stroke(d.paint);
    tn_paint_view_end(d.paint);
    tn_paint_view_begin(d.paint, &second);
    tn_paint_move_to(d.paint, 400, 288);
    tn_paint_line_to(d.paint, 401.5, 288);
    tn_paint_stroke(d.paint);
    tn_paint_view_end(d.paint);
    tn_paint_layer(d.paint, TN_LAYER_TITLE);
    tn_paint_text(d.paint, 36, 324, TN_ALIGN_LEFT, "sheet");
    char *written = end(&d);
    holds(written, "$INSUNITS\n70\n1\n");
    holds(written, "$MEASUREMENT\n70\n0\n");
    holds(written,
          "100\nAcDbEntity\n8\nA-DOOR\n370\n35\n100\nAcDbLine\n10\n0.0\n20\n0.0\n30\n0.0\n11\n48.0\n21\n48.0\n");
    holds(written,
          "AcDbLine\n10\n438.0\n20\n0.0\n30\n0.0\n11\n440.0\n"); /* 328 points of 4/3 inch are 437.33; steps of 6 */
    holds(written, "67\n1\n8\nA-ANNO-TTLB\n100\nAcDbText\n10\n0.5\n20\n0.5\n");
    holds(written, "40\n4.0\n41\n4.0\n68\n2\n69\n2\n12\n72.0\n22\n72.0\n"); /* a window that shows the first view */
    holds(written, "45\n192.0\n");
    assert_int_equal(count(written, "0\nVIEWPORT\n"), 3);
    holds(written, "3\nA-B\n350\n"); /* the layout's name */
    free(written);
}

static void names_layers_by_profile(void **state)
{
    static const tn_canvas_options options = {.width = 100, .height = 100};
    static const char *const names[] = {
        [TN_PROFILE_BY_MEASURES] = "A-82----E-", [TN_PROFILE_ISO] = "A-82----E-", [TN_PROFILE_US] = "A-FURN"};
    (void)state;
    for (int i = TN_PROFILE_BY_MEASURES; i <= TN_PROFILE_US; i++) {
        drawing d;
        begin(&d, &options, (tn_profile)i);
        tn_paint_layer(d.paint, TN_LAYER_FURNITURE);
        tn_paint_rectangle(d.paint, 1, 1, 5, 5);
        tn_paint_stroke(d.paint);
        char *written = end(&d);
        assert_int_equal(count(written, names[i]), 2); /* in the table, and of the entity */
        free(written);
    }
}

/* ---- blocks */

static void draw_hook(tn_paint *paint, const void *of)
{
    (void)of;
    tn_paint_move_to(paint, 0, 0);
    tn_paint_line_to(paint, 10 * MM, 0);
    tn_paint_line_to(paint, 10 * MM, 5 * MM);
    tn_paint_stroke(paint);
}

static void inserts_symbols(void **state)
{
    static const tn_drawn_symbol hook = {"HOOK 900/2", draw_hook, NULL};
    (void)state;
    drawing d;
    begin_plain(&d);
    tn_paint_symbol(d.paint, &hook, 10 * MM, 20 * MM, 0, false);
    tn_paint_symbol(d.paint, &hook, 10 * MM, 20 * MM, PI / 2, true);
    tn_paint_scale(d.paint, 2);
    tn_paint_symbol(d.paint, &hook, 5 * MM, 10 * MM, 0, false); /* of another size: another block */
    char *written = end(&d);
    assert_int_equal(count(written, "0\nBLOCK\n"), 4); /* two are the spaces */
    holds(written, "2\nHOOK-900-2\n");
    holds(written, "2\nHOOK-900-2-2\n");
    holds(written, "10\n0.0\n20\n0.0\n10\n10.0\n20\n0.0\n10\n10.0\n20\n-5.0\n");
    holds(written,
          "AcDbBlockReference\n2\nHOOK-900-2\n10\n10.0\n20\n30.0\n30\n0.0\n41\n1.0\n42\n1.0\n43\n1.0\n50\n0.0\n");
    holds(written, "41\n-1.0\n42\n1.0\n43\n1.0\n50\n270.0\n");
    free(written);
}

/* A text that the style of dimensions would write is left to it; another is given. */
static void writes_dimensions(void **state)
{
    static const struct {
        double inches; /* or millimetres */
        bool feet, given;
        const char *text;
    } all[] = {
        {144, true, false, "12'"},      {66.5, true, false, "5'-6 1/2\""}, {66.5, true, false, "5'6-1/2\""},
        {6.5, true, false, "6 1/2\""},  {66, true, true, "5'-7\""},        {3600, false, false, "3.6m"},
        {3600, false, false, "3.60 m"}, {3600, false, true, "3.7m"},       {3600, false, true, "about"},
        {3600, false, false, "3.6"},    {3600, false, false, "3600"},      {3600, false, true, "3601"},
        {0.75, true, false, "3/4\""},
    };
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const tn_canvas_options options = {.width = 720, .height = 360, .scale = 100, .feet = all[i].feet};
        static const tn_drawn_view view = {"ground", 0, 0, 720, 360, {0, 360}, 1};
        double points = all[i].inches / 100 * (all[i].feet ? 72 : MM);
        drawing d;
        begin(&d, &options, TN_PROFILE_BY_MEASURES);
        tn_paint_view_begin(d.paint, &view);
        const tn_dimension dimension = {{0, 360}, {points, 360}, 36, all[i].text, false, false};
        tn_paint_dimension(d.paint, &dimension);
        tn_paint_view_end(d.paint);
        char *written = end(&d), *text = strstr(written, "0\nDIMENSION\n");
        assert_non_null(text);
        text = strstr(text, "\n1\n");
        assert_non_null(text);
        assert_int_equal(text[3] != '\n', all[i].given);
        holds(written, "2\n*D1\n70\n1\n");
        free(written);
    }
}

/* ---- lettering */

/* A caret has a blank after it, a backslash is a number, what is no text is a question mark. */
static void writes_texts(void **state)
{
    (void)state;
    tn_buffer text = {0};
    tn_dxf_put_text(&text, 1, "a^b\\U+0041 %%u \xc3\xa4\xe2\x82\xac\xf0\x9d\x84\x9e\n\xff");
    assert_string_equal(text.data, "1\na^ b\\U+005CU+0041 %%u \xc3\xa4\xe2\x82\xac\xf0\x9d\x84\x9e??\n");
    free(text.data);
}

/* Each handle is that of one thing, and the seed is beyond all. */
static void has_handles_once(void **state)
{
    static const tn_drawn_symbol hook = {"HOOK", draw_hook, NULL};
    static const tn_dimension dimension = {{10, 10}, {60, 10}, 8, "50", false, false};
    static const double dashes[] = {3, 1, 2};
    (void)state;
    drawing d;
    begin_plain(&d);
    for (int i = 0; i < 20; i++) {
        tn_paint_symbol(d.paint, &hook, 1, 2, 0, false);
        tn_paint_dimension(d.paint, &dimension);
        tn_paint_dash(d.paint, dashes, (size_t)(i % 4), 0);
        tn_paint_rectangle(d.paint, 0, 0, 10, 10);
        tn_paint_hatch(d.paint, (tn_hatch)(i % TN_HATCH_COUNT), 1);
        tn_paint_rectangle(d.paint, 0, 0, 10, 10);
        tn_paint_stroke(d.paint);
    }
    char *written = end(&d);
    static bool seen[0x10000];
    unsigned long seed = 0;
    size_t handles = 0;
    for (char *code = written; *code;) {
        char *value = strchr(code, '\n') + 1, *next = strchr(value, '\n') + 1;
        value[-1] = next[-1] = '\0';
        const char *line = value, *this = code;
        code = next;
        if (strcmp(this, "5") != 0 && strcmp(this, "105") != 0)
            continue;
        unsigned long handle = strtoul(line, NULL, 16);
        if (!seed) {
            seed = handle;
            continue;
        }
        assert_in_range(handle, 1, seed - 1);
        assert_false(seen[handle]);
        seen[handle] = true;
        handles++;
    }
    assert_true(handles > 100);
    free(written);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_lines),           cmocka_unit_test(draws_arcs),
        cmocka_unit_test(joins_lines),           cmocka_unit_test(fills_solidly),
        cmocka_unit_test(stands_in_model_space), cmocka_unit_test(names_layers_by_profile),
        cmocka_unit_test(inserts_symbols),       cmocka_unit_test(writes_dimensions),
        cmocka_unit_test(writes_texts),          cmocka_unit_test(has_handles_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
