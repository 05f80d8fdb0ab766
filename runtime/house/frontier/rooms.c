/* Rooms: what they can tell of the inside of a tray, how they go on from tray to tray, and where in the row they began.
 *
 * ==== inside a tray
 *
 * Insides that rooms cannot tell apart are written down alike.
 *
 * Of a cell only that is kept which a question about its room can still depend on. A room that cannot go on across the
 * interfaces beside the tray, and of which nothing is seen there, is known here: only the questions that it answers are
 * kept. Those that answer none are as good as one. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/rule/outcome.h"

/* The rooms of the tray by their first cells. */
typedef struct tn_inside_rooms {
    const tn_inside *in;
    uint32_t *of; /* [cells] */
    tn_whole_room whole[TN_FRONTIER_CELLS_MAX];
    tn_room_open open[TN_FRONTIER_CELLS_MAX];
    bool goes_on[TN_FRONTIER_CELLS_MAX];
    uint32_t truth[TN_FRONTIER_CELLS_MAX];
    uint32_t nothing; /* the first cell of a room that answers no question */
} tn_inside_rooms;

/* The kinds in the inner faces of a cell, as far as rooms ask for them. */
static uint64_t inner_marks(const tn_inside *in, uint32_t cell)
{
    uint64_t marks = 0;
    for (size_t i = 0; i < in->house.face_count; i++) {
        const tn_face *face = &in->house.faces[i];
        if (tn_face_is_inner(face) && (face->first == cell || face->second == cell))
            marks |= tn_frontier_marks(in->frontier, face->kind);
    }
    return marks;
}

/* What is glazed in its outside faces at the back and the front. */
static tn_int128 inner_glass(const tn_inside *in, uint32_t cell)
{
    tn_int128 glass = 0;
    for (size_t i = 0; i < in->house.face_count; i++)
        if (tn_face_is_inner(&in->house.faces[i]) && tn_face_sheltered(&in->house, &in->house.faces[i]) == cell)
            glass += tn_face_glazing(&in->house, &in->house.faces[i]);
    return glass;
}

static tn_status find_open_rooms(tn_inside_rooms *r, tn_error *error)
{
    const tn_inside *in = r->in;
    uint32_t count = (uint32_t)in->house.cell_count;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < count; i++)
        if (!in->house.cells[i].open)
            r->whole[r->of[i]].fails |= tn_frontier_answers_fail(in->frontier, in->cells[i]->answers);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        if (r->of[i] == i)
            status = tn_frontier_room_open(in->frontier, r->whole[i].fails, &r->open[i], error);
    return status;
}

/* Can the interface at a side of the cell tell more of its room? If it is asked where rooms are, it always may. */
static bool is_seen(const tn_inside_rooms *r, tn_frontier_role_at role, uint32_t cell)
{
    const tn_frontier_reach *reach = tn_inside_reach(r->in, role, cell);
    const tn_room_open *open = &r->open[r->of[cell]];
    return r->in->frontier->questions.placed_count > 0 || reach->open || reach->marks & open->kinds ||
           (open->glass && reach->glazed);
}

static void gather(tn_inside_rooms *r)
{
    const tn_inside *in = r->in;
    for (uint32_t i = 0; i < in->house.cell_count; i++) {
        uint32_t room = r->of[i];
        const tn_room_open *open = &r->open[room];
        tn_whole_room *whole = &r->whole[room];
        if (!open->any && in->frontier->questions.placed_count == 0)
            continue;
        whole->kinds |= open->kinds ? inner_marks(in, i) & open->kinds : 0;
        whole->glass += open->glass ? inner_glass(in, i) : 0;
        whole->area += open->area && !in->house.cells[i].open ? tn_cell_area(&in->house.cells[i]) : 0;
        whole->cells += !in->house.cells[i].open;
        r->goes_on[room] = r->goes_on[room] || is_seen(r, TN_FRONTIER_ENTRY, i) || is_seen(r, TN_FRONTIER_EXIT, i);
    }
    r->nothing = TN_FRONTIER_NONE;
    for (uint32_t i = 0; i < in->house.cell_count; i++) {
        uint32_t room = r->of[i];
        if (room == i && r->open[i].any && !r->goes_on[i])
            r->truth[i] = tn_frontier_room_truth(in->frontier, &r->whole[i]);
        if (!r->goes_on[room] && r->truth[room] == 0 && r->nothing == TN_FRONTIER_NONE)
            r->nothing = i;
    }
}

