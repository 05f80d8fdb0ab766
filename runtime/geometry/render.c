/* Places cameras, lights surfaces, and paints triangles into pixels. */
#include "runtime/geometry/render.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/math/elementary.h"

/* ---- places cameras, and lights surfaces */

tn_camera tn_camera_default(void)
{
    return (tn_camera){-60, 30, 480};
}

tn_eye tn_camera_eye(const tn_camera *camera)
{
    double ca = tn_cos_degrees(camera->azimuth), sa = tn_sin_degrees(camera->azimuth);
    double ce = tn_cos_degrees(camera->elevation), se = tn_sin_degrees(camera->elevation);
    return (tn_eye){{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

tn_vector tn_eye_sees(const tn_eye *eye, tn_vector place)
{
    return (tn_vector){tn_dot(place, eye->right), tn_dot(place, eye->up), tn_dot(place, eye->towards)};
}

static double light_of_lamp(const tn_eye *eye, tn_vector normal)
{
    tn_vector lamp = tn_normalised(tn_add(tn_add(eye->towards, tn_scale(eye->up, 0.9)), tn_scale(eye->right, -0.6)));
    return 0.35 + 0.65 * fmax(0, tn_dot(normal, lamp));
}

double tn_eye_light(const tn_eye *eye, tn_vector normal)
{
    return light_of_lamp(eye, tn_dot(normal, eye->towards) < 0 ? tn_scale(normal, -1) : normal);
}

/* The same for smooth forms, which turn away from the lamp: some of the light comes from the eye, and only the side
 * that the normal points to is lit. */
static double eye_light_around(const tn_eye *eye, tn_vector normal)
{
    return 0.7 * light_of_lamp(eye, normal) + 0.3 * fabs(tn_dot(normal, eye->towards));
}

/* ---- paints triangles into pixels with a depth buffer. Each pixel is four points, so that outlines are smooth */

#define FINE 2u             /* points along a pixel's side */
#define SMOOTH_COSINE 0.766 /* of 40 degrees */
/* A triangle that is less high than this share of its longest side says little of how the surface lies there. */
#define THIN 0.05

typedef struct buffer {
    uint32_t width, height; /* points */
    float *depth, *light;   /* [height][width] */
} buffer;

/* A corner as it lies in the buffer, with its light. */
typedef struct corner {
    double x, y, depth, light;
} corner;

/* The colour of a surface by its light: 0 to 1 each. */
static void light_colour(double light, double rgb[3])
{
    rgb[0] = 0.98 * light;
    rgb[1] = 0.97 * light;
    rgb[2] = 0.93 * light;
}

/* Something that changes evenly over a triangle: by so much from point to point along x and y. */
typedef struct slope {
    double along_x, along_y, least, most;
} slope;

static slope slope_of(const corner c[3], double whole, double v0, double v1, double v2)
{
    double d1 = v1 - v0, d2 = v2 - v0;
    return (slope){.along_x = (d1 * (c[2].y - c[0].y) - d2 * (c[1].y - c[0].y)) / whole,
                   .along_y = (d2 * (c[1].x - c[0].x) - d1 * (c[2].x - c[0].x)) / whole,
                   .least = tn_smaller(v0, tn_smaller(v1, v2)),
                   .most = tn_larger(v0, tn_larger(v1, v2))};
}

/* Between the corners' values: where a triangle is a sliver, the slopes are not to be trusted. */
static double between(const slope *s, double value)
{
    return tn_smaller(tn_larger(value, s->least), s->most);
}

/* Where the line at height y runs through the triangle. A side gives both triangles that share it the same end, so
 * that nothing shows through between them. */
static void find_span(const corner c[3], double y, double *from, double *to)
{
    *from = INFINITY;
    *to = -INFINITY;
    for (int k = 0; k < 3; k++) {
        const corner *p = &c[k], *q = &c[(k + 1) % 3];
        if (q->y < p->y || (q->y == p->y && q->x < p->x)) {
            const corner *swap = p;
            p = q;
            q = swap;
        }
        if (y < p->y || y > q->y)
            continue;
        double x = q->y > p->y ? p->x + (y - p->y) * ((q->x - p->x) / (q->y - p->y)) : p->x;
        double other = q->y > p->y ? x : q->x;
        *from = tn_smaller(*from, tn_smaller(x, other));
        *to = tn_larger(*to, tn_larger(x, other));
    }
}

/* The first point at or behind x, whose middle lies half a point on. */
static uint32_t point_from(double x, uint32_t end)
{
    double at = ceil(x - 0.5);
    return at < 0 ? 0 : at > end ? end : (uint32_t)at;
}

static void fill_triangle(buffer *to, const corner c[3])
{
    double whole = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x), from, until;
    if (whole == 0)
        return;
    slope depths = slope_of(c, whole, c[0].depth, c[1].depth, c[2].depth);
    slope lights = slope_of(c, whole, c[0].light, c[1].light, c[2].light);
    uint32_t last = point_from(tn_larger(c[0].y, tn_larger(c[1].y, c[2].y)) + 1, to->height);
    for (uint32_t y = point_from(tn_smaller(c[0].y, tn_smaller(c[1].y, c[2].y)), to->height); y < last; y++) {
        double down = y + 0.5 - c[0].y;
        find_span(c, y + 0.5, &from, &until);
        for (uint32_t x = point_from(from, to->width); x < to->width && x + 0.5 <= until; x++) {
            size_t at = (size_t)y * to->width + x;
            double right = x + 0.5 - c[0].x;
            float depth = (float)between(&depths, c[0].depth + right * depths.along_x + down * depths.along_y);
            if (!(depth > to->depth[at]))
                continue;
            to->depth[at] = depth;
            to->light[at] = (float)between(&lights, c[0].light + right * lights.along_x + down * lights.along_y);
        }
    }
}

/* The vertices before the eye, with the light of their normals. */
static void look(const tn_mesh *mesh, const double *normals, const tn_eye *eye, const tn_render_frame *frame,
                 corner *corners)
{
    double points = FINE / frame->pixel;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        tn_vector seen = tn_eye_sees(eye, tn_vector_at(mesh->positions + 3 * v));
        corners[v] = (corner){(seen.x - frame->left) * points, (frame->top - seen.y) * points, seen.z,
                              eye_light_around(eye, tn_vector_at(normals + 3 * v))};
    }
}

static double longest_side(const tn_vector at[3])
{
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = tn_larger(most, tn_norm(tn_sub(at[(k + 1) % 3], at[k])));
    return most;
}

/* A triangle as it is painted. */
typedef struct facet {
    tn_vector normals[3]; /* of its vertices */
    tn_vector face;       /* its own, of unit length */
    bool thin;            /* only those of the vertices say how it lies */
    bool behind;          /* it is seen from behind */
} facet;

static facet facet_of(const tn_mesh *mesh, const double *normals, const tn_eye *eye, size_t f)
{
    const uint32_t *corners = mesh->corners + mesh->face_first[f];
    facet one;
    tn_vector at[3], sum = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        at[k] = tn_vector_at(mesh->positions + 3 * (size_t)corners[k]);
        one.normals[k] = tn_vector_at(normals + 3 * (size_t)corners[k]);
        sum = tn_add(sum, one.normals[k]);
    }
    tn_vector face = tn_cross(tn_sub(at[1], at[0]), tn_sub(at[2], at[0]));
    double longest = longest_side(at);
    one.thin = tn_norm(face) < THIN * longest * longest && tn_norm(sum) > 0;
    one.face = tn_normalised(face);
    one.behind = !(tn_dot(one.thin ? sum : one.face, eye->towards) > 0);
    return one;
}

