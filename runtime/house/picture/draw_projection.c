/* Paints one drawing of a house: what is seen in colour, what was cut, hatched, then its lines and its marks. */
#include <math.h>
#include <stdio.h>

#include "runtime/draw/type.h"
#include "runtime/house/picture/draw_parts.h"
#include "runtime/house/picture/draw_symbols.h"

/* Before the drawing's coordinates: u, v in nanometres. */
typedef struct tn_drawing_frame {
    tn_paint *paint;
    double x, y, scale;
    const tn_house_form *form;
} tn_drawing_frame;

static double place_u(const tn_drawing_frame *f, double u)
{
    return f->x + u * f->scale;
}

static double place_v(const tn_drawing_frame *f, double v)
{
    return f->y - v * f->scale;
}

/* ---- what was cut */

#define LAYER_POINTS 0.6 /* thinner layers are not drawn, nor those beside them */

/* least: how thick the thinnest layer is. */
static bool is_drawn(const tn_drawing_frame *f, double least)
{
    return least * f->scale >= LAYER_POINTS;
}

/* Panes and leaves are filled; of the rest, whatever is hatched so but for what is drawn in layers, or (hatch < 0) all.
 */
static bool trace_cuts(const tn_drawing_frame *f, const tn_house_drawn *drawn, bool panes, int hatch)
{
    const tn_house_projection *p = &drawn->projection;
    bool any = false;
    tn_paint_new_path(f->paint);
    for (size_t i = 0; i < p->cut_count; i++) {
        uint32_t group = tn_solid_groups[p->cuts[i].kind];
        if ((group == TN_GROUP_PANE || group == TN_GROUP_LEAF) != panes ||
            (hatch >= 0 && (drawn->hatches[i] != (tn_hatch)hatch || is_drawn(f, drawn->layer_least[i]))))
            continue;
        any = true;
        tn_paint_new_sub_path(f->paint);
        for (int k = 0; k < 4; k++)
            tn_paint_line_to(f->paint, place_u(f, p->cuts[i].at[k][0]), place_v(f, p->cuts[i].at[k][1]));
        tn_paint_close_path(f->paint);
    }
    return any;
}

/* Fills the path with a pattern. */
static void hatch_path(const tn_drawing_frame *f, tn_hatch hatch)
{
    tn_paint_layer(f->paint, TN_LAYER_HATCH);
    tn_paint_weight(f->paint, TN_WEIGHT_HATCH);
    tn_paint_colour(f->paint, 0.2, 0.2, 0.2);
    tn_paint_hatch(f->paint, hatch, 1);
}

static void fill_cuts(const tn_drawing_frame *f, const tn_house_drawn *drawn)
{
    if (tn_paint_covers(f->paint)) {
        trace_cuts(f, drawn, true, -1);
        tn_paint_colour(f->paint, 0.2, 0.35, 0.5);
        tn_paint_fill(f->paint);
        trace_cuts(f, drawn, false, -1);
        tn_paint_colour(f->paint, 0.93, 0.93, 0.93);
        tn_paint_fill(f->paint);
    }
    for (int hatch = 0; hatch < TN_HATCH_COUNT; hatch++)
        if (trace_cuts(f, drawn, false, hatch))
            hatch_path(f, (tn_hatch)hatch);
}

/* ---- layers of what was cut */

static void trace_layer(const tn_drawing_frame *f, const tn_cut_layer *layer)
{
    tn_paint_new_sub_path(f->paint);
    for (int k = 0; k < 4; k++)
        tn_paint_line_to(f->paint, place_u(f, layer->at[k][0]), place_v(f, layer->at[k][1]));
    tn_paint_close_path(f->paint);
}

static void trace_line(const tn_drawing_frame *f, const tn_drawn_line *line)
{
    tn_paint_move_to(f->paint, place_u(f, line->at[0][0]), place_v(f, line->at[0][1]));
    tn_paint_line_to(f->paint, place_u(f, line->at[1][0]), place_v(f, line->at[1][1]));
}

