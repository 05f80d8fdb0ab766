/* Counts the buildings that turning takes to themselves: sets of orbits, each a part with its images about an axis.
 * They are few beside all buildings, as a third of the parts or so can be chosen.
 *
 * Sets of orbits grow as in count.c. Parts of a connected set of orbits may still fall into pieces, which is looked at
 * when all are there. Where the axis stands matters up to steps of the lattice. Threads share the axes and the slots of
 * the lowest parts. */
#include "runtime/place/count/count.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/crew.h"

enum { IMAGES = 4 };

typedef struct orbit {
    size_t slots[IMAGES]; /* the lowest first */
    uint32_t count;       /* 0: not on the lattice, or in its own way */
} orbit;

typedef struct turning {
    const tn_lattice *l;
    uint32_t parts, turns;
    int32_t axis[2]; /* twice where it stands along x and z, in cells */
    uint8_t *marks;  /* [slot]: of an orbit's lowest: it was seen */
    size_t *chosen;  /* slots of the parts that are there */
    size_t *untried; /* for each number of chosen orbits */
    size_t room;
    tn_watch *watch;
    tn_error *error;
    uint64_t count;
} turning;

/* The slot that a slot is turned to. */
static size_t turn_slot(const turning *t, size_t slot)
{
    int32_t corner[3], to[3];
    const tn_look *look = &t->l->looks[tn_slot_look(t->l, slot, corner)];
    if (t->turns == 2) {
        to[0] = t->axis[0] - corner[0] - look->size[0];
        to[2] = t->axis[1] - corner[2] - look->size[2];
    } else { /* (x, z) to (-z, x) */
        to[0] = (t->axis[0] + t->axis[1]) / 2 - corner[2] - look->size[2];
        to[2] = (t->axis[1] - t->axis[0]) / 2 + corner[0];
    }
    to[1] = corner[1];
    return tn_slot_at(t->l, tn_look_of(t->l, look->kind, tn_turn_after(t->turns, look->heading)), to);
}

static bool joined(const tn_lattice *l, size_t a, size_t b)
{
    const tn_look *look = &l->looks[a % l->look_count];
    for (uint32_t i = 0; i < look->joining_count; i++)
        if ((int64_t)a + l->pairs[look->joining_first + i].slots == (int64_t)b)
            return true;
    return false;
}

static orbit orbit_of(const turning *t, size_t slot)
{
    orbit o = {.slots = {slot}, .count = 1};
    for (size_t next = turn_slot(t, slot); next != slot; next = turn_slot(t, next)) {
        if (next == SIZE_MAX || o.count == IMAGES)
            return (orbit){.count = 0};
        for (uint32_t i = 0; i < o.count; i++)
            if (tn_slots_overlap(t->l, o.slots[i], next))
                return (orbit){.count = 0};
        o.slots[o.count++] = next;
        if (next < o.slots[0]) {
            o.slots[o.count - 1] = o.slots[0];
            o.slots[0] = next;
        }
    }
    return o;
}

/* Do the chosen parts hang together? */
static bool hang_together(const turning *t, uint32_t count)
{
    size_t order[TN_COUNT_PARTS_MAX];
    uint32_t reached = 1;
    memcpy(order, t->chosen, count * sizeof *order);
    for (uint32_t i = 0; i < reached; i++) {
        for (uint32_t j = reached; j < count; j++) {
            if (!joined(t->l, order[i], order[j]))
                continue;
            size_t found = order[j];
            order[j] = order[reached];
            order[reached++] = found;
        }
    }
    return reached == count;
}

static bool is_free(const turning *t, uint32_t count, const orbit *o)
{
    for (uint32_t i = 0; i < count; i++)
        if (tn_slots_overlap(t->l, t->chosen[i], o->slots[0])) /* the images of both lie alike */
            return false;
    return true;
}

/* Adds the orbits that join one of a part, by their lowest slot; unseen, and above the root. */
static size_t add_joining(turning *t, size_t slot, size_t root, size_t *to)
{
    const tn_look *look = &t->l->looks[slot % t->l->look_count];
    size_t count = 0;
    for (uint32_t i = 0; i < look->joining_count; i++) {
        size_t next = (size_t)((int64_t)slot + t->l->pairs[look->joining_first + i].slots);
        orbit o = orbit_of(t, next);
        if (o.count == 0 || o.slots[0] <= root || t->marks[o.slots[0]])
            continue;
        t->marks[o.slots[0]] = 1;
        to[count++] = o.slots[0];
    }
    return count;
}

/* depth: orbits chosen; count: their parts; untried: how many there are for this depth. */
static tn_status grow(turning *t, uint32_t depth, uint32_t count, size_t root, size_t untried)
{
    size_t *own = &t->untried[depth * t->room], *next = own + t->room;
    tn_status status = tn_watch_check(t->watch, t->error);
    while (untried > 0 && status == TN_OK) {
        orbit o = orbit_of(t, own[--untried]);
        if (count + o.count > t->parts || !is_free(t, count, &o))
            continue;
        memcpy(&t->chosen[count], o.slots, o.count * sizeof *o.slots);
        if (count + o.count == t->parts) {
            t->count += hang_together(t, t->parts);
            continue;
        }
        memcpy(next, own, untried * sizeof *own);
        size_t more = add_joining(t, o.slots[0], root, next + untried);
        status = grow(t, depth + 1, count + o.count, root, untried + more);
        for (size_t i = 0; i < more; i++)
            t->marks[next[untried + i]] = 0;
    }
    return status;
}

