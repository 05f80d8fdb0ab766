/* Draws what stands in rooms as symbols: from the middle of its back, which is above, in shares of its width and depth.
 */
#include "runtime/house/picture/draw_symbols.h"

#include <math.h>
#include <stdio.h>

#define WHOLE 6.283185307179586
#define DOUBLE_BED_NM 1.2e9 /* wider ones have two pillows */
#define CHAIR_NM 4.5e8

/* wide, deep: in points. */
typedef struct tn_item_pen {
    tn_paint *paint;
    const tn_house_form *form;
    const tn_marked_item *item;
    double wide, deep, points;
} tn_item_pen;

static void line(const tn_item_pen *p, double x0, double y0, double x1, double y1)
{
    tn_paint_move_to(p->paint, x0 * p->wide, y0 * p->deep);
    tn_paint_line_to(p->paint, x1 * p->wide, y1 * p->deep);
}

static void box(const tn_item_pen *p, double x0, double y0, double x1, double y1)
{
    tn_paint_rectangle(p->paint, x0 * p->wide, y0 * p->deep, (x1 - x0) * p->wide, (y1 - y0) * p->deep);
}

/* radius: of the smaller side. */
static void circle(const tn_item_pen *p, double x, double y, double radius)
{
    tn_paint_new_sub_path(p->paint);
    tn_paint_arc(p->paint, x * p->wide, y * p->deep, radius * fmin(p->wide, p->deep), 0, WHOLE);
    tn_paint_close_path(p->paint);
}

/* A box with ends that are round: half circles, or quarters where it is nearly square. */
static void basin(const tn_item_pen *p, double x0, double y0, double x1, double y1)
{
    double left = x0 * p->wide, right = x1 * p->wide, top = y0 * p->deep, bottom = y1 * p->deep,
           radius = fmin(right - left, bottom - top) * 0.4;
    tn_paint_new_sub_path(p->paint);
    tn_paint_arc(p->paint, left + radius, top + radius, radius, WHOLE / 2, 0.75 * WHOLE);
    tn_paint_arc(p->paint, right - radius, top + radius, radius, 0.75 * WHOLE, WHOLE);
    tn_paint_arc(p->paint, right - radius, bottom - radius, radius, 0, WHOLE / 4);
    tn_paint_arc(p->paint, left + radius, bottom - radius, radius, WHOLE / 4, WHOLE / 2);
    tn_paint_close_path(p->paint);
}

/* ---- what is fixed */

static void draw_wc(const tn_item_pen *p)
{
    box(p, 0.05, 0, 0.95, 0.28);
    basin(p, 0.12, 0.28, 0.88, 1);
    basin(p, 0.24, 0.4, 0.76, 0.92);
}

static void draw_basin(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    basin(p, 0.12, 0.22, 0.88, 0.9);
    circle(p, 0.5, 0.11, 0.05);
}

static void draw_bath(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    basin(p, 0.08, 0.05, 0.92, 0.96);
    circle(p, 0.5, 0.13, 0.05);
}

static void draw_shower(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 0, 1, 1);
    line(p, 1, 0, 0, 1);
    circle(p, 0.5, 0.5, 0.06);
}

static void draw_hob(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    for (int i = 0; i < 4; i++)
        circle(p, i % 2 ? 0.74 : 0.26, i < 2 ? 0.28 : 0.72, 0.16);
}

static void draw_sink(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    basin(p, 0.07, 0.22, 0.5, 0.88);
    circle(p, 0.28, 0.12, 0.05);
    for (int i = 0; i < 4; i++)
        line(p, 0.6, 0.28 + 0.16 * i, 0.92, 0.28 + 0.16 * i);
}

/* So far from the left end of a counter, in nanometres. */
static double along(const tn_item_pen *p, double nanometres)
{
    return nanometres / p->item->wide;
}

#define BOWL_NM 4e8
#define HOB_NM 5.6e8
#define SINK_LEAST_NM 1.0e9 /* shorter counters have no sink */
#define HOB_LEAST_NM 1.8e9  /* shorter ones no hob */

/* With a sink and, as far as it is long enough, a hob, and a line where the wall's tiles stand on it. */
static void draw_counter(const tn_item_pen *p)
{
    double wide = p->item->wide, sink = wide * 0.3, hob = wide * 0.75;
    box(p, 0, 0, 1, 1);
    line(p, 0, 0.05, 1, 0.05);
    if (wide < SINK_LEAST_NM)
        return;
    sink = wide < HOB_LEAST_NM ? wide / 2 : sink;
    basin(p, along(p, sink - BOWL_NM), 0.25, along(p, sink), 0.85);
    circle(p, along(p, sink - BOWL_NM / 2), 0.15, 0.04);
    for (int i = 0; i < 4; i++)
        line(p, along(p, sink + 0.15 * BOWL_NM), 0.31 + 0.16 * i, along(p, sink + BOWL_NM), 0.31 + 0.16 * i);
    for (int i = 0; wide >= HOB_LEAST_NM && i < 4; i++)
        circle(p, along(p, hob + (i % 2 ? HOB_NM / 4 : -HOB_NM / 4)), i < 2 ? 0.32 : 0.74, 0.15);
}

