/* Which branches of a face join ("Genr8", 4.3): same region, same label, distinct vertices that no edge links already,
 * directions opposed to within BranchAngle, near enough. The nearest pair joins first; distances are quantised, so that
 * equal ones are equal in spite of rounding, and ties go by the branches' numbers. */
#include "runtime/growth/join/join.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/growth/join/branch_tree.h"

static bool loop_pairs(tn_loop *loop, const tn_growth *growth);
static bool loop_links(const tn_loop *loop, uint32_t u, uint32_t v);
static bool loop_join_pair(tn_loop *loop, const tn_candidate *pair);

/* ==== keeps the pairs of vertices that are linked */

void tn_pair_set_clear(tn_pair_set *set)
{
    free(set->slots);
    *set = (tn_pair_set){0};
}

static uint64_t key_of(uint32_t u, uint32_t v)
{
    return u < v ? (uint64_t)u << 32 | v : (uint64_t)v << 32 | u;
}

static size_t slot_of(const tn_pair_set *set, uint64_t key)
{
    size_t i = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & (set->capacity - 1);
    while (set->slots[i] != 0 && set->slots[i] != key)
        i = (i + 1) & (set->capacity - 1);
    return i;
}

bool tn_pair_set_has(const tn_pair_set *set, uint32_t u, uint32_t v)
{
    uint64_t key = key_of(u, v);
    return set->capacity && set->slots[slot_of(set, key)] == key;
}

static bool grow(tn_pair_set *set)
{
    tn_pair_set larger = {.count = set->count, .capacity = set->capacity ? 2 * set->capacity : 64};
    larger.slots = calloc(larger.capacity, sizeof *larger.slots);
    if (!larger.slots)
        return false;
    for (size_t i = 0; i < set->capacity; i++)
        if (set->slots[i])
            larger.slots[slot_of(&larger, set->slots[i])] = set->slots[i];
    free(set->slots);
    *set = larger;
    return true;
}

bool tn_pair_set_add(tn_pair_set *set, uint32_t u, uint32_t v)
{
    if (2 * set->count >= set->capacity && !grow(set))
        return false;
    uint64_t key = key_of(u, v);
    size_t slot = slot_of(set, key);
    set->count += set->slots[slot] == 0;
    set->slots[slot] = key;
    return true;
}

/* ==== finds what lies around a vertex of the old map */

/* A dart on its way round a vertex of the old map. Hubs have very many faces, and faces very many vertices: of two ways
 * round that answer a question, both are gone side by side until the shorter one is over. */
typedef struct walker {
    uint32_t start, dart, face;
} walker;

static walker walk_around(uint32_t face, const tn_loop_branch *branch)
{
    return (walker){branch->corner, branch->corner, face};
}

/* To the next dart of the vertex; false if that is the first. */
static bool turn(const tn_pass *pass, walker *at)
{
    const tn_map *old = pass->old;
    bool first = at->dart == old->face_first[at->face];
    uint32_t arriving = (first ? old->face_first[at->face + 1] : at->dart) - 1, side = old->side[arriving] ^ 1;
    at->dart = pass->dart[side];
    at->face = pass->sides[side].face;
    return at->dart != at->start;
}

/* The vertex at the other end of the first piece of what a dart's edge became. */
static uint32_t neighbour(const tn_pass *pass, uint32_t side)
{
    const tn_record *record = &pass->records[side / 2];
    if (tn_is_kept(record))
        return pass->sides[side ^ 1].origin;
    uint32_t pieces = pass->growth->shapes[record->template].template->segment_count;
    bool against = side & 1;
    if (pieces > 1)
        return against ? record->vertex + pieces - 2 : record->vertex;
    uint32_t far = side / 2;
    if (pass->runs)
        far = against ? pass->runs[far].first : pass->runs[far].last;
    return pass->sides[2 * (size_t)far + (against ? 0 : 1)].origin;
}

static bool old_vertices_linked(const tn_pass *pass, uint32_t face, const tn_loop_branch *a, uint32_t u,
                                const tn_loop_branch *b, uint32_t v)
{
    walker at_u = walk_around(face, a), at_v = walk_around(face, b);
    do {
        if (neighbour(pass, pass->old->side[at_u.dart]) == v || neighbour(pass, pass->old->side[at_v.dart]) == u)
            return true;
    } while (turn(pass, &at_u) && turn(pass, &at_v));
    return false;
}

