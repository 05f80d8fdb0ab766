/* Interfaces: what can stand between two edges, or where the row begins and ends.
 *
 * ==== parts
 *
 * A part of an interface is of one storey or more. What comes of it, with what is in its faces: meetings, steps, what
 * rooms and tiles see of both sides. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/rule/asked.h"
#include "runtime/house/ways.h"

/* Words of what comes of a part: the meetings (two words), the number of steps and STEP_WORDS for each, then for each
 * cell of its storeys its place and SIDE_WORDS; then, if costs are asked for, the number of the interface's. */
enum { PART_MEETINGS, PART_STEPS = PART_MEETINGS + 2 };

/* What comes of its faces, of `parts`, and of how many choices. */
typedef struct tn_interface_found {
    uint32_t part;
    uint64_t times;
} tn_interface_found;

/* Outcomes of the interface are the combinations of what its parts have. */
typedef struct tn_interface_part {
    uint64_t storeys; /* a bit each */
    tn_interface_found *found;
    size_t count, room;
    size_t at; /* of found: where a combination is at */
} tn_interface_part;

/* The house of the two trays. */
typedef struct tn_interface_house {
    tn_frontier *frontier;
    uint32_t left, right; /* edges, or TN_FRONTIER_NONE */
    uint32_t left_cells;  /* those of the left edge come first */
    bool has_left, has_right;
    tn_house house;
    uint32_t *faces; /* those in the interface */
    size_t count;
    tn_room_open *open; /* [cells]: of the rooms that they are in */
    uint32_t *sides;    /* [cells][SIDE_WORDS] */
    uint64_t changed;   /* storeys of whose faces one has another kind than when sides were found */
    uint64_t climbed;   /* if the form asks for ways: storeys from which a flight leads to the next */
    int64_t x;
    tn_interface_part *parts;
    size_t part_count;
    tn_key words; /* scratch */
    tn_numbering found;
    tn_frontier_list *list;
    tn_frontier_ordered *ordered; /* if these are wanted, and no list */
} tn_interface_house;

static bool part_has(const tn_interface_part *part, uint32_t storey)
{
    return part->storeys >> storey & 1;
}

uint64_t tn_frontier_marks(const tn_frontier *frontier, uint32_t kind)
{
    for (uint32_t i = 0; i < frontier->questions.kind_count; i++)
        if (frontier->questions.kinds[i] == kind)
            return UINT64_C(1) << i;
    return 0;
}

bool tn_frontier_steps(const tn_frontier *frontier, const tn_house *house, const tn_face *face, uint32_t walk)
{
    return tn_house_is_step(house, &frontier->form->module->MEETING_records[frontier->questions.walks[walk]], face);
}

bool tn_frontier_meets(const tn_frontier *frontier, const tn_house *house, const tn_face *face, uint32_t meeting)
{
    return tn_face_meets(house, &frontier->form->module->MEETING_records[frontier->questions.meetings[meeting]], face);
}

bool tn_frontier_joins(const tn_house *house, const tn_face *face)
{
    if (face->second == TN_NO_CELL || face->kind != TN_FACE_OPEN)
        return false;
    const tn_cell *a = &house->cells[face->first], *b = &house->cells[face->second];
    return !a->open && !b->open && a->function == b->function;
}

/* ---- steps */

/* The cell among those of its edge. */
static const tn_frontier_edge *edge_of(const tn_interface_house *c, uint32_t cell, uint32_t *at)
{
    bool left = cell < c->left_cells;
    *at = left ? cell : cell - c->left_cells;
    return &c->frontier->edges.items[left ? c->left : c->right];
}

/* Do its cells become one room, of which something may be asked? */
static bool joins(const tn_interface_house *c, const tn_face *face)
{
    bool asked = c->frontier->questions.placed_count > 0 || c->open[face->first].any || c->open[face->second].any;
    return asked && tn_frontier_joins(&c->house, face);
}

static tn_frontier_role role_of(const tn_frontier *frontier, uint32_t walk, const tn_frontier_edge *edge, uint32_t cell)
{
    return tn_frontier_role_of(frontier, walk, tn_edge_answers(frontier, edge, cell), edge->cells[cell].open);
}