/* Can a part and its images belong to one building? So many joints reach so far. */
static bool may_join(const turning *t, const orbit *o)
{
    int32_t first[3], other[3];
    tn_slot_look(t->l, o->slots[0], first);
    for (uint32_t i = 1; i < o->count; i++) {
        tn_slot_look(t->l, o->slots[i], other);
        for (int k = 0; k < 3; k += 2)
            if (abs(first[k] - other[k]) > (int64_t)(t->parts - 1) * t->l->most[k])
                return false;
    }
    return true;
}

static tn_status count_from(turning *t, size_t slot)
{
    orbit o = orbit_of(t, slot);
    if (o.count == 0 || o.slots[0] != slot || o.count > t->parts || !may_join(t, &o))
        return TN_OK;
    t->untried[0] = slot;
    return grow(t, 0, 0, slot, 1);
}

/* Some of the slots at height 0, where the lowest of a building lies. */
static tn_status count_slots(turning *t, size_t from, size_t to)
{
    tn_status status = TN_OK;
    for (size_t slot = from; slot < to && status == TN_OK; slot++) {
        int32_t corner[3];
        tn_slot_look(t->l, slot, corner);
        if (tn_watch_stopped_at(t->watch, slot))
            return tn_fail_stopped(t->watch, t->error);
        bool near = true; /* half of the longest chain of joints from the axis */
        for (int k = 0; k < 3; k += 2)
            near &= 2 * (int64_t)abs(corner[k]) <= (int64_t)t->parts * t->l->most[k] + 4 * (int64_t)t->l->most[k];
        if (near)
            status = count_from(t, slot);
    }
    return status;
}

static bool is_listed(const int32_t *axes, size_t count, int32_t axis)
{
    for (size_t i = 0; i < count; i++)
        if (axes[i] == axis)
            return true;
    return false;
}

/* An image's corner is the axis's number less the corner and the extent, and a multiple of the step like the corner. Of
 * quarter turns (turn_slot) half the sum of the two numbers takes that place, and half their difference is such a
 * multiple: up to steps of the lattice the two are equal. */
static size_t list_axes(const tn_lattice *l, int32_t *axes)
{
    size_t count = 0;
    int32_t step = l->step[0];
    for (uint32_t look = 0; look < l->look_count; look++) {
        for (int k = 0; k < 3; k += 2) {
            int32_t rest = l->looks[look].size[k] % step;
            if (is_listed(axes, count, rest))
                continue;
            axes[count++] = rest;
            axes[count++] = rest + step;
        }
    }
    return count;
}

enum { PIECES = 64 }; /* that the slots at height 0 are divided into: one is an item of work */

typedef struct turned_work {
    const tn_lattice *l;
    uint32_t turns;
    int32_t *axes; /* numbers for which some part has its image on the lattice, up to steps of it */
    size_t axis_count;
    turning *threads;
} turned_work;

static tn_status count_item(void *context, unsigned thread, size_t item, tn_error *error)
{
    const turned_work *w = context;
    turning *t = &w->threads[thread];
    size_t axis = item / PIECES, piece = item % PIECES;
    size_t layer = (size_t)w->l->side[0] * (size_t)w->l->side[2] * w->l->look_count;
    size_t first = (size_t)w->l->reach[1] * layer;
    t->axis[0] = w->axes[w->turns == 2 ? axis / w->axis_count : axis];
    t->axis[1] = w->axes[w->turns == 2 ? axis % w->axis_count : axis];
    t->error = error;
    return count_slots(t, first + layer * piece / PIECES, first + layer * (piece + 1) / PIECES);
}

static tn_status make_threads(turned_work *w, uint32_t parts, unsigned threads, tn_watch *watch, tn_error *error)
{
    size_t room = 1;
    for (uint32_t look = 0; look < w->l->look_count; look++)
        room += parts * (size_t)w->l->looks[look].joining_count;
    w->axes = calloc(4 * (size_t)w->l->look_count, sizeof *w->axes);
    w->threads = calloc(threads, sizeof *w->threads);
    if (!w->axes || !w->threads)
        return tn_fail_memory(error);
    for (unsigned i = 0; i < threads; i++) {
        turning *t = &w->threads[i];
        *t = (turning){.l = w->l, .parts = parts, .turns = w->turns, .watch = watch, .room = room};
        t->marks = calloc(w->l->slot_count, sizeof *t->marks);
        t->chosen = calloc(parts + IMAGES, sizeof *t->chosen);
        t->untried = calloc(tn_size_of(room, (size_t)parts + 1), sizeof *t->untried);
        if (!t->marks || !t->chosen || !t->untried)
            return tn_fail_memory(error);
    }
    return TN_OK;
}

tn_status tn_count_turned(const tn_lattice *lattice, uint32_t parts, uint32_t turns, unsigned threads, tn_watch *watch,
                          uint64_t *count, tn_error *error)
{
    turned_work w = {.l = lattice, .turns = turns};
    tn_crew *crew = tn_crew_new(threads, watch);
    unsigned made = crew ? tn_crew_threads(crew) : 0;
    tn_status status = crew ? make_threads(&w, parts, made, watch, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        w.axis_count = list_axes(lattice, w.axes);
        size_t axes = turns == 2 ? w.axis_count * w.axis_count : w.axis_count;
        status = tn_crew_run(crew, PIECES * axes, 1, count_item, &w, error);
    }
    *count = 0;
    for (unsigned i = 0; w.threads && i < made; i++) {
        *count += w.threads[i].count;
        free(w.threads[i].marks);
        free(w.threads[i].chosen);
        free(w.threads[i].untried);
    }
    free(w.threads);
    free(w.axes);
    tn_crew_free(crew);
    return status;
}
