/* Writes pictures as DXF: entities. */
#include "runtime/draw/device/dxf.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/draw/device/chains.h"
#include "runtime/draw/device/dxf_file.h"
#include "runtime/draw/device/lettering.h"
#include "runtime/math/elementary.h"

#define WHOLE 6.283185307179586
#define WHITE 0.97  /* what is filled in a colour as light as this covers something */
#define NEAR 1e-9   /* of points: the same */
#define GRID_MM 100 /* origins of views are apart by whole ones of these, so that measures stay round */
#define GRID_INCH 6

/* A corner of a polyline; the bulge is that of the arc that begins there: the tangent of a quarter of its angle. */
typedef struct corner {
    double x, y, bulge;
} corner;

/* (x, y) of the page is (to[0] + (x - from[0]) * scale, to[1] - (y - from[1]) * scale) where it is drawn. */
typedef struct mapping {
    double scale, from[2], to[2];
} mapping;

/* Where entities go. */
typedef struct place {
    tn_buffer *entities;
    uint32_t owner;
    mapping by;
    bool paper;
} place;

typedef struct dxf {
    tn_device device;
    FILE *out;
    tn_dxf_content content;
    place sheet;       /* what belongs to no view */
    place now, before; /* before: where symbols and dimensions are used while they are drawn */
    tn_buffer viewports;
    uint32_t viewport_count;
    double first_origin[2]; /* of the first view, on the page */
    size_t *symbols;        /* [number] its block; owned */
    size_t symbol_count, symbol_capacity;
    size_t dimension; /* the block of the dimension that is drawn */
    uint32_t dimension_count;
    tn_drawn_dimension dimension_at; /* in units of the drawing; its text is the caller's */
    corner *corners;                 /* owned, of the subpath at hand */
    size_t corner_count, corner_capacity;
} dxf;

/* ---- places */

static void map(const place *p, double x, double y, double at[2])
{
    at[0] = p->by.to[0] + (x - p->by.from[0]) * p->by.scale;
    at[1] = p->by.to[1] - (y - p->by.from[1]) * p->by.scale;
}

/* What is drawn in a block lies wherever that is inserted. */
static void widen(dxf *d, const double at[2])
{
    if (d->now.owner != TN_DXF_MODEL && d->now.owner != TN_DXF_PAPER)
        return;
    tn_dxf_box *box = d->now.paper ? &d->content.paper_box : &d->content.model_box;
    for (int k = 0; k < 2; k++) {
        box->low[k] = fmin(box->low[k], at[k]);
        box->high[k] = fmax(box->high[k], at[k]);
    }
}

static void put_point(dxf *d, int code, double x, double y)
{
    tn_dxf_put(d->now.entities, code, x);
    tn_dxf_put(d->now.entities, code + 10, y);
    tn_dxf_put(d->now.entities, code + 20, 0);
}

static tn_status outcome(const dxf *d)
{
    return d->now.entities->failed ? TN_MEMORY : TN_OK;
}

/* ---- what all entities have */

static uint32_t take_handle(dxf *d)
{
    return d->content.next_handle++;
}

static void begin_on(dxf *d, const char *entity, tn_layer layer)
{
    d->content.used[layer] = true;
    tn_buffer_printf(d->now.entities, "0\n%s\n5\n%X\n330\n%X\n100\nAcDbEntity\n%s8\n%s\n", entity,
                     (unsigned)take_handle(d), (unsigned)d->now.owner, d->now.paper ? "67\n1\n" : "",
                     tn_dxf_layer_name(&d->content.options, layer));
}

static void begin(dxf *d, const char *entity)
{
    begin_on(d, entity, d->device.layer);
}

static void put_class(dxf *d, const char *name)
{
    tn_buffer_printf(d->now.entities, "100\n%s\n", name);
}

static long byte_of(double part)
{
    return lround(fmin(fmax(part, 0), 1) * 255);
}

static void put_colour(dxf *d, const tn_ink *ink)
{
    tn_buffer_printf(d->now.entities, "420\n%ld\n",
                     byte_of(ink->red) << 16 | byte_of(ink->green) << 8 | byte_of(ink->blue));
}