#define BATT_LEAST 3.4 /* points: insulation that is drawn thinner is hatched */
#define BATT_STEP 0.5  /* from one side to the other, in its thickness */

static bool is_batt(const tn_drawing_frame *f, const tn_house_drawn *drawn, const tn_cut_layer *layer)
{
    double thick = (double)tn_form_layer(f->form, layer->layer)->thick * f->scale;
    return drawn->layer_hatches[layer->layer] == TN_HATCH_INSULATION && thick >= BATT_LEAST;
}

/* A zigzag between the long sides of a layer. */
static void trace_batt(const tn_drawing_frame *f, const tn_cut_layer *layer)
{
    double side[2];
    for (int k = 0; k < 2; k++)
        side[k] = hypot(layer->at[k + 1][0] - layer->at[k][0], layer->at[k + 1][1] - layer->at[k][1]);
    int first = side[0] >= side[1] ? 0 : 1; /* the corner at which a long side begins */
    double thick = fmin(side[0], side[1]), length = fmax(side[0], side[1]);
    int steps = thick > 0 ? (int)fmin(length / (thick * BATT_STEP) + 0.5, 10000) : 0;
    const double *a = layer->at[first], *b = layer->at[first + 1], *c = layer->at[(first + 2) % 4],
                 *d = layer->at[(first + 3) % 4];
    for (int i = 0; i <= steps && steps > 0; i++) {
        const double *from = i % 2 ? d : a, *to = i % 2 ? c : b;
        double share = (double)i / steps, u = from[0] + share * (to[0] - from[0]),
               v = from[1] + share * (to[1] - from[1]);
        if (i == 0)
            tn_paint_move_to(f->paint, place_u(f, u), place_v(f, v));
        else
            tn_paint_line_to(f->paint, place_u(f, u), place_v(f, v));
    }
}

/* Insulation, as the zigzag of a batt. */
static void paint_batts(const tn_drawing_frame *f, const tn_house_drawn *drawn)
{
    const tn_house_projection *p = &drawn->projection;
    tn_paint_new_path(f->paint);
    for (size_t i = 0; i < p->layer_count; i++)
        if (is_drawn(f, p->layers[i].least) && is_batt(f, drawn, &p->layers[i]))
            trace_batt(f, &p->layers[i]);
    tn_paint_layer(f->paint, TN_LAYER_HATCH);
    tn_paint_weight(f->paint, TN_WEIGHT_HATCH);
    tn_paint_colour(f->paint, 0.2, 0.2, 0.2);
    tn_paint_stroke(f->paint);
}

/* Of each part the thickest is hatched, and insulation. */
static void hatch_layers(const tn_drawing_frame *f, const tn_house_drawn *drawn, tn_hatch hatch)
{
    const tn_house_projection *p = &drawn->projection;
    tn_paint_new_path(f->paint);
    for (size_t i = 0; i < p->layer_count; i++) {
        const tn_cut_layer *layer = &p->layers[i];
        bool shows = layer->main || hatch == TN_HATCH_INSULATION;
        if (shows && drawn->layer_hatches[layer->layer] == hatch && is_drawn(f, layer->least) &&
            !is_batt(f, drawn, layer))
            trace_layer(f, layer);
    }
    hatch_path(f, hatch);
}

/* Light, in the colours of their materials. */
static void fill_layers(const tn_drawing_frame *f, const tn_house_drawn *drawn)
{
    const tn_house_projection *p = &drawn->projection;
    for (size_t i = 0; i < p->layer_count; i++) {
        const double *colour = drawn->layer_colours[p->layers[i].layer];
        if (!is_drawn(f, p->layers[i].least))
            continue;
        tn_paint_new_path(f->paint);
        trace_layer(f, &p->layers[i]);
        tn_paint_colour(f->paint, colour[0], colour[1], colour[2]);
        tn_paint_fill(f->paint);
    }
}

