/* What walks can tell of the inside of a tray, in a form that is the same where they cannot tell it apart.
 *
 * Cells to walk through that are joined are a group. Only cells at whose faces one can step over a plane are kept, with
 * the group that each is in. A group that is near a goal is as good as goals. Where a source waits for one group, the
 * group waits. So a door between two rooms that no walk goes through is not told from a wall, and two ways to the same
 * place are not told from one. A source that can never reach a goal says all that there is to say. */
#include <string.h>

#include "runtime/house/frontier/parts.h"
#include "runtime/house/frontier/placed.h"

/* By groups: of their first cell. by_source: of a source that is not walked through, the cells to which it can go. */
typedef struct tn_inside_walk {
    const tn_inside *in;
    uint32_t walk, cells;
    tn_strip_role role[TN_STRIP_CELLS_MAX];
    bool shown[TN_STRIP_CELLS_MAX]; /* of cells: one can step over a plane */
    bool beside_goal[TN_STRIP_CELLS_MAX];
    uint64_t by_source[TN_STRIP_CELLS_MAX];
    uint8_t parent[TN_STRIP_CELLS_MAX];
    bool near[TN_STRIP_CELLS_MAX], waits[TN_STRIP_CELLS_MAX]; /* of groups; waits: a source in it, or for it */
    uint32_t first[TN_STRIP_CELLS_MAX];                       /* of groups: the first cell that is shown, or none */
    uint32_t words[TN_STRIP_CELLS_MAX];                       /* the roles that are kept */
} tn_inside_walk;

static uint8_t root_of(tn_inside_walk *w, uint32_t cell)
{
    while (w->parent[cell] != cell)
        cell = w->parent[cell] = w->parent[w->parent[cell]];
    return (uint8_t)cell;
}

static void join(tn_inside_walk *w, uint32_t a, uint32_t b)
{
    a = root_of(w, a);
    b = root_of(w, b);
    w->parent[a > b ? a : b] = (uint8_t)(a < b ? a : b);
}

static bool shows(const tn_inside_walk *w, tn_strip_role_at role, uint32_t cell)
{
    return tn_inside_reach(w->in, role, cell)->walks >> w->walk & 1;
}

static void begin(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++) {
        w->role[i] = tn_strip_role_of(w->in->strip, w->walk, w->in->cells[i]->answers, w->in->house.cells[i].open);
        w->parent[i] = (uint8_t)i;
        w->shown[i] = shows(w, TN_STRIP_ENTRY, i) || shows(w, TN_STRIP_EXIT, i);
        w->first[i] = TN_STRIP_NONE;
    }
}

/* One of the two ways through a face. */
static void see_step(tn_inside_walk *w, uint32_t from, uint32_t to)
{
    if (w->role[from].goal)
        w->beside_goal[to] = true;
    if (w->role[from].through && w->role[to].source && !w->role[to].through)
        w->by_source[to] |= UINT64_C(1) << from;
}

static void see_steps(tn_inside_walk *w)
{
    const tn_house *house = &w->in->house;
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->second == TN_NO_CELL || !tn_strip_steps(w->in->strip, house, face, w->walk))
            continue;
        see_step(w, face->first, face->second);
        see_step(w, face->second, face->first);
        if (w->role[face->first].through && w->role[face->second].through)
            join(w, face->first, face->second);
    }
}

static void find_groups(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++) {
        uint8_t group = root_of(w, i);
        if (!w->role[i].through)
            continue;
        w->near[group] = w->near[group] || w->role[i].goal || w->beside_goal[i];
        w->waits[group] = w->waits[group] || w->role[i].source;
        if (w->shown[i] && w->first[group] == TN_STRIP_NONE)
            w->first[group] = i;
    }
}

/* A source that is not walked through waits for the groups that are shown, and where it is shown itself for others.
 * by_source becomes these groups. False: it can never reach a goal. */
static bool place_source(tn_inside_walk *w, uint32_t source)
{
    uint64_t cells = w->by_source[source], *groups = &w->by_source[source];
    bool near = w->beside_goal[source];
    uint32_t count = 0, last = 0;
    *groups = 0;
    for (uint32_t i = 0; i < w->cells; i++) {
        uint8_t group = root_of(w, i);
        if (!(cells >> i & 1))
            continue;
        near = near || w->near[group];
        if (w->first[group] == TN_STRIP_NONE || *groups >> group & 1)
            continue;
        *groups |= UINT64_C(1) << group;
        last = group;
        count++;
    }
    if (near || (count == 0 && !w->shown[source])) {
        *groups = 0;
        return near;
    }
    if (count == 1 && !w->shown[source]) {
        w->waits[last] = true;
        *groups = 0;
        return true;
    }
    w->words[source] = ROLE_SOURCE;
    return true;
}