/* The nearest of the weights that there are, in hundredths of a millimetre. */
static int weight_of(double points)
{
    static const int weights[] = {5,  9,  13, 15, 18,  20,  25,  30,  35,  40,  50, 53,
                                  60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211};
    double wanted = points * 2540 / 72;
    size_t best = 0;
    for (size_t i = 1; i < sizeof weights / sizeof *weights; i++)
        if (fabs(weights[i] - wanted) < fabs(weights[best] - wanted))
            best = i;
    return weights[best];
}

/* The number of these dashes; the count of all without memory. */
static size_t find_dashes(dxf *d, const tn_pen *pen)
{
    tn_dxf_content *c = &d->content;
    tn_dxf_dashes wanted = {.count = pen->dash_count};
    for (uint32_t i = 0; i < pen->dash_count; i++)
        wanted.lengths[i] = pen->dashes[i] * d->now.by.scale;
    size_t i = 0;
    while (i < c->dash_count && memcmp(&c->dashes[i], &wanted, sizeof wanted) != 0)
        i++;
    if (i == c->dash_count && tn_array_reserve(&c->dashes, &c->dash_capacity, i, 1, sizeof *c->dashes))
        c->dashes[c->dash_count++] = wanted;
    return i;
}

/* Lines have the colour of their layer; on none, their own. */
static bool put_pen(dxf *d, const tn_pen *pen, const tn_ink *ink)
{
    if (pen->dash_count > 0) {
        size_t number = find_dashes(d, pen);
        if (number == d->content.dash_count)
            return false;
        tn_buffer_printf(d->now.entities, "6\nDASHED-%zu\n", number + 1);
    }
    tn_buffer_printf(d->now.entities, "370\n%d\n", weight_of(pen->width));
    if (d->device.layer == TN_LAYER_NONE && byte_of(ink->red) + byte_of(ink->green) + byte_of(ink->blue) > 0)
        put_colour(d, ink);
    return true;
}

/* ---- paths */

static bool add_corner(dxf *d, double x, double y)
{
    double at[2];
    map(&d->now, x, y, at);
    if (!tn_array_reserve(&d->corners, &d->corner_capacity, d->corner_count, 1, sizeof *d->corners))
        return false;
    d->corners[d->corner_count++] = (corner){at[0], at[1], 0};
    return true;
}

/* From the corner that was added last. A whole circle is two halves. */
static bool add_arc(dxf *d, const tn_drawn_step *arc)
{
    int parts = fabs(arc->to - arc->from) < WHOLE * 0.999 ? 1 : 2;
    double turn = (arc->to - arc->from) / parts;
    for (int i = 1; i <= parts; i++) {
        double to = arc->from + turn * i;
        d->corners[d->corner_count - 1].bulge = -tn_sin(turn / 4) / tn_cos(turn / 4); /* y goes down on the page */
        if (!add_corner(d, arc->x + arc->radius * tn_cos(to), arc->y + arc->radius * tn_sin(to)))
            return false;
    }
    return true;
}

static bool same_place(const dxf *d, size_t a, size_t b)
{
    double near = NEAR * d->now.by.scale;
    return fabs(d->corners[a].x - d->corners[b].x) <= near && fabs(d->corners[a].y - d->corners[b].y) <= near;
}

/* Collects the subpath that begins with step `from`. Returns the first step after it. *fine: false without memory. */
static size_t collect(dxf *d, const tn_drawn_path *path, size_t from, bool *closed, bool *fine)
{
    size_t i = from;
    d->corner_count = 0;
    *closed = false;
    for (; *fine && i < path->count && !(i > from && path->steps[i].kind == TN_DRAWN_MOVE); i++) {
        const tn_drawn_step *step = &path->steps[i];
        if (step->kind == TN_DRAWN_ARC && d->corner_count > 0)
            *fine = add_arc(d, step);
        else if (step->kind == TN_DRAWN_CLOSE)
            *closed = true;
        else
            *fine = add_corner(d, step->x, step->y);
        size_t count = d->corner_count;
        if (step->kind == TN_DRAWN_LINE && count > 1 && same_place(d, count - 1, count - 2))
            d->corner_count--; /* it goes nowhere */
    }
    if (*closed && d->corner_count > 1 && same_place(d, 0, d->corner_count - 1))
        d->corner_count--;
    return i;
}

