/* Draws pictures as PNG and PDF by cairo. */
#include "runtime/draw/cairo/cairo.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "runtime/base/watch.h"

/* ==== writes PNG files (ISO/IEC 15948): 8 bits a colour, filter `up` in every row */

/* Level 4 takes two thirds of the time of zlib's own choice, 6, for 3 % more bytes of a shaded picture. */
enum { BUFFER = 1 << 16, FILTER_UP = 2, COLOUR = 2, LEVEL = 4 };

typedef struct png {
    FILE *out;
    z_stream packer;
    unsigned char *row, *packed; /* owned: the filter's number and the row; BUFFER bytes */
    bool begun;                  /* the packer */
} png;

static void put_number(unsigned char *to, uint32_t number)
{
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(number >> (24 - 8 * i));
}

static bool write_chunk(const png *p, const char *name, const unsigned char *data, uint32_t size)
{
    unsigned char head[8], tail[4];
    put_number(head, size);
    memcpy(head + 4, name, 4);
    uLong sum = crc32(crc32(0, head + 4, 4), data, size);
    put_number(tail, (uint32_t)sum);
    return fwrite(head, 1, 8, p->out) == 8 && fwrite(data, 1, size, p->out) == size && fwrite(tail, 1, 4, p->out) == 4;
}

static bool write_head(const png *p, uint32_t width, uint32_t height)
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    unsigned char head[13] = {0};
    put_number(head, width);
    put_number(head + 4, height);
    head[8] = 8;
    head[9] = COLOUR;
    return fwrite(signature, 1, 8, p->out) == 8 && write_chunk(p, "IHDR", head, sizeof head);
}

/* The row's colours less those of the row above it, or (NULL) as they are. */
static void filter_row(const uint32_t *pixels, const uint32_t *above, uint32_t width, unsigned char *row)
{
    *row++ = FILTER_UP;
    for (uint32_t x = 0; x < width; x++) {
        uint32_t here = pixels[x], before = above ? above[x] : 0;
        for (int shift = 16; shift >= 0; shift -= 8)
            *row++ = (unsigned char)((here >> shift) - (before >> shift));
    }
}

/* Packs what is given, and writes what that fills of chunks; `flush`: all. */
static bool pack(png *p, size_t size, int flush)
{
    int state;
    p->packer.next_in = p->row;
    p->packer.avail_in = (uInt)size;
    do {
        state = deflate(&p->packer, flush);
        uint32_t filled = BUFFER - p->packer.avail_out;
        if (p->packer.avail_out > 0 && state != Z_STREAM_END)
            continue;
        if (filled && !write_chunk(p, "IDAT", p->packed, filled))
            return false;
        p->packer.next_out = p->packed;
        p->packer.avail_out = BUFFER;
    } while (p->packer.avail_in || (flush == Z_FINISH && state != Z_STREAM_END));
    return true;
}