/* Is a new vertex the first on its edge, from an old one? */
static bool next_to(const tn_pass *pass, const tn_loop_branch *new, uint32_t old_vertex)
{
    uint32_t edge = pass->old->side[new->corner] / 2;
    tn_edge_run run = pass->runs ? pass->runs[edge] : (tn_edge_run){edge, edge};
    uint32_t pieces = pass->growth->shapes[pass->records[edge].template].template->segment_count;
    return (new->point == 1 && pass->sides[2 * (size_t)run.first].origin == old_vertex) ||
           (new->point + 1 == pieces && pass->sides[2 * (size_t)run.last + 1].origin == old_vertex);
}

/* Before this pass's joins: does an edge link the branches' vertices? Both lie in one face. */
static bool linked_before(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                          const tn_loop_branch *b)
{
    uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
    bool a_new = a->beyond != TN_NONE, b_new = b->beyond != TN_NONE;
    if (a_new && b_new)
        return a->edge == b->edge && (a->point + 1 == b->point || b->point + 1 == a->point);
    if (a_new || b_new)
        return a_new ? next_to(pass, a, v) : next_to(pass, b, u);
    return old_vertices_linked(pass, face, a, u, b, v);
}

/* Is a vertex, in a dart of which a walk begins, on a face? */
static bool touches(const tn_pass *pass, walker at, uint32_t vertex, uint32_t face)
{
    const tn_map *old = pass->old;
    for (uint32_t d = old->face_first[face]; d < old->face_first[face + 1]; d++) {
        if (at.face == face || old->origin[d] == vertex)
            return true;
        if (!turn(pass, &at))
            return false;
    }
    return false;
}

/* Does another interior face touch both vertices, so that a join there would link them? */
static bool share_another_face(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                               const tn_loop_branch *b)
{
    bool a_new = a->beyond != TN_NONE, b_new = b->beyond != TN_NONE;
    if (a_new && b_new)
        return a->beyond == b->beyond && a->beyond != TN_OUTER_FACE;
    uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
    if (a_new)
        return a->beyond != TN_OUTER_FACE && touches(pass, walk_around(face, b), v, a->beyond);
    if (b_new)
        return b->beyond != TN_OUTER_FACE && touches(pass, walk_around(face, a), u, b->beyond);
    walker at_u = walk_around(face, a), at_v = walk_around(face, b);
    do {
        if ((at_u.face != face && at_u.face != TN_OUTER_FACE && touches(pass, walk_around(face, b), v, at_u.face)) ||
            (at_v.face != face && at_v.face != TN_OUTER_FACE && touches(pass, walk_around(face, a), u, at_v.face)))
            return true;
    } while (turn(pass, &at_u) && turn(pass, &at_v));
    return false;
}

/* ==== A face's loop as a pass leaves it: each dart's pieces, and the branches at its corners */

void tn_loop_clear(tn_loop *loop)
{
    free(loop->items);
    free(loop->branches);
    free(loop->candidates);
    free(loop->joins);
    *loop = (tn_loop){0};
}

static bool make_room(tn_loop *loop, size_t items, size_t branches)
{
    return tn_array_reserve(&loop->items, &loop->item_room, loop->item_count, items, sizeof *loop->items) &&
           tn_array_reserve(&loop->branches, &loop->branch_room, loop->branch_count, branches, sizeof *loop->branches);
}

static void add_dart(tn_loop *loop, uint32_t vertex, uint32_t side)
{
    loop->items[loop->item_count++] = (tn_loop_item){vertex, side, 0, false, false};
}

/* A branch of a replaced edge; its direction is filled in by the caller. */
static void add_branch(tn_loop *loop, const tn_pass *pass, uint32_t edge, uint32_t index, uint32_t vertex,
                       uint32_t corner)
{
    const tn_record *record = &pass->records[edge];
    uint32_t id = record->branch + index, beyond = pass->aims[id - pass->branch_first].beyond;
    const tn_template *template = pass->growth->shapes[record->template].template;
    const tn_template_branch *b = &template->branches[index];
    bool old = b->at == 0 || b->at == template->segment_count;
    loop->branches[loop->branch_count] = (tn_loop_branch){.at = tn_vector_at(pass->new->positions + 3 * (size_t)vertex),
                                                          .id = id,
                                                          .label = b->label,
                                                          .item = loop->item_count,
                                                          .age = tn_changed_age(b->age, record->age),
                                                          .partner = -1,
                                                          .edge = pass->runs ? pass->runs[edge].first : edge,
                                                          .point = b->at,
                                                          .beyond = old ? TN_NONE : beyond,
                                                          .corner = corner,
                                                          .reversed = b->reversed};
    loop->items[loop->item_count++] = (tn_loop_item){vertex, loop->branch_count++, 0, true, false};
}

