/* The shortest walks of a house: from where they lead to, backwards, as one can walk both ways. */
#include "runtime/house/walk/walk.h"

#include <stdlib.h>

#include "runtime/house/house.h"

/* Is the cell one to which the walks lead? */
bool tn_walks_is_there(const tn_walks *w, const tn_walk_asked *asked, uint32_t cell)
{
    const tn_cell *c = &w->house->cells[cell];
    if (c->open)
        return false;
    return asked->to ? asked->to[cell] : c->storey == 0 && tn_cell_is_outdoor(w->house, cell);
}

/* Is the point one of a cell's: of its passages, at either side, or of its landings where it has no passages? */
static bool is_of(const tn_walks *w, const tn_walk_point *point, uint32_t cell)
{
    const tn_face *face = &w->house->faces[point->face];
    if (point->spot == TN_SPOT_LANDING)
        return point->cell == cell && !w->cells[cell].has_passage;
    return (face->first == cell && w->first_of[point->face]) || (face->second == cell && w->second_of[point->face]);
}

static bool is_goal(const tn_walks *w, const tn_walk_asked *asked, const tn_walk_point *point)
{
    const tn_face *face = &w->house->faces[point->face];
    const uint32_t cells[3] = {face->first, face->second, point->cell};
    if (!asked->by[point->face])
        return false;
    if (!asked->to && face->second == TN_NO_CELL)
        return true;
    for (int i = 0; i < 3; i++)
        if (cells[i] != TN_NO_CELL && tn_walks_is_there(w, asked, cells[i]) && is_of(w, point, cells[i]))
            return true;
    return false;
}

/* ---- the shortest */

typedef struct tn_nearing {
    const tn_walks *walks;
    const tn_walk_asked *asked;
    int64_t *lengths;
    uint32_t *next;
    bool *settled;
} tn_nearing;

static void come_to(const tn_nearing *n, uint32_t from, uint32_t to, int64_t far)
{
    if (far == TN_NO_PATH || n->settled[to] || !n->asked->by[n->walks->points[to].face] ||
        n->lengths[to] <= n->lengths[from] + far)
        return;
    n->lengths[to] = n->lengths[from] + far;
    n->next[to] = from;
}

static void go_on(const tn_nearing *n, uint32_t at)
{
    const tn_walk_point *point = &n->walks->points[at];
    const tn_walk_cell *cell = &n->walks->cells[point->cell];
    if (point->over != TN_NO_POINT)
        come_to(n, at, point->over, point->across);
    if (!n->asked->through[point->cell])
        return;
    for (uint32_t i = 0; i < cell->count; i++)
        come_to(n, at, cell->first + i, cell->lengths[(at - cell->first) * (size_t)cell->count + i]);
}

static uint32_t nearest(const tn_nearing *n)
{
    uint32_t best = TN_NO_POINT;
    for (uint32_t i = 0; i < n->walks->count; i++)
        if (!n->settled[i] && n->lengths[i] != TN_NO_PATH && (best == TN_NO_POINT || n->lengths[i] < n->lengths[best]))
            best = i;
    return best;
}

tn_status tn_walks_lengths(const tn_walks *w, const tn_walk_asked *asked, int64_t *lengths, uint32_t *next,
                           tn_error *error)
{
    tn_nearing n = {w, asked, lengths, next, calloc((size_t)w->count + 1, sizeof *n.settled)};
    if (!n.settled)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < w->count; i++) {
        lengths[i] = is_goal(w, asked, &w->points[i]) ? 0 : TN_NO_PATH;
        next[i] = TN_NO_POINT;
    }
    for (uint32_t at = nearest(&n); at != TN_NO_POINT; at = nearest(&n)) {
        n.settled[at] = true;
        go_on(&n, at);
    }
    free(n.settled);
    return TN_OK;
}

uint32_t tn_walks_from(const tn_walks *w, const tn_walk_asked *asked, const int64_t *lengths, uint32_t cell)
{
    uint32_t best = TN_NO_POINT;
    for (uint32_t i = 0; i < w->count; i++)
        if (lengths[i] != TN_NO_PATH && asked->by[w->points[i].face] && is_of(w, &w->points[i], cell) &&
            (best == TN_NO_POINT || lengths[i] < lengths[best]))
            best = i;
    return best;
}
