/* Makes the engine of one section ready: its questions, slices and clauses; then merges what no completion can tell
 * apart.
 *
 * ==== questions: decisions on cells, rooms, meetings, walks */
#include "runtime/house/frontier/frontier.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/ways.h"

tn_status tn_frontier_limit(const tn_frontier *frontier, const char *clause, const char *what, tn_error *error)
{
    (void)frontier;
    if (clause)
        tn_fail(error, TN_LIMIT, E_FRONTIER, "`%.60s` %s: the houses of all plans together cannot be counted", clause,
                what);
    else
        tn_fail(error, TN_LIMIT, E_FRONTIER, "%s: the houses of all plans together cannot be counted", what);
    tn_error_help(error, "ask about one plan (--plan PLAN or '#P'), or name a house by #P:V");
    return TN_LIMIT;
}

static tn_status add_decision(tn_frontier *frontier, uint32_t function, tn_error *error)
{
    tn_frontier_questions *q = &frontier->questions;
    for (size_t i = 0; i < q->decision_count; i++)
        if (q->decisions[i] == function)
            return TN_OK;
    if (!tn_array_reserve(&q->decisions, &q->decision_room, q->decision_count, 1, sizeof *q->decisions))
        return tn_fail_memory(error);
    q->decisions[q->decision_count++] = function;
    return TN_OK;
}

static size_t decision_of(const tn_frontier *frontier, uint32_t function)
{
    size_t i = 0;
    while (frontier->questions.decisions[i] != function)
        i++;
    return i;
}

static tn_status add_meeting(tn_frontier *frontier, uint32_t index, tn_error *error)
{
    const tn_meeting_record *m = &frontier->form->module->MEETING_records[index];
    tn_status status = add_decision(frontier, m->first, error);
    if (status == TN_OK)
        status = add_decision(frontier, m->second, error);
    return status == TN_OK && m->through != TN_NO_RECORD ? add_decision(frontier, m->through, error) : status;
}

/* ---- what clauses ask */

typedef struct tn_asking {
    tn_frontier *frontier;
    tn_frontier_clause *clause;
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
        return tn_frontier_limit(a->frontier, a->name, "asks for more than can be told apart at once", error);
    items[*at] = item;
    *count += *at == *count;
    return TN_OK;
}

static tn_status add_ratio(const tn_asking *a, int64_t ratio, tn_frontier_room *room, tn_error *error)
{
    tn_frontier_questions *q = &a->frontier->questions;
    uint32_t at = 0;
    while (at < q->ratio_count && q->ratios[at] != ratio)
        at++;
    if (at == TN_FRONTIER_RATIOS_MAX)
        return tn_frontier_limit(a->frontier, a->name, "asks for more ratios of glass than can be told apart at once",
                                 error);
    q->ratios[at] = ratio;
    q->ratio_count += at == q->ratio_count;
    room->ratios |= 1u << at;
    return TN_OK;
}

/* One instruction about a room. */
static tn_status add_room_part(const tn_asking *a, const tn_instruction *op, tn_frontier_room *room, tn_error *error)
{
    tn_frontier_questions *q = &a->frontier->questions;
    uint32_t at;
    tn_status status;
    tn_int128 most = (tn_int128)op->second * 1000000 + 1;
    switch (op->opcode) {
    case TN_OP_ALL_CELLS:
        status = find_or_add(a, q->all, &q->all_count, 64, (uint32_t)op->first, &at, error);
        room->all |= status == TN_OK ? UINT64_C(1) << at : 0;
        return status == TN_OK ? add_decision(a->frontier, (uint32_t)op->first, error) : status;
    case TN_OP_HAS_FACE:
        status = find_or_add(a, q->kinds, &q->kind_count, TN_FRONTIER_KINDS_MAX, (uint32_t)op->first, &at, error);
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
        return tn_frontier_limit(a->frontier, a->name, "asks for more than the cells, the faces and the area of rooms",
                                 error);
    }
}

