/* Drawing: the same bytes each time, formats, papers and scales, limits, texts of any kind. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/base/file.h"
#include "runtime/draw/canvas.h"
#include "runtime/draw/paper.h"
#include "runtime/draw/svg_ids.h"
#include "runtime/draw/svg_page.h"
#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw.h"
#include "tests/support/test_schema.h"

static void renumbers_ids(void **state)
{
    (void)state;
    static const char before[] =
        "<g id=\"surface17\"/><use xlink:href=\"#glyph0-3\"/><p style=\"fill:url(#x);color:#fff\"/>"
        "<symbol id=\"glyph0-3\"/><use xlink:href=\"#surface17\"/>";
    static const char after[] = "<g id=\"i0\"/><use xlink:href=\"#i1\"/><p style=\"fill:url(#i2);color:#fff\"/>"
                                "<symbol id=\"i1\"/><use xlink:href=\"#i0\"/>";
    char *text;
    size_t size;
    tn_error error;
    assert_int_equal(tn_svg_renumber(before, strlen(before), "i", &text, &size, &error), TN_OK);
    assert_string_equal(text, after);
    assert_int_equal(size, strlen(after));
    free(text);
    assert_int_equal(tn_svg_renumber("", 0, "i", &text, &size, &error), TN_OK);
    assert_int_equal(size, 0);
    free(text);
}

/* More ids than the table starts with, each defined once and used once. */
static void renumbers_many_ids(void **state)
{
    (void)state;
    enum { MANY = 5000, ROOM = MANY * 64 };
    char *before = malloc(ROOM), *after = malloc(ROOM), *text;
    size_t used = 0, wanted = 0, size;
    tn_error error;
    assert_non_null(before);
    assert_non_null(after);
    for (int i = 0; i < MANY; i++) {
        used += (size_t)snprintf(before + used, ROOM - used, "id=\"clip%d\" url(#clip%d)", 7 * i + 3, 7 * i + 3);
        wanted += (size_t)snprintf(after + wanted, ROOM - wanted, "id=\"i%d\" url(#i%d)", i, i);
    }
    assert_int_equal(tn_svg_renumber(before, used, "i", &text, &size, &error), TN_OK);
    assert_int_equal(size, wanted);
    assert_memory_equal(text, after, wanted);
    free(text);
    free(before);
    free(after);
}

static void knows_formats(void **state)
{
    (void)state;
    tn_canvas_format format;
    tn_error error;
    assert_int_equal(tn_canvas_format_of("a/b.c/sheet.SVG", &format, &error), TN_OK);
    assert_int_equal(format, TN_CANVAS_SVG);
    assert_int_equal(tn_canvas_format_of("x.pdf", &format, &error), TN_OK);
    assert_int_equal(format, TN_CANVAS_PDF);
    assert_int_equal(tn_canvas_format_of("svg", &format, &error), TN_INVALID);
    assert_int_equal(error.code, 904);
    assert_int_equal(tn_canvas_format_of("x.svg.gz", &format, &error), TN_INVALID);
}

static void knows_papers_and_scales(void **state)
{
    (void)state;
    const tn_paper *paper, *papers;
    const uint32_t *scales;
    char text[32];
    tn_error error;
    assert_int_equal(tn_paper_find("A3", &paper, &error), TN_OK);
    assert_true(fabs(paper->width - 1190.55) < 0.01 && fabs(paper->height - 841.89) < 0.01);
    assert_int_equal(tn_paper_find("a9", &paper, &error), TN_INVALID);
    for (int metric = 0; metric < 2; metric++) {
        size_t count = tn_paper_choices(metric, &papers), scale_count = tn_scale_choices(metric, &scales);
        for (size_t i = 1; i < count; i++)
            assert_true(papers[i].width > papers[i - 1].width && papers[i].height > papers[i - 1].height);
        for (size_t i = 1; i < scale_count; i++)
            assert_true(scales[i] > scales[i - 1]);
    }
    tn_scale_write(192, false, text, sizeof text);
    assert_string_equal(text, "1/16\" = 1'-0\"");
    tn_scale_write(100, true, text, sizeof text);
    assert_string_equal(text, "1:100");
    tn_scale_write(100, false, text, sizeof text);
    assert_string_equal(text, "1:100");
}

