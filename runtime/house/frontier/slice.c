/* Makes the slices of a tray: its cells' functions and what is in its inner faces, one combination after another. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/ways.h"

/* A tray that is being cut: each wheel is a cell's functions or an inner face's kinds. */
typedef struct tn_cutting {
    tn_inside inside;
    tn_numbering found, furnished;
    tn_frontier_list *list;
    tn_frontier_ordered *ordered; /* if these are wanted, and no list */
    uint64_t tried;
    tn_frontier_cut *cells; /* [cells][functions + 1], as far as they are met; last: voids */
    uint64_t *answers;      /* of these */
    uint32_t functions;     /* of the cells, by number */
} tn_cutting;

typedef struct tn_options {
    uint32_t of, count, at;
    uint32_t items[TN_CELL_RULES_MAX > TN_FACE_KINDS_MAX ? TN_CELL_RULES_MAX : TN_FACE_KINDS_MAX];
    uint32_t times[TN_FACE_KINDS_MAX]; /* of a face: so many kinds are one */
} tn_options;

/* ---- limits */

/* Whatever plan the tray is in, it has as many. */
static tn_status too_large(const tn_cutting *c, const char *what, tn_error *error)
{
    tn_buffer text = {0};
    const tn_house_form *form = c->inside.frontier->form;
    bool written = tn_plan_write_line(form->schema, &c->inside.tray, 1, &text);
    tn_fail(error, TN_LIMIT, E_FRONTIER,
            "the tray `%.120s` has more than %s in form `%.60s`: its houses cannot be counted",
            written ? text.data : "", what, tn_text(form->module, form->record->name));
    tn_error_help(error, "leave fewer storeys, fewer functions that a cell may have, or fewer kinds for its faces");
    free(text.data);
    return TN_LIMIT;
}

static tn_status too_many(const tn_cutting *c, tn_error *error)
{
    return too_large(c, "2^64 choices", error);
}

/* ---- cells */

static tn_frontier_cut *cell_at(const tn_cutting *c, size_t cell)
{
    const tn_house *house = &c->inside.house;
    size_t functions = tn_form_functions(house->form), function = house->cells[cell].function;
    if (house->cells[cell].open)
        function = functions + tn_cell_is_outdoor(house, (uint32_t)cell);
    return &c->cells[cell * (functions + 2) + function];
}

static tn_status know_cell(tn_cutting *c, uint32_t i, tn_frontier_cut *cell, tn_error *error)
{
    tn_frontier *s = c->inside.frontier;
    for (size_t d = 0; d < s->questions.decision_count; d++)
        cell->answers[d / 64] |=
            (uint64_t)tn_house_decide(&c->inside.house, s->questions.decisions[d], &c->inside.house.cells[i]) << d % 64;
    tn_status status = tn_frontier_describe(s, &c->inside.house, i, &cell->description, error);
    cell->known = status == TN_OK;
    return status;
}

