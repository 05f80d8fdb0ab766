/* Nodes from which houses go on alike become one class: what a class is made of is the slices by which it goes on, each
 * with the plan state and the class after it. How many choices lead there does not matter. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/count/projected.h"

enum { WORK_MOST = 1 << 30, STEPS_MOST = 1 << 24 }; /* steps: of one layer, half a gigabyte */

tn_status tn_projecting_spend(tn_projecting *p, uint64_t work, tn_error *error)
{
    p->work += work;
    if (p->work <= WORK_MOST)
        return tn_watch_check(p->houses->form->module->watch, error);
    return tn_fail(error, TN_LIMIT, E_STRIP, "finding how many plans have a house takes more than %d steps", WORK_MOST);
}

int tn_way_on_compare(const void *left, const void *right)
{
    const tn_way_on *p = left, *q = right;
    for (int i = 0; i < ON_WORDS; i++)
        if (p->words[i] != q->words[i])
            return p->words[i] < q->words[i] ? -1 : 1;
    return 0;
}

/* The ways on from the nodes of a layer, node by node. */
typedef struct tn_classing {
    tn_projecting *projecting;
    tn_projected_kind *of;
    uint32_t layer;
    bool takes_slice;
    const uint32_t *next_classes; /* [nodes of the next layer]: classes */
    tn_kept_step *steps;          /* those that are not kept */
    size_t count, room;
    size_t *first; /* [nodes + 1] */
    tn_way_on *on;
    bool *ends; /* [nodes] */
} tn_classing;

static tn_status note_end(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_classing *c = context;
    (void)error;
    c->ends[edge->from] = true;
    return TN_OK;
}

static tn_status note_step(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_classing *c = context;
    const tn_houses_layer *next = &c->of->kind->layers[c->layer + 1];
    uint32_t to = tn_number_find(&next->nodes, (uint64_t)edge->plan << 32 | edge->state);
    if (c->count == STEPS_MOST)
        return tn_fail(error, TN_LIMIT, E_STRIP,
                       "finding how many plans have a house takes more than %d steps of a tray", STEPS_MOST);
    if (!tn_array_reserve(&c->steps, &c->room, c->count, 1, sizeof *c->steps))
        return tn_fail_memory(error);
    c->steps[c->count++] = (tn_kept_step){edge->from, to, edge->slice, 0};
    return tn_projecting_spend(c->projecting, 1, error);
}

/* Sorts steps by the nodes that they are from. */
static tn_status place_steps(tn_classing *c, const tn_kept_step *steps, size_t count, tn_error *error)
{
    const tn_houses_layer *layer = &c->of->kind->layers[c->layer];
    c->first = calloc((size_t)layer->nodes.count + 2, sizeof *c->first);
    c->on = malloc((count + 1) * sizeof *c->on);
    if (!c->first || !c->on)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        c->first[steps[i].from + 2] += c->next_classes[steps[i].to] != CLASS_DEAD;
    for (uint32_t i = 2; i < layer->nodes.count + 2; i++)
        c->first[i] += c->first[i - 1];
    for (size_t i = 0; i < count; i++) {
        uint32_t class = c->next_classes[steps[i].to];
        uint32_t plan = c->takes_slice ? tn_high(layer[1].nodes.keys[steps[i].to]) : 0;
        if (class != CLASS_DEAD)
            c->on[c->first[steps[i].from + 1]++] = (tn_way_on){{plan, c->takes_slice ? steps[i].slice : 0, class}};
    }
    return tn_projecting_spend(c->projecting, count, error);
}

static tn_status find_steps(tn_classing *c, tn_error *error)
{
    const tn_houses *h = c->projecting->houses;
    const tn_kept_steps *kept = &c->of->kind->layers[c->layer].kept;
    tn_status status = TN_OK;
    if (c->layer == h->high * c->of->stages)
        return place_steps(c, NULL, 0, error);
    if (!kept->all)
        status = tn_houses_expand(h, c->of->kind, c->layer, false, note_step, c, error);
    if (status != TN_OK)
        return status;
    return kept->all ? place_steps(c, kept->items, kept->count, error) : place_steps(c, c->steps, c->count, error);
}

/* The class of a node; its ways on are each taken once. */
static tn_status class_of(const tn_classing *c, uint32_t node, uint32_t *class, tn_error *error)
{
    tn_key *key = &c->projecting->key;
    tn_way_on *on = c->on + c->first[node];
    size_t count = c->first[node + 1] - c->first[node];
    bool ok = true;
    key->size = 0;
    if (count > 0)
        qsort(on, count, sizeof *on, tn_way_on_compare);
    if (count > 0 || c->ends[node])
        ok = tn_key_push(key, c->ends[node]);
    for (size_t i = 0; ok && i < count; i++)
        if (i == 0 || tn_way_on_compare(&on[i - 1], &on[i]) != 0)
            for (int w = c->takes_slice ? 0 : ON_CLASS; ok && w < ON_WORDS; w++)
                ok = tn_key_push(key, on[i].words[w]);
    *class = ok ? tn_intern(&c->of->classes, key->data, key->size) : UINT32_MAX;
    return *class != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status find_ends(tn_classing *c, tn_error *error)
{
    const tn_houses *h = c->projecting->houses;
    c->ends = calloc((size_t)c->of->kind->layers[c->layer].nodes.count + 1, sizeof *c->ends);
    if (!c->ends)
        return tn_fail_memory(error);
    bool may_end = c->layer % c->of->stages == 0 && c->layer >= h->low * c->of->stages;
    return may_end ? tn_houses_expand(h, c->of->kind, c->layer, true, note_end, c, error) : TN_OK;
}

/* classes: [nodes of the layer], which the caller frees. */
static tn_status class_layer(tn_projecting *p, tn_projected_kind *of, uint32_t layer, const uint32_t *next_classes,
                             uint32_t **classes, tn_error *error)
{
    uint32_t nodes = of->kind->layers[layer].nodes.count;
    tn_classing c = {.projecting = p, .of = of, .layer = layer, .next_classes = next_classes};
    c.takes_slice = (layer + 1) % of->stages == 0;
    *classes = malloc(((size_t)nodes + 1) * sizeof **classes);
    tn_status status = *classes ? find_ends(&c, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = find_steps(&c, error);
    for (uint32_t i = 0; status == TN_OK && i < nodes; i++)
        status = class_of(&c, i, &(*classes)[i], error);
    free(c.steps);
    free(c.first);
    free(c.on);
    free(c.ends);
    return status;
}

tn_status tn_projected_classes(tn_projecting *p, tn_projected_kind *of, uint32_t *first, tn_error *error)
{
    uint32_t *classes = NULL, *next_classes = NULL;
    tn_status status = TN_OK;
    if (tn_intern(&of->classes, NULL, 0) != CLASS_DEAD)
        return tn_fail_memory(error);
    for (uint32_t k = p->houses->high * of->stages + 1; status == TN_OK && k-- > 0;) {
        status = class_layer(p, of, k, next_classes, &classes, error);
        free(next_classes);
        next_classes = classes;
    }
    *first = status == TN_OK ? next_classes[0] : CLASS_DEAD;
    free(next_classes);
    return status;
}
