/* How many plans have a house, and how many of their sections and functions: the automaton of houses is projected to
 * trays, or to trays with functions, and made deterministic by the subset construction.
 *
 * First, nodes from which houses go on alike are merged to classes: what a class is made of is the slices by which it
 * goes on, each with the plan state and the class after it. How many choices lead there does not matter. Then sets of
 * classes are followed from the beginning, with the number of plans, or of plans with functions, that lead to each. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"

/* Words of a class: may the row end there; then the way on. From one tray to the next, if a step has stages, there are
 * classes that go on without a slice: a word for each. */
enum { CLASS_ENDS, CLASS_ON };
enum { ON_PLAN, ON_SLICE, ON_CLASS, ON_WORDS };
enum { CLASS_DEAD }; /* nothing goes on from there */

/* A way on from a node. If no slice is taken, plan and slice are 0. */
typedef struct tn_way_on {
    uint32_t words[ON_WORDS];
} tn_way_on;

/* One kind of section. */
typedef struct tn_projected_kind {
    tn_houses_kind *kind;
    uint32_t stages;
    tn_interner classes; /* of nodes from which houses go on alike */
    tn_interner sets;    /* of classes, ascending; 0: the empty one */
    uint32_t first;      /* the set before the first tray */
    uint32_t *slots;     /* [slices]: scratch, where the ways on by each begin, and one more */
    uint32_t *stamps;    /* the same: of which turn that is */
    uint32_t turn;
} tn_projected_kind;

typedef struct tn_projecting {
    tn_houses *houses;
    tn_projected_kind *kinds; /* [kinds] */
    uint64_t work;
    tn_key key; /* scratch */
} tn_projecting;

/* ==== classes */

enum { WORK_MOST = 1 << 30, STEPS_MOST = 1 << 24 }; /* steps: of one layer, half a gigabyte */

/* TN_LIMIT (E1640) if there were too many steps. */
static tn_status spend(tn_projecting *p, uint64_t work, tn_error *error)
{
    p->work += work;
    if (p->work <= WORK_MOST)
        return tn_watch_check(p->houses->form->module->watch, error);
    return tn_fail(error, TN_LIMIT, E_FRONTIER, "finding how many plans have a house takes more than %d steps",
                   WORK_MOST);
}

static int compare_ways_on(const void *left, const void *right)
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
        return tn_fail(error, TN_LIMIT, E_FRONTIER,
                       "finding how many plans have a house takes more than %d steps of a tray", STEPS_MOST);
    if (!tn_array_reserve(&c->steps, &c->room, c->count, 1, sizeof *c->steps))
        return tn_fail_memory(error);
    c->steps[c->count++] = (tn_kept_step){edge->from, to, edge->slice, 0};
    return spend(c->projecting, 1, error);
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
    return spend(c->projecting, count, error);
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
        qsort(on, count, sizeof *on, compare_ways_on);
    if (count > 0 || c->ends[node])
        ok = tn_key_push(key, c->ends[node]);
    for (size_t i = 0; ok && i < count; i++)
        if (i == 0 || compare_ways_on(&on[i - 1], &on[i]) != 0)
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

/* Finds the classes of all nodes, layer by layer from the end. first: that of the node before the first tray. */
static tn_status find_classes(tn_projecting *p, tn_projected_kind *of, uint32_t *first, tn_error *error)
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

/* ==== sets of classes */

/* The number of the set of the classes in p->key, which are sorted; each is taken once. */
static tn_status number_set(tn_projecting *p, tn_projected_kind *of, uint32_t *set, tn_error *error)
{
    tn_key *key = &p->key;
    size_t kept = 0;
    if (key->size > 0)
        qsort(key->data, key->size, sizeof *key->data, tn_words_compare);
    for (size_t i = 0; i < key->size; i++)
        if (kept == 0 || key->data[i] != key->data[kept - 1])
            key->data[kept++] = key->data[i];
    *set = tn_intern(&of->sets, key->data, kept);
    if (*set == UINT32_MAX)
        return tn_fail_memory(error);
    return spend(p, key->size, error);
}