/* Directions of the branches from `first` on, which are those of an edge (or of its chain). */
static void turn_branches(tn_loop *loop, const tn_pass *pass, uint32_t edge, uint32_t first)
{
    if (first == loop->branch_count)
        return;
    const tn_record *record = &pass->records[edge];
    tn_edge_run run = pass->runs ? pass->runs[edge] : (tn_edge_run){edge, edge};
    tn_vector heading, up;
    double length;
    tn_pass_frame(pass, run.first, run.last, &heading, &up, &length);
    for (uint32_t i = first; i < loop->branch_count; i++) {
        tn_loop_branch *branch = &loop->branches[i];
        branch->direction = tn_branch_direction(
            heading, up, &pass->growth->system->templates[record->template].branches[branch->id - record->branch]);
    }
}

static void add_pending(tn_loop *loop, const tn_pass *pass, const tn_pending *pending, uint32_t vertex)
{
    tn_loop_branch *branch = &loop->branches[loop->branch_count];
    *branch = (tn_loop_branch){.direction = tn_vector_at(pending->direction),
                               .at = tn_vector_at(pass->new->positions + 3 * (size_t)vertex),
                               .id = pending->id,
                               .label = pending->label,
                               .item = loop->item_count,
                               .age = pending->age,
                               .partner = -1,
                               .edge = TN_NONE,
                               .beyond = TN_NONE,
                               .corner = pending->dart,
                               .reversed = pending->reversed};
    loop->items[loop->item_count++] = (tn_loop_item){vertex, loop->branch_count++, 0, true, false};
}

/* The pieces of a replaced edge along one side, from the old dart `here` on; `next` is the one after them. */
static void add_pieces(tn_loop *loop, const tn_pass *pass, uint32_t edge, bool against, uint32_t here, uint32_t next,
                       bool branches)
{
    uint32_t start = pass->old->origin[here], end = pass->old->origin[next];
    const tn_record *record = &pass->records[edge];
    const tn_shape *shape = &pass->growth->shapes[record->template];
    const tn_walk *walk = against ? shape->right : shape->left;
    uint32_t count = against ? shape->right_count : shape->left_count, points = shape->template->segment_count;
    for (uint32_t i = 0; i < count; i++) {
        if (walk[i].branch && !branches)
            continue;
        uint32_t at = walk[i].at, vertex = record->vertex + at - 1;
        bool leaves_end = at == (against ? 0 : points);
        if (leaves_end)
            vertex = end;
        else if (at == 0 || at == points)
            vertex = start;
        if (walk[i].branch)
            add_branch(loop, pass, edge, walk[i].index, vertex, leaves_end ? next : here);
        else
            add_dart(loop, vertex, record->side + 2 * walk[i].index + (walk[i].reversed != against));
    }
}

bool tn_loop_expand(tn_loop *loop, const tn_pass *pass, uint32_t face, bool branches)
{
    const tn_map *old = pass->old;
    uint32_t first = old->face_first[face], size = tn_face_size(old, face);
    const uint32_t *sides = old->side + first, *origins = old->origin + first;
    const tn_pending_list *list = &pass->growth->pending;
    const tn_pending *pending = NULL, *pending_end = NULL;
    if (branches && list->count) {
        pending = list->items + list->face_first[face];
        pending_end = list->items + list->face_first[face + 1];
    }
    loop->item_count = loop->branch_count = loop->join_count = loop->candidate_count = 0;
    for (uint32_t i = 0; i < size; i++) {
        uint32_t edge = sides[i] / 2, room = 1, next = i + 1;
        bool against = sides[i] & 1;
        const tn_record *record = &pass->records[edge];
        const tn_shape *shape = tn_is_kept(record) ? NULL : &pass->growth->shapes[record->template];
        if (shape) {
            if (pass->runs && edge != (against ? pass->runs[edge].last : pass->runs[edge].first))
                continue; /* within a chain: its head on this side stands for all of it */
            while (pass->runs && pass->runs[sides[next % size] / 2].first == pass->runs[edge].first)
                next++;
            room = against ? shape->right_count : shape->left_count;
        }
        size_t waiting = (size_t)(pending_end - pending);
        if (!make_room(loop, room + waiting, room + waiting))
            return false;
        while (pending < pending_end && pending->dart == first + i)
            add_pending(loop, pass, pending++, origins[i]);
        uint32_t before = loop->branch_count;
        if (shape)
            add_pieces(loop, pass, edge, against, first + i, first + next % size, branches);
        else
            add_dart(loop, origins[i], record->side | against);
        turn_branches(loop, pass, edge, before);
    }
    return true;
}

