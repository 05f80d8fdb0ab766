/* Joining the branches of a face that has very many: the same pairs in the same order as by looking at all of them
 * (join.c), in time that grows little faster than the branches.
 *
 * Each branch wishes for its nearest partner, and a heap gives the nearest wish. What made it impossible meanwhile (the
 * partner joined another, or a join came between) never becomes possible again, so the branch then asks for the next
 * nearest. A join cuts its region's ring of branches in two; the smaller half is what moves into a region of its own.
 */
#include <stdlib.h>

#include "runtime/growth/join/branch_tree.h"

typedef struct wish {
    tn_candidate pair;
    uint32_t owner;
} wish;

typedef struct crowd {
    tn_loop *loop;
    tn_branch_trees trees;
    tn_pair_set linked; /* vertices, by joins of this face */
    wish *wishes;       /* a heap, the nearest first */
    uint32_t wish_count;
    uint32_t *next;   /* [branch] in the ring of its region */
    uint32_t *inside; /* [branch] its region, as cut here */
    uint32_t *moving; /* branches */
    uint32_t *named;  /* [region as cut here] its name: 0, or which join made it */
} crowd;

static void clear(crowd *c)
{
    tn_branch_trees_clear(&c->trees);
    tn_pair_set_clear(&c->linked);
    free(c->wishes);
    free(c->next);
    free(c->inside);
    free(c->moving);
    free(c->named);
}

/* ---- wishes */

static void sift(crowd *c, uint32_t at)
{
    wish *heap = c->wishes, moving = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < c->wish_count; at = child) {
        if (child + 1 < c->wish_count && tn_candidate_before(c->loop, &heap[child + 1].pair, &heap[child].pair))
            child++;
        if (!tn_candidate_before(c->loop, &heap[child].pair, &moving.pair))
            break;
        heap[at] = heap[child];
    }
    heap[at] = moving;
}

static void drop_first(crowd *c)
{
    c->wishes[0] = c->wishes[--c->wish_count];
    sift(c, 0);
}

static void wish_again(crowd *c)
{
    wish *first = &c->wishes[0];
    tn_candidate refused = first->pair;
    if (tn_branch_trees_nearest(&c->trees, first->owner, &refused, &first->pair))
        sift(c, 0);
    else
        drop_first(c);
}

static bool prepare(crowd *c, const tn_pass *pass)
{
    uint32_t count = c->loop->branch_count;
    c->wishes = malloc(count * sizeof *c->wishes);
    c->next = malloc(count * sizeof *c->next);
    c->inside = calloc(count, sizeof *c->inside);
    c->moving = malloc(count * sizeof *c->moving);
    c->named = calloc(count, sizeof *c->named); /* each join takes two branches: fewer regions than that */
    if (!c->wishes || !c->next || !c->inside || !c->moving || !c->named ||
        !tn_branch_trees_new(c->loop, pass->growth, &c->trees))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        c->next[i] = i + 1 < count ? i + 1 : 0;
        wish *one = &c->wishes[c->wish_count];
        one->owner = i;
        c->wish_count += tn_branch_trees_nearest(&c->trees, i, NULL, &one->pair);
    }
    for (uint32_t i = c->wish_count / 2; i-- > 0;)
        sift(c, i);
    return true;
}

/* ---- regions */

/* What lies after the last join's start up to its end belongs to the new face. False: out of memory. */
static bool cut_region(crowd *c)
{
    const tn_loop *loop = c->loop;
    uint32_t made = loop->join_count, start = loop->joins[made - 1].start, end = loop->joins[made - 1].end;
    uint32_t region = c->inside[start], swap = c->next[start], one = start, other = end;
    c->next[start] = c->next[end]; /* the ring of what stays */
    c->next[end] = swap;           /* the ring of the new face */
    do {
        one = c->next[one];
        other = c->next[other];
    } while (one != start && other != end);
    bool new_is_smaller = other == end;
    c->named[made] = new_is_smaller ? made : c->named[region];
    if (!new_is_smaller)
        c->named[region] = made;
    uint32_t last = new_is_smaller ? end : start, b = last, count = 0;
    do {
        b = c->next[b];
        c->inside[b] = made;
        if (loop->branches[b].partner < 0)
            c->moving[count++] = b;
    } while (b != last);
    return tn_branch_trees_part(&c->trees, c->moving, count, made);
}

/* Every item's region: a dart's is that of what leads to it on its region's loop. */
static void name_regions(const crowd *c)
{
    tn_loop *loop = c->loop;
    uint32_t first = loop->branches[0].item, i = first, before = 0;
    do {
        tn_loop_item *item = &loop->items[i];
        item->region = before;
        if (item->is_branch) {
            const tn_loop_branch *branch = &loop->branches[item->value];
            item->region = c->named[c->inside[item->value]];
            before = branch->partner < 0 ? item->region : c->named[c->inside[branch->partner]];
        }
        i = i + 1 == loop->item_count ? 0 : i + 1;
    } while (i != first);
}

/* ---- joining */

static tn_join_outcome try_first(crowd *c, const tn_pass *pass, uint32_t face, tn_pair_set *taken)
{
    tn_loop *loop = c->loop;
    const tn_candidate *pair = &c->wishes[0].pair;
    if (loop->branches[pair->low].partner >= 0 || loop->branches[pair->high].partner >= 0 ||
        c->inside[pair->low] != c->inside[pair->high])
        return TN_JOIN_REFUSED;
    uint32_t u = loop->items[loop->branches[pair->low].item].vertex;
    uint32_t v = loop->items[loop->branches[pair->high].item].vertex;
    if (tn_pair_set_has(&c->linked, u, v))
        return TN_JOIN_REFUSED;
    tn_join_outcome outcome = tn_loop_may_join(loop, pass, face, pair, taken);
    if (outcome != TN_JOINED)
        return outcome;
    bool fine = tn_pair_set_add(&c->linked, u, v) && tn_loop_add_join(loop, pair->low, pair->high) &&
                tn_branch_trees_drop(&c->trees, pair->low) && tn_branch_trees_drop(&c->trees, pair->high) &&
                cut_region(c);
    return fine ? TN_JOINED : TN_JOIN_MEMORY;
}

tn_join_outcome tn_loop_join_many(tn_loop *loop, const tn_pass *pass, uint32_t face, tn_pair_set *taken)
{
    crowd c = {.loop = loop};
    tn_join_outcome outcome = prepare(&c, pass) ? TN_JOINED : TN_JOIN_MEMORY;
    while (c.wish_count > 0 && outcome == TN_JOINED) {
        if (loop->branches[c.wishes[0].owner].partner >= 0) {
            drop_first(&c);
            continue;
        }
        outcome = try_first(&c, pass, face, taken);
        if (outcome == TN_JOINED) {
            drop_first(&c);
        } else if (outcome == TN_JOIN_REFUSED) {
            wish_again(&c);
            outcome = TN_JOINED;
        }
    }
    if (outcome == TN_JOINED)
        name_regions(&c);
    clear(&c);
    return outcome;
}