/* Can a step through it make a difference to the walk? */
static bool leads(const tn_interface_house *c, const tn_face *face, uint32_t walk)
{
    uint32_t a, b;
    const tn_frontier_edge *left = edge_of(c, face->first, &a), *right = edge_of(c, face->second, &b);
    tn_frontier_role from = role_of(c->frontier, walk, left, a), to = role_of(c->frontier, walk, right, b);
    return (from.through && (to.through || to.source || to.goal)) || (from.source && (to.through || to.goal)) ||
           (from.goal && (to.through || to.source));
}

/* How a face matters to rooms and walks, as in STEP_HOW. */
static uint32_t find_how(const tn_interface_house *c, const tn_face *face, uint64_t *meetings)
{
    const tn_frontier *s = c->frontier;
    if (face->second == TN_NO_CELL)
        return 0;
    uint32_t how = joins(c, face);
    for (uint32_t w = 0; w < s->questions.walk_count; w++)
        how |= (uint32_t)(leads(c, face, w) && tn_frontier_steps(s, &c->house, face, w)) << (w + 1);
    for (uint32_t m = 0; m < s->questions.meeting_count; m++)
        *meetings |= (uint64_t)tn_frontier_meets(s, &c->house, face, m) << m;
    return how;
}

/* ---- sides */

/* What of the cell's glass is in the interface, if any question depends on that. */
static tn_int128 interface_glass(const tn_interface_house *c, uint32_t cell)
{
    tn_int128 glass = 0;
    for (size_t k = 0; c->open[cell].glass && k < c->count; k++)
        if (tn_face_sheltered(&c->house, &c->house.faces[c->faces[k]]) == cell)
            glass += tn_face_glazing(&c->house, &c->house.faces[c->faces[k]]);
    return glass;
}

/* What a side of the cell is, in SIDE_WORDS. posts: of its storey. */
static tn_status find_side(const tn_interface_house *c, uint32_t i, const tn_posts *posts, uint32_t *side,
                           tn_error *error)
{
    tn_frontier *s = c->frontier;
    uint32_t at, fit = 0, glass = tn_frontier_number_area(s, interface_glass(c, i));
    uint64_t marks = 0;
    bool tiled = edge_of(c, i, &at)->cells[at].tiled;
    tn_status status = glass != UINT32_MAX ? TN_OK : tn_fail_memory(error);
    for (size_t k = 0; c->open[i].kinds != 0 && k < c->count; k++) {
        const tn_face *face = &c->house.faces[c->faces[k]];
        marks |= face->first == i || face->second == i ? tn_frontier_marks(s, face->kind) : 0;
    }
    marks &= c->open[i].kinds;
    if (status == TN_OK && tiled)
        status = tn_frontier_fit_side(s, &c->house, i, c->x, posts, &fit, error);
    side[SIDE_MARKS] = tn_low(marks);
    side[SIDE_MARKS_HIGH] = tn_high(marks);
    side[SIDE_FIT] = fit + tiled;
    side[SIDE_GLASS] = glass;
    return status;
}

static bool has_tiles(const tn_interface_house *c, uint32_t storey)
{
    for (uint32_t i = 0; i < c->house.cell_count; i++) {
        uint32_t at;
        if (c->house.cells[i].storey == storey && edge_of(c, i, &at)->cells[at].tiled)
            return true;
    }
    return false;
}

/* Storeys do not see each other's faces. */
static tn_status find_sides(tn_interface_house *c, uint32_t storey, tn_error *error)
{
    tn_posts posts = {0};
    tn_status status = has_tiles(c, storey) ? tn_house_posts(&c->house, storey, NULL, &posts, error) : TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < c->house.cell_count; i++)
        if (c->house.cells[i].storey == storey)
            status = find_side(c, i, &posts, c->sides + (size_t)SIDE_WORDS * i, error);
    free(posts.items);
    return status;
}

/* ---- the part */

static bool push_part_steps(const tn_interface_house *c, const tn_interface_part *part, tn_key *key)
{
    uint64_t meetings = 0;
    bool ok = tn_push_long(key, 0) && tn_key_push(key, 0);
    for (size_t i = 0; ok && i < c->count; i++) {
        const tn_face *face = &c->house.faces[c->faces[i]];
        uint32_t how = part_has(part, face->storey) ? find_how(c, face, &meetings) : 0;
        if (how == 0)
            continue;
        ok = tn_key_push(key, face->first) && tn_key_push(key, face->second - c->left_cells) && tn_key_push(key, how);
        key->data[PART_STEPS]++;
    }
    if (ok) {
        key->data[PART_MEETINGS] = tn_low(meetings);
        key->data[PART_MEETINGS + 1] = tn_high(meetings);
    }
    return ok;
}

