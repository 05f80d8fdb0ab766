/* Open plans of houses: the nodes of all houses joined with the machine that places the written trays, counted forwards
 * and backwards. */
#include <stdlib.h>

#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"
#include "runtime/plan/measure/open_plan.h"

#define WORST ((tn_int128)INT64_MAX << 63)

/* A joint is a node with a place of the machine. Its element, forwards, is of the choices that lead there; backwards of
 * the houses that go on from there and complete the plan. best: the best value of these. */
typedef struct tn_joint_counts {
    mpz_t count;
    tn_int128 best;
} tn_joint_counts;

/* The joints of a layer by their nodes. */
typedef struct tn_joint_lists {
    uint32_t *next;  /* [joints]: the next of the same node, or UINT32_MAX */
    uint32_t *first; /* [nodes] */
} tn_joint_lists;

typedef struct tn_completing {
    const tn_houses *houses;
    tn_houses_kind *kind;
    tn_open_pattern pattern;
    tn_interner machines; /* {placed, gap, earlier in two words} */
    tn_numbering *joints; /* [high + 1]: node << 32 | machine */
    tn_key_walk walk;
    tn_joint_lists lists;                 /* of the layer at hand */
    uint64_t joint_count;                 /* of all layers before the next */
    mpz_t *placed;                        /* [items][trays of the schema] */
    tn_int128 *best_placed, *best_values; /* of the same; [items][values of the schema] */
    mpz_t one;
    tn_completions *out;
} tn_completing;

/* ---- joints */

static uint32_t number_machine(tn_completing *c, tn_open_machine m)
{
    const uint32_t key[] = {m.placed, m.gap, (uint32_t)m.earlier, (uint32_t)(m.earlier >> 32)};
    return tn_intern(&c->machines, key, sizeof key / sizeof *key);
}

static tn_open_machine machine_at(const tn_completing *c, uint64_t joint)
{
    size_t size;
    const uint32_t *key = tn_interned(&c->machines, (uint32_t)joint, &size);
    return (tn_open_machine){key[0], key[1], (uint64_t)key[3] << 32 | key[2]};
}

static tn_int128 *worst_new(size_t count)
{
    tn_int128 *values = malloc((count + 1) * sizeof *values);
    for (size_t i = 0; values && i < count; i++)
        values[i] = WORST;
    return values;
}

