/* Finds which parts join and which overlap, in all of their looks. */
#include "runtime/place/count/lattice.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/place/joints.h"
#include "runtime/place/search/choices.h"

enum { PAIRS_MAX = 1 << 21 };
#define SLOTS_MAX ((size_t)1 << 28)

/* A connector of a look: its place is from the lowest corner. */
typedef struct socket {
    int32_t at[3];
    tn_axis axis, beside;
    uint32_t type;
} socket;

static socket socket_of(const tn_lattice *l, const tn_look *look, uint32_t index)
{
    const tn_kind_of_part *kind = &l->kinds.kinds[look->kind];
    const tn_part_connector_record *c =
        &l->kinds.rules->module->PART_CONNECTOR_records[kind->record->connector_first + index];
    socket s = {.axis = tn_axis_turn((tn_axis)c->axis, look->heading),
                .beside = tn_axis_turn(tn_axis_beside((tn_axis)c->axis), look->heading),
                .type = c->type};
    const int32_t at[3] = {(int32_t)c->x, (int32_t)c->y, (int32_t)c->z};
    const tn_cell_box all = tn_kind_all(kind, look->heading);
    tn_turn_place(look->heading, at, s.at);
    for (int k = 0; k < 3; k++)
        s.at[k] -= all.low[k];
    return s;
}

static bool overlap(const tn_lattice *l, const tn_look *a, const tn_look *b, const int32_t by[3])
{
    const tn_kind_of_part *one = &l->kinds.kinds[a->kind], *two = &l->kinds.kinds[b->kind];
    const tn_cell_box ours = tn_kind_all(one, a->heading), theirs = tn_kind_all(two, b->heading);
    for (uint32_t i = 0; i < one->record->box_count; i++) {
        const tn_cell_box p = tn_kind_box(one, a->heading, i);
        for (uint32_t j = 0; j < two->record->box_count; j++) {
            const tn_cell_box q = tn_kind_box(two, b->heading, j);
            bool apart = false;
            for (int k = 0; k < 3; k++) {
                int32_t moved = by[k] + ours.low[k] - theirs.low[k];
                apart |= p.low[k] >= q.high[k] + moved || q.low[k] + moved >= p.high[k];
            }
            if (!apart)
                return true;
        }
    }
    return false;
}

static tn_status too_many(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_PLACE_LIMIT, "these parts may lie beside one another in more than %d ways", PAIRS_MAX);
    tn_error_help(error, "count buildings of fewer kinds of parts (--part), or of smaller ones");
    return TN_LIMIT;
}

static tn_status add_pair(tn_lattice *l, uint32_t look, const int32_t by[3], tn_error *error)
{
    if (l->pair_count == PAIRS_MAX)
        return too_many(error);
    if (!tn_array_reserve(&l->pairs, &l->pair_capacity, l->pair_count, 1, sizeof *l->pairs))
        return tn_fail_memory(error);
    l->pairs[l->pair_count++] = (tn_look_pair){.by = {by[0], by[1], by[2]}, .look = look};
    return TN_OK;
}

static int by_place(const void *a, const void *b)
{
    const tn_look_pair *p = a, *q = b;
    if (p->look != q->look)
        return p->look < q->look ? -1 : 1;
    return memcmp(p->by, q->by, sizeof p->by);
}

/* Keeps each of the pairs from the first on once; returns how many there are. */
static uint32_t keep_different(tn_lattice *l, size_t first)
{
    tn_look_pair *own = &l->pairs[first];
    size_t count = l->pair_count - first, kept = count > 0;
    if (count > 0)
        qsort(own, count, sizeof *own, by_place);
    for (size_t i = 1; i < count; i++)
        if (by_place(&own[kept - 1], &own[i]) != 0)
            own[kept++] = own[i];
    l->pair_count = first + kept;
    return (uint32_t)kept;
}

