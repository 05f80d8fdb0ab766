/* Paints triangles into pixels with a depth buffer. Each pixel is four points, so that outlines are smooth. */
#include "runtime/geometry/render.h"

#include <math.h>
#include <stdlib.h>

#define FINE 2u             /* points along a pixel's side */
#define SMOOTH_COSINE 0.766 /* of 40 degrees */

typedef struct buffer {
    uint32_t width, height; /* points */
    float *depth, *light;   /* [height][width] */
} buffer;

/* A corner as it lies in the buffer, with its light. */
typedef struct corner {
    double x, y, depth, light;
} corner;

void tn_light_colour(double light, double rgb[3])
{
    rgb[0] = 0.98 * light;
    rgb[1] = 0.97 * light;
    rgb[2] = 0.93 * light;
}

static double clamped(double x, double high)
{
    return x < 0 ? 0 : x > high ? high : x;
}

/* Twice the area of a, b and the point: above 0 where it lies to the left. */
static double side(const corner *a, const corner *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

static void fill_triangle(buffer *to, const corner c[3])
{
    double whole = side(&c[0], &c[1], c[2].x, c[2].y);
    if (whole == 0)
        return;
    uint32_t x0 = (uint32_t)clamped(floor(fmin(c[0].x, fmin(c[1].x, c[2].x))), to->width);
    uint32_t x1 = (uint32_t)clamped(ceil(fmax(c[0].x, fmax(c[1].x, c[2].x))) + 1, to->width);
    uint32_t y0 = (uint32_t)clamped(floor(fmin(c[0].y, fmin(c[1].y, c[2].y))), to->height);
    uint32_t y1 = (uint32_t)clamped(ceil(fmax(c[0].y, fmax(c[1].y, c[2].y))) + 1, to->height);
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = x0; x < x1; x++) {
            double w[3], px = x + 0.5, py = y + 0.5;
            for (int k = 0; k < 3; k++)
                w[k] = side(&c[(k + 1) % 3], &c[(k + 2) % 3], px, py) / whole;
            if (w[0] < 0 || w[1] < 0 || w[2] < 0)
                continue;
            size_t at = (size_t)y * to->width + x;
            float depth = (float)(w[0] * c[0].depth + w[1] * c[1].depth + w[2] * c[2].depth);
            if (!(depth > to->depth[at]))
                continue;
            to->depth[at] = depth;
            to->light[at] = (float)(w[0] * c[0].light + w[1] * c[1].light + w[2] * c[2].light);
        }
}

/* The light of a corner: by the vertex's normal, turned to the face's side, unless the surface has an edge there. */
static double corner_light(const tn_eye *eye, tn_vector face, const double *normal)
{
    tn_vector smooth = tn_vector_at(normal);
    return tn_eye_light_around(eye, tn_dot(smooth, face) < SMOOTH_COSINE ? face : smooth);
}

static void paint(const tn_mesh *mesh, const double *normals, const tn_eye *eye, const tn_render_frame *frame,
                  buffer *to)
{
    double points = FINE / frame->pixel;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corners = mesh->corners + mesh->face_first[f];
        tn_vector at[3];
        corner c[3];
        for (int k = 0; k < 3; k++)
            at[k] = tn_vector_at(mesh->positions + 3 * (size_t)corners[k]);
        tn_vector face = tn_normalised(tn_cross(tn_sub(at[1], at[0]), tn_sub(at[2], at[0])));
        for (int k = 0; k < 3; k++) {
            tn_vector seen = tn_eye_sees(eye, at[k]);
            c[k] = (corner){(seen.x - frame->left) * points, (frame->top - seen.y) * points, seen.z,
                            corner_light(eye, face, normals + 3 * (size_t)corners[k])};
        }
        fill_triangle(to, c);
    }
}

/* A pixel from its points. */
static uint32_t pixel_of(const buffer *from, uint32_t x, uint32_t y)
{
    double sum[3] = {0}, rgb[3];
    uint32_t covered = 0;
    for (uint32_t k = 0; k < FINE * FINE; k++) {
        size_t at = (size_t)(FINE * y + k / FINE) * from->width + FINE * x + k % FINE;
        if (from->depth[at] == -INFINITY)
            continue;
        covered++;
        tn_light_colour((double)from->light[at], rgb);
        for (int i = 0; i < 3; i++)
            sum[i] += rgb[i];
    }
    uint32_t pixel = (uint32_t)lrint(255.0 * covered / (FINE * FINE)) << 24;
    for (int i = 0; i < 3; i++)
        pixel |= (uint32_t)lrint(255.0 * sum[i] / (FINE * FINE)) << (16 - 8 * i);
    return pixel;
}

tn_status tn_mesh_render(const tn_mesh *mesh, const double *normals, const tn_eye *eye, const tn_render_frame *frame,
                         uint32_t **image, tn_error *error)
{
    buffer to = {.width = FINE * frame->width, .height = FINE * frame->height};
    size_t points = (size_t)to.width * to.height;
    to.depth = malloc((points + 1) * sizeof *to.depth);
    to.light = malloc((points + 1) * sizeof *to.light);
    *image = malloc(((size_t)frame->width * frame->height + 1) * sizeof **image);
    bool room = to.depth && to.light && *image;
    for (size_t i = 0; room && i < points; i++)
        to.depth[i] = -INFINITY;
    if (room)
        paint(mesh, normals, eye, frame, &to);
    for (uint32_t y = 0; room && y < frame->height; y++)
        for (uint32_t x = 0; x < frame->width; x++)
            (*image)[(size_t)y * frame->width + x] = pixel_of(&to, x, y);
    free(to.depth);
    free(to.light);
    if (room)
        return TN_OK;
    free(*image);
    *image = NULL;
    return tn_fail_memory(error);
}