/* What is known of the room as a whole stands at its first cell. */
static tn_status push_cell(const tn_inside_rooms *r, uint32_t cell, tn_key *key, tn_error *error)
{
    const tn_inside *in = r->in;
    tn_frontier *frontier = in->frontier;
    const tn_cell *at = &in->house.cells[cell];
    uint32_t base = 0, room = r->of[cell];
    tn_whole_room own = {0};
    if (tn_frontier_fills(frontier, &in->house, cell)) {
        tn_status status = tn_frontier_fit_base(frontier, &in->house, cell, &base, error);
        if (status != TN_OK)
            return status;
    }
    if (r->goes_on[room] && room == cell)
        own = r->whole[cell];
    uint32_t is = !r->goes_on[room] ? ROOM_IS_KNOWN
                  : at->open        ? ROOM_IS_VOID
                                    : ROOM_GOES_ON,
             to = r->goes_on[room] || r->truth[room] ? room : r->nothing;
    uint32_t area = tn_frontier_number_area(frontier, own.area), glass = tn_frontier_number_area(frontier, own.glass);
    bool ok = area != UINT32_MAX && glass != UINT32_MAX && tn_key_push(key, base) && tn_key_push(key, area) &&
              tn_key_push(key, glass) && tn_push_long(key, own.kinds) && tn_push_long(key, own.fails) &&
              tn_key_push(key, to) && tn_key_push(key, is) && tn_key_push(key, r->truth[room]);
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_frontier_push_inside(const tn_inside *in, tn_key *key, tn_error *error)
{
    tn_inside_rooms r = {.in = in};
    tn_status status = tn_house_rooms(&in->house, &r.of, error);
    if (status == TN_OK)
        status = find_open_rooms(&r, error);
    if (status == TN_OK)
        gather(&r);
    for (uint32_t i = 0; status == TN_OK && i < in->house.cell_count; i++)
        status = push_cell(&r, i, key, error);
    free(r.of);
    if (status == TN_OK && !tn_frontier_push_walks(in, key))
        status = tn_fail_memory(error);
    return status;
}

/* ==== from tray to tray
 *
 * Follows rooms from tray to tray: which cells at the interface are in one room, and what is known of it.
 *
 * What is known only grows, so a question that is decided stays decided, and the rest is forgotten as soon as no open
 * question needs it. */

/* known, truth: a bit for each question. fails: of `all`, what some cell of the room is not. */
typedef struct tn_known_room {
    uint64_t known, truth, fails, kinds;
    tn_int128 area;
    tn_int128 balance[TN_FRONTIER_RATIOS_MAX]; /* glass times the one number of a ratio, less floor times the other */
    uint32_t cells;
} tn_known_room;

enum { ROOM_WORDS = sizeof(tn_known_room) / sizeof(uint32_t) };

/* The rooms after an interface: the number of each right cell's room, and where each is among those joined. */
typedef struct tn_rooms_after {
    uint32_t of_cell[TN_FRONTIER_CELLS_MAX], roots[TN_FRONTIER_CELLS_MAX], count;
} tn_rooms_after;

/* The rooms of the left edge, then those that begin with a cell of the right one. */
typedef struct tn_joining {
    const tn_frontier *frontier;
    uint32_t parent[2 * TN_FRONTIER_CELLS_MAX];
    tn_known_room rooms[2 * TN_FRONTIER_CELLS_MAX];
    tn_frontier_place places[2 * TN_FRONTIER_CELLS_MAX]; /* where in the row it is asked for */
    uint32_t held[TN_FRONTIER_PLACED_MAX];               /* slots of the rooms before */
    uint32_t before;
} tn_joining;

static uint32_t root_of(tn_joining *j, uint32_t room)
{
    while (j->parent[room] != room)
        room = j->parent[room] = j->parent[j->parent[room]];
    return room;
}

static void join(tn_joining *j, uint32_t a, uint32_t b)
{
    a = root_of(j, a);
    b = root_of(j, b);
    if (a == b)
        return;
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    tn_known_room *to = &j->rooms[low], *from = &j->rooms[high];
    j->parent[high] = low;
    to->known |= from->known;
    to->truth |= from->truth;
    to->fails |= from->fails;
    to->kinds |= from->kinds;
    to->area += from->area;
    to->cells += from->cells;
    for (uint32_t r = 0; r < j->frontier->questions.ratio_count; r++)
        to->balance[r] += from->balance[r];
    if (j->frontier->questions.placed_count > 0)
        tn_frontier_place_join(j->frontier, &j->places[low], &j->places[high]);
}

/* ---- questions */

typedef struct tn_asked_known {
    const tn_frontier_questions *questions;
    const tn_known_room *room;
    bool whole; /* nothing is added to the room any more */
} tn_asked_known;

static uint64_t bit_of(const uint32_t *items, uint32_t count, uint32_t item)
{
    for (uint32_t i = 0; i < count; i++)
        if (items[i] == item)
            return UINT64_C(1) << i;
    return 0;
}

/* Of a number that only grows: what it is compared with cannot be undone. */
static tn_outcome compare(tn_int128 number, const tn_instruction *op, bool whole)
{
    bool now = tn_area_compares(number, op->first, op->second);
    bool above = number > (tn_int128)op->second * 1000000;
    return whole || above                         ? (now ? TN_OUTCOME_TRUE : TN_OUTCOME_FALSE)
           : op->first == TN_AREA_AT_LEAST && now ? TN_OUTCOME_TRUE
           : op->first == TN_AREA_LESS && !now    ? TN_OUTCOME_FALSE
                                                  : TN_OUTCOME_OPEN;
}

static tn_outcome glazing(const tn_asked_known *a, const tn_instruction *op)
{
    uint32_t r = 0;
    while (a->questions->ratios[r] != op->second)
        r++;
    return !a->whole                                             ? TN_OUTCOME_OPEN
           : tn_area_compares(a->room->balance[r], op->first, 0) ? TN_OUTCOME_TRUE
                                                                 : TN_OUTCOME_FALSE;
}

static tn_outcome ask(const void *context, const tn_instruction *op)
{
    enum { SQUARE_MICROMETRE = 1000000 };
    const tn_asked_known *a = context;
    const tn_frontier_questions *q = a->questions;
    switch (op->opcode) {
    case TN_OP_EVERY:
        return TN_OUTCOME_TRUE;
    case TN_OP_ALL_CELLS:
        return a->room->fails & bit_of(q->all, q->all_count, (uint32_t)op->first) ? TN_OUTCOME_FALSE
               : a->whole                                                         ? TN_OUTCOME_TRUE
                                                                                  : TN_OUTCOME_OPEN;
    case TN_OP_HAS_FACE:
        return a->room->kinds & bit_of(q->kinds, q->kind_count, (uint32_t)op->first) ? TN_OUTCOME_TRUE
               : a->whole                                                            ? TN_OUTCOME_FALSE
                                                                                     : TN_OUTCOME_OPEN;
    case TN_OP_ROOM_GLAZING:
        return glazing(a, op);
    case TN_OP_ROOM_AREA:
        return compare(a->room->area, op, a->whole);
    case TN_OP_ROOM_CELLS:
        return compare((tn_int128)a->room->cells * SQUARE_MICROMETRE, op, a->whole);
    default:
        return TN_OUTCOME_FALSE;
    }
}

/* Decides what can be decided, and forgets what is not needed for the rest. */
static void settle(const tn_frontier *frontier, tn_known_room *room, bool whole)
{
    const tn_frontier_questions *q = &frontier->questions;
    tn_asked_known asked = {q, room, whole};
    uint64_t all = 0, kinds = 0;
    uint32_t ratios = 0;
    bool area = false, cells = false;
    for (uint32_t i = 0; i < q->room_count; i++) {
        if (room->known >> i & 1)
            continue;
        tn_outcome outcome = tn_outcome_decide(frontier->form->module, q->rooms[i].function, ask, &asked);
        room->known |= (uint64_t)(outcome != TN_OUTCOME_OPEN) << i;
        room->truth |= (uint64_t)(outcome == TN_OUTCOME_TRUE) << i;
        if (outcome != TN_OUTCOME_OPEN)
            continue;
        all |= q->rooms[i].all;
        kinds |= q->rooms[i].kinds;
        ratios |= q->rooms[i].ratios;
        area |= q->rooms[i].area;
        cells |= q->rooms[i].cells;
    }
    room->fails &= all;
    room->kinds &= kinds;
    for (uint32_t r = 0; r < q->ratio_count; r++)
        room->balance[r] = ratios >> r & 1 ? room->balance[r] : 0;
    room->area = !area ? 0 : room->area > q->area_most ? q->area_most : room->area;
    room->cells = !cells ? 0 : room->cells > q->cells_most ? q->cells_most : room->cells;
}

/* ---- what can be asked at all */

uint64_t tn_frontier_answers_fail(const tn_frontier *frontier, const uint64_t *answers)
{
    uint64_t fails = 0;
    for (uint32_t i = 0; i < frontier->questions.all_count; i++)
        fails |= (uint64_t)!tn_answers(answers, frontier->questions.all_decisions[i]) << i;
    return fails;
}

uint64_t tn_frontier_fails(const tn_frontier *frontier, const tn_frontier_edge *edge, uint32_t cell)
{
    while (edge->cells[cell].open) /* a void is of the room below it; cells of a stack follow one another upwards */
        cell--;
    return tn_frontier_answers_fail(frontier, tn_edge_answers(frontier, edge, cell));
}

static void find_open(const tn_frontier *frontier, uint64_t fails, tn_room_open *open)
{
    const tn_frontier_questions *q = &frontier->questions;
    tn_known_room room = {.fails = fails};
    const tn_asked_known asked = {q, &room, false};
    *open = (tn_room_open){0};
    for (uint32_t i = 0; i < q->room_count; i++) {
        tn_outcome outcome = tn_outcome_decide(frontier->form->module, q->rooms[i].function, ask, &asked);
        open->any = open->any || outcome != TN_OUTCOME_FALSE;
        if (outcome != TN_OUTCOME_OPEN)
            continue;
        open->kinds |= q->rooms[i].kinds;
        open->area = open->area || q->rooms[i].area || q->rooms[i].ratios != 0;
        open->glass = open->glass || q->rooms[i].ratios != 0;
    }
}

tn_status tn_frontier_room_open(tn_frontier *frontier, uint64_t fails, tn_room_open *open, tn_error *error)
{
    uint32_t before = frontier->questions.fails.count;
    if (!tn_array_reserve(&frontier->questions.open_rooms, &frontier->questions.open_room, before, 1,
                          sizeof *frontier->questions.open_rooms))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&frontier->questions.fails, fails);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    if (at == before)
        find_open(frontier, fails, &frontier->questions.open_rooms[at]);
    *open = frontier->questions.open_rooms[at];
    return TN_OK;
}

