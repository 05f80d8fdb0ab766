/* Keeps the path and the state of a picture that is drawn, and hands each operation to its device in points of the
 * page.
 */
#include "runtime/draw/paint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/draw/device/lettering.h"
#include "runtime/math/elementary.h"

#define WHOLE 6.283185307179586

/* (x, y) stands at (x0 + across * x - down * y, y0 + down * x + across * y) of the page: axes are turned and of one
 * scale. Within symbols that are mirrored, x is -x. */
typedef struct axes {
    double across, down, x0, y0, scale, angle;
    bool mirrored;
} axes;

typedef struct state {
    axes axes;
    tn_ink ink;
    tn_pen pen;
    tn_layer layer;
    bool even_odd;
    double size;
    bool bold;
    size_t clips; /* since the state was saved */
} state;

/* A symbol that the device knows by its number. */
typedef struct known_symbol {
    char *name; /* owned */
    double scale;
} known_symbol;

struct tn_paint {
    tn_device *device; /* or NULL */
    state now;
    state *saved; /* owned */
    size_t depth, capacity;
    tn_drawn_step *steps; /* owned */
    size_t step_count, step_capacity;
    bool goes_on;            /* what is added goes on from where the path is */
    tn_drawn_step beginning; /* of the subpath */
    known_symbol *symbols;   /* owned */
    size_t symbol_count, symbol_capacity;
    bool in_symbol;
    tn_status status; /* of the first failure */
};

static void tell_layer(tn_paint *paint)
{
    if (paint->device)
        paint->device->layer = paint->now.layer;
}

static void reset(tn_paint *paint, axes from)
{
    paint->now = (state){.axes = from, .ink = {.opacity = 1}, .pen = {.width = 1}, .size = 10};
    tell_layer(paint);
}

/* Those of the page. */
static axes straight(double scale)
{
    return (axes){.across = scale, .scale = scale};
}

tn_paint *tn_paint_new(tn_device *device)
{
    tn_paint *paint = calloc(1, sizeof *paint);
    if (!paint) {
        if (device)
            device->operations->free(device);
        return NULL;
    }
    paint->device = device;
    reset(paint, straight(1));
    return paint;
}

void tn_paint_free(tn_paint *paint)
{
    if (!paint)
        return;
    if (paint->device)
        paint->device->operations->free(paint->device);
    for (size_t i = 0; i < paint->symbol_count; i++)
        free(paint->symbols[i].name);
    free(paint->symbols);
    free(paint->saved);
    free(paint->steps);
    free(paint);
}

/* Is there something to draw on, and nothing failed yet? */
static bool draws(const tn_paint *paint)
{
    return paint->device && paint->status == TN_OK;
}

static void note(tn_paint *paint, tn_status status)
{
    if (paint->status == TN_OK)
        paint->status = status;
}

static tn_status tell(const tn_paint *paint, tn_error *error)
{
    if (paint->status == TN_OK)
        return TN_OK;
    if (paint->status == TN_MEMORY)
        return tn_fail_memory(error);
    if (paint->status == TN_IO)
        return tn_fail(error, TN_IO, E_CANNOT_WRITE, "the picture cannot be written");
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the picture cannot be drawn");
}

tn_status tn_paint_finish(tn_paint *paint, tn_watch *watch, tn_error *error)
{
    if (!draws(paint))
        return tell(paint, error);
    return paint->device->operations->finish(paint->device, watch, error);
}

tn_status tn_paint_next_page(tn_paint *paint, double width, double height, tn_error *error)
{
    if (draws(paint) && paint->device->operations->next_page)
        note(paint, paint->device->operations->next_page(paint->device, width, height));
    else if (draws(paint))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "only a PDF has more than one page");
    reset(paint, straight(1));
    return tell(paint, error);
}

/* ---- the state */

void tn_paint_save(tn_paint *paint)
{
    if (!tn_array_reserve(&paint->saved, &paint->capacity, paint->depth, 1, sizeof *paint->saved)) {
        note(paint, TN_MEMORY);
        return;
    }
    paint->saved[paint->depth++] = paint->now;
    paint->now.clips = 0;
}

void tn_paint_restore(tn_paint *paint)
{
    if (paint->depth == 0)
        return; /* saving it failed */
    for (size_t i = 0; i < paint->now.clips && draws(paint); i++)
        note(paint, paint->device->operations->end_clip(paint->device));
    paint->now = paint->saved[--paint->depth];
    tell_layer(paint);
}