static tn_status add_room(const tn_asking *a, uint32_t function, uint32_t *at, tn_error *error)
{
    tn_frontier_questions *q = &a->frontier->questions;
    const tn_module *module = a->frontier->form->module;
    for (*at = 0; *at < q->room_count; ++*at)
        if (q->rooms[*at].function == function)
            return TN_OK;
    if (q->room_count == TN_FRONTIER_QUESTIONS_MAX)
        return tn_frontier_limit(a->frontier, a->name, "is about more kinds of rooms than can be told apart at once",
                                 error);
    tn_frontier_room *room = &q->rooms[q->room_count++];
    *room = (tn_frontier_room){.function = function};
    tn_status status = TN_OK;
    for (uint32_t c = module->FUNCTION_records[function].code_begin;
         status == TN_OK && c < module->FUNCTION_records[function].code_end;) {
        tn_instruction op = tn_code_read(module->code, c);
        status = add_room_part(a, &op, room, error);
        c += op.length;
    }
    return status;
}

static tn_frontier_atom *find_atom(const tn_frontier_clause *clause, const tn_instruction *op)
{
    for (size_t i = 0; i < clause->atom_count; i++)
        if (clause->atoms[i].op.opcode == op->opcode && clause->atoms[i].op.first == op->first &&
            clause->atoms[i].op.second == op->second)
            return &clause->atoms[i];
    return NULL;
}

static tn_status add_atom(const tn_asking *a, const tn_instruction *op, uint32_t of, uint32_t radix, tn_error *error)
{
    tn_frontier_clause *clause = a->clause;
    if (find_atom(clause, op))
        return TN_OK;
    if (!tn_array_reserve_from(&clause->atoms, &clause->atom_room, 4, clause->atom_count, 1, sizeof *clause->atoms))
        return tn_fail_memory(error);
    clause->atoms[clause->atom_count++] = (tn_frontier_atom){.op = *op, .of = of, .radix = radix};
    if ((uint64_t)clause->radix * radix > TN_FRONTIER_LETTERS_MAX)
        return tn_frontier_limit(a->frontier, a->name, "asks for too much at once", error);
    clause->radix *= radix;
    return TN_OK;
}

/* The question that the atom asks is placed from now on. */
static tn_status place_atom(const tn_asking *a, tn_frontier_atom *atom, tn_error *error)
{
    tn_frontier_questions *q = &a->frontier->questions;
    atom->placed = true;
    if (atom->op.opcode != TN_OP_APART)
        return find_or_add(a, q->placed_rooms, &q->placed_count, TN_FRONTIER_PLACED_MAX, atom->of, &atom->place, error);
    q->placed_walks |= 1u << atom->of;
    return TN_OK;
}

/* It takes more to follow where in the row a room or a walk is than whether there is one, or how many there are. */
static bool is_placed(tn_opcode opcode, tn_relation_use use)
{
    return opcode == TN_OP_ROOMS ? use != TN_USE_WHOLE
                                 : use != TN_USE_SOMEWHERE && (opcode == TN_OP_SOME_ROOM || opcode == TN_OP_APART);
}

static tn_status see(void *context, const tn_instruction *op, tn_relation_use use, tn_error *error)
{
    const tn_asking *a = context;
    tn_frontier_questions *q = &a->frontier->questions;
    uint32_t of = 0, radix = 1, first = (uint32_t)op->first;
    bool late = op->opcode == TN_OP_APART;
    if (tn_code_compares_house(op->opcode)) /* the automaton has no other question about such a number */
        return use == TN_USE_WHOLE
                   ? add_atom(a, op, tn_frontier_compared(a->frontier, first), TN_FRONTIER_TRUTHS, error)
                   : tn_frontier_limit(a->frontier, a->name, "compares a number of the whole house within a part of it",
                                       error);
    tn_status status = TN_OK;
    switch (op->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        radix = op->opcode == TN_OP_ROOMS ? TN_FRONTIER_CELLS_MAX + 1 : 2;
        status = add_room(a, first, &of, error);
        break;
    case TN_OP_MEETS:
    case TN_OP_APART:
        radix = 2;
        status = late ? find_or_add(a, q->walks, &q->walk_count, TN_FRONTIER_MEETINGS_MAX, first, &of, error)
                      : find_or_add(a, q->meetings, &q->meeting_count, 64, first, &of, error);
        if (status == TN_OK)
            status = add_meeting(a->frontier, first, error);
        break;
    default:
        break;
    }
    if (status == TN_OK)
        status = add_atom(a, op, of, radix, error);
    return status == TN_OK && is_placed(op->opcode, use) ? place_atom(a, find_atom(a->clause, op), error) : status;
}

