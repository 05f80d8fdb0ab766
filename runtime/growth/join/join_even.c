/* Joining so that mirrored branches join alike (`Even`, docs/growth.md).
 *
 * Pairs are taken nearest first, all that are equally near together. Of those, a pair joins only if it shares no branch
 * with another, does not cross another, and is the only one that links its vertices. What is left then is the same in
 * whatever order it joins. */
#include <stdlib.h>
#include <string.h>

#include "runtime/growth/join/around.h"
#include "runtime/growth/join/join.h"

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
           !tn_loop_links(loop, vertex_of(t, pair->low), vertex_of(t, pair->high)) &&
           !tn_linked_before(loop, pass, face, a, b) && !tn_share_another_face(loop, pass, face, a, b);
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
        if (t->pairs[i].distance >= 0 && !tn_loop_join_pair(t->loop, &t->pairs[i]))
            return TN_JOIN_MEMORY;
    tn_pair_set_clear(&t->once);
    tn_pair_set_clear(&t->twice);
    return TN_JOINED;
}

tn_join_outcome tn_loop_join_even(tn_loop *loop, const tn_pass *pass, uint32_t face)
{
    tie t = {.loop = loop};
    bool fine = tn_loop_pairs(loop, pass->growth) && prepare(&t);
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