static bool push_side(const tn_interface_house *c, uint32_t cell, tn_key *key)
{
    bool ok = tn_key_push(key, cell);
    for (size_t w = 0; ok && w < SIDE_WORDS; w++)
        ok = tn_key_push(key, c->sides[(size_t)SIDE_WORDS * cell + w]);
    return ok;
}

/* Of storeys in which no face has changed, sides are what they were, unless flights join them to others. */
static tn_status push_part_sides(tn_interface_house *c, const tn_interface_part *part, tn_key *key, tn_error *error)
{
    tn_status status = TN_OK;
    uint64_t stale = c->changed & part->storeys;
    if (stale != 0 && c->climbed != 0) /* cells of several storeys are filled together */
        stale = part->storeys;
    for (uint32_t storey = 0; status == TN_OK && storey < TN_STOREYS_MAX; storey++)
        if (stale >> storey & 1)
            status = find_sides(c, storey, error);
    c->changed = status == TN_OK ? c->changed & ~part->storeys : c->changed;
    for (uint32_t i = 0; status == TN_OK && i < c->house.cell_count; i++)
        if (part_has(part, c->house.cells[i].storey) && !push_side(c, i, key))
            status = tn_fail_memory(error);
    return status;
}

static tn_status push_cost(const tn_interface_house *c, tn_key *key, tn_error *error)
{
    tn_frontier *s = c->frontier;
    const tn_frontier_border border = {.left = c->has_left ? &s->edges.items[c->left] : NULL,
                                       .right = c->has_right ? &s->edges.items[c->right] : NULL,
                                       .faces = c->faces,
                                       .count = c->count};
    uint32_t cost = 0;
    tn_status status = tn_frontier_interface_cost(s, &border, &c->house, &cost, error);
    return status == TN_OK && !tn_key_push(key, cost) ? tn_fail_memory(error) : status;
}

/* Numbers what comes of its faces as they are: of `parts`. */
static tn_status number_part(tn_interface_house *c, const tn_interface_part *part, uint32_t *number, tn_error *error)
{
    tn_frontier *s = c->frontier;
    tn_key *key = &s->joined;
    key->size = 0;
    if (!push_part_steps(c, part, key))
        return tn_fail_memory(error);
    tn_status status = push_part_sides(c, part, key, error);
    if (status == TN_OK && s->prices.asked)
        status = push_cost(c, key, error);
    *number = status == TN_OK ? tn_intern(&s->interfaces.parts, key->data, key->size) : UINT32_MAX;
    return status == TN_OK && *number == UINT32_MAX ? tn_fail_memory(error) : status;
}

/* ==== outcomes
 *
 * Puts together what comes of an interface from what comes of its parts. */

/* ---- what is kept of an outcome */

/* Numbers what of the sides of some cells matters to their tiles. */
static uint32_t number_fits(tn_interface_house *c, const uint32_t *sides, uint32_t first, uint32_t end)
{
    tn_frontier *s = c->frontier;
    bool ok = true;
    s->key.size = 0;
    for (uint32_t i = first; ok && i < end; i++)
        ok = tn_key_push(&s->key, sides[(size_t)SIDE_WORDS * i + SIDE_FIT]);
    return ok ? tn_intern(&s->tiles.lists, s->key.data, s->key.size) : UINT32_MAX;
}

/* Numbers what rooms and walks meet: the key from the steps on, without what matters to tiles. */
static uint32_t number_through(tn_interface_house *c, const uint32_t *steps, const uint32_t *sides)
{
    tn_frontier *s = c->frontier;
    const uint32_t *end = sides + (size_t)SIDE_WORDS * c->house.cell_count;
    bool ok = true;
    s->key.size = 0;
    for (const uint32_t *word = steps; ok && word <= end; word++) {
        bool fit = word >= sides && word < end && (size_t)(word - sides) % SIDE_WORDS == SIDE_FIT;
        ok = tn_key_push(&s->key, fit ? 0 : *word);
    }
    return ok ? tn_intern(&s->outcomes.throughs, s->key.data, s->key.size) : UINT32_MAX;
}

