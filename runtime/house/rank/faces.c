/* What is in the faces of a house of a number, whose functions are known, in their order.
 *
 * The faces of a tray are those of its cells: some are in the interface at its left, some inside it, the others in the
 * interface at its right. In each of these three the last face changes first, so that with the first faces chosen a
 * stretch of all choices is left. How many houses have them: the states before the tray go by the slices that are left
 * and the outcomes that are left on both sides to states with houses ahead, which have the functions. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/integers.h"
#include "runtime/house/rank/path.h"

/* ---- choices that are left */

/* Of all slices of a tray, or outcomes of an interface. `left`: those of a stretch, each with its number of choices. */
typedef struct tn_left {
    tn_frontier_sequence all; /* borrowed */
    tn_frontier_list left;
    uint64_t *times;     /* [kinds of all] */
    size_t first, count; /* the stretch that `left` is of; count 0: of none yet */
} tn_left;

static void clear_left(tn_left *l)
{
    free(l->left.items);
    free(l->times);
}

static bool make_room(tn_left *l)
{
    size_t kinds = l->all.kind_count;
    if (!l->times)
        l->times = malloc((kinds + 1) * sizeof *l->times);
    return l->times && tn_array_reserve(&l->left.items, &l->left.room, 0, kinds, sizeof *l->left.items);
}

/* Joins what is equal among [first, first + count). */
static tn_status gather(tn_left *l, size_t first, size_t count, tn_error *error)
{
    if (l->first == first && l->count == count)
        return TN_OK;
    if (first + count > l->all.count)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a tray has other faces by itself than in the house");
    if (!make_room(l))
        return tn_fail_memory(error);
    memset(l->times, 0, l->all.kind_count * sizeof *l->times);
    for (size_t i = first; i < first + count; i++)
        l->times[l->all.items[i]]++;
    l->left.count = 0;
    for (size_t k = 0; k < l->all.kind_count; k++)
        if (l->times[k] > 0)
            l->left.items[l->left.count++] = (tn_frontier_choice){l->all.kinds[k], l->times[k]};
    l->first = first;
    l->count = count;
    return TN_OK;
}

/* The stretch of choices that is left, of each of these alike. */
typedef struct tn_choice_stretch {
    size_t first, count;
} tn_choice_stretch;

/* An interface between two trays whose functions are known: by the edges that meet there. */
typedef struct tn_interface_left {
    const tn_cell *cells; /* of both trays */
    tn_numbering edges;   /* left << 32 | right */
    tn_left *of;          /* [edges] */
    size_t room;
    tn_choice_stretch stretch;
} tn_interface_left;

static void clear_interface(tn_interface_left *interface)
{
    for (uint32_t i = 0; i < interface->edges.count; i++)
        clear_left(&interface->of[i]);
    free(interface->of);
    tn_numbering_clear(&interface->edges);
}

static tn_status outcomes_of(tn_plan_path *a, tn_interface_left *interface, uint32_t left, uint32_t right,
                             const tn_frontier_list **list, tn_error *error)
{
    uint32_t before = interface->edges.count;
    if (!tn_array_reserve_from(&interface->of, &interface->room, 4, before, 1, sizeof *interface->of))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&interface->edges, (uint64_t)left << 32 | right);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_left *l = &interface->of[at];
    tn_status status = TN_OK;
    if (at == before) {
        *l = (tn_left){0};
        status = tn_frontier_outcomes_ordered(a->kind.frontier, left, right, interface->cells, &l->all, error);
    }
    if (status == TN_OK)
        status = gather(l, interface->stretch.first, interface->stretch.count, error);
    *list = &l->left;
    return status;
}

/* ---- the tray whose faces are being chosen */

/* Where houses are on their way: a state, and the edge at the right of the slice that led there; by how many choices.
 */
typedef struct tn_places {
    tn_numbering keys; /* edge << 32 | state */
    mpz_t *choices;
    size_t room;
} tn_places;

typedef struct tn_faces {
    tn_plan_path *path;
    tn_choosing *choosing;
    tn_house *house;
    const tn_path_slices *of_tray;
    struct tn_facing *trays; /* [length] */
    mpz_t one;
} tn_faces;

/* A tray, with the faces so far. What is found of its slices and interfaces is kept while the functions stay. */
typedef struct tn_facing {
    tn_faces *of;
    uint32_t tray;
    const tn_places *before; /* the tray */
    tn_places after;         /* it */
    tn_places behind;        /* it: how many houses go on from places there, with these choices at its right: */
    tn_choice_stretch behind_by;
    tn_left slices;
    tn_choice_stretch inner;
    tn_interface_left *left; /* the right one of the tray before */
    tn_interface_left right;
} tn_facing;