/* The cells have other functions now. */
static tn_status know_cells(tn_cutting *c, tn_error *error)
{
    tn_key *key = &c->inside.frontier->joined;
    tn_status status = TN_OK;
    key->size = 0;
    for (uint32_t i = 0; status == TN_OK && i < c->inside.house.cell_count; i++) {
        tn_frontier_cut *cell = cell_at(c, i);
        if (!cell->known)
            status = know_cell(c, i, cell, error);
        c->inside.cells[i] = cell;
        if (status == TN_OK && !tn_key_push(key, c->inside.house.cells[i].function))
            status = tn_fail_memory(error);
    }
    if (status != TN_OK)
        return status;
    c->functions = tn_intern(&c->inside.frontier->slices.functions, key->data, key->size);
    return c->functions != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status begin_cells(tn_cutting *c, tn_error *error)
{
    size_t count = c->inside.house.cell_count * ((size_t)tn_form_functions(c->inside.frontier->form) + 2);
    c->cells = calloc(count + 1, sizeof *c->cells);
    c->answers = calloc(count * c->inside.frontier->questions.answer_words + 1, sizeof *c->answers);
    if (!c->cells || !c->answers)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        c->cells[i].answers = c->answers + i * c->inside.frontier->questions.answer_words;
    return TN_OK;
}

/* ---- slices */

/* A word for each cell: 0, or 1 and what of its own walls matters to its tiles. */
static bool push_tiles(const tn_frontier_edge *edge, const uint32_t *cells, tn_key *key)
{
    bool ok = true;
    key->size = 0;
    for (uint32_t i = 0; ok && i < edge->count; i++)
        ok = tn_key_push(key, edge->cells[i].tiled ? cells[(size_t)CELL_WORDS * i + CELL_TILE] + 1 : 0);
    return ok;
}

/* What rooms and walks meet in a slice: its edge at the left, its cells, tiles left aside, their roles, its steps. */
static bool push_inside(const uint32_t *slice, const uint32_t *end, uint32_t count, tn_key *key)
{
    bool ok = true;
    key->size = 0;
    for (const uint32_t *word = slice; ok && word < end; word++) {
        size_t at = (size_t)(word - slice);
        bool tile = at >= SLICE_CELLS && at < SLICE_CELLS + (size_t)CELL_WORDS * count &&
                    (at - SLICE_CELLS) % CELL_WORDS == CELL_TILE;
        ok = tn_key_push(key, tile || at == SLICE_EXIT ? 0 : *word);
    }
    return ok;
}

static bool find_plain(tn_frontier *s, uint32_t slice)
{
    tn_frontier_slice *parts = &s->slices.items[slice];
    const uint32_t words[] = {parts->inside, parts->exit, parts->bases};
    uint32_t before = s->slices.plain_keys.count;
    if (!tn_array_reserve(&s->slices.plains, &s->slices.plain_room, before, 1, sizeof *s->slices.plains))
        return false;
    uint32_t at = tn_intern(&s->slices.plain_keys, words, sizeof words / sizeof *words);
    if (at == UINT32_MAX)
        return false;
    if (at == before)
        s->slices.plains[at] = slice;
    parts->plain = s->slices.plains[at];
    return true;
}

/* The parts of a new slice, whose key is `joined`. */
static bool keep_slice(tn_frontier *s, uint32_t slice)
{
    const uint32_t *words = s->joined.data, *cells = words + SLICE_CELLS;
    const tn_frontier_edge *edge = &s->edges.items[words[SLICE_ENTRY]];
    const uint32_t *steps = cells + (CELL_WORDS + (size_t)s->questions.walk_count) * edge->count;
    const uint32_t *bases = steps + 1 + (size_t)STEP_WORDS * *steps, *gains = bases + s->clause_count;
    tn_frontier_slice *parts = &s->slices.items[slice];
    *parts = (tn_frontier_slice){.entry = words[SLICE_ENTRY],
                                 .exit = words[SLICE_EXIT],
                                 .bases = tn_intern(&s->slices.bases, bases, s->clause_count)};
    parts->tiles = push_tiles(edge, cells, &s->key) ? tn_intern(&s->tiles.lists, s->key.data, s->key.size) : UINT32_MAX;
    if (!push_inside(words, bases, edge->count, &s->key))
        return false;
    parts->inside = tn_intern(&s->slices.insides, s->key.data, s->key.size);
    s->key.data[SLICE_ENTRY] = s->questions.placed_count > 0 ? edge->asked : 0;
    parts->met = tn_intern(&s->slices.mets, s->key.data, s->key.size);
    for (uint32_t k = 0; k < s->added->count; k++)
        parts->gains[k] = (int64_t)tn_both(gains + 2 * (size_t)k);
    parts->cost = s->prices.asked ? gains[2 * (size_t)s->added->count] : 0;
    return parts->bases != UINT32_MAX && parts->tiles != UINT32_MAX && parts->inside != UINT32_MAX &&
           parts->met != UINT32_MAX && find_plain(s, slice) && tn_frontier_find_group(s, slice);
}

/* Notes that cells with these functions can be the slice. */
static tn_status add_furnished(tn_cutting *c, uint32_t slice, uint64_t times, tn_error *error)
{
    tn_frontier_furnished_list *list = &c->inside.frontier->slices.furnished[c->inside.tray];
    uint32_t at = tn_number(&c->furnished, (uint64_t)c->functions << 32 | slice);
    if (at == UINT32_MAX || !tn_array_reserve_from(&list->items, &list->room, 8, at, 1, sizeof *list->items))
        return tn_fail_memory(error);
    if (at == list->count)
        list->items[list->count++] = (tn_frontier_furnished){c->functions, slice, 0};
    return __builtin_add_overflow(list->items[at].times, times, &list->items[at].times) ? too_many(c, error) : TN_OK;
}

/* What the tray adds to each number that is added up: two words each; last, if costs are asked for, their number. */
static tn_status push_gains(const tn_cutting *c, uint32_t cost, tn_key *key, tn_error *error)
{
    tn_frontier *s = c->inside.frontier;
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < s->added->count; k++) {
        int64_t tray = 0;
        if (k >= s->added->measures)
            status = tn_frontier_tray_adds(s, k, c->inside.house.trays[0], &tray, error);
        if (status == TN_OK &&
            !tn_push_long(key, (uint64_t)(tn_house_weights_cells(s->added->of[k], &c->inside.house) + tray)))
            status = tn_fail_memory(error);
    }
    return status == TN_OK && s->prices.asked && !tn_key_push(key, cost) ? tn_fail_memory(error) : status;
}

