/* How many plans have a house, and how many of their sections and functions: the automaton of houses is projected to
 * trays, or to trays with functions, and made deterministic by the subset construction.
 *
 * First nodes from which houses go on alike become one class, layer by layer from the end: what a class is made of is
 * the slices by which it goes on, each with the plan state and the class behind it. How many choices lead there does
 * not matter. Then sets of classes are followed from the beginning, with the number of plans, or of plans with
 * functions, that lead to each. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"

enum { WORK_MOST = 1 << 30, STEPS_MOST = 1 << 24, DEAD = 0 }; /* steps: of one layer, half a gigabyte */

/* Words of a class: may the row end there; then the way on. From one tray to the next, if a step has stages, there are
 * classes that go on without a slice: a word for each. */
enum { CLASS_ENDS, CLASS_ON };
enum { ON_PLAN, ON_SLICE, ON_CLASS, ON_WORDS };

/* One kind of section. */
typedef struct tn_projected_kind {
    tn_houses_kind *kind;
    uint32_t stages;
    tn_interner classes; /* DEAD: nothing goes on from there */
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
    tn_key key;
} tn_projecting;

static tn_status spend(tn_projecting *p, uint64_t work, tn_error *error)
{
    p->work += work;
    if (p->work <= WORK_MOST)
        return tn_watch_check(p->houses->form->module->watch, error);
    return tn_fail(error, TN_LIMIT, E_STRIP, "finding how many plans have a house takes more than %d steps", WORK_MOST);
}

static int compare_words(const void *a, const void *b)
{
    uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
    return (p > q) - (p < q);
}

/* ---- classes */

/* A way on from a node. Where no slice is taken, plan and slice are 0. */
typedef struct tn_way_on {
    uint32_t words[ON_WORDS];
} tn_way_on;

