/* Counts and lists connected sets of slots: everywhere, or inside of a model's space. */
#include "runtime/place/count/count.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/place/space.h"

/* ==== counts connected sets of slots as D. H. Redelmeier counts polyominoes ("Counting polyominoes: yet another
 * attack", 1981): a set grows from its lowest slot, and each slot that it could grow by is either taken, or never taken
 * while the rest stays. The last part is not placed: the slots that are left are counted. Sets up to turning follow by
 * Burnside's lemma */

enum { SEEN = 128 }; /* above how many of the chosen overlap a slot */

/* What one thread has. */
typedef struct counting {
    uint8_t *marks;    /* [slot]: how many of the chosen overlap it; and SEEN */
    uint32_t *untried; /* for each number of chosen parts, `room` slots */
    uint32_t chosen[TN_COUNT_PARTS_MAX];
    size_t room;
    uint64_t count;
} counting;

typedef struct count_work {
    const tn_lattice *lattice;
    uint32_t parts;
    counting *threads;
    tn_watch *watch;
    const uint8_t *forbidden; /* [slot], or NULL: all may be taken */
    uint32_t *roots;          /* [item]: a slot */
    uint32_t *firsts;         /* [item]: which of the slots that join the root is taken first; NULL: each in its turn */
    size_t item_count;
    tn_slots_visit *visit; /* of each set, or NULL: they are counted */
    void *context;
} count_work;

static void block(const tn_lattice *l, uint8_t *marks, size_t slot, int by)
{
    const tn_look *look = &l->looks[slot % l->look_count];
    const tn_look_pair *pairs = &l->pairs[look->overlapping_first];
    for (uint32_t i = 0; i < look->overlapping_count; i++)
        marks[(size_t)((int64_t)slot + pairs[i].slots)] += (uint8_t)by;
}

/* The slots that join one, are above the root and were not seen: they are seen from here on. Returns how many. */
static size_t add_joining(const tn_lattice *l, counting *c, size_t slot, size_t root, uint32_t *to)
{
    const tn_look *look = &l->looks[slot % l->look_count];
    const tn_look_pair *pairs = &l->pairs[look->joining_first];
    size_t count = 0;
    for (uint32_t i = 0; i < look->joining_count; i++) {
        size_t next = (size_t)((int64_t)slot + pairs[i].slots);
        if (next <= root || c->marks[next])
            continue;
        c->marks[next] = SEEN;
        to[count++] = (uint32_t)next;
    }
    return count;
}

static uint64_t count_last(const tn_lattice *l, const counting *c, size_t slot, size_t root, const uint32_t *rest,
                           size_t rest_count)
{
    const tn_look *look = &l->looks[slot % l->look_count];
    const tn_look_pair *pairs = &l->pairs[look->joining_first];
    uint64_t count = 0;
    for (size_t i = 0; i < rest_count; i++)
        count += c->marks[rest[i]] == SEEN;
    for (uint32_t i = 0; i < look->joining_count; i++) {
        size_t next = (size_t)((int64_t)slot + pairs[i].slots);
        count += next > root && c->marks[next] == 0;
    }
    return count;
}

/* Each set that a last slot completes, in the order in which they would be taken. */
static tn_status visit_last(count_work *w, counting *c, size_t slot, size_t root, const uint32_t *rest,
                            size_t rest_count, tn_error *error)
{
    const tn_lattice *l = w->lattice;
    const tn_look *look = &l->looks[slot % l->look_count];
    const tn_look_pair *pairs = &l->pairs[look->joining_first];
    uint32_t *last = &c->chosen[w->parts - 1];
    tn_status status = TN_OK;
    for (uint32_t i = look->joining_count; i-- > 0 && status == TN_OK;) {
        size_t next = (size_t)((int64_t)slot + pairs[i].slots);
        *last = (uint32_t)next;
        if (next > root && c->marks[next] == 0)
            status = w->visit(w->context, c->chosen, error);
    }
    for (size_t i = rest_count; i-- > 0 && status == TN_OK;) {
        *last = rest[i];
        if (c->marks[rest[i]] == SEEN)
            status = w->visit(w->context, c->chosen, error);
    }
    return status;
}