/* ---- an interface */

tn_int128 tn_frontier_area(const tn_frontier *frontier, uint32_t number)
{
    size_t size;
    const uint32_t *words = tn_interned(&frontier->slices.areas, number, &size);
    tn_int128 area = 0;
    for (size_t i = 0; i < 4; i++)
        area |= (tn_int128)words[i] << 32 * i;
    return area;
}

/* Glass, less the floor that it is held against. */
static void add_balance(const tn_frontier *frontier, tn_known_room *room, tn_int128 glass, tn_int128 floor)
{
    for (uint32_t r = 0; r < frontier->questions.ratio_count; r++) {
        int64_t ratio = frontier->questions.ratios[r];
        room->balance[r] += glass * (ratio & UINT32_MAX) - floor * (ratio >> 32);
    }
}

uint32_t tn_frontier_number_area(tn_frontier *frontier, tn_int128 area)
{
    uint32_t words[4];
    for (size_t i = 0; i < 4; i++)
        words[i] = (uint32_t)(area >> 32 * i);
    return tn_intern(&frontier->slices.areas, words, 4);
}

static uint64_t all_questions(const tn_frontier *frontier)
{
    return (UINT64_C(1) << frontier->questions.room_count) - 1;
}

uint32_t tn_frontier_room_truth(const tn_frontier *frontier, const tn_whole_room *whole)
{
    tn_known_room room = {.fails = whole->fails, .kinds = whole->kinds, .area = whole->area, .cells = whole->cells};
    add_balance(frontier, &room, whole->glass, whole->area);
    settle(frontier, &room, true);
    return (uint32_t)room.truth;
}

