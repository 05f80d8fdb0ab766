/* Walks: what they can tell of the inside of a tray, and how they go on from tray to tray.
 *
 * ==== inside a tray
 *
 * Insides that walks cannot tell apart are written down alike.
 *
 * Cells to walk through that are joined are a group. Only cells from which one can step across an interface are kept,
 * with the group that each is in. A group that is near a goal counts as goals. If a source depends on one group alone,
 * it is the group that is pending. So a door between two rooms that no walk goes through is not told from a wall, and
 * two ways to the same place are not told from one. A source that can never reach a goal says all that there is to
 * say. */
#include <string.h>

#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"

/* By groups: of their first cell. by_source: of a source that is not walked through, the cells to which it can go. */
typedef struct tn_inside_walk {
    const tn_inside *in;
    uint32_t walk, cells;
    tn_frontier_role role[TN_FRONTIER_CELLS_MAX];
    bool shown[TN_FRONTIER_CELLS_MAX]; /* of cells: one can step across an interface */
    bool beside_goal[TN_FRONTIER_CELLS_MAX];
    uint64_t by_source[TN_FRONTIER_CELLS_MAX];
    uint8_t parent[TN_FRONTIER_CELLS_MAX];
    bool near[TN_FRONTIER_CELLS_MAX],
        pending[TN_FRONTIER_CELLS_MAX];    /* of groups; pending: a source is in it, or depends on it */
    uint32_t first[TN_FRONTIER_CELLS_MAX]; /* of groups: the first cell that is shown, or none */
    uint32_t words[TN_FRONTIER_CELLS_MAX]; /* the roles that are kept */
} tn_inside_walk;

static uint8_t group_of(tn_inside_walk *w, uint32_t cell)
{
    while (w->parent[cell] != cell)
        cell = w->parent[cell] = w->parent[w->parent[cell]];
    return (uint8_t)cell;
}

static void join_cells(tn_inside_walk *w, uint32_t a, uint32_t b)
{
    a = group_of(w, a);
    b = group_of(w, b);
    w->parent[a > b ? a : b] = (uint8_t)(a < b ? a : b);
}

static bool shows(const tn_inside_walk *w, tn_frontier_role_at role, uint32_t cell)
{
    return tn_inside_reach(w->in, role, cell)->walks >> w->walk & 1;
}

static void begin(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++) {
        w->role[i] =
            tn_frontier_role_of(w->in->frontier, w->walk, w->in->cells[i]->answers, w->in->house.cells[i].open);
        w->parent[i] = (uint8_t)i;
        w->shown[i] = shows(w, TN_FRONTIER_ENTRY, i) || shows(w, TN_FRONTIER_EXIT, i);
        w->first[i] = TN_FRONTIER_NONE;
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
        if (face->second == TN_NO_CELL || !tn_frontier_steps(w->in->frontier, house, face, w->walk))
            continue;
        see_step(w, face->first, face->second);
        see_step(w, face->second, face->first);
        if (w->role[face->first].through && w->role[face->second].through)
            join_cells(w, face->first, face->second);
    }
}

static void find_groups(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++) {
        uint8_t group = group_of(w, i);
        if (!w->role[i].through)
            continue;
        w->near[group] = w->near[group] || w->role[i].goal || w->beside_goal[i];
        w->pending[group] = w->pending[group] || w->role[i].source;
        if (w->shown[i] && w->first[group] == TN_FRONTIER_NONE)
            w->first[group] = i;
    }
}

/* A source that is not walked through depends on the groups that are shown, and, if it is shown itself, on others.
 * by_source becomes these groups. False: it can never reach a goal. */
