/* Ranks of houses among all of a library: how many come before a plan, and the plan of a rank.
 *
 * Behind each node it is counted how many houses go on from there, for each length. A walk along a plan then has, for
 * each node that the plan reaches, the number of choices that lead there. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/rank/path.h"

/* ==== along a plan, if steps have stages
 *
 * Where the trays of a plan lead, one after another, in a kind of section whose steps have stages. The number of
 * choices that lead to each node is kept for the nodes of a layer as a whole; many states are then gone on from at
 * once. */

typedef struct tn_plan_along {
    tn_houses view; /* the houses, with ways by tray; borrows all that they have */
    tn_houses_kind *kind;
    tn_tray *trays; /* [count]: those taken; the nodes may be further on */
    uint32_t count, layer;
    mpz_t *here;    /* [nodes of the layer]: choices that lead there */
    mpz_t *by_tray; /* [trays of the schema]: houses that go on by each */
    bool summed;    /* these are of the trays taken so far */
} tn_plan_along;

/* Begins before the first tray. Both are borrowed. End it also after a failure. */
static tn_status along_begin(const tn_houses *houses, tn_houses_kind *kind, tn_plan_along *a, tn_error *error)
{
    *a = (tn_plan_along){.view = *houses, .kind = kind};
    a->view.keep_trays = true;
    a->trays = malloc(((size_t)houses->high + 1) * sizeof *a->trays);
    a->here = tn_integers_new(1);
    a->by_tray = tn_integers_new(houses->form->schema->tray_count);
    if (!a->trays || !a->here || !a->by_tray)
        return tn_fail_memory(error);
    mpz_set_ui(a->here[0], 1);
    return TN_OK;
}

static void along_end(tn_plan_along *a)
{
    tn_integers_free(a->here, a->kind ? a->kind->layers[a->layer].nodes.count : 0);
    tn_integers_free(a->by_tray, a->kind ? a->view.form->schema->tray_count : 0);
    free(a->trays);
    *a = (tn_plan_along){0};
}

static void along_take(tn_plan_along *a, tn_tray tray)
{
    a->trays[a->count++] = tray;
    a->summed = false;
}

/* ---- from layer to layer */

typedef struct tn_plan_along_push {
    const tn_plan_along *along;
    const tn_tray *only; /* NULL: all */
    mpz_t *next;
    mpz_t one;
} tn_plan_along_push;

static tn_status push(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_plan_along_push *p = context;
    const tn_numbering *to = &p->along->kind->layers[p->along->layer + 1].nodes;
    (void)error;
    if (p->only && edge->tray != *p->only)
        return TN_OK;
    uint32_t at = tn_number_find(to, (uint64_t)edge->plan << 32 | edge->state);
    mpz_mul_ui(p->one, p->along->here[edge->from], edge->ways);
    mpz_addmul_ui(p->next[at], p->one, edge->times);
    return TN_OK;
}

/* only: the tray, if the step ends with one. */
static tn_status push_on(tn_plan_along *a, const tn_tray *only, tn_error *error)
{
    const tn_houses_layer *layers = a->kind->layers;
    tn_plan_along_push p = {.along = a, .only = only, .next = tn_integers_new(layers[a->layer + 1].nodes.count)};
    if (!p.next)
        return tn_fail_memory(error);
    mpz_init(p.one);
    tn_status status = tn_houses_expand_from(&a->view, a->kind, a->layer, a->here, push, &p, error);
    mpz_clear(p.one);
    tn_integers_free(a->here, layers[a->layer].nodes.count);
    a->here = p.next;
    a->layer++;
    return status;
}

/* To the last layer before the states after so many trays and one more. */
static tn_status push_to(tn_plan_along *a, uint32_t trays, tn_error *error)
{
    uint32_t stages = tn_houses_stages(&a->view, a->kind);
    tn_status status = TN_OK;
    while (status == TN_OK && a->layer + 1 < (trays + 1) * stages) {
        bool ends = (a->layer + 1) % stages == 0;
        status = push_on(a, ends ? &a->trays[a->layer / stages] : NULL, error);
    }
    return status;
}

