/* Draws the title block of a sheet: what is drawn, for which project, when, in which state, and to which scale. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/house/picture/draw_parts.h"

#define PADDING 12.0
#define NAME_ROW 24.0
#define LINE_ROW 18.0
#define SCALE_ROW 34.0
#define LEADING 15.0
#define BAR_HEIGHT 4.0
#define BAR_LEADING 13.0
#define BAR_STEPS 4
#define BAR_MOST 200.0 /* longer ones are of half as many metres or feet */

void tn_scale_bar_paint(const tn_title_block *block, tn_paint *paint, double right, double y)
{
    char text[64];
    int64_t unit = block->metric ? INT64_C(1000000000) : TN_FOOT_NM * 4;
    while (BAR_STEPS * (double)unit * block->points > BAR_MOST)
        unit /= 2;
    double step = (double)unit * block->points, x = right - BAR_STEPS * step;
    tn_scale_write(block->scale, block->metric, text, sizeof text);
    tn_paint_face(paint, TN_LETTERING, false);
    tn_paint_colour(paint, 0, 0, 0);
    tn_type_line(paint, x - 8, y + BAR_HEIGHT, TN_ALIGN_RIGHT, text);
    tn_paint_weight(paint, TN_WEIGHT_HATCH);
    for (int i = 0; i <= BAR_STEPS; i++) {
        tn_length_write_style(unit * i, block->style, text, sizeof text);
        if (i % 2 == 0)
            tn_type_line(paint, x + step * i, y + BAR_HEIGHT + BAR_LEADING, TN_ALIGN_CENTRE, text);
        if (i == BAR_STEPS)
            break;
        tn_paint_rectangle(paint, x + step * i, y, step, BAR_HEIGHT);
        if (i % 2 == 0)
            tn_paint_fill_keep(paint);
        tn_paint_stroke(paint);
    }
}

static bool is_said(const char *text)
{
    return text && text[0];
}

static bool is_dated(const tn_title_block *block)
{
    return is_said(block->says->date) || is_said(block->says->revision);
}

double tn_title_block_height(const tn_title_block *block)
{
    double rows = NAME_ROW + 2 * LEADING + 4 + SCALE_ROW;
    rows += is_said(block->says->project) ? LINE_ROW : 0;
    rows += is_dated(block) ? LINE_ROW : 0;
    return rows;
}

void tn_drawing_says_write(const tn_drawing_says *says, char *text, size_t size)
{
    const char *const parts[3] = {says->project, says->date, says->revision};
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < 3; i++)
        if (is_said(parts[i]) && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s%s", used ? ", " : "", i == 2 ? "revision " : "",
                                     parts[i]);
}

/* What the house is called, smaller if it is long. */
static void paint_name(tn_paint *paint, double x, double baseline, double room, const char *name)
{
    tn_paint_face(paint, TN_NAME_LETTERING, true);
    double across = tn_type_width(paint, name);
    if (across > room)
        tn_paint_face(paint, fmax(0.999 * TN_NAME_LETTERING * room / across, TN_LETTERING), true);
    tn_type_fit(paint, x, baseline, TN_ALIGN_LEFT, room, name);
}

static void paint_rule(tn_paint *paint, double x, double y)
{
    tn_paint_move_to(paint, x, y);
    tn_paint_line_to(paint, x + TN_BLOCK_WIDTH, y);
    tn_paint_stroke(paint);
}

/* The date at the left, the revision at the right. */
static void paint_state(const tn_title_block *block, tn_paint *paint, double x, double y)
{
    char text[80];
    double half = TN_BLOCK_WIDTH / 2, room = half - 2 * PADDING;
    tn_paint_move_to(paint, x + half, y);
    tn_paint_line_to(paint, x + half, y + LINE_ROW);
    tn_paint_stroke(paint);
    if (is_said(block->says->date)) {
        snprintf(text, sizeof text, "date %s", block->says->date);
        tn_type_fit(paint, x + PADDING, y + 13, TN_ALIGN_LEFT, room, text);
    }
    if (is_said(block->says->revision)) {
        snprintf(text, sizeof text, "revision %s", block->says->revision);
        tn_type_fit(paint, x + half + PADDING, y + 13, TN_ALIGN_LEFT, room, text);
    }
}

void tn_title_block_paint(const tn_title_block *block, tn_paint *paint, double x, double y)
{
    double room = TN_BLOCK_WIDTH - 2 * PADDING;
    tn_paint_layer(paint, TN_LAYER_TITLE);
    tn_paint_colour(paint, 0, 0, 0);
    tn_paint_weight(paint, TN_WEIGHT_CUT);
    tn_paint_new_path(paint);
    tn_paint_rectangle(paint, x, y, TN_BLOCK_WIDTH, tn_title_block_height(block));
    tn_paint_stroke(paint);
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    if (is_said(block->says->project)) {
        tn_paint_face(paint, TN_LETTERING, false);
        tn_type_fit(paint, x + PADDING, y + 13, TN_ALIGN_LEFT, room, block->says->project);
        y += LINE_ROW;
        paint_rule(paint, x, y);
    }
    if (is_said(block->title))
        paint_name(paint, x + PADDING, y + 17, room, block->title);
    y += NAME_ROW;
    paint_rule(paint, x, y);
    tn_paint_face(paint, TN_LETTERING, false);
    tn_type_fit(paint, x + PADDING, y + 13, TN_ALIGN_LEFT, room, block->kinds);
    tn_type_fit(paint, x + PADDING, y + 13 + LEADING, TN_ALIGN_LEFT, room, block->measures);
    y += 2 * LEADING + 4;
    paint_rule(paint, x, y);
    if (is_dated(block)) {
        paint_state(block, paint, x, y);
        y += LINE_ROW;
        paint_rule(paint, x, y);
    }
    tn_scale_bar_paint(block, paint, x + TN_BLOCK_WIDTH - 2 * PADDING, y + 8);
}
