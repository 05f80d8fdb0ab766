/* Follows walks from tray to tray: which cells at the plane one can walk between, which of these groups have reached a
 * goal, and which sources still wait for one.
 *
 * A group consists of cells to walk through, or is one source that is none of these. A source waits for a set of
 * groups: one of them has to reach a goal. Where a set is part of another, only the smaller one is kept: if that waits
 * in vain, there is a source apart already. */
#include <string.h>

#include "runtime/house/strip/parts.h"

enum { NODES = 2 * TN_STRIP_CELLS_MAX, NO_GROUP = 0xff, AT_GOAL = 0xfe };

typedef struct tn_walking {
    const tn_strip *strip;
    uint32_t walk;
    const uint32_t *roles; /* of the cells of the right edge, from the slice */
    uint32_t before;       /* nodes: the groups before, then the cells of the right edge */
    uint8_t parent[NODES];
    bool near[NODES];
    tn_uint128 waiting[4 * TN_STRIP_CELLS_MAX]; /* sets of nodes */
    uint32_t count;
    bool inside; /* the row has begun: what waits in vain may be said at once */
    bool apart, too_many;
} tn_walking;

tn_strip_role tn_strip_role_of(const tn_strip *strip, uint32_t walk, const uint64_t *answers, bool open)
{
    const tn_strip_walk *w = &strip->questions.walk_parts[walk];
    tn_strip_role role = {false, false, false, false};
    if (open)
        return role;
    role.through = w->any || tn_answers(answers, w->through);
    role.goal = tn_answers(answers, w->second);
    role.source = !role.goal && tn_answers(answers, w->first);
    return role;
}

static tn_strip_role role_at_left(const tn_walking *w, const tn_strip_edge *edge, uint32_t cell)
{
    return tn_strip_role_of(w->strip, w->walk, tn_edge_answers(w->strip, edge, cell), edge->cells[cell].open);
}

static tn_strip_role role_at_right(const tn_walking *w, uint32_t cell)
{
    uint32_t word = w->roles[cell];
    return (tn_strip_role){word & ROLE_THROUGH, word & ROLE_GOAL, word & ROLE_SOURCE, word & ROLE_ENDS};
}

static uint8_t root_of(tn_walking *w, uint8_t node)
{
    while (w->parent[node] != node)
        node = w->parent[node] = w->parent[w->parent[node]];
    return node;
}

static void join(tn_walking *w, uint8_t a, uint8_t b)
{
    a = root_of(w, a);
    b = root_of(w, b);
    w->near[a < b ? a : b] = w->near[a] || w->near[b];
    w->parent[a > b ? a : b] = a < b ? a : b;
}

static void wait_for(tn_walking *w, tn_uint128 set)
{
    if (w->count == sizeof w->waiting / sizeof *w->waiting)
        w->too_many = true;
    else
        w->waiting[w->count++] = set;
}

/* One of the two ways through a face: from the cell at node a to the cell at node b. */
static void step(tn_walking *w, uint8_t a, tn_strip_role from, uint8_t b, tn_strip_role to)
{
    if (b != NO_GROUP && from.goal) {
        if (b != AT_GOAL)
            w->near[root_of(w, b)] = true;
        return;
    }
    if (a == NO_GROUP || b == NO_GROUP || !from.through || to.through || !to.source || b == AT_GOAL)
        return;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->waiting[i] >> b & 1)
            w->waiting[i] |= a == AT_GOAL ? 0 : (tn_uint128)1 << a;
    if (a == AT_GOAL)
        w->near[b] = true;
}

static void pass(tn_walking *w, uint8_t a, tn_strip_role from, uint8_t b, tn_strip_role to)
{
    if (from.through && to.through && a != NO_GROUP && b != NO_GROUP) {
        if (a != AT_GOAL && b != AT_GOAL)
            join(w, a, b);
        else if (a != b)
            w->near[root_of(w, a == AT_GOAL ? b : a)] = true;
    }
    step(w, a, from, b, to);
    step(w, b, to, a, from);
}

/* ---- before: {group of each cell, number of groups, then four words for each set} */

static uint8_t node_before(const uint32_t *state, uint32_t cell)
{
    return (uint8_t)state[cell];
}

static void begin_left(tn_walking *w, const uint32_t *state, size_t size, uint32_t cells)
{
    w->before = state[cells];
    for (size_t i = cells + 1; i < size; i += 2)
        wait_for(w, tn_both(state + i));
}

static void begin_right(tn_walking *w, const tn_strip_edge *edge)
{
    for (uint32_t n = 0; n < w->before + edge->count; n++) {
        w->parent[n] = (uint8_t)n;
        w->near[n] = false;
    }
    for (uint32_t i = 0; i < edge->count; i++) {
        tn_strip_role role = role_at_right(w, i);
        w->near[w->before + i] = role.goal;
        if (role.source)
            wait_for(w, (tn_uint128)1 << (w->before + i));
    }
}

/* ---- after */