static void place(const tn_paint *paint, double x, double y, double *to_x, double *to_y)
{
    const axes *a = &paint->now.axes;
    x = a->mirrored ? -x : x;
    *to_x = a->x0 + a->across * x - a->down * y;
    *to_y = a->y0 + a->down * x + a->across * y;
}

void tn_paint_translate(tn_paint *paint, double x, double y)
{
    axes *a = &paint->now.axes;
    place(paint, x, y, &a->x0, &a->y0);
}

void tn_paint_scale(tn_paint *paint, double factor)
{
    axes *a = &paint->now.axes;
    a->scale *= factor;
    a->across *= factor;
    a->down *= factor;
}

void tn_paint_rotate(tn_paint *paint, double angle)
{
    axes *a = &paint->now.axes;
    a->angle += a->mirrored ? -angle : angle;
    a->across = a->scale * tn_cos(a->angle);
    a->down = a->scale * tn_sin(a->angle);
}

void tn_paint_colour(tn_paint *paint, double red, double green, double blue)
{
    paint->now.ink = (tn_ink){red, green, blue, 1};
}

void tn_paint_translucent(tn_paint *paint, double red, double green, double blue, double opacity)
{
    paint->now.ink = (tn_ink){red, green, blue, opacity};
}

void tn_paint_line_width(tn_paint *paint, double width)
{
    paint->now.pen.width = width;
}

void tn_paint_line_cap(tn_paint *paint, tn_line_cap cap)
{
    paint->now.pen.cap = cap;
}

void tn_paint_line_join(tn_paint *paint, tn_line_join join)
{
    paint->now.pen.join = join;
}

void tn_paint_dash(tn_paint *paint, const double *dashes, size_t count, double offset)
{
    tn_pen *pen = &paint->now.pen;
    pen->dash_count = (uint32_t)(count < TN_DASHES_MAX ? count : TN_DASHES_MAX);
    for (uint32_t i = 0; i < pen->dash_count; i++)
        pen->dashes[i] = dashes[i];
    pen->dash_offset = offset;
}

void tn_paint_even_odd(tn_paint *paint, bool even_odd)
{
    paint->now.even_odd = even_odd;
}

/* ---- paths */

static void add(tn_paint *paint, tn_drawn_step step)
{
    if (!draws(paint))
        return;
    if (tn_array_reserve(&paint->steps, &paint->step_capacity, paint->step_count, 1, sizeof *paint->steps))
        paint->steps[paint->step_count++] = step;
    else
        note(paint, TN_MEMORY);
}

void tn_paint_new_path(tn_paint *paint)
{
    paint->step_count = 0;
    paint->goes_on = false;
}

void tn_paint_new_sub_path(tn_paint *paint)
{
    paint->goes_on = false;
}

void tn_paint_move_to(tn_paint *paint, double x, double y)
{
    tn_drawn_step step = {.kind = TN_DRAWN_MOVE};
    place(paint, x, y, &step.x, &step.y);
    if (paint->step_count && paint->steps[paint->step_count - 1].kind == TN_DRAWN_MOVE)
        paint->step_count--; /* nothing begins there */
    add(paint, step);
    paint->beginning = step;
    paint->goes_on = true;
}

/* What goes on from a path that was closed begins where that began. */
static void go_on(tn_paint *paint)
{
    if (paint->step_count && paint->steps[paint->step_count - 1].kind == TN_DRAWN_CLOSE)
        add(paint, paint->beginning);
}

void tn_paint_line_to(tn_paint *paint, double x, double y)
{
    tn_drawn_step step = {.kind = TN_DRAWN_LINE};
    if (!paint->goes_on) {
        tn_paint_move_to(paint, x, y);
        return;
    }
    go_on(paint);
    place(paint, x, y, &step.x, &step.y);
    add(paint, step);
}

void tn_paint_close_path(tn_paint *paint)
{
    if (paint->goes_on)
        add(paint, (tn_drawn_step){.kind = TN_DRAWN_CLOSE});
}

void tn_paint_rectangle(tn_paint *paint, double x, double y, double width, double height)
{
    tn_paint_move_to(paint, x, y);
    tn_paint_line_to(paint, x + width, y);
    tn_paint_line_to(paint, x + width, y + height);
    tn_paint_line_to(paint, x, y + height);
    tn_paint_close_path(paint);
}

