/* Finds the nearest branch among many, by a tree. */
#include "runtime/growth/join/branch_tree.h"

#include <stdlib.h>

#include "runtime/geometry/select_nth.h"

#define LEAF 8u

enum { DIRECTION = 3, LABEL = 6 }; /* the first axes of these */

static void clear_tree(tn_branch_tree *tree)
{
    free(tree->nodes);
    free(tree->order);
    *tree = (tn_branch_tree){0};
}

void tn_branch_trees_clear(tn_branch_trees *trees)
{
    for (uint32_t i = 0; trees->trees && i <= trees->loop->branch_count / 2; i++)
        clear_tree(&trees->trees[i]);
    free(trees->trees);
    free(trees->places);
    free(trees->region);
    free(trees->leaf_of);
    *trees = (tn_branch_trees){0};
}

/* ---- building a tree */

static void bound(const tn_branch_trees *trees, const uint32_t *order, tn_branch_node *node)
{
    for (int k = 0; k < TN_BRANCH_AXES; k++)
        node->low[k] = node->high[k] = trees->places[order[node->first]][k];
    for (uint32_t i = node->first + 1; i < node->end; i++) {
        const double *place = trees->places[order[i]];
        for (int k = 0; k < TN_BRANCH_AXES; k++) {
            node->low[k] = tn_smaller(node->low[k], place[k]);
            node->high[k] = tn_larger(node->high[k], place[k]);
        }
    }
}

/* Labels are told apart first; then the axis along which the node is widest, of the whole region's size or of the
 * directions' circle. */
static int widest_axis(const tn_branch_node *root, const tn_branch_node *node)
{
    if (node->low[LABEL] != node->high[LABEL])
        return LABEL;
    double size = 0, most = -1;
    for (int k = 0; k < DIRECTION; k++)
        size = tn_larger(size, root->high[k] - root->low[k]);
    int widest = DIRECTION;
    for (int k = 0; k < LABEL; k++) {
        double width = (node->high[k] - node->low[k]) * (k < DIRECTION ? 2 : size);
        if (width > most) {
            most = width;
            widest = k;
        }
    }
    return widest;
}

static bool lies_before(const void *context, uint32_t a, uint32_t b, int axis)
{
    const tn_branch_trees *trees = context;
    double x = trees->places[a][axis], y = trees->places[b][axis];
    return x != y ? x < y : a < b;
}

static void refresh_leaf(const tn_branch_trees *trees, uint32_t region, tn_branch_node *node)
{
    const uint32_t *order = trees->trees[region].order;
    node->least = TN_NONE;
    for (uint32_t i = node->first; i < node->end; i++) {
        uint32_t id = trees->loop->branches[order[i]].id;
        if (trees->region[order[i]] == region && id < node->least)
            node->least = id;
    }
}

static void refresh_inner(const tn_branch_tree *tree, tn_branch_node *node)
{
    const tn_branch_node *a = &tree->nodes[node->left], *b = &tree->nodes[node->right];
    node->least = a->least < b->least ? a->least : b->least;
}

static uint32_t build(const tn_branch_trees *trees, uint32_t region, uint32_t first, uint32_t end, uint32_t parent)
{
    tn_branch_tree *tree = &trees->trees[region];
    uint32_t index = tree->node_count++, middle = first + (end - first) / 2;
    tn_branch_node *node = &tree->nodes[index];
    *node = (tn_branch_node){.first = first, .end = end, .parent = parent};
    bound(trees, tree->order, node);
    if (end - first <= LEAF) {
        for (uint32_t i = first; i < end; i++)
            trees->leaf_of[tree->order[i]] = index;
        refresh_leaf(trees, region, node);
        return index;
    }
    tn_select_nth(tree->order, first, end, middle, widest_axis(tree->nodes, node), lies_before, trees);
    node->left = build(trees, region, first, middle, index);
    node->right = build(trees, region, middle, end, index);
    refresh_inner(tree, node);
    return index;
}

/* Builds a region's tree. */
static bool plant(tn_branch_trees *trees, uint32_t region, const uint32_t *list, uint32_t count)
{
    tn_branch_tree *tree = &trees->trees[region];
    *tree = (tn_branch_tree){.count = count, .left = count};
    if (count == 0)
        return true;
    tree->nodes = malloc((count / 2 + 1) * sizeof *tree->nodes); /* halves of more than 8 have more than 3 */
    tree->order = malloc(count * sizeof *tree->order);
    if (!tree->nodes || !tree->order)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        tree->order[i] = list[i];
        trees->region[list[i]] = region;
    }
    build(trees, region, 0, count, 0);
    return true;
}

