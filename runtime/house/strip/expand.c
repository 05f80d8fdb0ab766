/* Goes from the nodes of a layer to those of the next: each state meets each slice once, whatever the plans are. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/strip/houses_data.h"

typedef struct tn_reached {
    uint32_t state;
    uint64_t times, faced;
    tn_house_gain gain;
} tn_reached;

/* From one state: what it reaches by each slice that was asked for. */
typedef struct tn_fan {
    uint32_t *mark; /* [slices]: the group that the slice was last asked for */
    size_t *first;  /* [slices + 1]: its part of `reached`, and how much */
    size_t *count;
    tn_reached *reached;
    size_t used, room;
} tn_fan;

/* The ways on from one plan state. */
typedef struct tn_ways {
    tn_houses_way *items;
    size_t count, room;
} tn_ways;

typedef struct tn_houses_expansion {
    const tn_houses *houses;
    tn_houses_kind *kind;
    uint32_t layer;
    tn_numbering plans; /* of the layer */
    tn_ways *ways;      /* [plans] */
    tn_fan fan;
    tn_houses_edge_seen *seen;
    void *context;
} tn_houses_expansion;

/* ---- ways of plans */

static int compare_ways(const void *a, const void *b)
{
    const tn_houses_way *p = a, *q = b;
    return p->slice != q->slice ? (p->slice > q->slice) - (p->slice < q->slice)
           : p->plan != q->plan ? (p->plan > q->plan) - (p->plan < q->plan)
           : p->tray != q->tray ? (p->tray > q->tray) - (p->tray < q->tray)
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

static tn_status find_ways(tn_houses_expansion *e, uint32_t plan, tn_ways *ways, tn_error *error)
{
    const tn_houses *h = e->houses;
    const tn_strip *strip = e->kind->strip;
    for (tn_tray t = 0; e->layer < h->high && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        tn_house_gain gain;
        const tn_strip_list *list = &strip->of_tray[t];
        tn_status status = tn_houses_plan_next(h, e->layer, plan, t, &next, &gain, error);
        if (status != TN_OK)
            return status;
        if (list->count == 0 || !tn_houses_plan_lives(h, e->layer + 1, next))
            continue;
        if (!tn_array_reserve(&ways->items, &ways->room, ways->count, list->count, sizeof *ways->items))
            return tn_fail_memory(error);
        for (size_t i = 0; i < list->count; i++) {
            uint32_t slice = list->items[i].slice;
            ways->items[ways->count++] = (tn_houses_way){strip->scouting ? strip->slices[slice].plain : slice, next,
                                                         list->items[i].times, gain, h->trays_matter ? t : 0};
        }
    }
    if (ways->count > 0)
        merge_ways(ways);
    return TN_OK;
}

static tn_status find_all_ways(tn_houses_expansion *e, tn_error *error)
{
    const tn_numbering *nodes = &e->kind->layers[e->layer].nodes;
    for (uint32_t i = 0; i < nodes->count; i++)
        if (tn_number(&e->plans, nodes->keys[i] >> 32) == UINT32_MAX)
            return tn_fail_memory(error);
    e->ways = calloc((size_t)e->plans.count + 1, sizeof *e->ways);
    tn_status status = e->ways ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < e->plans.count; i++)
        status = find_ways(e, (uint32_t)e->plans.keys[i], &e->ways[i], error);
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

/* Behind the last tray only states are kept in which the row may end. */
static tn_status keep_ends(tn_houses_expansion *e, size_t first, tn_error *error)
{
    tn_fan *fan = &e->fan;
    tn_status status = TN_OK;
    size_t kept = first;
    for (size_t i = first; status == TN_OK && i < fan->used; i++) {
        bool ends;
        status = tn_strip_ends(e->kind->strip, e->layer + 1, fan->reached[i].state, &ends, error);
        fan->reached[kept] = fan->reached[i];
        kept += ends;
    }
    fan->used = kept;
    return status;
}

/* Steps by a slice, if the group has not done so yet. */
static tn_status ask(tn_houses_expansion *e, uint32_t group, uint32_t state, uint32_t slice, size_t at, tn_error *error)
{
    tn_fan *fan = &e->fan;
    if (fan->mark[at] == group)
        return TN_OK;
    fan->mark[at] = group;
    fan->first[at] = fan->used;
    tn_status status = tn_strip_step(e->kind->strip, e->layer, state, slice, reach, fan, error);
    if (status == TN_OK && slice != TN_STRIP_NONE && e->layer + 1 == e->houses->high)
        status = keep_ends(e, fan->first[at], error);
    fan->count[at] = fan->used - fan->first[at];
    return status;
}

static tn_status show(const tn_houses_expansion *e, uint32_t from, const tn_houses_way *way, size_t at, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < e->fan.count[at]; i++) {
        tn_reached r = e->fan.reached[e->fan.first[at] + i];
        tn_houses_edge edge = {
            from, way->plan, r.state, way->times, r.times, r.faced, tn_house_gain_sum(&way->gain, &r.gain), way->tray};
        status = e->seen(e->context, &edge, error);
    }
    return status;
}

