/* How many plans have a house, and how many of their sections and functions: the automaton of houses is projected to
 * trays, or to trays with functions, and made deterministic by the subset construction.
 *
 * Nodes from which houses go on alike are one class (projected_classes.c). Sets of classes are followed from the
 * beginning, with the number of plans, or of plans with functions, that lead to each. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/count/projected.h"

/* ---- sets of classes */

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
    return tn_projecting_spend(p, key->size, error);
}

/* of->first := the set of the node before the first tray. */
static tn_status begin_sets(tn_projecting *p, tn_projected_kind *of, tn_error *error)
{
    uint32_t class;
    tn_status status = tn_projected_classes(p, of, &class, error);
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

/* set := the set of all that its classes go on to, where they do so without a slice. */
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
        qsort(g->on, g->count, sizeof *g->on, tn_way_on_compare);
    return tn_projecting_spend(g->projecting, g->count, error);
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
    tn_status status = tn_projecting_spend(g->projecting, list->count, error);
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
    tn_status status = tn_projecting_spend(g->projecting, list->count, error);
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