/* The parts of a new outcome, whose key is `joined`. */
static bool keep_outcome(tn_interface_house *c, uint32_t outcome)
{
    tn_frontier *s = c->frontier;
    const uint32_t *steps = s->joined.data + 2, *sides = steps + 1 + (size_t)STEP_WORDS * *steps;
    tn_frontier_outcome *parts = &s->outcomes.items[outcome];
    parts->left_fits = number_fits(c, sides, 0, c->left_cells);
    parts->right_fits = number_fits(c, sides, c->left_cells, (uint32_t)c->house.cell_count);
    parts->through = number_through(c, steps, sides);
    parts->cost = s->prices.asked ? sides[(size_t)SIDE_WORDS * c->house.cell_count + 1] : 0;
    return parts->left_fits != UINT32_MAX && parts->right_fits != UINT32_MAX && parts->through != UINT32_MAX &&
           tn_frontier_split_outcome(s, s->joined.data, c->left_cells, (uint32_t)c->house.cell_count - c->left_cells,
                                     parts);
}

/* ---- outcomes from parts */

static int compare_steps(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return p[STEP_FROM] != q[STEP_FROM] ? (p[STEP_FROM] > q[STEP_FROM]) - (p[STEP_FROM] < q[STEP_FROM])
                                        : (p[STEP_TO] > q[STEP_TO]) - (p[STEP_TO] < q[STEP_TO]);
}

/* parts: of `parts`, `count` of them. Appends their meetings, then their steps in order. */
static bool push_steps(const tn_frontier *s, const uint32_t *parts, size_t count, tn_key *key)
{
    bool ok = tn_push_long(key, 0) && tn_key_push(key, 0);
    for (size_t p = 0; ok && p < count; p++) {
        size_t size;
        const uint32_t *words = tn_interned(&s->interfaces.parts, parts[p], &size);
        key->data[0] |= words[PART_MEETINGS];
        key->data[1] |= words[PART_MEETINGS + 1];
        key->data[2] += words[PART_STEPS];
        for (size_t w = 0; ok && w < (size_t)STEP_WORDS * words[PART_STEPS]; w++)
            ok = tn_key_push(key, words[PART_STEPS + 1 + w]);
    }
    if (ok)
        qsort(key->data + 3, key->data[2], STEP_WORDS * sizeof *key->data, compare_steps);
    return ok;
}

/* Appends SIDE_WORDS of each cell, in the order of cells. *cost: the last word of a part. */
static bool push_sides(const tn_interface_house *c, const uint32_t *parts, size_t count, tn_key *key, uint32_t *cost)
{
    const tn_frontier *s = c->frontier;
    size_t first = key->size, cells = c->house.cell_count;
    bool ok = true;
    for (size_t w = 0; ok && w < SIDE_WORDS * cells; w++)
        ok = tn_key_push(key, 0);
    for (size_t p = 0; ok && p < count; p++) {
        size_t size;
        const uint32_t *words = tn_interned(&s->interfaces.parts, parts[p], &size),
                       *end = words + size - s->prices.asked;
        *cost = words[size - 1];
        for (words += PART_STEPS + 1 + (size_t)STEP_WORDS * words[PART_STEPS]; words < end; words += 1 + SIDE_WORDS)
            memcpy(key->data + first + (size_t)SIDE_WORDS * *words, words + 1, SIDE_WORDS * sizeof *words);
    }
    return ok;
}

/* The outcome that parts (of `parts`) have together. */
static tn_status find_outcome(tn_interface_house *c, const uint32_t *parts, size_t count, uint32_t *outcome,
                              tn_error *error)
{
    tn_frontier *s = c->frontier;
    tn_key *key = &s->joined;
    uint32_t before = s->outcomes.keys.count, cost = 0;
    key->size = 0;
    if (!push_steps(s, parts, count, key) || !push_sides(c, parts, count, key, &cost) ||
        !tn_key_push(key, c->left_cells) || (s->prices.asked && !tn_key_push(key, cost)) ||
        !tn_array_reserve(&s->outcomes.items, &s->outcomes.room, before, 1, sizeof *s->outcomes.items))
        return tn_fail_memory(error);
    *outcome = tn_intern(&s->outcomes.keys, key->data, key->size);
    bool ok = *outcome != UINT32_MAX && (*outcome < before || keep_outcome(c, *outcome));
    return ok ? TN_OK : tn_fail_memory(error);
}