static void put_corners(dxf *d, bool with_bulges)
{
    for (size_t i = 0; i < d->corner_count; i++) {
        const corner *c = &d->corners[i];
        tn_dxf_put(d->now.entities, 10, c->x);
        tn_dxf_put(d->now.entities, 20, c->y);
        if (with_bulges || c->bulge != 0)
            tn_dxf_put(d->now.entities, 42, c->bulge);
        widen(d, (const double[2]){c->x, c->y});
    }
}

static double degrees(double angle)
{
    double turned = fmod(angle * 360 / WHOLE, 360);
    turned += turned < 0 ? 360 : 0;
    return turned > 360 - 1e-7 ? 0 : turned;
}

/* A subpath that is an arc alone. Arcs run against the clock; y goes down on the page. */
static bool stroke_arc(dxf *d, const tn_drawn_step *arc, const tn_pen *pen, const tn_ink *ink)
{
    double at[2], radius = arc->radius * d->now.by.scale;
    bool whole = fabs(arc->to - arc->from) >= WHOLE * 0.999, falls = arc->to < arc->from;
    map(&d->now, arc->x, arc->y, at);
    begin(d, whole ? "CIRCLE" : "ARC");
    if (!put_pen(d, pen, ink))
        return false;
    put_class(d, "AcDbCircle");
    put_point(d, 10, at[0], at[1]);
    tn_dxf_put(d->now.entities, 40, radius);
    if (!whole) {
        put_class(d, "AcDbArc");
        tn_dxf_put(d->now.entities, 50, degrees(falls ? -arc->from : -arc->to));
        tn_dxf_put(d->now.entities, 51, degrees(falls ? -arc->to : -arc->from));
    }
    for (size_t i = 0; i < d->corner_count; i++)
        widen(d, (const double[2]){d->corners[i].x, d->corners[i].y});
    return true;
}

/* Is the subpath one arc alone, or a circle that is closed? */
static bool is_arc(const tn_drawn_path *path, size_t from, size_t end)
{
    const tn_drawn_step *arc = &path->steps[from + 1];
    bool whole = end == from + 3 && fabs(arc->to - arc->from) >= WHOLE * 0.999;
    return (end == from + 2 || (whole && path->steps[from + 2].kind == TN_DRAWN_CLOSE)) && arc->kind == TN_DRAWN_ARC;
}

static bool stroke_line(dxf *d, const tn_pen *pen, const tn_ink *ink)
{
    begin(d, "LINE");
    if (!put_pen(d, pen, ink))
        return false;
    put_class(d, "AcDbLine");
    for (size_t i = 0; i < 2; i++) {
        put_point(d, 10 + (int)i, d->corners[i].x, d->corners[i].y);
        widen(d, (const double[2]){d->corners[i].x, d->corners[i].y});
    }
    return true;
}

static bool stroke_polyline(dxf *d, bool closed, const tn_pen *pen, const tn_ink *ink)
{
    begin(d, "LWPOLYLINE");
    if (!put_pen(d, pen, ink))
        return false;
    put_class(d, "AcDbPolyline");
    tn_buffer_printf(d->now.entities, "90\n%zu\n70\n%d\n", d->corner_count, closed);
    put_corners(d, false);
    return true;
}

static bool stroke_path(dxf *d, const tn_drawn_path *path, const tn_pen *pen, const tn_ink *ink)
{
    bool fine = true, closed;
    for (size_t i = 0, end; fine && i < path->count; i = end) {
        end = collect(d, path, i, &closed, &fine);
        if (!fine || d->corner_count < 2)
            continue;
        if (is_arc(path, i, end))
            fine = stroke_arc(d, &path->steps[i + 1], pen, ink);
        else if (d->corner_count == 2 && d->corners[0].bulge == 0 && d->corners[1].bulge == 0)
            fine = stroke_line(d, pen, ink);
        else
            fine = stroke_polyline(d, closed, pen, ink);
    }
    return fine;
}

static tn_status stroke(tn_device *device, const tn_drawn_path *path, const tn_pen *pen, const tn_ink *ink)
{
    dxf *d = (dxf *)device;
    tn_drawn_step *steps;
    size_t count;
    tn_status status = tn_chains_join(path, &steps, &count);
    const tn_drawn_path joined = {steps, count, path->even_odd};
    if (status == TN_OK)
        status = stroke_path(d, &joined, pen, ink) ? outcome(d) : TN_MEMORY;
    free(steps);
    return status;
}