static tn_status expand_node(tn_houses_expansion *e, uint32_t group, uint32_t node, bool end, tn_error *error)
{
    uint64_t key = e->kind->layers[e->layer].nodes.keys[node];
    uint32_t state = (uint32_t)key, plan = (uint32_t)(key >> 32);
    const tn_ways *ways = end ? NULL : &e->ways[tn_number_find(&e->plans, plan)];
    tn_status status = TN_OK;
    if (end && e->layer >= e->houses->low && tn_houses_plan_alive(e->houses, 0, plan)) {
        const tn_houses_way way = {.plan = plan, .times = 1, .gain = tn_houses_plan_rest(e->houses, plan)};
        status = ask(e, group, state, TN_STRIP_NONE, 0, error);
        return status == TN_OK ? show(e, node, &way, 0, error) : status;
    }
    for (size_t i = 0; ways && status == TN_OK && i < ways->count; i++) {
        status = ask(e, group, state, ways->items[i].slice, ways->items[i].slice, error);
        if (status == TN_OK)
            status = show(e, node, &ways->items[i], ways->items[i].slice, error);
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

/* States that cross planes alike follow one another. */
static tn_ordered *order_nodes(const tn_strip *strip, const tn_numbering *nodes)
{
    tn_ordered *order = malloc(((size_t)nodes->count + 1) * sizeof *order);
    tn_interner crossing = {0};
    bool ok = order != NULL;
    for (uint32_t i = 0; ok && i < nodes->count; i++) {
        size_t size;
        uint32_t state = (uint32_t)nodes->keys[i];
        const uint32_t *words = state == TN_STRIP_NONE ? &state : tn_interned(&strip->states, state, &size);
        uint32_t place = tn_intern(&crossing, words, state == TN_STRIP_NONE ? 1 : tn_strip_waiting_word(strip) - 1);
        order[i] = (tn_ordered){place, state, i};
        ok = place != UINT32_MAX;
    }
    tn_interner_clear(&crossing);
    if (ok && nodes->count > 0)
        qsort(order, nodes->count, sizeof *order, compare_ordered);
    if (ok)
        return order;
    free(order);
    return NULL;
}

static tn_status expand_nodes(tn_houses_expansion *e, bool end, tn_error *error)
{
    const tn_numbering *nodes = &e->kind->layers[e->layer].nodes;
    tn_ordered *order = order_nodes(e->kind->strip, nodes);
    if (!order)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    uint32_t group = 0;
    for (uint32_t i = 0; status == TN_OK && i < nodes->count; i++) {
        if (i == 0 || order[i].state != order[i - 1].state) {
            group++;
            e->fan.used = 0;
            status = tn_watch_check(e->kind->strip->watch, error);
        }
        if (status == TN_OK)
            status = expand_node(e, group, order[i].node, end, error);
    }
    free(order);
    return status;
}

tn_status tn_houses_expand(const tn_houses *houses, tn_houses_kind *kind, uint32_t layer, bool end,
                           tn_houses_edge_seen *seen, void *context, tn_error *error)
{
    size_t slices = (size_t)kind->strip->slice_keys.count + 1;
    tn_houses_expansion e = {.houses = houses, .kind = kind, .layer = layer, .seen = seen, .context = context};
    e.fan.mark = calloc(slices, sizeof *e.fan.mark);
    e.fan.first = malloc(slices * sizeof *e.fan.first);
    e.fan.count = malloc(slices * sizeof *e.fan.count);
    tn_status status = e.fan.mark && e.fan.first && e.fan.count ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && !end)
        status = find_all_ways(&e, error);
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
