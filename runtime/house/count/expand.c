/* Goes from the nodes of a layer to those of the next: what is equal for several plans is worked out once.
 *
 * If a step has four stages (stage.c), there are three more layers between the states after two trays: of exit states,
 * of entry states, then of slice states. A state then goes on by all entries that can follow, an exit state and an
 * entry state by all groups of these, and a slice state by each slice. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"

typedef struct tn_reached {
    uint32_t state;
    uint64_t times, faced;
    tn_house_gain gain;
} tn_reached;

/* What one node's state reaches by each slice, or list, that was asked for. */
typedef struct tn_fan {
    uint32_t *mark; /* [slices and lists]: the turn in which it was last asked for */
    size_t *first;  /* the same: its part of `reached`, and how much */
    size_t *count;
    tn_reached *reached;
    size_t used, room;
} tn_fan;

/* The ways on from one plan state. */
typedef struct tn_ways {
    tn_houses_way *items;
    size_t count, room;
    uint32_t list; /* half way: of entries (STAGE_EXIT), of these with their groups (STAGE_CROSS, STAGE_ENTER) */
} tn_ways;

/* A step as a whole, or one of its stages. */
typedef enum tn_stage { STAGE_EXIT, STAGE_CROSS, STAGE_ENTER, STAGE_PASS, STAGE_WHOLE } tn_stage;

typedef struct tn_houses_expansion {
    const tn_houses *houses;
    tn_houses_kind *kind;
    tn_stage stage;
    uint32_t layer, trays; /* of the kind's; before the step */
    tn_numbering plans;    /* of the layer */
    tn_ways *ways;         /* [plans] */
    tn_fan fan;
    mpz_t *here; /* or NULL: nodes with 0 are left aside */
    tn_houses_edge_seen *seen;
    void *context;
} tn_houses_expansion;

/* ---- ways of plans */

/* What is half way is met once, however many slices lead on from it: the tray is not taken yet. */
static bool is_half(const tn_houses_expansion *e)
{
    return e->stage < STAGE_PASS;
}

/* Ways by slices of one entry, and of one group, follow one another: groups have one entry. */
static int compare_ways(const void *a, const void *b)
{
    const tn_houses_way *p = a, *q = b;
    return p->entry != q->entry   ? (p->entry > q->entry) - (p->entry < q->entry)
           : p->group != q->group ? (p->group > q->group) - (p->group < q->group)
           : p->slice != q->slice ? (p->slice > q->slice) - (p->slice < q->slice)
           : p->plan != q->plan   ? (p->plan > q->plan) - (p->plan < q->plan)
           : p->tray != q->tray   ? (p->tray > q->tray) - (p->tray < q->tray)
                                  : tn_house_gain_compare(&p->gain, &q->gain);
}

static void merge_ways(tn_ways *ways)
{
    size_t kept = 0;
    qsort(ways->items, ways->count, sizeof *ways->items, compare_ways);
    for (size_t i = 0; i < ways->count; i++) {
        if (kept > 0 && compare_ways(&ways->items[kept - 1], &ways->items[i]) == 0)
            ways->items[kept - 1].times += ways->items[i].times;
        else
            ways->items[kept++] = ways->items[i];
    }
    ways->count = kept;
}

static tn_houses_way way_by(const tn_frontier *frontier, const tn_frontier_choice *choice)
{
    uint32_t slice = frontier->scouting ? frontier->slices.items[choice->slice].plain : choice->slice;
    return (tn_houses_way){.slice = slice,
                           .entry = frontier->slices.items[slice].entry,
                           .group = frontier->slices.items[slice].group,
                           .times = choice->times};
}