static bool place_source(tn_inside_walk *w, uint32_t source)
{
    uint64_t cells = w->by_source[source], *groups = &w->by_source[source];
    bool near = w->beside_goal[source];
    uint32_t count = 0, last = 0;
    *groups = 0;
    for (uint32_t i = 0; i < w->cells; i++) {
        uint8_t group = group_of(w, i);
        if (!(cells >> i & 1))
            continue;
        near = near || w->near[group];
        if (w->first[group] == TN_FRONTIER_NONE || *groups >> group & 1)
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
        w->pending[last] = true;
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
        if (w->role[i].through && group_of(w, i) == i && w->pending[i] && !w->near[i] &&
            w->first[i] == TN_FRONTIER_NONE)
            return false;
    return true;
}

static void place_others(tn_inside_walk *w)
{
    for (uint32_t i = 0; i < w->cells; i++) {
        uint8_t group = group_of(w, i);
        if (!w->shown[i])
            continue;
        if (w->role[i].through)
            w->words[i] = ROLE_THROUGH | (w->near[group]                              ? ROLE_GOAL
                                          : w->first[group] == i && w->pending[group] ? ROLE_SOURCE
                                                                                      : 0u);
        else if (w->role[i].goal)
            w->words[i] = ROLE_GOAL;
    }
    for (uint32_t i = 0; i < w->cells; i++)
        if (w->words[i] != 0 && !shows(w, TN_FRONTIER_EXIT, i))
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
    w->words[0] =
        ROLES_APART; /* of the slice: no cell has a role, so that no step across an interface can reach a goal */
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
        if (face->second != TN_NO_CELL && tn_frontier_steps(w->in->frontier, house, face, w->walk))
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

/* Joins a cell to the first of its group that is shown, and a source to the groups that it depends on. */
static bool push_inside_steps(tn_inside_walk *w, uint32_t cell, tn_key *key, size_t count)
{
    uint32_t group = group_of(w, cell), first = w->first[group];
    bool ok = true;
    if (w->shown[cell] && w->role[cell].through && !w->near[group] && first != cell)
        return push_step(w, first, cell, key, count);
    for (uint32_t g = 0; ok && w->words[cell] & ROLE_SOURCE && !w->role[cell].through && g < w->cells; g++)
        if (w->by_source[cell] >> g & 1)
            ok = push_step(w, w->first[g], cell, key, count);
    return ok;
}

bool tn_frontier_push_walks(const tn_inside *in, tn_key *key)
{
    uint32_t walks = in->frontier->questions.walk_count, cells = (uint32_t)in->house.cell_count;
    tn_inside_walk w[TN_FRONTIER_MEETINGS_MAX];
    bool ok = true;
    for (uint32_t k = 0; ok && k < walks; k++) {
        memset(&w[k], 0, sizeof w[k]);
        w[k].in = in;
        w[k].walk = k;
        w[k].cells = cells;
        if (tn_frontier_walk_placed(in->frontier, k))
            place_plainly(&w[k]);
        else
            place(&w[k]);
        for (uint32_t i = 0; ok && i < cells; i++)
            ok = tn_key_push(key, w[k].words[i]);
    }
    size_t count = key->size;
    ok = ok && tn_key_push(key, 0);
    for (uint32_t k = 0; ok && k < walks; k++) {
        bool placed = tn_frontier_walk_placed(in->frontier, k);
        ok = !placed || push_plain_steps(&w[k], key, count);
        for (uint32_t i = 0; ok && !placed && i < cells; i++)
            ok = push_inside_steps(&w[k], i, key, count);
    }
    return ok;
}

/* ==== from tray to tray
 *
 * Follows walks from tray to tray: which cells at the interface one can walk between, which of these groups have
 * reached a goal, and which sources have not reached one yet: these are pending.
 *
 * A group consists of cells to walk through, or is one source that is none of these. A pending source is a set of
 * groups, one of which has to reach a goal. If a set is part of another, only the smaller one is kept: if that never
 * reaches a goal, there is a source apart already.
 *
 * If clauses ask in which trays sources are apart (a placed walk), each set has owners: slots for the sources of trays
 * before, and one for those of the last tray. Only sets of one owner make each other needless. Slots that own the same
 * sets become one. */

enum { NODES = 2 * TN_FRONTIER_CELLS_MAX, NO_GROUP = 0xff, AT_GOAL = 0xfe };

/* Owners, as bits: below them the slots. */
enum { LAST_TRAY = 1u << TN_FRONTIER_SLOTS_MAX, NEW_TRAY = LAST_TRAY << 1 };

typedef struct tn_walking {
    const tn_frontier *frontier;
    uint32_t walk;
    const uint32_t *roles; /* of the cells of the right edge, from the slice */
    uint32_t before;       /* nodes: the groups before, then the cells of the right edge */
    uint8_t parent[NODES];
    bool near[NODES];
    tn_uint128 pending[4 * TN_FRONTIER_CELLS_MAX]; /* sets of nodes */
    uint32_t owners[4 * TN_FRONTIER_CELLS_MAX];    /* of each; 0 if the walk is not placed */
    uint32_t count;
    bool inside; /* the row has begun: a source that is apart may be said at once */
    bool placed;
    uint32_t resolved; /* owners that have a source that is apart */
    bool apart, too_many;
} tn_walking;

tn_frontier_role tn_frontier_role_of(const tn_frontier *frontier, uint32_t walk, const uint64_t *answers, bool open)
{
    const tn_frontier_walk *w = &frontier->questions.walk_parts[walk];
    tn_frontier_role role = {false, false, false, false};
    if (open)
        return role;
    role.through = w->any || tn_answers(answers, w->through);
    role.goal = tn_answers(answers, w->second);
    role.source = !role.goal && tn_answers(answers, w->first);
    return role;
}

static tn_frontier_role role_at_left(const tn_walking *w, const tn_frontier_edge *edge, uint32_t cell)
{
    return tn_frontier_role_of(w->frontier, w->walk, tn_edge_answers(w->frontier, edge, cell), edge->cells[cell].open);
}

static tn_frontier_role role_at_right(const tn_walking *w, uint32_t cell)
{
    uint32_t word = w->roles[cell];
    return (tn_frontier_role){word & ROLE_THROUGH, word & ROLE_GOAL, word & ROLE_SOURCE, word & ROLE_ENDS};
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

static void add_pending(tn_walking *w, tn_uint128 set, uint32_t owners)
{
    w->too_many = w->too_many || w->count == sizeof w->pending / sizeof *w->pending;
    if (w->too_many)
        return;
    w->owners[w->count] = owners;
    w->pending[w->count++] = set;
}

/* One of the two ways through a face: from the cell at node a to the cell at node b. */
static void step(tn_walking *w, uint8_t a, tn_frontier_role from, uint8_t b, tn_frontier_role to)
{
    if (b != NO_GROUP && from.goal) {
        if (b != AT_GOAL)
            w->near[root_of(w, b)] = true;
        return;
    }
    if (a == NO_GROUP || b == NO_GROUP || !from.through || to.through || !to.source || b == AT_GOAL)
        return;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->pending[i] >> b & 1)
            w->pending[i] |= a == AT_GOAL ? 0 : (tn_uint128)1 << a;
    if (a == AT_GOAL)
        w->near[b] = true;
}

static void pass(tn_walking *w, uint8_t a, tn_frontier_role from, uint8_t b, tn_frontier_role to)
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

/* ---- before: {group of each cell, number of groups, then two words for each set; of a placed walk, three: its owners}
 */

static uint8_t node_before(const uint32_t *state, uint32_t cell)
{
    return (uint8_t)state[cell];
}

static void begin_left(tn_walking *w, const uint32_t *state, size_t size, uint32_t cells)
{
    size_t each = w->placed ? 3 : 2;
    w->before = state[cells];
    for (size_t i = cells + 1; i < size; i += each)
        add_pending(w, tn_both(state + i), w->placed ? state[i + 2] : 0);
}

static void begin_right(tn_walking *w, const tn_frontier_edge *edge)
{
    for (uint32_t n = 0; n < w->before + edge->count; n++) {
        w->parent[n] = (uint8_t)n;
        w->near[n] = false;
    }
    if (edge->count > 0 && w->roles[0] & ROLES_APART)
        add_pending(w, 0, 0);
    for (uint32_t i = 0; i < edge->count; i++) {
        tn_frontier_role role = role_at_right(w, i);
        w->near[w->before + i] = role.goal;
        if (role.source)
            add_pending(w, (tn_uint128)1 << (w->before + i), w->placed ? NEW_TRAY : 0);
    }
}

/* ---- after */

/* The group of each right cell, by the first cell in it. */
static uint32_t number_groups(tn_walking *w, const tn_frontier_edge *edge, uint32_t group[TN_FRONTIER_CELLS_MAX],
                              uint32_t of_node[NODES])
{
    uint32_t count = 0;
    memset(of_node, 0xff, NODES * sizeof *of_node);
    for (uint32_t i = 0; edge && i < edge->count; i++) {
        tn_frontier_role role = role_at_right(w, i);
        uint8_t root = root_of(w, (uint8_t)(w->before + i));
        group[i] = NO_GROUP;
        if ((!role.through && !role.source) || role.ends)
            continue;
        if (w->near[root])
            group[i] = AT_GOAL;
        else
            group[i] = of_node[root] = of_node[root] == UINT32_MAX ? count++ : of_node[root];
    }
    return count;
}

/* Drops the sets that have reached a goal; the others become sets of groups at the interface. */
static void carry(tn_walking *w, const uint32_t of_node[NODES])
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        tn_uint128 set = 0;
        bool near = false;
        for (uint8_t n = 0; n < NODES; n++) {
            if (!(w->pending[i] >> n & 1))
                continue;
            uint8_t root = root_of(w, n);
            near = near || w->near[root];
            set |= of_node[root] == UINT32_MAX ? 0 : (tn_uint128)1 << of_node[root];
        }
        if (near)
            continue;
        w->apart = w->apart || set == 0;
        w->resolved |= set == 0 ? w->owners[i] : 0;
        w->owners[kept] = w->owners[i];
        w->pending[kept++] = set;
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
            least = k == i || (w->pending[k] & ~w->pending[i]) != 0 || (w->pending[k] == w->pending[i] && k > i);
        tn_uint128 set = w->pending[i];
        if (!least)
            continue;
        uint32_t at = kept++;
        for (; at > 0 && w->pending[at - 1] > set; at--)
            w->pending[at] = w->pending[at - 1];
        w->pending[at] = set;
    }
    w->count = kept;
}