/* Three streams of warm air in its drum. */
static void draw_dryer(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 0.15, 1, 0.15);
    circle(p, 0.5, 0.58, 0.3);
    for (int i = -1; i <= 1; i++)
        line(p, 0.5 + 0.12 * i, 0.44, 0.5 + 0.12 * i, 0.72);
}

static void draw_fridge(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 0.88, 1, 0.88);
    line(p, 0, 0, 1, 0.88);
    line(p, 1, 0, 0, 0.88);
}

static void draw_washer(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 0.15, 1, 0.15);
    circle(p, 0.5, 0.58, 0.3);
    circle(p, 0.5, 0.58, 0.2);
}

static void draw_stove(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    box(p, 0.1, 0.1, 0.9, 0.8);
    circle(p, 0.5, 0.25, 0.1);
    line(p, 0.25, 1, 0.25, 0.8);
    line(p, 0.75, 1, 0.75, 0.8);
}

/* ---- furniture */

static void draw_bed(const tn_item_pen *p)
{
    bool twin = p->item->wide >= DOUBLE_BED_NM;
    box(p, 0, 0, 1, 1);
    for (int i = 0; i < 1 + twin; i++)
        basin(p, twin ? 0.06 + 0.48 * i : 0.12, 0.03, twin ? 0.46 + 0.48 * i : 0.88, 0.2);
    line(p, 0, 0.27, 1, 0.27);
    line(p, 0.6, 0.27, 1, 0.45);
}

/* A chair beside a table, half of it below that: at a share along a side, as far out as a chair is deep. */
static void draw_chair_at(const tn_item_pen *p, double x, double y, double out_x, double out_y)
{
    double half = CHAIR_NM * p->points / 2, middle_x = x * p->wide + out_x * half * 0.9,
           middle_y = y * p->deep + out_y * half * 0.9, along_x = fabs(out_y) * half, along_y = fabs(out_x) * half;
    tn_paint_move_to(p->paint, x * p->wide - along_x * 0.9, y * p->deep - along_y * 0.9);
    tn_paint_line_to(p->paint, middle_x - along_x * 0.9, middle_y - along_y * 0.9);
    tn_paint_line_to(p->paint, middle_x + along_x * 0.9, middle_y + along_y * 0.9);
    tn_paint_line_to(p->paint, x * p->wide + along_x * 0.9, y * p->deep + along_y * 0.9);
}

/* As many as have room, at the sides at which a chair can stand. */
static void draw_chairs(const tn_item_pen *p, uint32_t sides)
{
    static const double ends[4][4] = {{0, 0, 0, -1}, {0, 1, 0, 1}, {0, 0, -1, 0}, {1, 0, 1, 0}};
    for (int side = 0; side < 4; side++) {
        double length = side < 2 ? p->item->wide : p->item->deep;
        int count = (int)(length / (1.2 * CHAIR_NM));
        for (int i = 0; (sides >> side & 1) && i < count; i++) {
            double share = (i + 0.5) / count;
            draw_chair_at(p, side < 2 ? share : ends[side][0], side < 2 ? ends[side][1] : share, ends[side][2],
                          ends[side][3]);
        }
    }
}

static void draw_table(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    draw_chairs(p, p->item->free_sides);
}

static void draw_desk(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    if (p->item->free_sides & 2)
        draw_chair_at(p, 0.5, 1, 0, 1);
}

static void draw_chair(const tn_item_pen *p)
{
    basin(p, 0, 0, 1, 1);
    line(p, 0.12, 0.22, 0.88, 0.22);
}

static void draw_sofa(const tn_item_pen *p)
{
    int seats = p->item->wide > 1.7e9 ? 3 : p->item->wide > 1.2e9 ? 2 : 1;
    double arm = fmin(0.15 * p->deep / p->wide, 0.2);
    box(p, 0, 0, 1, 1);
    line(p, arm, 0.25, 1 - arm, 0.25);
    line(p, arm, 0.25, arm, 1);
    line(p, 1 - arm, 0.25, 1 - arm, 1);
    for (int i = 1; i < seats; i++)
        line(p, arm + (1 - 2 * arm) * i / seats, 0.25, arm + (1 - 2 * arm) * i / seats, 1);
}

/* With the rod, and hangers on it. */
static void draw_wardrobe(const tn_item_pen *p)
{
    int hangers = (int)fmin(fmax(p->item->wide / 1.2e8, 3), 40);
    box(p, 0, 0, 1, 1);
    line(p, 0, 0.5, 1, 0.5);
    for (int i = 1; i < hangers; i++)
        line(p, (double)i / hangers - 0.01, 0.15, (double)i / hangers + 0.01, 0.85);
}