/* ---- houses by tray */

typedef struct tn_plan_along_sum {
    const tn_plan_along *along;
    uint32_t length;
    mpz_t one;
} tn_plan_along_sum;

static tn_status add_along(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_plan_along_sum *s = context;
    const tn_plan_along *a = s->along;
    const tn_houses_layer *next = &a->kind->layers[a->layer + 1];
    uint32_t at = tn_number_find(&next->nodes, (uint64_t)edge->plan << 32 | edge->state);
    (void)error;
    mpz_mul_ui(s->one, next->ahead[(size_t)at * tn_houses_lengths(&a->view) + s->length - a->view.low], edge->ways);
    mpz_mul_ui(s->one, s->one, edge->times);
    mpz_addmul(a->by_tray[edge->tray], s->one, a->here[edge->from]);
    return TN_OK;
}

static tn_status find_along(tn_plan_along *a, uint32_t length, tn_error *error)
{
    tn_plan_along_sum s = {.along = a, .length = length};
    if (a->summed)
        return TN_OK;
    for (tn_tray t = 0; t < a->view.form->schema->tray_count; t++)
        mpz_set_ui(a->by_tray[t], 0);
    tn_status status = push_to(a, a->count, error);
    mpz_init(s.one);
    if (status == TN_OK)
        status = tn_houses_expand_from(&a->view, a->kind, a->layer, a->here, add_along, &s, error);
    mpz_clear(s.one);
    a->summed = status == TN_OK;
    return status;
}

/* ---- what is kept */

/* *place: where the numbers of this beginning are kept: NULL if they are not known yet; NULL: too many are. */
static tn_status place_along(const tn_plan_along *a, uint32_t length, mpz_t ***place, tn_error *error)
{
    enum { MOST = 1000000 }; /* numbers */
    tn_houses_kind *kind = a->kind;
    tn_key *key = &kind->frontier->key;
    uint32_t before = kind->beginnings.count;
    *place = NULL;
    if ((uint64_t)before * a->view.form->schema->tray_count > MOST)
        return TN_OK;
    key->size = 0;
    bool ok = tn_key_push(key, length);
    for (uint32_t i = 0; ok && i < a->count; i++)
        ok = tn_key_push(key, (uint32_t)a->trays[i]);
    if (!ok || !tn_array_reserve(&kind->by_beginning, &kind->beginning_room, before, 1, sizeof *kind->by_beginning))
        return tn_fail_memory(error);
    uint32_t at = tn_intern(&kind->beginnings, key->data, key->size);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    if (at == before)
        kind->by_beginning[at] = NULL;
    *place = &kind->by_beginning[at];
    return TN_OK;
}

/* *houses: of one section, on plans of the length that go on by the tray; good until the next call. Those by all trays
 * are found at once, and kept with the kind by the beginning of the plan, as many plans begin alike. */
static tn_status along_houses(tn_plan_along *a, uint32_t length, tn_tray tray, mpz_ptr *houses, tn_error *error)
{
    uint32_t trays = a->view.form->schema->tray_count;
    mpz_t **place;
    tn_status status = place_along(a, length, &place, error);
    *houses = a->by_tray[tray];
    if (status == TN_OK && place && *place)
        *houses = (*place)[tray];
    else if (status == TN_OK)
        status = find_along(a, length, error);
    if (status != TN_OK || !place || *place)
        return status;
    *place = tn_integers_new(trays);
    for (tn_tray t = 0; *place && t < trays; t++)
        mpz_set((*place)[t], a->by_tray[t]);
    return *place ? TN_OK : tn_fail_memory(error);
}

/* ==== plans */

/* ---- what is ahead */