/* The light of a corner is by the vertex's normal, unless the surface has an edge there. What is seen from behind has
 * normals that look the other way. */
static void paint(const tn_mesh *mesh, const double *normals, const tn_eye *eye, const corner *seen, bool open,
                  buffer *to)
{
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corners = mesh->corners + mesh->face_first[f];
        const facet one = facet_of(mesh, normals, eye, f);
        corner c[3];
        if (one.behind && !open)
            continue;
        for (int k = 0; k < 3; k++) {
            bool edge = !one.thin && tn_dot(one.normals[k], one.face) < SMOOTH_COSINE;
            tn_vector normal = edge ? one.face : one.normals[k];
            c[k] = seen[corners[k]];
            if (edge || one.behind)
                c[k].light = eye_light_around(eye, one.behind ? tn_scale(normal, -1) : normal);
        }
        fill_triangle(to, c);
    }
}

/* A pixel from its points. */
static uint32_t pixel_of(const buffer *from, uint32_t x, uint32_t y)
{
    double light = 0, rgb[3];
    uint32_t covered = 0;
    for (uint32_t k = 0; k < FINE * FINE; k++) {
        size_t at = (size_t)(FINE * y + k / FINE) * from->width + FINE * x + k % FINE;
        if (from->depth[at] == -INFINITY)
            continue;
        covered++;
        light += (double)from->light[at];
    }
    if (covered == 0)
        return 0;
    light_colour(light / (FINE * FINE), rgb);
    uint32_t pixel = (uint32_t)(255.0 * covered / (FINE * FINE) + 0.5) << 24;
    for (int i = 0; i < 3; i++)
        pixel |= (uint32_t)(255 * rgb[i] + 0.5) << (16 - 8 * i);
    return pixel;
}

tn_status tn_mesh_render(const tn_mesh *mesh, const double *normals, const tn_eye *eye, const tn_render_frame *frame,
                         uint32_t **image, tn_error *error)
{
    buffer to = {.width = FINE * frame->width, .height = FINE * frame->height};
    size_t points = (size_t)to.width * to.height;
    corner *seen = malloc((mesh->vertex_count + 1) * sizeof *seen);
    to.depth = malloc((points + 1) * sizeof *to.depth);
    to.light = malloc((points + 1) * sizeof *to.light);
    *image = malloc(((size_t)frame->width * frame->height + 1) * sizeof **image);
    bool room = seen && to.depth && to.light && *image;
    for (size_t i = 0; room && i < points; i++)
        to.depth[i] = -INFINITY;
    if (room) {
        look(mesh, normals, eye, frame, seen);
        paint(mesh, normals, eye, seen, frame->open, &to);
    }
    for (uint32_t y = 0; room && y < frame->height; y++)
        for (uint32_t x = 0; x < frame->width; x++)
            (*image)[(size_t)y * frame->width + x] = pixel_of(&to, x, y);
    free(seen);
    free(to.depth);
    free(to.light);
    if (room)
        return TN_OK;
    free(*image);
    *image = NULL;
    return tn_fail_memory(error);
}
