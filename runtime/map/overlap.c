/* Pairs of triangles that overlap in the picture, found by halving the picture, and which of two is the nearer one
 * there. */
#include <math.h>
#include <stdlib.h>

#include "runtime/map/hidden_parts.h"

#define LEAF 24u       /* as many triangles are compared each with each */
#define DEPTH_MAX 48   /* halvings */
#define TOUCH 1e-9     /* of the picture: what overlaps less only touches */
#define ROUNDING 1e-14 /* of a slope: by so much rounding may move a depth */

typedef struct box {
    double low[2], high[2];
} box;

typedef struct search {
    const tn_scene *scene;
    const tn_seen_triangle *triangles;
    box *boxes;
    uint32_t *stack; /* lists of triangles, one on top of the other */
    size_t used, room;
    tn_pairs *befores;
    bool out_of_memory;
} search;

/* ---- two triangles */

/* Keeps the part of a polygon to the left of the line from a to b. */
static int clip_by(double (*polygon)[3], int count, const double *a, const double *b)
{
    double out[12][3], dx = b[0] - a[0], dy = b[1] - a[1];
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const double *p = polygon[i], *q = polygon[i + 1 == count ? 0 : i + 1];
        double at_p = dx * (p[1] - a[1]) - dy * (p[0] - a[0]), at_q = dx * (q[1] - a[1]) - dy * (q[0] - a[0]);
        if (at_p >= 0) {
            for (int k = 0; k < 3; k++)
                out[kept][k] = p[k];
            kept++;
        }
        if ((at_p < 0) != (at_q < 0)) {
            double t = at_p / (at_p - at_q);
            for (int k = 0; k < 3; k++)
                out[kept][k] = p[k] + t * (q[k] - p[k]);
            kept++;
        }
    }
    for (int i = 0; i < kept; i++)
        for (int k = 0; k < 3; k++)
            polygon[i][k] = out[i][k];
    return kept;
}