/* The element of a node is a number for each length. */
typedef struct tn_looking_ahead {
    const tn_houses *houses;
    uint32_t stages;
    mpz_t one;
} tn_looking_ahead;

static void zero_ahead(const void *context, void *element)
{
    const tn_looking_ahead *b = context;
    for (uint32_t i = 0; i < tn_houses_lengths(b->houses); i++)
        mpz_init(((mpz_t *)element)[i]);
}

static tn_status end_ahead(void *context, void *element, const tn_walk_edge *at, tn_error *error)
{
    const tn_looking_ahead *b = context;
    mpz_ptr ahead = ((mpz_t *)element)[at->layer / b->stages - b->houses->low];
    (void)error;
    mpz_add_ui(ahead, ahead, ((const tn_houses_edge *)at->label)->times);
    return TN_OK;
}

static tn_status add_ahead(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_looking_ahead *b = context;
    mpz_t *ahead = sum;
    mpz_srcptr next = element;
    const tn_houses_edge *edge = at->label;
    (void)error;
    for (uint32_t i = 0; i < tn_houses_lengths(b->houses); i++) {
        if (mpz_sgn(&next[i]) == 0)
            continue;
        mpz_mul_ui(b->one, &next[i], edge->ways);
        mpz_addmul_ui(ahead[i], b->one, edge->times);
    }
    return TN_OK;
}

tn_status tn_houses_look_back(const tn_houses *h, tn_houses_kind *kind, tn_key_walk *walk, tn_error *error)
{
    static const tn_walk_algebra numbers = {.zero = zero_ahead, .add = add_ahead};
    tn_looking_ahead b = {.houses = h, .stages = h->high > 0 ? walk->last / h->high : 1};
    mpz_init(b.one);
    const tn_key_question ahead = {&numbers, end_ahead, &b, tn_houses_lengths(h) * sizeof(mpz_t)};
    tn_status status = tn_key_walk_backward(walk, &ahead, error);
    for (uint32_t k = 0; k <= walk->last; k++) {
        kind->layers[k].ahead = (mpz_t *)(void *)walk->backward[k];
        walk->backward[k] = NULL;
    }
    mpz_clear(b.one);
    return status;
}

tn_status tn_houses_look_ahead(const tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    tn_houses_layers l;
    tn_status status = tn_houses_layers_begin(&l, h, kind, error);
    if (status == TN_OK)
        status = tn_houses_look_back(h, kind, &l.walk, error);
    tn_key_walk_clear(&l.walk, NULL, NULL);
    return status;
}

static tn_status make_ranked(tn_houses *h, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && !h->ranked && i < h->kind_count; i++)
        status = tn_houses_look_ahead(h, &h->kinds[i], error);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++)
        status = tn_frontier_ways_want(h->kinds[i].frontier, error);
    h->ranked = status == TN_OK;
    return status;
}

/* ---- a walk along a plan */

/* The states of one kind of section that the trays so far reach, and how many choices lead to each; where there are
 * many slices, `along` knows instead. */
typedef struct tn_houses_front {
    uint32_t *states;
    mpz_t *counts;
    size_t count, room, counts_room;
    bool staged;
    tn_plan_along along;
} tn_houses_front;

typedef struct tn_plan_walk {
    tn_houses *houses;
    uint32_t length, layer, plan;
    tn_houses_front *fronts; /* [kinds] */
    mpz_t *by_tray;          /* [trays of the schema] scratch */
    mpz_t one;
} tn_plan_walk;

static void clear_front(tn_houses_front *front)
{
    for (size_t i = 0; i < front->count; i++)
        mpz_clear(front->counts[i]);
    front->count = 0;
}

static tn_status add_state(tn_houses_front *front, uint32_t state, const mpz_t count, uint64_t times, tn_error *error)
{
    size_t i = 0;
    while (i < front->count && front->states[i] != state)
        i++;
    if (i == front->count) {
        if (!tn_array_reserve(&front->states, &front->room, i, 1, sizeof *front->states) ||
            !tn_array_reserve(&front->counts, &front->counts_room, i, 1, sizeof *front->counts))
            return tn_fail_memory(error);
        front->states[i] = state;
        mpz_init(front->counts[i]);
        front->count++;
    }
    mpz_addmul_ui(front->counts[i], count, times);
    return TN_OK;
}