/* The same for all parts of the interface, which may have been met together; parts: their numbers, then that of the
 * cells at the left. */
static tn_status know_outcome(tn_interface_house *c, const tn_key *parts, uint32_t *outcome, tn_error *error)
{
    tn_frontier *s = c->frontier;
    uint32_t before = s->interfaces.combined.count;
    if (!tn_array_reserve(&s->interfaces.of_combined, &s->interfaces.combined_room, before, 1,
                          sizeof *s->interfaces.of_combined))
        return tn_fail_memory(error);
    uint32_t at = tn_intern(&s->interfaces.combined, parts->data, parts->size);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (at == before)
        status = find_outcome(c, parts->data, c->part_count, &s->interfaces.of_combined[at], error);
    *outcome = status == TN_OK ? s->interfaces.of_combined[at] : 0;
    return status;
}

/* ==== interfaces
 *
 * Finds what can stand in the interface between two edges, or where the row begins and ends: each storey by
 * itself, as storeys do not see each other's faces, then their combinations. */

/* ---- the house of the two trays */

static bool in_interface(const tn_interface_house *c, const tn_face *face)
{
    return face->at.x0 == c->x && face->at.x1 == c->x;
}

static void furnish(tn_interface_house *c, const tn_frontier_edge *edge, size_t first_cell, size_t *face)
{
    for (uint32_t i = 0; i < edge->count; i++)
        c->house.cells[first_cell + i].function = edge->cells[i].function;
    for (size_t i = 0; i < edge->inner_count; ++*face) {
        tn_face *f = &c->house.faces[*face];
        if (f->relation == TN_FACE_UNDER || f->side == TN_HOUSE_BACK || f->side == TN_HOUSE_FRONT)
            f->kind = edge->inner[i++];
    }
}

static tn_status find_open(tn_interface_house *c, tn_error *error)
{
    tn_status status = TN_OK;
    c->open = malloc((c->house.cell_count + 1) * sizeof *c->open);
    if (!c->open)
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < c->house.cell_count; i++) {
        bool left = i < c->left_cells;
        uint32_t at = left ? i : i - c->left_cells;
        const tn_frontier_edge *edge = &c->frontier->edges.items[left ? c->left : c->right];
        status = tn_frontier_room_open(c->frontier, tn_frontier_fails(c->frontier, edge, at), &c->open[i], error);
    }
    return status;
}

static tn_status stand(tn_interface_house *c, tn_error *error)
{
    const tn_frontier *s = c->frontier;
    uint32_t left = c->left, right = c->right;
    tn_tray trays[2];
    size_t length = 0, face = 0;
    c->has_left = left != TN_FRONTIER_NONE;
    c->has_right = right != TN_FRONTIER_NONE;
    if (c->has_left)
        trays[length++] = s->edges.items[left].tray;
    if (c->has_right)
        trays[length++] = s->edges.items[right].tray;
    tn_status status = tn_house_stand(s->form, trays, length, s->shapes, &c->house, error);
    c->faces = status == TN_OK ? malloc((c->house.face_count + 1) * sizeof *c->faces) : NULL;
    if (status == TN_OK && !c->faces)
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    c->left_cells = c->has_left ? s->edges.items[left].count : 0;
    if (c->has_left)
        furnish(c, &s->edges.items[left], 0, &face);
    if (c->has_right)
        furnish(c, &s->edges.items[right], c->left_cells, &face);
    c->x = c->has_left ? tn_tray_value_record(s->form->schema, trays[0], s->form->width)->length : 0;
    for (uint32_t i = 0; i < c->house.face_count; i++)
        if (in_interface(c, &c->house.faces[i]) && c->house.faces[i].relation != TN_FACE_UNDER)
            c->faces[c->count++] = i;
    return find_open(c, error);
}

/* ---- combinations of parts */

static tn_status add_to_list(tn_interface_house *c, uint32_t outcome, uint64_t times, tn_error *error)
{
    uint32_t at = tn_number(&c->found, outcome);
    if (at == UINT32_MAX || !tn_array_reserve_from(&c->list->items, &c->list->room, 1, at, 1, sizeof *c->list->items))
        return tn_fail_memory(error);
    if (at == c->list->count)
        c->list->items[c->list->count++] = (tn_frontier_choice){.slice = outcome};
    c->list->items[at].times += times;
    return TN_OK;
}

