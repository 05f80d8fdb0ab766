/* How far two PNG pictures of one size are apart: picture_distance A.png B.png [DIFFERENCE.png]
 *
 * Prints the root of the mean of the squares of what the colours differ by, black to white being 100; and the most that
 * a block of 24 by 24 pixels is darker or lighter as a whole, which is much where something is missing and little where
 * it is drawn a fraction of a pixel aside. The third picture shows where they differ. Status 2: they cannot be read, or
 * are not of one size. */
#include <cairo.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { BLOCK = 24 };

typedef struct picture {
    cairo_surface_t *surface;
    const unsigned char *bytes;
    int width, height, stride;
} picture;

static picture read_picture(const char *path)
{
    picture p = {.surface = cairo_image_surface_create_from_png(path)};
    if (cairo_surface_status(p.surface) != CAIRO_STATUS_SUCCESS) {
        fprintf(stderr, "picture_distance: %s cannot be read\n", path);
        exit(2);
    }
    p.bytes = cairo_image_surface_get_data(p.surface);
    p.width = cairo_image_surface_get_width(p.surface);
    p.height = cairo_image_surface_get_height(p.surface);
    p.stride = cairo_image_surface_get_stride(p.surface);
    return p;
}

/* A part of a colour: 0 blue, 1 green, 2 red. */
static int part_at(const picture *p, int x, int y, int part)
{
    uint32_t pixel = ((const uint32_t *)(const void *)(p->bytes + (size_t)y * (size_t)p->stride))[x];
    return (int)(pixel >> (8 * part) & 255);
}

static double distance(const picture *a, const picture *b)
{
    double sum = 0;
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++)
            for (int part = 0; part < 3; part++)
                sum += pow(part_at(a, x, y, part) - part_at(b, x, y, part), 2);
    return sqrt(sum / 3 / a->width / a->height) / 2.55;
}

/* The most that a block of pixels is darker or lighter as a whole. */
static double largest_of_blocks(const picture *a, const picture *b)
{
    double most = 0;
    for (int top = 0; top + BLOCK <= a->height; top += BLOCK / 2)
        for (int left = 0; left + BLOCK <= a->width; left += BLOCK / 2)
            for (int part = 0; part < 3; part++) {
                double difference = 0;
                for (int i = 0; i < BLOCK * BLOCK; i++)
                    difference += part_at(a, left + i % BLOCK, top + i / BLOCK, part) -
                                  part_at(b, left + i % BLOCK, top + i / BLOCK, part);
                most = fmax(most, fabs(difference));
            }
    return most / (BLOCK * BLOCK) / 2.55;
}

static void write_difference(const picture *a, const picture *b, const char *path)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, a->width, a->height);
    unsigned char *bytes = cairo_image_surface_get_data(surface);
    int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            uint32_t pixel = 0;
            for (int part = 0; part < 3; part++)
                pixel |= (uint32_t)(255 - abs(part_at(a, x, y, part) - part_at(b, x, y, part))) << (8 * part);
            ((uint32_t *)(void *)(bytes + (size_t)y * (size_t)stride))[x] = pixel;
        }
    cairo_surface_mark_dirty(surface);
    cairo_surface_write_to_png(surface, path);
    cairo_surface_destroy(surface);
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fputs("usage: picture_distance A.png B.png [DIFFERENCE.png]\n", stderr);
        return 2;
    }
    picture a = read_picture(argv[1]), b = read_picture(argv[2]);
    if (a.width != b.width || a.height != b.height) {
        fprintf(stderr, "picture_distance: %d x %d and %d x %d pixels\n", a.width, a.height, b.width, b.height);
        return 2;
    }
    printf("%.2f %.2f\n", distance(&a, &b), largest_of_blocks(&a, &b));
    if (argc > 3)
        write_difference(&a, &b, argv[3]);
    cairo_surface_destroy(a.surface);
    cairo_surface_destroy(b.surface);
    return 0;
}