/* ---- hatches */

static bool put_boundary(dxf *d, const tn_drawn_path *path)
{
    tn_buffer *to = d->now.entities;
    size_t count = 0;
    bool fine = true, closed;
    for (size_t i = 0; i < path->count; i++)
        count += path->steps[i].kind == TN_DRAWN_MOVE;
    tn_buffer_printf(to, "91\n%zu\n", count);
    for (size_t i = 0, end; fine && i < path->count; i = end) {
        end = collect(d, path, i, &closed, &fine);
        bool bulges = false;
        for (size_t k = 0; k < d->corner_count; k++)
            bulges |= d->corners[k].bulge != 0;
        tn_buffer_printf(to, "92\n3\n72\n%d\n73\n1\n93\n%zu\n", bulges, d->corner_count);
        put_corners(d, bulges);
        tn_buffer_printf(to, "97\n0\n");
    }
    return fine;
}

/* Up to where the pattern is said. */
static bool begin_hatch(dxf *d, const tn_drawn_path *path, const char *pattern, bool solid)
{
    put_class(d, "AcDbHatch");
    tn_buffer_printf(d->now.entities, "10\n0.0\n20\n0.0\n30\n0.0\n210\n0.0\n220\n0.0\n230\n1.0\n2\n%s\n70\n%d\n71\n0\n",
                     pattern, solid);
    if (!put_boundary(d, path))
        return false;
    tn_buffer_printf(d->now.entities, "75\n0\n76\n%d\n", solid ? 1 : 2);
    return true;
}

static void end_hatch(dxf *d)
{
    tn_buffer_printf(d->now.entities, "98\n1\n10\n0.0\n20\n0.0\n");
}

static tn_status fill(tn_device *device, const tn_drawn_path *path, const tn_ink *ink)
{
    dxf *d = (dxf *)device;
    if (ink->opacity < 1 || fmin(fmin(ink->red, ink->green), ink->blue) >= WHITE)
        return TN_OK;
    begin(d, "HATCH");
    put_colour(d, ink);
    if (!begin_hatch(d, path, "SOLID", true))
        return TN_MEMORY;
    end_hatch(d);
    return outcome(d);
}

/* The lines of one direction: a point on one, where the next is from it, and its dashes. */
static void put_hatch_lines(dxf *d, const tn_hatched *h, const tn_hatch_lines *lines)
{
    double scale = h->scale * d->now.by.scale, turn[2] = {tn_cos(h->angle), tn_sin(h->angle)}, at[2],
           angle = lines->angle * WHOLE / 360 - h->angle, along[2] = {tn_cos(angle), tn_sin(angle)};
    map(&d->now, h->x + h->scale * (turn[0] * lines->x - turn[1] * lines->y),
        h->y + h->scale * (turn[1] * lines->x + turn[0] * lines->y), at);
    tn_buffer *to = d->now.entities;
    int dashes = lines->dashes[0] > 0 ? 2 : 0;
    tn_dxf_put(to, 53, degrees(angle));
    tn_dxf_put(to, 43, at[0]);
    tn_dxf_put(to, 44, at[1]);
    tn_dxf_put(to, 45, scale * (lines->shift * along[0] - lines->apart * along[1]));
    tn_dxf_put(to, 46, scale * (lines->shift * along[1] + lines->apart * along[0]));
    tn_buffer_printf(to, "79\n%d\n", dashes);
    if (dashes) {
        tn_dxf_put(to, 49, scale * lines->dashes[0]);
        tn_dxf_put(to, 49, -scale * lines->dashes[1]);
    }
}

static tn_status hatch(tn_device *device, const tn_drawn_path *path, const tn_hatched *hatched, const tn_pen *pen,
                       const tn_ink *ink)
{
    dxf *d = (dxf *)device;
    size_t count;
    const tn_hatch_lines *lines = tn_hatch_made_of(hatched->hatch, &count);
    begin(d, "HATCH");
    if (!put_pen(d, pen, ink) || !begin_hatch(d, path, tn_hatch_name(hatched->hatch), false))
        return TN_MEMORY;
    tn_buffer_printf(d->now.entities, "52\n0.0\n");
    tn_dxf_put(d->now.entities, 41,
               hatched->scale * lines->apart * d->now.by.scale / (d->content.options.feet ? 0.125 : 3.175));
    tn_buffer_printf(d->now.entities, "77\n0\n78\n%zu\n", count);
    for (size_t i = 0; i < count; i++)
        put_hatch_lines(d, hatched, &lines[i]);
    end_hatch(d);
    return outcome(d);
}

