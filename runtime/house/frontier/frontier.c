/* Makes the engine of one section ready: its questions, slices and clauses; then merges what nothing can tell apart.
 *
 * ==== questions: decisions on cells, rooms, meetings, walks */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

tn_status tn_strip_limit(const tn_strip *strip, const char *clause, const char *what, tn_error *error)
{
    (void)strip;
    if (clause)
        tn_fail(error, TN_LIMIT, E_STRIP, "`%.60s` %s: the houses of all plans together cannot be counted", clause,
                what);
    else
        tn_fail(error, TN_LIMIT, E_STRIP, "%s: the houses of all plans together cannot be counted", what);
    tn_error_help(error, "ask about one plan (--plan PLAN or '#P'), or name a house by #P:V");
    return TN_LIMIT;
}

static tn_status add_decision(tn_strip *strip, uint32_t function, tn_error *error)
{
    tn_strip_questions *q = &strip->questions;
    for (size_t i = 0; i < q->decision_count; i++)
        if (q->decisions[i] == function)
            return TN_OK;
    if (!tn_array_reserve(&q->decisions, &q->decision_room, q->decision_count, 1, sizeof *q->decisions))
        return tn_fail_memory(error);
    q->decisions[q->decision_count++] = function;
    return TN_OK;
}

static size_t decision_of(const tn_strip *strip, uint32_t function)
{
    size_t i = 0;
    while (strip->questions.decisions[i] != function)
        i++;
    return i;
}

static tn_status add_meeting(tn_strip *strip, uint32_t index, tn_error *error)
{
    const tn_meeting_record *m = &strip->form->module->MEETING_records[index];
    tn_status status = add_decision(strip, m->first, error);
    if (status == TN_OK)
        status = add_decision(strip, m->second, error);
    return status == TN_OK && m->through != TN_NO_RECORD ? add_decision(strip, m->through, error) : status;
}

/* ---- what clauses ask */

typedef struct tn_asking {
    tn_strip *strip;
    tn_strip_clause *clause;
    const char *name;
} tn_asking;

static uint32_t find(const uint32_t *items, uint32_t count, uint32_t item)
{
    uint32_t i = 0;
    while (i < count && items[i] != item)
        i++;
    return i;
}

static tn_status find_or_add(const tn_asking *a, uint32_t *items, uint32_t *count, uint32_t most, uint32_t item,
                             uint32_t *at, tn_error *error)
{
    *at = find(items, *count, item);
    if (*at == *count && *count == most)
        return tn_strip_limit(a->strip, a->name, "asks for more than can be told apart at once", error);
    items[*at] = item;
    *count += *at == *count;
    return TN_OK;
}

static tn_status add_ratio(const tn_asking *a, int64_t ratio, tn_strip_room *room, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    uint32_t at = 0;
    while (at < q->ratio_count && q->ratios[at] != ratio)
        at++;
    if (at == TN_STRIP_RATIOS_MAX)
        return tn_strip_limit(a->strip, a->name, "asks for more ratios of glass than can be told apart at once", error);
    q->ratios[at] = ratio;
    q->ratio_count += at == q->ratio_count;
    room->ratios |= 1u << at;
    return TN_OK;
}