/* All pairs of connectors of two looks that join. */
static tn_status join(tn_lattice *l, const tn_look *a, uint32_t other, tn_error *error)
{
    const tn_look *b = &l->looks[other];
    const tn_connector_type_record *types = l->kinds.rules->module->CONNECTOR_TYPE_records;
    uint32_t ours = l->kinds.kinds[a->kind].record->connector_count,
             theirs = l->kinds.kinds[b->kind].record->connector_count;
    tn_status status = (uint64_t)ours * theirs > 16 * (uint64_t)PAIRS_MAX ? too_many(error) : TN_OK;
    for (uint32_t i = 0; i < ours && status == TN_OK; i++) {
        socket p = socket_of(l, a, i);
        for (uint32_t j = 0; j < theirs && status == TN_OK; j++) {
            socket q = socket_of(l, b, j);
            int32_t by[3] = {p.at[0] - q.at[0], p.at[1] - q.at[1], p.at[2] - q.at[2]};
            bool joined = tn_axis_opposite(p.axis) == q.axis &&
                          (types[p.type].joins == q.type || types[q.type].joins == p.type) &&
                          tn_connectors_turn(l->kinds.rules->module, p.type, q.type, p.beside, q.beside) &&
                          !overlap(l, a, b, by);
            if (joined)
                status = add_pair(l, other, by, error);
        }
    }
    return status;
}

static tn_status find_joining(tn_lattice *l, tn_look *look, tn_error *error)
{
    tn_status status = TN_OK;
    look->joining_first = (uint32_t)l->pair_count;
    for (uint32_t other = 0; other < l->look_count && status == TN_OK; other++)
        status = join(l, look, other, error);
    look->joining_count = status == TN_OK ? keep_different(l, look->joining_first) : 0;
    return status;
}

static int32_t common(int32_t a, int32_t b)
{
    while (b) {
        int32_t rest = a % b;
        a = b;
        b = rest;
    }
    return abs(a);
}

/* The largest steps of which all distances are multiples; the same along x and z, so that what is turned stays on it.
 */
static void find_steps(tn_lattice *l)
{
    for (size_t i = 0; i < l->pair_count; i++)
        for (int k = 0; k < 3; k++)
            l->step[k] = common(l->step[k], l->pairs[i].by[k]);
    l->step[0] = l->step[2] = common(l->step[0], l->step[2]);
    for (int k = 0; k < 3; k++)
        l->step[k] = l->step[k] ? l->step[k] : 1;
}

/* The least multiple of a step that is above a number. */
static int32_t above(int32_t number, int32_t step)
{
    int32_t down = number / step * step;
    return down > number ? down : down + step;
}

/* Places of the lattice at which a box of another look shares a cell with a box of one. */
static tn_status overlap_boxes(tn_lattice *l, const tn_look *look, uint32_t box, uint32_t other, uint32_t other_box,
                               tn_error *error)
{
    const tn_look *b = &l->looks[other];
    const tn_kind_of_part *one = &l->kinds.kinds[look->kind], *two = &l->kinds.kinds[b->kind];
    const tn_cell_box p = tn_kind_box(one, look->heading, box), q = tn_kind_box(two, b->heading, other_box);
    const tn_cell_box ours = tn_kind_all(one, look->heading), theirs = tn_kind_all(two, b->heading);
    int32_t low[3], high[3], by[3];
    tn_status status = TN_OK;
    for (int k = 0; k < 3; k++) {
        int32_t moved = theirs.low[k] - ours.low[k];
        low[k] = above(p.low[k] - q.high[k] + moved, l->step[k]);
        high[k] = p.high[k] - q.low[k] + moved;
    }
    for (by[1] = low[1]; by[1] < high[1]; by[1] += l->step[1])
        for (by[2] = low[2]; by[2] < high[2]; by[2] += l->step[2])
            for (by[0] = low[0]; by[0] < high[0] && status == TN_OK; by[0] += l->step[0])
                status = add_pair(l, other, by, error);
    return status;
}

