/* Draws why a house is as it is: reasons, one below another, each with the plans of the storeys in which it lights
 * something up. */
#include <math.h>
#include <stdlib.h>

#include "runtime/draw/scales.h"
#include "runtime/draw/type.h"
#include "runtime/house/picture/draw_parts.h"

#define MARGIN 28.0
#define TITLE_SIZE 12.0
#define HEADING_SIZE 8.5
#define TEXT_SIZE 7.0
#define LEADING 10.0
#define LINES_MAX 12u /* of one line of a reason: longer ones end with an ellipsis */
#define GAP 16.0
#define CAPTION 14.0
#define PLAN_WIDTH 380.0 /* the most that a plan takes, in points, at a usual scale */
#define PLAN_HEIGHT 300.0
#define PAGE_WIDTH 800.0 /* that plans fill beside each other */
#define TEXT_WIDTH 440.0 /* at least, for what is said */
#define SIGN 6.0

typedef struct lit_page {
    const tn_lit_house *what;
    tn_house_drawn *plans; /* of the storeys that the house has; owned */
    size_t count;
    bool metric;
    double points;   /* a nanometre, in points */
    double room;     /* between the margins */
    tn_paint *paint; /* without a device while the page is measured */
    const tn_canvas *canvas;
    double y; /* so far down */
} lit_page;

/* ---- plans */

static double wide(const lit_page *p, const tn_house_drawn *d)
{
    return (d->high[0] - d->low[0]) * p->points;
}

static double high(const lit_page *p, const tn_house_drawn *d)
{
    return (d->high[1] - d->low[1]) * p->points;
}

static tn_status take_plans(lit_page *p, tn_watch *watch, tn_error *error)
{
    const tn_house *house = p->what->house;
    tn_status status = TN_OK;
    for (uint32_t s = 0; status == TN_OK && s < house->form->record->storey_count; s++) {
        const tn_aspect aspect = {.kind = TN_ASPECT_PLAN, .storey = s};
        if (tn_house_has_storey(house, s))
            status = tn_house_view_take(p->what->solids, &aspect, house, &p->plans[p->count++], watch, error);
    }
    return status;
}

/* The largest usual scale at which each plan has room, or else the smallest of them. */
static tn_status choose_scale(lit_page *p, tn_error *error)
{
    const uint32_t *scales;
    size_t count = tn_scale_choices(p->metric, &scales);
    tn_mark_style style = {.us = !p->metric,
                           .millimetres = tn_house_length_style(p->what->house) == TN_STYLE_MILLIMETRES};
    tn_status status = TN_OK;
    bool fits = false;
    for (size_t i = 0; status == TN_OK && !fits && i < count; i++) {
        p->points = TN_POINTS_PER_NM / scales[i];
        fits = true;
        for (size_t k = 0; status == TN_OK && k < p->count; k++) {
            tn_house_drawn *d = &p->plans[k];
            style.lettering = TN_LETTERING / p->points;
            status = tn_house_projection_mark(p->what->house, &style, &d->projection, error);
            tn_house_projection_extent(&d->projection, d->low, d->high);
            fits &= wide(p, d) <= PLAN_WIDTH && high(p, d) <= PLAN_HEIGHT;
        }
    }
    return status;
}

/* Two plans beside each other, as far as they fit; more room if one alone is wider. */
static void choose_width(lit_page *p)
{
    double all = 0, most = 0;
    for (size_t i = 0; i < p->count; i++) {
        all += wide(p, &p->plans[i]) + (i ? GAP : 0);
        most = fmax(most, wide(p, &p->plans[i]));
    }
    p->room = fmax(fmax(most, fmin(all, PAGE_WIDTH)), TEXT_WIDTH);
}

static bool is_lit(const tn_house_drawn *d, const tn_lit_reason *reason)
{
    for (size_t i = 0; i < reason->lit_count; i++)
        if (reason->lits[i].storey == d->projection.aspect.storey)
            return true;
    return false;
}

static void set_plan(lit_page *p, tn_house_drawn *d, const tn_lit_reason *reason, double x, double bottom)
{
    d->x = x;
    d->y = bottom;
    if (!p->canvas || tn_canvas_stopped(p->canvas))
        return;
    tn_draw_projection(p->canvas, d, p->points);
    if (reason)
        tn_draw_lits(p->canvas, d, p->points, reason->lits, reason->lit_count);
    tn_paint_colour(p->paint, 0, 0, 0);
    tn_paint_face(p->paint, TEXT_SIZE, true);
    tn_type_fit(p->paint, x + wide(p, d) / 2, bottom + CAPTION - 4, TN_ALIGN_CENTRE, wide(p, d), d->projection.title);
}

