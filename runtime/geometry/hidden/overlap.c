/* Pairs of triangles that overlap in the picture, found by halving the picture, and which of two is the nearer one
 * there. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/crew.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/hidden/overlap.h"
#include "runtime/geometry/vector.h"

#define LEAF 24u       /* as many triangles are compared each with each */
#define DEPTH_MAX 48   /* halvings */
#define JOB_DEPTH 7    /* halvings, after which parts are searched by themselves, side by side */
#define JOB_SIZE 2048u /* triangles that are not worth more halvings before */
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
    tn_face_pairs befores;
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

/* Does all of b lie outside one side of a? a is not seen as a line. */
static bool outside(const tn_scene *scene, const tn_seen_triangle *a, const tn_seen_triangle *b)
{
    for (int i = 0; i < 3; i++) {
        const double *p = scene->points[a->corner[i]], *q = scene->points[a->corner[i == 2 ? 0 : i + 1]];
        double dx = q[0] - p[0], dy = q[1] - p[1];
        int out = 0;
        for (int j = 0; j < 3; j++) {
            const double *c = scene->points[b->corner[j]];
            out += dx * (c[1] - p[1]) - dy * (c[0] - p[0]) < 0;
        }
        if (out == 3)
            return true;
    }
    return false;
}

/* Where both are seen: is a nearer somewhere, is it farther somewhere? b is not seen as a line. */
static void compare(const tn_scene *scene, const tn_seen_triangle *a, const tn_seen_triangle *b, bool *nearer,
                    bool *farther)
{
    double polygon[12][3], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    double least = INFINITY, most = -INFINITY;
    int count = 3;
    *nearer = *farther = false;
    if (outside(scene, b, a) || (!a->edge_on && outside(scene, a, b)))
        return;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            polygon[i][k] = scene->points[a->corner[i]][k];
    for (int i = 0; i < 3 && count > 0; i++)
        count = clip_by(polygon, count, scene->points[b->corner[i]], scene->points[b->corner[(i + 1) % 3]]);
    for (int i = 0; i < count; i++) {
        const double *p = polygon[i];
        double over = p[2] - (b->height + b->slope[0] * p[0] + b->slope[1] * p[1]);
        least = tn_smaller(least, over);
        most = tn_larger(most, over);
        for (int k = 0; k < 2; k++) {
            low[k] = tn_smaller(low[k], p[k]);
            high[k] = tn_larger(high[k], p[k]);
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
    tn_face_pairs *list = &s->befores;
    if (!tn_array_reserve(&list->items, &list->room, list->count, 1, sizeof *list->items)) {
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

static bool apart(const box *a, const box *b)
{
    return a->low[0] > b->high[0] || b->low[0] > a->high[0] || a->low[1] > b->high[1] || b->low[1] > a->high[1];
}

/* A pair is looked at in the part of the picture that holds the low corner of what their boxes share. */
static void compare_all(search *s, const uint32_t *list, size_t count, const box *part)
{
    for (size_t i = 0; i < count; i++) {
        const box *a = &s->boxes[list[i]];
        for (size_t j = i + 1; j < count; j++) {
            const box *b = &s->boxes[list[j]];
            if (apart(a, b))
                continue;
            double x = tn_larger(a->low[0], b->low[0]), y = tn_larger(a->low[1], b->low[1]);
            bool here = x >= part->low[0] && x < part->high[0] && y >= part->low[1] && y < part->high[1];
            if (here && s->triangles[list[i]].face != s->triangles[list[j]].face)
                compare_pair(s, list[i], list[j]);
        }
    }
}

static bool reserve(search *s, size_t more)
{
    if (tn_array_reserve(&s->stack, &s->room, s->used, more, sizeof *s->stack))
        return true;
    s->out_of_memory = true;
    return false;
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

/* Puts the lists of a part's halves on top of the stack; false if that is not worth it. */
static bool halve(search *s, size_t at, size_t count, const box *part, box halves[2], size_t starts[2],
                  size_t counts[2])
{
    int axis = part->high[0] - part->low[0] < part->high[1] - part->low[1];
    double middle = part->low[axis] + (part->high[axis] - part->low[axis]) / 2;
    size_t before = s->used;
    if (!reserve(s, 2 * count))
        return false;
    halves[0] = halves[1] = *part;
    halves[0].high[axis] = halves[1].low[axis] = middle;
    for (int h = 0; h < 2; h++) {
        starts[h] = s->used;
        counts[h] = choose(s, at, count, &halves[h]);
    }
    if (4 * (counts[0] + counts[1]) <= 7 * count)
        return true;
    s->used = before; /* nearly all lie across the middle */
    return false;
}

static void search_part(search *s, size_t at, size_t count, const box *part, int depth)
{
    box halves[2];
    size_t before = s->used, starts[2], counts[2];
    if (count <= LEAF || depth == DEPTH_MAX || !halve(s, at, count, part, halves, starts, counts)) {
        compare_all(s, s->stack + at, count, part);
        return;
    }
    for (int h = 0; h < 2 && !s->out_of_memory; h++)
        search_part(s, starts[h], counts[h], &halves[h], depth + 1);
    s->used = before;
}

/* ---- parts side by side: their pairs are put together in the order of one search of all */

typedef struct job {
    size_t at, count; /* its list on the stack of the search of all */
    box part;
    int depth;
    tn_face_pairs befores;
    bool out_of_memory;
} job;

typedef struct jobs {
    search all;
    job *items;
    size_t count, room;
} jobs;

static void add_jobs(jobs *j, size_t at, size_t count, const box *part, int depth)
{
    box halves[2];
    size_t starts[2], counts[2];
    if (count > JOB_SIZE && depth < JOB_DEPTH && halve(&j->all, at, count, part, halves, starts, counts)) {
        for (int h = 0; h < 2 && !j->all.out_of_memory; h++)
            add_jobs(j, starts[h], counts[h], &halves[h], depth + 1);
        return;
    }
    if (tn_array_reserve(&j->items, &j->room, j->count, 1, sizeof *j->items))
        j->items[j->count++] = (job){.at = at, .count = count, .part = *part, .depth = depth};
    else
        j->all.out_of_memory = true;
}

static void do_job(void *context, uint32_t number)
{
    const jobs *j = context;
    job *one = &j->items[number];
    search s = {.scene = j->all.scene, .triangles = j->all.triangles, .boxes = j->all.boxes};
    if (one->count > 0 && reserve(&s, one->count)) {
        memcpy(s.stack, j->all.stack + one->at, one->count * sizeof *s.stack);
        s.used = one->count;
        search_part(&s, 0, one->count, &one->part, one->depth);
    }
    free(s.stack);
    one->befores = s.befores;
    one->out_of_memory = s.out_of_memory;
}

static tn_status do_jobs(jobs *j, tn_error *error)
{
    const tn_scene *scene = j->all.scene;
    tn_crew *crew = tn_crew_new(scene->threads > 1 ? (unsigned)scene->threads : 1, scene->watch);
    tn_status status = crew ? tn_crew_share(crew, (uint32_t)j->count, do_job, j, error) : tn_fail_memory(error);
    tn_crew_free(crew);
    return status;
}

/* All jobs' pairs, which are freed. False: out of memory. */
static bool gather(jobs *j, tn_face_pairs *befores)
{
    size_t count = 0;
    bool fine = !j->all.out_of_memory;
    for (size_t i = 0; i < j->count; i++) {
        count += j->items[i].befores.count;
        fine = fine && !j->items[i].out_of_memory;
    }
    if (fine)
        *befores = (tn_face_pairs){.items = malloc((count + 1) * sizeof *befores->items), .room = count + 1};
    fine = fine && befores->items;
    for (size_t i = 0; i < j->count; i++) {
        const tn_face_pairs *list = &j->items[i].befores;
        if (fine && list->count)
            memcpy(befores->items + befores->count, list->items, list->count * sizeof *list->items);
        befores->count += fine ? list->count : 0;
        free(list->items);
    }
    return fine;
}

static box find_boxes(search *s, size_t count)
{
    box all = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t t = 0; t < count; t++) {
        box *b = &s->boxes[t];
        for (int k = 0; k < 2; k++) {
            const uint32_t *c = s->triangles[t].corner;
            double p = s->scene->points[c[0]][k], q = s->scene->points[c[1]][k], r = s->scene->points[c[2]][k];
            b->low[k] = tn_smaller(p, tn_smaller(q, r));
            b->high[k] = tn_larger(p, tn_larger(q, r));
            all.low[k] = tn_smaller(all.low[k], b->low[k]);
            all.high[k] = tn_larger(all.high[k], b->high[k] + 1); /* parts are half open */
        }
    }
    return all;
}

tn_status tn_overlaps_find(const tn_scene *scene, const tn_seen_triangle *triangles, size_t count,
                           tn_face_pairs *befores, tn_error *error)
{
    jobs j = {.all = {.scene = scene, .triangles = triangles}};
    search *s = &j.all;
    tn_status status = TN_OK;
    *befores = (tn_face_pairs){0};
    s->boxes = malloc((count + 1) * sizeof *s->boxes);
    s->out_of_memory = !s->boxes;
    if (s->boxes && reserve(s, count + 1)) {
        box all = find_boxes(s, count);
        for (size_t t = 0; t < count; t++)
            s->stack[t] = (uint32_t)t;
        s->used = count;
        add_jobs(&j, 0, count, &all, 0);
        if (!s->out_of_memory)
            status = do_jobs(&j, error);
    }
    bool fine = gather(&j, befores);
    free(j.items);
    free(s->boxes);
    free(s->stack);
    return fine || status != TN_OK ? status : tn_fail_memory(error);
}