static tn_status find_overlapping(tn_lattice *l, tn_look *look, tn_error *error)
{
    tn_status status = TN_OK;
    look->overlapping_first = (uint32_t)l->pair_count;
    for (uint32_t other = 0; other < l->look_count; other++)
        for (uint32_t i = 0; i < l->kinds.kinds[look->kind].record->box_count; i++)
            for (uint32_t j = 0; j < l->kinds.kinds[l->looks[other].kind].record->box_count && status == TN_OK; j++)
                status = overlap_boxes(l, look, i, other, j, error);
    look->overlapping_count = status == TN_OK ? keep_different(l, look->overlapping_first) : 0;
    return status;
}

static tn_status find_looks(tn_lattice *l, const bool *wanted, tn_error *error)
{
    uint32_t turns = tn_place_turns(l->kinds.rules->module);
    l->looks = calloc(turns * (size_t)l->kinds.kind_count + 1, sizeof *l->looks);
    if (!l->looks)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < l->kinds.kind_count; k++) {
        for (uint32_t h = 0; h < turns; h++) {
            const tn_kind_of_part *kind = &l->kinds.kinds[k];
            if ((wanted && !wanted[k]) || kind->shape[h] != h || kind->record->box_count == 0)
                continue;
            tn_look *look = &l->looks[l->look_count++];
            *look = (tn_look){.kind = k, .heading = h};
            const tn_cell_box all = tn_kind_all(kind, h);
            for (int axis = 0; axis < 3; axis++)
                look->size[axis] = all.high[axis] - all.low[axis];
        }
    }
    return TN_OK;
}

tn_status tn_lattice_make(const tn_place_rules *rules, const bool *wanted, tn_lattice *l, tn_error *error)
{
    *l = (tn_lattice){.kinds = {.rules = rules}};
    tn_status status = tn_kinds_make(&l->kinds, error);
    if (status == TN_OK)
        status = find_looks(l, wanted, error);
    for (uint32_t i = 0; i < l->look_count && status == TN_OK; i++)
        status = find_joining(l, &l->looks[i], error);
    if (status != TN_OK)
        return status;
    find_steps(l);
    for (uint32_t i = 0; i < l->look_count && status == TN_OK; i++)
        status = find_overlapping(l, &l->looks[i], error);
    for (size_t i = 0; i < l->pair_count; i++)
        for (int k = 0; k < 3; k++)
            l->most[k] = abs(l->pairs[i].by[k]) > l->most[k] ? abs(l->pairs[i].by[k]) : l->most[k];
    return status;
}

void tn_lattice_clear(tn_lattice *l)
{
    tn_site_choices_clear(&l->kinds);
    free(l->looks);
    free(l->pairs);
    *l = (tn_lattice){0};
}

/* ---- slots */

static int by_slots(const void *a, const void *b)
{
    const tn_look_pair *p = a, *q = b;
    return p->slots < q->slots ? -1 : p->slots > q->slots;
}

bool tn_slots_overlap(const tn_lattice *l, size_t a, size_t b)
{
    const tn_look *look = &l->looks[a % l->look_count];
    const tn_look_pair wanted = {.slots = (int64_t)b - (int64_t)a};
    return look->overlapping_count > 0 && bsearch(&wanted, &l->pairs[look->overlapping_first], look->overlapping_count,
                                                  sizeof *l->pairs, by_slots) != NULL;
}