/* ==== joining so that mirrored branches join alike (`Even`, docs/growth.md). Pairs are taken nearest first, all that
 * are equally near together. Of those, a pair joins only if it shares no branch with another, does not cross another,
 * and is the only one that links its vertices. What is left then is the same in whatever order it joins */

/* Pairs of one distance, and what of them is where on the loop. */
typedef struct tie {
    tn_loop *loop;
    tn_candidate *pairs; /* the first of them; those that cannot join are taken out */
    uint32_t count;
    uint32_t *place; /* [branch] among the branches, in the order of the loop */
    uint32_t *ends;  /* [branch count + 1] ends of pairs at places below this one */
    uint32_t *order; /* pairs, by where they end */
    uint32_t *tree;  /* [branch count + 1] pairs that end before the one at hand, counted by where they begin */
    tn_pair_set once, twice;
} tie;

static void clear(tie *t)
{
    free(t->place);
    free(t->ends);
    free(t->order);
    free(t->tree);
    tn_pair_set_clear(&t->once);
    tn_pair_set_clear(&t->twice);
}

static int by_item(const void *left, const void *right)
{
    const uint32_t *a = left, *b = right;
    return a[0] < b[0] ? -1 : a[0] > b[0];
}

static bool prepare(tie *t)
{
    uint32_t branches = t->loop->branch_count;
    uint32_t(*items)[2] = malloc((branches + 1) * sizeof *items);
    t->place = malloc((branches + 1) * sizeof *t->place);
    t->ends = malloc((branches + 2) * sizeof *t->ends);
    t->tree = malloc((branches + 2) * sizeof *t->tree);
    t->order = malloc((t->loop->candidate_count + 1) * sizeof *t->order);
    bool fine = items && t->place && t->ends && t->tree && t->order;
    for (uint32_t b = 0; fine && b < branches; b++) {
        items[b][0] = t->loop->branches[b].item;
        items[b][1] = b;
    }
    if (fine)
        qsort(items, branches, sizeof *items, by_item);
    for (uint32_t i = 0; fine && i < branches; i++)
        t->place[items[i][1]] = i;
    free(items);
    return fine;
}

static uint32_t vertex_of(const tie *t, uint32_t branch)
{
    return t->loop->items[t->loop->branches[branch].item].vertex;
}

static bool is_possible(const tie *t, const tn_pass *pass, uint32_t face, const tn_candidate *pair)
{
    const tn_loop *loop = t->loop;
    const tn_loop_branch *a = &loop->branches[pair->low], *b = &loop->branches[pair->high];
    return a->partner < 0 && b->partner < 0 && loop->items[a->item].region == loop->items[b->item].region &&
           !loop_links(loop, vertex_of(t, pair->low), vertex_of(t, pair->high)) &&
           !linked_before(loop, pass, face, a, b) && !share_another_face(loop, pass, face, a, b);
}

/* Leaves the pairs that are possible, and counts their ends. */
static bool keep_possible(tie *t, const tn_pass *pass, uint32_t face)
{
    uint32_t kept = 0;
    bool fine = true;
    memset(t->ends, 0, (t->loop->branch_count + 2) * sizeof *t->ends);
    for (uint32_t i = 0; i < t->count && fine; i++) {
        tn_candidate pair = t->pairs[i];
        if (!is_possible(t, pass, face, &pair))
            continue;
        t->pairs[kept++] = pair;
        t->ends[t->place[pair.low] + 1]++;
        t->ends[t->place[pair.high] + 1]++;
        uint32_t u = vertex_of(t, pair.low), v = vertex_of(t, pair.high);
        fine = tn_pair_set_add(tn_pair_set_has(&t->once, u, v) ? &t->twice : &t->once, u, v);
    }
    t->count = kept;
    for (uint32_t i = 1; i <= t->loop->branch_count; i++)
        t->ends[i] += t->ends[i - 1];
    return fine;
}