static tn_status end_at(count_work *w, counting *c, size_t slot, size_t root, const uint32_t *rest, size_t rest_count,
                        tn_error *error)
{
    if (w->visit)
        return visit_last(w, c, slot, root, rest, rest_count, error);
    c->count += count_last(w->lattice, c, slot, root, rest, rest_count);
    return TN_OK;
}

static tn_status grow(count_work *w, counting *c, uint32_t chosen, size_t root, size_t count, tn_error *error);

/* Takes a slot, with `rest` of the untried ones left, and goes on. */
static tn_status take(count_work *w, counting *c, uint32_t chosen, size_t root, size_t slot, size_t rest,
                      tn_error *error)
{
    const tn_lattice *l = w->lattice;
    uint32_t *own = &c->untried[chosen * c->room], *next = own + c->room;
    tn_status status = TN_OK;
    c->chosen[chosen] = (uint32_t)slot;
    block(l, c->marks, slot, 1);
    if (chosen + 2 == w->parts) {
        status = end_at(w, c, slot, root, own, rest, error);
    } else {
        memcpy(next, own, rest * sizeof *own);
        size_t more = add_joining(l, c, slot, root, next + rest);
        status = grow(w, c, chosen + 1, root, rest + more, error);
        for (size_t i = 0; i < more; i++)
            c->marks[next[rest + i]] &= (uint8_t)~SEEN;
    }
    block(l, c->marks, slot, -1);
    return status;
}

static tn_status grow(count_work *w, counting *c, uint32_t chosen, size_t root, size_t count, tn_error *error)
{
    const uint32_t *own = &c->untried[chosen * c->room];
    tn_status status = TN_OK;
    if (chosen <= 3 && tn_watch_stopped(w->watch))
        return tn_fail_stopped(w->watch, error);
    while (count > 0 && status == TN_OK) {
        size_t slot = own[--count];
        if (c->marks[slot] == SEEN)
            status = take(w, c, chosen, root, slot, count, error);
    }
    return status;
}

/* ---- all of it */

/* The buildings whose lowest slot is a root and which have one of the `count` slots that join it, of which the item
 * takes one first: those that come after it in the list are not taken. */
static tn_status count_from(count_work *w, counting *c, size_t root, size_t count, size_t item, tn_error *error)
{
    uint32_t *own = &c->untried[c->room];
    if (!w->firsts)
        return grow(w, c, 1, root, count, error);
    return w->firsts[item] < count && c->marks[own[w->firsts[item]]] == SEEN
               ? take(w, c, 1, root, own[w->firsts[item]], w->firsts[item], error)
               : TN_OK;
}

static tn_status count_item(void *context, unsigned thread, size_t item, tn_error *error)
{
    count_work *w = context;
    const tn_lattice *l = w->lattice;
    counting *c = &w->threads[thread];
    size_t root = w->roots[item];
    tn_status status = tn_watch_check(w->watch, error);
    if (status != TN_OK)
        return status;
    block(l, c->marks, root, 1);
    c->chosen[0] = (uint32_t)root;
    if (w->parts == 2) {
        if (!w->firsts || w->firsts[item] == 0)
            status = end_at(w, c, root, root, NULL, 0, error);
    } else {
        uint32_t *own = &c->untried[c->room];
        size_t count = add_joining(l, c, root, root, own);
        status = count_from(w, c, root, count, item, error);
        for (size_t i = 0; i < count; i++)
            c->marks[own[i]] &= (uint8_t)~SEEN;
    }
    block(l, c->marks, root, -1);
    return status;
}