/* One instruction about a room. */
static tn_status add_room_part(const tn_asking *a, const tn_instruction *op, tn_strip_room *room, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    uint32_t at;
    tn_status status;
    tn_int128 most = (tn_int128)op->second * 1000000 + 1;
    switch (op->opcode) {
    case TN_OP_ALL_CELLS:
        status = find_or_add(a, q->all, &q->all_count, 64, (uint32_t)op->first, &at, error);
        room->all |= status == TN_OK ? UINT64_C(1) << at : 0;
        return status == TN_OK ? add_decision(a->strip, (uint32_t)op->first, error) : status;
    case TN_OP_HAS_FACE:
        status = find_or_add(a, q->kinds, &q->kind_count, TN_STRIP_KINDS_MAX, (uint32_t)op->first, &at, error);
        room->kinds |= status == TN_OK ? UINT64_C(1) << at : 0;
        return status;
    case TN_OP_ROOM_AREA:
        room->area = true;
        q->area_most = most > q->area_most ? most : q->area_most;
        return TN_OK;
    case TN_OP_ROOM_CELLS:
        room->cells = true;
        q->cells_most = op->second + 1 > q->cells_most ? (uint32_t)(op->second + 1) : q->cells_most;
        return TN_OK;
    case TN_OP_ROOM_GLAZING:
        return add_ratio(a, op->second, room, error);
    case TN_OP_EVERY:
    case TN_OP_ALL_OF:
    case TN_OP_ONE_OF:
    case TN_OP_NONE_OF:
    case TN_OP_DECIDE:
        return TN_OK;
    default:
        return tn_strip_limit(a->strip, a->name, "asks for more than the cells, the faces and the area of rooms",
                              error);
    }
}

static tn_status add_room(const tn_asking *a, uint32_t function, uint32_t *at, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    const tn_module *module = a->strip->form->module;
    for (*at = 0; *at < q->room_count; ++*at)
        if (q->rooms[*at].function == function)
            return TN_OK;
    if (q->room_count == TN_STRIP_QUESTIONS_MAX)
        return tn_strip_limit(a->strip, a->name, "is about more kinds of rooms than can be told apart at once", error);
    tn_strip_room *room = &q->rooms[q->room_count++];
    *room = (tn_strip_room){.function = function};
    tn_status status = TN_OK;
    for (uint32_t c = module->FUNCTION_records[function].code_begin;
         status == TN_OK && c < module->FUNCTION_records[function].code_end;) {
        tn_instruction op = tn_code_read(module->code, c);
        status = add_room_part(a, &op, room, error);
        c += op.length;
    }
    return status;
}

static tn_strip_atom *find_atom(const tn_strip_clause *clause, const tn_instruction *op)
{
    for (size_t i = 0; i < clause->atom_count; i++)
        if (clause->atoms[i].op.opcode == op->opcode && clause->atoms[i].op.first == op->first &&
            clause->atoms[i].op.second == op->second)
            return &clause->atoms[i];
    return NULL;
}

static tn_status add_atom(const tn_asking *a, const tn_instruction *op, uint32_t of, uint32_t radix, tn_error *error)
{
    tn_strip_clause *clause = a->clause;
    if (find_atom(clause, op))
        return TN_OK;
    if (!tn_array_reserve_from(&clause->atoms, &clause->atom_room, 4, clause->atom_count, 1, sizeof *clause->atoms))
        return tn_fail_memory(error);
    clause->atoms[clause->atom_count++] = (tn_strip_atom){.op = *op, .of = of, .radix = radix};
    if ((uint64_t)clause->radix * radix > TN_STRIP_LETTERS_MAX)
        return tn_strip_limit(a->strip, a->name, "asks for too much at once", error);
    clause->radix *= radix;
    return TN_OK;
}

/* The question that the atom asks is placed from now on. */
static tn_status place_atom(const tn_asking *a, tn_strip_atom *atom, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    atom->placed = true;
    if (atom->op.opcode != TN_OP_APART)
        return find_or_add(a, q->placed_rooms, &q->placed_count, TN_STRIP_PLACED_MAX, atom->of, &atom->place, error);
    q->placed_walks |= 1u << atom->of;
    return TN_OK;
}

/* Where in the row a room or a walk is, takes more to follow than whether there is one, or how many rooms there are. */
static bool is_placed(tn_opcode opcode, tn_relation_use use)
{
    return opcode == TN_OP_ROOMS ? use != TN_USE_WHOLE
                                 : use != TN_USE_SOMEWHERE && (opcode == TN_OP_SOME_ROOM || opcode == TN_OP_APART);
}