/* The rooms that a number counts. */
static tn_status ask_weights(tn_frontier *frontier, uint32_t number, tn_error *error)
{
    const tn_house_weights *w = frontier->added->of[number];
    tn_asking asking = {frontier, NULL, tn_text(frontier->form->module, w->of.name)};
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < w->count; i++)
        if (w->terms[i].kind == TN_HOUSE_ROOMS)
            status = add_room(&asking, w->terms[i].part, &frontier->compared.weighed_rooms[number][i], error);
    return status;
}

static tn_frontier_walk parts_of(const tn_frontier *frontier, uint32_t meeting)
{
    const tn_meeting_record *m = &frontier->form->module->MEETING_records[meeting];
    bool any = m->through == TN_NO_RECORD;
    return (tn_frontier_walk){decision_of(frontier, m->first), decision_of(frontier, m->second),
                              any ? 0 : decision_of(frontier, m->through), any};
}

/* The places of the decisions that rooms, meetings and walks ask for. */
static void place_decisions(tn_frontier *frontier)
{
    tn_frontier_questions *q = &frontier->questions;
    for (uint32_t i = 0; i < q->all_count; i++)
        q->all_decisions[i] = decision_of(frontier, q->all[i]);
    for (uint32_t m = 0; m < q->meeting_count; m++)
        q->meeting_parts[m] = parts_of(frontier, q->meetings[m]);
    for (uint32_t w = 0; w < q->walk_count; w++)
        q->walk_parts[w] = parts_of(frontier, q->walks[w]);
}

/* TN_LIMIT (E1640) if there are too many, or one that is not known here, with the clause. */
static tn_status find_questions(tn_frontier *frontier, tn_error *error)
{
    const tn_module *module = frontier->form->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < frontier->clause_count; i++) {
        tn_frontier_clause *clause = &frontier->clauses[i];
        const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[frontier->library->clause_first + i];
        tn_asking asking = {frontier, clause, tn_text(module, record->name)};
        status = tn_rule_uses(module, clause->holds, see, &asking, error);
    }
    for (uint32_t k = 0; status == TN_OK && k < frontier->added->count; k++)
        status = ask_weights(frontier, k, error);
    if (status == TN_OK)
        place_decisions(frontier);
    frontier->questions.answer_words = frontier->questions.decision_count / 64 + 1;
    return status;
}

/* ==== merging
 *
 * Merges what no completion can tell apart: edges that meet every neighbour alike, and cells for whose tiles it makes
 * no difference what stands at their left.
 *
 * The neighbours are found by a first pass over all states without tiles (tn_frontier.scouting). These states are few,
 * and they make every interface that the library's houses can have. */