static double turned(const axes *a, double angle)
{
    return a->angle + (a->mirrored ? WHOLE / 2 - angle : angle);
}

static void add_arc(tn_paint *paint, double x, double y, double radius, double from, double to)
{
    const axes *a = &paint->now.axes;
    tn_paint_line_to(paint, x + radius * tn_cos(from), y + radius * tn_sin(from));
    tn_drawn_step step = {
        .kind = TN_DRAWN_ARC, .radius = radius * a->scale, .from = turned(a, from), .to = turned(a, to)};
    place(paint, x, y, &step.x, &step.y);
    add(paint, step);
}

void tn_paint_arc(tn_paint *paint, double x, double y, double radius, double from, double to)
{
    if (to < from)
        to += WHOLE * ceil((from - to) / WHOLE);
    add_arc(paint, x, y, radius, from, to);
}

void tn_paint_arc_negative(tn_paint *paint, double x, double y, double radius, double from, double to)
{
    if (to > from)
        to -= WHOLE * ceil((to - from) / WHOLE);
    add_arc(paint, x, y, radius, from, to);
}

static tn_drawn_path path_of(const tn_paint *paint)
{
    return (tn_drawn_path){paint->steps, paint->step_count, paint->now.even_odd};
}

void tn_paint_fill_keep(tn_paint *paint)
{
    tn_drawn_path path = path_of(paint);
    if (draws(paint) && path.count)
        note(paint, paint->device->operations->fill(paint->device, &path, &paint->now.ink));
}

void tn_paint_fill(tn_paint *paint)
{
    tn_paint_fill_keep(paint);
    tn_paint_new_path(paint);
}

/* The pen as it is on the page. */
static tn_pen pen_of(const tn_paint *paint)
{
    tn_pen pen = paint->now.pen;
    double scale = paint->now.axes.scale;
    pen.width *= scale;
    pen.dash_offset *= scale;
    for (uint32_t i = 0; i < pen.dash_count; i++)
        pen.dashes[i] *= scale;
    return pen;
}

void tn_paint_stroke_keep(tn_paint *paint)
{
    tn_drawn_path path = path_of(paint);
    tn_pen pen = pen_of(paint);
    if (draws(paint) && path.count)
        note(paint, paint->device->operations->stroke(paint->device, &path, &pen, &paint->now.ink));
}

void tn_paint_stroke(tn_paint *paint)
{
    tn_paint_stroke_keep(paint);
    tn_paint_new_path(paint);
}

void tn_paint_clip(tn_paint *paint)
{
    tn_drawn_path path = path_of(paint);
    if (draws(paint)) {
        note(paint, paint->device->operations->begin_clip(paint->device, &path));
        paint->now.clips++;
    }
    tn_paint_new_path(paint);
}

/* ---- lettering */

void tn_paint_face(tn_paint *paint, double size, bool bold)
{
    paint->now.size = size;
    paint->now.bold = bold;
}

void tn_paint_capitals(tn_paint *paint, double height, bool bold)
{
    tn_paint_face(paint, height / TN_LETTERING_CAPITALS, bold);
}

double tn_paint_text_width(const tn_paint *paint, const char *text)
{
    return paint->now.size * tn_lettering_width(text, paint->now.bold);
}

double tn_paint_line_height(const tn_paint *paint)
{
    return paint->now.size * tn_lettering_height(paint->now.bold);
}

void tn_paint_text(tn_paint *paint, double x, double y, tn_align align, const char *text)
{
    const state *now = &paint->now;
    tn_lettering lettering = {
        .angle = now->axes.angle, .size = now->size * now->axes.scale, .bold = now->bold, .align = align, .text = text};
    place(paint, x, y, &lettering.x, &lettering.y);
    if (draws(paint) && *text)
        note(paint,
             paint->in_symbol ? TN_INTERNAL : paint->device->operations->text(paint->device, &lettering, &now->ink));
}

/* ---- layers and weights */

void tn_paint_layer(tn_paint *paint, tn_layer layer)
{
    paint->now.layer = layer;
    tell_layer(paint);
}

void tn_paint_weight(tn_paint *paint, tn_weight weight)
{
    static const double millimetres[] = {
        [TN_WEIGHT_CUT] = 0.5, [TN_WEIGHT_SEEN] = 0.35, [TN_WEIGHT_THIN] = 0.25, [TN_WEIGHT_HATCH] = 0.18};
    tn_paint_line_width(paint, millimetres[weight] * TN_POINTS_PER_MM / paint->now.axes.scale);
}