static cairo_status_t write_rows(png *p, cairo_surface_t *image, uint32_t width, uint32_t height, tn_watch *watch)
{
    const unsigned char *data = cairo_image_surface_get_data(image);
    size_t stride = (size_t)cairo_image_surface_get_stride(image);
    const uint32_t *above = NULL;
    for (uint32_t y = 0; y < height; y++) {
        const uint32_t *pixels = (const uint32_t *)(const void *)(data + y * stride);
        if (y % 64 == 0 && tn_watch_stopped(watch))
            return CAIRO_STATUS_WRITE_ERROR;
        filter_row(pixels, above, width, p->row);
        above = pixels;
        if (!pack(p, 1 + 3 * (size_t)width, Z_NO_FLUSH))
            return CAIRO_STATUS_WRITE_ERROR;
    }
    bool done = pack(p, 0, Z_FINISH) && write_chunk(p, "IEND", p->packed, 0);
    return done ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

/* The image is of CAIRO_FORMAT_RGB24. CAIRO_STATUS_WRITE_ERROR where the stream cannot be written, or the watch (or
 * NULL) says that it is time to end; CAIRO_STATUS_NO_MEMORY. */
static cairo_status_t png_write(cairo_surface_t *image, FILE *out, tn_watch *watch)
{
    uint32_t width = (uint32_t)cairo_image_surface_get_width(image),
             height = (uint32_t)cairo_image_surface_get_height(image);
    png p = {.out = out, .row = malloc(1 + 3 * (size_t)width), .packed = malloc(BUFFER)};
    cairo_surface_flush(image);
    p.packer.next_out = p.packed;
    p.packer.avail_out = BUFFER;
    p.begun = p.row && p.packed && deflateInit(&p.packer, LEVEL) == Z_OK;
    cairo_status_t status = CAIRO_STATUS_NO_MEMORY;
    if (p.begun)
        status = write_head(&p, width, height) ? write_rows(&p, image, width, height, watch) : CAIRO_STATUS_WRITE_ERROR;
    if (p.begun)
        deflateEnd(&p.packer);
    free(p.row);
    free(p.packed);
    return status;
}

enum { SIDE_MAX = 32767 };

/* Pictures carry no time, so that they can be made again bit for bit; PDF wants one, and this is the first it can hold.
 */
static const char constant_date[] = "2000-01-01T00:00:00Z";

typedef struct cairo_device {
    tn_device device;
    FILE *out;
    tn_watch *watch; /* or NULL */
    cairo_surface_t *surface;
    cairo_t *context;
    bool is_png;
} cairo_device;

static cairo_t *context_of(tn_device *device)
{
    return ((cairo_device *)device)->context;
}

static tn_status status_of(tn_device *device)
{
    switch (cairo_status(context_of(device))) {
    case CAIRO_STATUS_SUCCESS:
        return TN_OK;
    case CAIRO_STATUS_NO_MEMORY:
        return TN_MEMORY;
    case CAIRO_STATUS_WRITE_ERROR:
        return TN_IO;
    default:
        return TN_INTERNAL;
    }
}

/* ---- operations */

static void trace(cairo_t *context, const tn_drawn_path *path)
{
    cairo_new_path(context);
    for (size_t i = 0; i < path->count; i++) {
        const tn_drawn_step *step = &path->steps[i];
        if (step->kind == TN_DRAWN_MOVE)
            cairo_move_to(context, step->x, step->y);
        else if (step->kind == TN_DRAWN_LINE)
            cairo_line_to(context, step->x, step->y);
        else if (step->kind == TN_DRAWN_CLOSE)
            cairo_close_path(context);
        else if (step->to < step->from)
            cairo_arc_negative(context, step->x, step->y, step->radius, step->from, step->to);
        else
            cairo_arc(context, step->x, step->y, step->radius, step->from, step->to);
    }
    cairo_set_fill_rule(context, path->even_odd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
}

static void take_ink(cairo_t *context, const tn_ink *ink)
{
    cairo_set_source_rgba(context, ink->red, ink->green, ink->blue, ink->opacity);
}

static tn_status fill(tn_device *device, const tn_drawn_path *path, const tn_ink *ink)
{
    trace(context_of(device), path);
    take_ink(context_of(device), ink);
    cairo_fill(context_of(device));
    return status_of(device);
}

static tn_status stroke(tn_device *device, const tn_drawn_path *path, const tn_pen *pen, const tn_ink *ink)
{
    cairo_t *context = context_of(device);
    trace(context, path);
    take_ink(context, ink);
    cairo_set_line_width(context, pen->width);
    cairo_set_line_cap(context, pen->cap == TN_CAP_ROUND ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(context, pen->join == TN_JOIN_ROUND ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
    cairo_set_dash(context, pen->dashes, (int)pen->dash_count, pen->dash_offset);
    cairo_stroke(context);
    return status_of(device);
}

/* Without hints, so that widths do not depend on the resolution. A font that stands in for DejaVu Sans has other widths
 * than those that lines were broken by: what is centred or stands to the right goes by its own. */
static tn_status write_text(tn_device *device, const tn_lettering *l, const tn_ink *ink)
{
    cairo_t *context = context_of(device);
    cairo_text_extents_t extents;
    cairo_save(context);
    cairo_translate(context, l->x, l->y);
    cairo_rotate(context, l->angle);
    cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           l->bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, l->size);
    cairo_text_extents(context, l->text, &extents);
    double shift = l->align == TN_ALIGN_LEFT ? 0 : extents.x_advance * (l->align == TN_ALIGN_RIGHT ? 1 : 0.5);
    cairo_move_to(context, -shift, 0);
    take_ink(context, ink);
    cairo_show_text(context, l->text);
    cairo_restore(context);
    return status_of(device);
}

static tn_status draw_pixels(tn_device *device, const tn_pixels *pixels)
{
    cairo_t *context = context_of(device);
    cairo_surface_t *image =
        cairo_image_surface_create_for_data((unsigned char *)(uintptr_t)pixels->values, CAIRO_FORMAT_ARGB32,
                                            (int)pixels->width, (int)pixels->height, (int)(4 * pixels->width));
    cairo_save(context);
    cairo_translate(context, pixels->x, pixels->y);
    cairo_scale(context, pixels->pixel, pixels->pixel);
    cairo_set_source_surface(context, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
    cairo_paint(context);
    cairo_restore(context);
    cairo_surface_destroy(image);
    return status_of(device);
}

static tn_status begin_clip(tn_device *device, const tn_drawn_path *path)
{
    cairo_save(context_of(device));
    trace(context_of(device), path);
    cairo_clip(context_of(device));
    return status_of(device);
}

static tn_status end_clip(tn_device *device)
{
    cairo_restore(context_of(device));
    return status_of(device);
}

/* ---- the picture */

static void begin_page(cairo_t *context)
{
    cairo_set_source_rgb(context, 1, 1, 1);
    cairo_paint(context);
}

static tn_status next_page(tn_device *device, double width, double height)
{
    if (((cairo_device *)device)->is_png)
        return TN_INTERNAL;
    cairo_show_page(context_of(device));
    cairo_pdf_surface_set_size(((cairo_device *)device)->surface, width, height);
    begin_page(context_of(device));
    return status_of(device);
}

static tn_status tell(cairo_status_t status, tn_error *error)
{
    if (status == CAIRO_STATUS_SUCCESS)
        return TN_OK;
    if (status == CAIRO_STATUS_NO_MEMORY)
        return tn_fail_memory(error);
    if (status == CAIRO_STATUS_WRITE_ERROR)
        return tn_fail(error, TN_IO, E_CANNOT_WRITE, "the picture cannot be written");
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the picture cannot be drawn: %s", cairo_status_to_string(status));
}

static tn_status finish(tn_device *device, tn_watch *watch, tn_error *error)
{
    cairo_device *d = (cairo_device *)device;
    cairo_show_page(d->context);
    cairo_status_t drawn = cairo_status(d->context);
    if (drawn == CAIRO_STATUS_SUCCESS && d->is_png)
        drawn = png_write(d->surface, d->out, watch);
    cairo_surface_finish(d->surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        drawn = cairo_surface_status(d->surface);
    return tell(drawn, error);
}

static void free_device(tn_device *device)
{
    cairo_device *d = (cairo_device *)device;
    if (d->context)
        cairo_destroy(d->context);
    if (d->surface)
        cairo_surface_destroy(d->surface);
    free(d);
}

static cairo_device *new_device(FILE *out, tn_watch *watch)
{
    static const tn_device_operations operations = {
        .fill = fill,
        .stroke = stroke,
        .text = write_text,
        .pixels = draw_pixels,
        .begin_clip = begin_clip,
        .end_clip = end_clip,
        .next_page = next_page,
        .finish = finish,
        .free = free_device,
    };
    cairo_device *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    made->device.operations = &operations;
    made->out = out;
    made->watch = watch;
    return made;
}

static void choose_lettering(cairo_t *context)
{
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(context, options);
    cairo_font_options_destroy(options);
}

/* The surface is there: a context on it. */
static tn_status begin(cairo_device *made, tn_device **device, tn_error *error)
{
    made->context = cairo_create(made->surface);
    cairo_set_miter_limit(made->context, TN_MITRE_LIMIT);
    choose_lettering(made->context);
    begin_page(made->context);
    tn_status status = tell(cairo_status(made->context), error);
    if (status == TN_OK)
        *device = &made->device;
    else
        free_device(&made->device);
    return status;
}

static tn_status check_size(double width, double height, double dpi, tn_error *error)
{
    if (width <= SIDE_MAX && height <= SIDE_MAX && width * height <= (double)TN_PNG_PIXELS_MAX)
        return TN_OK;
    tn_status status = tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE,
                               "the picture would have %.0f x %.0f pixels; the limit is %d a side and %llu in all",
                               width, height, SIDE_MAX, (unsigned long long)TN_PNG_PIXELS_MAX);
    tn_error_help(error, "draw fewer plans, lower --dpi (now %.0f), or make a .pdf, which has pages", dpi);
    return status;
}

tn_status tn_png_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error)
{
    double dpi = options->dpi, width = ceil(options->width * dpi / 72), height = ceil(options->height * dpi / 72);
    *device = NULL;
    tn_status status = check_size(width, height, dpi, error);
    if (status != TN_OK)
        return status;
    cairo_device *made = new_device(out, watch);
    if (!made)
        return tn_fail_memory(error);
    made->is_png = true;
    made->device.pixel = 72 / dpi;
    made->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    cairo_surface_set_device_scale(made->surface, dpi / 72, dpi / 72);
    return begin(made, device, error);
}

static cairo_status_t write_bytes(void *closure, const unsigned char *bytes, unsigned int size)
{
    const cairo_device *d = closure;
    if (tn_watch_stopped(d->watch))
        return CAIRO_STATUS_WRITE_ERROR;
    return fwrite(bytes, 1, size, d->out) == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

tn_status tn_pdf_new(FILE *out, const tn_cairo_options *options, tn_watch *watch, tn_device **device, tn_error *error)
{
    *device = NULL;
    cairo_device *made = new_device(out, watch);
    if (!made)
        return tn_fail_memory(error);
    made->surface = cairo_pdf_surface_create_for_stream(write_bytes, made, options->width, options->height);
    cairo_pdf_surface_set_metadata(made->surface, CAIRO_PDF_METADATA_CREATE_DATE, constant_date);
    cairo_pdf_surface_set_metadata(made->surface, CAIRO_PDF_METADATA_MOD_DATE, constant_date);
    cairo_pdf_surface_set_metadata(made->surface, CAIRO_PDF_METADATA_CREATOR, "tartan");
    if (options->title)
        cairo_pdf_surface_set_metadata(made->surface, CAIRO_PDF_METADATA_TITLE, options->title);
    return begin(made, device, error);
}