static int compare_words(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* ---- edges */

/* An interface, for sorting: by its left edge, then its right one. */
typedef struct tn_interface_place {
    uint64_t edges; /* left << 32 | right */
    uint32_t interface;
} tn_interface_place;

static int compare_places(const void *a, const void *b)
{
    const tn_interface_place *p = a, *q = b;
    return (p->edges > q->edges) - (p->edges < q->edges);
}

/* Equal lists of outcomes have one number. */
static bool number_outcomes(tn_frontier *frontier, tn_interner *lists, const tn_frontier_list *list, uint32_t *number)
{
    tn_key *key = &frontier->key;
    bool ok = true;
    key->size = 0;
    for (size_t i = 0; ok && i < list->count; i++)
        ok = tn_key_push(key, list->items[i].slice) && tn_push_long(key, list->items[i].times);
    *number = ok ? tn_intern(lists, key->data, key->size) : UINT32_MAX;
    return *number != UINT32_MAX;
}

/* What is asked of an edge's cells later, when it is the left one. */
static bool push_asked(tn_frontier *frontier, const tn_frontier_edge *edge)
{
    bool ok = tn_key_push(&frontier->joined, edge->asked);
    for (uint32_t i = 0; ok && i < edge->count; i++)
        ok = tn_key_push(&frontier->joined, edge->cells[i].tiled);
    return ok;
}

/* places: all interfaces in order; *at: the first of the edge, then the first of another. */
static bool push_neighbours(tn_frontier *frontier, tn_interner *lists, uint32_t edge, const tn_interface_place *places,
                            size_t count, size_t *at)
{
    bool ok = true;
    for (; ok && *at < count && places[*at].edges >> 32 == edge; ++*at) {
        uint32_t list;
        ok = number_outcomes(frontier, lists, &frontier->interfaces.items[places[*at].interface], &list) &&
             tn_key_push(&frontier->joined, tn_low(places[*at].edges)) && tn_key_push(&frontier->joined, list);
    }
    return ok;
}

static bool merge_edges(tn_frontier *frontier)
{
    uint32_t edges = frontier->edges.keys.count, interfaces = frontier->interfaces.keys.count;
    tn_interface_place *places = malloc(((size_t)interfaces + 1) * sizeof *places);
    uint32_t *first = malloc(((size_t)edges + 1) * sizeof *first); /* of each class */
    frontier->merged.edges = malloc(((size_t)edges + 1) * sizeof *frontier->merged.edges);
    tn_interner classes = {0}, lists = {0};
    size_t at = 0;
    bool ok = places && first && frontier->merged.edges;
    for (uint32_t i = 0; ok && i < interfaces; i++)
        places[i] = (tn_interface_place){frontier->interfaces.keys.keys[i], i};
    if (ok)
        qsort(places, interfaces, sizeof *places, compare_places);
    for (uint32_t e = 0; ok && e < edges; e++) {
        uint32_t before = classes.count;
        frontier->joined.size = 0;
        ok = push_asked(frontier, &frontier->edges.items[e]) &&
             push_neighbours(frontier, &lists, e, places, interfaces, &at);
        uint32_t class = ok ? tn_intern(&classes, frontier->joined.data, frontier->joined.size) : UINT32_MAX;
        ok = class != UINT32_MAX;
        if (ok && class == before)
            first[class] = e;
        if (ok)
            frontier->merged.edges[e] = first[class];
    }
    tn_interner_clear(&classes);
    tn_interner_clear(&lists);
    free(places);
    free(first);
    return ok;
}

/* ---- what can stand at the right of a cell */

/* The number of a cell of an edge among the cells of all edges. */
static uint32_t *number_cells(const tn_frontier *frontier)
{
    uint32_t *first = malloc(((size_t)frontier->edges.keys.count + 1) * sizeof *first), count = 0;
    for (uint32_t e = 0; first && e < frontier->edges.keys.count; e++) {
        first[e] = count;
        count += frontier->edges.items[e].count;
    }
    return first;
}

/* seen: {cell of an edge, what stands at its right}. */
static bool see_interface(const tn_frontier *frontier, uint32_t interface, const uint32_t *cells, tn_numbering *seen)
{
    uint32_t left = tn_high(frontier->interfaces.keys.keys[interface]);
    const tn_frontier_list *list = &frontier->interfaces.items[interface];
    bool ok = true;
    for (size_t k = 0; ok && left != TN_FRONTIER_NONE && k < list->count; k++) {
        size_t size;
        const uint32_t *outcome = tn_interned(&frontier->outcomes.keys, list->items[k].slice, &size);
        const uint32_t *sides = outcome + 3 + (size_t)STEP_WORDS * outcome[2];
        for (uint32_t i = 0; ok && i < frontier->edges.items[left].count; i++)
            if (frontier->edges.items[left].cells[i].tiled)
                ok = tn_number(seen, (uint64_t)(cells[left] + i) << 32 | (sides[SIDE_WORDS * i + SIDE_FIT] - 1)) !=
                     UINT32_MAX;
    }
    return ok;
}

/* found: {base, what stands at its right}, of all slices whose cells are those. cell_bases: {cell of an edge, base}. */
static bool see_slices(const tn_frontier *frontier, const uint32_t *cells, tn_numbering *cell_bases)
{
    bool ok = true;
    for (uint32_t s = 0; ok && s < frontier->slices.keys.count; s++) {
        size_t size;
        const uint32_t *slice = tn_interned(&frontier->slices.keys, s, &size);
        const tn_frontier_edge *edge = &frontier->edges.items[slice[SLICE_EXIT]];
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
static bool list_sides(tn_frontier *frontier, tn_numbering *found)
{
    tn_frontier_merged *m = &frontier->merged;
    m->first = calloc((size_t)frontier->tiles.bases.count + 2, sizeof *m->first);
    m->sides = malloc(((size_t)found->count + 1) * sizeof *m->sides);
    if (!m->first || !m->sides)
        return false;
    if (found->count > 0)
        qsort(found->keys, found->count, sizeof *found->keys, compare_words);
    for (uint32_t i = 0; i < found->count; i++) {
        m->first[tn_high(found->keys[i]) + 1]++;
        m->sides[i] = tn_low(found->keys[i]);
    }
    for (uint32_t b = 0; b < frontier->tiles.bases.count; b++)
        m->first[b + 1] += m->first[b];
    return true;
}

static bool find_sides(tn_frontier *frontier)
{
    tn_numbering seen = {0}, cell_bases = {0}, found = {0};
    uint32_t *cells = number_cells(frontier);
    bool ok = cells && see_slices(frontier, cells, &cell_bases);
    for (uint32_t p = 0; ok && p < frontier->interfaces.keys.count; p++)
        ok = see_interface(frontier, p, cells, &seen);
    ok = ok && join(&cell_bases, &seen, &found) && list_sides(frontier, &found);
    free(cells);
    tn_numbering_clear(&seen);
    tn_numbering_clear(&cell_bases);
    tn_numbering_clear(&found);
    return ok;
}

void tn_frontier_forget_states(tn_frontier *frontier)
{
    tn_interner_clear(&frontier->states);
    tn_frontier_stages_forget(&frontier->stages);
    tn_frontier_ways_forget(frontier);
    free(frontier->ends);
    frontier->ends = NULL;
    frontier->end_room = 0;
}

tn_status tn_frontier_merge(tn_frontier *frontier, tn_error *error)
{
    frontier->scouting = false;
    tn_frontier_forget_states(frontier);
    return merge_edges(frontier) && find_sides(frontier) ? TN_OK : tn_fail_memory(error);
}

void tn_frontier_merged_clear(tn_frontier_merged *merged)
{
    free(merged->edges);
    free(merged->first);
    free(merged->sides);
    free(merged->of_pair);
    free(merged->one);
    tn_numbering_clear(&merged->pairs);
    tn_interner_clear(&merged->tiles);
}

/* ---- pending tiles: how many fit depends on what stands at the right of their cell */

static uint32_t common_divisor(uint32_t a, uint32_t b)
{
    while (b != 0) {
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* frontier->key := {what stands at the right, how many tiles fit}, for each side that can. */
static tn_status list_tiles(tn_frontier *frontier, uint32_t base, uint32_t left, tn_error *error)
{
    const tn_frontier_merged *m = &frontier->merged;
    tn_key *key = &frontier->key;
    tn_status status = TN_OK;
    key->size = 0;
    for (size_t i = m->first[base]; status == TN_OK && i < m->first[base + 1]; i++) {
        uint32_t tiles = 0;
        status = tn_frontier_fit(frontier, base, left, m->sides[i], &tiles, error);
        if (status == TN_OK && (!tn_key_push(key, m->sides[i]) || !tn_key_push(key, tiles)))
            status = tn_fail_memory(error);
    }
    return status;
}

/* Takes from the list at hand what all of its numbers are multiples of: 0 if no tile ever fits. A list of ones becomes
 * empty: nothing is pending. If tiles have prices, numbers are of lists of costs, and stay as they are. */
static uint32_t take_factor(const tn_frontier *frontier, tn_key *key)
{
    uint32_t factor = 0;
    bool ones = true;
    for (size_t i = 1; i < key->size; i += 2)
        factor = common_divisor(factor, key->data[i]);
    if (frontier->prices.items)
        return factor > 0;
    for (size_t i = 1; factor > 0 && i < key->size; i += 2) {
        key->data[i] /= factor;
        ones = ones && key->data[i] == 1;
    }
    key->size = ones ? 0 : key->size;
    return factor;
}

/* Equal lists are one class. */
static tn_status classify(tn_frontier *frontier, uint32_t base, uint32_t left, tn_frontier_cell_class *class_of,
                          tn_error *error)
{
    tn_frontier_merged *m = &frontier->merged;
    tn_status status = list_tiles(frontier, base, left, error);
    if (status != TN_OK)
        return status;
    uint32_t before = m->tiles.count, factor = take_factor(frontier, &frontier->key);
    *class_of = (tn_frontier_cell_class){.class = TN_FRONTIER_NONE};
    if (factor == 0)
        return TN_OK;
    bool ever = frontier->key.size > 0;
    uint32_t class = tn_intern(&m->tiles, frontier->key.data, frontier->key.size);
    if (class == UINT32_MAX || !tn_array_reserve(&m->one, &m->one_room, before, 1, sizeof *m->one))
        return tn_fail_memory(error);
    if (class == before)
        m->one[class] = (tn_frontier_one){base, left, factor};
    *class_of = (tn_frontier_cell_class){class, factor, ever};
    return TN_OK;
}

tn_status tn_frontier_pending_class(tn_frontier *frontier, uint32_t base, uint32_t left,
                                    tn_frontier_cell_class *class_of, tn_error *error)
{
    tn_frontier_merged *m = &frontier->merged;
    uint32_t before = m->pairs.count;
    if (!tn_array_reserve(&m->of_pair, &m->pair_room, before, 1, sizeof *m->of_pair))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&m->pairs, (uint64_t)base << 32 | left);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = at == before ? classify(frontier, base, left, &m->of_pair[at], error) : TN_OK;
    *class_of = status == TN_OK ? m->of_pair[at] : (tn_frontier_cell_class){.class = TN_FRONTIER_NONE};
    return status;
}

/* ==== making it ready
 *
 * The questions, then the slices of the trays, then the automata of the clauses. */

static void find_tiled(tn_frontier *frontier)
{
    const tn_house_form *form = frontier->form;
    for (uint32_t f = 0; tn_form_asks_ways(form) && f < tn_form_functions(form); f++)
        frontier->tiles.tiled[f] = frontier->tiles.any = true;
    for (uint32_t t = 0; t < form->record->tile_count; t++) {
        const tn_tile_record *tile = &form->module->TILE_records[form->record->tile_first + t];
        for (uint32_t i = 0; i < tile->purpose_count; i++)
            frontier->tiles.furnished[form->module->HOUSE_ITEM_records[tile->purpose_first + i].number] =
                frontier->tiles.tiled[form->module->HOUSE_ITEM_records[tile->purpose_first + i].number] =
                    frontier->tiles.any = true;
    }
}

static tn_status begin(tn_frontier *frontier, tn_error *error)
{
    const tn_house_form *form = frontier->form;
    frontier->slices.of_tray = calloc((size_t)form->schema->tray_count + 1, sizeof *frontier->slices.of_tray);
    frontier->slices.furnished = calloc((size_t)form->schema->tray_count + 1, sizeof *frontier->slices.furnished);
    frontier->tiles.tiled = calloc((size_t)form->record->rule_count + 1, sizeof *frontier->tiles.tiled);
    frontier->tiles.furnished = calloc((size_t)form->record->rule_count + 1, sizeof *frontier->tiles.furnished);
    frontier->questions.asked_function =
        calloc((size_t)tn_form_functions(form) + 1, sizeof *frontier->questions.asked_function);
    frontier->reading.scratch =
        calloc(2 * (size_t)frontier->library->clause_count + 1, sizeof *frontier->reading.scratch);
    frontier->reading.after_slice = calloc((size_t)frontier->trays_most + 1, sizeof *frontier->reading.after_slice);
    frontier->reading.after_interface =
        calloc((size_t)frontier->trays_most + 1, sizeof *frontier->reading.after_interface);
    if (!frontier->slices.of_tray || !frontier->slices.furnished || !frontier->tiles.tiled ||
        !frontier->tiles.furnished || !frontier->questions.asked_function || !frontier->reading.scratch ||
        !frontier->reading.after_slice || !frontier->reading.after_interface)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < frontier->added->count; k++) {
        frontier->compared.weighed_rooms[k] = calloc((size_t)frontier->added->of[k]->count + 1, sizeof(uint32_t));
        if (!frontier->compared.weighed_rooms[k])
            return tn_fail_memory(error);
    }
    find_tiled(frontier);
    tn_status status = tn_frontier_clauses_new(frontier, error);
    return status == TN_OK ? find_questions(frontier, error) : status;
}

tn_status tn_frontier_new(const tn_house_form *form, const tn_house_library_record *library, const uint32_t *shapes,
                          const tn_frontier_trays *trays, uint32_t trays_least, uint32_t trays_most,
                          const tn_house_measures *measures, const tn_house_added *added,
                          const tn_frontier_without *without, tn_frontier **out, tn_error *error)
{
    tn_frontier *frontier = *out = calloc(1, sizeof *frontier);
    if (!frontier)
        return tn_fail_memory(error);
    *frontier = (tn_frontier){.form = form,
                              .library = library,
                              .trays_least = trays_least,
                              .trays_most = trays_most,
                              .watch = form->module->watch,
                              .measures = measures,
                              .added = added,
                              .without = without};
    memcpy(frontier->shapes, shapes, form->record->choice_count * sizeof *shapes);
    tn_status status = begin(frontier, error);
    if (status == TN_OK)
        status = tn_frontier_prices_begin(frontier, error);
    if (status == TN_OK)
        status = tn_frontier_borders_find(frontier, trays, error);
    for (tn_tray t = 0; status == TN_OK && t < form->schema->tray_count; t++)
        if (trays->stand[t])
            status = tn_frontier_slices(frontier, t, error);
    if (status == TN_OK)
        status = tn_frontier_lower(frontier, error);
    frontier->without = NULL;
    return status;
}

static void clear_questions(tn_frontier_questions *questions)
{
    free(questions->decisions);
    free(questions->asked_function);
    tn_numbering_clear(&questions->fails);
    free(questions->open_rooms);
}

void tn_frontier_free(tn_frontier *frontier)
{
    if (!frontier)
        return;
    clear_questions(&frontier->questions);
    tn_frontier_clauses_free(frontier);
    tn_frontier_reading_clear(&frontier->reading, frontier->trays_most);
    tn_frontier_comparisons_clear(&frontier->compared);
    tn_frontier_edges_clear(&frontier->edges);
    tn_frontier_slices_clear(&frontier->slices, frontier->form->schema->tray_count);
    tn_frontier_interfaces_clear(&frontier->interfaces);
    tn_frontier_outcomes_clear(&frontier->outcomes);
    tn_frontier_tiles_clear(&frontier->tiles);
    tn_frontier_merged_clear(&frontier->merged);
    tn_frontier_sums_clear(&frontier->sums);
    tn_frontier_prices_clear(&frontier->prices);
    tn_interner_clear(&frontier->states);
    free(frontier->ends);
    tn_frontier_crossed_clear(&frontier->crossed);
    tn_frontier_ways_forget(frontier);
    tn_frontier_stages_clear(&frontier->stages);
    free(frontier->key.data);
    free(frontier->joined.data);
    free(frontier);
}

/* How many different things a clause keeps apart: its own states, and the rooms and walks that it asks for. */
static uint64_t kept_apart(const tn_frontier *frontier, const tn_frontier_clause *clause)
{
    uint64_t states = clause->dfa ? clause->dfa->states : 0;
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_opcode opcode = clause->atoms[i].op.opcode;
        states += opcode == TN_OP_APART                                ? frontier->crossed.walks.count
                  : opcode == TN_OP_SOME_ROOM || opcode == TN_OP_ROOMS ? frontier->crossed.rooms.count
                  : tn_code_compares_house(opcode)                     ? frontier->compared.totals.count
                                                                       : 0;
    }
    return states;
}

const char *tn_frontier_largest(const tn_frontier *frontier)
{
    const tn_module *module = frontier->form->module;
    const char *name = NULL;
    uint64_t most = 0;
    for (uint32_t i = 0; i < frontier->clause_count; i++) {
        uint64_t states = kept_apart(frontier, &frontier->clauses[i]);
        if (states > most)
            name = tn_text(module, module->HOUSE_CLAUSE_records[frontier->library->clause_first + i].name);
        most = states > most ? states : most;
    }
    return name;
}
