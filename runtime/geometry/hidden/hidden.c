/* Finds the order in which faces are painted: makes an order of what has to be painted before what, and cuts faces that
 * have none. */
#include "runtime/geometry/hidden/hidden.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/hidden/overlap.h"
#include "runtime/geometry/mesh.h"

/* Faces, and from each an arrow to every face that has to be painted after it. Faces that lead to one another have no
 * order: they are one knot. */
typedef struct paint_order {
    uint32_t count;
    uint32_t *arrow_first; /* [count + 1] */
    uint32_t *arrows;
    uint32_t *knot;       /* [face] */
    uint32_t *knot_first; /* [knot_count + 1] into members */
    uint32_t *members;    /* faces by knot */
    uint32_t knot_count;
    double *depth; /* [face] mean */
} paint_order;

/* Calls `paint` for each knot, the farthest of those first that nothing has to come before any more. */
typedef tn_status tn_paint_knot(void *user, uint32_t knot, tn_error *error);

static tn_status painting_add(tn_painting *painting, tn_patch patch, tn_error *error);

/* ==== from what has to be painted before what to an order */

#define NONE UINT32_MAX

static void order_clear(paint_order *order)
{
    free(order->arrow_first);
    free(order->arrows);
    free(order->knot);
    free(order->knot_first);
    free(order->members);
    free(order->depth);
    *order = (paint_order){0};
}

/* ---- knots: the strongly connected parts (Tarjan 1972), without recursion */

typedef struct visit {
    uint32_t *number, *low; /* [face] in the order of first visits, from 1 */
    uint32_t *open;         /* visited faces whose knot is not known yet */
    uint32_t *path, *next;  /* the way to the face at hand, and each one's next arrow */
    uint32_t opened, visited, depth;
} visit;

static void enter(const paint_order *o, visit *v, uint32_t face)
{
    v->number[face] = v->low[face] = ++v->visited;
    v->open[v->opened++] = face;
    v->path[v->depth] = face;
    v->next[v->depth++] = o->arrow_first[face];
}

static void leave(paint_order *o, visit *v)
{
    uint32_t face = v->path[--v->depth];
    if (v->depth > 0) {
        uint32_t above = v->path[v->depth - 1];
        v->low[above] = v->low[face] < v->low[above] ? v->low[face] : v->low[above];
    }
    if (v->low[face] != v->number[face])
        return;
    uint32_t member;
    do {
        member = v->open[--v->opened];
        o->knot[member] = o->knot_count;
    } while (member != face);
    o->knot_count++;
}

static void visit_from(paint_order *o, visit *v, uint32_t start)
{
    enter(o, v, start);
    while (v->depth > 0) {
        uint32_t face = v->path[v->depth - 1];
        if (v->next[v->depth - 1] == o->arrow_first[face + 1]) {
            leave(o, v);
            continue;
        }
        uint32_t to = o->arrows[v->next[v->depth - 1]++];
        if (v->number[to] == 0)
            enter(o, v, to);
        else if (o->knot[to] == NONE && v->number[to] < v->low[face])
            v->low[face] = v->number[to];
    }
}

static tn_status find_knots(paint_order *o, tn_error *error)
{
    uint32_t *space = calloc(5 * (size_t)o->count + 1, sizeof *space);
    if (!space)
        return tn_fail_memory(error);
    visit v = {space,
               space + o->count,
               space + 2 * (size_t)o->count,
               space + 3 * (size_t)o->count,
               space + 4 * (size_t)o->count,
               0,
               0,
               0};
    memset(o->knot, 0xff, o->count * sizeof *o->knot);
    for (uint32_t f = 0; f < o->count; f++)
        if (v.number[f] == 0)
            visit_from(o, &v, f);
    memset(o->knot_first, 0, (o->knot_count + 1) * sizeof *o->knot_first);
    for (uint32_t f = 0; f < o->count; f++)
        o->knot_first[o->knot[f] + 1]++;
    for (uint32_t k = 0; k < o->knot_count; k++)
        o->knot_first[k + 1] += o->knot_first[k];
    memcpy(space, o->knot_first, o->knot_count * sizeof *space);
    for (uint32_t f = 0; f < o->count; f++)
        o->members[space[o->knot[f]]++] = f;
    free(space);
    return TN_OK;
}

