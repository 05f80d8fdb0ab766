/* Faces that no order puts right are cut along one another's planes: a triangle divides the rest into what lies beyond
 * its plane, which is painted first, and what lies on the eye's side, which is painted last; and so on in each part
 * (binary space partition: Fuchs, Kedem, Naylor, "On visible surface generation by a priori tree structures", SIGGRAPH
 * 1980). */
#include <math.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/geometry/hidden/hidden_parts.h"

#define FLAT 1e-9       /* as near to a plane is on it; the whole scene is about 1 large */
#define CORNERS_MAX 64u /* of a piece; cutting a triangle makes no more in practice: then it stays as it is */
#define CANDIDATES 6u   /* dividing pieces that are tried, */
#define SAMPLE 200u     /* each on as many of the others */
#define LAST UINT32_MAX /* ends a list of pieces */

typedef struct piece {
    uint32_t first, count; /* corners in the painting */
    uint32_t face;
    uint32_t next;   /* of its list */
    double plane[4]; /* unit normal towards the eye, and how far along it */
} piece;

typedef struct piece_list {
    uint32_t first, last; /* valid where count > 0 */
    size_t count;
} piece_list;

typedef struct task {
    piece_list list;
    bool paint; /* as it is; otherwise divide it */
} task;

typedef struct cutting {
    tn_painting *painting;
    piece *pieces;
    size_t piece_count, piece_room;
    task *tasks;
    size_t task_count, task_room;
} cutting;

static bool add_corner(tn_painting *painting, const double *p, uint32_t side)
{
    size_t room = painting->corner_room, count = painting->corner_count;
    if (!tn_array_reserve(&painting->points, &room, count, 1, sizeof *painting->points) ||
        !tn_array_reserve(&painting->sides, &painting->corner_room, count, 1, sizeof *painting->sides))
        return false;
    for (int k = 0; k < 3; k++)
        painting->points[painting->corner_count][k] = p[k];
    painting->sides[painting->corner_count++] = side;
    return true;
}

static void append(cutting *c, piece_list *list, uint32_t number)
{
    c->pieces[number].next = LAST;
    if (list->count++ == 0)
        list->first = number;
    else
        c->pieces[list->last].next = number;
    list->last = number;
}

/* ---- triangles */

/* The side of the face that leads from one of its corners to another, or TN_CUT for a diagonal. */
static uint32_t side_between(const tn_scene *scene, uint32_t face, uint32_t from, uint32_t to)
{
    uint32_t first = scene->first[face], last = scene->first[face + 1] - 1;
    if (to == (from == last ? first : from + 1))
        return from;
    if (from == (to == last ? first : to + 1))
        return to;
    return TN_CUT;
}

/* The plane of a triangle, its normal towards the eye; false where it has no area. */
static bool plane_of(const tn_scene *scene, const tn_seen_triangle *t, double plane[4])
{
    const double *p = scene->points[t->corner[0]], *q = scene->points[t->corner[1]], *r = scene->points[t->corner[2]];
    double u[3], v[3], n[3];
    for (int k = 0; k < 3; k++) {
        u[k] = q[k] - p[k];
        v[k] = r[k] - p[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), sign = n[2] < 0 ? -1 : 1;
    plane[3] = 0;
    for (int k = 0; k < 3; k++) {
        plane[k] = sign * n[k] / size;
        plane[3] += plane[k] * p[k];
    }
    return size > 1e-18;
}

/* A triangle becomes a piece; one without an area is not seen. False without memory. */
static bool take_triangle(cutting *c, const tn_scene *scene, const tn_seen_triangle *t, piece_list *list)
{
    piece made = {.first = (uint32_t)c->painting->corner_count, .count = 3, .face = t->face};
    if (!plane_of(scene, t, made.plane))
        return true;
    if (!tn_array_reserve(&c->pieces, &c->piece_room, c->piece_count, 1, sizeof *c->pieces))
        return false;
    for (int k = 0; k < 3; k++) {
        uint32_t from = t->corner[k], to = t->corner[(k + 1) % 3];
        if (!add_corner(c->painting, scene->points[from], side_between(scene, t->face, from, to)))
            return false;
    }
    c->pieces[c->piece_count] = made;
    append(c, list, (uint32_t)c->piece_count++);
    return true;
}

/* ---- cutting */

static double height_over(const double plane[4], const double *p)
{
    double h = plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] - plane[3];
    return fabs(h) <= FLAT ? 0 : h;
}

/* On which sides of a plane a piece has corners that do not lie on it. */
static void sides_of(const cutting *c, const piece *p, const double plane[4], bool *over, bool *under)
{
    *over = *under = false;
    for (uint32_t i = p->first; i < p->first + p->count; i++) {
        double h = height_over(plane, c->painting->points[i]);
        *over |= h > 0;
        *under |= h < 0;
    }
    if (p->count >= CORNERS_MAX && *over)
        *under = false;
}