static void paint_layers(const tn_drawing_frame *f, const tn_house_drawn *drawn)
{
    if (drawn->projection.layer_count == 0)
        return;
    if (tn_paint_covers(f->paint))
        fill_layers(f, drawn);
    for (int hatch = 0; hatch < TN_HATCH_COUNT; hatch++)
        hatch_layers(f, drawn, (tn_hatch)hatch);
    paint_batts(f, drawn);
}

static void paint_joints(const tn_drawing_frame *f, const tn_house_projection *p)
{
    tn_paint_new_path(f->paint);
    for (size_t i = 0; i < p->joint_count; i++)
        if (is_drawn(f, tn_joint_layer(p, &p->joints[i])->least))
            trace_line(f, &p->joints[i]);
    tn_paint_layer(f->paint, TN_LAYER_HATCH);
    tn_paint_colour(f->paint, 0.1, 0.1, 0.1);
    tn_paint_weight(f->paint, TN_WEIGHT_THIN);
    tn_paint_stroke(f->paint);
}

/* ---- edges */

/* The layer of an edge: of what is seen of a part, and of what is cut. */
static const tn_layer edge_layers[TN_GROUP_COUNT][2] = {
    [TN_GROUP_WALL] = {TN_LAYER_WALL, TN_LAYER_WALL_CUT}, [TN_GROUP_FLOOR] = {TN_LAYER_FLOOR, TN_LAYER_FLOOR_CUT},
    [TN_GROUP_ROOF] = {TN_LAYER_ROOF, TN_LAYER_ROOF_CUT}, [TN_GROUP_ITEM] = {TN_LAYER_FURNITURE, TN_LAYER_FURNITURE},
    [TN_GROUP_PANE] = {TN_LAYER_WINDOW, TN_LAYER_WINDOW}, [TN_GROUP_LEAF] = {TN_LAYER_DOOR, TN_LAYER_DOOR},
    [TN_GROUP_GUARD] = {TN_LAYER_GUARD, TN_LAYER_GUARD},  [TN_GROUP_FLIGHT] = {TN_LAYER_STAIR, TN_LAYER_STAIR},
};

static const tn_weight weights[TN_STROKE_WEIGHTS] = {[TN_STROKE_CUT] = TN_WEIGHT_CUT,
                                                     [TN_STROKE_SEEN] = TN_WEIGHT_SEEN,
                                                     [TN_STROKE_THIN] = TN_WEIGHT_THIN,
                                                     [TN_STROKE_HATCH] = TN_WEIGHT_HATCH};

static void paint_lines_of(const tn_drawing_frame *f, const tn_house_projection *p, tn_line_weight weight,
                           uint32_t group, bool cut)
{
    size_t count = 0;
    tn_paint_new_path(f->paint);
    for (size_t i = 0; i < p->line_count; i++) {
        const tn_drawn_line *line = &p->lines[i];
        if (line->weight != weight || line->group % TN_GROUP_COUNT != group || line->cut != cut)
            continue;
        trace_line(f, line);
        count++;
    }
    tn_paint_layer(f->paint, edge_layers[group][cut]);
    if (count)
        tn_paint_stroke(f->paint);
}

/* The lightest first. */
static void paint_lines(const tn_drawing_frame *f, const tn_house_projection *p)
{
    tn_paint_colour(f->paint, 0, 0, 0);
    tn_paint_line_cap(f->paint, TN_CAP_ROUND);
    for (int weight = TN_STROKE_WEIGHTS - 1; weight >= TN_STROKE_CUT; weight--) {
        tn_paint_weight(f->paint, weights[weight]);
        for (uint32_t group = 0; group < TN_GROUP_COUNT; group++)
            for (int cut = 0; cut < 2; cut++)
                paint_lines_of(f, p, (tn_line_weight)weight, group, cut);
    }
    tn_paint_line_cap(f->paint, TN_CAP_BUTT);
}

/* ---- marks */

typedef struct mark_pen {
    tn_layer layer;
    tn_weight weight;
    double grey, dash;
} mark_pen;

