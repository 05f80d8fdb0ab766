/* Which branches of a face join ("Genr8", 4.3): same region, same label, distinct vertices that no edge links already,
 * directions opposed to within BranchAngle, near enough. The nearest pair joins first; distances are quantised, so that
 * equal ones are equal in spite of rounding, and ties go by the branches' numbers. */
#include <stdlib.h>
#include <string.h>

#include "runtime/map/join.h"

#define QUANTA 1048576.0 /* of the current length: 2^20 */

/* ---- pairs of branches */

tn_join_failure tn_branches_measure(const tn_growth *growth, tn_vector a_direction, tn_vector a_at,
                                    tn_vector b_direction, tn_vector b_at, double *distance)
{
    tn_vector way = tn_sub(b_at, a_at);
    double length = tn_norm(way);
    if (growth->options.facing &&
        (tn_dot(a_direction, way) <= 1e-9 * length || tn_dot(b_direction, way) >= -1e-9 * length))
        return TN_FAIL_FACING;
    if (growth->options.branch_length >= 0 && length > growth->options.branch_length * growth->length * (1 + 1e-9))
        return TN_FAIL_DISTANCE;
    double quanta = length / growth->length * QUANTA + 0.5;
    *distance = quanta < 0x1p62 ? (double)(int64_t)quanta : quanta;
    return TN_JOIN_FAILURE_COUNT;
}

/* How far a pair comes: TN_JOIN_FAILURE_COUNT where nothing but the topology could stand against it. */
static tn_join_failure compare(const tn_growth *growth, const tn_loop_branch *a, const tn_loop_branch *b,
                               double *distance)
{
    if (!tn_branches_oppose(growth, a->direction, b->direction))
        return TN_FAIL_ANGLE;
    return tn_branches_measure(growth, a->direction, a->at, b->direction, b->at, distance);
}

static bool add_candidate(tn_loop *loop, tn_candidate candidate)
{
    if (loop->candidate_count == loop->candidate_room) {
        size_t room = 2 * loop->candidate_room + 64;
        tn_candidate *grown = realloc(loop->candidates, room * sizeof *grown);
        if (!grown)
            return false;
        loop->candidates = grown;
        loop->candidate_room = room;
    }
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
                compare(growth, a, b, &distance) != TN_JOIN_FAILURE_COUNT)
                continue;
            tn_candidate one = a->id < b->id ? (tn_candidate){distance, i, j} : (tn_candidate){distance, j, i};
            if (!add_candidate(loop, one))
                return false;
        }
    }
    return true;
}

static bool comes_before(const tn_loop *loop, const tn_candidate *a, const tn_candidate *b)
{
    if (a->distance != b->distance)
        return a->distance < b->distance;
    uint32_t x = loop->branches[a->low].id, y = loop->branches[b->low].id;
    if (x != y)
        return x < y;
    return loop->branches[a->high].id < loop->branches[b->high].id;
}

static void sift(const tn_loop *loop, tn_candidate *heap, uint32_t at, uint32_t count)
{
    tn_candidate moving = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && comes_before(loop, &heap[child], &heap[child + 1]))
            child++;
        if (!comes_before(loop, &moving, &heap[child]))
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
            for (; j > 0 && comes_before(loop, &moving, &list[j - 1]); j--)
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

/* ---- the vertices around an old vertex, for the questions whether two vertices are linked, or share another face */

static uint32_t before_in_face(const tn_map *map, uint32_t face, uint32_t dart)
{
    return (dart == map->face_first[face] ? map->face_first[face + 1] : dart) - 1;
}

static uint32_t dart_of(const tn_pass *pass, uint32_t face, uint32_t vertex)
{
    const tn_map *old = pass->old;
    for (uint32_t d = old->face_first[face]; d < old->face_first[face + 1]; d++)
        if (old->origin[d] == vertex)
            return d;
    return TN_NONE;
}

/* Goes round a vertex: from a dart of it and its face to the next. */
static void turn(const tn_pass *pass, uint32_t *dart, uint32_t *face)
{
    uint32_t arriving = before_in_face(pass->old, *face, *dart);
    uint32_t side = pass->old->side[arriving] ^ 1;
    *dart = pass->dart[side];
    *face = pass->sides[side].face;
}