/* Texts that are not UTF-8, too long, or nothing: cairo must still be drawing afterwards. */
static void sets_any_text(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "", "plain", "\xff\xfe\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "caf\xc3\xa9", "\xc3", "a\nb\tc"};
    char huge[5000];
    memset(huge, 'x', sizeof huge - 1);
    huge[sizeof huge - 1] = '\0';
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 50, 50);
    cairo_t *context = cairo_create(surface);
    tn_type_face(context, 8, false);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        tn_type_line(context, 1, 10, TN_ALIGN_CENTRE, texts[i]);
        tn_type_fit(context, 1, 10, TN_ALIGN_RIGHT, 3, texts[i]);
        tn_type_paragraph(context, 1, 10, 5, 5, 3, texts[i]);
        assert_int_equal(cairo_status(context), CAIRO_STATUS_SUCCESS);
    }
    tn_type_fit(context, 0, 20, TN_ALIGN_LEFT, 40, huge);
    tn_type_digits(context, 0, 30, 100, "1234567");
    tn_type_digits(context, 0, 30, 2, "12345678901234567890");
    assert_int_equal(tn_type_paragraph(context, 0, 30, 1000, 8, 3, "one line"), 1);
    assert_int_equal(tn_type_paragraph(context, 0, 30, 1, 8, 3, "five short words in lines"), 3);
    assert_true(tn_type_width(context, "mm") > tn_type_width(context, "m"));
    assert_int_equal(cairo_status(context), CAIRO_STATUS_SUCCESS);
    cairo_destroy(context);
    cairo_surface_destroy(surface);
}

/* A paragraph with more words than its lines hold ends with a whole word, also where it is longer than any line. */
static void ends_with_a_whole_word(void **state)
{
    (void)state;
    char words[20000] = "", *said = NULL;
    size_t size;
    for (size_t i = 0; i + 8 < sizeof words; i += 7)
        memcpy(words + i, "pantry ", 8);
    FILE *letters = open_memstream(&said, &size);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 50, 50);
    cairo_t *context = cairo_create(surface);
    assert_true(tn_type_as_text(context, letters));
    tn_type_face(context, 8, false);
    assert_int_equal(tn_type_paragraph(context, 0, 10, 300, 8, 3, words), 3);
    assert_int_equal(tn_type_paragraph(context, 0, 10, 1e6, 8, 3, words), 1);
    fclose(letters);
    const char *end = said;
    for (size_t paragraph = 0; paragraph < 2; paragraph++) {
        end = strstr(end, "\xe2\x80\xa6</text>");
        assert_true(end && end - said > 8);
        assert_memory_equal(end - 7, "pantry ", 7);
        end++;
    }
    cairo_destroy(context);
    cairo_surface_destroy(surface);
    free(said);
}

/* ---- sheets */

enum { PLAN_COUNT = 7, LENGTH = 5 };

typedef struct sheet {
    tn_module *module;
    tn_schema *schema;
    tn_tray trays[PLAN_COUNT][LENGTH];
    tn_drawn_plan plans[PLAN_COUNT];
    char path[64];
} sheet;

static int open_sheet(void **state)
{
    sheet *s = calloc(1, sizeof *s);
    assert_non_null(s);
    tn_builder *builder = tn_builder_new();
    uint32_t index = test_schema_add(builder, &test_schema_paper);
    s->module = test_module(builder);
    s->schema = test_schema_open(s->module, index);
    for (size_t i = 0; i < PLAN_COUNT; i++) {
        for (size_t k = 0; k < LENGTH; k++)
            s->trays[i][k] = (tn_tray)((i * 131 + k * 57) % s->schema->tray_count);
        s->plans[i] = (tn_drawn_plan){s->trays[i], i % (LENGTH + 1), "123456789", NULL, NULL};
    }
    snprintf(s->path, sizeof s->path, "/tmp/tartan-draw-%ld", (long)getpid());
    *state = s;
    return 0;
}

