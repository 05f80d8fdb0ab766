/* Cuts the union of rectangles, less others, into rectangles that do not overlap: a sweep over the x of all edges. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/solids.h"

tn_status tn_rectangles_add(tn_rectangles *list, tn_rectangle rectangle, tn_error *error)
{
    if (!tn_array_reserve_from(&list->items, &list->room, 16, list->count, 1, sizeof *list->items))
        return tn_fail_memory(error);
    list->items[list->count++] = rectangle;
    return TN_OK;
}

typedef struct tn_stretch_y {
    int64_t from, to;
} tn_stretch_y;

static int compare_numbers(const void *a, const void *b)
{
    int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

static int compare_stretches(const void *a, const void *b)
{
    const tn_stretch_y *p = a, *q = b;
    return p->from != q->from ? (p->from > q->from) - (p->from < q->from) : (p->to > q->to) - (p->to < q->to);
}

/* The stretches in y of those rectangles that cover [x0, x1), sorted, joined where they meet. */
static size_t stretches(const tn_rectangles *list, int64_t x0, int64_t x1, tn_stretch_y *out)
{
    size_t count = 0, kept = 0;
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].x0 <= x0 && x1 <= list->items[i].x1)
            out[count++] = (tn_stretch_y){list->items[i].y0, list->items[i].y1};
    if (count)
        qsort(out, count, sizeof *out, compare_stretches);
    for (size_t i = 0; i < count; i++) {
        if (kept && out[i].from <= out[kept - 1].to)
            out[kept - 1].to = out[i].to > out[kept - 1].to ? out[i].to : out[kept - 1].to;
        else
            out[kept++] = out[i];
    }
    return kept;
}

/* The first list less the second, both sorted and apart. Returns how many. */
static size_t subtract(const tn_stretch_y *of, size_t of_count, const tn_stretch_y *less, size_t less_count,
                       tn_stretch_y *out)
{
    size_t count = 0, l = 0;
    for (size_t i = 0; i < of_count; i++) {
        int64_t from = of[i].from;
        while (l < less_count && less[l].to <= from)
            l++;
        for (size_t k = l; k < less_count && less[k].from < of[i].to; k++) {
            if (less[k].from > from)
                out[count++] = (tn_stretch_y){from, less[k].from};
            from = less[k].to > from ? less[k].to : from;
        }
        if (from < of[i].to)
            out[count++] = (tn_stretch_y){from, of[i].to};
    }
    return count;
}

/* What the sweep works with. */
typedef struct tn_sweep {
    int64_t *x;
    tn_stretch_y *of, *less, *now, *before;
    size_t before_count;
    int64_t from, to; /* of the slab before */
} tn_sweep;

static tn_status put_slab(const tn_sweep *sweep, tn_rectangles *cut, tn_error *error)
{
    for (size_t i = 0; i < sweep->before_count; i++) {
        tn_rectangle r = {sweep->from, sweep->to, sweep->before[i].from, sweep->before[i].to};
        tn_status status = tn_rectangles_add(cut, r, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status sweep_all(tn_sweep *sweep, size_t edges, const tn_rectangles *of, const tn_rectangles *less,
                           tn_rectangles *cut, tn_error *error)
{
    for (size_t i = 0; i + 1 < edges; i++) {
        int64_t x0 = sweep->x[i], x1 = sweep->x[i + 1];
        if (x0 == x1)
            continue;
        size_t of_count = stretches(of, x0, x1, sweep->of), less_count = stretches(less, x0, x1, sweep->less);
        size_t count = subtract(sweep->of, of_count, sweep->less, less_count, sweep->now);
        bool same = sweep->to == x0 && count == sweep->before_count &&
                    memcmp(sweep->now, sweep->before, count * sizeof *sweep->now) == 0;
        if (same) {
            sweep->to = x1;
            continue;
        }
        tn_status status = put_slab(sweep, cut, error);
        if (status != TN_OK)
            return status;
        tn_stretch_y *spare = sweep->before;
        sweep->before = sweep->now;
        sweep->now = spare;
        sweep->before_count = count;
        sweep->from = x0;
        sweep->to = x1;
    }
    return put_slab(sweep, cut, error);
}

tn_status tn_region_cut(const tn_rectangles *of, const tn_rectangles *less, tn_rectangles *cut, tn_error *error)
{
    size_t total = of->count + less->count + 1, edges = 0;
    tn_sweep sweep = {.x = malloc(2 * total * sizeof *sweep.x),
                      .of = malloc(total * sizeof *sweep.of),
                      .less = malloc(total * sizeof *sweep.less),
                      .now = malloc(2 * total * sizeof *sweep.now),
                      .before = malloc(2 * total * sizeof *sweep.before)};
    tn_status status = sweep.x && sweep.of && sweep.less && sweep.now && sweep.before ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        for (size_t i = 0; i < of->count + less->count; i++) {
            const tn_rectangle *r = i < of->count ? &of->items[i] : &less->items[i - of->count];
            sweep.x[edges++] = r->x0;
            sweep.x[edges++] = r->x1;
        }
        qsort(sweep.x, edges, sizeof *sweep.x, compare_numbers);
        status = sweep_all(&sweep, edges, of, less, cut, error);
    }
    free(sweep.x);
    free(sweep.of);
    free(sweep.less);
    free(sweep.now);
    free(sweep.before);
    return status;
}