/* Where both are seen: is a nearer somewhere, is it farther somewhere? b is not seen as a line. */
static void compare(const tn_scene *scene, const tn_seen_triangle *a, const tn_seen_triangle *b, bool *nearer,
                    bool *farther)
{
    double polygon[12][3], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    double least = INFINITY, most = -INFINITY;
    int count = 3;
    *nearer = *farther = false;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            polygon[i][k] = scene->points[a->corner[i]][k];
    for (int i = 0; i < 3 && count > 0; i++)
        count = clip_by(polygon, count, scene->points[b->corner[i]], scene->points[b->corner[(i + 1) % 3]]);
    for (int i = 0; i < count; i++) {
        const double *p = polygon[i];
        double over = p[2] - (b->height + b->slope[0] * p[0] + b->slope[1] * p[1]);
        least = fmin(least, over);
        most = fmax(most, over);
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    if (!(high[0] - low[0] > TOUCH || high[1] - low[1] > TOUCH))
        return;
    double same = TOUCH + ROUNDING * (fabs(a->slope[0]) + fabs(a->slope[1]) + fabs(b->slope[0]) + fabs(b->slope[1]));
    *nearer = most > same;
    *farther = least < -same;
}

static void add(search *s, uint32_t far, uint32_t near)
{
    tn_pairs *list = s->befores;
    if (!tn_room_for_one((void **)&list->items, sizeof *list->items, list->count, &list->room)) {
        s->out_of_memory = true;
        return;
    }
    list->items[list->count++] = (tn_pair){far, near};
}

static void compare_pair(search *s, uint32_t i, uint32_t j)
{
    const tn_seen_triangle *a = &s->triangles[i], *b = &s->triangles[j];
    bool nearer, farther;
    if (b->edge_on) {
        const tn_seen_triangle *swap = a;
        a = b;
        b = swap;
    }
    if (b->edge_on)
        return; /* two lines: whichever is painted last */
    compare(s->scene, a, b, &nearer, &farther);
    if (nearer)
        add(s, b->face, a->face);
    if (farther)
        add(s, a->face, b->face);
}

/* ---- pairs */

/* A pair is looked at in the part of the picture that holds the low corner of what their boxes share. */
static void compare_all(search *s, const uint32_t *list, size_t count, const box *part)
{
    for (size_t i = 0; i < count; i++) {
        const box *a = &s->boxes[list[i]];
        for (size_t j = i + 1; j < count; j++) {
            const box *b = &s->boxes[list[j]];
            double x = fmax(a->low[0], b->low[0]), y = fmax(a->low[1], b->low[1]);
            if (x > fmin(a->high[0], b->high[0]) || y > fmin(a->high[1], b->high[1]))
                continue;
            bool here = x >= part->low[0] && x < part->high[0] && y >= part->low[1] && y < part->high[1];
            if (here && s->triangles[list[i]].face != s->triangles[list[j]].face)
                compare_pair(s, list[i], list[j]);
        }
    }
}

static bool reserve(search *s, size_t more)
{
    if (s->room - s->used < more) {
        size_t room = 2 * (s->used + more);
        uint32_t *grown = realloc(s->stack, room * sizeof *grown);
        if (!grown) {
            s->out_of_memory = true;
            return false;
        }
        s->stack = grown;
        s->room = room;
    }
    return true;
}

/* Of the list of `count` at `at`, those that reach into a part, put on top of the stack. */
static size_t choose(search *s, size_t at, size_t count, const box *part)
{
    size_t before = s->used;
    for (size_t i = 0; i < count; i++) {
        const box *b = &s->boxes[s->stack[at + i]];
        if (b->low[0] < part->high[0] && b->high[0] >= part->low[0] && b->low[1] < part->high[1] &&
            b->high[1] >= part->low[1])
            s->stack[s->used++] = s->stack[at + i];
    }
    return s->used - before;
}

static void search_part(search *s, size_t at, size_t count, const box *part, int depth)
{
    int axis = part->high[0] - part->low[0] < part->high[1] - part->low[1];
    double middle = part->low[axis] + (part->high[axis] - part->low[axis]) / 2;
    if (count <= LEAF || depth == DEPTH_MAX || !reserve(s, 2 * count)) {
        compare_all(s, s->stack + at, count, part);
        return;
    }
    box halves[2] = {*part, *part};
    halves[0].high[axis] = halves[1].low[axis] = middle;
    size_t before = s->used, counts[2], starts[2];
    for (int h = 0; h < 2; h++) {
        starts[h] = s->used;
        counts[h] = choose(s, at, count, &halves[h]);
    }
    if (4 * (counts[0] + counts[1]) > 7 * count) { /* nearly all lie across the middle */
        s->used = before;
        compare_all(s, s->stack + at, count, part);
        return;
    }
    for (int h = 0; h < 2 && !s->out_of_memory; h++)
        search_part(s, starts[h], counts[h], &halves[h], depth + 1);
    s->used = before;
}

static box find_boxes(search *s, size_t count)
{
    box all = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t t = 0; t < count; t++) {
        box *b = &s->boxes[t];
        for (int k = 0; k < 2; k++) {
            const uint32_t *c = s->triangles[t].corner;
            double p = s->scene->points[c[0]][k], q = s->scene->points[c[1]][k], r = s->scene->points[c[2]][k];
            b->low[k] = fmin(p, fmin(q, r));
            b->high[k] = fmax(p, fmax(q, r));
            all.low[k] = fmin(all.low[k], b->low[k]);
            all.high[k] = fmax(all.high[k], b->high[k] + 1); /* parts are half open */
        }
    }
    return all;
}

tn_status tn_overlaps_find(const tn_scene *scene, const tn_seen_triangle *triangles, size_t count, tn_pairs *befores,
                           tn_error *error)
{
    search s = {.scene = scene, .triangles = triangles, .befores = befores};
    *befores = (tn_pairs){0};
    s.boxes = malloc((count + 1) * sizeof *s.boxes);
    if (s.boxes && reserve(&s, count + 1)) {
        box all = find_boxes(&s, count);
        for (size_t t = 0; t < count; t++)
            s.stack[t] = (uint32_t)t;
        s.used = count;
        search_part(&s, 0, count, &all, 0);
    }
    bool failed = !s.boxes || s.out_of_memory;
    free(s.boxes);
    free(s.stack);
    return failed ? tn_fail_memory(error) : TN_OK;
}
