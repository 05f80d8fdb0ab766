/* Which branches of a face join ("Genr8", 4.3): same region, same label, distinct vertices that no edge links already,
 * directions opposed to within BranchAngle, near enough. The nearest pair joins first; distances are quantised, so that
 * equal ones are equal in spite of rounding, and ties go by the branches' numbers. */
#include "runtime/growth/join/join.h"

#include "runtime/base/array.h"
#include "runtime/growth/join/around.h"
#include "runtime/growth/join/branch_tree.h"

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

bool tn_loop_links(const tn_loop *loop, uint32_t u, uint32_t v)
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

bool tn_loop_join_pair(tn_loop *loop, const tn_candidate *pair)
{
    if (!tn_loop_add_join(loop, pair->low, pair->high))
        return false;
    const tn_loop_join *join = &loop->joins[loop->join_count - 1];
    split_region(loop, loop->branches[join->start].item, loop->branches[join->end].item);
    return true;
}

bool tn_loop_pairs(tn_loop *loop, const tn_growth *growth)
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
    if (tn_linked_before(loop, pass, face, a, b))
        return TN_JOIN_REFUSED;
    if (!tn_share_another_face(loop, pass, face, a, b))
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
    if (!tn_loop_pairs(loop, pass->growth))
        return TN_JOIN_MEMORY;
    for (uint32_t c = 0; c < loop->candidate_count; c++) {
        const tn_candidate *pair = &loop->candidates[c];
        const tn_loop_branch *a = &loop->branches[pair->low], *b = &loop->branches[pair->high];
        if (a->partner >= 0 || b->partner >= 0 || loop->items[a->item].region != loop->items[b->item].region ||
            tn_loop_links(loop, loop->items[a->item].vertex, loop->items[b->item].vertex))
            continue;
        tn_join_outcome outcome = tn_loop_may_join(loop, pass, face, pair, taken);
        if (outcome == TN_JOIN_REFUSED)
            continue;
        if (outcome != TN_JOINED)
            return outcome;
        if (!tn_loop_join_pair(loop, pair))
            return TN_JOIN_MEMORY;
    }
    return TN_JOINED;
}

tn_join_outcome tn_loop_join_branches(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken)
{
    if (loop->branch_count < 2)
        return TN_JOINED;
    if (pass->growth->system->even && loop->branch_count <= TN_EVEN_BRANCHES_MAX)
        return tn_loop_join_even(loop, pass, face);
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