static void begin_cell(tn_joining *j, const tn_frontier_crossing *c, uint32_t cell, const uint32_t *side)
{
    const uint32_t *words = c->slice + SLICE_CELLS + CELL_WORDS * cell;
    uint32_t room = j->before + cell;
    tn_known_room *known = &j->rooms[room];
    memset(known, 0, sizeof *known); /* padding too: rooms are compared as words */
    j->parent[room] = room;
    if (j->frontier->questions.placed_count > 0)
        tn_frontier_place_new(j->frontier, &j->places[room]);
    known->kinds = tn_both(side + SIDE_MARKS) | tn_both(words + CELL_MARKS);
    known->fails = tn_both(words + CELL_FAILS);
    if (words[CELL_ROOM_IS] == ROOM_IS_KNOWN) {
        known->known = all_questions(j->frontier);
        known->truth = words[CELL_TRUTH];
    }
    tn_int128 area = tn_frontier_area(j->frontier, words[CELL_AREA]);
    add_balance(j->frontier, known,
                tn_frontier_area(j->frontier, words[CELL_GLASS]) + tn_frontier_area(j->frontier, side[SIDE_GLASS]),
                area);
    known->area = area;
    known->cells = words[CELL_ROOM_IS] == ROOM_GOES_ON;
}

static void load_place(tn_joining *j, uint32_t room, const uint32_t *words)
{
    if (j->frontier->questions.placed_count == 0)
        return;
    tn_frontier_place_load(j->frontier, words, &j->places[room]);
    for (uint32_t p = 0; p < j->frontier->questions.placed_count; p++)
        if (j->places[room].slots[p] > 0)
            j->held[p] |= 1u << (j->places[room].slots[p] - 1);
}