static tn_status see(void *context, const tn_instruction *op, tn_relation_use use, tn_error *error)
{
    const tn_asking *a = context;
    tn_strip_questions *q = &a->strip->questions;
    uint32_t of = 0, radix = 1, first = (uint32_t)op->first;
    bool late = op->opcode == TN_OP_APART;
    if (tn_code_compares_house(op->opcode)) /* the automaton has no other question about such a number */
        return use == TN_USE_WHOLE ? add_atom(a, op, tn_strip_compared(a->strip, first), TN_STRIP_TRUTHS, error)
                                   : tn_strip_limit(a->strip, a->name,
                                                    "compares a number of the whole house within a part of it", error);
    tn_status status = TN_OK;
    switch (op->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        radix = op->opcode == TN_OP_ROOMS ? TN_STRIP_CELLS_MAX + 1 : 2;
        status = add_room(a, first, &of, error);
        break;
    case TN_OP_MEETS:
    case TN_OP_APART:
        radix = 2;
        status = late ? find_or_add(a, q->walks, &q->walk_count, TN_STRIP_MEETINGS_MAX, first, &of, error)
                      : find_or_add(a, q->meetings, &q->meeting_count, 64, first, &of, error);
        if (status == TN_OK)
            status = add_meeting(a->strip, first, error);
        break;
    default:
        break;
    }
    if (status == TN_OK)
        status = add_atom(a, op, of, radix, error);
    return status == TN_OK && is_placed(op->opcode, use) ? place_atom(a, find_atom(a->clause, op), error) : status;
}

/* The rooms that a number counts. */
static tn_status ask_weights(tn_strip *strip, uint32_t number, tn_error *error)
{
    const tn_house_weights *w = strip->added->of[number];
    tn_asking asking = {strip, NULL, tn_text(strip->form->module, w->of.name)};
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < w->count; i++)
        if (w->terms[i].kind == TN_HOUSE_ROOMS)
            status = add_room(&asking, w->terms[i].part, &strip->weighed_rooms[number][i], error);
    return status;
}

static tn_strip_walk parts_of(const tn_strip *strip, uint32_t meeting)
{
    const tn_meeting_record *m = &strip->form->module->MEETING_records[meeting];
    bool any = m->through == TN_NO_RECORD;
    return (tn_strip_walk){decision_of(strip, m->first), decision_of(strip, m->second),
                           any ? 0 : decision_of(strip, m->through), any};
}

/* The places of the decisions that rooms, meetings and walks ask for. */
static void place_decisions(tn_strip *strip)
{
    tn_strip_questions *q = &strip->questions;
    for (uint32_t i = 0; i < q->all_count; i++)
        q->all_decisions[i] = decision_of(strip, q->all[i]);
    for (uint32_t m = 0; m < q->meeting_count; m++)
        q->meeting_parts[m] = parts_of(strip, q->meetings[m]);
    for (uint32_t w = 0; w < q->walk_count; w++)
        q->walk_parts[w] = parts_of(strip, q->walks[w]);
}

tn_status tn_strip_ask(tn_strip *strip, tn_error *error)
{
    const tn_module *module = strip->form->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < strip->clause_count; i++) {
        tn_strip_clause *clause = &strip->clauses[i];
        const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[strip->library->clause_first + i];
        tn_asking asking = {strip, clause, tn_text(module, record->name)};
        status = tn_rule_uses(module, clause->holds, see, &asking, error);
    }
    for (uint32_t k = 0; status == TN_OK && k < strip->added->count; k++)
        status = ask_weights(strip, k, error);
    if (status == TN_OK)
        place_decisions(strip);
    strip->answer_words = strip->questions.decision_count / 64 + 1;
    return status;
}

/* ==== merging
 *
 * Merges what nothing that follows can tell apart: edges that meet every neighbour alike, and cells for whose
 * tiles it makes no difference what stands at their left.
 *
 * Which neighbours there are is scouted first, tiles left aside (tn_strip.scouting): few states, which make every plane
 * that the library's houses can have. */

