/* Functions of a house of a number, tray by tray: houses that go on by slices with functions from where they can come.
 *
 * If a step has stages, that is from the slice states of the slice's group; else from the states before the tray. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/rank/path.h"

/* ---- where a tray is come to */

/* The nodes of a layer, and how many choices lead there. */
typedef struct tn_coming {
    tn_plan_path *path;
    uint32_t tray, layer, beginning; /* beginning: the functions so far, of those that are kept */
    mpz_t *here;                     /* [nodes] */
    uint32_t *order;                 /* [nodes]: by group, if they are slice states */
    mpz_t one, unkept;
} tn_coming;

static const tn_numbering *nodes_of(const tn_coming *c)
{
    return &c->path->kind.layers[c->layer].nodes;
}

static uint32_t node_of(const tn_coming *c, uint32_t i)
{
    return (uint32_t)nodes_of(c)->keys[c->order[i]];
}

/* The group that a node leads into; 0 if it leads into all. */
static uint32_t group_of(const tn_coming *c, uint32_t i)
{
    return c->path->stages > 1 ? tn_frontier_slice_state_group(c->path->kind.frontier, node_of(c, i)) : 0;
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
    mpz_inits(c->one, c->unkept, NULL);
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
    mpz_clears(c->one, c->unkept, NULL);
}

/* ---- by a slice */

/* The nodes [*first, *end), in order, from which the slice can follow. */
static void find_nodes(const tn_coming *c, uint32_t slice, uint32_t *first, uint32_t *end)
{
    uint32_t group = c->path->stages > 1 ? c->path->kind.frontier->slices.items[slice].group : 0, low = 0,
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

static tn_status go_by(const tn_coming *c, uint32_t i, uint32_t slice, tn_frontier_seen *seen, void *context,
                       tn_error *error)
{
    tn_frontier *frontier = c->path->kind.frontier;
    return c->path->stages > 1 ? tn_frontier_stage_pass(frontier, node_of(c, i), slice, seen, context, error)
                               : tn_path_step(c->path, c->tray, node_of(c, i), slice, NULL, seen, context, error);
}

/* houses += those that have this slice in this place, with the functions so far. */
static tn_status add_slice(const tn_coming *c, const tn_frontier_furnished *slice, mpz_t houses, tn_error *error)
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

static tn_status take_slice(tn_coming *c, const tn_frontier_choice *slice, tn_error *error)
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

/* The slices of a tray [first, end), by functions in order, have the same ones. */
static size_t end_of(const tn_frontier_furnished_list *slices, size_t first)
{
    size_t end = first;
    while (end < slices->count && slices->items[end].functions == slices->items[first].functions)
        end++;
    return end;
}

static bool has_functions(const tn_coming *c, uint32_t number, const tn_house *house)
{
    size_t cells;
    const uint32_t *functions = tn_interned(&c->path->kind.frontier->slices.functions, number, &cells);
    bool same = house != NULL;
    for (size_t i = 0; same && i < cells; i++)
        same = house->cells[house->tray_first[c->tray] + i].function == functions[i];
    return same;
}

static bool is_typed(const tn_coming *c, uint32_t number, const tn_house *house, const tn_path_typed *typed)
{
    size_t cells;
    return tn_path_typed_functions(typed, house, c->tray,
                                   tn_interned(&c->path->kind.frontier->slices.functions, number, &cells));
}

/* houses := those with these slices in this place, and the functions so far. */
static tn_status count_houses(const tn_coming *c, const tn_frontier_furnished *slices, size_t count, mpz_t houses,
                              tn_error *error)
{
    tn_status status = TN_OK;
    mpz_set_ui(houses, 0);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = add_slice(c, &slices[i], houses, error);
    return status;
}

enum { NUMBERS_MOST = 1 << 16 }; /* of all beginnings together */

/* The same, found once: they are the `at`th of what the tray can be with the functions so far. Good until the next. */
static tn_status find_houses(tn_coming *c, size_t at, const tn_frontier_furnished *slices, size_t count,
                             mpz_ptr *houses, tn_error *error)
{
    tn_plan_path *path = c->path;
    tn_path_numbers *numbers = &path->by_functions[c->beginning];
    if (at < numbers->count) {
        *houses = numbers->items[at];
        return TN_OK;
    }
    *houses = c->unkept;
    tn_status status = count_houses(c, slices, count, c->unkept, error);
    if (status != TN_OK || at > numbers->count || path->number_count > NUMBERS_MOST)
        return status;
    if (!tn_array_reserve_from(&numbers->items, &numbers->room, 4, at, 1, sizeof *numbers->items))
        return tn_fail_memory(error);
    mpz_init_set(numbers->items[numbers->count++], c->unkept);
    path->number_count++;
    return TN_OK;
}

/* The tray has the functions of these slices. */
static tn_status take(tn_coming *c, const tn_frontier_furnished *slices, size_t count, tn_house *house,
                      tn_path_slices *taken, tn_error *error)
{
    size_t cells;
    const uint32_t *functions = tn_interned(&c->path->kind.frontier->slices.functions, slices->functions, &cells);
    for (size_t i = 0; i < cells; i++)
        house->cells[house->tray_first[c->tray] + i].function = functions[i];
    taken->items = malloc((count + 1) * sizeof *taken->items);
    if (!taken->items || !tn_key_push(&c->path->beginning, slices->functions))
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        taken->items[taken->count++] = (tn_frontier_choice){slices[i].slice, slices[i].times};
        status = take_slice(c, &taken->items[i], error);
    }
    return status;
}

