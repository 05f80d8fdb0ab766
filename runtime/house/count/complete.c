/* Open plans of houses: the nodes of all houses joined with the machine that places the written trays, counted forwards
 * and backwards. */
#include <stdlib.h>

#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"
#include "runtime/plan/measure/complete_data.h"

#define WORST ((tn_int128)INT64_MAX << 63)

/* After so many trays: each node with each place of the machine. Counts are of the choices that lead there, and of the
 * houses that go on from there and complete the plan; values the best of these. */
typedef struct tn_joint_layer {
    tn_numbering joints; /* node << 32 | machine */
    uint32_t *next;      /* [joints]: the next of the same node, or UINT32_MAX */
    uint32_t *first;     /* [nodes] */
    mpz_t *before, *after;
    tn_int128 *best_before, *best_after;
    size_t room;
} tn_joint_layer;

typedef struct tn_completing {
    const tn_houses *houses;
    tn_houses_kind *kind;
    tn_completer pattern;
    tn_interner machines; /* {placed, gap, earlier in two words} */
    uint32_t layer;
    tn_joint_layer *layers;               /* [high + 1] */
    uint64_t joints;                      /* of all layers */
    mpz_t *placed;                        /* [items][trays of the schema] */
    tn_int128 *best_placed, *best_values; /* of the same; [items][values of the schema] */
    mpz_t one;
    tn_completions *out;
} tn_completing;

/* ---- joints */

static uint32_t number_machine(tn_completing *c, tn_machine m)
{
    const uint32_t key[] = {m.placed, m.gap, (uint32_t)m.earlier, (uint32_t)(m.earlier >> 32)};
    return tn_intern(&c->machines, key, sizeof key / sizeof *key);
}

static tn_machine machine_at(const tn_completing *c, uint64_t joint)
{
    size_t size;
    const uint32_t *key = tn_interned(&c->machines, (uint32_t)joint, &size);
    return (tn_machine){key[0], key[1], (uint64_t)key[3] << 32 | key[2]};
}

static void clear_layer(tn_joint_layer *layer)
{
    tn_integers_free(layer->before, layer->room);
    tn_integers_free(layer->after, layer->room);
    tn_numbering_clear(&layer->joints);
    free(layer->next);
    free(layer->first);
    free(layer->best_before);
    free(layer->best_after);
}

static tn_int128 *worst_new(size_t count)
{
    tn_int128 *values = malloc((count + 1) * sizeof *values);
    for (size_t i = 0; values && i < count; i++)
        values[i] = WORST;
    return values;
}

/* Room for what is known of the joints, once all are met; they are listed by their nodes. */
static tn_status make_layer(const tn_completing *c, uint32_t at, tn_error *error)
{
    tn_joint_layer *layer = &c->layers[at];
    size_t nodes = c->kind->layers[at].nodes.count;
    layer->room = layer->joints.count;
    layer->next = malloc((layer->room + 1) * sizeof *layer->next);
    layer->first = malloc((nodes + 1) * sizeof *layer->first);
    layer->before = tn_integers_new(layer->room);
    layer->after = tn_integers_new(layer->room);
    layer->best_before = worst_new(layer->room);
    layer->best_after = worst_new(layer->room);
    if (!layer->next || !layer->first || !layer->before || !layer->after || !layer->best_before || !layer->best_after)
        return tn_fail_memory(error);
    for (size_t i = 0; i < nodes; i++)
        layer->first[i] = UINT32_MAX;
    for (uint32_t i = layer->joints.count; i-- > 0;) {
        uint32_t node = (uint32_t)(layer->joints.keys[i] >> 32);
        layer->next[i] = layer->first[node];
        layer->first[node] = i;
    }
    return TN_OK;
}

static tn_status too_many(const tn_completing *c, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_FRONTIER, "counting the houses that complete this takes more than %u states",
            c->houses->max_states);
    tn_error_help(error, "write fewer trays, or allow more (--max-states N)");
    return TN_LIMIT;
}

static void take_better(tn_int128 *best, tn_int128 value)
{
    *best = value < *best ? value : *best;
}

/* ---- steps */

/* A step of the houses with one of the machine. to: among the joints behind it. */
typedef struct tn_joint_step {
    uint32_t from, to;
    bool places;
    uint32_t item;
    const tn_houses_edge *edge;
} tn_joint_step;

typedef tn_status tn_take_step(tn_completing *c, const tn_joint_step *step, tn_error *error);