/* The vertex at the other end of the first piece of what a dart's edge became. */
static uint32_t neighbour(const tn_pass *pass, uint32_t side)
{
    uint32_t slot = pass->slot[side / 2];
    if (slot & TN_KEPT)
        return pass->sides[side ^ 1].origin;
    const tn_record *record = &pass->records[slot];
    uint32_t pieces = pass->growth->shapes[record->template].template->segment_count;
    bool against = side & 1;
    if (pieces > 1)
        return against ? record->vertex + pieces - 2 : record->vertex;
    uint32_t far = side / 2;
    if (pass->runs)
        far = against ? pass->runs[slot].first : pass->runs[slot].last;
    return pass->sides[2 * (size_t)far + (against ? 0 : 1)].origin;
}

static bool is_linked(const tn_pass *pass, uint32_t face, uint32_t old_vertex, uint32_t to)
{
    uint32_t start = dart_of(pass, face, old_vertex), d = start, f = face;
    do {
        if (neighbour(pass, pass->old->side[d]) == to)
            return true;
        turn(pass, &d, &f);
    } while (d != start);
    return false;
}

static bool touches(const tn_pass *pass, uint32_t face, uint32_t old_vertex, uint32_t other_face)
{
    uint32_t start = dart_of(pass, face, old_vertex), d = start, f = face;
    do {
        if (f == other_face)
            return true;
        turn(pass, &d, &f);
    } while (d != start);
    return false;
}

/* Before this pass's joins: does an edge link the branches' vertices? */
static bool linked_before(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                          const tn_loop_branch *b)
{
    uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
    if (a->beyond != TN_NONE && b->beyond != TN_NONE)
        return a->record == b->record && (a->point + 1 == b->point || b->point + 1 == a->point);
    return a->beyond == TN_NONE ? is_linked(pass, face, u, v) : is_linked(pass, face, v, u);
}

/* Does another interior face touch both vertices, so that a join there would link them? */
static bool shares_another_face(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                                const tn_loop_branch *b)
{
    if (a->beyond != TN_NONE && b->beyond != TN_NONE)
        return a->beyond == b->beyond && a->beyond != TN_OUTER_FACE;
    if (a->beyond != TN_NONE) {
        const tn_loop_branch *swap = a;
        a = b;
        b = swap;
    }
    uint32_t u = loop->items[a->item].vertex;
    if (b->beyond != TN_NONE)
        return b->beyond != TN_OUTER_FACE && touches(pass, face, u, b->beyond);
    uint32_t start = dart_of(pass, face, loop->items[b->item].vertex), d = start, f = face;
    do {
        if (f != face && f != TN_OUTER_FACE && touches(pass, face, u, f))
            return true;
        turn(pass, &d, &f);
    } while (d != start);
    return false;
}

static bool joined_in_loop(const tn_loop *loop, uint32_t u, uint32_t v)
{
    for (uint32_t i = 0; i < loop->join_count; i++) {
        uint32_t x = loop->items[loop->branches[loop->joins[i].start].item].vertex;
        uint32_t y = loop->items[loop->branches[loop->joins[i].end].item].vertex;
        if ((x == u && y == v) || (x == v && y == u))
            return true;
    }
    return false;
}

/* ---- the set of pairs */

static uint64_t pair_key(uint32_t u, uint32_t v)
{
    return u < v ? (uint64_t)u << 32 | v : (uint64_t)v << 32 | u;
}

static size_t pair_slot(const tn_pair_set *set, uint64_t key)
{
    size_t i = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & (set->capacity - 1);
    while (set->slots[i] != 0 && set->slots[i] != key)
        i = (i + 1) & (set->capacity - 1);
    return i;
}

static bool pair_is_in(const tn_pair_set *set, uint64_t key)
{
    return set->capacity && set->slots[pair_slot(set, key)] == key;
}