static int close_sheet(void **state)
{
    sheet *s = *state;
    tn_schema_free(s->schema);
    tn_module_free(s->module);
    free(s);
    return 0;
}

static void draw_to(sheet *s, const char *extension, const tn_draw_options *options, uint8_t **bytes, size_t *size)
{
    char path[80];
    tn_error error;
    snprintf(path, sizeof path, "%s.%s", s->path, extension);
    test_ok(tn_plans_draw(s->schema, s->plans, PLAN_COUNT, options, &(tn_picture){.path = path}, &error), &error);
    test_ok(tn_file_read(path, 100 << 20, bytes, size, &error), &error);
    remove(path);
}

static void draws_the_same_bytes(void **state)
{
    static const char *const extensions[] = {"svg", "png", "pdf"};
    sheet *s = *state;
    tn_draw_options options = {.title = "a title", .number_name = "rank", .dpi = 50};
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++) {
        uint8_t *first, *second;
        size_t first_size, second_size;
        draw_to(s, extensions[i], &options, &first, &first_size);
        draw_to(s, extensions[i], &options, &second, &second_size);
        assert_int_equal(first_size, second_size);
        assert_memory_equal(first, second, first_size);
        free(first);
        free(second);
    }
}

static void refuses_what_it_cannot_draw(void **state)
{
    sheet *s = *state;
    tn_error error;
    tn_draw_options few = {.max_plans = PLAN_COUNT - 1}, paper = {.paper = "foolscap"}, dense = {.dpi = 100000},
                    scale = {.scale = 100}, wide = {.columns = 1000}, plain = {0};
    assert_int_equal(tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &few, &(tn_picture){.path = "x.svg"}, &error),
                     TN_LIMIT);
    assert_int_equal(error.code, 820);
    assert_non_null(strstr(error.help, "--max-plans"));
    assert_int_equal(tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &paper, &(tn_picture){.path = "x.svg"}, &error),
                     TN_INVALID);
    assert_int_equal(
        tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &dense, &(tn_picture){.path = "/tmp/tartan-x.png"}, &error),
        TN_LIMIT);
    assert_int_equal(error.code, 820);
    assert_int_equal(tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &scale, &(tn_picture){.path = "x.svg"}, &error),
                     TN_INVALID);
    assert_int_equal(tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &wide, &(tn_picture){.path = "x.svg"}, &error),
                     TN_LIMIT);
    assert_int_equal(
        tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &plain, &(tn_picture){.path = "/no/such/folder/x.svg"}, &error),
        TN_IO);
    assert_int_equal(error.code, 902);
    assert_int_not_equal(access("/tmp/tartan-x.png", F_OK), 0);
}

/* How high an SVG is, in points. */
static double height_of(const uint8_t *svg, size_t size)
{
    char head[400];
    snprintf(head, sizeof head, "%.*s", (int)(size < sizeof head ? size : sizeof head), (const char *)svg);
    const char *height = strstr(head, "height=\"");
    assert_non_null(height);
    return strtod(height + strlen("height=\""), NULL);
}

static double sheet_height(const sheet *s, const char *heading)
{
    tn_drawn_plan plans[40];
    tn_draw_options options = {.paper = "a4", .columns = 2, .number_name = "rank"};
    uint8_t *bytes;
    size_t size;
    char path[80];
    tn_error error;
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        plans[i] = s->plans[i % PLAN_COUNT];
        plans[i].heading = heading;
    }
    snprintf(path, sizeof path, "%s.svg", s->path);
    test_ok(
        tn_plans_draw(s->schema, plans, sizeof plans / sizeof *plans, &options, &(tn_picture){.path = path}, &error),
        &error);
    test_ok(tn_file_read(path, 100 << 20, &bytes, &size, &error), &error);
    remove(path);
    double height = height_of(bytes, size);
    free(bytes);
    return height;
}

/* Forty plans in two columns are twenty rows; a group for each, forty rows, and each row has room for a heading. */
static void groups_begin_rows(void **state)
{
    const sheet *s = *state;
    assert_true(sheet_height(s, "a group") > 1.6 * sheet_height(s, NULL));
}