static tn_status each_way(tn_completing *c, const tn_houses_edge *edge, tn_take_step *take, tn_error *error)
{
    const tn_joint_layer *layer = &c->layers[c->layer];
    uint32_t node = tn_number_find(&c->kind->layers[c->layer + 1].nodes, (uint64_t)edge->plan << 32 | edge->state);
    tn_status status = TN_OK;
    for (uint32_t i = layer->first[edge->from]; status == TN_OK && i != UINT32_MAX; i = layer->next[i]) {
        tn_machine m = machine_at(c, layer->joints.keys[i]);
        tn_machine_way ways[2];
        size_t count = tn_machine_ways(&c->pattern, m, c->pattern.fits[edge->tray], ways);
        for (size_t w = 0; status == TN_OK && w < count; w++) {
            uint32_t machine = number_machine(c, ways[w].to);
            uint32_t to = machine == UINT32_MAX
                              ? machine
                              : tn_number(&c->layers[c->layer + 1].joints, (uint64_t)node << 32 | machine);
            const tn_joint_step step = {i, to, ways[w].places, m.placed, edge};
            status = to == UINT32_MAX ? tn_fail_memory(error) : take(c, &step, error);
        }
    }
    return status;
}

static tn_status meet(tn_completing *c, const tn_joint_step *step, tn_error *error)
{
    return c->joints + step->to > c->houses->max_states ? too_many(c, error) : TN_OK;
}

/* one := the choices of the step, so many times. */
static void times(tn_completing *c, const mpz_t count, const tn_houses_edge *edge)
{
    mpz_mul_ui(c->one, count, edge->ways);
    mpz_mul_ui(c->one, c->one, edge->times);
}

static tn_status count_forwards(tn_completing *c, const tn_joint_step *step, tn_error *error)
{
    const tn_joint_layer *layer = &c->layers[c->layer], *next = &c->layers[c->layer + 1];
    (void)error;
    times(c, layer->before[step->from], step->edge);
    mpz_add(next->before[step->to], next->before[step->to], c->one);
    take_better(&next->best_before[step->to], layer->best_before[step->from] + step->edge->gain.by[0]);
    return TN_OK;
}

/* Not every joint leads to a house that completes the plan: such have no best. */
static tn_status count_backwards(tn_completing *c, const tn_joint_step *step, tn_error *error)
{
    const tn_joint_layer *layer = &c->layers[c->layer], *next = &c->layers[c->layer + 1];
    size_t at = (size_t)step->item * c->houses->form->schema->tray_count + step->edge->tray;
    (void)error;
    if (mpz_sgn(next->after[step->to]) == 0)
        return TN_OK;
    tn_int128 rest = step->edge->gain.by[0] + next->best_after[step->to];
    times(c, next->after[step->to], step->edge);
    mpz_add(layer->after[step->from], layer->after[step->from], c->one);
    take_better(&layer->best_after[step->from], rest);
    if (!step->places)
        return TN_OK;
    mpz_mul(c->one, c->one, layer->before[step->from]);
    mpz_addmul_ui(c->placed[at], c->one, c->kind->sections);
    take_better(&c->best_placed[at], layer->best_before[step->from] + rest);
    return TN_OK;
}

static tn_status see_meet(void *context, const tn_houses_edge *edge, tn_error *error)
{
    return each_way(context, edge, meet, error);
}

static tn_status see_forwards(void *context, const tn_houses_edge *edge, tn_error *error)
{
    return each_way(context, edge, count_forwards, error);
}

static tn_status see_backwards(void *context, const tn_houses_edge *edge, tn_error *error)
{
    return each_way(context, edge, count_backwards, error);
}

static tn_status see_end(void *context, const tn_houses_edge *edge, tn_error *error)
{
    const tn_completing *c = context;
    const tn_joint_layer *layer = &c->layers[c->layer];
    (void)error;
    for (uint32_t i = layer->first[edge->from]; i != UINT32_MAX; i = layer->next[i]) {
        if (machine_at(c, layer->joints.keys[i]).placed < c->pattern.items)
            continue;
        mpz_add_ui(layer->after[i], layer->after[i], edge->times);
        take_better(&layer->best_after[i], edge->gain.by[0]);
    }
    return TN_OK;
}

/* ---- a section */