static int compare_words(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* ---- edges */

/* A plane, for sorting: by its left edge, then its right one. */
typedef struct tn_plane_place {
    uint64_t edges; /* left << 32 | right */
    uint32_t plane;
} tn_plane_place;

static int compare_places(const void *a, const void *b)
{
    const tn_plane_place *p = a, *q = b;
    return (p->edges > q->edges) - (p->edges < q->edges);
}

/* Equal lists of outcomes have one number. */
static bool number_outcomes(tn_strip *strip, tn_interner *lists, const tn_strip_list *list, uint32_t *number)
{
    tn_key *key = &strip->key;
    bool ok = true;
    key->size = 0;
    for (size_t i = 0; ok && i < list->count; i++)
        ok = tn_key_push(key, list->items[i].slice) && tn_push_long(key, list->items[i].times);
    *number = ok ? tn_intern(lists, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX;
}

/* What is asked of an edge's cells later, when it is the left one. */
static bool push_asked(tn_strip *strip, const tn_strip_edge *edge)
{
    bool ok = tn_key_push(&strip->joined, edge->asked);
    for (uint32_t i = 0; ok && i < edge->count; i++)
        ok = tn_key_push(&strip->joined, edge->cells[i].tiled);
    return ok;
}

/* places: all planes in order; *at: the first of the edge, then the first of another. */
static bool push_neighbours(tn_strip *strip, tn_interner *lists, uint32_t edge, const tn_plane_place *places,
                            size_t count, size_t *at)
{
    bool ok = true;
    for (; ok && *at < count && places[*at].edges >> 32 == edge; ++*at) {
        uint32_t list;
        ok = number_outcomes(strip, lists, &strip->planes[places[*at].plane], &list) &&
             tn_key_push(&strip->joined, tn_low(places[*at].edges)) && tn_key_push(&strip->joined, list);
    }
    return ok;
}

static bool merge_edges(tn_strip *strip)
{
    uint32_t edges = strip->edge_keys.count, planes = strip->plane_keys.count;
    tn_plane_place *places = malloc(((size_t)planes + 1) * sizeof *places);
    uint32_t *first = malloc(((size_t)edges + 1) * sizeof *first); /* of each class */
    strip->merged.edges = malloc(((size_t)edges + 1) * sizeof *strip->merged.edges);
    tn_interner classes = {0}, lists = {0};
    size_t at = 0;
    bool ok = places && first && strip->merged.edges;
    for (uint32_t i = 0; ok && i < planes; i++)
        places[i] = (tn_plane_place){strip->plane_keys.keys[i], i};
    if (ok)
        qsort(places, planes, sizeof *places, compare_places);
    for (uint32_t e = 0; ok && e < edges; e++) {
        uint32_t before = classes.count;
        strip->joined.size = 0;
        ok = push_asked(strip, &strip->edges[e]) && push_neighbours(strip, &lists, e, places, planes, &at);
        uint32_t class = ok ? tn_intern(&classes, strip->joined.data, strip->joined.size) : UINT32_MAX;
        ok = class != UINT32_MAX;
        if (ok && class == before)
            first[class] = e;
        if (ok)
            strip->merged.edges[e] = first[class];
    }
    tn_interner_clear(&classes);
    tn_interner_clear(&lists);
    free(places);
    free(first);
    return ok;
}

/* ---- what can stand at the right of a cell */

/* The number of a cell of an edge among the cells of all edges. */
static uint32_t *number_cells(const tn_strip *strip)
{
    uint32_t *first = malloc(((size_t)strip->edge_keys.count + 1) * sizeof *first), count = 0;
    for (uint32_t e = 0; first && e < strip->edge_keys.count; e++) {
        first[e] = count;
        count += strip->edges[e].count;
    }
    return first;
}

/* seen: {cell of an edge, what stands at its right}. */
static bool see_plane(const tn_strip *strip, uint32_t plane, const uint32_t *cells, tn_numbering *seen)
{
    uint32_t left = tn_high(strip->plane_keys.keys[plane]);
    const tn_strip_list *list = &strip->planes[plane];
    bool ok = true;
    for (size_t k = 0; ok && left != TN_STRIP_NONE && k < list->count; k++) {
        size_t size;
        const uint32_t *outcome = tn_interned(&strip->outcome_keys, list->items[k].slice, &size);
        const uint32_t *sides = outcome + 3 + (size_t)STEP_WORDS * outcome[2];
        for (uint32_t i = 0; ok && i < strip->edges[left].count; i++)
            if (strip->edges[left].cells[i].tiled)
                ok = tn_number(seen, (uint64_t)(cells[left] + i) << 32 | (sides[SIDE_WORDS * i + SIDE_FIT] - 1)) !=
                     UINT32_MAX;
    }
    return ok;
}

/* found: {base, what stands at its right}, of all slices whose cells are those. cell_bases: {cell of an edge, base}. */
static bool see_slices(const tn_strip *strip, const uint32_t *cells, tn_numbering *cell_bases)
{
    bool ok = true;
    for (uint32_t s = 0; ok && s < strip->slice_keys.count; s++) {
        size_t size;
        const uint32_t *slice = tn_interned(&strip->slice_keys, s, &size);
        const tn_strip_edge *edge = &strip->edges[slice[SLICE_EXIT]];
        for (uint32_t i = 0; ok && i < edge->count; i++)
            if (edge->cells[i].tiled)
                ok = tn_number(cell_bases, (uint64_t)(cells[slice[SLICE_EXIT]] + i) << 32 |
                                               slice[SLICE_CELLS + CELL_WORDS * i + CELL_TILE]) != UINT32_MAX;
    }
    return ok;
}

/* Joins {cell, base} and {cell, side} to {base, side}; both are sorted here. */
static bool join(tn_numbering *cell_bases, tn_numbering *seen, tn_numbering *found)
{
    bool ok = true;
    size_t at = 0;
    if (cell_bases->count > 0)
        qsort(cell_bases->keys, cell_bases->count, sizeof *cell_bases->keys, compare_words);
    if (seen->count > 0)
        qsort(seen->keys, seen->count, sizeof *seen->keys, compare_words);
    for (uint32_t i = 0; ok && i < cell_bases->count; i++) {
        uint32_t cell = tn_high(cell_bases->keys[i]);
        while (at < seen->count && tn_high(seen->keys[at]) < cell)
            at++;
        for (size_t k = at; ok && k < seen->count && tn_high(seen->keys[k]) == cell; k++)
            ok = tn_number(found, cell_bases->keys[i] << 32 | tn_low(seen->keys[k])) != UINT32_MAX;
    }
    return ok;
}

/* found, sorted, as a list for each base. */
static bool list_sides(tn_strip *strip, tn_numbering *found)
{
    tn_strip_merged *m = &strip->merged;
    m->first = calloc((size_t)strip->bases.count + 2, sizeof *m->first);
    m->sides = malloc(((size_t)found->count + 1) * sizeof *m->sides);
    if (!m->first || !m->sides)
        return false;
    if (found->count > 0)
        qsort(found->keys, found->count, sizeof *found->keys, compare_words);
    for (uint32_t i = 0; i < found->count; i++) {
        m->first[tn_high(found->keys[i]) + 1]++;
        m->sides[i] = tn_low(found->keys[i]);
    }
    for (uint32_t b = 0; b < strip->bases.count; b++)
        m->first[b + 1] += m->first[b];
    return true;
}

static bool find_sides(tn_strip *strip)
{
    tn_numbering seen = {0}, cell_bases = {0}, found = {0};
    uint32_t *cells = number_cells(strip);
    bool ok = cells && see_slices(strip, cells, &cell_bases);
    for (uint32_t p = 0; ok && p < strip->plane_keys.count; p++)
        ok = see_plane(strip, p, cells, &seen);
    ok = ok && join(&cell_bases, &seen, &found) && list_sides(strip, &found);
    free(cells);
    tn_numbering_clear(&seen);
    tn_numbering_clear(&cell_bases);
    tn_numbering_clear(&found);
    return ok;
}

void tn_strip_forget_states(tn_strip *strip)
{
    tn_interner_clear(&strip->states);
    tn_strip_stages_forget(&strip->stages);
    tn_strip_ways_forget(strip);
    free(strip->ends);
    strip->ends = NULL;
    strip->end_room = 0;
}

tn_status tn_strip_merge(tn_strip *strip, tn_error *error)
{
    strip->scouting = false;
    tn_strip_forget_states(strip);
    return merge_edges(strip) && find_sides(strip) ? TN_OK : tn_fail_memory(error);
}

void tn_strip_merged_clear(tn_strip_merged *merged)
{
    free(merged->edges);
    free(merged->first);
    free(merged->sides);
    free(merged->waits);
    free(merged->one);
    tn_numbering_clear(&merged->pairs);
    tn_interner_clear(&merged->tiles);
}

/* ---- tiles that wait for the right side of their cell */

static uint32_t common_divisor(uint32_t a, uint32_t b)
{
    while (b != 0) {
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* strip->key := {what stands at the right, how many tiles fit}, for each side that can. */
static tn_status list_tiles(tn_strip *strip, uint32_t base, uint32_t left, tn_error *error)
{
    const tn_strip_merged *m = &strip->merged;
    tn_key *key = &strip->key;
    tn_status status = TN_OK;
    key->size = 0;
    for (size_t i = m->first[base]; status == TN_OK && i < m->first[base + 1]; i++) {
        uint32_t tiles = 0;
        status = tn_strip_fit(strip, base, left, m->sides[i], &tiles, error);
        if (status == TN_OK && (!tn_key_push(key, m->sides[i]) || !tn_key_push(key, tiles)))
            status = tn_fail_memory(error);
    }
    return status;
}

/* Takes from the list at hand what all of its numbers are multiples of: 0 where no tile ever fits. A list of ones
 * becomes empty: nothing waits. Where tiles have prices, numbers are of lists of costs, and stay as they are. */
static uint32_t take_factor(const tn_strip *strip, tn_key *key)
{
    uint32_t factor = 0;
    bool ones = true;
    for (size_t i = 1; i < key->size; i += 2)
        factor = common_divisor(factor, key->data[i]);
    if (strip->prices.items)
        return factor > 0;
    for (size_t i = 1; factor > 0 && i < key->size; i += 2) {
        key->data[i] /= factor;
        ones = ones && key->data[i] == 1;
    }
    key->size = ones ? 0 : key->size;
    return factor;
}

/* Equal lists are one class. */
static tn_status classify(tn_strip *strip, uint32_t base, uint32_t left, tn_strip_wait *wait, tn_error *error)
{
    tn_strip_merged *m = &strip->merged;
    tn_status status = list_tiles(strip, base, left, error);
    if (status != TN_OK)
        return status;
    uint32_t before = m->tiles.count, factor = take_factor(strip, &strip->key);
    *wait = (tn_strip_wait){.class = TN_STRIP_NONE};
    if (factor == 0)
        return TN_OK;
    bool ever = strip->key.size > 0;
    uint32_t class = tn_intern(&m->tiles, strip->key.data, strip->key.size);
    if (class == UINT32_MAX || !tn_array_reserve(&m->one, &m->one_room, before, 1, sizeof *m->one))
        return tn_fail_memory(error);
    if (class == before)
        m->one[class] = (tn_strip_one){base, left, factor};
    *wait = (tn_strip_wait){class, factor, ever};
    return TN_OK;
}

tn_status tn_strip_waits(tn_strip *strip, uint32_t base, uint32_t left, tn_strip_wait *wait, tn_error *error)
{
    tn_strip_merged *m = &strip->merged;
    uint32_t before = m->pairs.count;
    if (!tn_array_reserve(&m->waits, &m->wait_room, before, 1, sizeof *m->waits))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&m->pairs, (uint64_t)base << 32 | left);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = at == before ? classify(strip, base, left, &m->waits[at], error) : TN_OK;
    *wait = status == TN_OK ? m->waits[at] : (tn_strip_wait){.class = TN_STRIP_NONE};
    return status;
}

/* ==== making it ready
 *
 * Makes a strip ready: its questions, the slices of its trays, the automata of its clauses. */

static void find_tiled(tn_strip *strip)
{
    const tn_house_form *form = strip->form;
    for (uint32_t t = 0; t < form->record->tile_count; t++) {
        const tn_tile_record *tile = &form->module->TILE_records[form->record->tile_first + t];
        for (uint32_t i = 0; i < tile->purpose_count; i++)
            strip->tiled[form->module->HOUSE_ITEM_records[tile->purpose_first + i].number] = strip->any_tiled = true;
    }
}

static tn_status begin(tn_strip *strip, tn_error *error)
{
    const tn_house_form *form = strip->form;
    strip->of_tray = calloc((size_t)form->schema->tray_count + 1, sizeof *strip->of_tray);
    strip->furnished = calloc((size_t)form->schema->tray_count + 1, sizeof *strip->furnished);
    strip->tiled = calloc((size_t)tn_form_functions(form) + 1, sizeof *strip->tiled);
    strip->asked_function = calloc((size_t)tn_form_functions(form) + 1, sizeof *strip->asked_function);
    strip->scratch = calloc(2 * (size_t)strip->library->clause_count + 1, sizeof *strip->scratch);
    strip->after_slice = calloc((size_t)strip->trays_most + 1, sizeof *strip->after_slice);
    strip->after_plane = calloc((size_t)strip->trays_most + 1, sizeof *strip->after_plane);
    if (!strip->of_tray || !strip->furnished || !strip->tiled || !strip->asked_function || !strip->scratch ||
        !strip->after_slice || !strip->after_plane)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < strip->added->count; k++) {
        strip->weighed_rooms[k] = calloc((size_t)strip->added->of[k]->count + 1, sizeof(uint32_t));
        if (!strip->weighed_rooms[k])
            return tn_fail_memory(error);
    }
    find_tiled(strip);
    tn_status status = tn_strip_clauses_new(strip, error);
    return status == TN_OK ? tn_strip_ask(strip, error) : status;
}

tn_status tn_strip_new(const tn_house_form *form, const tn_house_library_record *library, const uint32_t *shapes,
                       const tn_strip_trays *trays, uint32_t trays_least, uint32_t trays_most,
                       const tn_house_measures *measures, const tn_house_added *added, const tn_strip_without *without,
                       tn_strip **out, tn_error *error)
{
    tn_strip *strip = *out = calloc(1, sizeof *strip);
    if (!strip)
        return tn_fail_memory(error);
    *strip = (tn_strip){.form = form,
                        .library = library,
                        .trays_least = trays_least,
                        .trays_most = trays_most,
                        .watch = form->module->watch,
                        .measures = measures,
                        .added = added,
                        .without = without};
    memcpy(strip->shapes, shapes, form->record->choice_count * sizeof *shapes);
    tn_status status = begin(strip, error);
    if (status == TN_OK)
        status = tn_strip_prices_begin(strip, error);
    if (status == TN_OK)
        status = tn_strip_borders_find(strip, trays, error);
    for (tn_tray t = 0; status == TN_OK && t < form->schema->tray_count; t++)
        if (trays->stand[t])
            status = tn_strip_slices(strip, t, error);
    if (status == TN_OK)
        status = tn_strip_lower(strip, error);
    strip->without = NULL;
    return status;
}

static void clear_known(tn_strip *strip)
{
    for (uint32_t k = 0; strip->after_slice && strip->after_plane && k <= strip->trays_most; k++) {
        tn_strip_known_clear(&strip->after_slice[k]);
        tn_strip_known_clear(&strip->after_plane[k]);
    }
    free(strip->after_slice);
    free(strip->after_plane);
    tn_strip_known_clear(&strip->tiles);
    tn_strip_sums_clear(&strip->sums);
    tn_strip_known_clear(&strip->waits);
    tn_strip_known_clear(&strip->crossed_rooms);
    for (uint32_t w = 0; w < TN_STRIP_MEETINGS_MAX; w++)
        tn_strip_known_clear(&strip->crossed_walks[w]);
}

static void free_lists(tn_strip_list *lists, size_t count)
{
    for (size_t i = 0; lists && i < count; i++)
        free(lists[i].items);
    free(lists);
}

void tn_strip_free(tn_strip *strip)
{
    if (!strip)
        return;
    tn_interner *const interners[] = {&strip->edge_keys, &strip->slice_keys, &strip->outcome_keys, &strip->areas,
                                      &strip->bases,     &strip->sides,      &strip->waiting,      &strip->rooms,
                                      &strip->walks,     &strip->states,     &strip->letters,      &strip->fit_lists,
                                      &strip->insides,   &strip->throughs,   &strip->readings,     &strip->between,
                                      &strip->values,    &strip->asked,      &strip->mets,         &strip->totals,
                                      &strip->functions, &strip->plain_keys, &strip->parts,        &strip->combined};
    for (uint32_t i = 0; i < strip->edge_keys.count; i++) {
        free(strip->edges[i].cells);
        free(strip->edges[i].answers);
        free(strip->edges[i].inner);
    }
    free_lists(strip->of_tray, strip->form->schema->tray_count);
    for (size_t t = 0; strip->furnished && t < strip->form->schema->tray_count; t++)
        free(strip->furnished[t].items);
    free(strip->furnished);
    tn_strip_borders_clear(&strip->borders);
    free_lists(strip->planes, strip->plane_keys.count);
    for (size_t i = 0; i < sizeof interners / sizeof *interners; i++)
        tn_interner_clear(interners[i]);
    tn_numbering_clear(&strip->plane_keys);
    tn_numbering_clear(&strip->fit_keys[0]);
    tn_numbering_clear(&strip->fit_keys[1]);
    tn_strip_row_clear(&strip->row);
    tn_strip_stages_clear(&strip->stages);
    tn_numbering_clear(&strip->befores);
    tn_numbering_clear(&strip->moves);
    clear_known(strip);
    tn_strip_ways_forget(strip);
    tn_strip_orders_clear(&strip->slice_orders);
    tn_strip_orders_clear(&strip->outcome_orders);
    tn_strip_clauses_free(strip);
    tn_strip_merged_clear(&strip->merged);
    tn_strip_prices_clear(&strip->prices);
    free(strip->questions.decisions);
    free(strip->edges);
    free(strip->slices);
    free(strip->plains);
    free(strip->outcomes);
    free(strip->of_combined);
    free(strip->tiled);
    free(strip->asked_function);
    free(strip->scratch);
    free(strip->ends);
    for (uint32_t k = 0; k < TN_ADDED_MAX; k++)
        free(strip->weighed_rooms[k]);
    tn_plan_vm_free(strip->plan_vm);
    free(strip->ahead);
    tn_numbering_clear(&strip->fails);
    free(strip->open_rooms);
    free(strip->fits);
    free(strip->key.data);
    free(strip->joined.data);
    free(strip);
}

/* How many different things a clause keeps apart: its own states, and the rooms and walks that it asks for. */
static uint64_t kept_apart(const tn_strip *strip, const tn_strip_clause *clause)
{
    uint64_t states = clause->dfa ? clause->dfa->states : 0;
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_opcode opcode = clause->atoms[i].op.opcode;
        states += opcode == TN_OP_APART                                ? strip->walks.count
                  : opcode == TN_OP_SOME_ROOM || opcode == TN_OP_ROOMS ? strip->rooms.count
                  : tn_code_compares_house(opcode)                     ? strip->totals.count
                                                                       : 0;
    }
    return states;
}

const char *tn_strip_dearest(const tn_strip *strip)
{
    const tn_module *module = strip->form->module;
    const char *name = NULL;
    uint64_t most = 0;
    for (uint32_t i = 0; i < strip->clause_count; i++) {
        uint64_t states = kept_apart(strip, &strip->clauses[i]);
        if (states > most)
            name = tn_text(module, module->HOUSE_CLAUSE_records[strip->library->clause_first + i].name);
        most = states > most ? states : most;
    }
    return name;
}