/* ---- painting: of all knots that nothing has to come before any more, the farthest */

typedef struct waiting {
    const paint_order *order;
    uint32_t *knots; /* a heap */
    uint32_t count;
} waiting;

static double depth_of(const paint_order *o, uint32_t knot)
{
    return o->depth[o->members[o->knot_first[knot]]];
}

static bool farther(const paint_order *o, uint32_t a, uint32_t b)
{
    double x = depth_of(o, a), y = depth_of(o, b);
    return x < y || (x == y && o->members[o->knot_first[a]] < o->members[o->knot_first[b]]);
}

static void put_in(waiting *w, uint32_t knot)
{
    uint32_t at = w->count++;
    for (; at > 0 && farther(w->order, knot, w->knots[(at - 1) / 2]); at = (at - 1) / 2)
        w->knots[at] = w->knots[(at - 1) / 2];
    w->knots[at] = knot;
}

static uint32_t farthest(waiting *w)
{
    uint32_t top = w->knots[0], last = w->knots[--w->count], at = 0;
    for (uint32_t child = 1; child < w->count; child = 2 * at + 1) {
        if (child + 1 < w->count && farther(w->order, w->knots[child + 1], w->knots[child]))
            child++;
        if (!farther(w->order, w->knots[child], last))
            break;
        w->knots[at] = w->knots[child];
        at = child;
    }
    w->knots[at] = last;
    return top;
}

static tn_status order_walk(const paint_order *o, tn_paint_knot *paint, void *user, tn_error *error)
{
    uint32_t *before = calloc(2 * (size_t)o->knot_count + 1, sizeof *before); /* knots to be painted first; the heap */
    if (!before)
        return tn_fail_memory(error);
    waiting w = {o, before + o->knot_count, 0};
    for (uint32_t f = 0; f < o->count; f++)
        for (uint32_t a = o->arrow_first[f]; a < o->arrow_first[f + 1]; a++)
            before[o->knot[o->arrows[a]]] += o->knot[o->arrows[a]] != o->knot[f];
    for (uint32_t k = 0; k < o->knot_count; k++)
        if (before[k] == 0)
            put_in(&w, k);
    tn_status status = TN_OK;
    while (w.count > 0 && status == TN_OK) {
        uint32_t knot = farthest(&w);
        status = paint(user, knot, error);
        for (uint32_t m = o->knot_first[knot]; m < o->knot_first[knot + 1]; m++) {
            uint32_t f = o->members[m];
            for (uint32_t a = o->arrow_first[f]; a < o->arrow_first[f + 1]; a++) {
                uint32_t to = o->knot[o->arrows[a]];
                if (to != knot && --before[to] == 0)
                    put_in(&w, to);
            }
        }
    }
    free(before);
    return status;
}

/* ---- */

static void point_arrows(paint_order *o, const tn_face_pairs *befores)
{
    for (size_t i = 0; i < befores->count; i++)
        o->arrow_first[befores->items[i].a + 1]++;
    for (uint32_t f = 0; f < o->count; f++)
        o->arrow_first[f + 1] += o->arrow_first[f];
    for (size_t i = befores->count; i-- > 0;) /* from each face's end down: its end becomes its start */
        o->arrows[--o->arrow_first[befores->items[i].a + 1]] = befores->items[i].b;
    memmove(o->arrow_first, o->arrow_first + 1, o->count * sizeof *o->arrow_first);
    o->arrow_first[o->count] = (uint32_t)befores->count;
}

/* Makes the order of a scene's faces. TN_LIMIT (E0820) for more than 2^32 pairs. Clear it in any case. */
static tn_status order_make(const tn_scene *scene, const tn_face_pairs *befores, paint_order *o, tn_error *error)
{
    size_t count = scene->face_count;
    *o = (paint_order){.count = scene->face_count};
    if (befores->count >= NONE) {
        tn_fail(error, TN_LIMIT, E_PICTURE_TOO_LARGE, "the faces of this picture overlap too often to be drawn");
        tn_error_help(error, "draw an earlier step, or write a mesh instead");
        return TN_LIMIT;
    }
    o->arrow_first = calloc(count + 2, sizeof *o->arrow_first);
    o->arrows = malloc((befores->count + 1) * sizeof *o->arrows);
    o->knot = malloc((count + 1) * sizeof *o->knot);
    o->knot_first = malloc((count + 1) * sizeof *o->knot_first);
    o->members = malloc((count + 1) * sizeof *o->members);
    o->depth = malloc((count + 1) * sizeof *o->depth);
    if (!o->arrow_first || !o->arrows || !o->knot || !o->knot_first || !o->members || !o->depth)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < count; f++) {
        double sum = 0;
        for (uint32_t c = scene->first[f]; c < scene->first[f + 1]; c++)
            sum += scene->points[c][2];
        o->depth[f] = sum / (scene->first[f + 1] - scene->first[f]);
    }
    point_arrows(o, befores);
    return find_knots(o, error);
}