static tn_status too_many(const tn_interface_house *c, tn_error *error)
{
    return tn_frontier_limit(c->frontier, NULL, "two trays have more than 4,000,000 choices between them", error);
}

static bool turn_parts(const tn_interface_house *c)
{
    for (size_t p = c->part_count; p-- > 0;) {
        if (++c->parts[p].at < c->parts[p].count)
            return true;
        c->parts[p].at = 0;
    }
    return false;
}

/* words := the part that each is at, and the number of the left cells. *times: choices that have these. */
static tn_status begin_combination(tn_interface_house *c, uint64_t *times, tn_error *error)
{
    bool ok = true;
    *times = 1;
    c->words.size = 0;
    for (size_t p = 0; ok && p < c->part_count; p++) {
        const tn_interface_found *found = &c->parts[p].found[c->parts[p].at];
        *times *= found->times;
        ok = tn_key_push(&c->words, found->part);
    }
    return ok && tn_key_push(&c->words, c->left_cells) ? TN_OK : tn_fail_memory(error);
}

/* Adds the outcomes of all combinations of what the parts have. */
static tn_status combine(tn_interface_house *c, tn_error *error)
{
    uint64_t tried = 0;
    tn_status status;
    do {
        uint64_t times = 0;
        uint32_t outcome = 0;
        status = ++tried <= TN_FRONTIER_CHOICES_MAX ? begin_combination(c, &times, error) : too_many(c, error);
        if (status == TN_OK)
            status = know_outcome(c, &c->words, &outcome, error);
        if (status == TN_OK)
            status = add_to_list(c, outcome, times, error);
    } while (status == TN_OK && turn_parts(c));
    return status;
}

/* ---- choices of what is in the faces */

typedef struct tn_interface_wheel {
    tn_face *face;
    uint32_t count, at, kinds[TN_FACE_KINDS_MAX];
} tn_interface_wheel;

static bool turn(tn_interface_wheel *wheels, size_t count)
{
    for (size_t i = count; i-- > 0;) {
        if (++wheels[i].at < wheels[i].count)
            return true;
        wheels[i].at = 0;
    }
    return false;
}

static void set_kind(tn_interface_house *c, tn_face *face, uint32_t kind)
{
    c->changed |= (uint64_t)(face->kind != kind) << face->storey;
    face->kind = kind;
}

/* In order, the outcome itself; else what the part has, to be combined with the others. */
static tn_status add_choice(tn_interface_house *c, tn_interface_part *part, tn_error *error)
{
    uint32_t number, outcome;
    tn_status status = number_part(c, part, &number, error);
    if (status == TN_OK && c->ordered) {
        status = find_outcome(c, &number, 1, &outcome, error);
        return status == TN_OK && !tn_frontier_ordered_add(c->ordered, outcome) ? tn_fail_memory(error) : status;
    }
    size_t at = 0;
    while (status == TN_OK && at < part->count && part->found[at].part != number)
        at++;
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve_from(&part->found, &part->room, 4, at, 1, sizeof *part->found))
        return tn_fail_memory(error);
    if (at == part->count)
        part->found[part->count++] = (tn_interface_found){.part = number};
    part->found[at].times++;
    return TN_OK;
}

static tn_status add_choices(tn_interface_house *c, tn_interface_part *part, tn_error *error)
{
    tn_interface_wheel *wheels = malloc((c->count + 1) * sizeof *wheels);
    uint64_t tried = 0;
    size_t count = 0;
    if (!wheels)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->count; i++) {
        tn_face *face = &c->house.faces[c->faces[i]];
        if (!part_has(part, face->storey))
            continue;
        wheels[count] = (tn_interface_wheel){.face = face};
        wheels[count].count = (uint32_t)tn_face_options(&c->house, face, wheels[count].kinds);
        count++;
    }
    tn_status status = TN_OK;
    do {
        for (size_t i = 0; i < count; i++)
            set_kind(c, wheels[i].face, wheels[i].kinds[wheels[i].at]);
        status = ++tried <= TN_FRONTIER_CHOICES_MAX ? add_choice(c, part, error) : too_many(c, error);
    } while (status == TN_OK && turn(wheels, count));
    free(wheels);
    return status;
}

/* Storeys are parts of their own, but for those that flights join if the form asks for ways. Not if choices are wanted
 * in their order, nor if costs are asked for, which are of the interface as a whole. */