static bool list_joints(tn_completing *c, uint32_t layer)
{
    const tn_numbering *joints = &c->joints[layer];
    size_t nodes = c->kind->layers[layer].nodes.count;
    c->lists.next = malloc(((size_t)joints->count + 1) * sizeof *c->lists.next);
    c->lists.first = malloc((nodes + 1) * sizeof *c->lists.first);
    if (!c->lists.next || !c->lists.first)
        return false;
    for (size_t i = 0; i < nodes; i++)
        c->lists.first[i] = UINT32_MAX;
    for (uint32_t i = joints->count; i-- > 0;) {
        uint32_t node = (uint32_t)(joints->keys[i] >> 32);
        c->lists.next[i] = c->lists.first[node];
        c->lists.first[node] = i;
    }
    return true;
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

/* ---- the graph: steps of the houses with those of the machine */

typedef struct tn_joint_step {
    bool places;
    uint32_t item;
    const tn_houses_edge *edge;
} tn_joint_step;

static tn_numbering *joints_of(void *context, uint32_t layer)
{
    return &((tn_completing *)context)->joints[layer];
}

static tn_status each_way(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_completing *c = context;
    uint32_t layer = c->walk.layer;
    uint32_t node = tn_number_find(&c->kind->layers[layer + 1].nodes, (uint64_t)edge->plan << 32 | edge->state);
    tn_status status = TN_OK;
    for (uint32_t i = c->lists.first[edge->from]; status == TN_OK && i != UINT32_MAX; i = c->lists.next[i]) {
        tn_open_machine m = machine_at(c, c->joints[layer].keys[i]);
        tn_open_way ways[2];
        size_t count = tn_open_ways(&c->pattern, m, c->pattern.fits[edge->tray], ways);
        for (size_t w = 0; status == TN_OK && w < count; w++) {
            uint32_t machine = number_machine(c, ways[w].to);
            const tn_joint_step step = {ways[w].places, m.placed, edge};
            status = machine == UINT32_MAX
                         ? tn_fail_memory(error)
                         : tn_key_walk_edge(&c->walk, i, (uint64_t)node << 32 | machine, &step, error);
        }
    }
    return status;
}

static tn_status each_end(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_completing *c = context;
    tn_status status = TN_OK;
    for (uint32_t i = c->lists.first[edge->from]; status == TN_OK && i != UINT32_MAX; i = c->lists.next[i])
        if (machine_at(c, c->joints[c->walk.layer].keys[i]).placed == c->pattern.items)
            status = tn_key_walk_end(&c->walk, i, edge, error);
    return status;
}

static tn_status show(tn_completing *c, uint32_t layer, bool end, tn_error *error)
{
    tn_status status = list_joints(c, layer) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_houses_expand(c->houses, c->kind, layer, end, end ? each_end : each_way, c, error);
    free(c->lists.next);
    free(c->lists.first);
    c->lists = (tn_joint_lists){0};
    return status;
}

static tn_status show_edges(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error)
{
    tn_completing *c = context;
    c->joint_count += walk->backwards ? 0 : c->joints[layer].count;
    return show(c, layer, false, error);
}

static tn_status show_ends(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error)
{
    const tn_completing *c = context;
    (void)walk;
    return layer >= c->houses->low ? show(context, layer, true, error) : TN_OK;
}

/* ---- what is counted */

static void zero_joint(const void *context, void *element)
{
    tn_joint_counts *joint = element;
    (void)context;
    mpz_init(joint->count);
    joint->best = WORST;
}

static void clear_joint(void *element)
{
    mpz_clear(((tn_joint_counts *)element)->count);
}

static tn_status start(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const tn_completing *c = context;
    tn_joint_counts *joint = element;
    (void)layer;
    (void)state;
    (void)error;
    mpz_set_ui(joint->count, 1);
    joint->best = c->houses->measures ? tn_houses_plan_start(c->houses).by[0] : 0;
    return TN_OK;
}

/* one := the choices of the step, so many times. */
static void times(tn_completing *c, const mpz_t count, const tn_houses_edge *edge)
{
    mpz_mul_ui(c->one, count, edge->ways);
    mpz_mul_ui(c->one, c->one, edge->times);
}

static tn_status count_forwards(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_completing *c = context;
    tn_joint_counts *to = sum;
    const tn_joint_counts *from = element;
    const tn_houses_edge *edge = ((const tn_joint_step *)at->label)->edge;
    if (c->joint_count + at->to > c->houses->max_states)
        return too_many(c, error);
    times(c, from->count, edge);
    mpz_add(to->count, to->count, c->one);
    take_better(&to->best, from->best + edge->gain.by[0]);
    return TN_OK;
}

/* Not every joint leads to a house that completes the plan: such have no best. */
static tn_status count_backwards(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_completing *c = context;
    tn_joint_counts *from = sum;
    const tn_joint_counts *to = element,
                          *before = tn_key_walk_forward_of(&c->walk, at->layer, at->from, sizeof *before);
    const tn_joint_step *step = at->label;
    size_t placed = (size_t)step->item * c->houses->form->schema->tray_count + step->edge->tray;
    (void)error;
    if (mpz_sgn(to->count) == 0)
        return TN_OK;
    tn_int128 rest = step->edge->gain.by[0] + to->best;
    times(c, to->count, step->edge);
    mpz_add(from->count, from->count, c->one);
    take_better(&from->best, rest);
    if (!step->places)
        return TN_OK;
    mpz_mul(c->one, c->one, before->count);
    mpz_addmul_ui(c->placed[placed], c->one, c->kind->sections);
    take_better(&c->best_placed[placed], before->best + rest);
    return TN_OK;
}

static tn_status count_end(void *context, void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_joint_counts *joint = element;
    const tn_houses_edge *edge = at->label;
    (void)context;
    (void)error;
    mpz_add_ui(joint->count, joint->count, edge->times);
    take_better(&joint->best, edge->gain.by[0]);
    return TN_OK;
}

/* ---- a section */

static tn_status complete_kind(tn_completing *c, tn_error *error)
{
    static const tn_key_graph graph = {joints_of, show_edges, show_ends};
    static const tn_walk_algebra before = {
        .zero = zero_joint, .clear = clear_joint, .one = start, .add = count_forwards};
    static const tn_walk_algebra after = {.zero = zero_joint, .clear = clear_joint, .add = count_backwards};
    uint32_t last = c->houses->high, machine = number_machine(c, tn_open_start(&c->pattern));
    c->walk = (tn_key_walk){.graph = &graph, .graph_context = c, .last = last, .keeps = true};
    c->joints = calloc((size_t)last + 1, sizeof *c->joints);
    c->joint_count = 0;
    if (!c->joints || machine == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = tn_key_walk_begin(&c->walk, machine, error);
    if (status == TN_OK)
        status = tn_key_walk_forward(&c->walk, &(tn_key_question){&before, NULL, c, sizeof(tn_joint_counts)}, error);
    if (status == TN_OK)
        status =
            tn_key_walk_backward(&c->walk, &(tn_key_question){&after, count_end, c, sizeof(tn_joint_counts)}, error);
    if (status == TN_OK)
        mpz_addmul_ui(c->out->plans, ((tn_joint_counts *)(void *)c->walk.backward[0])->count, c->kind->sections);
    tn_key_walk_clear(&c->walk, &before, &after);
    return status;
}

static void clear_kind(tn_completing *c)
{
    for (uint32_t k = 0; c->joints && k <= c->houses->high; k++)
        tn_numbering_clear(&c->joints[k]);
    free(c->joints);
    c->joints = NULL;
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
    tn_completing c = {.houses = h, .out = out};
    *out = (tn_completions){0};
    mpz_inits(out->plans, c.one, NULL);
    tn_status status = tn_open_pattern_read(&c.pattern, tn_library_schema(h->plans), open, error);
    if (status == TN_OK)
        status = make_room(&c, error);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        c.kind = &h->kinds[i];
        status = complete_kind(&c, error);
        clear_kind(&c);
    }
    if (status == TN_OK)
        add_values(&c);
    tn_interner_clear(&c.machines);
    tn_integers_free(c.placed, (size_t)c.pattern.items * h->form->schema->tray_count);
    free(c.best_placed);
    free(c.best_values);
    tn_open_pattern_clear(&c.pattern);
    mpz_clear(c.one);
    return status;
}
