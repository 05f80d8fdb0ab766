/* The states of the houses on a plan that have one value: a state of the frontier and the value so far, from which the
 * wanted one is reached. Choosing among these houses is then the same as among all. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/rank/path.h"

bool tn_aim_leads_on(const tn_path_aim *aim, uint32_t trays, uint32_t length, uint32_t state,
                     const tn_house_gain *value)
{
    const tn_houses_layer *layer = &aim->kind->layers[trays];
    uint32_t node = tn_number_find(&layer->nodes, (uint64_t)aim->plans[trays] << 32 | state);
    tn_house_gain left;
    if (node == UINT32_MAX)
        return false;
    for (size_t k = 0; k < TN_WEIGHED_MAX; k++)
        left.by[k] = aim->wanted->by[k] - value->by[k];
    const tn_value_counts *of_node = &layer->best[(size_t)node * tn_houses_lengths(aim->houses)];
    return tn_value_counts_has(&of_node[length - aim->houses->low], &left);
}

/* ---- steps */

typedef struct tn_valuing {
    tn_plan_path *path;
    uint32_t trays; /* before the step */
    bool ends;
    tn_house_gain before;
    tn_frontier_seen *seen;
    void *context;
} tn_valuing;

/* *number: of the state with the value. */
static tn_status number_of(tn_plan_path *p, uint32_t state, const tn_house_gain *value, uint32_t *number,
                           tn_error *error)
{
    enum { STATE, VALUE, WORDS = VALUE + sizeof value->by / (sizeof(uint32_t)) };
    uint32_t words[WORDS] = {state}, before = p->numbers.count;
    memcpy(words + VALUE, value->by, sizeof value->by);
    bool ok = tn_array_reserve(&p->valued, &p->valued_room, before, 1, sizeof *p->valued);
    *number = ok ? tn_intern(&p->numbers, words, WORDS) : UINT32_MAX;
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    p->valued[*number] = (tn_path_valued){state, *value};
    return TN_OK;
}

static tn_status see(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                     tn_error *error)
{
    const tn_valuing *v = context;
    const tn_path_aim *aim = v->path->aim;
    tn_house_gain value = tn_house_gain_sum(&v->before, gain);
    if (v->ends) {
        tn_house_gain rest = tn_houses_plan_rest(aim->houses, aim->plans[v->trays]);
        value = tn_house_gain_sum(&value, &rest);
        bool has = tn_house_gain_compare(&value, aim->wanted) == 0;
        return has ? v->seen(v->context, state, times, faced, gain, error) : TN_OK;
    }
    value = tn_house_gain_sum(&value, &aim->gains[v->trays]);
    if (!tn_aim_leads_on(aim, v->trays + 1, v->path->length, state, &value))
        return TN_OK;
    uint32_t number;
    tn_status status = number_of(v->path, state, &value, &number, error);
    return status == TN_OK ? v->seen(v->context, number, times, faced, gain, error) : status;
}

/* The state before the first slice has the value that plans begin with. */
static uint32_t begin_step(tn_valuing *v, uint32_t state)
{
    const tn_path_valued first = {TN_FRONTIER_NONE, tn_houses_plan_start(v->path->aim->houses)};
    const tn_path_valued *before = state != TN_FRONTIER_NONE ? &v->path->valued[state] : &first;
    v->before = before->value;
    return before->state;
}

tn_status tn_path_step(tn_plan_path *p, uint32_t tray, uint32_t state, uint32_t slice, const tn_frontier_list *only,
                       tn_frontier_seen *seen, void *context, tn_error *error)
{
    tn_frontier *frontier = p->kind.frontier;
    tn_valuing v = {.path = p, .trays = tray, .ends = slice == TN_FRONTIER_NONE, .seen = seen, .context = context};
    if (p->aim) {
        state = begin_step(&v, state);
        seen = see;
        context = &v;
    }
    return only ? tn_frontier_step_by(frontier, tray, state, slice, only, seen, context, error)
                : tn_frontier_step(frontier, tray, state, slice, seen, context, error);
}

/* ---- states: a graph of keys, which are the numbers of these states with their values */

static tn_numbering *nodes_of(void *context, uint32_t layer)
{
    return &((tn_plan_path *)context)->kind.layers[layer].nodes;
}

typedef struct tn_valued_node {
    tn_key_walk *walk;
    uint32_t place;
    uint64_t ways; /* of the slice */
} tn_valued_node;

static tn_status show(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                      tn_error *error)
{
    const tn_valued_node *n = context;
    const tn_houses_edge edge = {.from = n->place, .state = state, .ways = n->ways, .times = times};
    (void)faced;
    (void)gain;
    return n->walk->layer < n->walk->last ? tn_key_walk_edge(n->walk, n->place, state, &edge, error)
                                          : tn_key_walk_end(n->walk, n->place, &edge, error);
}

static tn_status show_edges(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error)
{
    tn_plan_path *p = context;
    const tn_frontier_list *slices = &p->kind.frontier->slices.of_tray[p->view.only[layer]];
    tn_status status = tn_watch_check(p->kind.frontier->watch, error);
    for (uint32_t i = 0; status == TN_OK && i < p->kind.layers[layer].nodes.count; i++)
        for (size_t k = 0; status == TN_OK && k < slices->count; k++) {
            tn_valued_node n = {walk, i, slices->items[k].times};
            status = tn_path_step(p, layer, tn_path_state(p, layer, i), slices->items[k].slice, NULL, show, &n, error);
        }
    return status;
}

static tn_status show_ends(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error)
{
    tn_plan_path *p = context;
    tn_status status = TN_OK;
    for (uint32_t i = 0; layer == p->length && status == TN_OK && i < p->kind.layers[layer].nodes.count; i++) {
        tn_valued_node n = {walk, i, 1};
        status = tn_path_step(p, layer, tn_path_state(p, layer, i), TN_FRONTIER_NONE, NULL, show, &n, error);
    }
    return status;
}

static tn_status pass(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    (void)context;
    (void)sum;
    (void)element;
    (void)at;
    (void)error;
    return TN_OK;
}

tn_status tn_path_find_valued(tn_plan_path *p, const tn_path_aim *aim, const tn_tray *trays, uint32_t length,
                              tn_error *error)
{
    static const tn_key_graph graph = {nodes_of, show_edges, show_ends};
    static const tn_walk_algebra meeting = {.add = pass};
    *p = (tn_plan_path){.view = *aim->houses, .kind = {.frontier = aim->kind->frontier}, .length = length, .aim = aim};
    p->view.only = trays;
    p->view.low = p->view.high = length;
    p->view.whole_steps = true;
    p->stages = 1;
    p->kind.layers = calloc((size_t)length + 1, sizeof *p->kind.layers);
    if (!p->kind.layers)
        return tn_fail_memory(error);
    tn_key_walk walk = {.graph = &graph, .graph_context = p, .last = length};
    tn_status status = tn_key_walk_begin(&walk, TN_FRONTIER_NONE, error);
    if (status == TN_OK)
        status = tn_key_walk_forward(&walk, &(tn_key_question){&meeting, NULL, p, 0}, error);
    if (status == TN_OK)
        status = tn_houses_look_back(&p->view, &p->kind, &walk, error);
    tn_key_walk_clear(&walk, NULL, NULL);
    return status == TN_OK ? tn_path_begin_states(p, error) : status;
}
