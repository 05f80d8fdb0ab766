/* Drawing: the same bytes each time, formats, papers and scales, limits. */
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
#include "runtime/draw/scales.h"
#include "runtime/plan/picture/draw.h"
#include "tests/support/test_schema.h"

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

/* False: this build makes no such pictures. */
static bool draw_to(sheet *s, const char *extension, const tn_draw_options *options, uint8_t **bytes, size_t *size)
{
    char path[80];
    tn_error error;
    snprintf(path, sizeof path, "%s.%s", s->path, extension);
    tn_status status = tn_plans_draw(s->schema, s->plans, PLAN_COUNT, options, &(tn_picture){.path = path}, &error);
    if (status == TN_INVALID && error.code == E_PART_ABSENT)
        return false;
    test_ok(status, &error);
    test_ok(tn_file_read(path, 100 << 20, bytes, size, &error), &error);
    remove(path);
    return true;
}

static void draws_the_same_bytes(void **state)
{
    static const char *const extensions[] = {"svg", "png", "pdf"};
    sheet *s = *state;
    tn_draw_options options = {.title = "a title", .number_name = "rank", .dpi = 50};
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++) {
        uint8_t *first, *second;
        size_t first_size, second_size;
        if (!draw_to(s, extensions[i], &options, &first, &first_size)) {
            assert_int_not_equal(i, 0); /* an SVG needs no part */
            continue;
        }
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
    assert_int_not_equal(
        tn_plans_draw(s->schema, s->plans, PLAN_COUNT, &dense, &(tn_picture){.path = "/tmp/tartan-x.png"}, &error),
        TN_OK);
    assert_true(error.code == E_PICTURE_TOO_LARGE || error.code == E_PART_ABSENT);
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
        cmocka_unit_test(knows_formats),
        cmocka_unit_test(knows_papers_and_scales),
        cmocka_unit_test_setup_teardown(draws_the_same_bytes, open_sheet, close_sheet),
        cmocka_unit_test_setup_teardown(refuses_what_it_cannot_draw, open_sheet, close_sheet),
        cmocka_unit_test_setup_teardown(groups_begin_rows, open_sheet, close_sheet),
        cmocka_unit_test_setup_teardown(draws_nothing, open_sheet, close_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