/* The rooms before, with the faces of their last cells. */
static void begin_left(tn_joining *j, const tn_frontier_crossing *c, const uint32_t *state, const uint32_t *sides)
{
    uint32_t cells = c->left ? c->left->count : 0;
    size_t each = ROOM_WORDS + tn_frontier_place_words(j->frontier);
    j->before = c->left ? state[cells] : 0;
    for (uint32_t r = 0; r < j->before; r++) {
        const uint32_t *words = state + cells + 1 + r * each;
        j->parent[r] = r;
        memcpy(&j->rooms[r], words, sizeof j->rooms[r]);
        load_place(j, r, words + ROOM_WORDS);
    }
    for (uint32_t i = 0; i < cells; i++) {
        j->rooms[state[i]].kinds |= tn_both(sides + SIDE_WORDS * i + SIDE_MARKS);
        add_balance(j->frontier, &j->rooms[state[i]], tn_frontier_area(j->frontier, sides[SIDE_WORDS * i + SIDE_GLASS]),
                    0);
    }
}

/* Rooms that are nothing that is asked for become one: what is joined to one of them is nothing of that, either. Not if
 * it is asked where rooms are: then each begins somewhere. */
static void settle_all(const tn_frontier *frontier, tn_joining *j, uint32_t cells)
{
    uint64_t all = all_questions(frontier);
    uint32_t nothing = UINT32_MAX;
    for (uint32_t i = 0; i < cells; i++) {
        uint32_t root = root_of(j, j->before + i);
        settle(frontier, &j->rooms[root], false);
        if (j->rooms[root].known != all || j->rooms[root].truth != 0)
            continue;
        if (nothing == UINT32_MAX)
            nothing = root;
        join(j, nothing, root);
    }
}

/* Numbers the rooms of the right cells by the first cell in each, and settles them. */
static void number_rooms(tn_joining *j, uint32_t cells, tn_rooms_after *to)
{
    uint32_t number[2 * TN_FRONTIER_CELLS_MAX];
    memset(number, 0xff, sizeof number);
    if (j->frontier->questions.placed_count == 0)
        settle_all(j->frontier, j, cells);
    to->count = 0;
    for (uint32_t i = 0; i < cells; i++) {
        uint32_t root = root_of(j, j->before + i);
        if (number[root] == UINT32_MAX) {
            to->roots[to->count] = root;
            number[root] = to->count++;
            settle(j->frontier, &j->rooms[root], false);
        }
        to->of_cell[i] = number[root];
    }
}

/* seen: of the questions that ask where rooms are. */
static void go_on(tn_joining *j, const tn_frontier_edge *right, const tn_rooms_after *to, uint32_t *seen)
{
    tn_frontier_going rooms[TN_FRONTIER_CELLS_MAX];
    for (uint32_t r = 0; r < to->count; r++) {
        const tn_known_room *known = &j->rooms[to->roots[r]];
        rooms[r] = (tn_frontier_going){.place = &j->places[to->roots[r]], .open = ~known->known | known->truth};
    }
    for (uint32_t i = 0; right && i < right->count; i++)
        if (!right->cells[i].open)
            rooms[to->of_cell[i]].function = right->cells[i].function;
    tn_frontier_places_go_on(j->frontier, rooms, to->count, j->held, seen);
}

static bool push_words(tn_key *key, const uint32_t *words, size_t count)
{
    bool ok = true;
    for (size_t w = 0; ok && w < count; w++)
        ok = tn_key_push(key, words[w]);
    return ok;
}