static void walk_end(tn_plan_walk *w)
{
    for (size_t i = 0; w->fronts && i < w->houses->kind_count; i++) {
        if (w->fronts[i].staged)
            along_end(&w->fronts[i].along);
        clear_front(&w->fronts[i]);
        free(w->fronts[i].states);
        free(w->fronts[i].counts);
    }
    free(w->fronts);
    tn_integers_free(w->by_tray, w->houses->form->schema->tray_count);
    mpz_clear(w->one);
}

static tn_status walk_begin(tn_houses *h, uint32_t length, tn_plan_walk *w, tn_error *error)
{
    *w = (tn_plan_walk){.houses = h, .length = length};
    mpz_init_set_ui(w->one, 1);
    w->fronts = calloc(h->kind_count + 1, sizeof *w->fronts);
    w->by_tray = tn_integers_new(h->form->schema->tray_count);
    tn_status status = w->fronts && w->by_tray ? make_ranked(h, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        tn_houses_front *front = &w->fronts[i];
        front->staged =
            tn_houses_stages(h, &h->kinds[i]) > 1 && h->kinds[i].frontier->slices.keys.count >= h->many_slices;
        status = front->staged ? along_begin(h, &h->kinds[i], &front->along, error)
                               : add_state(front, TN_FRONTIER_NONE, w->one, 1, error);
    }
    return status;
}

/* ---- houses ahead of a tray */

typedef struct tn_summing_up {
    const tn_plan_walk *walk;
    const tn_houses_layer *next;
    uint32_t plan;
    mpz_t sum;
} tn_summing_up;

static tn_status sum_up(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                        tn_error *error)
{
    tn_summing_up *s = context;
    const tn_houses *h = s->walk->houses;
    uint32_t node = tn_number_find(&s->next->nodes, (uint64_t)s->plan << 32 | state);
    (void)faced;
    (void)gain;
    (void)error;
    if (node != UINT32_MAX)
        mpz_addmul_ui(s->sum, s->next->ahead[(size_t)node * tn_houses_lengths(h) + s->walk->length - h->low], times);
    return TN_OK;
}

/* houses := those that go on from a state by this tray to a plan of the length. */
static tn_status go_on_by(tn_plan_walk *w, const tn_houses_kind *kind, uint32_t state, tn_tray tray, mpz_t houses,
                          tn_error *error)
{
    const tn_houses *h = w->houses;
    const tn_frontier_list *list = &kind->frontier->slices.of_tray[tray];
    tn_summing_up s = {.walk = w, .next = &kind->layers[(w->layer + 1) * tn_houses_stages(h, kind)]};
    tn_house_gain gain;
    mpz_set_ui(houses, 0);
    tn_status status = tn_houses_plan_next(h, w->layer, w->plan, tray, &s.plan, &gain, error);
    if (status != TN_OK || !tn_houses_plan_alive(h, w->length - w->layer - 1, s.plan))
        return status;
    mpz_init(s.sum);
    for (size_t k = 0; status == TN_OK && k < list->count; k++) {
        mpz_set_ui(s.sum, 0);
        status = tn_frontier_step(kind->frontier, w->layer, state, list->items[k].slice, sum_up, &s, error);
        mpz_addmul_ui(houses, s.sum, list->items[k].times);
    }
    mpz_clear(s.sum);
    return status;
}

static tn_status find_by_tray(tn_plan_walk *w, const tn_houses_kind *kind, uint32_t state, mpz_t *by_tray,
                              tn_error *error)
{
    tn_status status = TN_OK;
    for (tn_tray t = 0; status == TN_OK && t < w->houses->form->schema->tray_count; t++)
        status = go_on_by(w, kind, state, t, by_tray[t], error);
    return status;
}

