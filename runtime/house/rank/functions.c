/* Functions of a house of a number, tray by tray: houses that go on by slices with functions from where they can come.
 *
 * Where a step has stages, that is from the arrivals of the slice's group; else from the states before the tray. */
#include <stdlib.h>

#include "runtime/base/integers.h"
#include "runtime/house/rank/path.h"

/* ---- where a tray is come to */

/* The nodes of a layer, and how many choices lead there. */
typedef struct tn_coming {
    tn_plan_path *path;
    uint32_t tray, layer;
    mpz_t *here;     /* [nodes] */
    uint32_t *order; /* [nodes]: by group, where they are arrivals */
    mpz_t one;
} tn_coming;

static const tn_numbering *nodes_of(const tn_coming *c)
{
    return &c->path->kind.layers[c->layer].nodes;
}

static uint32_t node_of(const tn_coming *c, uint32_t i)
{
    return (uint32_t)nodes_of(c)->keys[c->order[i]];
}

/* The group that a node leads into; 0 where it leads into all. */
static uint32_t group_of(const tn_coming *c, uint32_t i)
{
    return c->path->stages > 1 ? tn_strip_arrival_group(c->path->kind.strip, node_of(c, i)) : 0;
}

typedef struct tn_pushing {
    const tn_numbering *to;
    mpz_t *from, *next;
    mpz_t one;
} tn_pushing;

static tn_status push(void *context, const tn_houses_edge *edge, tn_error *error)
{
    tn_pushing *p = context;
    uint32_t at = tn_number_find(p->to, (uint64_t)edge->plan << 32 | edge->state);
    (void)error;
    mpz_mul_ui(p->one, p->from[edge->from], edge->ways);
    mpz_addmul_ui(p->next[at], p->one, edge->times);
    return TN_OK;
}

/* Goes on to the next layer. */
static tn_status push_on(tn_coming *c, tn_error *error)
{
    tn_houses_kind *kind = &c->path->kind;
    tn_pushing p = {.to = &kind->layers[c->layer + 1].nodes, .from = c->here};
    p.next = tn_integers_new(p.to->count);
    if (!p.next)
        return tn_fail_memory(error);
    mpz_init(p.one);
    tn_status status = tn_houses_expand_from(&c->path->view, kind, c->layer, c->here, push, &p, error);
    mpz_clear(p.one);
    tn_integers_free(c->here, nodes_of(c)->count);
    c->here = p.next;
    c->layer++;
    return status;
}

typedef struct tn_grouped {
    uint32_t group, node;
} tn_grouped;

static int compare_grouped(const void *a, const void *b)
{
    const tn_grouped *p = a, *q = b;
    return p->group != q->group ? (p->group > q->group) - (p->group < q->group)
                                : (p->node > q->node) - (p->node < q->node);
}

static tn_status order_nodes(tn_coming *c, tn_error *error)
{
    uint32_t count = nodes_of(c)->count;
    tn_grouped *grouped = malloc(((size_t)count + 1) * sizeof *grouped);
    c->order = malloc(((size_t)count + 1) * sizeof *c->order);
    if (!grouped || !c->order) {
        free(grouped);
        return tn_fail_memory(error);
    }
    for (uint32_t i = 0; i < count; i++)
        c->order[i] = i;
    for (uint32_t i = 0; i < count; i++)
        grouped[i] = (tn_grouped){group_of(c, i), i};
    if (count > 0)
        qsort(grouped, count, sizeof *grouped, compare_grouped);
    for (uint32_t i = 0; i < count; i++)
        c->order[i] = grouped[i].node;
    free(grouped);
    return TN_OK;
}

static tn_status begin_tray(tn_coming *c, tn_plan_path *path, uint32_t tray, tn_error *error)
{
    *c = (tn_coming){.path = path, .tray = tray, .layer = tray * path->stages};
    mpz_init(c->one);
    uint32_t count = nodes_of(c)->count;
    c->here = tn_integers_new(count);
    if (!c->here)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        mpz_set(c->here[i], path->states[tray].here[i]);
    tn_status status = TN_OK;
    while (status == TN_OK && c->layer + 1 < (tray + 1) * path->stages)
        status = push_on(c, error);
    return status == TN_OK ? order_nodes(c, error) : status;
}

static void end_tray(tn_coming *c)
{
    tn_integers_free(c->here, nodes_of(c)->count);
    free(c->order);
    mpz_clear(c->one);
}

/* ---- by a slice */

/* The nodes [*first, *end), in order, from which the slice can follow. */
static void find_nodes(const tn_coming *c, uint32_t slice, uint32_t *first, uint32_t *end)
{
    uint32_t group = c->path->stages > 1 ? c->path->kind.strip->slices[slice].group : 0, low = 0,
             high = nodes_of(c)->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (group_of(c, middle) < group)
            low = middle + 1;
        else
            high = middle;
    }
    *first = *end = low;
    while (*end < nodes_of(c)->count && group_of(c, *end) == group)
        ++*end;
}

static tn_status go_by(const tn_coming *c, uint32_t i, uint32_t slice, tn_strip_seen *seen, void *context,
                       tn_error *error)
{
    tn_strip *strip = c->path->kind.strip;
    return c->path->stages > 1 ? tn_strip_arrive(strip, node_of(c, i), slice, seen, context, error)
                               : tn_path_step(c->path, c->tray, node_of(c, i), slice, NULL, seen, context, error);
}