static void span_of(const tie *t, const tn_candidate *pair, uint32_t *from, uint32_t *to)
{
    uint32_t a = t->place[pair->low], b = t->place[pair->high];
    *from = a < b ? a : b;
    *to = a < b ? b : a;
}

/* By where they end; counted into place, so that it takes no more than the pairs and branches together. */
static void order_by_end(tie *t, uint32_t *first)
{
    uint32_t branches = t->loop->branch_count, from, to;
    memset(first, 0, (branches + 2) * sizeof *first);
    for (uint32_t i = 0; i < t->count; i++) {
        span_of(t, &t->pairs[i], &from, &to);
        first[to + 1]++;
    }
    for (uint32_t i = 1; i <= branches; i++)
        first[i] += first[i - 1];
    for (uint32_t i = 0; i < t->count; i++) {
        span_of(t, &t->pairs[i], &from, &to);
        t->order[first[to]++] = i;
    }
}

/* Pairs that begin behind a place, of those noted so far. */
static uint32_t behind(const tie *t, uint32_t place)
{
    uint32_t sum = 0;
    for (uint32_t i = place + 2; i <= t->loop->branch_count; i += i & (0 - i))
        sum += t->tree[i];
    return sum;
}

static void note(tie *t, uint32_t place)
{
    for (uint32_t i = place + 1; i > 0; i -= i & (0 - i))
        t->tree[i]++;
}

/* Without a shared branch, a pair crosses another where an end lies between its own whose other end does not. */
static void take_out(tie *t)
{
    order_by_end(t, t->tree);
    memset(t->tree, 0, (t->loop->branch_count + 2) * sizeof *t->tree);
    for (uint32_t i = 0; i < t->count; i++) {
        tn_candidate *pair = &t->pairs[t->order[i]];
        uint32_t from, to;
        span_of(t, pair, &from, &to);
        uint32_t between = t->ends[to] - t->ends[from + 1], whole = behind(t, from);
        bool shared = t->ends[from + 1] - t->ends[from] > 1 || t->ends[to + 1] - t->ends[to] > 1;
        bool double_link = tn_pair_set_has(&t->twice, vertex_of(t, pair->low), vertex_of(t, pair->high));
        note(t, from);
        if (shared || double_link || between != 2 * whole)
            pair->distance = -1;
    }
}

static tn_join_outcome join_tie(tie *t, const tn_pass *pass, uint32_t face)
{
    if (!keep_possible(t, pass, face))
        return TN_JOIN_MEMORY;
    if (t->count > 1)
        take_out(t);
    for (uint32_t i = 0; i < t->count; i++)
        if (t->pairs[i].distance >= 0 && !loop_join_pair(t->loop, &t->pairs[i]))
            return TN_JOIN_MEMORY;
    tn_pair_set_clear(&t->once);
    tn_pair_set_clear(&t->twice);
    return TN_JOINED;
}

/* The way of `Even`: of pairs that are equally near, those that exclude each other do not join, so that
 * no join hangs on the order of branches. */
static tn_join_outcome loop_join_even(tn_loop *loop, const tn_pass *pass, uint32_t face)
{
    tie t = {.loop = loop};
    bool fine = loop_pairs(loop, pass->growth) && prepare(&t);
    tn_join_outcome outcome = fine ? TN_JOINED : TN_JOIN_MEMORY;
    for (uint32_t i = 0, next; i < loop->candidate_count && outcome == TN_JOINED; i = next) {
        for (next = i + 1; next < loop->candidate_count; next++)
            if (loop->candidates[next].distance != loop->candidates[i].distance)
                break;
        t.pairs = loop->candidates + i;
        t.count = next - i;
        outcome = join_tie(&t, pass, face);
    }
    clear(&t);
    return outcome;
}

#define FEW 96u /* branches of a face, up to which comparing all of them is the less work */

/* ---- pairs of branches */

