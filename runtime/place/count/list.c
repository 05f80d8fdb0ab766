/* Lists buildings as count.c finds them. Of those that turning takes to one another the least is shown: so each comes
 * once, and nothing that was shown need be kept. */
#include "runtime/place/count/list.h"

#include <stdlib.h>
#include <string.h>

enum { COLOUR = 1 };

/* A part by its lowest corner and its look. */
typedef struct lying {
    int32_t corner[3];
    uint32_t look;
} lying;

typedef struct listing {
    const tn_building_list *list;
    const tn_lattice *lattice;
    tn_watch *watch;
    int32_t anchor[3]; /* INSIDE: the corner of the middle */
    lying set[TN_COUNT_PARTS_MAX], turned[TN_COUNT_PARTS_MAX];
    tn_placed_part parts[TN_COUNT_PARTS_MAX];
} listing;

static int compare(const lying *a, const lying *b)
{
    static const int axes[] = {1, 2, 0};
    for (int i = 0; i < 3; i++)
        if (a->corner[axes[i]] != b->corner[axes[i]])
            return a->corner[axes[i]] < b->corner[axes[i]] ? -1 : 1;
    return (a->look > b->look) - (a->look < b->look);
}

static int by_corner(const void *a, const void *b)
{
    return compare(a, b);
}

/* In order, seen from the first: so that those that differ by where they stand are equal. */
static void settle(lying *set, uint32_t count)
{
    qsort(set, count, sizeof *set, by_corner); /* no two are equal: they would overlap */
    const lying first = set[0];
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            set[i].corner[k] -= first.corner[k];
}

/* A quarter turn: (x, z) to (-z, x), as in tn_turn_place. */
static void turn(const tn_lattice *l, lying *set, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const tn_look *look = &l->looks[set[i].look];
        int32_t x = -set[i].corner[2] - look->size[2];
        set[i].corner[2] = set[i].corner[0];
        set[i].corner[0] = x;
        set[i].look = tn_look_of(l, look->kind, tn_turn_after(1, look->heading));
    }
    settle(set, count);
}

/* Is it the least of those that turning makes of it? */
static bool is_least(listing *n)
{
    uint32_t count = n->list->parts;
    memcpy(n->turned, n->set, count * sizeof *n->set);
    for (int turns = 1; turns < 4; turns++) {
        int order = 0;
        turn(n->lattice, n->turned, count);
        for (uint32_t i = 0; i < count && order == 0; i++)
            order = compare(&n->turned[i], &n->set[i]);
        if (order < 0)
            return false;
    }
    return true;
}

/* Heights grow downwards: the last is the lowest. */
static void stand(listing *n)
{
    uint32_t count = n->list->parts;
    for (uint32_t i = 0; i < count; i++) {
        const lying *from = &n->set[count - 1 - i];
        const tn_look *look = &n->lattice->looks[from->look];
        const tn_kind_of_part *kind = &n->lattice->kinds.kinds[look->kind];
        tn_placed_part *part = &n->parts[i];
        part->name = tn_text(n->list->rules->module, kind->record->name);
        part->frame = (tn_frame){.heading = look->heading, .colour = COLOUR};
        const tn_cell_box all = tn_kind_all(kind, look->heading);
        for (int k = 0; k < 3; k++)
            part->frame.at[k] = from->corner[k] - all.low[k];
    }
    const tn_frame first = n->parts[0].frame;
    for (uint32_t i = 0; i < count && n->list->kind != TN_BUILDINGS_INSIDE; i++)
        for (int k = 0; k < 3; k++)
            n->parts[i].frame.at[k] -= first.at[k];
}

static tn_status show(void *context, const uint32_t *slots, tn_error *error)
{
    listing *n = context;
    uint32_t count = n->list->parts;
    if (tn_watch_stopped(n->watch))
        return tn_fail_stopped(n->watch, error);
    for (uint32_t i = 0; i < count; i++)
        n->set[i].look = tn_slot_look(n->lattice, slots[i], n->set[i].corner);
    settle(n->set, count);
    if (n->list->kind == TN_BUILDINGS_TURNED && !is_least(n))
        return TN_OK;
    if (n->list->kind == TN_BUILDINGS_INSIDE) {
        lying first;
        first.look = tn_slot_look(n->lattice, slots[0], first.corner); /* the lowest slot is the first of the set */
        for (uint32_t i = 0; i < count; i++)
            for (int k = 0; k < 3; k++)
                n->set[i].corner[k] += first.corner[k] + n->anchor[k];
    }
    stand(n);
    const tn_placed_model model = {.parts = n->parts, .count = count};
    return n->list->visit(n->list->context, &model, error);
}

static tn_status list_inside(listing *n, tn_error *error)
{
    tn_lattice lattice;
    uint8_t *forbidden;
    n->lattice = &lattice;
    tn_status status =
        tn_lattice_inside(n->list->rules, n->list->wanted, n->watch, &lattice, n->anchor, &forbidden, error);
    if (status == TN_OK)
        status = tn_visit_sets(&lattice, forbidden, n->list->parts, n->watch, show, n, error);
    free(forbidden);
    tn_lattice_clear(&lattice);
    return status;
}

tn_status tn_list_buildings(const tn_building_list *list, tn_watch *watch, tn_error *error)
{
    listing n = {.list = list, .watch = watch};
    tn_lattice lattice;
    if (list->kind == TN_BUILDINGS_INSIDE)
        return list_inside(&n, error);
    n.lattice = &lattice;
    tn_status status = tn_lattice_make(list->rules, list->wanted, &lattice, error);
    if (status == TN_OK && lattice.look_count > 0)
        status = tn_lattice_size(&lattice, list->parts, error);
    if (status == TN_OK && lattice.look_count > 0)
        status = tn_visit_sets(&lattice, NULL, list->parts, watch, show, &n, error);
    tn_lattice_clear(&lattice);
    return status;
}