static tn_status make_items(count_work *w, tn_error *error)
{
    const tn_lattice *l = w->lattice;
    size_t count = 0;
    for (uint32_t look = 0; look < l->look_count; look++)
        count += l->looks[look].joining_count;
    w->roots = calloc(count + 1, sizeof *w->roots);
    w->firsts = calloc(count + 1, sizeof *w->firsts);
    if (!w->roots || !w->firsts)
        return tn_fail_memory(error);
    for (uint32_t look = 0; look < l->look_count; look++) {
        for (uint32_t i = l->looks[look].joining_count; i-- > 0;) { /* what takes longest first */
            w->roots[w->item_count] = (uint32_t)l->middle + look;
            w->firsts[w->item_count++] = i;
        }
    }
    return TN_OK;
}

static tn_status make_threads(count_work *w, unsigned threads, tn_error *error)
{
    const tn_lattice *l = w->lattice;
    size_t room = 1;
    tn_status status = TN_OK;
    for (uint32_t look = 0; look < l->look_count; look++)
        room = l->looks[look].joining_count > room ? l->looks[look].joining_count : room;
    w->threads = calloc(threads, sizeof *w->threads);
    if (!w->threads)
        return tn_fail_memory(error);
    for (unsigned i = 0; i < threads && status == TN_OK; i++) {
        counting *c = &w->threads[i];
        c->room = room * w->parts;
        c->marks = calloc(l->slot_count, sizeof *c->marks);
        c->untried = calloc(tn_size_of(c->room, w->parts), sizeof *c->untried);
        status = c->marks && c->untried ? TN_OK : tn_fail_memory(error);
        if (status == TN_OK && w->forbidden)
            memcpy(c->marks, w->forbidden, l->slot_count);
    }
    return status;
}

/* Every slot that is allowed is a root; where all are, one for each look is enough. */
static tn_status make_roots(count_work *w, tn_error *error)
{
    const tn_lattice *l = w->lattice;
    size_t first = w->forbidden ? 0 : l->middle, end = w->forbidden ? l->slot_count : l->middle + l->look_count;
    w->roots = calloc(end - first + 1, sizeof *w->roots);
    if (!w->roots)
        return tn_fail_memory(error);
    for (size_t slot = first; slot < end; slot++)
        if (!w->forbidden || !w->forbidden[slot])
            w->roots[w->item_count++] = (uint32_t)slot;
    return TN_OK;
}

static void clear_work(count_work *w, unsigned threads)
{
    for (unsigned i = 0; w->threads && i < threads; i++) {
        free(w->threads[i].marks);
        free(w->threads[i].untried);
    }
    free(w->threads);
    free(w->roots);
    free(w->firsts);
}

static tn_status count_sets(const tn_lattice *l, const uint8_t *forbidden, uint32_t parts, unsigned threads,
                            tn_watch *watch, uint64_t *count, tn_error *error)
{
    count_work w = {.lattice = l, .parts = parts, .watch = watch, .forbidden = forbidden};
    tn_crew *crew = tn_crew_new(threads, watch);
    tn_status status = crew ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = forbidden ? make_roots(&w, error) : make_items(&w, error);
    if (status == TN_OK)
        status = make_threads(&w, tn_crew_threads(crew), error);
    if (status == TN_OK)
        status = tn_crew_run(crew, w.item_count, 1, count_item, &w, error);
    *count = 0;
    for (unsigned i = 0; crew && w.threads && i < tn_crew_threads(crew); i++)
        *count += w.threads[i].count;
    clear_work(&w, crew ? tn_crew_threads(crew) : 0);
    tn_crew_free(crew);
    return status;
}

/* Shows each of those sets once, always in the same order. forbidden NULL: all slots are allowed, and sets whose lowest
 * slot is at the middle are shown. TN_MEMORY, TN_STOPPED, or what the visit says. */
static tn_status visit_sets(const tn_lattice *l, const uint8_t *forbidden, uint32_t parts, tn_watch *watch,
                            tn_slots_visit *visit, void *context, tn_error *error)
{
    count_work w = {
        .lattice = l, .parts = parts, .watch = watch, .forbidden = forbidden, .visit = visit, .context = context};
    tn_status status = make_roots(&w, error);
    if (status == TN_OK)
        status = make_threads(&w, 1, error);
    for (size_t item = 0; item < w.item_count && status == TN_OK; item++)
        status = parts == 1 ? visit(context, &w.roots[item], error) : count_item(&w, 0, item, error);
    clear_work(&w, 1);
    return status;
}