static tn_status go_forwards(tn_completing *c, tn_error *error)
{
    const tn_houses *h = c->houses;
    uint32_t machine = number_machine(c, tn_machine_start(&c->pattern));
    if (machine == UINT32_MAX || tn_number(&c->layers[0].joints, machine) == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = make_layer(c, 0, error);
    if (status == TN_OK) {
        mpz_set_ui(c->layers[0].before[0], 1);
        c->layers[0].best_before[0] = h->measures ? tn_houses_plan_start(h).by[0] : 0;
    }
    for (c->layer = 0; status == TN_OK && c->layer < h->high; c->layer++) {
        c->joints += c->layers[c->layer].joints.count;
        status = tn_houses_expand(h, c->kind, c->layer, false, see_meet, c, error);
        if (status == TN_OK)
            status = make_layer(c, c->layer + 1, error);
        if (status == TN_OK)
            status = tn_houses_expand(h, c->kind, c->layer, false, see_forwards, c, error);
    }
    return status;
}

static tn_status go_backwards(tn_completing *c, tn_error *error)
{
    const tn_houses *h = c->houses;
    tn_status status = TN_OK;
    for (c->layer = h->high + 1; status == TN_OK && c->layer-- > 0;) {
        if (c->layer >= h->low)
            status = tn_houses_expand(h, c->kind, c->layer, true, see_end, c, error);
        if (status == TN_OK && c->layer < h->high)
            status = tn_houses_expand(h, c->kind, c->layer, false, see_backwards, c, error);
    }
    return status;
}

static tn_status complete_kind(tn_completing *c, tn_error *error)
{
    uint32_t layers = c->houses->high + 1;
    c->layers = calloc(layers, sizeof *c->layers);
    c->joints = 0;
    tn_status status = c->layers ? go_forwards(c, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = go_backwards(c, error);
    if (status == TN_OK)
        mpz_addmul_ui(c->out->plans, c->layers[0].after[0], c->kind->sections);
    for (uint32_t k = 0; c->layers && k < layers; k++)
        clear_layer(&c->layers[k]);
    free(c->layers);
    c->layers = NULL;
    return status;
}

/* ---- the answer */

static tn_status make_room(tn_completing *c, tn_error *error)
{
    tn_completions *out = c->out;
    const tn_schema *schema = c->houses->form->schema;
    size_t placed = (size_t)c->pattern.items * schema->tray_count;
    size_t values = (size_t)c->pattern.items * schema->value_count;
    c->placed = tn_integers_new(placed);
    c->best_placed = worst_new(placed);
    out->counts = tn_integers_new(values);
    out->best = c->houses->measures ? calloc(values + 1, sizeof *out->best) : NULL;
    c->best_values = worst_new(values);
    if (!c->placed || !c->best_placed || !c->best_values || !out->counts || (c->houses->measures && !out->best))
        return tn_fail_memory(error);
    out->trays = c->pattern.items;
    out->values = schema->value_count;
    return TN_OK;
}

static void add_values(const tn_completing *c)
{
    const tn_schema *schema = c->houses->form->schema;
    tn_completions *out = c->out;
    for (uint32_t i = 0; i < c->pattern.items; i++)
        for (tn_tray t = 0; t < schema->tray_count; t++)
            for (uint32_t f = 0; f < schema->field_count; f++) {
                size_t at = (size_t)i * out->values + schema->value_start[f] + tn_tray_value(schema, t, f);
                size_t placed = (size_t)i * schema->tray_count + t;
                mpz_add(out->counts[at], out->counts[at], c->placed[placed]);
                take_better(&c->best_values[at], c->best_placed[placed]);
            }
    tn_int128 sign = out->best && c->houses->measures->most[0] ? -1 : 1;
    for (size_t i = 0; out->best && i < (size_t)out->trays * out->values; i++)
        out->best[i] =
            c->best_values[i] == WORST ? TN_NO_BEST : tn_houses_shown(c->houses, 0, sign * c->best_values[i]);
}

tn_status tn_houses_complete(tn_houses *h, const tn_open_plan *open, tn_completions *out, tn_error *error)
{
    tn_completing c = {.houses = h, .out = out, .pattern = {.library = h->plans}};
    *out = (tn_completions){0};
    mpz_inits(out->plans, c.one, NULL);
    tn_status status = tn_completer_read(&c.pattern, open, error);
    if (status == TN_OK)
        status = make_room(&c, error);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        c.kind = &h->kinds[i];
        status = complete_kind(&c, error);
    }
    if (status == TN_OK)
        add_values(&c);
    tn_completer_clear_pattern(&c.pattern);
    tn_interner_clear(&c.machines);
    tn_integers_free(c.placed, (size_t)c.pattern.items * h->form->schema->tray_count);
    free(c.best_placed);
    free(c.best_values);
    mpz_clear(c.one);
    return status;
}