/* The group of each right cell, by the first cell in it. */
static uint32_t number_groups(tn_walking *w, const tn_strip_edge *edge, uint32_t group[TN_STRIP_CELLS_MAX],
                              uint32_t of_node[NODES])
{
    uint32_t count = 0;
    memset(of_node, 0xff, NODES * sizeof *of_node);
    for (uint32_t i = 0; edge && i < edge->count; i++) {
        tn_strip_role role = role_at_right(w, i);
        uint8_t root = root_of(w, (uint8_t)(w->before + i));
        group[i] = NO_GROUP;
        if ((!role.through && !role.source) || (role.ends && w->inside))
            continue;
        if (w->near[root])
            group[i] = AT_GOAL;
        else
            group[i] = of_node[root] = of_node[root] == UINT32_MAX ? count++ : of_node[root];
    }
    return count;
}

/* Drops the sets that have reached a goal; the others become sets of groups at the plane. */
static void carry(tn_walking *w, const uint32_t of_node[NODES])
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        tn_uint128 set = 0;
        bool near = false;
        for (uint8_t n = 0; n < NODES; n++) {
            if (!(w->waiting[i] >> n & 1))
                continue;
            uint8_t root = root_of(w, n);
            near = near || w->near[root];
            set |= of_node[root] == UINT32_MAX ? 0 : (tn_uint128)1 << of_node[root];
        }
        if (near)
            continue;
        w->apart = w->apart || set == 0;
        w->waiting[kept++] = set;
    }
    w->count = kept;
}

/* Keeps the least sets, in order. */
static void reduce(tn_walking *w)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        bool least = true;
        for (uint32_t k = 0; least && k < w->count; k++)
            least = k == i || (w->waiting[k] & ~w->waiting[i]) != 0 || (w->waiting[k] == w->waiting[i] && k > i);
        tn_uint128 set = w->waiting[i];
        if (!least)
            continue;
        uint32_t at = kept++;
        for (; at > 0 && w->waiting[at - 1] > set; at--)
            w->waiting[at] = w->waiting[at - 1];
        w->waiting[at] = set;
    }
    w->count = kept;
}

static tn_status leave(tn_strip *strip, tn_walking *w, const tn_strip_edge *edge, uint32_t *after, tn_error *error)
{
    uint32_t group[TN_STRIP_CELLS_MAX], of_node[NODES];
    uint32_t count = number_groups(w, edge, group, of_node);
    carry(w, of_node);
    tn_key *key = &strip->key;
    key->size = 0;
    *after = 0;
    if (w->apart)
        w->count = 0; /* it is known; what else waits does not matter, but for where the others are */
    reduce(w);
    bool ok = true;
    for (uint32_t i = 0; ok && edge && i < edge->count; i++)
        ok = tn_key_push(key, group[i]);
    ok = ok && tn_key_push(key, count);
    for (uint32_t i = 0; ok && i < w->count; i++)
        ok = tn_push_long(key, (uint64_t)w->waiting[i]);
    *after = ok ? tn_intern(&strip->walks, key->data, key->size) : UINT32_MAX;
    return *after != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

tn_status tn_strip_walk_cross(tn_strip *strip, uint32_t walk, uint32_t before, const tn_strip_crossing *c,
                              uint32_t *after, bool *apart, tn_error *error)
{
    tn_walking w = {.strip = strip, .walk = walk, .inside = c->left != NULL};
    size_t size = 0;
    const uint32_t *state = c->left ? tn_interned(&strip->walks, before, &size) : NULL;
    uint32_t right = c->right ? c->right->count : 0;
    if (c->left)
        begin_left(&w, state, size, c->left->count);
    static const tn_strip_edge nothing = {0};
    const uint32_t *roles = right ? c->slice + SLICE_CELLS + (size_t)CELL_WORDS * right : NULL, *steps = c->outcome + 3;
    w.roles = right ? roles + (size_t)walk * right : NULL;
    begin_right(&w, c->right ? c->right : &nothing);
    for (uint32_t i = 0; i < c->outcome[2]; i++, steps += STEP_WORDS)
        if (steps[STEP_HOW] >> (walk + 1) & 1)
            pass(&w, node_before(state, steps[STEP_FROM]), role_at_left(&w, c->left, steps[STEP_FROM]),
                 (uint8_t)(w.before + steps[STEP_TO]), role_at_right(&w, steps[STEP_TO]));
    steps = right ? roles + (size_t)strip->questions.walk_count * right : NULL;
    for (uint32_t i = 0, count = steps ? *steps++ : 0; i < count; i++, steps += STEP_WORDS)
        if (steps[STEP_HOW] >> (walk + 1) & 1)
            pass(&w, (uint8_t)(w.before + steps[STEP_FROM]), role_at_right(&w, steps[STEP_FROM]),
                 (uint8_t)(w.before + steps[STEP_TO]), role_at_right(&w, steps[STEP_TO]));
    if (w.too_many)
        return tn_strip_limit(strip, NULL, "more sources wait for a walk than can be told apart at once", error);
    tn_status status = leave(strip, &w, c->right, after, error);
    *apart = w.apart;
    return status;
}