/* Upright, with its keys in front. */
static void draw_piano(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 0.6, 1, 0.6);
    for (int i = 1; i < 16; i++)
        line(p, i / 16.0, 0.75, i / 16.0, 1);
    line(p, 0, 0.75, 1, 0.75);
}

/* Of three boards. */
static void draw_bench(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 1 / 3.0, 1, 1 / 3.0);
    line(p, 0, 2 / 3.0, 1, 2 / 3.0);
}

static void draw_shelf(const tn_item_pen *p)
{
    box(p, 0, 0, 1, 1);
    line(p, 0, 0, 1, 1);
}

/* ---- drawn by a form */

static double place(int64_t length, bool far, double size, double points)
{
    return far ? (size - (double)length) * points : (double)length * points;
}

static void draw_lines(const tn_item_pen *p)
{
    const tn_tile_box_record *record = &p->form->module->TILE_BOX_records[p->item->box];
    for (uint32_t i = 0; i < record->line_count; i++) {
        const tn_symbol_line_record *l = &p->form->module->SYMBOL_LINE_records[record->line_first + i];
        double wide = p->item->wide, deep = p->item->deep;
        tn_paint_move_to(p->paint, place(l->x0, l->sides & TN_LINE_X0_RIGHT, wide, p->points),
                         place(l->y0, l->sides & TN_LINE_Y0_FRONT, deep, p->points));
        tn_paint_line_to(p->paint, place(l->x1, l->sides & TN_LINE_X1_RIGHT, wide, p->points),
                         place(l->y1, l->sides & TN_LINE_Y1_FRONT, deep, p->points));
    }
}

static void draw_box(const tn_item_pen *p)
{
    if (p->form->module->TILE_BOX_records[p->item->box].line_count > 0)
        draw_lines(p);
    else
        box(p, 0, 0, 1, 1);
}

static const struct {
    void (*draw)(const tn_item_pen *pen);
    bool fixture;
} symbols[TN_SYMBOL_COUNT] = {
    [TN_SYMBOL_NONE] = {draw_box, false},          [TN_SYMBOL_WC] = {draw_wc, true},
    [TN_SYMBOL_BASIN] = {draw_basin, true},        [TN_SYMBOL_BATH] = {draw_bath, true},
    [TN_SYMBOL_SHOWER] = {draw_shower, true},      [TN_SYMBOL_HOB] = {draw_hob, true},
    [TN_SYMBOL_SINK] = {draw_sink, true},          [TN_SYMBOL_FRIDGE] = {draw_fridge, true},
    [TN_SYMBOL_WASHER] = {draw_washer, true},      [TN_SYMBOL_BED] = {draw_bed, false},
    [TN_SYMBOL_TABLE] = {draw_table, false},       [TN_SYMBOL_CHAIR] = {draw_chair, false},
    [TN_SYMBOL_SOFA] = {draw_sofa, false},         [TN_SYMBOL_DESK] = {draw_desk, false},
    [TN_SYMBOL_WARDROBE] = {draw_wardrobe, false}, [TN_SYMBOL_PIANO] = {draw_piano, false},
    [TN_SYMBOL_STOVE] = {draw_stove, true},        [TN_SYMBOL_SHELF] = {draw_shelf, false},
    [TN_SYMBOL_COUNTER] = {draw_counter, true},    [TN_SYMBOL_DRYER] = {draw_dryer, true},
    [TN_SYMBOL_BENCH] = {draw_bench, false},
};

bool tn_symbol_is_fixture(tn_item_symbol symbol)
{
    return symbols[symbol].fixture;
}

static void draw(tn_paint *paint, const void *of)
{
    tn_item_pen pen = *(const tn_item_pen *)of;
    pen.paint = paint;
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_new_path(paint);
    symbols[pen.item->symbol].draw(&pen);
    tn_paint_stroke(paint);
}

void tn_draw_symbol(tn_paint *paint, const tn_house_form *form, const tn_marked_item *item, double x, double y,
                    double points)
{
    char name[96], word[24];
    const tn_item_pen pen = {paint, form, item, item->wide * points, item->deep * points, points};
    size_t used = 0;
    for (const char *c = tn_names_SYMBOL[item->symbol]; *c && used + 1 < sizeof word; c++)
        word[used++] = (char)(*c - 'a' + 'A');
    word[used] = '\0';
    if (item->symbol == TN_SYMBOL_NONE)
        snprintf(name, sizeof name, "ITEM%u-%.0fx%.0f", (unsigned)item->box, item->wide / 1e6, item->deep / 1e6);
    else
        snprintf(name, sizeof name, "%s-%.0fx%.0f-%u", word, item->wide / 1e6, item->deep / 1e6,
                 (unsigned)item->free_sides);
    tn_paint_symbol(paint, &(tn_drawn_symbol){name, draw, &pen}, x, y, item->quarter * WHOLE / 4, item->mirrored);
}