/* houses += those that have this slice in this place, with the functions so far. */
static tn_status add_slice(const tn_coming *c, const tn_strip_functioned *slice, mpz_t houses, tn_error *error)
{
    const tn_plan_path *path = c->path;
    tn_path_sum sum = {.path = path, .trays = c->tray + 1, .ahead = tn_path_layer(path, c->tray + 1)->ahead};
    uint32_t first, end;
    tn_status status = TN_OK;
    mpz_init(sum.houses);
    find_nodes(c, slice->slice, &first, &end);
    for (uint32_t i = first; status == TN_OK && i < end; i++) {
        mpz_ptr here = c->here[c->order[i]];
        if (mpz_sgn(here) == 0)
            continue;
        mpz_set_ui(sum.houses, 0);
        status = go_by(c, i, slice->slice, tn_path_add, &sum, error);
        mpz_mul(sum.houses, sum.houses, here);
        mpz_addmul_ui(houses, sum.houses, slice->times);
    }
    mpz_clear(sum.houses);
    return status;
}

/* What leads on: to states after the tray, by so many choices. */
typedef struct tn_leading {
    const tn_plan_path *path;
    uint32_t trays;
    mpz_ptr choices;
} tn_leading;

static tn_status lead_to(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                         tn_error *error)
{
    const tn_leading *l = context;
    uint32_t at = tn_path_node(l->path, l->trays, state);
    (void)faced;
    (void)gain;
    (void)error;
    if (at != UINT32_MAX)
        mpz_addmul_ui(l->path->states[l->trays].here[at], l->choices, times);
    return TN_OK;
}

static tn_status take_slice(tn_coming *c, const tn_strip_choice *slice, tn_error *error)
{
    tn_leading l = {c->path, c->tray + 1, c->one};
    uint32_t first, end;
    tn_status status = TN_OK;
    find_nodes(c, slice->slice, &first, &end);
    for (uint32_t i = first; status == TN_OK && i < end; i++) {
        mpz_mul_ui(c->one, c->here[c->order[i]], slice->times);
        if (mpz_sgn(c->one) != 0)
            status = go_by(c, i, slice->slice, lead_to, &l, error);
    }
    return status;
}

/* ---- functions */

/* The slices of a tray, by functions in order. */
typedef struct tn_functioned {
    const tn_strip_functioned *items;
    size_t count;
} tn_functioned;

static bool has_functions(const tn_strip_functioned *slice, const tn_house *house, uint32_t tray)
{
    bool same = house != NULL;
    for (size_t i = 0; same && i < slice->cells; i++)
        same = house->cells[house->tray_first[tray] + i].function == slice->functions[i];
    return same;
}

/* The slices [*first, *end) have the functions of the house. *found: does one? */
static tn_status choose(const tn_coming *c, const tn_choosing *choosing, const tn_functioned *slices, size_t *first,
                        size_t *end, bool *found, tn_error *error)
{
    mpz_t houses;
    mpz_init(houses);
    tn_status status = TN_OK;
    *found = false;
    for (*first = *end = 0; status == TN_OK && !*found && *end < slices->count;) {
        *first = *end;
        mpz_set_ui(houses, 0);
        for (; status == TN_OK && *end < slices->count &&
               tn_strip_functioned_compare(&slices->items[*first], &slices->items[*end]) == 0;
             ++*end)
            status = add_slice(c, &slices->items[*end], houses, error);
        *found =
            status == TN_OK &&
            !tn_choosing_passes(choosing, houses, has_functions(&slices->items[*first], choosing->wanted, c->tray));
    }
    mpz_clear(houses);
    return status;
}

/* The tray has the functions of these slices. */
static tn_status take(tn_coming *c, const tn_strip_functioned *slices, size_t count, tn_house *house,
                      tn_path_slices *taken, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < slices->cells; i++)
        house->cells[house->tray_first[c->tray] + i].function = slices->functions[i];
    taken->items = malloc((count + 1) * sizeof *taken->items);
    if (!taken->items)
        return tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        taken->items[taken->count++] = (tn_strip_choice){slices[i].slice, slices[i].times};
        status = take_slice(c, &taken->items[i], error);
    }
    return status;
}

static tn_status choose_tray(tn_coming *c, const tn_choosing *choosing, tn_house *house, tn_path_slices *taken,
                             bool *found, tn_error *error)
{
    tn_functioned slices = {0};
    size_t first = 0, end = 0;
    tn_strip_functioned *items = tn_strip_functioned_of(c->path->kind.strip, house->trays[c->tray], &slices.count);
    slices.items = items;
    tn_status status = items ? choose(c, choosing, &slices, &first, &end, found, error) : tn_fail_memory(error);
    if (status == TN_OK && *found)
        status = take(c, items + first, end - first, house, taken, error);
    free(items);
    return status;
}

static void begin(tn_plan_path *path)
{
    for (uint32_t layer = 0; layer <= path->length; layer++)
        for (uint32_t i = 0; i < tn_path_layer(path, layer)->nodes.count; i++)
            mpz_set_ui(path->states[layer].here[i], 0);
    mpz_set_ui(path->states[0].here[0], 1);
}

tn_status tn_path_functions(tn_plan_path *path, const tn_choosing *choosing, tn_house *house, tn_path_slices *of_tray,
                            bool *found, tn_error *error)
{
    tn_status status = TN_OK;
    *found = true;
    begin(path);
    for (uint32_t i = 0; status == TN_OK && *found && i < path->length; i++) {
        tn_coming c;
        status = begin_tray(&c, path, i, error);
        if (status == TN_OK)
            status = choose_tray(&c, choosing, house, &of_tray[i], found, error);
        end_tray(&c);
    }
    return status;
}