/* ---- pictures for a page */

static void letters_pages_with_text(void **state)
{
    (void)state;
    tn_picture picture = {.number = 7};
    tn_canvas *canvas;
    tn_error error;
    test_ok(tn_canvas_begin(&picture, 200, 100, "title", &canvas, &error), &error);
    cairo_t *context = tn_canvas_context(canvas);
    tn_type_face(context, 10, true);
    tn_type_line(context, 20.255, 30, TN_ALIGN_CENTRE, "a < b & \"c\"");
    cairo_arc(context, 50, 50, 20, 0, 6);
    cairo_clip(context); /* which needs an id */
    cairo_paint(context);
    cairo_reset_clip(context);
    cairo_set_source_rgb(context, 1, 0, 0);
    cairo_scale(context, 2, 2);
    tn_type_face(context, 5, false);
    tn_type_line(context, 10, 10, TN_ALIGN_RIGHT, "red");
    cairo_rotate(context, 1);
    tn_type_line(context, 0, 0, TN_ALIGN_LEFT, "turned");
    test_ok(tn_canvas_commit(canvas, &error), &error);
    tn_canvas_free(canvas);
    assert_int_equal(strlen(picture.element), picture.size);
    assert_int_equal(strncmp(picture.element, "<svg ", 5), 0);
    assert_non_null(strstr(picture.element, "<text x=\"20.26\" y=\"30\" font-size=\"10\" font-weight=\"bold\" "
                                            "text-anchor=\"middle\">a &lt; b &amp; \"c\"</text>"));
    assert_non_null(strstr(picture.element,
                           "<text x=\"20\" y=\"20\" font-size=\"10\" text-anchor=\"end\" fill=\"#ff0000\">red</text>"));
    assert_non_null(strstr(picture.element, "transform=\"matrix(1.08 1.68 -1.68 1.08 0 0)\">turned</text>"));
    assert_null(strstr(picture.element, "<symbol"));
    assert_null(strstr(picture.element, "id=\"i"));
    assert_non_null(strstr(picture.element, "id=\"p7-"));
    assert_string_equal(picture.element + picture.size - strlen("</g>\n</svg>\n"), "</g>\n</svg>\n");
    free(picture.element);
}

static void shortens_paths(void **state)
{
    (void)state;
    char text[] =
        "<path style=\"fill:none;stroke-linecap:butt;stroke:red;stroke-miterlimit:10;\" d=\"M 1.2345 -0.5 L 3. "
        "17.001\"/><text x=\"1.2345\">fill-opacity:1; 0.12345</text>";
    size_t size = tn_svg_shorten(text, strlen(text));
    assert_string_equal(text, "<path style=\"fill:none;stroke:red;\" d=\"M 1.23 -0.5 L 3. 17.00\"/><text "
                              "x=\"1.2345\">fill-opacity:1; 0.12345</text>");
    assert_int_equal(size, strlen(text));
}

static void draws_nothing(void **state)
{
    sheet *s = *state;
    char path[80];
    tn_error error;
    tn_draw_options options = {0};
    snprintf(path, sizeof path, "%s.svg", s->path);
    test_ok(tn_plans_draw(s->schema, NULL, 0, &options, &(tn_picture){.path = path}, &error), &error);
    assert_int_equal(remove(path), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(renumbers_ids),
        cmocka_unit_test(renumbers_many_ids),
        cmocka_unit_test(knows_formats),
        cmocka_unit_test(knows_papers_and_scales),
        cmocka_unit_test(sets_any_text),
        cmocka_unit_test(ends_with_a_whole_word),
        cmocka_unit_test_setup_teardown(draws_the_same_bytes, open_sheet, close_sheet),
        cmocka_unit_test_setup_teardown(refuses_what_it_cannot_draw, open_sheet, close_sheet),
        cmocka_unit_test_setup_teardown(groups_begin_rows, open_sheet, close_sheet),
        cmocka_unit_test(letters_pages_with_text),
        cmocka_unit_test(shortens_paths),
        cmocka_unit_test_setup_teardown(draws_nothing, open_sheet, close_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