/* The part of a piece on one side of a plane (sign: 1 over, -1 under) as a new piece; LAST without memory. */
static uint32_t part_of(cutting *c, uint32_t number, const double plane[4], double sign)
{
    tn_painting *painting = c->painting;
    if (!tn_array_reserve(&c->pieces, &c->piece_room, c->piece_count, 1, sizeof *c->pieces))
        return LAST;
    piece old = c->pieces[number], part = old;
    part.first = (uint32_t)painting->corner_count;
    for (uint32_t i = 0; i < old.count; i++) {
        uint32_t a = old.first + i, b = old.first + (i + 1 == old.count ? 0 : i + 1), side = painting->sides[a];
        double p[3], q[3], x[3];
        for (int k = 0; k < 3; k++) { /* copies: the array may move */
            p[k] = painting->points[a][k];
            q[k] = painting->points[b][k];
        }
        double at_p = height_over(plane, p) * sign, at_q = height_over(plane, q) * sign;
        if (at_p >= 0 && !add_corner(painting, p, at_p == 0 && at_q < 0 ? TN_CUT : side))
            return LAST;
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
            for (int k = 0; k < 3; k++)
                x[k] = p[k] + at_p / (at_p - at_q) * (q[k] - p[k]);
            if (!add_corner(painting, x, at_p > 0 ? TN_CUT : side))
                return LAST;
        }
    }
    part.count = (uint32_t)painting->corner_count - part.first;
    c->pieces[c->piece_count] = part;
    return (uint32_t)c->piece_count++;
}

static bool push(cutting *c, piece_list list, bool paint)
{
    if (list.count == 0)
        return true;
    if (!tn_array_reserve(&c->tasks, &c->task_room, c->task_count, 1, sizeof *c->tasks))
        return false;
    c->tasks[c->task_count++] = (task){list, paint};
    return true;
}

/* How badly a piece would divide a list: pieces cut, and the parts' difference. */
static double badness(const cutting *c, const piece_list *list, uint32_t by, size_t stride)
{
    double cuts = 0, balance = 0;
    size_t i = 0;
    for (uint32_t n = list->first; n != LAST; n = c->pieces[n].next) {
        bool over, under;
        if (i++ % stride != 0)
            continue;
        sides_of(c, &c->pieces[n], c->pieces[by].plane, &over, &under);
        cuts += over && under;
        balance += (double)over - (double)under;
    }
    return 4 * cuts + fabs(balance);
}

static uint32_t choose(const cutting *c, const piece_list *list)
{
    size_t every = list->count / CANDIDATES + 1, stride = list->count / SAMPLE + 1, i = 0;
    uint32_t best = list->first;
    double least = INFINITY;
    for (uint32_t n = list->first; n != LAST && list->count > 2; n = c->pieces[n].next) {
        if (i++ % every != 0)
            continue;
        double bad = badness(c, list, n, stride);
        if (bad < least) {
            least = bad;
            best = n;
        }
    }
    return best;
}

static tn_status divide(cutting *c, piece_list list, tn_error *error)
{
    piece_list far = {0}, near = {0}, level = {0};
    double plane[4];
    uint32_t by = choose(c, &list);
    for (int k = 0; k < 4; k++)
        plane[k] = c->pieces[by].plane[k];
    for (uint32_t n = list.first, next; n != LAST; n = next) {
        bool over, under;
        next = c->pieces[n].next;
        sides_of(c, &c->pieces[n], plane, &over, &under);
        if (n == by || (!over && !under)) {
            append(c, &level, n);
        } else if (over && under) {
            uint32_t upper = part_of(c, n, plane, 1), lower = upper == LAST ? LAST : part_of(c, n, plane, -1);
            if (lower == LAST)
                return tn_fail_memory(error);
            append(c, &near, upper);
            append(c, &far, lower);
        } else {
            append(c, over ? &near : &far, n);
        }
    }
    if (c->painting->corner_count > TN_PIECE_CORNERS_MAX)
        return TN_LIMIT;
    return push(c, near, false) && push(c, level, true) && push(c, far, false) ? TN_OK : tn_fail_memory(error);
}

static tn_status paint(cutting *c, piece_list list, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t n = list.first; n != LAST && status == TN_OK; n = c->pieces[n].next) {
        const piece *p = &c->pieces[n];
        status = tn_painting_add(c->painting, (tn_patch){p->face, p->first, p->count, true}, error);
    }
    return status;
}

tn_status tn_painting_cut(const tn_scene *scene, const tn_seen_triangle *triangles, const uint32_t *list, size_t count,
                          tn_painting *painting, tn_error *error)
{
    cutting c = {.painting = painting};
    piece_list all = {0};
    bool taken = true;
    for (size_t i = 0; i < count && taken; i++)
        taken = take_triangle(&c, scene, &triangles[list[i]], &all);
    tn_status status = taken && push(&c, all, false) ? TN_OK : tn_fail_memory(error);
    while (status == TN_OK && c.task_count > 0) {
        task next = c.tasks[--c.task_count];
        status = next.paint ? paint(&c, next.list, error) : divide(&c, next.list, error);
    }
    free(c.pieces);
    free(c.tasks);
    return status;
}