static tn_status number_after(tn_frontier *frontier, tn_joining *j, const tn_rooms_after *to, uint32_t cells,
                              uint32_t *after, tn_error *error)
{
    tn_key *key = &frontier->key;
    key->size = 0;
    bool ok = push_words(key, to->of_cell, cells) && tn_key_push(key, to->count);
    for (uint32_t r = 0; ok && r < to->count; r++) {
        const tn_frontier_place *place = &j->places[to->roots[r]];
        uint32_t words[ROOM_WORDS];
        memcpy(words, &j->rooms[to->roots[r]], sizeof words);
        ok = push_words(key, words, ROOM_WORDS);
        if (ok && frontier->questions.placed_count > 0)
            ok = tn_key_push(key, place->age) && push_words(key, place->slots, frontier->questions.placed_count);
    }
    *after = ok ? tn_intern(&frontier->crossed.rooms, key->data, key->size) : UINT32_MAX;
    return *after != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* Rooms without a cell at the right of the interface are whole. */
static void close_rooms(tn_frontier *frontier, tn_joining *j, uint32_t cells, uint32_t *closed)
{
    bool live[2 * TN_FRONTIER_CELLS_MAX] = {false};
    for (uint32_t i = 0; i < cells; i++)
        live[root_of(j, j->before + i)] = true;
    for (uint32_t r = 0; r < j->before; r++) {
        if (j->parent[r] != r || live[r])
            continue;
        settle(frontier, &j->rooms[r], true);
        for (uint32_t q = 0; q < frontier->questions.room_count; q++)
            closed[q] += j->rooms[r].truth >> q & 1;
        tn_frontier_place_end(frontier, &j->places[r], j->rooms[r].truth, closed + frontier->questions.room_count);
    }
}

tn_status tn_frontier_rooms_cross(tn_frontier *frontier, uint32_t before, const tn_frontier_crossing *c,
                                  uint32_t *after, uint32_t *closed, tn_error *error)
{
    size_t size;
    const tn_frontier_questions *q = &frontier->questions;
    memset(closed, 0, (q->room_count + (size_t)q->placed_count * SEEN_WORDS) * sizeof *closed);
    tn_joining j; /* large, and filled in as far as it is used */
    tn_rooms_after to;
    j.frontier = frontier;
    memset(j.held, 0, sizeof j.held);
    uint32_t left = c->left ? c->left->count : 0, right = c->right ? c->right->count : 0;
    const uint32_t *steps = c->outcome + 3, *sides = steps + (size_t)STEP_WORDS * c->outcome[2];
    begin_left(&j, c, c->left ? tn_interned(&frontier->crossed.rooms, before, &size) : NULL, sides);
    const uint32_t *state = c->left ? tn_interned(&frontier->crossed.rooms, before, &size) : NULL;
    for (uint32_t i = 0; i < right; i++)
        begin_cell(&j, c, i, sides + SIDE_WORDS * (left + i));
    for (uint32_t i = 0; i < right; i++)
        join(&j, j.before + i, j.before + c->slice[SLICE_CELLS + CELL_WORDS * i + CELL_ROOM]);
    for (uint32_t i = 0; i < c->outcome[2]; i++, steps += STEP_WORDS)
        if (steps[STEP_HOW] & 1)
            join(&j, state[steps[STEP_FROM]], j.before + steps[STEP_TO]);
    close_rooms(frontier, &j, right, closed);
    number_rooms(&j, right, &to);
    if (q->placed_count > 0)
        go_on(&j, c->right, &to, closed + q->room_count);
    return number_after(frontier, &j, &to, right, after, error);
}

/* ---- what the right side of an interface can tell of the rooms before it */

/* Appends the steps into rooms before, with these by number, in the order of the steps. */
static bool push_joined(const uint32_t *state, const uint32_t *outcome, uint32_t number[TN_FRONTIER_CELLS_MAX],
                        uint32_t joined[TN_FRONTIER_CELLS_MAX], uint32_t *count, tn_key *key)
{
    const uint32_t *step = outcome + 3;
    bool ok = true;
    memset(number, 0xff, TN_FRONTIER_CELLS_MAX * sizeof *number);
    *count = 0;
    for (uint32_t i = 0; ok && i < outcome[2]; i++, step += STEP_WORDS) {
        if (!(step[STEP_HOW] & 1))
            continue;
        uint32_t room = state[step[STEP_FROM]];
        if (number[room] == UINT32_MAX) {
            joined[*count] = room;
            number[room] = (*count)++;
        }
        ok = tn_key_push(key, step[STEP_TO]) && tn_key_push(key, number[room]);
    }
    return ok && tn_key_push(key, *count);
}

/* Rooms that no step leads into are whole: of these, only how many are so for each question. */
static bool push_closed(const tn_frontier *frontier, tn_joining *j, const uint32_t *number, tn_key *key)
{
    uint32_t closed[TN_FRONTIER_QUESTIONS_MAX] = {0};
    for (uint32_t r = 0; r < j->before; r++) {
        if (number[r] != UINT32_MAX)
            continue;
        settle(frontier, &j->rooms[r], true);
        for (uint32_t q = 0; q < frontier->questions.room_count; q++)
            closed[q] += j->rooms[r].truth >> q & 1;
    }
    return push_words(key, closed, frontier->questions.room_count);
}

tn_status tn_frontier_rooms_view(const tn_frontier *frontier, uint32_t before, const tn_frontier_edge *left,
                                 const uint32_t *outcome, tn_key *key, tn_error *error)
{
    size_t size;
    uint32_t number[TN_FRONTIER_CELLS_MAX], joined[TN_FRONTIER_CELLS_MAX], count;
    const uint32_t *state = tn_interned(&frontier->crossed.rooms, before, &size);
    const tn_frontier_crossing c = {.left = left, .outcome = outcome};
    tn_joining j; /* large, and filled in as far as it is used */
    j.frontier = frontier;
    begin_left(&j, &c, state, outcome + 3 + (size_t)STEP_WORDS * outcome[2]);
    bool ok = push_joined(state, outcome, number, joined, &count, key);
    for (uint32_t i = 0; ok && i < count; i++) {
        uint32_t words[ROOM_WORDS];
        settle(frontier, &j.rooms[joined[i]], false);
        memcpy(words, &j.rooms[joined[i]], sizeof words);
        ok = push_words(key, words, ROOM_WORDS);
    }
    return ok && push_closed(frontier, &j, number, key) ? TN_OK : tn_fail_memory(error);
}

/* ---- how many rooms of one tray a question can be about */

/* most: the greatest number so far. Nothing depends on the glass of a room that is not whole. */
static void look_at_slice(tn_frontier *frontier, uint32_t slice, uint32_t *most)
{
    static const uint32_t unseen[SIDE_WORDS] = {0};
    size_t size;
    const uint32_t *words = tn_interned(&frontier->slices.keys, slice, &size);
    const tn_frontier_crossing c = {.right = &frontier->edges.items[words[SLICE_ENTRY]], .slice = words};
    const tn_frontier_questions *q = &frontier->questions;
    tn_joining j;
    tn_rooms_after to;
    j.frontier = frontier;
    j.before = 0;
    for (uint32_t i = 0; i < c.right->count; i++)
        begin_cell(&j, &c, i, unseen);
    for (uint32_t i = 0; i < c.right->count; i++)
        join(&j, i, words[SLICE_CELLS + CELL_WORDS * i + CELL_ROOM]);
    number_rooms(&j, c.right->count, &to);
    for (uint32_t p = 0; p < q->placed_count; p++) {
        uint32_t count = 0;
        for (uint32_t r = 0; r < to.count; r++) {
            const tn_known_room *known = &j.rooms[to.roots[r]];
            count += (~known->known | known->truth) >> q->placed_rooms[p] & 1;
        }
        most[p] = count > most[p] ? count : most[p];
    }
}

void tn_frontier_rooms_at_once(tn_frontier *frontier, uint32_t most[TN_FRONTIER_PLACED_MAX])
{
    memset(most, 0, TN_FRONTIER_PLACED_MAX * sizeof *most);
    for (uint32_t s = 0; frontier->questions.placed_count > 0 && s < frontier->slices.keys.count; s++)
        look_at_slice(frontier, s, most);
}

/* ==== where in the row they began
 *
 * Follows where in the row rooms began, for the questions that ask where they are.
 *
 * That a room is what a question asks for is known when it ends. Until then its beginning has a slot: the clauses are
 * told of each tray which slot begins with it, which go on, and which end with a room that is so (clause.c). Rooms that
 * began with one tray share their slot. Rooms that meet were one from the start: the older beginning is theirs, and so
 * it has to be known which of two that can meet is older, but not by how much. Only rooms of one function can meet. */

/* Ages that are greater than all others: of rooms that began with the tray before the interface, and with the tray
 * after it. What is known of a room does not tell the second from rooms that no question is open of. */
#define FRESH (UINT32_MAX - 1)
#define NOT_YET UINT32_MAX

void tn_frontier_place_new(const tn_frontier *frontier, tn_frontier_place *place)
{
    place->age = NOT_YET;
    memset(place->slots, 0, frontier->questions.placed_count * sizeof *place->slots);
}

void tn_frontier_place_load(const tn_frontier *frontier, const uint32_t *words, tn_frontier_place *place)
{
    place->age = words[0] == NOT_YET ? FRESH : words[0];
    memcpy(place->slots, words + 1, frontier->questions.placed_count * sizeof *place->slots);
}

void tn_frontier_place_join(const tn_frontier *frontier, tn_frontier_place *to, const tn_frontier_place *from)
{
    if (from->age >= to->age)
        return;
    to->age = from->age;
    memcpy(to->slots, from->slots, frontier->questions.placed_count * sizeof *to->slots);
}

void tn_frontier_place_end(const tn_frontier *frontier, const tn_frontier_place *place, uint64_t truth, uint32_t *seen)
{
    const tn_frontier_questions *q = &frontier->questions;
    for (uint32_t p = 0; p < q->placed_count; p++, seen += SEEN_WORDS) {
        if (!(truth >> q->placed_rooms[p] & 1))
            continue;
        uint32_t *slot = place->age == FRESH ? NULL : &seen[SEEN_SLOTS + place->slots[p] - 1];
        if (slot)
            *slot = *slot >= SLOT_ENDS ? *slot + 1 : SLOT_ENDS;
        else
            seen[SEEN_FIRST]++;
    }
}

/* ---- rooms that go on */

static uint32_t free_slot(uint32_t held)
{
    uint32_t slot = 0;
    while (held >> slot & 1)
        slot++;
    return slot;
}

/* Of one question: which slots go on, and which begins. */
static void give_slots(const tn_frontier *frontier, const tn_frontier_going *rooms, uint32_t count, uint32_t placed,
                       uint32_t held, uint32_t *seen)
{
    uint32_t question = frontier->questions.placed_rooms[placed], slot = free_slot(held);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t age = rooms[i].place->age, *own = &rooms[i].place->slots[placed];
        if (!(rooms[i].open >> question & 1) || age == NOT_YET)
            *own = 0;
        else if (age == FRESH)
            *own = slot + 1;
        if (*own > TN_FRONTIER_SLOTS_MAX)
            seen[SEEN_FIRST] = SEEN_TOO_MANY;
        else if (*own > 0 && age == FRESH)
            seen[SEEN_SLOTS + slot] = SLOT_BEGINS;
        else if (*own > 0 && seen[SEEN_SLOTS + *own - 1] == SLOT_OFF)
            seen[SEEN_SLOTS + *own - 1] = SLOT_ON;
    }
}

