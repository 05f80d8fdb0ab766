/* Keeps the path and the state of a picture that is drawn, and hands each operation to its device in points of the
 * page.
 */
#include "runtime/draw/paint.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/draw/device/lettering.h"
#include "runtime/math/elementary.h"

#define WHOLE 6.283185307179586

/* (x, y) stands at (x0 + across * x - down * y, y0 + down * x + across * y) of the page: axes are turned and of one
 * scale, and never mirrored. */
typedef struct axes {
    double across, down, x0, y0, scale, angle;
} axes;

typedef struct state {
    axes axes;
    tn_ink ink;
    tn_pen pen;
    bool even_odd;
    double size;
    bool bold;
    size_t clips; /* since the state was saved */
} state;

struct tn_paint {
    tn_device *device; /* or NULL */
    state now;
    state *saved; /* owned */
    size_t depth, capacity;
    tn_drawn_step *steps; /* owned */
    size_t step_count, step_capacity;
    bool goes_on;            /* what is added goes on from where the path is */
    tn_drawn_step beginning; /* of the subpath */
    tn_status status;        /* of the first failure */
};

static void reset(state *s)
{
    *s = (state){.axes = {.across = 1, .scale = 1}, .ink = {.opacity = 1}, .pen = {.width = 1}, .size = 10};
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
    reset(&paint->now);
    return paint;
}

void tn_paint_free(tn_paint *paint)
{
    if (!paint)
        return;
    if (paint->device)
        paint->device->operations->free(paint->device);
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
    reset(&paint->now);
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
}

static void place(const tn_paint *paint, double x, double y, double *to_x, double *to_y)
{
    const axes *a = &paint->now.axes;
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
    a->angle += angle;
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

static void add_arc(tn_paint *paint, double x, double y, double radius, double from, double to)
{
    const axes *a = &paint->now.axes;
    tn_paint_line_to(paint, x + radius * tn_cos(from), y + radius * tn_sin(from));
    tn_drawn_step step = {
        .kind = TN_DRAWN_ARC, .radius = radius * a->scale, .from = from + a->angle, .to = to + a->angle};
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
void tn_paint_stroke_keep(tn_paint *paint)
{
    tn_drawn_path path = path_of(paint);
    tn_pen pen = paint->now.pen;
    double scale = paint->now.axes.scale;
    pen.width *= scale;
    pen.dash_offset *= scale;
    for (uint32_t i = 0; i < pen.dash_count; i++)
        pen.dashes[i] *= scale;
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
        note(paint, paint->device->operations->text(paint->device, &lettering, &now->ink));
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
    if (!draws(paint) || !paint->device->operations->target || paint->now.axes.angle != 0)
        return;
    double scale = paint->now.axes.scale, left, top;
    place(paint, x, y, &left, &top);
    note(paint, paint->device->operations->target(paint->device, left, top, width * scale, height * scale));
}
