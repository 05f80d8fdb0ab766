/* Reads grey pictures in the PGM format of Netpbm, which any program of pictures writes. */
#include "runtime/place/heights.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE_MAX = 65536, PIXELS_MAX = 1 << 26, MOST_MAX = 65535 };

typedef struct reader {
    const uint8_t *next, *end;
    tn_error *error;
} reader;

static tn_status wrong(const reader *r, const char *what)
{
    return tn_fail(r->error, TN_INVALID, TN_CODE_NONE, "%s", what);
}

static bool is_blank(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Blanks, and comments, which go from # to the end of the line. */
static void skip(reader *r)
{
    while (r->next < r->end && (is_blank(*r->next) || *r->next == '#')) {
        bool comment = *r->next++ == '#';
        while (comment && r->next < r->end && *r->next != '\n')
            r->next++;
    }
}

static tn_status read_number(reader *r, uint32_t most, const char *what, uint32_t *number)
{
    uint64_t value = 0;
    skip(r);
    if (r->next == r->end || *r->next < '0' || *r->next > '9')
        return tn_fail(r->error, TN_INVALID, TN_CODE_NONE, "%s is missing", what);
    for (; r->next < r->end && *r->next >= '0' && *r->next <= '9' && value <= most; r->next++)
        value = 10 * value + (uint64_t)(*r->next - '0');
    *number = (uint32_t)value;
    return value <= most
               ? TN_OK
               : tn_fail(r->error, TN_LIMIT, TN_CODE_NONE, "%s is above %u, which is the most", what, (unsigned)most);
}

static tn_status read_text(reader *r, tn_heights *heights, size_t count)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        uint32_t value = 0;
        status = read_number(r, heights->most, "the brightness of a pixel", &value);
        heights->values[i] = (uint16_t)value;
    }
    return status;
}

static tn_status read_binary(reader *r, tn_heights *heights, size_t count)
{
    size_t wide = heights->most > 255 ? 2 : 1;
    if (r->next == r->end || !is_blank(*r->next))
        return wrong(r, "a blank is missing behind the brightness of white");
    r->next++;
    if ((size_t)(r->end - r->next) < count * wide)
        return wrong(r, "it ends before its last pixel");
    for (size_t i = 0; i < count; i++) {
        const uint8_t *p = r->next + wide * i;
        heights->values[i] = (uint16_t)(wide == 2 ? p[0] << 8 | p[1] : p[0]);
        if (heights->values[i] > heights->most)
            return wrong(r, "a pixel is brighter than white");
    }
    return TN_OK;
}

tn_status tn_heights_read(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error)
{
    reader r = {bytes, bytes + size, error};
    *heights = (tn_heights){0};
    if (size < 3 || bytes[0] != 'P' || (bytes[1] != '2' && bytes[1] != '5'))
        return wrong(&r, "it is no PGM picture, which begins with P2 or P5");
    r.next += 2;
    tn_status status = read_number(&r, SIDE_MAX, "the width", &heights->width);
    if (status == TN_OK)
        status = read_number(&r, SIDE_MAX, "the height", &heights->depth);
    if (status == TN_OK)
        status = read_number(&r, MOST_MAX, "the brightness of white", &heights->most);
    size_t count = (size_t)heights->width * heights->depth;
    if (status == TN_OK && (count == 0 || heights->most == 0))
        status = wrong(&r, "it has no pixels, or no brightness");
    if (status == TN_OK && count > PIXELS_MAX)
        status = tn_fail(error, TN_LIMIT, TN_CODE_NONE, "it has more than %d pixels", PIXELS_MAX);
    if (status == TN_OK && !(heights->values = malloc(count * sizeof *heights->values)))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    return bytes[1] == '2' ? read_text(&r, heights, count) : read_binary(&r, heights, count);
}

void tn_heights_clear(tn_heights *heights)
{
    free(heights->values);
    *heights = (tn_heights){0};
}

/* The pixels whose middles lie before and behind a place, and how far it is from the first to the second. */
static double between(double share, uint32_t count, uint32_t pixels[2])
{
    double at = share * count - 0.5, last = count - 1;
    at = at > 0 ? (at < last ? at : last) : 0;
    double whole = floor(at);
    pixels[0] = (uint32_t)whole;
    pixels[1] = pixels[0] + 1 < count ? pixels[0] + 1 : pixels[0];
    return at - whole;
}

double tn_heights_at(const tn_heights *heights, double across, double down)
{
    uint32_t x[2], y[2];
    double u = between(across, heights->width, x), v = between(down, heights->depth, y), row[2];
    for (int i = 0; i < 2; i++) {
        const uint16_t *line = heights->values + (size_t)y[i] * heights->width;
        row[i] = line[x[0]] * (1 - u) + line[x[1]] * u;
    }
    return (row[0] * (1 - v) + row[1] * v) / heights->most;
}