/* ---- lettering */

static tn_status write_lettering(tn_device *device, const tn_lettering *l, const tn_ink *ink)
{
    dxf *d = (dxf *)device;
    double at[2];
    (void)ink;
    map(&d->now, l->x, l->y, at);
    begin(d, "TEXT");
    put_class(d, "AcDbText");
    put_point(d, 10, at[0], at[1]);
    tn_dxf_put(d->now.entities, 40, TN_LETTERING_CAPITALS * l->size * d->now.by.scale);
    tn_dxf_put_text(d->now.entities, 1, l->text);
    tn_dxf_put(d->now.entities, 50, degrees(-l->angle));
    tn_buffer_printf(d->now.entities, "7\n%s\n", l->bold ? "BOLD" : "STANDARD");
    if (l->align != TN_ALIGN_LEFT) {
        tn_buffer_printf(d->now.entities, "72\n%d\n", l->align == TN_ALIGN_CENTRE ? 1 : 2);
        put_point(d, 11, at[0], at[1]);
    }
    put_class(d, "AcDbText");
    if (d->now.owner != TN_DXF_MODEL && d->now.owner != TN_DXF_PAPER && d->content.dimension_text == 0)
        d->content.dimension_text = TN_LETTERING_CAPITALS * l->size * tn_dxf_paper_unit(&d->content.options);
    widen(d, at);
    return outcome(d);
}

/* Pictures that are written as DXF have none. */
static tn_status refuse_pixels(tn_device *device, const tn_pixels *pixels)
{
    (void)device, (void)pixels;
    return TN_INTERNAL;
}

static tn_status ignore_clip(tn_device *device, const tn_drawn_path *path)
{
    (void)device, (void)path;
    return TN_OK;
}

static tn_status end_ignored(tn_device *device)
{
    (void)device;
    return TN_OK;
}

/* ---- blocks */

/* A name that no block has yet: letters, digits, `-` and `_`, with a number at its end if need be. */
static char *name_block(const tn_dxf_content *c, const char *wanted)
{
    tn_buffer name = {0};
    for (unsigned number = 1; !name.failed; number++) {
        bool taken = false;
        name.size = 0;
        tn_buffer_printf(&name, "%s", wanted);
        for (size_t i = wanted[0] == '*'; i < name.size && !name.failed; i++)
            if (!isalnum((unsigned char)name.data[i]) && name.data[i] != '_')
                name.data[i] = '-';
        if (number > 1)
            tn_buffer_printf(&name, "-%u", number);
        for (size_t i = 0; i < c->block_count && !name.failed; i++)
            taken |= strcmp(c->blocks[i].name, name.data) == 0;
        if (!taken)
            break;
    }
    if (!name.failed)
        return name.data;
    free(name.data);
    return NULL;
}

/* What is drawn goes into a new block. */
static tn_status begin_block(dxf *d, const char *name, mapping by)
{
    tn_dxf_content *c = &d->content;
    char *own = name_block(c, name);
    if (!own || !tn_array_reserve(&c->blocks, &c->block_capacity, c->block_count, 1, sizeof *c->blocks)) {
        free(own);
        return TN_MEMORY;
    }
    tn_dxf_block *b = &c->blocks[c->block_count++];
    *b = (tn_dxf_block){.name = own, .scale = by.scale};
    b->record = take_handle(d);
    b->begin = take_handle(d);
    b->end = take_handle(d);
    d->before = d->now;
    d->now = (place){&b->entities, b->record, by, false};
    return TN_OK;
}

static tn_status end_block(dxf *d)
{
    tn_status status = outcome(d);
    d->now = d->before;
    return status;
}

static tn_status begin_symbol(tn_device *device, size_t number, const char *name)
{
    dxf *d = (dxf *)device;
    if (!tn_array_reserve(&d->symbols, &d->symbol_capacity, number, 1, sizeof *d->symbols))
        return TN_MEMORY;
    d->symbols[number] = d->content.block_count;
    d->symbol_count = number + 1;
    return begin_block(d, name, (mapping){.scale = d->now.by.scale});
}