/* *place: where the numbers of a node are kept, of houses of the walk's length; NULL: there are too many. */
static tn_status place_of(tn_plan_walk *w, tn_houses_kind *kind, uint32_t state, mpz_t ***place, tn_error *error)
{
    enum { MOST = 1000000 }; /* numbers */
    tn_houses *h = w->houses;
    tn_houses_layer *layer = &kind->layers[w->layer * tn_houses_stages(h, kind)];
    size_t lengths = tn_houses_lengths(h);
    uint32_t node = tn_number_find(&layer->nodes, (uint64_t)w->plan << 32 | state);
    *place = NULL;
    if (node == UINT32_MAX || h->by_tray_count > MOST)
        return TN_OK;
    if (!layer->by_tray)
        layer->by_tray = calloc(tn_size_of(layer->nodes.count, lengths) + 1, sizeof *layer->by_tray);
    if (!layer->by_tray)
        return tn_fail_memory(error);
    *place = &layer->by_tray[node * lengths + w->length - h->low];
    return TN_OK;
}

/* *houses: of a state by a tray, good until the next call. Those of all trays are found at once and kept, as many plans
 * begin alike. */
static tn_status find_houses(tn_plan_walk *w, tn_houses_kind *kind, uint32_t state, tn_tray tray, mpz_ptr *houses,
                             tn_error *error)
{
    tn_houses *h = w->houses;
    mpz_t **place = NULL;
    tn_status status = place_of(w, kind, state, &place, error);
    *houses = w->by_tray[tray];
    if (status != TN_OK || !place)
        return status != TN_OK ? status : go_on_by(w, kind, state, tray, w->by_tray[tray], error);
    if (!*place) {
        mpz_t *found = tn_integers_new(h->form->schema->tray_count);
        status = found ? find_by_tray(w, kind, state, found, error) : tn_fail_memory(error);
        if (status != TN_OK) {
            tn_integers_free(found, h->form->schema->tray_count);
            return status;
        }
        *place = found;
        h->by_tray_count += h->form->schema->tray_count;
    }
    *houses = (*place)[tray];
    return TN_OK;
}

/* Houses whose plans go on with this tray. */
static tn_status houses_by(tn_plan_walk *w, tn_tray tray, mpz_t houses, tn_error *error)
{
    const tn_houses *h = w->houses;
    tn_status status = TN_OK;
    mpz_set_ui(houses, 0);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        mpz_ptr one;
        if (w->fronts[i].staged) {
            status = along_houses(&w->fronts[i].along, w->length, tray, &one, error);
            if (status == TN_OK)
                mpz_addmul_ui(houses, one, h->kinds[i].sections);
        }
        for (size_t k = 0; status == TN_OK && k < w->fronts[i].count; k++) {
            status = find_houses(w, &h->kinds[i], w->fronts[i].states[k], tray, &one, error);
            if (status != TN_OK)
                continue;
            mpz_mul(w->one, one, w->fronts[i].counts[k]);
            mpz_addmul_ui(houses, w->one, h->kinds[i].sections);
        }
    }
    return status;
}

/* ---- going on by a tray */

typedef struct tn_going_on {
    tn_houses_front *next;
    mpz_ptr count;
    uint64_t times; /* of the slice */
    mpz_t one;
} tn_going_on;

static tn_status go_to(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                       tn_error *error)
{
    tn_going_on *g = context;
    (void)faced;
    (void)gain;
    mpz_mul_ui(g->one, g->count, times);
    return add_state(g->next, state, g->one, g->times, error);
}