/* ---- placed walks */

/* Drops what has become known, and sets that an owner has a smaller one than; equal sets become one. */
static void reduce_owned(tn_walking *w)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < w->count; i++)
        w->owners[i] &= ~w->resolved;
    for (uint32_t i = 0; i < w->count; i++)
        for (uint32_t k = 0; k < w->count; k++)
            if (w->pending[k] != w->pending[i] && (w->pending[k] & ~w->pending[i]) == 0)
                w->owners[i] &= ~w->owners[k];
    for (uint32_t i = 0; i < w->count; i++) {
        tn_uint128 set = w->pending[i];
        uint32_t owners = w->owners[i], at = 0;
        while (at < kept && w->pending[at] < set)
            at++;
        if (at < kept && w->pending[at] == set)
            w->owners[at] |= owners;
        if (owners == 0 || (at < kept && w->pending[at] == set))
            continue;
        memmove(w->pending + at + 1, w->pending + at, (kept - at) * sizeof *w->pending);
        memmove(w->owners + at + 1, w->owners + at, (kept - at) * sizeof *w->owners);
        w->pending[at] = set;
        w->owners[at] = owners;
        kept++;
    }
    w->count = kept;
}

static uint32_t all_owners(const tn_walking *w)
{
    uint32_t owners = 0;
    for (uint32_t i = 0; i < w->count; i++)
        owners |= w->owners[i];
    return owners;
}