static tn_status find_parts(tn_interface_house *c, tn_error *error)
{
    uint64_t storeys = 0;
    for (size_t i = 0; i < c->house.cell_count; i++)
        storeys |= UINT64_C(1) << c->house.cells[i].storey;
    for (size_t i = 0; tn_form_asks_ways(c->house.form) && i < c->house.face_count; i++)
        if (tn_form_flight(c->house.form, c->house.faces[i].kind))
            c->climbed |= UINT64_C(1) << c->house.faces[i].storey;
    bool whole = c->ordered || c->frontier->prices.asked;
    c->parts = calloc(TN_STOREYS_MAX, sizeof *c->parts);
    if (!c->parts)
        return tn_fail_memory(error);
    for (uint32_t storey = 0; !whole && storey < TN_STOREYS_MAX; storey++) {
        bool joined = storey > 0 && c->climbed >> (storey - 1) & 1;
        c->part_count += storeys >> storey & 1 && !joined;
        if (storeys >> storey & 1)
            c->parts[c->part_count - 1].storeys |= UINT64_C(1) << storey;
    }
    if (whole)
        c->parts[c->part_count++].storeys = UINT64_MAX;
    return TN_OK;
}

static tn_status add_outcomes(tn_interface_house *c, tn_error *error)
{
    c->sides = malloc((c->house.cell_count + 1) * SIDE_WORDS * sizeof *c->sides);
    c->changed = UINT64_MAX;
    tn_status status = c->sides ? find_parts(c, error) : tn_fail_memory(error);
    for (size_t p = 0; status == TN_OK && p < c->part_count; p++)
        status = add_choices(c, &c->parts[p], error);
    return status == TN_OK && !c->ordered ? combine(c, error) : status;
}

static void end(tn_interface_house *c)
{
    tn_house_clear(&c->house);
    tn_numbering_clear(&c->found);
    for (size_t p = 0; p < c->part_count; p++)
        free(c->parts[p].found);
    free(c->parts);
    free(c->words.data);
    free(c->faces);
    free(c->open);
    free(c->sides);
}

tn_status tn_frontier_interface(tn_frontier *frontier, uint32_t left, uint32_t right,
                                const tn_frontier_list **interface, tn_error *error)
{
    uint32_t before = frontier->interfaces.keys.count;
    if (!tn_array_reserve(&frontier->interfaces.items, &frontier->interfaces.room, before, 1,
                          sizeof *frontier->interfaces.items))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&frontier->interfaces.keys, (uint64_t)left << 32 | right);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    if (at == before)
        frontier->interfaces.items[at] = (tn_frontier_list){0};
    *interface = &frontier->interfaces.items[at];
    if (frontier->interfaces.items[at].made)
        return TN_OK;
    tn_interface_house c = {
        .frontier = frontier, .left = left, .right = right, .list = &frontier->interfaces.items[at]};
    tn_status status = stand(&c, error);
    if (status == TN_OK)
        status = add_outcomes(&c, error);
    frontier->interfaces.items[at].made = status == TN_OK;
    frontier->interfaces.outcomes += frontier->interfaces.items[at].count;
    end(&c);
    return status;
}

tn_status tn_frontier_order_outcomes(tn_frontier *frontier, uint32_t left, uint32_t right, const tn_cell *like,
                                     tn_frontier_ordered *outcomes, tn_error *error)
{
    tn_interface_house c = {.frontier = frontier, .left = left, .right = right, .ordered = outcomes};
    tn_status status = stand(&c, error);
    for (size_t i = 0; status == TN_OK && i < c.house.cell_count; i++)
        c.house.cells[i].function = like[i].function;
    if (status == TN_OK)
        status = add_outcomes(&c, error);
    end(&c);
    return status;
}

void tn_frontier_interfaces_clear(tn_frontier_interfaces_made *interfaces)
{
    tn_frontier_lists_free(interfaces->items, interfaces->keys.count);
    tn_numbering_clear(&interfaces->keys);
    tn_interner_clear(&interfaces->parts);
    tn_interner_clear(&interfaces->combined);
    free(interfaces->of_combined);
}

void tn_frontier_outcomes_clear(tn_frontier_outcomes_made *outcomes)
{
    tn_interner_clear(&outcomes->keys);
    tn_interner_clear(&outcomes->throughs);
    tn_frontier_orders_clear(&outcomes->orders);
    free(outcomes->items);
}