static tn_status end_symbol(tn_device *device)
{
    return end_block((dxf *)device);
}

static tn_status use_symbol(tn_device *device, size_t number, const tn_symbol_place *where)
{
    dxf *d = (dxf *)device;
    const tn_dxf_block *block = &d->content.blocks[d->symbols[number]];
    double at[2], scale = d->now.by.scale / block->scale;
    map(&d->now, where->x, where->y, at);
    begin(d, "INSERT");
    put_class(d, "AcDbBlockReference");
    tn_buffer_printf(d->now.entities, "2\n%s\n", block->name);
    put_point(d, 10, at[0], at[1]);
    tn_dxf_put(d->now.entities, 41, where->mirrored ? -scale : scale);
    tn_dxf_put(d->now.entities, 42, scale);
    tn_dxf_put(d->now.entities, 43, scale);
    tn_dxf_put(d->now.entities, 50, degrees(-where->angle));
    widen(d, at);
    return outcome(d);
}

/* ---- dimensions: each has a block that shows it, for programs that do not draw dimensions themselves */

static tn_status begin_dimension(tn_device *device, const tn_drawn_dimension *dimension)
{
    dxf *d = (dxf *)device;
    char name[24];
    snprintf(name, sizeof name, "*D%u", (unsigned)++d->dimension_count);
    d->dimension = d->content.block_count;
    d->dimension_at = *dimension;
    map(&d->now, dimension->from[0], dimension->from[1], d->dimension_at.from);
    map(&d->now, dimension->to[0], dimension->to[1], d->dimension_at.to);
    for (int i = 0; i < 2; i++)
        map(&d->now, dimension->line[i][0], dimension->line[i][1], d->dimension_at.line[i]);
    map(&d->now, dimension->text_at[0], dimension->text_at[1], d->dimension_at.text_at);
    return begin_block(d, name, d->now.by);
}

/* The number before what `after` holds; *text moves behind both. */
static double number_before(const char **text, const char *after)
{
    double number = 0, divisor = 0;
    for (; isdigit((unsigned char)**text) || **text == '.'; ++*text) {
        divisor = **text == '.' ? 1 : divisor * 10;
        number = **text == '.' ? number : number * 10 + (**text - '0');
    }
    *text += strspn(*text, after);
    return divisor > 0 ? number / divisor : number;
}

/* Feet and inches, the latter with a fraction. */
static double inches_of(const char **text)
{
    double feet = strchr(*text, '\'') ? number_before(text, "' -") : 0, inches = number_before(text, " -\"");
    if (**text == '/') {
        ++*text;
        double parts = number_before(text, "\"");
        return 12 * feet + (parts > 0 ? inches / parts : 0);
    }
    if (**text) {
        double over = number_before(text, "/"), parts = number_before(text, "\"");
        inches += parts > 0 ? over / parts : 0;
    }
    return 12 * feet + inches;
}

/* Is that what programs write for the length by the style of dimensions? Others have their text given. The first that
 * says its length chooses the style: metres with their unit, or without it, or millimetres. */
static bool says_length(tn_dxf_content *content, const char *text, double length)
{
    bool feet = content->options.feet, unit = strchr(text, 'm') != NULL;
    double said = feet ? inches_of(&text) : number_before(&text, " m"), near = 1e-4 * fmax(1, length);
    tn_dxf_measure measure = feet                                 ? TN_DXF_FEET
                             : fabs(said * 1000 - length) <= near ? (unit ? TN_DXF_METRES_NAMED : TN_DXF_METRES)
                                                                  : TN_DXF_MILLIMETRES;
    if (*text || (measure == TN_DXF_MILLIMETRES && unit))
        return false;
    if (fabs(said * (measure == TN_DXF_METRES || measure == TN_DXF_METRES_NAMED ? 1000 : 1) - length) > near)
        return false;
    if (content->measure == TN_DXF_UNSAID)
        content->measure = measure;
    return content->measure == measure;
}