/* The slices of a tray are in the order of ways, as long as they stand for themselves. */
static tn_status find_ways(tn_houses_expansion *e, uint32_t plan, tn_ways *ways, tn_error *error)
{
    const tn_houses *h = e->houses;
    const tn_frontier *frontier = e->kind->frontier;
    size_t trays = 0;
    for (tn_tray t = 0; e->trays < h->high && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        tn_house_gain gain;
        const tn_frontier_list *list = &frontier->slices.of_tray[t];
        tn_status status = tn_houses_plan_next(h, e->trays, plan, t, &next, &gain, error);
        if (status != TN_OK)
            return status;
        if (list->count == 0 || !tn_houses_plan_lives(h, e->trays + 1, next))
            continue;
        if (!tn_array_reserve(&ways->items, &ways->room, ways->count, list->count, sizeof *ways->items))
            return tn_fail_memory(error);
        for (size_t i = 0; i < list->count; i++) {
            tn_houses_way *way = &ways->items[ways->count++];
            *way = way_by(frontier, &list->items[i]);
            way->plan = next;
            way->gain = gain;
            way->tray = h->trays_matter || h->keep_trays ? t : 0;
        }
        trays++;
    }
    if (ways->count > 0 && (trays > 1 || frontier->scouting))
        merge_ways(ways);
    return TN_OK;
}