bool tn_branch_trees_new(const tn_loop *loop, const tn_growth *growth, tn_branch_trees *trees)
{
    uint32_t count = loop->branch_count;
    *trees = (tn_branch_trees){.loop = loop, .growth = growth};
    trees->trees = calloc(count / 2 + 1, sizeof *trees->trees);
    trees->places = malloc(count * sizeof *trees->places);
    trees->region = malloc(count * sizeof *trees->region);
    trees->leaf_of = malloc(count * sizeof *trees->leaf_of);
    uint32_t *all = malloc(count * sizeof *all);
    bool fine = trees->trees && trees->places && trees->region && trees->leaf_of && all;
    for (uint32_t i = 0; fine && i < count; i++) {
        const tn_loop_branch *branch = &loop->branches[i];
        tn_vector_put(trees->places[i], branch->at);
        tn_vector_put(trees->places[i] + DIRECTION, branch->direction);
        trees->places[i][LABEL] = branch->label;
        all[i] = i;
    }
    fine = fine && plant(trees, 0, all, count);
    free(all);
    return fine;
}

/* ---- out of a tree */

/* Out of its region's tree, whose boxes stay as they are. */
static void take_out(tn_branch_trees *trees, uint32_t branch)
{
    uint32_t region = trees->region[branch], index = trees->leaf_of[branch];
    tn_branch_tree *tree = &trees->trees[region];
    trees->region[branch] = TN_NONE;
    tree->left--;
    refresh_leaf(trees, region, &tree->nodes[index]);
    while (index != 0) {
        index = tree->nodes[index].parent;
        tn_branch_node *node = &tree->nodes[index];
        uint32_t before = node->least;
        refresh_inner(tree, node);
        if (node->least == before)
            break;
    }
}

/* Builds a tree anew that half of its branches have left. */
static bool tidy(tn_branch_trees *trees, uint32_t region)
{
    tn_branch_tree old = trees->trees[region];
    uint32_t left = 0;
    if (2 * old.left > old.count || old.count <= LEAF)
        return true;
    for (uint32_t i = 0; i < old.count; i++)
        if (trees->region[old.order[i]] == region)
            old.order[left++] = old.order[i];
    bool fine = plant(trees, region, old.order, left);
    clear_tree(&old);
    return fine;
}

/* The branch joined. False: out of memory. */
static bool branch_trees_drop(tn_branch_trees *trees, uint32_t branch)
{
    uint32_t region = trees->region[branch];
    take_out(trees, branch);
    return tidy(trees, region);
}

/* Makes a region of its own of branches of one region. False: out of memory. */
static bool branch_trees_part(tn_branch_trees *trees, const uint32_t *list, uint32_t count, uint32_t region)
{
    uint32_t before = count > 0 ? trees->region[list[0]] : TN_NONE;
    for (uint32_t i = 0; i < count; i++)
        take_out(trees, list[i]);
    return plant(trees, region, list, count) && (before == TN_NONE || tidy(trees, before));
}

/* ---- what a box allows */

static double gap(double low, double high, double at)
{
    return at < low ? low - at : at > high ? at - high : 0;
}

/* The least distance of a place from what is in a box. */
static double distance_to(const tn_branch_node *node, tn_vector at)
{
    return tn_norm((tn_vector){gap(node->low[0], node->high[0], at.x), gap(node->low[1], node->high[1], at.y),
                               gap(node->low[2], node->high[2], at.z)});
}

/* The least product of a direction with what lies between the corners of a box. */
static double least_product(tn_vector direction, tn_vector low, tn_vector high)
{
    return tn_smaller(direction.x * low.x, direction.x * high.x) +
           tn_smaller(direction.y * low.y, direction.y * high.y) +
           tn_smaller(direction.z * low.z, direction.z * high.z);
}

/* How far a partner in this box may come at best, of those of the branch's label; TN_FAIL_LABEL: there is none. */
static tn_join_failure best_in_box(const tn_growth *growth, const tn_branch_node *node, const tn_loop_branch *branch,
                                   double distance)
{
    if (branch->label < node->low[LABEL] || branch->label > node->high[LABEL])
        return TN_FAIL_LABEL;
    if (least_product(branch->direction, tn_vector_at(node->low + DIRECTION), tn_vector_at(node->high + DIRECTION)) >
        growth->branch_cosine)
        return TN_FAIL_ANGLE;
    if (growth->options.facing) {
        tn_vector back = tn_scale(branch->direction, -1);
        if (least_product(back, tn_sub(tn_vector_at(node->low), branch->at),
                          tn_sub(tn_vector_at(node->high), branch->at)) >= 0)
            return TN_FAIL_FACING;
    }
    return distance > tn_branch_reach(growth) ? TN_FAIL_DISTANCE : TN_JOIN_FAILURE_COUNT;
}

/* ---- the nearest */

typedef struct search {
    const tn_branch_trees *trees;
    const tn_branch_tree *tree;
    uint32_t branch;
    const tn_candidate *after;
    tn_candidate best;
    bool found;
} search;

