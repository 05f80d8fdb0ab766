/* Reads PNG pictures by cairo, and takes their luminance. */
#include "runtime/place/picture/heights_png.h"

#include <cairo.h>
#include <stdlib.h>

enum { HEADER = 24, SIDE_MAX = 32767, PIXELS_MAX = 1 << 24, MOST = 65535 };

typedef struct stream {
    const uint8_t *next, *end;
} stream;

static cairo_status_t give(void *closure, unsigned char *to, unsigned int count)
{
    stream *from = closure;
    if ((size_t)(from->end - from->next) < count)
        return CAIRO_STATUS_READ_ERROR;
    memcpy(to, from->next, count);
    from->next += count;
    return CAIRO_STATUS_SUCCESS;
}

static uint32_t number_at(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

/* The header comes first, so that what is too large is not unpacked. */
static tn_status read_size(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error)
{
    if (size < HEADER || memcmp(bytes + 12, "IHDR", 4) != 0)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "it is no PNG picture, though it begins as one");
    heights->width = number_at(bytes + 16);
    heights->depth = number_at(bytes + 20);
    if (heights->width == 0 || heights->depth == 0)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "it has no pixels");
    if (heights->width > SIDE_MAX || heights->depth > SIDE_MAX)
        return tn_fail(error, TN_LIMIT, TN_CODE_NONE, "it has more than %d pixels along a side", SIDE_MAX);
    return (uint64_t)heights->width * heights->depth <= PIXELS_MAX
               ? TN_OK
               : tn_fail(error, TN_LIMIT, TN_CODE_NONE, "it has more than %d pixels", PIXELS_MAX);
}

/* Of pictures with errors, too, cairo says that there is no memory. */
static tn_status refuse(cairo_status_t status, tn_error *error)
{
    return tn_fail(error, TN_INVALID, TN_CODE_NONE,
                   status == CAIRO_STATUS_READ_ERROR ? "it ends before its last pixel"
                                                      : "it has errors, or there is no memory for it");
}

/* Of three parts from 0 to 1. */
static uint16_t luminance(double red, double green, double blue)
{
    return (uint16_t)(MOST * (0.2126 * red + 0.7152 * green + 0.0722 * blue) + 0.5);
}

/* Colours of pictures with 8 bits are bytes of a word; those with 16 are floats, where cairo knows these. */
static bool take_row(const uint8_t *row, cairo_format_t format, uint32_t width, uint16_t *to)
{
    size_t floats = 0;
#if CAIRO_VERSION >= CAIRO_VERSION_ENCODE(1, 17, 2)
    floats = format == CAIRO_FORMAT_RGB96F ? 3 : format == CAIRO_FORMAT_RGBA128F ? 4 : 0;
#endif
    if (floats == 0 && format != CAIRO_FORMAT_RGB24 && format != CAIRO_FORMAT_ARGB32)
        return false;
    for (uint32_t x = 0; x < width; x++) {
        if (floats) {
            float colour[3];
            memcpy(colour, row + x * floats * sizeof *colour, sizeof colour);
            to[x] = luminance((double)colour[0], (double)colour[1], (double)colour[2]);
        } else {
            uint32_t pixel;
            memcpy(&pixel, row + x * sizeof pixel, sizeof pixel);
            to[x] = luminance((pixel >> 16 & 255) / 255.0, (pixel >> 8 & 255) / 255.0, (pixel & 255) / 255.0);
        }
    }
    return true;
}

static tn_status take_heights(cairo_surface_t *picture, tn_heights *heights, tn_error *error)
{
    const uint8_t *rows = cairo_image_surface_get_data(picture);
    size_t stride = (size_t)cairo_image_surface_get_stride(picture);
    heights->most = MOST;
    heights->values = malloc((size_t)heights->width * heights->depth * sizeof *heights->values);
    if (!heights->values)
        return tn_fail_memory(error);
    for (uint32_t y = 0; y < heights->depth; y++)
        if (!take_row(rows + y * stride, cairo_image_surface_get_format(picture), heights->width,
                      heights->values + (size_t)y * heights->width))
            return tn_fail(error, TN_INVALID, TN_CODE_NONE, "it is a PNG picture of a kind that cannot be read");
    return TN_OK;
}

tn_status tn_heights_read_png(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error)
{
    stream from = {bytes, bytes + size};
    *heights = (tn_heights){0};
    tn_status status = read_size(bytes, size, heights, error);
    if (status != TN_OK)
        return status;
    cairo_surface_t *picture = cairo_image_surface_create_from_png_stream(give, &from);
    cairo_status_t read = cairo_surface_status(picture);
    if (read != CAIRO_STATUS_SUCCESS)
        status = refuse(read, error);
    else if (cairo_image_surface_get_width(picture) != (int)heights->width ||
             cairo_image_surface_get_height(picture) != (int)heights->depth)
        status = refuse(CAIRO_STATUS_READ_ERROR, error);
    else
        status = take_heights(picture, heights, error);
    cairo_surface_destroy(picture);
    return status;
}