/* ---- numbers that are kept */

void tn_path_forget_numbers(tn_plan_path *path)
{
    for (uint32_t i = 0; i < path->beginnings.count; i++)
        tn_integers_free(path->by_functions[i].items, path->by_functions[i].count);
    free(path->by_functions);
    tn_interner_clear(&path->beginnings);
    path->beginnings = (tn_interner){0};
    path->by_functions = NULL;
    path->beginning_room = path->number_count = 0;
}

/* *beginning: the place of the functions so far. */
static tn_status find_beginning(tn_plan_path *path, uint32_t *beginning, tn_error *error)
{
    uint32_t before = path->beginnings.count;
    if (!tn_array_reserve_from(&path->by_functions, &path->beginning_room, 4, before, 1, sizeof *path->by_functions))
        return tn_fail_memory(error);
    *beginning = tn_intern(&path->beginnings, path->beginning.data, path->beginning.size);
    if (*beginning == UINT32_MAX)
        return tn_fail_memory(error);
    if (*beginning == before)
        path->by_functions[before] = (tn_path_numbers){0};
    return TN_OK;
}

static void begin(tn_plan_path *path)
{
    if (path->number_count > NUMBERS_MOST)
        tn_path_forget_numbers(path);
    path->beginning.size = 0;
    for (uint32_t layer = 0; layer <= path->length; layer++)
        for (uint32_t i = 0; i < tn_path_layer(path, layer)->nodes.count; i++)
            mpz_set_ui(path->states[layer].here[i], 0);
    mpz_set_ui(path->states[0].here[0], 1);
}

/* ---- tray by tray */

static void take_back(tn_plan_path *path, uint32_t tray, tn_path_slices *taken)
{
    for (uint32_t i = 0; i < tn_path_layer(path, tray + 1)->nodes.count; i++)
        mpz_set_ui(path->states[tray + 1].here[i], 0);
    free(taken->items);
    *taken = (tn_path_slices){0};
    path->beginning.size = tray;
}

static tn_status choose_tray(tn_plan_path *path, uint32_t tray, tn_choosing *choosing, tn_house *house,
                             tn_path_slices *of_tray, tn_error *error);

/* The functions of the tray, in order: each group of slices [first, end) has others. */
static tn_status choose(tn_coming *c, tn_choosing *choosing, tn_house *house, tn_path_slices *of_tray, tn_error *error)
{
    const tn_frontier_furnished_list *slices = &c->path->kind.frontier->slices.furnished[house->trays[c->tray]];
    const tn_house *wanted = choosing->wanted;
    tn_status status = TN_OK;
    for (size_t i = 0, first = 0, end; status == TN_OK && !choosing->stop && !choosing->next && first < slices->count;
         i++, first = end) {
        const tn_frontier_furnished *group = &slices->items[first];
        mpz_ptr houses = NULL;
        end = end_of(slices, first);
        if (choosing->typed && !is_typed(c, group->functions, house, choosing->typed))
            continue;
        if (choosing->typed)
            status = tn_typed_try(choosing->typed->work, error);
        if (status == TN_OK)
            status = find_houses(c, i, group, end - first, &houses, error);
        if (status != TN_OK || tn_choosing_passes(choosing, houses, has_functions(c, group->functions, wanted)))
            continue;
        status = take(c, group, end - first, house, &of_tray[c->tray], error);
        if (status == TN_OK)
            status = choose_tray(c->path, c->tray + 1, choosing, house, of_tray, error);
        take_back(c->path, c->tray, &of_tray[c->tray]);
        choosing->stop = choosing->stop || wanted;
    }
    return status;
}

static tn_status choose_tray(tn_plan_path *path, uint32_t tray, tn_choosing *choosing, tn_house *house,
                             tn_path_slices *of_tray, tn_error *error)
{
    tn_coming c;
    if (tray == path->length)
        return tn_path_faces(path, choosing, house, of_tray, error);
    tn_status status = begin_tray(&c, path, tray, error);
    if (status == TN_OK)
        status = find_beginning(path, &c.beginning, error);
    if (status == TN_OK)
        status = choose(&c, choosing, house, of_tray, error);
    end_tray(&c);
    return status;
}

tn_status tn_path_choose(tn_plan_path *path, tn_choosing *choosing, tn_house *house, tn_error *error)
{
    tn_path_slices *of_tray = calloc((size_t)path->length + 1, sizeof *of_tray);
    if (!of_tray)
        return tn_fail_memory(error);
    begin(path);
    tn_status status = choose_tray(path, 0, choosing, house, of_tray, error);
    free(of_tray);
    return status;
}