static int compare_on(const void *a, const void *b)
{
    const tn_way_on *p = a, *q = b;
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
    const uint32_t *behind; /* [nodes of the next layer]: classes */
    tn_kept_step *steps;    /* those that are not kept */
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
        c->first[steps[i].from + 2] += c->behind[steps[i].to] != DEAD;
    for (uint32_t i = 2; i < layer->nodes.count + 2; i++)
        c->first[i] += c->first[i - 1];
    for (size_t i = 0; i < count; i++) {
        uint32_t class = c->behind[steps[i].to];
        uint32_t plan = c->takes_slice ? tn_high(layer[1].nodes.keys[steps[i].to]) : 0;
        if (class != DEAD)
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
        qsort(on, count, sizeof *on, compare_on);
    if (count > 0 || c->ends[node])
        ok = tn_key_push(key, c->ends[node]);
    for (size_t i = 0; ok && i < count; i++)
        if (i == 0 || compare_on(&on[i - 1], &on[i]) != 0)
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
static tn_status class_layer(tn_projecting *p, tn_projected_kind *of, uint32_t layer, const uint32_t *behind,
                             uint32_t **classes, tn_error *error)
{
    uint32_t nodes = of->kind->layers[layer].nodes.count;
    tn_classing c = {.projecting = p, .of = of, .layer = layer, .behind = behind};
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

/* ---- sets of classes */

/* The number of the set of the classes in p->key, which are sorted; each is taken once. */
static tn_status number_set(tn_projecting *p, tn_projected_kind *of, uint32_t *set, tn_error *error)
{
    tn_key *key = &p->key;
    size_t kept = 0;
    if (key->size > 0)
        qsort(key->data, key->size, sizeof *key->data, compare_words);
    for (size_t i = 0; i < key->size; i++)
        if (kept == 0 || key->data[i] != key->data[kept - 1])
            key->data[kept++] = key->data[i];
    *set = tn_intern(&of->sets, key->data, kept);
    if (*set == UINT32_MAX)
        return tn_fail_memory(error);
    return spend(p, key->size, error);
}

static tn_status class_kind(tn_projecting *p, tn_projected_kind *of, tn_error *error)
{
    uint32_t *classes = NULL, *behind = NULL;
    tn_status status = TN_OK;
    p->key.size = 0;
    if (tn_intern(&of->classes, NULL, 0) != DEAD || tn_intern(&of->sets, NULL, 0) == UINT32_MAX)
        return tn_fail_memory(error);
    for (uint32_t k = p->houses->high * of->stages + 1; status == TN_OK && k-- > 0;) {
        status = class_layer(p, of, k, behind, &classes, error);
        free(behind);
        behind = classes;
    }
    p->key.size = 0;
    if (status == TN_OK && behind[0] != DEAD && !tn_key_push(&p->key, behind[0]))
        status = tn_fail_memory(error);
    free(behind);
    return status == TN_OK ? number_set(p, of, &of->first, error) : status;
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
        qsort(g->on, g->count, sizeof *g->on, compare_on);
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

/* Adds the classes behind a slice to those of the key. */
static bool push_behind(const tn_projected_ways *g, uint32_t slice)
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
    uint32_t layer, plan;
    mpz_ptr count;
    tn_projected_layer *next;
} tn_project_functions;

static tn_status take_functions(tn_project_functions *f, tn_tray tray, uint32_t plan, tn_error *error)
{
    tn_projected_ways *g = &f->going;
    const tn_strip_furnished_list *list = &g->of->kind->strip->furnished[tray];
    tn_status status = spend(g->projecting, list->count, error);
    aim(g, plan);
    for (size_t i = 0; status == TN_OK && i < list->count;) {
        uint32_t set, functions = list->items[i].functions;
        g->projecting->key.size = 0;
        for (; i < list->count && list->items[i].functions == functions; i++)
            if (!push_behind(g, list->items[i].slice))
                return tn_fail_memory(error);
        if (g->projecting->key.size == 0)
            continue;
        status = number_set(g->projecting, g->of, &set, error);
        if (status == TN_OK)
            status = add(f->next, plan, set, f->count, error);
    }
    return status;
}

static tn_status functions_of_node(tn_project_functions *f, uint32_t set, tn_error *error)
{
    const tn_houses *h = f->going.projecting->houses;
    tn_status status = begin_step(&f->going, set, error);
    for (tn_tray t = 0; status == TN_OK && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        tn_house_gain gain;
        status = tn_houses_plan_next(h, f->layer, f->plan, t, &next, &gain, error);
        if (status == TN_OK && next != TN_STRIP_NONE)
            status = take_functions(f, t, next, error);
    }
    return status;
}

/* functions += those of one section, on all plans, that have a house. */
static tn_status project_functions(tn_projecting *p, tn_projected_kind *of, mpz_t functions, tn_error *error)
{
    tn_projected_layer layer = {0}, next = {0};
    tn_project_functions f = {.going = {.projecting = p, .of = of}, .next = &next};
    mpz_t one;
    mpz_init_set_ui(one, 1);
    tn_status status = of->first ? add(&layer, 0, of->first, one, error) : TN_OK;
    mpz_clear(one);
    for (f.layer = 0; status == TN_OK && f.layer <= p->houses->high; f.layer++) {
        for (uint32_t i = 0; status == TN_OK && i < layer.nodes.count; i++) {
            uint32_t set = tn_low(layer.nodes.keys[i]);
            f.plan = tn_high(layer.nodes.keys[i]);
            f.count = layer.counts[i];
            if (ends(of, set))
                mpz_addmul_ui(functions, f.count, of->kind->sections);
            if (f.layer < p->houses->high)
                status = functions_of_node(&f, set, error);
        }
        clear_layer(&layer);
        layer = next;
        next = (tn_projected_layer){0};
    }
    clear_layer(&layer);
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
    uint32_t layer, plan;
    mpz_ptr count;
    tn_projected_layer *next;
} tn_project_plans;

static tn_status take_tray(tn_project_plans *f, tn_tray tray, uint32_t plan, tn_error *error)
{
    const tn_houses *h = f->projecting->houses;
    bool any = false;
    tn_status status = TN_OK;
    for (size_t k = 0; status == TN_OK && k < h->kind_count; k++) {
        tn_projected_ways *g = &f->going[k];
        const tn_strip_list *list = &g->of->kind->strip->of_tray[tray];
        f->projecting->key.size = 0;
        f->tuple[k] = 0;
        if (g->count == 0)
            continue;
        aim(g, plan);
        for (size_t i = 0; i < list->count; i++)
            if (!push_behind(g, list->items[i].slice))
                return tn_fail_memory(error);
        status = spend(f->projecting, list->count, error);
        if (status == TN_OK)
            status = number_set(f->projecting, g->of, &f->tuple[k], error);
        any = any || f->tuple[k] != 0;
    }
    if (status != TN_OK || !any)
        return status;
    uint32_t tuple = tn_intern(&f->tuples, f->tuple, h->kind_count);
    return tuple == UINT32_MAX ? tn_fail_memory(error) : add(f->next, plan, tuple, f->count, error);
}

static tn_status trays_of_node(tn_project_plans *f, uint32_t tuple, tn_error *error)
{
    const tn_houses *h = f->projecting->houses;
    tn_status status = TN_OK;
    size_t size;
    for (size_t k = 0; status == TN_OK && k < h->kind_count; k++)
        status = begin_step(&f->going[k], tn_interned(&f->tuples, tuple, &size)[k], error);
    for (tn_tray t = 0; status == TN_OK && t < h->form->schema->tray_count; t++) {
        uint32_t next;
        tn_house_gain gain;
        status = tn_houses_plan_next(h, f->layer, f->plan, t, &next, &gain, error);
        if (status == TN_OK && next != TN_STRIP_NONE)
            status = take_tray(f, t, next, error);
    }
    return status;
}

static void count_ends(const tn_project_plans *f, uint32_t tuple, tn_houses_projected *counts)
{
    const tn_projecting *p = f->projecting;
    unsigned long sections = 0;
    size_t size;
    const uint32_t *sets = tn_interned(&f->tuples, tuple, &size);
    for (size_t k = 0; k < p->houses->kind_count; k++)
        sections += ends(&p->kinds[k], sets[k]) ? p->kinds[k].kind->sections : 0;
    if (sections > 0)
        mpz_add(counts->plans, counts->plans, f->count);
    mpz_addmul_ui(counts->sections, f->count, sections);
}

static tn_status begin_plans(tn_project_plans *f, tn_projected_layer *first, tn_error *error)
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
    mpz_t one;
    mpz_init_set_ui(one, 1);
    tn_status status = tuple == UINT32_MAX ? tn_fail_memory(error) : add(first, 0, tuple, one, error);
    mpz_clear(one);
    return status;
}

static void end_plans(tn_project_plans *f)
{
    for (size_t k = 0; f->going && k < f->projecting->houses->kind_count; k++)
        free(f->going[k].on);
    free(f->going);
    free(f->tuple);
    tn_interner_clear(&f->tuples);
}

static tn_status project_plans(tn_projecting *p, tn_houses_projected *counts, tn_error *error)
{
    tn_projected_layer layer = {0}, next = {0};
    tn_project_plans f = {.projecting = p, .next = &next};
    tn_status status = begin_plans(&f, &layer, error);
    for (f.layer = 0; status == TN_OK && f.layer <= p->houses->high; f.layer++) {
        for (uint32_t i = 0; status == TN_OK && i < layer.nodes.count; i++) {
            uint32_t tuple = tn_low(layer.nodes.keys[i]);
            f.plan = tn_high(layer.nodes.keys[i]);
            f.count = layer.counts[i];
            count_ends(&f, tuple, counts);
            if (f.layer < p->houses->high)
                status = trays_of_node(&f, tuple, error);
        }
        clear_layer(&layer);
        layer = next;
        next = (tn_projected_layer){0};
    }
    clear_layer(&layer);
    end_plans(&f);
    return status;
}

/* ---- all */

static tn_status begin_kind(tn_projecting *p, size_t k, tn_error *error)
{
    tn_projected_kind *of = &p->kinds[k];
    of->kind = &p->houses->kinds[k];
    of->stages = tn_houses_stages(p->houses, of->kind);
    of->slots = malloc(((size_t)of->kind->strip->slice_keys.count + 1) * sizeof *of->slots);
    of->stamps = calloc((size_t)of->kind->strip->slice_keys.count + 1, sizeof *of->stamps);
    return of->slots && of->stamps ? class_kind(p, of, error) : tn_fail_memory(error);
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