static tn_status end_dimension(tn_device *device)
{
    dxf *d = (dxf *)device;
    const tn_drawn_dimension *at = &d->dimension_at;
    double length = hypot(at->line[1][0] - at->line[0][0], at->line[1][1] - at->line[0][1]);
    tn_status status = end_block(d);
    begin(d, "DIMENSION");
    put_class(d, "AcDbDimension");
    tn_buffer_printf(d->now.entities, "2\n%s\n", d->content.blocks[d->dimension].name);
    put_point(d, 10, at->line[1][0], at->line[1][1]);
    if (at->moved)
        put_point(d, 11, at->text_at[0], at->text_at[1]);
    else
        put_point(d, 11, (at->line[0][0] + at->line[1][0]) / 2, (at->line[0][1] + at->line[1][1]) / 2);
    tn_buffer_printf(d->now.entities, "70\n%d\n71\n%d\n", at->moved ? 160 : 32, at->moved ? 5 : 8);
    tn_dxf_put(d->now.entities, 42, length);
    if (!at->text[0])
        tn_buffer_printf(d->now.entities, "1\n \n"); /* a blank: nothing is written */
    else if (says_length(&d->content, at->text, length))
        tn_buffer_printf(d->now.entities, "1\n\n");
    else
        tn_dxf_put_text(d->now.entities, 1, at->text);
    tn_buffer_printf(d->now.entities, "3\nSTANDARD\n");
    put_class(d, "AcDbAlignedDimension");
    put_point(d, 13, at->from[0], at->from[1]);
    put_point(d, 14, at->to[0], at->to[1]);
    tn_dxf_put(d->now.entities, 50,
               degrees(tn_atan2(at->line[1][1] - at->line[0][1], at->line[1][0] - at->line[0][0])));
    put_class(d, "AcDbRotatedDimension");
    for (int i = 0; i < 2; i++)
        widen(d, at->line[i]);
    widen(d, at->from);
    widen(d, at->to);
    return status == TN_OK ? outcome(d) : status;
}

/* ---- views */

/* 1:scale of a view. */
static double scale_of(const dxf *d, const tn_drawn_view *view)
{
    return d->content.options.scale * view->smaller;
}

/* Views stand in model space as they do on the sheet, but for their origins, which are whole steps apart. */
static mapping map_view(dxf *d, const tn_drawn_view *view)
{
    const tn_dxf_options *options = &d->content.options;
    mapping by = {.scale = tn_dxf_paper_unit(options) * scale_of(d, view), .from = {view->origin[0], view->origin[1]}};
    double step = options->feet ? GRID_INCH : GRID_MM;
    if (d->viewport_count == 0)
        memcpy(d->first_origin, view->origin, sizeof d->first_origin);
    by.to[0] = round((view->origin[0] - d->first_origin[0]) * by.scale / step) * step;
    by.to[1] = round((d->first_origin[1] - view->origin[1]) * by.scale / step) * step;
    return by;
}

/* A window in the sheet, through which a part of model space is seen. number: 1 is the sheet itself. low: the lower
 * left corner of the part. */
static void put_viewport(dxf *d, uint32_t number, const double paper[4], const double low[2], double scale)
{
    double width = paper[2] - paper[0], height = paper[3] - paper[1];
    tn_buffer *to = d->now.entities;
    begin_on(d, "VIEWPORT", TN_LAYER_VIEWPORT);
    put_class(d, "AcDbViewport");
    put_point(d, 10, (paper[0] + paper[2]) / 2, (paper[1] + paper[3]) / 2);
    tn_dxf_put(to, 40, width);
    tn_dxf_put(to, 41, height);
    tn_buffer_printf(to, "68\n%u\n69\n%u\n", (unsigned)number, (unsigned)number);
    tn_dxf_put(to, 12, low[0] + width * scale / 2);
    tn_dxf_put(to, 22, low[1] + height * scale / 2);
    tn_buffer_printf(
        to, "13\n0.0\n23\n0.0\n14\n10.0\n24\n10.0\n15\n10.0\n25\n10.0\n16\n0.0\n26\n0.0\n36\n1.0\n17\n0.0\n27\n"
            "0.0\n37\n0.0\n42\n50.0\n43\n0.0\n44\n0.0\n");
    tn_dxf_put(to, 45, height * scale);
    tn_buffer_printf(to,
                     "50\n0.0\n51\n0.0\n72\n100\n90\n%d\n1\n\n281\n0\n71\n1\n74\n0\n110\n0.0\n120\n0.0\n130\n0.0\n111\n"
                     "1.0\n121\n0.0\n131\n0.0\n112\n0.0\n122\n1.0\n132\n0.0\n79\n0\n146\n0.0\n",
                     number > 1 ? 16384 : 0); /* its scale is locked */
}