static const mark_pen pens[TN_MARK_LAYERS] = {
    [TN_MARK_DOOR] = {TN_LAYER_DOOR, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_STAIR] = {TN_LAYER_STAIR, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_VOID] = {TN_LAYER_OVERHEAD, TN_WEIGHT_THIN, 0.3, 3},
    [TN_MARK_BEAM] = {TN_LAYER_OVERHEAD, TN_WEIGHT_THIN, 0, 3},
    [TN_MARK_GROUND] = {TN_LAYER_GROUND, TN_WEIGHT_CUT, 0, 0},
    [TN_MARK_DIMENSION] = {TN_LAYER_DIMENSION, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_NAME] = {TN_LAYER_ROOM, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_TAG] = {TN_LAYER_SYMBOL, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_SECTION] = {TN_LAYER_SYMBOL, TN_WEIGHT_CUT, 0, 0},
    [TN_MARK_FURNITURE] = {TN_LAYER_FURNITURE, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_WINDOW] = {TN_LAYER_WINDOW, TN_WEIGHT_THIN, 0, 0},
    [TN_MARK_ROOF] = {TN_LAYER_SYMBOL, TN_WEIGHT_THIN, 0, 0},
};

/* A leaf that stands open upwards from its hinge, and the quarter through which it goes, to its right. */
static void draw_leaf(tn_paint *paint, const void *of)
{
    double wide = *(const double *)of;
    tn_paint_layer(paint, TN_LAYER_DOOR);
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_move_to(paint, 0, 0);
    tn_paint_line_to(paint, 0, -wide);
    tn_paint_stroke(paint);
    tn_paint_arc(paint, 0, 0, wide, -M_PI / 2, 0);
    tn_paint_stroke(paint);
}

/* A door's leaf: a symbol by its width in millimetres. */
static void paint_leaf(const tn_drawing_frame *f, const tn_mark *m)
{
    char name[40];
    double du = m->u1 - m->u0, dv = m->v1 - m->v0, length = fabs(du) + fabs(dv), wide = length * f->scale;
    double angle = fabs(dv) > fabs(du) ? (dv > 0 ? 0 : M_PI) : (du > 0 ? M_PI / 2 : -M_PI / 2);
    snprintf(name, sizeof name, "DOOR-%.0f", length / 1e6);
    const tn_drawn_symbol leaf = {name, draw_leaf, &wide};
    tn_paint_symbol(f->paint, &leaf, place_u(f, m->u0), place_v(f, m->v0), angle, !m->right);
}

/* A pane along the x axis: wide, thick. */
static void draw_pane(tn_paint *paint, const void *of)
{
    const double *size = of;
    tn_paint_layer(paint, TN_LAYER_WINDOW);
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_rectangle(paint, -size[0] / 2, -size[1] / 2, size[0], size[1]);
    if (tn_paint_covers(paint)) {
        tn_paint_colour(paint, 0.2, 0.35, 0.5);
        tn_paint_fill_keep(paint);
        tn_paint_colour(paint, 0, 0, 0);
    }
    tn_paint_stroke(paint);
}

/* A symbol by its width and thickness in millimetres. */
static void paint_pane(const tn_drawing_frame *f, const tn_mark *m)
{
    char name[64];
    double du = fabs(m->u1 - m->u0), dv = fabs(m->v1 - m->v0), wide = du + dv;
    const double size[2] = {wide * f->scale, m->high * f->scale};
    snprintf(name, sizeof name, "WINDOW-%.0fx%.0f", wide / 1e6, m->high / 1e6);
    const tn_drawn_symbol pane = {name, draw_pane, size};
    tn_paint_symbol(f->paint, &pane, place_u(f, (m->u0 + m->u1) / 2), place_v(f, (m->v0 + m->v1) / 2),
                    dv > du ? M_PI / 2 : 0, false);
}

static void paint_span(const tn_drawing_frame *f, const tn_mark *m)
{
    const tn_dimension dimension = {.from = {place_u(f, m->u0), place_v(f, m->v0)},
                                    .to = {place_u(f, m->u1), place_v(f, m->v1)},
                                    .text = m->text,
                                    .below = m->below,
                                    .heavy = m->heavy};
    tn_paint_face(f->paint, m->high * f->scale, false);
    tn_paint_dimension(f->paint, &dimension);
}

