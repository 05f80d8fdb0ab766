/* Counts connected sets of slots as D. H. Redelmeier counts polyominoes ("Counting polyominoes: yet another attack",
 * 1981): a set grows from its lowest slot, and each slot that it could grow by is either taken, or never taken while
 * the rest stays. The last part is not placed: the slots that are left are counted. Sets up to turning follow by
 * Burnside's lemma. */
#include "runtime/place/count/count.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

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

tn_status tn_visit_sets(const tn_lattice *l, const uint8_t *forbidden, uint32_t parts, tn_watch *watch,
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

tn_status tn_count_allowed(const tn_lattice *l, const uint8_t *forbidden, uint32_t parts, unsigned threads,
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