/* The plans of a row that begins with one, and the next row's first. */
static size_t set_row(lit_page *p, size_t first, const tn_lit_reason *reason)
{
    double x = MARGIN, down = 0;
    size_t end = first;
    for (; end < p->count; end++) {
        tn_house_drawn *d = &p->plans[end];
        if (reason && !is_lit(d, reason))
            continue;
        if (x > MARGIN && x + wide(p, d) > MARGIN + p->room + 0.01)
            break;
        x += wide(p, d) + GAP;
        down = fmax(down, high(p, d));
    }
    x = MARGIN;
    for (size_t i = first; i < end; i++) {
        tn_house_drawn *d = &p->plans[i];
        if (reason && !is_lit(d, reason))
            continue;
        set_plan(p, d, reason, x, p->y + down);
        x += wide(p, d) + GAP;
    }
    p->y += down > 0 ? down + CAPTION + GAP : 0;
    return end;
}

/* reason: only storeys in which it lights something up; NULL: all. */
static void set_plans(lit_page *p, const tn_lit_reason *reason)
{
    for (size_t i = 0; i < p->count;)
        i = set_row(p, i, reason);
}

/* ---- lettering */

static void set_text(lit_page *p, double x, double size, bool bold, const char *text)
{
    tn_paint_face(p->paint, size, bold);
    tn_paint_colour(p->paint, 0, 0, 0);
    unsigned lines = tn_type_paragraph(p->paint, x, p->y + LEADING, MARGIN + p->room - x, LEADING, LINES_MAX, text);
    p->y += LEADING * lines;
}

/* Red before what speaks against the house, green before what speaks for it. */
static void set_sign(lit_page *p, bool good)
{
    tn_paint_rectangle(p->paint, MARGIN, p->y + LEADING - SIGN, SIGN, SIGN);
    tn_paint_colour(p->paint, good ? 0.36 : 0.78, good ? 0.66 : 0.20, good ? 0.38 : 0.17);
    tn_paint_fill(p->paint);
}

static void set_reason(lit_page *p, const tn_lit_reason *reason)
{
    double x = MARGIN + 2 * SIGN;
    set_sign(p, reason->good);
    set_text(p, x, HEADING_SIZE, true, reason->heading);
    for (size_t i = 0; i < reason->line_count; i++)
        set_text(p, x, TEXT_SIZE, false, reason->lines[i]);
    p->y += GAP / 2;
    set_plans(p, reason);
}

/* Measures the page, or draws it. */
static void set_all(lit_page *p)
{
    const tn_lit_house *what = p->what;
    size_t lit = 0;
    p->y = MARGIN;
    set_text(p, MARGIN, TITLE_SIZE, true, what->title);
    set_text(p, MARGIN, TEXT_SIZE, false, what->said);
    p->y += GAP;
    for (size_t i = 0; i < what->reason_count; i++) {
        set_reason(p, &what->reasons[i]);
        lit += what->reasons[i].lit_count;
    }
    if (lit == 0)
        set_plans(p, NULL);
    p->y += MARGIN;
}

static tn_status set_page(lit_page *p, tn_picture *to, tn_error *error)
{
    tn_canvas *canvas = NULL;
    p->paint = tn_paint_new(NULL);
    if (!p->paint)
        return tn_fail_memory(error);
    set_all(p);
    tn_paint_free(p->paint);
    tn_status status = tn_canvas_begin(to, p->room + 2 * MARGIN, p->y, p->what->title, &canvas, error);
    if (status == TN_OK) {
        p->canvas = canvas;
        p->paint = tn_canvas_paint(canvas);
        set_all(p);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}

tn_status tn_lit_house_draw(const tn_lit_house *what, tn_picture *to, tn_error *error)
{
    lit_page p = {.what = what,
                  .plans = calloc((size_t)what->house->form->record->storey_count + 1, sizeof *p.plans),
                  .metric = tn_house_length_style(what->house) != TN_STYLE_FEET};
    tn_status status = p.plans ? take_plans(&p, to->watch, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = choose_scale(&p, error);
    if (status == TN_OK) {
        choose_width(&p);
        status = set_page(&p, to, error);
    }
    for (size_t i = 0; i < p.count; i++)
        tn_house_drawn_clear(&p.plans[i]);
    free(p.plans);
    return status;
}