static tn_status push_slice(const tn_cutting *c, tn_key *key, tn_error *error)
{
    tn_frontier *s = c->inside.frontier;
    uint32_t entry = 0, exit = 0, base = 0, cost = 0;
    tn_status status = s->prices.asked ? tn_frontier_tray_cost(s, &c->inside.house, &cost, error) : TN_OK;
    if (status == TN_OK)
        status = tn_frontier_find_edge(&c->inside, TN_FRONTIER_ENTRY, cost, &entry, error);
    if (status == TN_OK)
        status = tn_frontier_find_edge(&c->inside, TN_FRONTIER_EXIT, cost, &exit, error);
    key->size = 0;
    if (status == TN_OK && (!tn_key_push(key, entry) || !tn_key_push(key, exit)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_frontier_push_inside(&c->inside, key, error);
    for (uint32_t i = 0; status == TN_OK && i < s->clause_count; i++) {
        status = tn_frontier_base(s, &s->clauses[i], &c->inside.house, &base, error);
        if (status == TN_OK && !tn_key_push(key, base))
            status = tn_fail_memory(error);
    }
    return status == TN_OK ? push_gains(c, cost, key, error) : status;
}

/* The slice that the house at hand is. */
static tn_status find_slice(const tn_cutting *c, uint32_t *slice, tn_error *error)
{
    tn_frontier *s = c->inside.frontier;
    tn_key *key = &s->joined;
    tn_status status = push_slice(c, key, error);
    uint32_t before = s->slices.keys.count;
    if (status != TN_OK)
        return status;
    if (before >= TN_FRONTIER_SLICES_MAX)
        return too_large(c, "200,000 choices that other cells, clauses or costs can tell apart", error);
    if (!tn_array_reserve(&s->slices.items, &s->slices.room, before, 1, sizeof *s->slices.items))
        return tn_fail_memory(error);
    *slice = tn_intern(&s->slices.keys, key->data, key->size);
    bool ok = *slice != UINT32_MAX && (*slice < before || keep_slice(s, *slice));
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status add_slice(tn_cutting *c, uint64_t times, tn_error *error)
{
    uint32_t slice = 0;
    tn_status status = find_slice(c, &slice, error);
    if (status != TN_OK)
        return status;
    if (c->ordered)
        return tn_frontier_ordered_add(c->ordered, slice) ? TN_OK : tn_fail_memory(error);
    uint32_t at = tn_number(&c->found, slice);
    if (at == UINT32_MAX || !tn_array_reserve_from(&c->list->items, &c->list->room, 8, at, 1, sizeof *c->list->items))
        return tn_fail_memory(error);
    if (at == c->list->count)
        c->list->items[c->list->count++] = (tn_frontier_choice){.slice = slice};
    if (__builtin_add_overflow(c->list->items[at].times, times, &c->list->items[at].times))
        return too_many(c, error);
    return add_furnished(c, slice, times, error);
}

/* ---- combinations */

static bool turn(tn_options *options, size_t count)
{
    for (size_t i = count; i-- > 0;) {
        if (++options[i].at < options[i].count)
            return true;
        options[i].at = 0;
    }
    return false;
}

/* Do people come in there, if the form asks for ways? */
static bool lets_pass(const tn_frontier *s, const tn_face *face, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_opening(s->form, kind);
    return tn_form_asks_ways(s->form) && opening && opening->flags & TN_PASSAGE && face->storey == 0;
}

/* Can a room of the cell tell one kind from the other? Walls have no openings, and are as thick as those that have. */
static bool tells_apart(const tn_cutting *c, const tn_face *face, const tn_room_open *open, uint32_t one,
                        uint32_t other)
{
    const tn_frontier *s = c->inside.frontier;
    const uint32_t kinds[2] = {one, other};
    uint64_t marks[2];
    tn_int128 glass[2];
    for (int k = 0; k < 2; k++) {
        tn_face with = *face;
        with.kind = kinds[k];
        if (kinds[k] != TN_FACE_WALL && !tn_form_opening(s->form, kinds[k]))
            return true;
        if (lets_pass(s, face, kinds[k]))
            return true;
        marks[k] = tn_frontier_marks(s, kinds[k]) & open->kinds;
        glass[k] = open->glass ? tn_face_glazing(&c->inside.house, &with) : 0;
    }
    return marks[0] != marks[1] || glass[0] != glass[1];
}

/* Kinds in an outside face at the back or the front that nothing tells apart become one, unless each slice is wanted by
 * itself. A void belongs to the room below it, which is not looked for here. */
static tn_status merge_kinds(const tn_cutting *c, const tn_face *face, tn_options *options, tn_error *error)
{
    tn_frontier *s = c->inside.frontier;
    const tn_cell *cell = &c->inside.house.cells[face->first];
    if (c->ordered || face->relation != TN_FACE_OUTSIDE || cell->open || s->prices.asked ||
        s->tiles.furnished[cell->function])
        return TN_OK;
    tn_room_open open;
    uint64_t fails = tn_frontier_answers_fail(s, c->inside.cells[face->first]->answers);
    tn_status status = tn_frontier_room_open(s, fails, &open, error);
    uint32_t kept = 0;
    for (uint32_t i = 0; status == TN_OK && i < options->count; i++) {
        uint32_t like = 0;
        while (like < kept && tells_apart(c, face, &open, options->items[like], options->items[i]))
            like++;
        if (like < kept) {
            options->times[like]++;
        } else {
            options->items[kept] = options->items[i];
            options->times[kept++] = 1;
        }
    }
    options->count = status == TN_OK ? kept : options->count;
    return status;
}

static tn_status face_options(const tn_cutting *c, uint32_t face, tn_options *options, tn_error *error)
{
    const tn_house *house = &c->inside.house;
    *options = (tn_options){.of = face};
    options->count = (uint32_t)tn_face_options(house, &house->faces[face], options->items);
    for (uint32_t i = 0; i < options->count; i++)
        options->times[i] = 1;
    return merge_kinds(c, &house->faces[face], options, error);
}

/* Sets the kinds that the wheels show, which stand for so many combinations. False: these are too many to count. */
static bool set_kinds(tn_cutting *c, const tn_options *options, size_t count, uint64_t *times)
{
    bool ok = true;
    *times = 1;
    for (size_t i = 0; i < count; i++) {
        c->inside.house.faces[options[i].of].kind = options[i].items[options[i].at];
        ok = ok && !__builtin_mul_overflow(*times, (uint64_t)options[i].times[options[i].at], times);
    }
    return ok;
}

static tn_status cut_faces(tn_cutting *c, tn_error *error)
{
    tn_options *options = malloc((c->inside.house.face_count + 1) * sizeof *options);
    size_t count = 0;
    if (!options)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < c->inside.house.face_count; i++)
        if (tn_face_is_inner(&c->inside.house.faces[i]))
            status = face_options(c, i, &options[count++], error);
    for (bool more = true; status == TN_OK && more; more = turn(options, count)) {
        uint64_t times;
        if (!set_kinds(c, options, count, &times))
            status = too_many(c, error);
        else if (++c->tried > TN_FRONTIER_CHOICES_MAX)
            status = too_large(c, "4,000,000 choices", error);
        else
            status = add_slice(c, times, error);
    }
    free(options);
    return status;
}

static tn_status cut_functions(tn_cutting *c, tn_error *error)
{
    const tn_house_form *form = c->inside.frontier->form;
    tn_options *options = malloc((c->inside.house.cell_count + 1) * sizeof *options);
    size_t count = 0;
    uint64_t ways = 1;
    bool possible = true;
    if (!options)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < c->inside.house.cell_count; i++) {
        if (c->inside.house.cells[i].open)
            continue;
        options[count] = (tn_options){.of = i};
        for (uint32_t f = 0; f < tn_form_functions(form); f++)
            if (tn_cell_may(&c->inside.house, &c->inside.house.cells[i], f))
                options[count].items[options[count].count++] = f;
        possible = possible && options[count].count > 0;
        ways = ways > TN_FRONTIER_FUNCTIONS_MAX ? ways : ways * options[count].count;
        count++;
    }
    tn_status status = TN_OK;
    if (ways > TN_FRONTIER_FUNCTIONS_MAX)
        status = too_large(c, "1,000,000 choices of functions", error);
    while (possible && status == TN_OK) {
        for (size_t i = 0; i < count; i++)
            c->inside.house.cells[options[i].of].function = options[i].items[options[i].at];
        status = know_cells(c, error);
        if (status == TN_OK)
            status = cut_faces(c, error);
        if (!turn(options, count))
            break;
    }
    free(options);
    return status;
}

static tn_status begin(tn_cutting *c, tn_error *error)
{
    const tn_frontier *frontier = c->inside.frontier;
    tn_status status = tn_house_stand(frontier->form, &c->inside.tray, 1, frontier->shapes, &c->inside.house, error);
    if (status == TN_OK && c->inside.house.cell_count > TN_FRONTIER_CELLS_MAX)
        status = too_large(c, "60 cells", error);
    return status == TN_OK ? begin_cells(c, error) : status;
}

static void end(tn_cutting *c)
{
    tn_house_clear(&c->inside.house);
    tn_numbering_clear(&c->found);
    tn_numbering_clear(&c->furnished);
    free(c->cells);
    free(c->answers);
}

/* A choice in the order of ways: by what its slice begins with. */
typedef struct tn_cut_choice {
    uint32_t entry, group;
    tn_frontier_choice choice;
} tn_cut_choice;

static int compare_cut(const void *a, const void *b)
{
    const tn_cut_choice *p = a, *q = b;
    return p->entry != q->entry   ? (p->entry > q->entry) - (p->entry < q->entry)
           : p->group != q->group ? (p->group > q->group) - (p->group < q->group)
                                  : (p->choice.slice > q->choice.slice) - (p->choice.slice < q->choice.slice);
}

static tn_status order_list(const tn_frontier *frontier, tn_frontier_list *list, tn_error *error)
{
    tn_cut_choice *cut = malloc((list->count + 1) * sizeof *cut);
    if (!cut)
        return tn_fail_memory(error);
    for (size_t i = 0; i < list->count; i++) {
        const tn_frontier_slice *slice = &frontier->slices.items[list->items[i].slice];
        cut[i] = (tn_cut_choice){slice->entry, slice->group, list->items[i]};
    }
    if (list->count > 0)
        qsort(cut, list->count, sizeof *cut, compare_cut);
    for (size_t i = 0; i < list->count; i++)
        list->items[i] = cut[i].choice;
    free(cut);
    return TN_OK;
}

tn_status tn_frontier_slices(tn_frontier *frontier, tn_tray tray, tn_error *error)
{
    tn_cutting c = {.inside = {.frontier = frontier, .tray = tray}, .list = &frontier->slices.of_tray[tray]};
    if (c.list->made)
        return TN_OK;
    c.list->made = true;
    tn_status status = begin(&c, error);
    if (status == TN_OK)
        status = cut_functions(&c, error);
    if (status == TN_OK)
        status = order_list(frontier, c.list, error);
    end(&c);
    return status;
}

tn_status tn_frontier_order_slices(tn_frontier *frontier, tn_tray tray, const tn_cell *like,
                                   tn_frontier_ordered *slices, tn_error *error)
{
    tn_cutting c = {.inside = {.frontier = frontier, .tray = tray}, .ordered = slices};
    tn_status status = begin(&c, error);
    for (size_t i = 0; status == TN_OK && i < c.inside.house.cell_count; i++)
        c.inside.house.cells[i].function = like[i].function;
    if (status == TN_OK)
        status = know_cells(&c, error);
    if (status == TN_OK)
        status = cut_faces(&c, error);
    end(&c);
    return status;
}

void tn_frontier_lists_free(tn_frontier_list *lists, size_t count)
{
    for (size_t i = 0; lists && i < count; i++)
        free(lists[i].items);
    free(lists);
}

void tn_frontier_slices_clear(tn_frontier_slices_made *slices, size_t trays)
{
    tn_interner *const interners[] = {&slices->keys, &slices->functions, &slices->bases,     &slices->insides,
                                      &slices->mets, &slices->areas,     &slices->plain_keys};
    for (size_t i = 0; i < sizeof interners / sizeof *interners; i++)
        tn_interner_clear(interners[i]);
    tn_frontier_lists_free(slices->of_tray, trays);
    for (size_t t = 0; slices->furnished && t < trays; t++)
        free(slices->furnished[t].items);
    free(slices->furnished);
    tn_frontier_orders_clear(&slices->orders);
    free(slices->items);
    free(slices->plains);
}

/* ==== in the order of houses
 *
 * Slices of a tray and outcomes of an interface in the order of houses, by the functions of their cells. They are
 * kept, as ranks ask for the same ones again and again. */

void tn_frontier_orders_clear(tn_frontier_orders *orders)
{
    for (uint32_t i = 0; i < orders->keys.count; i++) {
        free(orders->of[i].kinds);
        free(orders->of[i].items);
    }
    free(orders->of);
    tn_interner_clear(&orders->keys);
    *orders = (tn_frontier_orders){0};
}

void tn_frontier_orders_trim(tn_frontier *frontier)
{
    enum { ITEMS_MOST = 1 << 20 }; /* 4 MB */
    tn_frontier_orders *const both[] = {&frontier->slices.orders, &frontier->outcomes.orders};
    for (size_t i = 0; i < 2; i++)
        if (both[i]->items > ITEMS_MOST)
            tn_frontier_orders_clear(both[i]);
}

/* ---- what is in a sequence */

/* kinds := what is in the items, once each. */
static void find_kinds(tn_frontier_sequence *s)
{
    memcpy(s->kinds, s->items, s->count * sizeof *s->kinds);
    qsort(s->kinds, s->count, sizeof *s->kinds, tn_words_compare);
    for (size_t i = 0; i < s->count; i++)
        if (i == 0 || s->kinds[i] != s->kinds[s->kind_count - 1])
            s->kinds[s->kind_count++] = s->kinds[i];
}

/* Takes the items over; each becomes the place of what it is. */
static tn_status make_sequence(const tn_frontier_ordered *ordered, tn_frontier_sequence *s, tn_error *error)
{
    uint32_t *kinds = malloc((ordered->count + 1) * sizeof *kinds);
    if (!kinds)
        return tn_fail_memory(error);
    *s = (tn_frontier_sequence){.kinds = kinds, .items = ordered->items, .count = ordered->count};
    if (s->count > 0)
        find_kinds(s);
    for (size_t i = 0; i < s->count; i++) {
        const uint32_t *kind = bsearch(&s->items[i], s->kinds, s->kind_count, sizeof *kind, tn_words_compare);
        s->items[i] = (uint32_t)(kind - s->kinds);
    }
    return TN_OK;
}

/* ---- what is asked for */

/* *at: the place of what the key asks for, to which the functions of so many cells are added. */
static tn_status place_of(tn_frontier_orders *orders, tn_key *key, const tn_cell *cells, size_t count, uint32_t *at,
                          tn_error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++)
        ok = tn_key_push(key, cells[i].function);
    uint32_t before = orders->keys.count;
    if (!ok || !tn_array_reserve(&orders->of, &orders->room, before, 1, sizeof *orders->of))
        return tn_fail_memory(error);
    *at = tn_intern(&orders->keys, key->data, key->size);
    if (*at == UINT32_MAX)
        return tn_fail_memory(error);
    if (*at == before)
        orders->of[before] = (tn_frontier_sequence){0};
    return TN_OK;
}