bool tn_paint_covers(const tn_paint *paint)
{
    return !paint->device || !paint->device->outlines;
}

/* ---- hatches */

#define HATCH_MOST 40000.0 /* lines of a region */

typedef struct box {
    double low[2], high[2];
} box;

static box bounds_of(const tn_drawn_path *path)
{
    box b = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < path->count; i++) {
        const tn_drawn_step *step = &path->steps[i];
        const double at[2] = {step->x, step->y}, around = step->kind == TN_DRAWN_ARC ? step->radius : 0;
        for (int k = 0; k < 2 && step->kind != TN_DRAWN_CLOSE; k++) {
            b.low[k] = fmin(b.low[k], at[k] - around);
            b.high[k] = fmax(b.high[k], at[k] + around);
        }
    }
    return b;
}

/* How many lines there are about in a box. */
static double count_hatch_lines(const tn_hatched *h, const box *b)
{
    size_t count;
    const tn_hatch_lines *lines = tn_hatch_made_of(h->hatch, &count);
    double wide = b->high[0] - b->low[0], high = b->high[1] - b->low[1], drawn = 0;
    for (size_t i = 0; i < count; i++) {
        double angle = h->angle - lines[i].angle * WHOLE / 360, u = fabs(tn_cos(angle)), v = fabs(tn_sin(angle)),
               period = (lines[i].dashes[0] + lines[i].dashes[1]) * h->scale;
        drawn += (wide * v + high * u) / (lines[i].apart * h->scale) *
                 (period > 0 ? fmax(1, (wide * u + high * v) / period) : 1);
    }
    return drawn;
}

/* Leaves of a stretch of a line through (u, v) what is within a box; false: nothing. */
static bool trim(const box *b, const double through[2], const double along[2], double *from, double *to)
{
    for (int k = 0; k < 2; k++) {
        if (fabs(along[k]) < 1e-9) {
            if (through[k] < b->low[k] || through[k] > b->high[k])
                return false;
            continue;
        }
        double low = (b->low[k] - through[k]) / along[k], high = (b->high[k] - through[k]) / along[k];
        *from = fmax(*from, fmin(low, high));
        *to = fmin(*to, fmax(low, high));
    }
    return *from < *to;
}

/* Draws a line across a box, with its dashes counted from `shift` along it. */
static void draw_hatch_line(tn_paint *paint, const tn_hatched *h, const tn_hatch_lines *lines, const box *b,
                            const double through[2], const double along[2], double shift)
{
    double from = -INFINITY, to = INFINITY, period = (lines->dashes[0] + lines->dashes[1]) * h->scale;
    if (!trim(b, through, along, &from, &to))
        return;
    tn_paint_move_to(paint, through[0] + from * along[0], through[1] + from * along[1]);
    tn_paint_line_to(paint, through[0] + to * along[0], through[1] + to * along[1]);
    if (!(period > 0))
        return;
    const double dashes[] = {lines->dashes[0] * h->scale, lines->dashes[1] * h->scale};
    tn_paint_dash(paint, dashes, 2, from - shift - floor((from - shift) / period) * period);
    tn_paint_stroke(paint);
}

/* Draws the lines of one direction across a box, in points of the page. */
static void draw_hatch_lines(tn_paint *paint, const tn_hatched *h, const tn_hatch_lines *lines, const box *b)
{
    double angle = h->angle - lines->angle * WHOLE / 360, along[2] = {tn_cos(angle), tn_sin(angle)},
           aside[2] = {along[1], -along[0]}, turn[2] = {tn_cos(h->angle), tn_sin(h->angle)},
           x = h->x + h->scale * (turn[0] * lines->x - turn[1] * lines->y),
           y = h->y + h->scale * (turn[1] * lines->x + turn[0] * lines->y), low = INFINITY, high = -INFINITY,
           apart = lines->apart * h->scale;
    for (int k = 0; k < 4; k++) {
        double dx = (k % 2 ? b->high[0] : b->low[0]) - x, dy = (k / 2 ? b->high[1] : b->low[1]) - y;
        low = fmin(low, dx * aside[0] + dy * aside[1]);
        high = fmax(high, dx * aside[0] + dy * aside[1]);
    }
    for (double k = ceil(low / apart); k * apart <= high; k++)
        draw_hatch_line(paint, h, lines, b, (const double[2]){x + k * apart * aside[0], y + k * apart * aside[1]},
                        along, k * lines->shift * h->scale);
    tn_paint_stroke(paint);
}