static bool own_alike(const tn_walking *w, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < w->count; i++)
        if (!(w->owners[i] & a) != !(w->owners[i] & b))
            return false;
    return true;
}

/* What the owner's sets go to: a slot that owns the same, or the one that is given. */
static uint32_t hand_over(tn_walking *w, uint32_t owner, uint32_t slots, uint32_t slot)
{
    for (uint32_t s = 0; s < slots; s++)
        if (all_owners(w) >> s & 1 && own_alike(w, owner, 1u << s)) {
            slot = s;
            break;
        }
    for (uint32_t i = 0; i < w->count; i++)
        if (w->owners[i] & owner)
            w->owners[i] = (w->owners[i] & ~owner) | 1u << slot;
    return slot;
}

/* What is seen at the right side of the last tray. */
static void see_owners(tn_walking *w, uint32_t *seen)
{
    for (uint32_t s = 0; s < TN_FRONTIER_SLOTS_MAX; s++) {
        uint32_t *word = &seen[SEEN_SLOTS + s];
        *word = w->resolved >> s & 1 ? WALK_APART : WALK_NONE;
        if (!(all_owners(w) >> s & 1))
            continue;
        uint32_t to = hand_over(w, 1u << s, s, s);
        *word = to == s ? WALK_ON : WALK_TO + to;
    }
    seen[SEEN_FIRST] = w->resolved & LAST_TRAY ? WALK_APART : WALK_NONE;
    if (!(all_owners(w) & LAST_TRAY))
        return;
    uint32_t free = 0;
    while (all_owners(w) >> free & 1)
        free++;
    uint32_t to = hand_over(w, LAST_TRAY, TN_FRONTIER_SLOTS_MAX, free);
    seen[SEEN_FIRST] = to < TN_FRONTIER_SLOTS_MAX ? WALK_TO + to : SEEN_TOO_MANY;
}