/* The sets of so many slots that hang together and are allowed: [slot], 0 if it is. */
static tn_status count_allowed(const tn_lattice *l, const uint8_t *forbidden, uint32_t parts, unsigned threads,
                               tn_watch *watch, uint64_t *count, tn_error *error)
{
    *count = 0;
    if (parts > 1)
        return count_sets(l, forbidden, parts, threads, watch, count, error);
    for (size_t slot = 0; slot < l->slot_count; slot++)
        *count += !forbidden[slot];
    return TN_OK;
}

tn_status tn_count_buildings(const tn_place_rules *rules, const bool *wanted, uint32_t parts, bool fixed,
                             unsigned threads, tn_watch *watch, tn_building_counts *counts, tn_error *error)
{
    tn_lattice lattice;
    *counts = (tn_building_counts){0};
    tn_status status = tn_lattice_make(rules, wanted, &lattice, error);
    if (status == TN_OK && lattice.look_count > 0)
        status = tn_lattice_size(&lattice, parts, error);
    counts->fixed = lattice.look_count;
    if (status == TN_OK && parts > 1 && lattice.look_count > 0)
        status = count_sets(&lattice, NULL, parts, threads, watch, &counts->fixed, error);
    if (status == TN_OK && !fixed && lattice.look_count > 0) {
        status = tn_count_turned(&lattice, parts, 2, threads, watch, &counts->half, error);
        if (status == TN_OK)
            status = tn_count_turned(&lattice, parts, 1, threads, watch, &counts->quarter, error);
    }
    counts->buildings = (counts->fixed + counts->half + 2 * counts->quarter) / 4; /* Burnside */
    tn_lattice_clear(&lattice);
    return status;
}

/* ==== counts buildings where they stand: the slots of the lattice whose cells are inside of a model's space are
 * allowed */

/* The lowest corner of the first wanted part that the model's rules place where it starts: the lattice goes through it.
 */
static tn_status find_anchor(const tn_place_rules *rules, const bool *wanted, int32_t anchor[3], tn_error *error)
{
    tn_site_choices c;
    bool found = false;
    tn_status status = tn_site_choices_make(rules, &c, error);
    for (size_t s = c.start_first; status == TN_OK && s < c.site_count && !found; s++) {
        const tn_choice_symbol *symbol = &c.symbols[c.sites[s].symbol];
        for (uint32_t i = 0; i < symbol->count && !found; i++) {
            const tn_site_choice *choice = &c.choices[symbol->first + i];
            const tn_chosen_part *part = &c.parts[choice->part_first];
            if (choice->part_count == 0 || (wanted && !wanted[part->kind]))
                continue;
            tn_frame frame = tn_frame_from(&c.sites[s].frame, &part->frame);
            tn_cell_box all = tn_kind_all(&c.kinds[part->kind], frame.heading);
            for (int k = 0; k < 3; k++)
                anchor[k] = frame.at[k] + all.low[k];
            found = true;
        }
    }
    tn_site_choices_clear(&c);
    if (status != TN_OK || found)
        return status;
    tn_fail(error, TN_INVALID, E_COUNT_START, "model %.100s starts with none of the parts that are counted",
            tn_text(rules->module, rules->space->name));
    tn_error_help(error, "where it starts says where parts may lie: name a part that its rule places there by --part");
    return TN_INVALID;
}

/* Is the part of a slot inside of the space, whose cells are those that are free? */
static bool is_inside(const tn_lattice *l, size_t slot, const int32_t anchor[3], tn_cells *cells)
{
    int32_t corner[3];
    const tn_look *look = &l->looks[tn_slot_look(l, slot, corner)];
    const tn_kind_of_part *kind = &l->kinds.kinds[look->kind];
    tn_cell_box all = tn_kind_all(kind, look->heading);
    for (int k = 0; k < 3; k++)
        corner[k] += anchor[k] - all.low[k];
    for (uint32_t b = 0; b < kind->record->box_count; b++) {
        tn_cell_box turned = tn_kind_box(kind, look->heading, b), box = tn_box_from(&turned, corner);
        if (tn_cells_any(cells, &box))
            return false;
    }
    return true;
}