/* Is the path that box and nothing else? */
static bool is_box(const tn_drawn_path *path)
{
    const tn_drawn_step *steps = path->steps;
    bool holds = path->count == 5 && steps[4].kind == TN_DRAWN_CLOSE;
    for (size_t i = 0; holds && i < 4; i++) {
        const tn_drawn_step *next = &steps[(i + 1) % 4];
        holds = steps[i].kind == (i == 0 ? TN_DRAWN_MOVE : TN_DRAWN_LINE) &&
                (steps[i].x == next->x) != (steps[i].y == next->y) &&
                (steps[i].x == next->x) == (steps[(i + 2) % 4].x == steps[(i + 3) % 4].x);
    }
    return holds;
}

/* By lines that are clipped; those across a box end there. */
static void draw_hatch(tn_paint *paint, const tn_hatched *hatched, const box *b)
{
    size_t count;
    const tn_hatch_lines *lines = tn_hatch_made_of(hatched->hatch, &count);
    const tn_drawn_path path = path_of(paint);
    tn_paint_save(paint);
    if (is_box(&path))
        tn_paint_new_path(paint);
    else
        tn_paint_clip(paint);
    paint->now.pen = pen_of(paint);
    paint->now.axes = straight(1);
    for (size_t i = 0; i < count; i++) {
        tn_paint_dash(paint, NULL, 0, 0);
        draw_hatch_lines(paint, hatched, &lines[i], b);
    }
    tn_paint_restore(paint);
}

void tn_paint_hatch(tn_paint *paint, tn_hatch hatch, double size)
{
    const axes *a = &paint->now.axes;
    tn_drawn_path path = path_of(paint);
    if (draws(paint) && path.count) {
        tn_pen pen = pen_of(paint);
        box b = bounds_of(&path);
        tn_hatched hatched = {hatch, a->x0, a->y0, a->angle, size * a->scale};
        while (count_hatch_lines(&hatched, &b) > HATCH_MOST)
            hatched.scale *= 2; /* too many are farther apart */
        if (paint->device->operations->hatch)
            note(paint, paint->device->operations->hatch(paint->device, &path, &hatched, &pen, &paint->now.ink));
        else
            draw_hatch(paint, &hatched, &b);
    }
    tn_paint_new_path(paint);
}

/* ---- symbols */

/* The number of a symbol of that name and scale, or the count of symbols if there is none yet. */
static size_t find_symbol(const tn_paint *paint, const char *name)
{
    size_t i = 0;
    while (i < paint->symbol_count &&
           (strcmp(paint->symbols[i].name, name) != 0 || paint->symbols[i].scale != paint->now.axes.scale))
        i++;
    return i;
}

/* Draws it with a state that is new but for these axes. */
static void draw_symbol(tn_paint *paint, const tn_drawn_symbol *symbol, axes from)
{
    bool within = paint->in_symbol;
    tn_paint_save(paint);
    paint->in_symbol = true;
    reset(paint, from);
    symbol->draw(paint, symbol->of);
    paint->in_symbol = within;
    tn_paint_restore(paint);
    tn_paint_new_path(paint);
}

static tn_status define_symbol(tn_paint *paint, const tn_drawn_symbol *symbol)
{
    const tn_device_operations *does = paint->device->operations;
    size_t number = paint->symbol_count;
    if (!tn_array_reserve(&paint->symbols, &paint->symbol_capacity, number, 1, sizeof *paint->symbols))
        return TN_MEMORY;
    char *name = strdup(symbol->name);
    if (!name)
        return TN_MEMORY;
    paint->symbols[paint->symbol_count++] = (known_symbol){name, paint->now.axes.scale};
    tn_status status = does->begin_symbol(paint->device, number, name);
    if (status != TN_OK)
        return status;
    draw_symbol(paint, symbol, straight(paint->now.axes.scale));
    return paint->status == TN_OK ? does->end_symbol(paint->device) : paint->status;
}