/* ==== faces that no order puts right are cut along one another's planes: a triangle divides the rest into what lies
 * beyond its plane, which is painted first, and what lies on the eye's side, which is painted last; and so on in each
 * part (binary space partition: Fuchs, Kedem, Naylor, "On visible surface generation by a priori tree structures",
 * SIGGRAPH 1980) */

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

/* The plane of a triangle, its normal towards the eye; false if it has no area. */
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
        status = painting_add(c->painting, (tn_patch){p->face, p->first, p->count, true}, error);
    }
    return status;
}

/* Cuts the faces of a knot into pieces that have an order, and adds these to the painting. `list` holds the faces'
 * triangles. TN_LIMIT, without a message, where that would take too many pieces. */
static tn_status painting_cut(const tn_scene *scene, const tn_seen_triangle *triangles, const uint32_t *list,
                              size_t count, tn_painting *painting, tn_error *error)
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

/* ==== finds the order in which faces are painted */

#define EDGE_ON 1e-7 /* of the square of its longest side: a triangle with less area in the picture is a line */

void tn_painting_clear(tn_painting *painting)
{
    free(painting->patches);
    free(painting->points);
    free(painting->sides);
    *painting = (tn_painting){0};
}

/* Adds what is painted next. */
static tn_status painting_add(tn_painting *painting, tn_patch patch, tn_error *error)
{
    if (!tn_array_reserve(&painting->patches, &painting->patch_room, painting->patch_count, 1,
                          sizeof *painting->patches))
        return tn_fail_memory(error);
    painting->patches[painting->patch_count++] = patch;
    return TN_OK;
}

/* ---- triangles */

static void look_at(const tn_scene *scene, tn_seen_triangle *t)
{
    const double *p = scene->points[t->corner[0]], *q = scene->points[t->corner[1]], *r = scene->points[t->corner[2]];
    double ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2], vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
    double area = ux * vy - uy * vx, wx = vx - ux, wy = vy - uy;
    double longest = fmax(ux * ux + uy * uy, fmax(vx * vx + vy * vy, wx * wx + wy * wy));
    t->edge_on = !(fabs(area) > EDGE_ON * longest);
    t->slope[0] = t->edge_on ? 0 : (uz * vy - uy * vz) / area;
    t->slope[1] = t->edge_on ? 0 : (ux * vz - uz * vx) / area;
    t->height = p[2] - t->slope[0] * p[0] - t->slope[1] * p[1];
    if (area < 0) {
        uint32_t swap = t->corner[1];
        t->corner[1] = t->corner[2];
        t->corner[2] = swap;
    }
}

/* Every face in triangles, each corner of a face a vertex of its own. */
static tn_status cut_faces(const tn_scene *scene, tn_seen_triangle **result, size_t *count, tn_error *error)
{
    uint32_t corners = scene->first[scene->face_count];
    tn_mesh mesh;
    tn_status status = tn_mesh_new(corners, scene->face_count, corners, &mesh, error);
    if (status != TN_OK)
        return status;
    memcpy(mesh.positions, scene->points, corners * sizeof *scene->points);
    memcpy(mesh.face_first, scene->first, (scene->face_count + 1) * sizeof *scene->first);
    for (uint32_t c = 0; c < corners; c++)
        mesh.corners[c] = c;
    status = tn_mesh_triangulate(&mesh, error);
    tn_seen_triangle *triangles = status == TN_OK ? malloc((mesh.face_count + 1) * sizeof *triangles) : NULL;
    if (status == TN_OK && !triangles)
        status = tn_fail_memory(error);
    uint32_t face = 0;
    for (size_t t = 0; status == TN_OK && t < mesh.face_count; t++) {
        memcpy(triangles[t].corner, mesh.corners + 3 * t, sizeof triangles[t].corner);
        while (triangles[t].corner[0] >= scene->first[face + 1])
            face++;
        triangles[t].face = face;
        look_at(scene, &triangles[t]);
    }
    *count = mesh.face_count;
    *result = triangles;
    tn_mesh_clear(&mesh);
    return status;
}