static void empty(tn_places *places)
{
    for (uint32_t i = 0; i < places->keys.count; i++)
        mpz_set_ui(places->choices[i], 0);
    tn_numbering_clear(&places->keys);
    places->keys = (tn_numbering){0};
}

static void clear_places(tn_places *places)
{
    tn_numbering_clear(&places->keys);
    tn_integers_free(places->choices, places->room);
}

static tn_status find_place(tn_places *places, uint64_t place, uint32_t *at, tn_error *error)
{
    size_t before = places->room;
    if (!tn_array_reserve_from(&places->choices, &places->room, 16, places->keys.count, 1, sizeof *places->choices))
        return tn_fail_memory(error);
    for (size_t i = before; i < places->room; i++)
        mpz_init(places->choices[i]);
    *at = tn_number(&places->keys, place);
    return *at == UINT32_MAX ? tn_fail_memory(error) : TN_OK;
}

static tn_status add_place(tn_places *places, uint32_t edge, uint32_t state, const mpz_t choices, uint64_t times,
                           tn_error *error)
{
    uint32_t at;
    tn_status status = find_place(places, (uint64_t)edge << 32 | state, &at, error);
    if (status == TN_OK)
        mpz_addmul_ui(places->choices[at], choices, times);
    return status;
}

/* ---- through the tray */

typedef struct tn_going {
    tn_places *to;
    uint32_t edge;
    mpz_ptr choices;
} tn_going;

static tn_status go_to(void *context, uint32_t state, uint64_t times, uint64_t faced, const tn_house_gain *gain,
                       tn_error *error)
{
    tn_going *g = context;
    (void)faced;
    (void)gain;
    return add_place(g->to, g->edge, state, g->choices, times, error);
}

/* f->after := where the houses with the faces so far are after the tray. */
static tn_status go_through(tn_facing *f, tn_error *error)
{
    tn_plan_path *path = f->of->path;
    tn_frontier *frontier = path->kind.frontier;
    tn_status status = gather(&f->slices, f->inner.first, f->inner.count, error);
    empty(&f->after);
    for (uint32_t i = 0; status == TN_OK && i < f->before->keys.count; i++) {
        uint32_t edge = tn_high(f->before->keys.keys[i]), state = tn_low(f->before->keys.keys[i]);
        status = tn_watch_check(frontier->watch, error);
        for (size_t k = 0; status == TN_OK && k < f->slices.left.count; k++) {
            const tn_frontier_choice *slice = &f->slices.left.items[k];
            const tn_frontier_list *outcomes = NULL;
            tn_going g = {&f->after, frontier->slices.items[slice->slice].exit, f->of->one};
            status = outcomes_of(path, f->left, edge, frontier->slices.items[slice->slice].entry, &outcomes, error);
            mpz_mul_ui(f->of->one, f->before->choices[i], slice->times);
            if (status == TN_OK)
                status = tn_path_step(path, f->tray, state, slice->slice, outcomes, go_to, &g, error);
        }
    }
    return status;
}

/* ---- houses ahead */

/* sum->houses := those that go on from a place after the tray. */
static tn_status look_on(tn_facing *f, uint64_t place, tn_path_sum *sum, tn_error *error)
{
    tn_plan_path *a = f->of->path;
    uint32_t edge = tn_high(place), state = tn_low(place), next = f->tray + 1;
    const tn_frontier_list *outcomes = NULL;
    tn_status status;
    mpz_set_ui(sum->houses, 0);
    if (next == a->length) {
        sum->ahead = NULL;
        status = outcomes_of(a, &f->right, edge, TN_FRONTIER_NONE, &outcomes, error);
        return status == TN_OK ? tn_path_step(a, next, state, TN_FRONTIER_NONE, outcomes, tn_path_add, sum, error)
                               : status;
    }
    mpz_t all;
    mpz_init(all);
    sum->trays = next + 1;
    sum->ahead = a->states[next + 1].like;
    status = TN_OK;
    for (size_t k = 0; status == TN_OK && k < f->of->of_tray[next].count; k++) {
        const tn_frontier_choice *slice = &f->of->of_tray[next].items[k];
        mpz_set_ui(sum->houses, 0);
        status = outcomes_of(a, &f->right, edge, a->kind.frontier->slices.items[slice->slice].entry, &outcomes, error);
        if (status == TN_OK)
            status = tn_path_step(a, next, state, slice->slice, outcomes, tn_path_add, sum, error);
        mpz_addmul_ui(all, sum->houses, slice->times);
    }
    mpz_swap(sum->houses, all);
    mpz_clear(all);
    return status;
}