void tn_paint_symbol(tn_paint *paint, const tn_drawn_symbol *symbol, double x, double y, double angle, bool mirrored)
{
    axes a = paint->now.axes;
    tn_paint_new_path(paint);
    if (!draws(paint))
        return;
    place(paint, x, y, &a.x0, &a.y0);
    a.angle += a.mirrored ? -angle : angle;
    a.mirrored ^= mirrored;
    a.across = a.scale * tn_cos(a.angle);
    a.down = a.scale * tn_sin(a.angle);
    if (!paint->device->operations->use_symbol || paint->in_symbol) {
        draw_symbol(paint, symbol, a);
        return;
    }
    size_t number = find_symbol(paint, symbol->name);
    if (number == paint->symbol_count)
        note(paint, define_symbol(paint, symbol));
    const tn_symbol_place at = {a.x0, a.y0, a.angle, a.mirrored};
    if (draws(paint))
        note(paint, paint->device->operations->use_symbol(paint->device, number, &at));
}

/* ---- dimensions. Shares of the size of the lettering */

#define DIMENSION_GAP 0.4    /* from a point to the line out from it */
#define DIMENSION_BEYOND 0.6 /* how far that goes past the line of the dimension; without an offset to both sides */
#define DIMENSION_STROKE 0.4 /* half of how far an oblique stroke reaches, across and up */
#define DIMENSION_RAISED 0.4 /* from the line to the text's baseline */
#define DIMENSION_BELOW 1.55 /* clear of strokes */
#define DIMENSION_LEADER 0.76
#define DIMENSION_CAPITAL 0.36 /* half of one */

static void trace_line(tn_paint *paint, double x0, double y0, double x1, double y1)
{
    tn_paint_move_to(paint, x0, y0);
    tn_paint_line_to(paint, x1, y1);
}

/* The oblique strokes at its ends. */
static void trace_strokes(tn_paint *paint, const double ends[2][2], const double along[2], const double aside[2])
{
    double stroke = DIMENSION_STROKE * paint->now.size, x = stroke * (along[0] + aside[0]),
           y = stroke * (along[1] + aside[1]);
    for (int i = 0; i < 2; i++)
        trace_line(paint, ends[i][0] - x, ends[i][1] - y, ends[i][0] + x, ends[i][1] + y);
}

/* along: a direction, `aside` the one to the left of it. */
static void trace_dimension(tn_paint *paint, const tn_dimension *d, const double ends[2][2], const double along[2],
                            const double aside[2])
{
    const double *points[2] = {d->from, d->to};
    double size = paint->now.size, out = d->offset < 0 ? -1 : 1, past = out * DIMENSION_BEYOND * size,
           gap = d->offset == 0 ? -past : out * fmin(DIMENSION_GAP * size, fabs(d->offset)),
           thin = paint->now.pen.width;
    for (int i = 0; i < 2; i++)
        trace_line(paint, points[i][0] + gap * aside[0], points[i][1] + gap * aside[1], ends[i][0] + past * aside[0],
                   ends[i][1] + past * aside[1]);
    trace_line(paint, ends[0][0], ends[0][1], ends[1][0], ends[1][1]);
    if (d->heavy) {
        tn_paint_stroke(paint);
        tn_paint_weight(paint, TN_WEIGHT_CUT);
    }
    trace_strokes(paint, ends, along, aside);
    tn_paint_stroke(paint);
    paint->now.pen.width = thin;
}

/* Which way its text runs: to be read from below, or from the right. */
static void run_of(const double ends[2][2], double run[2])
{
    double dx = ends[1][0] - ends[0][0], dy = ends[1][1] - ends[0][1], sign = dx < 0 || (dx == 0 && dy > 0) ? -1 : 1;
    run[0] = sign * dx;
    run[1] = sign * dy;
}

/* The middle of a text that is below the line. */
static void place_below(const tn_paint *paint, const double ends[2][2], double at[2])
{
    double run[2], away = (DIMENSION_BELOW - DIMENSION_CAPITAL) * paint->now.size;
    run_of(ends, run);
    double length = hypot(run[0], run[1]);
    place(paint, (ends[0][0] + ends[1][0]) / 2 - run[1] / length * away,
          (ends[0][1] + ends[1][1]) / 2 + run[0] / length * away, &at[0], &at[1]);
}