static void paint_circle(const tn_drawing_frame *f, const tn_mark *m)
{
    tn_paint_new_sub_path(f->paint);
    tn_paint_arc(f->paint, place_u(f, m->u0), place_v(f, m->v0), fabs(m->u1 - m->u0) * f->scale, 0, 2 * M_PI);
    tn_paint_close_path(f->paint);
    if (m->layer == TN_MARK_TAG && tn_paint_covers(f->paint)) {
        tn_paint_colour(f->paint, 1, 1, 1);
        tn_paint_fill_keep(f->paint);
        tn_paint_colour(f->paint, 0, 0, 0);
    }
    tn_paint_stroke(f->paint);
}

#define NORTH_CIRCLE 0.6 /* shares of an arrow to the north with its letter */
#define NORTH_LETTER 0.82
#define NORTH_CAPITAL 0.36

/* In a circle: half of it black. */
static void draw_north(tn_paint *paint, const void *of)
{
    double radius = *(const double *)of;
    tn_paint_layer(paint, TN_LAYER_SYMBOL);
    tn_paint_weight(paint, TN_WEIGHT_THIN);
    tn_paint_arc(paint, 0, 0, radius, 0, 2 * M_PI);
    tn_paint_close_path(paint);
    tn_paint_stroke(paint);
    for (int side = -1; side <= 1; side += 2) {
        tn_paint_move_to(paint, 0, -radius);
        tn_paint_line_to(paint, side * 0.5 * radius, 0.75 * radius);
        tn_paint_line_to(paint, 0, 0.4 * radius);
        tn_paint_close_path(paint);
        if (side < 0)
            tn_paint_fill_keep(paint);
        tn_paint_stroke(paint);
    }
}

static void paint_north(const tn_drawing_frame *f, const tn_mark *m)
{
    double whole = (m->u1 - m->u0) * f->scale, radius = NORTH_CIRCLE * whole, angle = m->high * (M_PI / 180),
           x = place_u(f, m->u0), y = place_v(f, m->v0);
    const tn_drawn_symbol arrow = {"NORTH", draw_north, &radius};
    tn_paint_symbol(f->paint, &arrow, x, y, angle, false);
    tn_paint_save(f->paint);
    tn_paint_translate(f->paint, x, y);
    tn_paint_rotate(f->paint, angle);
    tn_paint_translate(f->paint, 0, -NORTH_LETTER * whole);
    tn_paint_rotate(f->paint, -angle);
    tn_paint_face(f->paint, NORTH_CAPITAL * whole, false);
    tn_type_line(f->paint, 0, 0.35 * NORTH_CAPITAL * whole, TN_ALIGN_CENTRE, "N");
    tn_paint_restore(f->paint);
}

static void paint_text(const tn_drawing_frame *f, const tn_mark *m)
{
    double high = m->high * f->scale, half = tn_mark_width(m->text) * high / 2;
    tn_paint_save(f->paint);
    tn_paint_translate(f->paint, place_u(f, m->u0), place_v(f, m->v0));
    if (m->upright)
        tn_paint_rotate(f->paint, -M_PI / 2);
    bool veiled = m->layer == TN_MARK_NAME || m->layer == TN_MARK_STAIR || m->layer == TN_MARK_ROOF;
    if (veiled && tn_paint_covers(f->paint)) {
        tn_paint_translucent(f->paint, 1, 1, 1, 0.72);
        tn_paint_rectangle(f->paint, -half, -0.6 * high, 2 * half, 1.2 * high);
        tn_paint_fill(f->paint);
    }
    double grey = pens[m->layer].grey;
    tn_paint_colour(f->paint, grey, grey, grey);
    tn_paint_face(f->paint, high, false);
    tn_type_line(f->paint, 0, 0.35 * high, TN_ALIGN_CENTRE, m->text);
    tn_paint_restore(f->paint);
}