/* A table of so many places about the middle. */
static tn_status make_table(tn_lattice *l, const int64_t reach[3], const char *what, tn_error *error)
{
    double slots = l->look_count;
    for (int k = 0; k < 3; k++) {
        l->reach[k] = (int32_t)(reach[k] < 1 << 24 ? reach[k] : 1 << 24);
        l->side[k] = 2 * l->reach[k] + 1;
        slots *= l->side[k];
    }
    if (slots > (double)SLOTS_MAX) {
        tn_fail(error, TN_LIMIT, E_PLACE_LIMIT, "buildings %s need a table of %.3g places, and %zu is the most", what,
                slots, SLOTS_MAX);
        tn_error_help(error, "count buildings of fewer parts, or fewer kinds of parts (--part)");
        return TN_LIMIT;
    }
    l->slot_count = (size_t)slots;
    static const int32_t zero[3] = {0};
    l->middle = tn_slot_at(l, 0, zero);
    for (size_t i = 0; i < l->pair_count; i++) {
        tn_look_pair *pair = &l->pairs[i];
        pair->slots = (((int64_t)(pair->by[1] / l->step[1]) * l->side[2] + pair->by[2] / l->step[2]) * l->side[0] +
                       pair->by[0] / l->step[0]) *
                      (int64_t)l->look_count;
    }
    for (uint32_t a = 0; a < l->look_count; a++) {
        const tn_look *look = &l->looks[a];
        for (uint32_t i = 0; i < look->joining_count; i++)
            l->pairs[look->joining_first + i].slots += (int64_t)l->pairs[look->joining_first + i].look - a;
        for (uint32_t i = 0; i < look->overlapping_count; i++)
            l->pairs[look->overlapping_first + i].slots += (int64_t)l->pairs[look->overlapping_first + i].look - a;
        if (look->overlapping_count > 0) /* large parts overlap in many ways, which are searched */
            qsort(&l->pairs[look->overlapping_first], look->overlapping_count, sizeof *l->pairs, by_slots);
    }
    return TN_OK;
}

tn_status tn_lattice_size(tn_lattice *l, uint32_t parts, tn_error *error)
{
    int32_t wide = l->most[0] > l->most[2] ? l->most[0] : l->most[2];
    int64_t reach[3];
    char what[40];
    for (int k = 0; k < 3; k++)
        reach[k] = ((k == 1 ? 1 : 2) * (int64_t)parts + 2) * ((k == 1 ? l->most[1] : wide) / l->step[k] + 1);
    snprintf(what, sizeof what, "of %u parts", parts);
    return make_table(l, reach, what, error);
}

tn_status tn_lattice_cover(tn_lattice *l, const tn_cell_box *box, tn_error *error)
{
    int64_t reach[3];
    for (int k = 0; k < 3; k++) {
        int64_t low = llabs((long long)box->low[k]), high = llabs((long long)box->high[k]);
        reach[k] = ((low > high ? low : high) + l->most[k]) / l->step[k] + 2;
    }
    return make_table(l, reach, "inside of this space", error);
}

uint32_t tn_slot_look(const tn_lattice *l, size_t slot, int32_t corner[3])
{
    uint32_t look = (uint32_t)(slot % l->look_count);
    size_t place = slot / l->look_count;
    corner[0] = ((int32_t)(place % (size_t)l->side[0]) - l->reach[0]) * l->step[0];
    place /= (size_t)l->side[0];
    corner[2] = ((int32_t)(place % (size_t)l->side[2]) - l->reach[2]) * l->step[2];
    corner[1] = ((int32_t)(place / (size_t)l->side[2]) - l->reach[1]) * l->step[1];
    return look;
}

size_t tn_slot_at(const tn_lattice *l, uint32_t look, const int32_t corner[3])
{
    size_t place[3];
    for (int k = 0; k < 3; k++) {
        int32_t at = corner[k] / l->step[k];
        if (corner[k] % l->step[k] != 0 || abs(at) > l->reach[k])
            return SIZE_MAX;
        place[k] = (size_t)(at + l->reach[k]);
    }
    return ((place[1] * (size_t)l->side[2] + place[2]) * (size_t)l->side[0] + place[0]) * l->look_count + look;
}

uint32_t tn_look_of(const tn_lattice *l, uint32_t kind, uint32_t heading)
{
    uint32_t look = 0;
    while (look < l->look_count &&
           (l->looks[look].kind != kind || l->looks[look].heading != l->kinds.kinds[kind].shape[heading]))
        look++;
    return look;
}
