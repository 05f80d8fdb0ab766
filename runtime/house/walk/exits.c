/* How many walks lead outside of which no two share a passage or a flight: the greatest flow from a cell, where each
 * face lets one through. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/walk/walk.h"

/* An arc and, right behind it, its opposite: how much can go on along it still. */
typedef struct tn_arc {
    uint32_t to, next; /* next: of the arcs of the same node */
    uint32_t left;
} tn_arc;

#define NO_ARC UINT32_MAX
#define ANY_NUMBER (UINT32_MAX / 2)

/* Nodes: a part of a floor, by the first of its points; where a face is come to, and where it is left; the cell, and
 * outside. */
typedef struct tn_flow {
    const tn_walks *walks;
    tn_arc *arcs;
    uint32_t *first; /* [nodes] */
    uint32_t *came;  /* [nodes] the arc that a search came by */
    uint32_t *todo;  /* [nodes] */
    size_t arc_count, room;
    uint32_t nodes, start, outside;
} tn_flow;

static uint32_t entry_of(const tn_flow *f, uint32_t face)
{
    return f->walks->count + 2 * face;
}

static uint32_t exit_of(const tn_flow *f, uint32_t face)
{
    return f->walks->count + 2 * face + 1;
}

/* The first point of the same part of the floor. */
static uint32_t part_of(const tn_flow *f, uint32_t point)
{
    const tn_walk_cell *cell = &f->walks->cells[f->walks->points[point].cell];
    uint32_t i = 0;
    while (cell->lengths[i * (size_t)cell->count + (point - cell->first)] == TN_NO_PATH)
        i++;
    return cell->first + i;
}

static bool add_arc(tn_flow *f, uint32_t from, uint32_t to, uint32_t most)
{
    if (!tn_array_reserve(&f->arcs, &f->room, f->arc_count, 2, sizeof *f->arcs))
        return false;
    f->arcs[f->arc_count] = (tn_arc){to, f->first[from], most};
    f->first[from] = (uint32_t)f->arc_count++;
    f->arcs[f->arc_count] = (tn_arc){from, f->first[to], 0};
    f->first[to] = (uint32_t)f->arc_count++;
    return true;
}

/* From its part of the floor into the face, if one can go through there, and out of it. */
static bool add_point(tn_flow *f, uint32_t number)
{
    static const tn_walk_asked outside = {0};
    const tn_walk_point *point = &f->walks->points[number];
    bool leads = f->walks->house->faces[point->face].second == TN_NO_CELL || point->over != TN_NO_POINT;
    uint32_t part = part_of(f, number);
    return (!leads || add_arc(f, part, entry_of(f, point->face), ANY_NUMBER)) &&
           add_arc(f, exit_of(f, point->face), part, ANY_NUMBER) &&
           (!tn_walks_is_there(f->walks, &outside, point->cell) || add_arc(f, part, f->outside, ANY_NUMBER));
}

/* The cell's ways out: its passages, or the flights at its landings where it has none. */
static bool begin_at(tn_flow *f, uint32_t cell)
{
    const tn_walks *w = f->walks;
    bool ok = true;
    for (uint32_t i = 0; ok && i < w->house->face_count; i++) {
        const tn_face *face = &w->house->faces[i];
        if ((face->first == cell && w->first_of[i]) || (face->second == cell && w->second_of[i]))
            ok = add_arc(f, f->start, entry_of(f, i), ANY_NUMBER);
    }
    for (uint32_t i = 0; ok && i < w->cells[cell].count && !w->cells[cell].has_passage; i++)
        ok = add_arc(f, f->start, entry_of(f, w->points[w->cells[cell].first + i].face), ANY_NUMBER);
    return ok;
}

static tn_status begin(tn_flow *f, uint32_t cell, tn_error *error)
{
    const tn_walks *w = f->walks;
    uint32_t faces = (uint32_t)w->house->face_count;
    f->start = w->count + 2 * faces;
    f->outside = f->start + 1;
    f->nodes = f->start + 2;
    f->first = tn_array_new(f->nodes, sizeof *f->first);
    f->came = tn_array_new(f->nodes, sizeof *f->came);
    f->todo = tn_array_new(f->nodes, sizeof *f->todo);
    bool ok = f->first && f->came && f->todo;
    for (uint32_t i = 0; ok && i < f->nodes; i++)
        f->first[i] = NO_ARC;
    for (uint32_t i = 0; ok && i < w->count; i++)
        ok = add_point(f, i);
    for (uint32_t i = 0; ok && i < faces; i++)
        ok = add_arc(f, entry_of(f, i), exit_of(f, i), 1) &&
             (w->house->faces[i].second != TN_NO_CELL || add_arc(f, exit_of(f, i), f->outside, ANY_NUMBER));
    return ok && begin_at(f, cell) ? TN_OK : tn_fail_memory(error);
}

/* One walk more, if there is one. */
static bool search(tn_flow *f)
{
    size_t count = 1, at = 0;
    for (uint32_t i = 0; i < f->nodes; i++)
        f->came[i] = NO_ARC;
    f->todo[0] = f->start;
    while (at < count && f->came[f->outside] == NO_ARC) {
        uint32_t node = f->todo[at++];
        for (uint32_t i = f->first[node]; i != NO_ARC; i = f->arcs[i].next) {
            const tn_arc *arc = &f->arcs[i];
            if (arc->left == 0 || arc->to == f->start || f->came[arc->to] != NO_ARC)
                continue;
            f->came[arc->to] = i;
            f->todo[count++] = arc->to;
        }
    }
    if (f->came[f->outside] == NO_ARC)
        return false;
    for (uint32_t node = f->outside; node != f->start; node = f->arcs[f->came[node] ^ 1].to) {
        f->arcs[f->came[node]].left--;
        f->arcs[f->came[node] ^ 1].left++;
    }
    return true;
}

tn_status tn_walks_exits(const tn_walks *w, uint32_t cell, uint32_t *exits, tn_error *error)
{
    static const tn_walk_asked outside = {0};
    tn_flow f = {.walks = w};
    *exits = UINT32_MAX;
    if (tn_walks_is_there(w, &outside, cell))
        return TN_OK;
    tn_status status = begin(&f, cell, error);
    *exits = 0;
    while (status == TN_OK && search(&f))
        ++*exits;
    free(f.arcs);
    free(f.first);
    free(f.came);
    free(f.todo);
    return status;
}
