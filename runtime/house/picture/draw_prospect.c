/* Paints one drawing of a house: what is seen, then what was cut, hatched, then its marks. */
#include <math.h>

#include "runtime/draw/type.h"
#include "runtime/house/picture/draw_parts.h"

/* Before the drawing's coordinates: u, v in nanometres. */
typedef struct tn_drawing_frame {
    cairo_t *cr;
    double x, y, scale;
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

static void trace_cuts(const tn_drawing_frame *f, const tn_prospect *p, bool panes)
{
    cairo_new_path(f->cr);
    for (size_t i = 0; i < p->cut_count; i++) {
        uint32_t group = tn_solid_groups[p->cuts[i].kind];
        if ((group == TN_GROUP_PANE || group == TN_GROUP_LEAF) != panes)
            continue;
        cairo_new_sub_path(f->cr);
        for (int k = 0; k < 4; k++)
            cairo_line_to(f->cr, place_u(f, p->cuts[i].at[k][0]), place_v(f, p->cuts[i].at[k][1]));
        cairo_close_path(f->cr);
    }
}

static void hatch(const tn_drawing_frame *f, const tn_prospect *p)
{
    double x0 = place_u(f, p->low[0]), x1 = place_u(f, p->high[0]), y0 = place_v(f, p->high[1]),
           y1 = place_v(f, p->low[1]);
    cairo_save(f->cr);
    cairo_clip(f->cr);
    cairo_set_line_width(f->cr, 0.35);
    for (double x = x0 - (y1 - y0); x < x1; x += 2.2) {
        cairo_move_to(f->cr, x, y1);
        cairo_line_to(f->cr, x + (y1 - y0), y0);
    }
    cairo_set_source_rgb(f->cr, 0.25, 0.25, 0.28);
    cairo_stroke(f->cr);
    cairo_restore(f->cr);
}

/* Lines around the parts that hang together: the inner half of each line is painted over. */
static void paint_cuts(const tn_drawing_frame *f, const tn_prospect *p)
{
    trace_cuts(f, p, true);
    cairo_set_source_rgb(f->cr, 0.2, 0.35, 0.5);
    cairo_fill(f->cr);
    trace_cuts(f, p, false);
    cairo_set_line_join(f->cr, CAIRO_LINE_JOIN_MITER);
    cairo_set_source_rgb(f->cr, 0, 0, 0);
    cairo_set_line_width(f->cr, 1.5);
    cairo_stroke_preserve(f->cr);
    cairo_set_source_rgb(f->cr, 0.86, 0.86, 0.87);
    cairo_fill_preserve(f->cr);
    hatch(f, p);
}

/* ---- marks */

typedef struct tn_pen {
    double width, grey, dash;
} tn_pen;

static const tn_pen pens[TN_MARK_LAYERS] = {
    [TN_MARK_DOOR] = {0.6, 0, 0},   [TN_MARK_STAIR] = {0.4, 0.2, 0},      [TN_MARK_VOID] = {0.4, 0.3, 3},
    [TN_MARK_GROUND] = {1.4, 0, 0}, [TN_MARK_DIMENSION] = {0.35, 0.3, 0}, [TN_MARK_NAME] = {0.4, 0, 0},
};

static void paint_arc(const tn_drawing_frame *f, const tn_mark *m)
{
    double x = place_u(f, m->u0), y = place_v(f, m->v0), dx = place_u(f, m->u1) - x, dy = place_v(f, m->v1) - y;
    double from = fabs(dx) > fabs(dy) ? (dx > 0 ? 0 : M_PI) : (dy > 0 ? M_PI / 2 : -M_PI / 2);
    cairo_new_sub_path(f->cr);
    cairo_arc_negative(f->cr, x, y, fabs(dx) + fabs(dy), from, from - M_PI / 2); /* y goes down here */
    cairo_stroke(f->cr);
}

static void paint_text(const tn_drawing_frame *f, const tn_mark *m)
{
    double high = m->high * f->scale, half = tn_mark_width(m->text) * high / 2;
    cairo_save(f->cr);
    cairo_translate(f->cr, place_u(f, m->u0), place_v(f, m->v0));
    if (m->upright)
        cairo_rotate(f->cr, -M_PI / 2);
    if (m->layer == TN_MARK_NAME) {
        cairo_set_source_rgba(f->cr, 1, 1, 1, 0.72);
        cairo_rectangle(f->cr, -half, -0.6 * high, 2 * half, 1.2 * high);
        cairo_fill(f->cr);
    }
    double grey = pens[m->layer].grey;
    cairo_set_source_rgb(f->cr, grey, grey, grey);
    tn_type_face(f->cr, high, false);
    tn_type_line(f->cr, 0, 0.35 * high, TN_ALIGN_CENTRE, m->text);
    cairo_restore(f->cr);
}

static void paint_line(const tn_drawing_frame *f, const tn_mark *m)
{
    cairo_move_to(f->cr, place_u(f, m->u0), place_v(f, m->v0));
    cairo_line_to(f->cr, place_u(f, m->u1), place_v(f, m->v1));
    cairo_stroke(f->cr);
}

static void paint_mark(const tn_drawing_frame *f, const tn_mark *m)
{
    const tn_pen *pen = &pens[m->layer];
    if (m->kind == TN_MARK_TEXT) {
        paint_text(f, m);
        return;
    }
    cairo_set_source_rgb(f->cr, pen->grey, pen->grey, pen->grey);
    cairo_set_line_width(f->cr, pen->width);
    cairo_set_dash(f->cr, &pen->dash, pen->dash > 0, 0);
    if (m->kind == TN_MARK_ARC)
        paint_arc(f, m);
    else
        paint_line(f, m);
    cairo_set_dash(f->cr, NULL, 0, 0);
}

void tn_draw_prospect(const tn_canvas *canvas, const tn_house_drawn *drawn, double points_per_nm)
{
    const tn_prospect *p = &drawn->prospect;
    double palette[TN_PALETTE_MAX][3];
    tn_drawing_frame f = {tn_canvas_context(canvas), drawn->x - drawn->low[0] * points_per_nm,
                          drawn->y + drawn->low[1] * points_per_nm, points_per_nm};
    tn_house_palette(drawn->form, p->aspect.kind, palette);
    tn_view_place place = {
        f.x, f.y, f.scale, 0.35, tn_house_ambient(drawn->form, p->aspect.kind), (const double(*)[3])palette, 0};
    tn_view_paint(canvas, drawn->view, &place);
    if (p->aspect.kind != TN_ASPECT_AXONOMETRIC)
        paint_cuts(&f, p);
    for (size_t i = 0; i < p->marks.count; i++)
        paint_mark(&f, &p->marks.items[i]);
}