static tn_status go_on(tn_plan_walk *w, tn_tray tray, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < w->houses->kind_count; i++) {
        tn_frontier *frontier = w->houses->kinds[i].frontier;
        const tn_frontier_list *list = &frontier->slices.of_tray[tray];
        tn_houses_front next = {0};
        if (w->fronts[i].staged) {
            along_take(&w->fronts[i].along, tray);
            continue;
        }
        tn_going_on g = {.next = &next};
        mpz_init(g.one);
        for (size_t k = 0; status == TN_OK && k < list->count; k++)
            for (size_t n = 0; status == TN_OK && n < w->fronts[i].count; n++) {
                g.count = w->fronts[i].counts[n];
                g.times = list->items[k].times;
                status = tn_frontier_step(frontier, w->layer, w->fronts[i].states[n], list->items[k].slice, go_to, &g,
                                          error);
            }
        mpz_clear(g.one);
        clear_front(&w->fronts[i]);
        free(w->fronts[i].states);
        free(w->fronts[i].counts);
        w->fronts[i] = next;
    }
    tn_house_gain gain;
    if (status == TN_OK)
        status = tn_houses_plan_next(w->houses, w->layer, w->plan, tray, &w->plan, &gain, error);
    w->layer++;
    return status;
}

/* ---- ranks */

tn_status tn_houses_before(tn_houses *h, const tn_tray *trays, uint32_t length, mpz_t before, tn_error *error)
{
    tn_plan_walk w;
    mpz_t houses;
    mpz_init(houses);
    mpz_set_ui(before, 0);
    for (uint32_t k = h->low; k < length; k++) {
        tn_houses_count(h, k, houses);
        mpz_add(before, before, houses);
    }
    tn_status status = walk_begin(h, length, &w, error);
    for (uint32_t i = 0; status == TN_OK && i < length; i++) {
        for (tn_tray t = 0; status == TN_OK && t < trays[i]; t++) {
            status = houses_by(&w, t, houses, error);
            mpz_add(before, before, houses);
        }
        if (status == TN_OK && i + 1 < length)
            status = go_on(&w, trays[i], error);
    }
    walk_end(&w);
    mpz_clear(houses);
    return status;
}

/* The length of the plan; rank becomes that among the houses of this length. */
static bool find_length(const tn_houses *h, mpz_t rank, uint32_t *length)
{
    mpz_t houses;
    bool found = false;
    mpz_init(houses);
    for (uint32_t k = h->low; !found && k <= h->high; k++) {
        tn_houses_count(h, k, houses);
        *length = k;
        found = mpz_cmp(rank, houses) < 0;
        if (!found)
            mpz_sub(rank, rank, houses);
    }
    mpz_clear(houses);
    return found;
}

/* houses := those that go on with the tray. */
static tn_status find_tray(tn_plan_walk *w, mpz_t rank, tn_tray *tray, mpz_t houses, tn_error *error)
{
    tn_status status = TN_OK;
    for (*tray = 0; *tray < w->houses->form->schema->tray_count; ++*tray) {
        status = houses_by(w, *tray, houses, error);
        if (status != TN_OK || mpz_cmp(rank, houses) < 0)
            break;
        mpz_sub(rank, rank, houses);
    }
    return status;
}

tn_status tn_houses_find(tn_houses *h, mpz_t rank, tn_tray *trays, uint32_t *length, mpz_t on_plan, tn_error *error)
{
    tn_plan_walk w;
    if (!find_length(h, rank, length)) {
        tn_status status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library has fewer houses than that");
        tn_error_help(error, "`tartan count` says how many; ranks count from 0");
        return status;
    }
    tn_houses_count(h, *length, on_plan); /* if there is one plan, or one without trays */
    if (h->only) {
        memcpy(trays, h->only, *length * sizeof *trays);
        return TN_OK;
    }
    tn_status status = walk_begin(h, *length, &w, error);
    for (uint32_t i = 0; status == TN_OK && i < *length; i++) {
        status = find_tray(&w, rank, &trays[i], on_plan, error);
        if (status == TN_OK && i + 1 < *length)
            status = go_on(&w, trays[i], error);
    }
    walk_end(&w);
    return status;
}