static void write_dimension(tn_paint *paint, const tn_dimension *d, const double ends[2][2])
{
    double run[2];
    run_of(ends, run);
    tn_paint_save(paint);
    tn_paint_translate(paint, (ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2);
    tn_paint_rotate(paint, tn_atan2(run[1], run[0]));
    if (d->below && d->text[0]) {
        trace_line(paint, 0, 0, 0, DIMENSION_LEADER * paint->now.size);
        tn_paint_stroke(paint);
    }
    tn_paint_text(paint, 0, (d->below ? DIMENSION_BELOW : -DIMENSION_RAISED) * paint->now.size, TN_ALIGN_CENTRE,
                  d->text);
    tn_paint_restore(paint);
}

void tn_paint_dimension(tn_paint *paint, const tn_dimension *d)
{
    const tn_device_operations *does = paint->device ? paint->device->operations : NULL;
    double dx = d->to[0] - d->from[0], dy = d->to[1] - d->from[1], length = hypot(dx, dy);
    tn_paint_new_path(paint);
    if (!draws(paint) || !(length > 0))
        return;
    const double along[2] = {dx / length, dy / length}, aside[2] = {along[1], -along[0]},
                 ends[2][2] = {{d->from[0] + d->offset * aside[0], d->from[1] + d->offset * aside[1]},
                               {d->to[0] + d->offset * aside[0], d->to[1] + d->offset * aside[1]}};
    tn_drawn_dimension drawn = {.text = d->text, .moved = d->below && d->text[0]};
    place_below(paint, ends, drawn.text_at);
    place(paint, d->from[0], d->from[1], &drawn.from[0], &drawn.from[1]);
    place(paint, d->to[0], d->to[1], &drawn.to[0], &drawn.to[1]);
    for (int i = 0; i < 2; i++)
        place(paint, ends[i][0], ends[i][1], &drawn.line[i][0], &drawn.line[i][1]);
    if (does->begin_dimension)
        note(paint, does->begin_dimension(paint->device, &drawn));
    trace_dimension(paint, d, ends, along, aside);
    write_dimension(paint, d, ends);
    if (does->begin_dimension && draws(paint))
        note(paint, does->end_dimension(paint->device));
}

/* ---- drawings to scale */

void tn_paint_view_begin(tn_paint *paint, const tn_drawn_view *view)
{
    tn_drawn_view placed = *view;
    double scale = paint->now.axes.scale;
    place(paint, view->x, view->y, &placed.x, &placed.y);
    place(paint, view->origin[0], view->origin[1], &placed.origin[0], &placed.origin[1]);
    placed.width *= scale;
    placed.height *= scale;
    if (draws(paint) && paint->device->operations->begin_view)
        note(paint, paint->device->operations->begin_view(paint->device, &placed));
}

void tn_paint_view_end(tn_paint *paint)
{
    if (draws(paint) && paint->device->operations->end_view)
        note(paint, paint->device->operations->end_view(paint->device));
}

/* ---- pixels */

void tn_paint_pixels(tn_paint *paint, const uint32_t *values, uint32_t width, uint32_t height, double x, double y,
                     double pixel)
{
    tn_pixels pixels = {.values = values, .width = width, .height = height, .pixel = pixel * paint->now.axes.scale};
    place(paint, x, y, &pixels.x, &pixels.y);
    if (draws(paint))
        note(paint, paint->device->operations->pixels(paint->device, &pixels));
}

double tn_paint_pixel(const tn_paint *paint)
{
    return paint->device ? paint->device->pixel / paint->now.axes.scale : 0;
}

/* ---- groups */

void tn_paint_group_begin(tn_paint *paint, tn_paint_subject subject, size_t number)
{
    static const char *const names[] = {
        [TN_PAINT_PLAN] = "plan", [TN_PAINT_TRAY] = "tray",   [TN_PAINT_RULE] = "rule",
        [TN_PAINT_PART] = "part", [TN_PAINT_ITEM] = "item",   [TN_PAINT_DEPTH] = "depth",
        [TN_PAINT_BAR] = "bar",   [TN_PAINT_POINT] = "point", [TN_PAINT_HOUSE] = "house"};
    if (draws(paint) && paint->device->operations->begin_group)
        note(paint, paint->device->operations->begin_group(paint->device, names[subject], number));
}

void tn_paint_group_end(tn_paint *paint)
{
    if (draws(paint) && paint->device->operations->end_group)
        note(paint, paint->device->operations->end_group(paint->device));
}

void tn_paint_target(tn_paint *paint, double x, double y, double width, double height)
{
    if (!draws(paint) || !paint->device->operations->target || paint->now.axes.angle != 0 || paint->now.axes.mirrored)
        return;
    double scale = paint->now.axes.scale, left, top;
    place(paint, x, y, &left, &top);
    note(paint, paint->device->operations->target(paint->device, left, top, width * scale, height * scale));
}