/* ---- painting */

typedef struct work {
    const tn_scene *scene;
    tn_seen_triangle *triangles;
    uint32_t *triangle_first; /* [face + 1] */
    paint_order order;
    tn_painting *painting;
} work;

typedef struct face_at {
    double depth;
    uint32_t face;
} face_at;

static int farther_first(const void *a, const void *b)
{
    const face_at *x = a, *y = b;
    if (x->depth != y->depth)
        return x->depth < y->depth ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

static tn_status paint_face(work *w, uint32_t face, tn_error *error)
{
    uint32_t first = w->scene->first[face], end = w->scene->first[face + 1];
    return painting_add(w->painting, (tn_patch){face, first, end - first, false}, error);
}

static tn_status paint_by_depth(work *w, const uint32_t *faces, size_t count, tn_error *error)
{
    face_at *sorted = malloc(count * sizeof *sorted);
    if (!sorted)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        sorted[i] = (face_at){w->order.depth[faces[i]], faces[i]};
    qsort(sorted, count, sizeof *sorted, farther_first);
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = paint_face(w, sorted[i].face, error);
    w->painting->by_depth += (uint32_t)count;
    free(sorted);
    return status;
}

static tn_status cut_knot(work *w, const uint32_t *faces, size_t count, tn_error *error)
{
    size_t triangles = 0, n = 0;
    for (size_t i = 0; i < count; i++)
        triangles += w->triangle_first[faces[i] + 1] - w->triangle_first[faces[i]];
    uint32_t *list = malloc((triangles + 1) * sizeof *list);
    if (!list)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        for (uint32_t t = w->triangle_first[faces[i]]; t < w->triangle_first[faces[i] + 1]; t++)
            list[n++] = t;
    tn_painting *painting = w->painting;
    size_t patches = painting->patch_count, corners = painting->corner_count;
    tn_status status = painting_cut(w->scene, w->triangles, list, n, painting, error);
    free(list);
    if (status != TN_LIMIT)
        return status;
    painting->patch_count = patches;
    painting->corner_count = corners;
    return paint_by_depth(w, faces, count, error);
}

static tn_status paint_knot(void *user, uint32_t knot, tn_error *error)
{
    work *w = user;
    const paint_order *o = &w->order;
    if (tn_watch_stopped(w->scene->watch))
        return tn_fail_stopped(w->scene->watch, error);
    const uint32_t *faces = o->members + o->knot_first[knot];
    uint32_t count = o->knot_first[knot + 1] - o->knot_first[knot];
    return count == 1 ? paint_face(w, faces[0], error) : cut_knot(w, faces, count, error);
}

static tn_status find_order(work *w, size_t triangle_count, tn_error *error)
{
    tn_face_pairs befores;
    tn_status status = tn_overlaps_find(w->scene, w->triangles, triangle_count, &befores, error);
    if (status == TN_OK)
        status = order_make(w->scene, &befores, &w->order, error);
    free(befores.items);
    if (status != TN_OK)
        return status;
    w->triangle_first = calloc((size_t)w->scene->face_count + 1, sizeof *w->triangle_first);
    if (!w->triangle_first)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < w->scene->face_count; f++)
        w->triangle_first[f + 1] = w->triangle_first[f] + w->scene->first[f + 1] - w->scene->first[f] - 2;
    return TN_OK;
}

tn_status tn_painting_make(const tn_scene *scene, tn_painting *painting, tn_error *error)
{
    work w = {.scene = scene, .painting = painting};
    size_t triangle_count;
    *painting = (tn_painting){0};
    tn_status status = cut_faces(scene, &w.triangles, &triangle_count, error);
    if (status == TN_OK)
        status = find_order(&w, triangle_count, error);
    if (status == TN_OK)
        status = order_walk(&w.order, paint_knot, &w, error);
    free(w.triangles);
    free(w.triangle_first);
    order_clear(&w.order);
    return status;
}