/* of->first := the set of the node before the first tray. */
static tn_status begin_sets(tn_projecting *p, tn_projected_kind *of, tn_error *error)
{
    uint32_t class = CLASS_DEAD;
    tn_status status = find_classes(p, of, &class, error);
    if (status != TN_OK)
        return status;
    p->key.size = 0;
    if (tn_intern(&of->sets, NULL, 0) == UINT32_MAX || (class != CLASS_DEAD && !tn_key_push(&p->key, class)))
        return tn_fail_memory(error);
    return number_set(p, of, &of->first, error);
}

static bool ends(const tn_projected_kind *of, uint32_t set)
{
    size_t count, size;
    const uint32_t *classes = tn_interned(&of->sets, set, &count);
    for (size_t i = 0; i < count; i++)
        if (tn_interned(&of->classes, classes[i], &size)[CLASS_ENDS])
            return true;
    return false;
}

/* set := the set of all that its classes go on to, if they do so without a slice. */
static tn_status go_on(tn_projecting *p, tn_projected_kind *of, uint32_t *set, tn_error *error)
{
    size_t count, size;
    const uint32_t *classes = tn_interned(&of->sets, *set, &count);
    p->key.size = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t *words = tn_interned(&of->classes, classes[i], &size);
        for (size_t w = CLASS_ON; w < size; w++)
            if (!tn_key_push(&p->key, words[w]))
                return tn_fail_memory(error);
    }
    return number_set(p, of, set, error);
}

/* ---- from a set, by a tray or its functions */

/* All ways on from a set, by plan state, slice and class; those to one plan state are [begin, end). */
typedef struct tn_projected_ways {
    tn_projecting *projecting;
    tn_projected_kind *of;
    tn_way_on *on;
    size_t count, room, begin, end;
} tn_projected_ways;

static tn_status gather(tn_projected_ways *g, uint32_t set, tn_error *error)
{
    size_t count, size;
    g->count = g->begin = g->end = 0;
    const uint32_t *classes = tn_interned(&g->of->sets, set, &count);
    for (size_t i = 0; i < count; i++) {
        const uint32_t *words = tn_interned(&g->of->classes, classes[i], &size);
        size_t more = (size - CLASS_ON) / ON_WORDS;
        if (!tn_array_reserve(&g->on, &g->room, g->count, more, sizeof *g->on))
            return tn_fail_memory(error);
        memcpy(g->on + g->count, words + CLASS_ON, more * sizeof *g->on);
        g->count += more;
    }
    if (g->count > 0)
        qsort(g->on, g->count, sizeof *g->on, compare_ways_on);
    return spend(g->projecting, g->count, error);
}

/* From now on ways lead to this plan state; where those by each slice begin is noted. */
static void aim(tn_projected_ways *g, uint32_t plan)
{
    tn_projected_kind *of = g->of;
    if (g->end > g->begin && g->on[g->begin].words[ON_PLAN] == plan)
        return;
    of->turn++;
    g->begin = 0;
    while (g->begin < g->count && g->on[g->begin].words[ON_PLAN] < plan)
        g->begin++;
    for (g->end = g->begin; g->end < g->count && g->on[g->end].words[ON_PLAN] == plan; g->end++) {
        uint32_t slice = g->on[g->end].words[ON_SLICE];
        if (of->stamps[slice] != of->turn)
            of->slots[slice] = (uint32_t)g->end;
        of->stamps[slice] = of->turn;
    }
}

/* Adds the classes after a slice to those of the key. */
static bool push_after(const tn_projected_ways *g, uint32_t slice)
{
    bool ok = true;
    if (g->of->stamps[slice] != g->of->turn)
        return true;
    for (size_t i = g->of->slots[slice]; ok && i < g->end && g->on[i].words[ON_SLICE] == slice; i++)
        ok = tn_key_push(&g->projecting->key, g->on[i].words[ON_CLASS]);
    return ok;
}

/* ---- plans and functions that lead to sets */