/* False: one of the sources can never reach a goal. */
static bool place_sources(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++)
        if (w->role[i].source && !w->role[i].through && !place_source(w, i))
            return false;
    for (uint32_t i = 0; i < w->cells; i++)
        if (w->role[i].through && root_of(w, i) == i && w->waits[i] && !w->near[i] && w->first[i] == TN_STRIP_NONE)
            return false;
    return true;
}

static void place_others(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++) {
        uint8_t group = root_of(w, i);
        if (!w->shown[i])
            continue;
        if (w->role[i].through)
            w->words[i] = ROLE_THROUGH | (w->near[group]                            ? ROLE_GOAL
                                          : w->first[group] == i && w->waits[group] ? ROLE_SOURCE
                                                                                    : 0u);
        else if (w->role[i].goal)
            w->words[i] = ROLE_GOAL;
    }
    for (uint32_t i = 0; i < w->cells; i++)
        if (w->words[i] != 0 && !shows(w, TN_STRIP_EXIT, i))
            w->words[i] |= ROLE_ENDS;
}

static void place(tn_inside_walk *w)
{
    begin(w);
    see_steps(w);
    find_groups(w);
    if (place_sources(w)) {
        place_others(w);
        return;
    }
    memset(w->words, 0, sizeof w->words);
    memset(w->by_source, 0, sizeof w->by_source);
    memset(w->shown, 0, sizeof w->shown);
    w->words[0] = ROLES_APART; /* of the slice: no cell has a role, so that no step over a plane can reach a goal */
}

static bool push_step(const tn_inside_walk *w, uint32_t from, uint32_t to, tn_key *key, size_t count)
{
    bool ok = tn_key_push(key, from) && tn_key_push(key, to) && tn_key_push(key, 1u << (w->walk + 1));
    key->data[count] += ok;
    return ok;
}

/* Where it is asked where in the row sources are, all roles and steps stay. */
static bool push_plain_steps(const tn_inside_walk *w, tn_key *key, size_t count)
{
    const tn_house *house = &w->in->house;
    bool ok = true;
    for (size_t i = 0; ok && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->second != TN_NO_CELL && tn_strip_steps(w->in->strip, house, face, w->walk))
            ok = push_step(w, face->first, face->second, key, count);
    }
    return ok;
}

static void place_plainly(tn_inside_walk *w)
{
    begin(w);
    for (uint32_t i = 0; i < w->cells; i++)
        w->words[i] = (w->role[i].through ? ROLE_THROUGH : 0u) | (w->role[i].goal ? ROLE_GOAL : 0u) |
                      (w->role[i].source ? ROLE_SOURCE : 0u);
}

/* Joins a cell to the first of its group that is shown, and a source to the groups that it waits for. */
static bool push_steps(tn_inside_walk *w, uint32_t cell, tn_key *key, size_t count)
{
    uint32_t group = root_of(w, cell), first = w->first[group];
    bool ok = true;
    if (w->shown[cell] && w->role[cell].through && !w->near[group] && first != cell)
        return push_step(w, first, cell, key, count);
    for (uint32_t g = 0; ok && w->words[cell] & ROLE_SOURCE && !w->role[cell].through && g < w->cells; g++)
        if (w->by_source[cell] >> g & 1)
            ok = push_step(w, w->first[g], cell, key, count);
    return ok;
}

bool tn_strip_push_walks(const tn_inside *in, tn_key *key)
{
    uint32_t walks = in->strip->questions.walk_count, cells = (uint32_t)in->house.cell_count;
    tn_inside_walk w[TN_STRIP_MEETINGS_MAX];
    bool ok = true;
    for (uint32_t k = 0; ok && k < walks; k++) {
        memset(&w[k], 0, sizeof w[k]);
        w[k].in = in;
        w[k].walk = k;
        w[k].cells = cells;
        if (tn_strip_walk_placed(in->strip, k))
            place_plainly(&w[k]);
        else
            place(&w[k]);
        for (uint32_t i = 0; ok && i < cells; i++)
            ok = tn_key_push(key, w[k].words[i]);
    }
    size_t count = key->size;
    ok = ok && tn_key_push(key, 0);
    for (uint32_t k = 0; ok && k < walks; k++) {
        bool placed = tn_strip_walk_placed(in->strip, k);
        ok = !placed || push_plain_steps(&w[k], key, count);
        for (uint32_t i = 0; ok && !placed && i < cells; i++)
            ok = push_steps(&w[k], i, key, count);
    }
    return ok;
}