static bool is_open(const tn_frontier *frontier, const tn_frontier_going *room)
{
    uint64_t asked = 0;
    for (uint32_t p = 0; p < frontier->questions.placed_count; p++)
        asked |= UINT64_C(1) << frontier->questions.placed_rooms[p];
    return (room->open & asked) != 0;
}

/* How many beginnings before that of the room are told apart. ages: of all rooms. */
static uint32_t rank_of(const tn_frontier_going *rooms, const uint32_t *ages, uint32_t count, uint32_t room)
{
    uint32_t rank = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool first = rooms[i].function == rooms[room].function && ages[i] < ages[room];
        for (uint32_t k = 0; first && k < i; k++)
            first = rooms[k].function != rooms[i].function || ages[k] != ages[i];
        rank += first;
    }
    return rank;
}

void tn_frontier_places_go_on(const tn_frontier *frontier, const tn_frontier_going *rooms, uint32_t count,
                              const uint32_t *held, uint32_t *seen)
{
    uint32_t ages[TN_FRONTIER_CELLS_MAX];
    for (uint32_t p = 0; p < frontier->questions.placed_count; p++)
        give_slots(frontier, rooms, count, p, held[p], seen + (size_t)SEEN_WORDS * p);
    for (uint32_t i = 0; i < count; i++)
        ages[i] = is_open(frontier, &rooms[i]) ? rooms[i].place->age : NOT_YET;
    for (uint32_t i = 0; i < count; i++)
        rooms[i].place->age = ages[i] == NOT_YET ? NOT_YET : rank_of(rooms, ages, count, i);
}