static bool pair_insert(tn_pair_set *set, uint64_t key)
{
    if (2 * set->count >= set->capacity) {
        tn_pair_set larger = {.capacity = set->capacity ? 2 * set->capacity : 64};
        larger.slots = calloc(larger.capacity, sizeof *larger.slots);
        if (!larger.slots)
            return false;
        for (size_t i = 0; i < set->capacity; i++)
            if (set->slots[i])
                larger.slots[pair_slot(&larger, set->slots[i])] = set->slots[i];
        larger.count = set->count;
        free(set->slots);
        *set = larger;
    }
    set->slots[pair_slot(set, key)] = key;
    set->count++;
    return true;
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

static bool add_join(tn_loop *loop, uint32_t low, uint32_t high)
{
    if (loop->join_count == loop->join_room) {
        size_t room = 2 * loop->join_room + 16;
        tn_loop_join *grown = realloc(loop->joins, room * sizeof *grown);
        if (!grown)
            return false;
        loop->joins = grown;
        loop->join_room = room;
    }
    tn_loop_branch *a = &loop->branches[low], *b = &loop->branches[high];
    bool turned = a->reversed && !b->reversed; /* '~' marks an incoming branch */
    tn_loop_join join = turned ? (tn_loop_join){high, low, low} : (tn_loop_join){low, high, low};
    loop->joins[loop->join_count++] = join;
    a->partner = (int32_t)high;
    b->partner = (int32_t)low;
    split_region(loop, loop->branches[join.start].item, loop->branches[join.end].item);
    return true;
}

tn_join_outcome tn_loop_join_branches(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken)
{
    if (loop->branch_count < 2)
        return TN_JOINED;
    if (!find_candidates(loop, pass->growth))
        return TN_JOIN_MEMORY;
    sort_candidates(loop);
    for (uint32_t c = 0; c < loop->candidate_count; c++) {
        uint32_t low = loop->candidates[c].low, high = loop->candidates[c].high;
        const tn_loop_branch *a = &loop->branches[low], *b = &loop->branches[high];
        if (a->partner >= 0 || b->partner >= 0 || loop->items[a->item].region != loop->items[b->item].region)
            continue;
        uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
        if (joined_in_loop(loop, u, v) || linked_before(loop, pass, face, a, b))
            continue;
        if (shares_another_face(loop, pass, face, a, b)) {
            if (!taken)
                return TN_JOIN_LATER;
            uint64_t key = pair_key(u, v);
            if (pair_is_in(taken, key))
                continue;
            if (!pair_insert(taken, key))
                return TN_JOIN_MEMORY;
        }
        if (!add_join(loop, low, high))
            return TN_JOIN_MEMORY;
    }
    return TN_JOINED;
}

/* ---- why the others did not */

static tn_join_failure explain_pair(const tn_loop *loop, const tn_pass *pass, const tn_loop_branch *a,
                                    const tn_loop_branch *b)
{
    double distance;
    if (loop->items[a->item].vertex == loop->items[b->item].vertex)
        return TN_FAIL_ADJACENT;
    tn_join_failure how = compare(pass->growth, a, b, &distance);
    if (how != TN_JOIN_FAILURE_COUNT)
        return how;
    bool taken = b->partner >= 0 || loop->items[a->item].region != loop->items[b->item].region;
    return taken ? TN_FAIL_TAKEN : TN_FAIL_ADJACENT;
}

void tn_loop_explain(const tn_loop *loop, const tn_pass *pass, uint64_t failures[TN_JOIN_FAILURE_COUNT])
{
    for (uint32_t i = 0; i < loop->branch_count; i++) {
        const tn_loop_branch *a = &loop->branches[i];
        if (a->partner >= 0)
            continue;
        tn_join_failure furthest = TN_FAIL_LABEL;
        for (uint32_t j = 0; j < loop->branch_count; j++) {
            const tn_loop_branch *b = &loop->branches[j];
            if (j == i || a->label != b->label)
                continue;
            tn_join_failure how = explain_pair(loop, pass, a, b);
            furthest = how > furthest ? how : furthest;
        }
        failures[furthest]++;
    }
}