/* *houses: the same, found once for the choices at the tray's right; good until the next. */
static tn_status find_behind(tn_facing *f, uint64_t place, tn_path_sum *sum, mpz_ptr *houses, tn_error *error)
{
    uint32_t at, known = f->behind.keys.count;
    tn_status status = find_place(&f->behind, place, &at, error);
    if (status == TN_OK && at == known) {
        status = look_on(f, place, sum, error);
        mpz_set(f->behind.choices[at], sum->houses);
    }
    *houses = status == TN_OK ? f->behind.choices[at] : sum->houses;
    return status;
}

/* houses := those that go on after the tray. */
static tn_status count_on(tn_facing *f, mpz_t houses, tn_error *error)
{
    tn_path_sum sum = {.path = f->of->path};
    tn_status status = TN_OK;
    mpz_init(sum.houses);
    mpz_set_ui(houses, 0);
    if (f->behind_by.first != f->right.stretch.first || f->behind_by.count != f->right.stretch.count)
        empty(&f->behind);
    f->behind_by = f->right.stretch;
    for (uint32_t i = 0; status == TN_OK && i < f->after.keys.count; i++) {
        mpz_ptr behind;
        status = find_behind(f, f->after.keys.keys[i], &sum, &behind, error);
        mpz_addmul(houses, behind, f->after.choices[i]);
    }
    mpz_clear(sum.houses);
    return status;
}

/* houses := those with the faces so far. */
static tn_status count_houses(tn_facing *f, mpz_t houses, tn_error *error)
{
    tn_status status = go_through(f, error);
    return status == TN_OK ? count_on(f, houses, error) : status;
}

/* ---- faces */

static tn_choice_stretch *stretch_of(tn_facing *f, const tn_face *face)
{
    if (tn_face_is_inner(face))
        return &f->inner;
    return face->side == TN_HOUSE_LEFT ? &f->left->stretch : &f->right.stretch;
}

/* Ways to choose what is in the faces of an interface: those at this x that are not between storeys. */
static size_t choices_at(const tn_house *house, int64_t x)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    size_t ways = 1;
    for (size_t i = 0; i < house->face_count; i++)
        if (!tn_face_is_inner(&house->faces[i]) && house->faces[i].at.x0 == x)
            ways *= tn_face_options(house, &house->faces[i], kinds);
    return ways;
}

static void begin_interface(const tn_house *house, uint32_t place, tn_interface_left *interface)
{
    uint32_t tray = place > 0 ? place - 1 : 0;
    interface->cells = house->cells + house->tray_first[tray];
    interface->stretch = (tn_choice_stretch){0};
    interface->stretch.count = choices_at(house, tn_house_plane_x(house, place));
}

static tn_status choose_tray(tn_faces *faces, uint32_t tray, tn_error *error);

static tn_status show(tn_choosing *choosing, tn_house *house, tn_error *error)
{
    tn_status status = choosing->faced(choosing->context, house, choosing->number, &choosing->stop, error);
    choosing->shown = true;
    choosing->next = choosing->alike < TN_ALIKE_FACES;
    if (!choosing->wanted)
        mpz_set_ui(choosing->number, 0);
    return status;
}

/* The faces are all chosen. Clauses or tiles may leave no house with them. */
static tn_status show_left(tn_facing *f, tn_error *error)
{
    mpz_t houses;
    mpz_init(houses);
    tn_status status = count_on(f, houses, error);
    if (status == TN_OK && mpz_sgn(houses) > 0)
        status = show(f->of->choosing, f->of->house, error);
    mpz_clear(houses);
    return status;
}

static tn_status end_tray(tn_facing *f, tn_error *error)
{
    tn_faces *faces = f->of;
    tn_status status = go_through(f, error);
    if (status != TN_OK)
        return status;
    return f->tray + 1 == faces->path->length ? show_left(f, error) : choose_tray(faces, f->tray + 1, error);
}

/* The kinds of the faces from this one on, of those of the tray. Up to the first house that is shown, the houses left
 * are more than its number: if none before the last kind has it, the last has. */