/* Nodes of one layer of the projection, and how many lead to each. */
typedef struct tn_projected_layer {
    tn_numbering nodes; /* plan state << 32 | set, or tuple of sets */
    mpz_t *counts;      /* [nodes] */
    size_t count, room;
} tn_projected_layer;

static void clear_layer(tn_projected_layer *layer)
{
    tn_numbering_clear(&layer->nodes);
    tn_integers_free(layer->counts, layer->count);
    *layer = (tn_projected_layer){0};
}

static tn_status add(tn_projected_layer *layer, uint32_t plan, uint32_t set, const mpz_t count, tn_error *error)
{
    uint32_t at = tn_number(&layer->nodes, (uint64_t)plan << 32 | set);
    if (at == UINT32_MAX || !tn_array_reserve(&layer->counts, &layer->room, layer->count, 1, sizeof *layer->counts))
        return tn_fail_memory(error);
    if (at == layer->count)
        mpz_init(layer->counts[layer->count++]);
    mpz_add(layer->counts[at], layer->counts[at], count);
    return TN_OK;
}

/* A walk from layer to layer: `next` are the nodes after the one at hand, which so many lead to. */
typedef struct tn_projected_walk tn_projected_walk;
struct tn_projected_walk {
    tn_projecting *projecting;
    uint32_t layer, plan, set; /* of the node; set: or tuple of sets */
    mpz_ptr count;
    tn_projected_layer at, next;
    void (*end)(const tn_projected_walk *walk); /* the row may end at the node */
    tn_status (*begin)(tn_projected_walk *walk, tn_error *error);
    tn_status (*take)(tn_projected_walk *walk, tn_tray tray, uint32_t plan, tn_error *error);
    void *context;
};

static tn_status walk_begin(tn_projected_walk *w, uint32_t set, tn_error *error)
{
    mpz_t one;
    mpz_init_set_ui(one, 1);
    tn_status status = add(&w->at, 0, set, one, error);
    mpz_clear(one);
    return status;
}

static tn_status walk_node(tn_projected_walk *w, uint32_t i, tn_error *error)
{
    const tn_houses *h = w->projecting->houses;
    w->plan = tn_high(w->at.nodes.keys[i]);
    w->set = tn_low(w->at.nodes.keys[i]);
    w->count = w->at.counts[i];
    w->end(w);
    if (w->layer == h->high)
        return TN_OK;
    tn_status status = w->begin(w, error);
    for (tn_tray t = 0; status == TN_OK && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        tn_house_gain gain;
        status = tn_houses_plan_next(h, w->layer, w->plan, t, &next, &gain, error);
        if (status == TN_OK && next != TN_FRONTIER_NONE)
            status = w->take(w, t, next, error);
    }
    return status;
}

/* From the node that it began with, to the end of all rows. */
static tn_status walk(tn_projected_walk *w, tn_error *error)
{
    tn_status status = TN_OK;
    for (w->layer = 0; status == TN_OK && w->layer <= w->projecting->houses->high; w->layer++) {
        for (uint32_t i = 0; status == TN_OK && i < w->at.nodes.count; i++)
            status = walk_node(w, i, error);
        clear_layer(&w->at);
        w->at = w->next;
        w->next = (tn_projected_layer){0};
    }
    clear_layer(&w->at);
    return status;
}

/* Goes on from a node of a layer of states: over the half steps, to where trays are taken. */
static tn_status begin_step(tn_projected_ways *g, uint32_t set, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 1; status == TN_OK && i < g->of->stages; i++)
        status = go_on(g->projecting, g->of, &set, error);
    return status == TN_OK ? gather(g, set, error) : status;
}

/* ---- functions */

typedef struct tn_project_functions {
    tn_projected_ways going;
    mpz_ptr functions;
} tn_project_functions;

static void end_functions(const tn_projected_walk *w)
{
    const tn_project_functions *f = w->context;
    if (ends(f->going.of, w->set))
        mpz_addmul_ui(f->functions, w->count, f->going.of->kind->sections);
}