/* forbidden: [slot], zeros. */
static tn_status find_forbidden(const tn_place_rules *rules, const tn_lattice *l, const int32_t anchor[3],
                                uint8_t *forbidden, tn_watch *watch, tn_error *error)
{
    tn_space *space = NULL;
    tn_cells *cells = tn_cells_new(watch);
    tn_status status = cells ? tn_space_new(rules, &space, error) : tn_fail_memory(error);
    if (status == TN_OK)
        tn_cells_bound(cells, tn_space_cells(space));
    for (size_t slot = 0; slot < l->slot_count && status == TN_OK; slot++) {
        if (tn_watch_stopped_at(watch, slot))
            status = tn_fail_stopped(watch, error);
        forbidden[slot] = !is_inside(l, slot, anchor, cells);
    }
    if (status == TN_OK)
        status = tn_cells_status(cells, error);
    tn_cells_free(cells);
    tn_space_free(space);
    return status;
}

static tn_status cover_space(const tn_place_rules *rules, tn_lattice *l, const int32_t anchor[3], tn_error *error)
{
    const tn_kit_model_record *model = rules->space;
    const int64_t low[3] = {model->low_x, model->low_y, model->low_z},
                  high[3] = {model->high_x, model->high_y, model->high_z};
    tn_cell_box box;
    for (int k = 0; k < 3; k++) {
        box.low[k] = (int32_t)(low[k] - anchor[k]);
        box.high[k] = (int32_t)(high[k] - anchor[k]);
    }
    return tn_lattice_cover(l, &box, error);
}

/* The lattice on which that is counted, through the anchor, and [slot] what is forbidden there: the caller clears the
 * one and frees the other in any case. */
static tn_status lattice_inside(const tn_place_rules *rules, const bool *wanted, tn_watch *watch, tn_lattice *lattice,
                                int32_t anchor[3], uint8_t **forbidden, tn_error *error)
{
    *forbidden = NULL;
    *lattice = (tn_lattice){0};
    tn_status status = find_anchor(rules, wanted, anchor, error);
    if (status == TN_OK)
        status = tn_lattice_make(rules, wanted, lattice, error);
    if (status == TN_OK)
        status = cover_space(rules, lattice, anchor, error);
    if (status != TN_OK)
        return status;
    *forbidden = calloc(lattice->slot_count, sizeof **forbidden);
    return *forbidden ? find_forbidden(rules, lattice, anchor, *forbidden, watch, error) : tn_fail_memory(error);
}

tn_status tn_count_inside(const tn_place_rules *rules, const bool *wanted, uint32_t parts, unsigned threads,
                          tn_watch *watch, uint64_t *count, tn_error *error)
{
    tn_lattice lattice;
    int32_t anchor[3];
    uint8_t *forbidden;
    *count = 0;
    tn_status status = lattice_inside(rules, wanted, watch, &lattice, anchor, &forbidden, error);
    if (status == TN_OK)
        status = count_allowed(&lattice, forbidden, parts, threads, watch, count, error);
    free(forbidden);
    tn_lattice_clear(&lattice);
    return status;
}

/* ==== lists buildings as count.c finds them. Of those that turning takes to one another the least is shown: so each
 * comes once, and nothing that was shown need be kept */

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
        lattice_inside(n->list->rules, n->list->wanted, n->watch, &lattice, n->anchor, &forbidden, error);
    if (status == TN_OK)
        status = visit_sets(&lattice, forbidden, n->list->parts, n->watch, show, n, error);
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
        status = visit_sets(&lattice, NULL, list->parts, watch, show, &n, error);
    tn_lattice_clear(&lattice);
    return status;
}