/* May a pair with something in this node, which is so far away at least, come before the best one? */
static bool may_improve(const search *s, const tn_branch_node *node, double distance)
{
    const tn_loop_branch *branches = s->trees->loop->branches, *branch = &branches[s->branch];
    if (node->least == TN_NONE || best_in_box(s->trees->growth, node, branch, distance) != TN_JOIN_FAILURE_COUNT)
        return false;
    if (!s->found)
        return true;
    double quantised = tn_quantised(s->trees->growth, distance);
    if (quantised != s->best.distance)
        return quantised < s->best.distance;
    uint32_t low = branch->id < node->least ? branch->id : node->least;
    uint32_t high = branch->id < node->least ? node->least : branch->id;
    uint32_t best_low = branches[s->best.low].id;
    return low != best_low ? low < best_low : high < branches[s->best.high].id;
}

static void try_partner(search *s, uint32_t partner)
{
    const tn_loop *loop = s->trees->loop;
    const tn_loop_branch *a = &loop->branches[s->branch], *b = &loop->branches[partner];
    tn_candidate pair = a->id < b->id ? (tn_candidate){0, s->branch, partner} : (tn_candidate){0, partner, s->branch};
    if (s->trees->region[partner] != s->trees->region[s->branch] || a->label != b->label ||
        loop->items[a->item].vertex == loop->items[b->item].vertex ||
        tn_branches_compare(s->trees->growth, a, b, &pair.distance) != TN_JOIN_FAILURE_COUNT)
        return;
    if ((s->after && !tn_candidate_before(loop, s->after, &pair)) ||
        (s->found && !tn_candidate_before(loop, &pair, &s->best)))
        return;
    s->best = pair;
    s->found = true;
}

static void seek(search *s, uint32_t index, double distance)
{
    const tn_branch_node *node = &s->tree->nodes[index];
    if (!may_improve(s, node, distance))
        return;
    if (node->left == 0) {
        for (uint32_t i = node->first; i < node->end; i++)
            try_partner(s, s->tree->order[i]);
        return;
    }
    tn_vector at = s->trees->loop->branches[s->branch].at;
    double left = distance_to(&s->tree->nodes[node->left], at), right = distance_to(&s->tree->nodes[node->right], at);
    bool right_first = right < left;
    seek(s, right_first ? node->right : node->left, right_first ? right : left);
    seek(s, right_first ? node->left : node->right, right_first ? left : right);
}

/* The first pair (tn_candidate_before) of this branch and another of its region that may join but for the topology;
 * `after` not NULL: of the pairs after that one. False: none. */
static bool branch_trees_nearest(const tn_branch_trees *trees, uint32_t branch, const tn_candidate *after,
                                 tn_candidate *found)
{
    search s = {.trees = trees, .tree = &trees->trees[trees->region[branch]], .branch = branch, .after = after};
    seek(&s, 0, 0);
    *found = s.best;
    return s.found;
}

/* ---- the furthest that any comes */

static void try_node(const tn_branch_trees *trees, uint32_t index, uint32_t branch, tn_branch_reason how,
                     tn_join_failure *furthest)
{
    const tn_branch_tree *tree = &trees->trees[trees->region[branch]];
    const tn_branch_node *node = &tree->nodes[index];
    const tn_loop_branch *a = &trees->loop->branches[branch];
    double distance = distance_to(node, a->at);
    tn_join_failure best = best_in_box(trees->growth, node, a, distance);
    if (distance == 0 && best != TN_FAIL_LABEL)
        best = TN_FAIL_TAKEN; /* branches of its own vertex come far, whatever their directions */
    if (best <= *furthest)
        return;
    if (node->left == 0) {
        for (uint32_t i = node->first; i < node->end; i++) {
            const tn_loop_branch *b = &trees->loop->branches[tree->order[i]];
            bool other = a != b && a->label == b->label;
            tn_join_failure came = other ? how(trees->loop, trees->growth, a, b) : TN_FAIL_LABEL;
            *furthest = came > *furthest ? came : *furthest;
        }
        return;
    }
    try_node(trees, node->left, branch, how, furthest);
    try_node(trees, node->right, branch, how, furthest);
}

tn_join_failure tn_branch_trees_furthest(const tn_branch_trees *trees, uint32_t branch, tn_branch_reason how)
{
    tn_join_failure furthest = TN_FAIL_LABEL;
    try_node(trees, 0, branch, how, &furthest);
    return furthest;
}

/* ==== joining the branches of a face that has very many: the same pairs in the same order as by looking at all of them
 * (join.c), in time that grows little faster than the branches. Each branch wishes for its nearest partner, and a heap
 * gives the nearest wish. What made it impossible meanwhile (the partner joined another, or a join came between) never
 * becomes possible again, so the branch then asks for the next nearest. A join cuts its region's ring of branches in
 * two; the smaller half is what moves into a region of its own */

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
    if (branch_trees_nearest(&c->trees, first->owner, &refused, &first->pair))
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
        c->wish_count += branch_trees_nearest(&c->trees, i, NULL, &one->pair);
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
    return branch_trees_part(&c->trees, c->moving, count, made);
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
                branch_trees_drop(&c->trees, pair->low) && branch_trees_drop(&c->trees, pair->high) && cut_region(c);
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