static tn_status begin_functions(tn_projected_walk *w, tn_error *error)
{
    tn_project_functions *f = w->context;
    return begin_step(&f->going, w->set, error);
}

static tn_status take_functions(tn_projected_walk *w, tn_tray tray, uint32_t plan, tn_error *error)
{
    tn_projected_ways *g = &((tn_project_functions *)w->context)->going;
    const tn_frontier_furnished_list *list = &g->of->kind->frontier->slices.furnished[tray];
    tn_status status = spend(g->projecting, list->count, error);
    aim(g, plan);
    for (size_t i = 0; status == TN_OK && i < list->count;) {
        uint32_t set, functions = list->items[i].functions;
        g->projecting->key.size = 0;
        for (; i < list->count && list->items[i].functions == functions; i++)
            if (!push_after(g, list->items[i].slice))
                return tn_fail_memory(error);
        if (g->projecting->key.size == 0)
            continue;
        status = number_set(g->projecting, g->of, &set, error);
        if (status == TN_OK)
            status = add(&w->next, plan, set, w->count, error);
    }
    return status;
}

/* functions += those of one section, on all plans, that have a house. */
static tn_status project_functions(tn_projecting *p, tn_projected_kind *of, mpz_t functions, tn_error *error)
{
    tn_project_functions f = {.going = {.projecting = p, .of = of}, .functions = functions};
    tn_projected_walk w = {
        .projecting = p, .end = end_functions, .begin = begin_functions, .take = take_functions, .context = &f};
    tn_status status = of->first ? walk_begin(&w, of->first, error) : TN_OK;
    if (status == TN_OK)
        status = walk(&w, error);
    clear_layer(&w.at);
    clear_layer(&w.next);
    free(f.going.on);
    return status;
}

/* ---- plans, with the sections of each */

/* A plan leads to a set of each kind of section: together they are a tuple. */
typedef struct tn_project_plans {
    tn_projecting *projecting;
    tn_projected_ways *going; /* [kinds] */
    tn_interner tuples;
    uint32_t *tuple; /* [kinds] scratch */
    tn_houses_projected *counts;
} tn_project_plans;

static void end_plans(const tn_projected_walk *w)
{
    const tn_project_plans *f = w->context;
    const tn_projecting *p = f->projecting;
    uint64_t sections = 0;
    size_t size;
    const uint32_t *sets = tn_interned(&f->tuples, w->set, &size);
    for (size_t k = 0; k < p->houses->kind_count; k++)
        sections += ends(&p->kinds[k], sets[k]) ? p->kinds[k].kind->sections : 0;
    if (sections > 0)
        mpz_add(f->counts->plans, f->counts->plans, w->count);
    mpz_addmul_ui(f->counts->sections, w->count, sections);
}

static tn_status begin_trays(tn_projected_walk *w, tn_error *error)
{
    tn_project_plans *f = w->context;
    tn_status status = TN_OK;
    size_t size;
    for (size_t k = 0; status == TN_OK && k < f->projecting->houses->kind_count; k++)
        status = begin_step(&f->going[k], tn_interned(&f->tuples, w->set, &size)[k], error);
    return status;
}

/* *set: where the tray leads in one kind of section. */
static tn_status take_in_kind(tn_projected_ways *g, tn_tray tray, uint32_t plan, uint32_t *set, tn_error *error)
{
    const tn_frontier_list *list = &g->of->kind->frontier->slices.of_tray[tray];
    g->projecting->key.size = 0;
    *set = 0;
    if (g->count == 0)
        return TN_OK;
    aim(g, plan);
    for (size_t i = 0; i < list->count; i++)
        if (!push_after(g, list->items[i].slice))
            return tn_fail_memory(error);
    tn_status status = spend(g->projecting, list->count, error);
    return status == TN_OK ? number_set(g->projecting, g->of, set, error) : status;
}

