/* From what has to be painted before what to an order. */
#include <stdlib.h>
#include <string.h>

#include "runtime/geometry/hidden/hidden_parts.h"

#define NONE UINT32_MAX

void tn_order_clear(tn_order *order)
{
    free(order->arrow_first);
    free(order->arrows);
    free(order->knot);
    free(order->knot_first);
    free(order->members);
    free(order->depth);
    *order = (tn_order){0};
}

/* ---- knots: the strongly connected parts (Tarjan 1972), without recursion */

typedef struct visit {
    uint32_t *number, *low; /* [face] in the order of first visits, from 1 */
    uint32_t *open;         /* visited faces whose knot is not known yet */
    uint32_t *path, *next;  /* the way to the face at hand, and each one's next arrow */
    uint32_t opened, visited, depth;
} visit;

static void enter(const tn_order *o, visit *v, uint32_t face)
{
    v->number[face] = v->low[face] = ++v->visited;
    v->open[v->opened++] = face;
    v->path[v->depth] = face;
    v->next[v->depth++] = o->arrow_first[face];
}

static void leave(tn_order *o, visit *v)
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

static void visit_from(tn_order *o, visit *v, uint32_t start)
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

static tn_status find_knots(tn_order *o, tn_error *error)
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
    const tn_order *order;
    uint32_t *knots; /* a heap */
    uint32_t count;
} waiting;

static double depth_of(const tn_order *o, uint32_t knot)
{
    return o->depth[o->members[o->knot_first[knot]]];
}

static bool farther(const tn_order *o, uint32_t a, uint32_t b)
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

tn_status tn_order_walk(const tn_order *o, tn_paint_knot *paint, void *user, tn_error *error)
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

static void point_arrows(tn_order *o, const tn_face_pairs *befores)
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

tn_status tn_order_make(const tn_scene *scene, const tn_face_pairs *befores, tn_order *o, tn_error *error)
{
    size_t count = scene->face_count;
    *o = (tn_order){.count = scene->face_count};
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
