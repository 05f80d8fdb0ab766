/* The plans that houses stand on, as an automaton: what the library knows after so many trays, and what measures add.
 *
 * Near the end of the row little of that still matters: plan states from which the same trays lead to plans, and add
 * the same to the measures, are merged for each number of trays. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"

bool tn_houses_plan_lives(const tn_houses *h, uint32_t layer, uint32_t plan)
{
    uint32_t least = h->low > layer ? h->low - layer : 0;
    for (uint32_t left = least; left <= h->high - layer; left++)
        if (tn_houses_plan_alive(h, left, plan))
            return true;
    return false;
}

/* Without a library the one plan that is looked at has a state after each of its trays: how many there are so far. */
bool tn_houses_plan_alive(const tn_houses *h, uint32_t left, uint32_t plan)
{
    if (!h->plans)
        return plan != TN_FRONTIER_NONE && plan + left == h->high;
    return plan != TN_FRONTIER_NONE &&
           (h->weighed ? tn_weighed_alive(h->weighed, left, plan) : tn_library_lives(h->plans, left, plan));
}

/* What plans add to each measure, in steps of its numbers but for costs: these are known before all costs are. */
typedef struct tn_plan_steps {
    int64_t by[TN_WEIGHED_MAX];
} tn_plan_steps;

static void weigh(const tn_houses *h, tn_plan_steps *steps)
{
    for (uint32_t k = 0; k < h->measures->count; k++)
        steps->by[k] *= h->measures->of[k]->plan * (h->measures->most[k] ? -1 : 1);
}

static tn_plan_steps rest_of_plan(const tn_houses *h, uint32_t plan)
{
    tn_plan_steps steps = {{0}};
    for (uint32_t k = 0; h->measures && k < h->measures->count; k++)
        steps.by[k] = tn_weighed_rest(h->weighed, plan, k);
    if (h->measures)
        weigh(h, &steps);
    return steps;
}

/* The same in the steps that values have. */
static tn_house_gain gain_of_plan(const tn_houses *h, const tn_plan_steps *steps)
{
    tn_house_gain gain = {{0}};
    for (uint32_t k = 0; h->measures && k < h->measures->count; k++)
        gain.by[k] = h->units.others[k] * steps->by[k];
    return gain;
}

tn_house_gain tn_houses_plan_start(const tn_houses *h)
{
    tn_plan_steps steps = {{0}};
    for (uint32_t k = 0; k < h->measures->count; k++)
        steps.by[k] = tn_weighed_start(h->weighed, k);
    weigh(h, &steps);
    return gain_of_plan(h, &steps);
}

tn_house_gain tn_houses_plan_rest(const tn_houses *h, uint32_t plan)
{
    const tn_plan_steps steps = rest_of_plan(h, plan);
    return gain_of_plan(h, &steps);
}

/* Where a tray leads before what is alike is merged. */
static tn_status step(const tn_houses *h, uint32_t layer, uint32_t plan, tn_tray tray, uint32_t *next,
                      tn_plan_steps *steps, tn_error *error)
{
    *next = TN_FRONTIER_NONE;
    *steps = (tn_plan_steps){{0}};
    if (h->only && h->only[layer] != tray)
        return TN_OK;
    if (!h->weighed) {
        *next = h->plans ? tn_library_next(h->plans, plan, tray) : plan + 1;
        return TN_OK;
    }
    tn_status status = tn_weighed_step(h->weighed, plan, tn_weighed_letter(h->weighed, tray), next, steps->by, error);
    weigh(h, steps);
    return status;
}

static tn_status merged_step(const tn_houses *h, uint32_t layer, uint32_t plan, tn_tray tray, uint32_t *next,
                             tn_plan_steps *steps, tn_error *error)
{
    tn_status status = step(h, layer, plan, tray, next, steps, error);
    const tn_houses_plan_layer *after = &h->plan_layers[layer + 1];
    uint32_t at = status == TN_OK && *next != TN_FRONTIER_NONE ? tn_number_find(&after->states, *next) : UINT32_MAX;
    *next = at == UINT32_MAX ? TN_FRONTIER_NONE : after->alike[at];
    return status;
}

