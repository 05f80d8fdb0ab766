/* Draws whatever means something (runtime/draw/paint.h): drawn_meanings FILE.svg|png|pdf|dxf. For comparing pictures of
 * one drawing that is written in several ways. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/draw/canvas.h"

#define QUARTER (M_PI / 2)

enum { HATCHES = TN_HATCH_COUNT, TURNS = 8, CELL = 60 };

/* A door of so many points, hinged at the origin. */
static void draw_door(tn_paint *paint, const void *of)
{
    double wide = *(const double *)of;
    tn_paint_layer(paint, TN_LAYER_DOOR);
    tn_paint_rectangle(paint, 0, -wide, 2, wide);
    tn_paint_colour(paint, 0.8, 0.7, 0.6);
    tn_paint_fill_keep(paint);
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_weight(paint, TN_WEIGHT_SEEN);
    tn_paint_stroke(paint);
    tn_paint_arc(paint, 0, 0, wide, -QUARTER, 0);
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_stroke(paint);
    tn_paint_layer(paint, TN_LAYER_WALL_CUT);
    tn_paint_rectangle(paint, wide, -1, 4, 2);
    tn_paint_fill(paint);
}

/* A ring of each pattern, its hole by the rule of even and odd. */
static void draw_hatches(tn_paint *paint)
{
    for (int i = 0; i < HATCHES; i++) {
        double x = 10 + i * CELL;
        tn_paint_layer(paint, TN_LAYER_HATCH);
        tn_paint_even_odd(paint, true);
        tn_paint_rectangle(paint, x, 10, CELL - 10, CELL - 10);
        tn_paint_new_sub_path(paint);
        tn_paint_arc(paint, x + (CELL - 10) / 2.0, 10 + (CELL - 10) / 2.0, 12, 0, 4 * QUARTER);
        tn_paint_close_path(paint);
        tn_paint_weight(paint, TN_WEIGHT_HATCH);
        tn_paint_hatch(paint, (tn_hatch)i, 1);
        tn_paint_layer(paint, TN_LAYER_WALL_CUT);
        tn_paint_rectangle(paint, x, 10, CELL - 10, CELL - 10);
        tn_paint_weight(paint, TN_WEIGHT_CUT);
        tn_paint_stroke(paint);
        tn_paint_layer(paint, TN_LAYER_TEXT);
        tn_paint_capitals(paint, 2.5 * TN_POINTS_PER_MM, false);
        tn_paint_text(paint, x + (CELL - 10) / 2.0, 75, TN_ALIGN_CENTRE, "Wall \xc3\xa4");
    }
}

static void draw_symbols(tn_paint *paint)
{
    static const double wide = 20, narrow = 14;
    const tn_drawn_symbol door = {"DOOR-20", draw_door, &wide}, small = {"DOOR-14", draw_door, &narrow};
    for (int i = 0; i < TURNS; i++) {
        tn_paint_layer(paint, TN_LAYER_DOOR);
        tn_paint_symbol(paint, &door, 35 + i * 52, 120, i % 4 * QUARTER, i >= 4);
        tn_paint_symbol(paint, &small, 35 + i * 52, 175, 0.3 + i % 4 * QUARTER, i >= 4);
    }
    tn_paint_save(paint);
    tn_paint_translate(paint, 440, 120);
    tn_paint_rotate(paint, QUARTER / 2);
    tn_paint_scale(paint, 1.5);
    tn_paint_symbol(paint, &door, 0, 0, 0, true);
    tn_paint_restore(paint);
}

static void draw_dimensions(tn_paint *paint)
{
    static const tn_dimension all[] = {{{30, 215}, {200, 215}, 12, "5.997m", false, false},
                                       {{200, 215}, {30, 215}, 14, "6 m", false, false},
                                       {{230, 240}, {230, 205}, 15, "350", false, false},
                                       {{260, 205}, {260, 240}, 15, "350", false, false},
                                       {{300, 240}, {400, 205}, -12, "9'-11\"", false, false}};
    tn_paint_layer(paint, TN_LAYER_DIMENSION);
    tn_paint_weight(paint, TN_WEIGHT_HATCH);
    tn_paint_capitals(paint, 1.8 * TN_POINTS_PER_MM, false);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        tn_paint_dimension(paint, &all[i]);
}

static void draw_page(tn_paint *paint)
{
    static const double dash = 3;
    const tn_drawn_view view = {"Ground floor", 5, 5, 460, 245, {10, 240}, 1};
    tn_paint_view_begin(paint, &view);
    draw_hatches(paint);
    draw_symbols(paint);
    draw_dimensions(paint);
    tn_paint_layer(paint, TN_LAYER_OVERHEAD);
    tn_paint_dash(paint, &dash, 1, 0);
    tn_paint_rectangle(paint, 8, 6, 440, 240);
    tn_paint_stroke(paint);
    tn_paint_dash(paint, NULL, 0, 0);
    tn_paint_view_end(paint);
    tn_paint_layer(paint, TN_LAYER_TITLE);
    tn_paint_capitals(paint, 3.5 * TN_POINTS_PER_MM, true);
    tn_paint_text(paint, 20, 275, TN_ALIGN_LEFT, "Ground floor 1:100");
}

int main(int argc, char **argv)
{
    tn_picture picture = {0};
    tn_canvas *canvas = NULL;
    tn_error error = {0};
    if (argc != 2) {
        fputs("usage: drawn_meanings FILE\n", stderr);
        return 2;
    }
    const tn_canvas_options options = {.width = 480, .height = 290, .title = "Meanings", .scale = 100};
    const char *ending = strrchr(argv[1], '.');
    picture.path = argv[1];
    picture.format = ending && strcmp(ending, ".dxf") == 0 ? TN_CANVAS_DXF : TN_CANVAS_BY_PATH;
    tn_status status = tn_canvas_open(&picture, &options, &canvas, &error);
    if (status == TN_OK) {
        draw_page(tn_canvas_paint(canvas));
        status = tn_canvas_commit(canvas, &error);
    }
    tn_canvas_free(canvas);
    if (status != TN_OK)
        fprintf(stderr, "drawn_meanings: %s\n", error.message);
    return status == TN_OK ? 0 : 2;
}