static void paint_line(const tn_drawing_frame *f, const tn_mark *m)
{
    tn_paint_move_to(f->paint, place_u(f, m->u0), place_v(f, m->v0));
    tn_paint_line_to(f->paint, place_u(f, m->u1), place_v(f, m->v1));
    tn_paint_stroke(f->paint);
}

/* The ground, and where it is cut the earth below it. */
static void paint_earth(const tn_drawing_frame *f, const tn_mark *m)
{
    double x = place_u(f, m->u0), deep = m->high / 2 * f->scale;
    tn_paint_new_path(f->paint);
    tn_paint_rectangle(f->paint, x, place_v(f, m->v0), place_u(f, m->u1) - x, deep);
    hatch_path(f, TN_HATCH_EARTH);
}

static void paint_shape(const tn_drawing_frame *f, const tn_mark *m)
{
    switch (m->kind) {
    case TN_MARK_TEXT:
        paint_text(f, m);
        break;
    case TN_MARK_LEAF:
        paint_leaf(f, m);
        break;
    case TN_MARK_CIRCLE:
        paint_circle(f, m);
        break;
    case TN_MARK_SPAN:
        paint_span(f, m);
        break;
    case TN_MARK_PANE:
        paint_pane(f, m);
        break;
    case TN_MARK_NORTH:
        paint_north(f, m);
        break;
    case TN_MARK_ITEM:
        tn_paint_layer(f->paint, tn_symbol_is_fixture(m->item.symbol) ? TN_LAYER_FIXTURE : TN_LAYER_FURNITURE);
        tn_draw_symbol(f->paint, f->form, &m->item, place_u(f, m->u0), place_v(f, m->v0), f->scale);
        break;
    default:
        paint_line(f, m);
    }
}

static void paint_mark(const tn_drawing_frame *f, const tn_mark *m)
{
    const mark_pen *pen = &pens[m->layer];
    if (m->layer == TN_MARK_GROUND && m->high > 0)
        paint_earth(f, m);
    tn_paint_layer(f->paint, pen->layer);
    tn_paint_weight(f->paint, pen->weight);
    tn_paint_colour(f->paint, pen->grey, pen->grey, pen->grey);
    tn_paint_dash(f->paint, &pen->dash, pen->dash > 0, 0);
    paint_shape(f, m);
    tn_paint_dash(f->paint, NULL, 0, 0);
}

static tn_drawing_frame frame_of(const tn_canvas *canvas, const tn_house_drawn *drawn, double points_per_nm)
{
    return (tn_drawing_frame){tn_canvas_paint(canvas), drawn->x - drawn->low[0] * points_per_nm,
                              drawn->y + drawn->low[1] * points_per_nm, points_per_nm, drawn->form};
}

void tn_draw_projection(const tn_canvas *canvas, const tn_house_drawn *drawn, double points_per_nm)
{
    tn_paint *paint = tn_canvas_paint(canvas);
    const tn_house_projection *p = &drawn->projection;
    double palette[TN_PALETTE_MAX][3];
    tn_drawing_frame f = frame_of(canvas, drawn, points_per_nm);
    tn_house_palette(drawn->form, p->aspect.kind, palette);
    tn_view_place place = {
        f.x, f.y, f.scale, 0, tn_house_ambient(drawn->form, p->aspect.kind), (const double(*)[3])palette, 0};
    tn_paint_save(paint);
    if (drawn->view && tn_paint_covers(paint))
        tn_view_paint(canvas, drawn->view, &place);
    fill_cuts(&f, drawn);
    paint_layers(&f, drawn);
    paint_joints(&f, p);
    paint_lines(&f, p);
    for (size_t i = 0; i < p->marks.count; i++)
        paint_mark(&f, &p->marks.items[i]);
    tn_paint_restore(paint);
}

/* ---- what is lit up */

#define WALL_LIGHT 4.0 /* points: how broad a wall shines */
#define WALK_WIDTH 1.8