/* What is the new tray's after this interface is the last tray's before the next one. */
static void follow_owners(tn_walking *w, uint32_t *seen)
{
    reduce_owned(w);
    see_owners(w, seen);
    for (uint32_t i = 0; i < w->count; i++)
        w->owners[i] = (w->owners[i] & ~NEW_TRAY) | (w->owners[i] & NEW_TRAY ? LAST_TRAY : 0);
}

/* seen: of a placed walk. */
static tn_status number_after(tn_frontier *frontier, tn_walking *w, const tn_frontier_edge *edge, uint32_t *after,
                              uint32_t *seen, tn_error *error)
{
    uint32_t group[TN_FRONTIER_CELLS_MAX], of_node[NODES];
    uint32_t count = number_groups(w, edge, group, of_node);
    carry(w, of_node);
    tn_key *key = &frontier->key;
    key->size = 0;
    *after = 0;
    if (w->placed)
        follow_owners(w, seen);
    if (!w->placed && w->apart && w->inside)
        w->count = 0; /* the answer is known: other sets matter only if it is asked where */
    if (!w->placed)
        reduce(w);
    bool ok = true;
    for (uint32_t i = 0; ok && edge && i < edge->count; i++)
        ok = tn_key_push(key, group[i]);
    ok = ok && tn_key_push(key, count);
    for (uint32_t i = 0; ok && i < w->count; i++)
        ok = tn_push_long(key, (uint64_t)w->pending[i]) && (!w->placed || tn_key_push(key, w->owners[i]));
    *after = ok ? tn_intern(&frontier->crossed.walks, key->data, key->size) : UINT32_MAX;
    return *after != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

tn_status tn_frontier_walk_cross(tn_frontier *frontier, uint32_t walk, uint32_t before, const tn_frontier_crossing *c,
                                 uint32_t *after, bool *apart, uint32_t *seen, tn_error *error)
{
    tn_walking w = {.frontier = frontier,
                    .walk = walk,
                    .inside = c->left != NULL,
                    .placed = tn_frontier_walk_placed(frontier, walk)};
    size_t size = 0;
    const uint32_t *state = c->left ? tn_interned(&frontier->crossed.walks, before, &size) : NULL;
    uint32_t right = c->right ? c->right->count : 0;
    if (c->left)
        begin_left(&w, state, size, c->left->count);
    static const tn_frontier_edge nothing = {0};
    const uint32_t *roles = right ? c->slice + SLICE_CELLS + (size_t)CELL_WORDS * right : NULL, *steps = c->outcome + 3;
    w.roles = right ? roles + (size_t)walk * right : NULL;
    begin_right(&w, c->right ? c->right : &nothing);
    for (uint32_t i = 0; i < c->outcome[2]; i++, steps += STEP_WORDS)
        if (steps[STEP_HOW] >> (walk + 1) & 1)
            pass(&w, node_before(state, steps[STEP_FROM]), role_at_left(&w, c->left, steps[STEP_FROM]),
                 (uint8_t)(w.before + steps[STEP_TO]), role_at_right(&w, steps[STEP_TO]));
    steps = right ? roles + (size_t)frontier->questions.walk_count * right : NULL;
    for (uint32_t i = 0, count = steps ? *steps++ : 0; i < count; i++, steps += STEP_WORDS)
        if (steps[STEP_HOW] >> (walk + 1) & 1)
            pass(&w, (uint8_t)(w.before + steps[STEP_FROM]), role_at_right(&w, steps[STEP_FROM]),
                 (uint8_t)(w.before + steps[STEP_TO]), role_at_right(&w, steps[STEP_TO]));
    if (w.too_many)
        return tn_frontier_limit(frontier, NULL, "more sources wait for a walk than can be told apart at once", error);
    tn_status status = number_after(frontier, &w, c->right, after, seen, error);
    *apart = w.apart && w.inside;
    return status;
}

/* ---- what the right side of an interface can tell of the walk before it */

/* Appends the steps from cells of the left edge, each with its role and its group, by number in the order of the steps.
 */
static bool push_steps(const tn_walking *w, const uint32_t *state, const tn_frontier_edge *left,
                       const uint32_t *outcome, uint32_t of_node[NODES], tn_key *key)
{
    const uint32_t *step = outcome + 3;
    uint32_t count = 0;
    bool ok = true;
    memset(of_node, 0xff, NODES * sizeof *of_node);
    for (uint32_t i = 0; ok && i < outcome[2]; i++, step += STEP_WORDS) {
        if (!(step[STEP_HOW] >> (w->walk + 1) & 1))
            continue;
        tn_frontier_role role = role_at_left(w, left, step[STEP_FROM]);
        uint32_t node = node_before(state, step[STEP_FROM]);
        if (node < w->before)
            node = of_node[node] = of_node[node] == UINT32_MAX ? count++ : of_node[node];
        ok = tn_key_push(key, step[STEP_TO]) &&
             tn_key_push(key, node << 3 | (uint32_t)role.through * ROLE_THROUGH | (uint32_t)role.goal * ROLE_GOAL |
                                  (uint32_t)role.source * ROLE_SOURCE);
    }
    return ok;
}

tn_status tn_frontier_walk_view(const tn_frontier *frontier, uint32_t walk, uint32_t before,
                                const tn_frontier_edge *left, const uint32_t *outcome, tn_key *key, tn_error *error)
{
    tn_walking w = {.frontier = frontier, .walk = walk, .inside = true};
    uint32_t of_node[NODES];
    size_t size;
    const uint32_t *state = tn_interned(&frontier->crossed.walks, before, &size);
    begin_left(&w, state, size, left->count);
    for (uint32_t n = 0; n < w.before; n++)
        w.parent[n] = (uint8_t)n;
    bool ok = push_steps(&w, state, left, outcome, of_node, key);
    carry(&w, of_node);
    if (w.apart)
        w.count = 0; /* the answer is known */
    reduce(&w);
    ok = ok && tn_key_push(key, TN_FRONTIER_NONE) && tn_key_push(key, w.apart);
    for (uint32_t i = 0; ok && i < w.count; i++)
        ok = tn_push_long(key, (uint64_t)w.pending[i]);
    return ok ? TN_OK : tn_fail_memory(error);
}