static tn_status choose_kinds(tn_facing *f, uint32_t at, tn_error *error)
{
    uint32_t kinds[TN_FACE_KINDS_MAX];
    tn_house *house = f->of->house;
    tn_choosing *choosing = f->of->choosing;
    while (at < house->face_count && house->cells[house->faces[at].first].tray != f->tray)
        at++;
    if (at == house->face_count)
        return end_tray(f, error);
    tn_face *face = &house->faces[at];
    size_t count = tn_face_options(house, face, kinds);
    tn_choice_stretch *stretch = stretch_of(f, face), before = *stretch;
    tn_status status = TN_OK;
    mpz_t houses;
    mpz_init(houses);
    stretch->count /= count;
    for (size_t i = 0; status == TN_OK && !choosing->stop && !choosing->next && i < count;
         i++, stretch->first += stretch->count) {
        const tn_house *wanted = choosing->wanted;
        bool is_it =
            wanted ? wanted->faces[at].kind == kinds[i] : i + 1 == count && !choosing->shown && !choosing->typed;
        bool leads_on = true;
        face->kind = kinds[i];
        if (choosing->typed)
            status = tn_path_typed_face(choosing->typed, house, at, &leads_on, error);
        if (status == TN_OK && leads_on && !is_it)
            status = count_houses(f, houses, error);
        if (status == TN_OK && leads_on && (is_it || !tn_choosing_passes(choosing, houses, false))) {
            status = choose_kinds(f, at + 1, error);
            choosing->stop = choosing->stop || wanted;
        }
    }
    *stretch = before;
    mpz_clear(houses);
    return status;
}

/* The interface at the right of the tray before is that at the left of this one: part of it is chosen. */
static tn_status choose_tray(tn_faces *faces, uint32_t tray, tn_error *error)
{
    const tn_house *house = faces->house;
    tn_facing *f = &faces->trays[tray];
    uint32_t first = house->tray_first[tray];
    tn_status status = TN_OK;
    if (!f->of) {
        *f = (tn_facing){.of = faces, .tray = tray, .before = &f[-1].after, .left = &f[-1].right};
        status = tn_frontier_slices_ordered(faces->path->kind.frontier, house->trays[tray], &house->cells[first],
                                            house->tray_first[tray + 1] - first, &f->slices.all, error);
        begin_interface(house, tray + 1, &f->right);
    }
    f->inner = (tn_choice_stretch){0, f->slices.all.count};
    return status == TN_OK ? choose_kinds(f, 0, error) : status;
}

/* ---- what is ahead, of houses with the functions */

/* How the row ends does not depend on functions. */
static tn_status look_ahead(tn_plan_path *a, const tn_path_slices *of_tray, tn_error *error)
{
    const tn_houses_layer *last = tn_path_layer(a, a->length);
    tn_path_sum sum = {.path = a};
    tn_status status = TN_OK;
    mpz_init(sum.houses);
    for (uint32_t i = 0; i < last->nodes.count; i++)
        mpz_set(a->states[a->length].like[i], last->ahead[i]);
    for (uint32_t tray = a->length; status == TN_OK && tray-- > 0;) {
        sum.trays = tray + 1;
        sum.ahead = a->states[tray + 1].like;
        for (uint32_t i = 0; status == TN_OK && i < tn_path_layer(a, tray)->nodes.count; i++)
            if (mpz_sgn(a->states[tray].here[i]) > 0)
                status = tn_path_count_on(a, tray, tn_path_state(a, tray, i), of_tray[tray].items, of_tray[tray].count,
                                          &sum, a->states[tray].like[i], error);
    }
    mpz_clear(sum.houses);
    return status;
}

static tn_status begin(tn_faces *faces, tn_error *error)
{
    tn_facing *outside = faces->trays;
    begin_interface(faces->house, 0, &outside->right);
    return add_place(&outside->after, TN_FRONTIER_NONE, TN_FRONTIER_NONE, faces->one, 1, error);
}

tn_status tn_path_faces(tn_plan_path *a, tn_choosing *choosing, tn_house *house, const tn_path_slices *of_tray,
                        tn_error *error)
{
    tn_faces faces = {.path = a, .choosing = choosing, .house = house, .of_tray = of_tray};
    tn_facing *all = faces.trays = calloc((size_t)a->length + 1, sizeof *faces.trays); /* the first is outside */
    if (!all)
        return tn_fail_memory(error);
    bool fits = true;
    mpz_init_set_ui(faces.one, 1);
    tn_frontier_orders_trim(a->kind.frontier);
    tn_status status = choosing->typed ? tn_path_typed_begin(choosing->typed, house, &fits, error) : TN_OK;
    if (status == TN_OK && fits)
        status = look_ahead(a, of_tray, error);
    if (status == TN_OK && fits)
        status = begin(&faces, error);
    faces.trays++;
    if (status == TN_OK && fits)
        status = a->length > 0 ? choose_tray(&faces, 0, error) : show(choosing, house, error);
    choosing->next = choosing->next && choosing->alike < TN_ALIKE_FUNCTIONS;
    for (uint32_t i = 0; i <= a->length; i++) {
        clear_left(&all[i].slices);
        clear_interface(&all[i].right);
        clear_places(&all[i].after);
        clear_places(&all[i].behind);
    }
    free(all);
    mpz_clear(faces.one);
    return status;
}