static const double lights[][3] = {
    [TN_LIT_FAULT] = {0.78, 0.20, 0.17}, [TN_LIT_BESIDE] = {0.93, 0.62, 0.58}, [TN_LIT_GOOD] = {0.36, 0.66, 0.38},
    [TN_LIT_THING] = {0.45, 0.45, 0.45}, [TN_LIT_GROUND] = {0.35, 0.60, 0.90}, [TN_LIT_PERSON] = {0.10, 0.25, 0.65},
    [TN_LIT_WALK] = {0.08, 0.20, 0.60}};

/* Where a place in the house is on its plan, which is turned, with the front below. */
static double place_x(const tn_drawing_frame *f, int64_t x)
{
    return place_u(f, -(double)x);
}

static double place_y(const tn_drawing_frame *f, int64_t y)
{
    return place_v(f, -(double)y);
}

static void paint_walk(const tn_drawing_frame *f, const tn_rectangle *line)
{
    const double *c = lights[TN_LIT_WALK];
    tn_paint_move_to(f->paint, place_x(f, line->x0), place_y(f, line->y0));
    tn_paint_line_to(f->paint, place_x(f, line->x1), place_y(f, line->y1));
    tn_paint_colour(f->paint, c[0], c[1], c[2]);
    tn_paint_line_width(f->paint, WALK_WIDTH);
    tn_paint_line_cap(f->paint, TN_CAP_ROUND);
    tn_paint_stroke(f->paint);
    tn_paint_line_cap(f->paint, TN_CAP_BUTT);
}

/* A space shines through, with a clear edge inside its own; a wall is a broad line. */
static void paint_lit(const tn_drawing_frame *f, const tn_lit *lit)
{
    const double *c = lights[lit->tone];
    double x0 = place_x(f, lit->at.x1), x1 = place_x(f, lit->at.x0), y0 = place_y(f, lit->at.y0),
           y1 = place_y(f, lit->at.y1);
    if (lit->at.x0 == lit->at.x1 || lit->at.y0 == lit->at.y1) {
        tn_paint_move_to(f->paint, x0, y0);
        tn_paint_line_to(f->paint, x1, y1);
        tn_paint_translucent(f->paint, c[0], c[1], c[2], 0.75);
        tn_paint_line_width(f->paint, WALL_LIGHT);
        tn_paint_stroke(f->paint);
        return;
    }
    tn_paint_rectangle(f->paint, x0, y0, x1 - x0, y1 - y0);
    tn_paint_translucent(f->paint, c[0], c[1], c[2], lit->tone == TN_LIT_BESIDE ? 0.25 : 0.35);
    tn_paint_fill(f->paint);
    if (lit->tone == TN_LIT_GROUND)
        return; /* made of pieces */
    tn_paint_rectangle(f->paint, x0 + 1, y0 + 1, fmax(x1 - x0 - 2, 0), fmax(y1 - y0 - 2, 0));
    tn_paint_colour(f->paint, c[0], c[1], c[2]);
    tn_paint_line_width(f->paint, 1.5);
    tn_paint_stroke(f->paint);
}

static int pass_of(tn_lit_tone tone)
{
    return tone == TN_LIT_PERSON || tone == TN_LIT_WALK ? 2 : tone == TN_LIT_FAULT ? 1 : 0;
}

void tn_draw_lits(const tn_canvas *canvas, const tn_house_drawn *drawn, double points_per_nm, const tn_lit *lits,
                  size_t count)
{
    tn_drawing_frame f = frame_of(canvas, drawn, points_per_nm);
    uint32_t storey = drawn->projection.aspect.storey;
    for (int pass = 0; pass < 3; pass++) /* what is at fault comes last but for the person */
        for (size_t i = 0; i < count; i++)
            if (lits[i].storey == storey && pass_of(lits[i].tone) == pass) {
                if (lits[i].tone == TN_LIT_WALK)
                    paint_walk(&f, &lits[i].at);
                else
                    paint_lit(&f, &lits[i]);
            }
    tn_paint_colour(f.paint, 0, 0, 0);
}