tn_join_failure tn_branches_measure(const tn_growth *growth, tn_vector a_direction, tn_vector a_at,
                                    tn_vector b_direction, tn_vector b_at, double *distance)
{
    tn_vector way = tn_sub(b_at, a_at);
    double length = tn_norm(way);
    if (growth->options.facing &&
        (tn_dot(a_direction, way) <= 1e-9 * length || tn_dot(b_direction, way) >= -1e-9 * length))
        return TN_FAIL_FACING;
    if (length > tn_branch_reach(growth))
        return TN_FAIL_DISTANCE;
    *distance = tn_quantised(growth, length);
    return TN_JOIN_FAILURE_COUNT;
}

tn_join_failure tn_branches_compare(const tn_growth *growth, const tn_loop_branch *a, const tn_loop_branch *b,
                                    double *distance)
{
    if (!tn_branches_oppose(growth, a->direction, b->direction))
        return TN_FAIL_ANGLE;
    return tn_branches_measure(growth, a->direction, a->at, b->direction, b->at, distance);
}

static bool add_candidate(tn_loop *loop, tn_candidate candidate)
{
    if (!tn_array_reserve(&loop->candidates, &loop->candidate_room, loop->candidate_count, 1, sizeof *loop->candidates))
        return false;
    loop->candidates[loop->candidate_count++] = candidate;
    return true;
}

static bool find_candidates(tn_loop *loop, const tn_growth *growth)
{
    for (uint32_t i = 0; i < loop->branch_count; i++) {
        const tn_loop_branch *a = &loop->branches[i];
        for (uint32_t j = i + 1; j < loop->branch_count; j++) {
            const tn_loop_branch *b = &loop->branches[j];
            double distance;
            if (a->label != b->label || loop->items[a->item].vertex == loop->items[b->item].vertex ||
                tn_branches_compare(growth, a, b, &distance) != TN_JOIN_FAILURE_COUNT)
                continue;
            tn_candidate one = a->id < b->id ? (tn_candidate){distance, i, j} : (tn_candidate){distance, j, i};
            if (!add_candidate(loop, one))
                return false;
        }
    }
    return true;
}

static void sift(const tn_loop *loop, tn_candidate *heap, uint32_t at, uint32_t count)
{
    tn_candidate moving = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && tn_candidate_before(loop, &heap[child], &heap[child + 1]))
            child++;
        if (!tn_candidate_before(loop, &moving, &heap[child]))
            break;
        heap[at] = heap[child];
    }
    heap[at] = moving;
}

static void sort_candidates(tn_loop *loop)
{
    tn_candidate *list = loop->candidates;
    uint32_t count = loop->candidate_count;
    if (count <= 16) {
        for (uint32_t i = 1; i < count; i++) {
            tn_candidate moving = list[i];
            uint32_t j = i;
            for (; j > 0 && tn_candidate_before(loop, &moving, &list[j - 1]); j--)
                list[j] = list[j - 1];
            list[j] = moving;
        }
        return;
    }
    for (uint32_t i = count / 2; i-- > 0;)
        sift(loop, list, i, count);
    for (uint32_t end = count - 1; end > 0; end--) {
        tn_candidate top = list[0];
        list[0] = list[end];
        list[end] = top;
        sift(loop, list, 0, end);
    }
}

/* Does a join of this face link the two vertices? */
static bool loop_links(const tn_loop *loop, uint32_t u, uint32_t v)
{
    for (uint32_t i = 0; i < loop->join_count; i++) {
        uint32_t x = loop->items[loop->branches[loop->joins[i].start].item].vertex;
        uint32_t y = loop->items[loop->branches[loop->joins[i].end].item].vertex;
        if ((x == u && y == v) || (x == v && y == u))
            return true;
    }
    return false;
}

/* ---- joining */

/* Cuts the region in two: what lies after `start` up to `end` on the loop belongs to the new face, on the side of the
 * dart that runs back from end to start. */
static void split_region(tn_loop *loop, uint32_t start, uint32_t end)
{
    tn_loop_item *items = loop->items;
    uint32_t region = items[start].region, new_region = loop->join_count;
    for (uint32_t i = start; i != end;) {
        i = i + 1 == loop->item_count ? 0 : i + 1;
        if (items[i].region == region)
            items[i].region = new_region;
    }
}