/* The ways are by entry. */
static tn_status find_entries(tn_frontier *frontier, tn_ways *ways, tn_error *error)
{
    tn_key *key = &frontier->key;
    bool ok = true;
    key->size = 0;
    for (size_t i = 0; ok && i < ways->count; i++)
        if (i == 0 || ways->items[i].entry != ways->items[i - 1].entry)
            ok = tn_key_push(key, ways->items[i].entry);
    ways->list = ok ? tn_frontier_number_list(frontier, key->data, key->size) : UINT32_MAX;
    return ways->list != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* frontier->key := for each group of the ways from here that have one entry: what clauses read of it, and its number.
 * *at := after these ways. */
static bool list_groups(tn_frontier *frontier, const tn_ways *ways, size_t *at)
{
    uint32_t entry = ways->items[*at].entry;
    tn_key *key = &frontier->key;
    bool ok = true;
    key->size = 0;
    for (size_t first = *at; ok && *at < ways->count && ways->items[*at].entry == entry; ++*at) {
        const tn_houses_way *way = &ways->items[*at];
        if (*at == first || way->group != way[-1].group)
            ok = tn_key_push(key, frontier->slices.items[way->slice].bases) && tn_key_push(key, way->group);
    }
    return ok;
}

static int compare_pairs(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

/* The number of the list of groups in frontier->key: those of which clauses read the same follow one another. */
static uint32_t number_groups(tn_frontier *frontier)
{
    const tn_key *key = &frontier->key;
    size_t count = key->size / 2;
    qsort(key->data, count, 2 * sizeof *key->data, compare_pairs);
    for (size_t i = 0; i < count; i++)
        key->data[i] = key->data[2 * i + 1];
    return tn_frontier_number_list(frontier, key->data, count);
}

static tn_status find_groups(tn_frontier *frontier, tn_ways *ways, tn_error *error)
{
    tn_key entry_groups = {0};
    bool ok = true;
    for (size_t at = 0; ok && at < ways->count;) {
        uint32_t entry = ways->items[at].entry;
        uint32_t groups = list_groups(frontier, ways, &at) ? number_groups(frontier) : UINT32_MAX;
        ok = groups != UINT32_MAX && tn_key_push(&entry_groups, entry) && tn_key_push(&entry_groups, groups);
    }
    ways->list = ok ? tn_frontier_number_list(frontier, entry_groups.data, entry_groups.size) : UINT32_MAX;
    free(entry_groups.data);
    return ways->list != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* Is the node left aside? */
static bool is_empty(const tn_houses_expansion *e, uint32_t node)
{
    return e->here && mpz_sgn(e->here[node]) == 0;
}

static tn_status find_all_ways(tn_houses_expansion *e, tn_error *error)
{
    const tn_numbering *nodes = &e->kind->layers[e->layer].nodes;
    for (uint32_t i = 0; i < nodes->count; i++)
        if (!is_empty(e, i) && tn_number(&e->plans, nodes->keys[i] >> 32) == UINT32_MAX)
            return tn_fail_memory(error);
    e->ways = calloc((size_t)e->plans.count + 1, sizeof *e->ways);
    tn_status status = e->ways ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < e->plans.count; i++) {
        status = find_ways(e, (uint32_t)e->plans.keys[i], &e->ways[i], error);
        if (status == TN_OK && e->stage == STAGE_EXIT)
            status = find_entries(e->kind->frontier, &e->ways[i], error);
        if (status == TN_OK && is_half(e) && e->stage != STAGE_EXIT)
            status = find_groups(e->kind->frontier, &e->ways[i], error);
    }
    return status;
}

/* ---- steps of states */

static tn_status reach(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                       tn_error *error)
{
    tn_fan *fan = context;
    if (!tn_array_reserve(&fan->reached, &fan->room, fan->used, 1, sizeof *fan->reached))
        return tn_fail_memory(error);
    fan->reached[fan->used++] = (tn_reached){state, times, faced, *gain};
    return TN_OK;
}

/* After the last tray only states are kept in which the row may end. */
static tn_status keep_ends(tn_houses_expansion *e, size_t first, tn_error *error)
{
    tn_fan *fan = &e->fan;
    tn_status status = TN_OK;
    size_t kept = first;
    for (size_t i = first; status == TN_OK && i < fan->used; i++) {
        bool ends;
        status = tn_frontier_ends(e->kind->frontier, e->trays + 1, fan->reached[i].state, &ends, error);
        fan->reached[kept] = fan->reached[i];
        kept += ends;
    }
    fan->used = kept;
    return status;
}

static tn_status step(tn_houses_expansion *e, uint32_t state, uint32_t by, tn_error *error)
{
    tn_frontier *frontier = e->kind->frontier;
    if (e->stage == STAGE_EXIT)
        return tn_frontier_stage_exit(frontier, state, by, reach, &e->fan, error);
    if (e->stage == STAGE_CROSS)
        return tn_frontier_stage_cross(frontier, e->trays, state, by, reach, &e->fan, error);
    if (e->stage == STAGE_ENTER)
        return tn_frontier_stage_enter(frontier, e->trays, state, by, reach, &e->fan, error);
    return e->stage == STAGE_PASS ? tn_frontier_stage_pass(frontier, state, by, reach, &e->fan, error)
                                  : tn_frontier_step(frontier, e->trays, state, by, reach, &e->fan, error);
}

/* Steps by a slice or a list, if that was not done in this turn. */
static tn_status ask(tn_houses_expansion *e, uint32_t turn, uint32_t state, uint32_t by, size_t at, tn_error *error)
{
    tn_fan *fan = &e->fan;
    if (fan->mark[at] == turn)
        return TN_OK;
    fan->mark[at] = turn;
    fan->first[at] = fan->used;
    tn_status status = step(e, state, by, error);
    bool after_slice = by != TN_FRONTIER_NONE && e->stage >= STAGE_PASS;
    if (status == TN_OK && after_slice && e->trays + 1 == e->houses->high)
        status = keep_ends(e, fan->first[at], error);
    fan->count[at] = fan->used - fan->first[at];
    return status;
}

static tn_status show(const tn_houses_expansion *e, uint32_t from, const tn_houses_way *way, size_t at, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < e->fan.count[at]; i++) {
        tn_reached r = e->fan.reached[e->fan.first[at] + i];
        const tn_houses_edge edge = {.from = from,
                                     .plan = way->plan,
                                     .state = r.state,
                                     .slice = way->slice,
                                     .ways = way->times,
                                     .times = r.times,
                                     .faced = r.faced,
                                     .gain = tn_house_gain_sum(&way->gain, &r.gain),
                                     .tray = way->tray};
        status = e->seen(e->context, &edge, error);
    }
    return status;
}

/* The first way that is not before this entry and group. */
static size_t first_way(const tn_ways *ways, uint32_t entry, uint32_t group)
{
    size_t low = 0, high = ways->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const tn_houses_way *way = &ways->items[middle];
        if (way->entry < entry || (way->entry == entry && way->group < group))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The ways [*first, *end) by which the node can go on. */
static void find_stretch(const tn_houses_expansion *e, const tn_ways *ways, uint32_t state, size_t *first, size_t *end)
{
    const tn_frontier *frontier = e->kind->frontier;
    *first = 0;
    *end = ways->count;
    if (e->stage != STAGE_PASS)
        return;
    uint32_t group = tn_frontier_slice_state_group(frontier, state);
    uint32_t entry = frontier->slices.items[frontier->stages.slices[group]].entry;
    *first = first_way(ways, entry, group);
    *end = first_way(ways, entry, group + 1);
}

static tn_status expand_end(tn_houses_expansion *e, uint32_t turn, uint32_t node, tn_error *error)
{
    uint64_t key = e->kind->layers[e->layer].nodes.keys[node];
    uint32_t plan = (uint32_t)(key >> 32);
    if (e->trays < e->houses->low || !tn_houses_plan_alive(e->houses, 0, plan))
        return TN_OK;
    const tn_houses_way way = {.plan = plan, .times = 1, .gain = tn_houses_plan_rest(e->houses, plan)};
    tn_status status = ask(e, turn, (uint32_t)key, TN_FRONTIER_NONE, 0, error);
    return status == TN_OK ? show(e, node, &way, 0, error) : status;
}

static tn_status expand_half(tn_houses_expansion *e, uint32_t turn, uint32_t node, const tn_ways *ways, tn_error *error)
{
    uint64_t key = e->kind->layers[e->layer].nodes.keys[node];
    const tn_houses_way stays = {.plan = (uint32_t)(key >> 32), .times = 1};
    if (ways->count == 0)
        return TN_OK;
    tn_status status = ask(e, turn, (uint32_t)key, ways->list, ways->list, error);
    return status == TN_OK ? show(e, node, &stays, ways->list, error) : status;
}

static tn_status expand_node(tn_houses_expansion *e, uint32_t turn, uint32_t node, tn_error *error)
{
    uint64_t key = e->kind->layers[e->layer].nodes.keys[node];
    uint32_t state = (uint32_t)key, plan = (uint32_t)(key >> 32);
    const tn_ways *ways = &e->ways[tn_number_find(&e->plans, plan)];
    size_t first, end;
    tn_status status = TN_OK;
    if (is_half(e))
        return expand_half(e, turn, node, ways, error);
    find_stretch(e, ways, state, &first, &end);
    for (size_t i = first; status == TN_OK && i < end; i++) {
        const tn_houses_way *way = &ways->items[i];
        status = ask(e, turn, state, way->slice, way->slice, error);
        if (status == TN_OK)
            status = show(e, node, way, way->slice, error);
    }
    return status;
}

/* ---- nodes by their states */

/* order: of the state's rooms and walks, with its edge, by their first appearance. */
typedef struct tn_ordered {
    uint32_t order, state, node;
} tn_ordered;

static int compare_ordered(const void *a, const void *b)
{
    const tn_ordered *p = a, *q = b;
    return p->order != q->order   ? (p->order > q->order) - (p->order < q->order)
           : p->state != q->state ? (p->state > q->state) - (p->state < q->state)
                                  : (p->node > q->node) - (p->node < q->node);
}

/* What nodes are gone through by: states that cross interfaces alike follow one another. */
static tn_status find_place(const tn_houses_expansion *e, tn_interner *crossing, uint32_t state, uint32_t *place,
                            tn_error *error)
{
    const tn_frontier *frontier = e->kind->frontier;
    size_t size;
    *place = 0;
    if (e->stage != STAGE_EXIT && e->stage != STAGE_WHOLE)
        return TN_OK;
    const uint32_t *words = state == TN_FRONTIER_NONE ? &state : tn_interned(&frontier->states, state, &size);
    *place = tn_intern(crossing, words, state == TN_FRONTIER_NONE ? 1 : tn_frontier_pending_word(frontier) - 1);
    return *place != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status order_nodes(const tn_houses_expansion *e, tn_ordered **order, uint32_t *count, tn_error *error)
{
    const tn_numbering *nodes = &e->kind->layers[e->layer].nodes;
    tn_interner crossing = {0};
    *order = malloc(((size_t)nodes->count + 1) * sizeof **order);
    tn_status status = *order ? TN_OK : tn_fail_memory(error);
    *count = 0;
    for (uint32_t i = 0; status == TN_OK && i < nodes->count; i++) {
        tn_ordered *o = &(*order)[*count];
        if (is_empty(e, i))
            continue;
        *o = (tn_ordered){.state = (uint32_t)nodes->keys[i], .node = i};
        status = find_place(e, &crossing, o->state, &o->order, error);
        ++*count;
    }
    tn_interner_clear(&crossing);
    if (status == TN_OK && *count > 0)
        qsort(*order, *count, sizeof **order, compare_ordered);
    return status;
}

static tn_status expand_nodes(tn_houses_expansion *e, bool end, tn_error *error)
{
    tn_ordered *order;
    uint32_t turn = 0, count;
    tn_status status = order_nodes(e, &order, &count, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        if (i == 0 || order[i].state != order[i - 1].state) {
            turn++;
            e->fan.used = 0;
            status = tn_watch_check(e->kind->frontier->watch, error);
            if (status == TN_OK)
                status = tn_houses_check_interfaces(e->houses, e->kind, error);
        }
        if (status == TN_OK)
            status = end ? expand_end(e, turn, order[i].node, error) : expand_node(e, turn, order[i].node, error);
    }
    free(order);
    return status;
}

static tn_status begin_fan(tn_houses_expansion *e, tn_error *error)
{
    const tn_frontier *frontier = e->kind->frontier;
    size_t by = (size_t)frontier->slices.keys.count + frontier->stages.lists.count + 1; /* what each stage goes by */
    e->fan.mark = calloc(by, sizeof *e->fan.mark);
    e->fan.first = malloc(by * sizeof *e->fan.first);
    e->fan.count = malloc(by * sizeof *e->fan.count);
    return e->fan.mark && e->fan.first && e->fan.count ? TN_OK : tn_fail_memory(error);
}

static tn_status expand(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, bool end, mpz_t *here,
                        tn_houses_edge_seen *seen, void *context, tn_error *error)
{
    uint32_t stages = tn_houses_stages(houses, kind);
    tn_houses_expansion e = {.houses = houses,
                             .kind = kind,
                             .stage = end || stages == 1 ? STAGE_WHOLE : (tn_stage)(layer % stages),
                             .layer = layer,
                             .trays = layer / stages,
                             .here = here,
                             .seen = seen,
                             .context = context};
    tn_status status = end ? TN_OK : find_all_ways(&e, error);
    if (status == TN_OK)
        status = begin_fan(&e, error);
    if (status == TN_OK)
        status = expand_nodes(&e, end, error);
    for (uint32_t i = 0; e.ways && i < e.plans.count; i++)
        free(e.ways[i].items);
    free(e.ways);
    tn_numbering_clear(&e.plans);
    free(e.fan.mark);
    free(e.fan.first);
    free(e.fan.count);
    free(e.fan.reached);
    return status;
}

tn_status tn_houses_expand(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, bool end,
                           tn_houses_edge_seen *seen, void *context, tn_error *error)
{
    return expand(houses, kind, layer, end, NULL, seen, context, error);
}

tn_status tn_houses_expand_from(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, mpz_t *here,
                                tn_houses_edge_seen *seen, void *context, tn_error *error)
{
    return expand(houses, kind, layer, false, here, seen, context, error);
}

/* ==== the layers as a graph of keys */

static tn_numbering *nodes_of(void *context, uint32_t layer)
{
    const tn_houses_layers *l = context;
    return &l->kind->layers[layer].nodes;
}

static tn_status show_edge(void *context, const tn_houses_edge *edge, tn_error *error)
{
    return tn_key_walk_edge(context, edge->from, (uint64_t)edge->plan << 32 | edge->state, edge, error);
}

/* Backwards, the steps that counting kept are shown again, once. */
static tn_status show_edges(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error)
{
    const tn_houses_layers *l = context;
    const tn_kept_steps *kept = &l->kind->layers[layer].kept;
    tn_status status = TN_OK;
    if (!walk->backwards || !kept->all)
        return tn_houses_expand(l->houses, l->kind, layer, false, show_edge, walk, error);
    for (size_t i = 0; status == TN_OK && i < kept->count; i++) {
        const tn_houses_edge edge = {.from = kept->items[i].from, .ways = 1, .times = kept->items[i].times};
        status = tn_key_walk_edge_to(walk, edge.from, kept->items[i].to, &edge, error);
    }
    tn_houses_forget_steps(l->kind, layer);
    return status;
}

static tn_status show_end(void *context, const tn_houses_edge *edge, tn_error *error)
{
    return tn_key_walk_end(context, edge->from, edge, error);
}

static tn_status show_ends(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error)
{
    const tn_houses_layers *l = context;
    uint32_t stages = tn_houses_stages(l->houses, l->kind);
    if (layer % stages != 0 || layer < l->houses->low * stages)
        return TN_OK;
    return tn_houses_expand(l->houses, l->kind, layer, true, show_end, walk, error);
}

static const tn_key_graph graph = {nodes_of, show_edges, show_ends};

tn_status tn_houses_layers_begin(tn_houses_layers *l, const tn_houses *houses, tn_houses_kind *kind, tn_error *error)
{
    uint32_t last = houses->high * tn_houses_stages(houses, kind);
    *l = (tn_houses_layers){.houses = houses, .kind = kind};
    l->walk = (tn_key_walk){.graph = &graph, .graph_context = l, .last = last};
    if (!kind->layers)
        kind->layers = calloc((size_t)last + 1, sizeof *kind->layers);
    return kind->layers ? tn_key_walk_begin(&l->walk, TN_FRONTIER_NONE, error) : tn_fail_memory(error);
}

tn_status tn_houses_go_forward(const tn_houses *houses, tn_houses_kind *kind, const tn_key_question *question,
                               tn_error *error)
{
    tn_houses_layers l;
    tn_status status = tn_houses_layers_begin(&l, houses, kind, error);
    if (status == TN_OK)
        status = tn_key_walk_forward(&l.walk, question, error);
    tn_key_walk_clear(&l.walk, question->algebra, NULL);
    return status;
}

/* ==== steps that are kept
 *
 * Keeps the steps that counting went: ranks go the same ones backwards. */

enum { KEPT_MAX = 6000000 }; /* by all kinds of sections together: 144 MB */

tn_status tn_houses_keep_step(const tn_houses *h, tn_houses_kind *kind, uint32_t layer, uint32_t to,
                              const tn_houses_edge *edge, tn_error *error)
{
    tn_kept_steps *kept = &kind->layers[layer].kept;
    uint64_t times;
    if (!kept->all)
        return TN_OK;
    if (kind->kept_steps >= KEPT_MAX / h->kind_count || __builtin_mul_overflow(edge->ways, edge->times, &times)) {
        tn_houses_forget_steps(kind, layer);
        return TN_OK;
    }
    if (!tn_array_reserve(&kept->items, &kept->room, kept->count, 1, sizeof *kept->items))
        return tn_fail_memory(error);
    kept->items[kept->count++] = (tn_kept_step){edge->from, to, edge->slice, times};
    kind->kept_steps++;
    return TN_OK;
}

void tn_houses_forget_steps(tn_houses_kind *kind, uint32_t layer)
{
    tn_kept_steps *kept = &kind->layers[layer].kept;
    kind->kept_steps -= kept->count;
    free(kept->items);
    *kept = (tn_kept_steps){0};
}