tn_status tn_houses_plan_next(const tn_houses *h, uint32_t layer, uint32_t plan, tn_tray tray, uint32_t *next,
                              tn_house_gain *gain, tn_error *error)
{
    tn_plan_steps steps;
    tn_status status = merged_step(h, layer, plan, tray, next, &steps, error);
    *gain = gain_of_plan(h, &steps);
    return status;
}

/* ---- the states that plans of the library reach, and the trays between them */

/* Sets of trays are bits in so many words. */
typedef struct tn_reaching {
    const tn_houses *houses;
    tn_frontier_trays *trays;
    uint64_t *into, *next; /* [states of the layer], of the next: by which trays plans come there */
    size_t into_room, next_room;
    uint64_t *onward; /* by which they go on */
} tn_reaching;

static void add_tray(uint64_t *set, tn_tray tray)
{
    set[tray / 64] |= UINT64_C(1) << tray % 64;
}

/* A state of the next layer, new or old, that the tray leads to. */
static tn_status reach_state(tn_reaching *r, uint32_t layer, uint32_t state, tn_tray tray, tn_error *error)
{
    size_t words = r->trays->words, before = r->next_room;
    uint32_t at = tn_number(&r->houses->plan_layers[layer + 1].states, state);
    if (at == UINT32_MAX || !tn_array_reserve(&r->next, &r->next_room, at * words, words, sizeof *r->next))
        return tn_fail_memory(error);
    memset(r->next + before, 0, (r->next_room - before) * sizeof *r->next);
    add_tray(r->next + at * words, tray);
    add_tray(r->onward, tray);
    r->trays->stand[tray] = true;
    return TN_OK;
}

static void note_followers(tn_reaching *r, uint32_t at)
{
    size_t words = r->trays->words;
    for (tn_tray t = 0; r->trays->follows && t < r->houses->form->schema->tray_count; t++)
        for (size_t w = 0; r->into[at * words + t / 64] >> t % 64 & 1 && w < words; w++)
            r->trays->follows[t * words + w] |= r->onward[w];
}

static tn_status reach_next(tn_reaching *r, uint32_t layer, uint32_t at, tn_error *error)
{
    const tn_houses *h = r->houses;
    uint32_t plan = (uint32_t)h->plan_layers[layer].states.keys[at];
    tn_status status = TN_OK;
    memset(r->onward, 0, r->trays->words * sizeof *r->onward);
    for (tn_tray t = 0; status == TN_OK && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        tn_plan_steps steps;
        status = step(h, layer, plan, t, &next, &steps, error);
        if (status == TN_OK && tn_houses_plan_lives(h, layer + 1, next))
            status = reach_state(r, layer, next, t, error);
    }
    if (layer > 0)
        note_followers(r, at);
    return status;
}

static tn_status reach_layers(tn_reaching *r, tn_error *error)
{
    const tn_houses *h = r->houses;
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < h->high; k++) {
        for (uint32_t i = 0; status == TN_OK && i < h->plan_layers[k].states.count; i++)
            status = reach_next(r, k, i, error);
        uint64_t *into = r->into;
        size_t room = r->into_room;
        r->into = r->next;
        r->into_room = r->next_room;
        r->next = into;
        r->next_room = room;
        if (room > 0)
            memset(r->next, 0, room * sizeof *r->next);
    }
    return status;
}

/* ---- what is alike */

static bool push_steps(const tn_houses *h, tn_key *key, const tn_plan_steps *steps)
{
    bool ok = true;
    for (uint32_t k = 0; ok && h->measures && k < h->measures->count; k++)
        ok = tn_push_long(key, (uint64_t)steps->by[k]);
    return ok;
}