/* Keeps what was found, if it was; owns the items. */
static tn_status keep(tn_frontier_orders *orders, uint32_t at, tn_status status, const tn_frontier_ordered *found,
                      tn_error *error)
{
    if (status == TN_OK)
        status = make_sequence(found, &orders->of[at], error);
    if (status == TN_OK)
        orders->items += found->count;
    else
        free(found->items);
    return status;
}

tn_status tn_frontier_slices_ordered(tn_frontier *frontier, tn_tray tray, const tn_cell *like, size_t cells,
                                     tn_frontier_sequence *slices, tn_error *error)
{
    tn_frontier_orders *orders = &frontier->slices.orders;
    uint32_t at;
    frontier->joined.size = 0;
    if (!tn_key_push(&frontier->joined, tray))
        return tn_fail_memory(error);
    tn_status status = place_of(orders, &frontier->joined, like, cells, &at, error);
    if (status == TN_OK && !orders->of[at].kinds) {
        tn_frontier_ordered found = {0};
        status = tn_frontier_order_slices(frontier, tray, like, &found, error);
        status = keep(orders, at, status, &found, error);
    }
    if (status == TN_OK)
        *slices = orders->of[at];
    return status;
}

static size_t cells_of(const tn_frontier *frontier, uint32_t edge)
{
    return edge == TN_FRONTIER_NONE ? 0 : frontier->edges.items[edge].count;
}

tn_status tn_frontier_outcomes_ordered(tn_frontier *frontier, uint32_t left, uint32_t right, const tn_cell *like,
                                       tn_frontier_sequence *outcomes, tn_error *error)
{
    tn_frontier_orders *orders = &frontier->outcomes.orders;
    size_t cells = cells_of(frontier, left) + cells_of(frontier, right);
    uint32_t at;
    frontier->joined.size = 0;
    if (!tn_key_push(&frontier->joined, left) || !tn_key_push(&frontier->joined, right))
        return tn_fail_memory(error);
    tn_status status = place_of(orders, &frontier->joined, like, cells, &at, error);
    if (status == TN_OK && !orders->of[at].kinds) {
        tn_frontier_ordered found = {0};
        status = tn_frontier_order_outcomes(frontier, left, right, like, &found, error);
        status = keep(orders, at, status, &found, error);
    }
    if (status == TN_OK)
        *outcomes = orders->of[at];
    return status;
}