static tn_status take_tray(tn_projected_walk *w, tn_tray tray, uint32_t plan, tn_error *error)
{
    tn_project_plans *f = w->context;
    size_t kinds = f->projecting->houses->kind_count;
    bool any = false;
    tn_status status = TN_OK;
    for (size_t k = 0; status == TN_OK && k < kinds; k++) {
        status = take_in_kind(&f->going[k], tray, plan, &f->tuple[k], error);
        any = any || f->tuple[k] != 0;
    }
    if (status != TN_OK || !any)
        return status;
    uint32_t tuple = tn_intern(&f->tuples, f->tuple, kinds);
    return tuple == UINT32_MAX ? tn_fail_memory(error) : add(&w->next, plan, tuple, w->count, error);
}

static tn_status begin_plans(tn_project_plans *f, tn_projected_walk *w, tn_error *error)
{
    tn_projecting *p = f->projecting;
    size_t kinds = p->houses->kind_count;
    f->going = calloc(kinds + 1, sizeof *f->going);
    f->tuple = malloc((kinds + 1) * sizeof *f->tuple);
    if (!f->going || !f->tuple)
        return tn_fail_memory(error);
    for (size_t k = 0; k < kinds; k++) {
        f->going[k] = (tn_projected_ways){.projecting = p, .of = &p->kinds[k]};
        f->tuple[k] = p->kinds[k].first;
    }
    uint32_t tuple = tn_intern(&f->tuples, f->tuple, kinds);
    return tuple == UINT32_MAX ? tn_fail_memory(error) : walk_begin(w, tuple, error);
}

static tn_status project_plans(tn_projecting *p, tn_houses_projected *counts, tn_error *error)
{
    tn_project_plans f = {.projecting = p, .counts = counts};
    tn_projected_walk w = {.projecting = p, .end = end_plans, .begin = begin_trays, .take = take_tray, .context = &f};
    tn_status status = begin_plans(&f, &w, error);
    if (status == TN_OK)
        status = walk(&w, error);
    for (size_t k = 0; f.going && k < p->houses->kind_count; k++)
        free(f.going[k].on);
    free(f.going);
    free(f.tuple);
    tn_interner_clear(&f.tuples);
    clear_layer(&w.at);
    clear_layer(&w.next);
    return status;
}

/* ---- all */

static tn_status begin_kind(tn_projecting *p, size_t k, tn_error *error)
{
    tn_projected_kind *of = &p->kinds[k];
    of->kind = &p->houses->kinds[k];
    of->stages = tn_houses_stages(p->houses, of->kind);
    of->slots = malloc(((size_t)of->kind->frontier->slices.keys.count + 1) * sizeof *of->slots);
    of->stamps = calloc((size_t)of->kind->frontier->slices.keys.count + 1, sizeof *of->stamps);
    return of->slots && of->stamps ? begin_sets(p, of, error) : tn_fail_memory(error);
}

static void end_kind(tn_projected_kind *of)
{
    tn_interner_clear(&of->classes);
    tn_interner_clear(&of->sets);
    free(of->slots);
    free(of->stamps);
}

void tn_houses_projected_init(tn_houses_projected *counts)
{
    mpz_inits(counts->plans, counts->sections, counts->functions, NULL);
}

void tn_houses_projected_clear(tn_houses_projected *counts)
{
    mpz_clears(counts->plans, counts->sections, counts->functions, NULL);
}

tn_status tn_houses_project(tn_houses *h, tn_houses_projected *counts, tn_error *error)
{
    tn_projecting p = {.houses = h, .kinds = calloc(h->kind_count + 1, sizeof *p.kinds)};
    tn_status status = p.kinds ? TN_OK : tn_fail_memory(error);
    for (size_t k = 0; status == TN_OK && k < h->kind_count; k++)
        status = begin_kind(&p, k, error);
    for (size_t k = 0; status == TN_OK && k < h->kind_count; k++)
        status = project_functions(&p, &p.kinds[k], counts->functions, error);
    if (status == TN_OK)
        status = project_plans(&p, counts, error);
    for (size_t k = 0; p.kinds && k < h->kind_count; k++)
        end_kind(&p.kinds[k]);
    free(p.kinds);
    free(p.key.data);
    return status;
}