bool tn_loop_add_join(tn_loop *loop, uint32_t low, uint32_t high)
{
    if (!tn_array_reserve(&loop->joins, &loop->join_room, loop->join_count, 1, sizeof *loop->joins))
        return false;
    tn_loop_branch *a = &loop->branches[low], *b = &loop->branches[high];
    bool turned = a->reversed && !b->reversed; /* '~' marks an incoming branch */
    loop->joins[loop->join_count++] = turned ? (tn_loop_join){high, low, low} : (tn_loop_join){low, high, low};
    a->partner = (int32_t)high;
    b->partner = (int32_t)low;
    return true;
}

/* Joins a pair and cuts its region in two. False: out of memory. */
static bool loop_join_pair(tn_loop *loop, const tn_candidate *pair)
{
    if (!tn_loop_add_join(loop, pair->low, pair->high))
        return false;
    const tn_loop_join *join = &loop->joins[loop->join_count - 1];
    split_region(loop, loop->branches[join->start].item, loop->branches[join->end].item);
    return true;
}

/* All pairs that may join but for the topology, the nearest first. False: out of memory. */
static bool loop_pairs(tn_loop *loop, const tn_growth *growth)
{
    if (!find_candidates(loop, growth))
        return false;
    sort_candidates(loop);
    return true;
}

tn_join_outcome tn_loop_may_join(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_candidate *pair,
                                 tn_pair_set *taken)
{
    const tn_loop_branch *a = &loop->branches[pair->low], *b = &loop->branches[pair->high];
    if (linked_before(loop, pass, face, a, b))
        return TN_JOIN_REFUSED;
    if (!share_another_face(loop, pass, face, a, b))
        return TN_JOINED;
    if (!taken)
        return TN_JOIN_LATER;
    uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
    if (tn_pair_set_has(taken, u, v))
        return TN_JOIN_REFUSED;
    return tn_pair_set_add(taken, u, v) ? TN_JOINED : TN_JOIN_MEMORY;
}

tn_join_outcome tn_loop_join_few(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken)
{
    if (!loop_pairs(loop, pass->growth))
        return TN_JOIN_MEMORY;
    for (uint32_t c = 0; c < loop->candidate_count; c++) {
        const tn_candidate *pair = &loop->candidates[c];
        const tn_loop_branch *a = &loop->branches[pair->low], *b = &loop->branches[pair->high];
        if (a->partner >= 0 || b->partner >= 0 || loop->items[a->item].region != loop->items[b->item].region ||
            loop_links(loop, loop->items[a->item].vertex, loop->items[b->item].vertex))
            continue;
        tn_join_outcome outcome = tn_loop_may_join(loop, pass, face, pair, taken);
        if (outcome == TN_JOIN_REFUSED)
            continue;
        if (outcome != TN_JOINED)
            return outcome;
        if (!loop_join_pair(loop, pair))
            return TN_JOIN_MEMORY;
    }
    return TN_JOINED;
}

tn_join_outcome tn_loop_join_branches(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken)
{
    if (loop->branch_count < 2)
        return TN_JOINED;
    if (pass->growth->system->even && loop->branch_count <= TN_EVEN_BRANCHES_MAX)
        return loop_join_even(loop, pass, face);
    return loop->branch_count <= FEW ? tn_loop_join_few(loop, pass, face, taken)
                                     : tn_loop_join_many(loop, pass, face, taken);
}

/* ---- why the others did not */

static tn_join_failure explain_pair(const tn_loop *loop, const tn_growth *growth, const tn_loop_branch *a,
                                    const tn_loop_branch *b)
{
    double distance;
    if (loop->items[a->item].vertex == loop->items[b->item].vertex)
        return TN_FAIL_ADJACENT;
    tn_join_failure how = tn_branches_compare(growth, a, b, &distance);
    if (how != TN_JOIN_FAILURE_COUNT)
        return how;
    bool taken = b->partner >= 0 || loop->items[a->item].region != loop->items[b->item].region;
    return taken ? TN_FAIL_TAKEN : TN_FAIL_ADJACENT;
}

bool tn_loop_explain(const tn_loop *loop, const tn_pass *pass, uint64_t failures[TN_JOIN_FAILURE_COUNT])
{
    tn_branch_trees trees;
    if (loop->branch_count == 2 * loop->join_count)
        return true;
    bool fine = tn_branch_trees_new(loop, pass->growth, &trees);
    for (uint32_t i = 0; fine && i < loop->branch_count; i++)
        if (loop->branches[i].partner < 0)
            failures[tn_branch_trees_furthest(&trees, i, explain_pair)]++;
    tn_branch_trees_clear(&trees);
    return fine;
}