static tn_status begin_view(tn_device *device, const tn_drawn_view *view)
{
    dxf *d = (dxf *)device;
    if (d->content.options.scale <= 0)
        return TN_OK;
    double corners[4], low[2];
    place model = {&d->content.model, TN_DXF_MODEL, map_view(d, view), false};
    d->now = d->sheet;
    map(&d->sheet, view->x, view->y + view->height, corners);
    map(&d->sheet, view->x + view->width, view->y, corners + 2);
    map(&model, view->x, view->y + view->height, low);
    d->now.entities = &d->viewports;
    put_viewport(d, ++d->viewport_count + 1, corners, low, scale_of(d, view));
    widen(d, corners);
    widen(d, corners + 2);
    d->now = model;
    return d->viewports.failed ? TN_MEMORY : TN_OK;
}

static tn_status end_view(tn_device *device)
{
    dxf *d = (dxf *)device;
    d->now = d->sheet;
    return TN_OK;
}

/* ---- the picture */

/* The sheet's own window comes first, then the others, which programs want in this order. */
static tn_status finish(tn_device *device, tn_watch *watch, tn_error *error)
{
    dxf *d = (dxf *)device;
    const tn_dxf_options *options = &d->content.options;
    double unit = tn_dxf_paper_unit(options), paper[4] = {0, 0, options->width * unit, options->height * unit};
    tn_buffer sheet = d->content.paper, first = {0};
    (void)watch;
    d->now = (place){.entities = &first, .owner = TN_DXF_PAPER, .paper = true};
    put_viewport(d, 1, paper, paper, 1);
    d->content.paper = first;
    if (d->viewports.size > 0)
        tn_buffer_append(&d->content.paper, d->viewports.data, d->viewports.size);
    if (sheet.size > 0)
        tn_buffer_append(&d->content.paper, sheet.data, sheet.size);
    d->content.paper.failed |= sheet.failed || d->viewports.failed;
    free(sheet.data);
    return tn_dxf_write(&d->content, d->out) == TN_OK ? TN_OK : tn_fail_memory(error);
}

static void free_dxf(tn_device *device)
{
    dxf *d = (dxf *)device;
    for (size_t i = 0; i < d->content.block_count; i++) {
        free(d->content.blocks[i].name);
        free(d->content.blocks[i].entities.data);
    }
    free(d->content.blocks);
    free(d->content.dashes);
    free(d->content.model.data);
    free(d->content.paper.data);
    free(d->viewports.data);
    free(d->symbols);
    free(d->corners);
    free(d);
}

tn_status tn_dxf_new(FILE *out, const tn_dxf_options *options, tn_device **device, tn_error *error)
{
    static const tn_device_operations operations = {
        .fill = fill,
        .stroke = stroke,
        .text = write_lettering,
        .pixels = refuse_pixels,
        .begin_clip = ignore_clip,
        .end_clip = end_ignored,
        .hatch = hatch,
        .begin_symbol = begin_symbol,
        .end_symbol = end_symbol,
        .use_symbol = use_symbol,
        .begin_dimension = begin_dimension,
        .end_dimension = end_dimension,
        .begin_view = begin_view,
        .end_view = end_view,
        .finish = finish,
        .free = free_dxf,
    };
    static const tn_dxf_box empty = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    dxf *d = calloc(1, sizeof *d);
    if (!d)
        return tn_fail_memory(error);
    bool to_scale = options->scale > 0;
    d->device.operations = &operations;
    d->device.outlines = true;
    d->out = out;
    d->content.options = *options;
    d->content.next_handle = TN_DXF_FIRST;
    d->content.model_box = d->content.paper_box = empty;
    d->sheet = (place){to_scale ? &d->content.paper : &d->content.model,
                       to_scale ? TN_DXF_PAPER : TN_DXF_MODEL,
                       {.scale = tn_dxf_paper_unit(options), .from = {0, options->height}},
                       to_scale};
    d->now = d->sheet;
    *device = &d->device;
    return TN_OK;
}