/* What goes on from a plan state: whether the row may end, then each tray that leads on, with what comes after it. */
static tn_status describe(const tn_houses *h, uint32_t layer, uint32_t plan, tn_key *key, tn_error *error)
{
    bool end = layer >= h->low && tn_houses_plan_alive(h, 0, plan);
    tn_plan_steps steps = end ? rest_of_plan(h, plan) : (tn_plan_steps){{0}};
    tn_status status = TN_OK;
    key->size = 0;
    bool ok = tn_key_push(key, end) && push_steps(h, key, &steps);
    for (tn_tray t = 0; ok && layer < h->high && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        status = merged_step(h, layer, plan, t, &next, &steps, error);
        ok = status == TN_OK;
        if (ok && next != TN_FRONTIER_NONE)
            ok = tn_key_push(key, t) && tn_key_push(key, next) && push_steps(h, key, &steps);
    }
    return ok ? TN_OK : status != TN_OK ? status : tn_fail_memory(error);
}

/* The layer after it is merged already. */
static tn_status merge_layer(tn_houses *h, uint32_t at, tn_error *error)
{
    tn_houses_plan_layer *layer = &h->plan_layers[at];
    tn_interner classes = {0};
    tn_key key = {0};
    tn_status status = TN_OK;
    uint32_t *first = malloc(((size_t)layer->states.count + 1) * sizeof *first); /* of each class */
    layer->alike = malloc(((size_t)layer->states.count + 1) * sizeof *layer->alike);
    if (!first || !layer->alike)
        status = tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < layer->states.count; i++) {
        uint32_t plan = (uint32_t)layer->states.keys[i], before = classes.count;
        status = describe(h, at, plan, &key, error);
        uint32_t class = status == TN_OK ? tn_intern(&classes, key.data, key.size) : 0;
        if (class == UINT32_MAX)
            status = tn_fail_memory(error);
        if (status != TN_OK)
            continue;
        if (class == before)
            first[class] = plan;
        layer->alike[i] = first[class];
    }
    tn_interner_clear(&classes);
    free(key.data);
    free(first);
    return status;
}

/* A schema with more trays than this has too many pairs of them. */
enum { FOLLOWED_TRAYS_MAX = 4096 };

static tn_status begin_trays(const tn_houses *h, tn_frontier_trays *trays, tn_error *error)
{
    size_t count = h->form->schema->tray_count;
    trays->words = count / 64 + 1;
    trays->stand = calloc(count + 1, sizeof *trays->stand);
    if (count <= FOLLOWED_TRAYS_MAX)
        trays->follows = calloc(tn_size_of(count + 1, trays->words), sizeof *trays->follows);
    return trays->stand && (trays->follows || count > FOLLOWED_TRAYS_MAX) ? TN_OK : tn_fail_memory(error);
}

tn_status tn_houses_plans_find(tn_houses *h, tn_frontier_trays *trays, tn_error *error)
{
    tn_reaching r = {.houses = h, .trays = trays};
    tn_status status = begin_trays(h, trays, error);
    h->plan_layers = calloc((size_t)h->high + 1, sizeof *h->plan_layers);
    r.onward = calloc(trays->words, sizeof *r.onward);
    if (status == TN_OK && (!h->plan_layers || !r.onward || tn_number(&h->plan_layers[0].states, 0) == UINT32_MAX))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = reach_layers(&r, error);
    for (uint32_t k = h->high + 1; status == TN_OK && k-- > 0;)
        status = merge_layer(h, k, error);
    free(r.into);
    free(r.next);
    free(r.onward);
    return status;
}

void tn_frontier_trays_clear(tn_frontier_trays *trays)
{
    free(trays->stand);
    free(trays->follows);
}

void tn_houses_plans_clear(tn_houses *h)
{
    for (uint32_t k = 0; h->plan_layers && k <= h->high; k++) {
        tn_numbering_clear(&h->plan_layers[k].states);
        free(h->plan_layers[k].alike);
    }
    free(h->plan_layers);
}
