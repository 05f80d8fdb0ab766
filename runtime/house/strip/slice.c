/* Makes the slices of a tray: its cells' functions and what is in its inner faces, one combination after another. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/solids.h"
#include "runtime/house/strip/parts.h"

/* A tray that is being cut: each wheel is a cell's functions or an inner face's kinds. */
typedef struct tn_cutting {
    tn_strip *strip;
    tn_tray tray;
    tn_house house; /* of this tray alone */
    tn_numbering found;
    tn_strip_list *list;
    uint64_t tried;
} tn_cutting;

typedef struct tn_options {
    uint32_t of, count, at;
    uint32_t items[TN_CELL_RULES_MAX > TN_FACE_KINDS_MAX ? TN_CELL_RULES_MAX : TN_FACE_KINDS_MAX];
} tn_options;

static bool is_inner(const tn_face *face)
{
    return face->relation == TN_FACE_UNDER || face->side == TN_HOUSE_BACK || face->side == TN_HOUSE_FRONT;
}

/* ---- edges */

static bool push_cells(tn_cutting *c, tn_key *key)
{
    tn_strip *s = c->strip;
    bool ok = tn_key_push(key, (uint32_t)c->house.cell_count);
    for (size_t i = 0; ok && i < c->house.cell_count; i++) {
        const tn_cell *cell = &c->house.cells[i];
        ok = tn_push_long(key, (uint64_t)cell->at.y0) && tn_push_long(key, (uint64_t)cell->at.y1) &&
             tn_key_push(key, cell->storey << 1 | cell->open) && tn_key_push(key, cell->function);
        for (size_t w = 0; ok && w < s->answer_words; w++) {
            uint64_t word = 0;
            for (size_t d = 64 * w; d < s->questions.decision_count && d < 64 * w + 64; d++)
                word |= (uint64_t)tn_house_decide(&c->house, s->questions.decisions[d], cell) << d % 64;
            ok = tn_push_long(key, word);
        }
    }
    return ok;
}

/* Walls across end at the planes on both sides of the tray. */
static bool push_ends(tn_cutting *c, tn_key *key)
{
    bool ok = true;
    for (size_t i = 0; ok && i < c->house.face_count; i++) {
        const tn_face *face = &c->house.faces[i];
        int64_t thick = face->relation == TN_FACE_UNDER || !is_inner(face) ? 0 : tn_face_thickness(&c->house, face);
        if (thick > 0)
            ok = tn_key_push(key, face->storey) && tn_push_long(key, (uint64_t)face->at.y0) &&
                 tn_push_long(key, (uint64_t)thick);
    }
    return ok;
}

/* The first cell that has the function of this one. */
static uint32_t first_alike(const tn_strip_edge *edge, size_t cell)
{
    uint32_t i = 0;
    while (edge->cells[i].open || edge->cells[i].function != edge->cells[cell].function)
        i++;
    return i;
}

/* Numbers what is asked of the cells of the edge. */
static uint32_t number_asked(tn_strip *s, const tn_strip_edge *edge)
{
    bool ok = true;
    s->key.size = 0;
    for (size_t i = 0; ok && i < edge->count; i++) {
        ok = tn_key_push(&s->key, edge->cells[i].open);
        if (ok && s->questions.placed_count > 0 && !edge->cells[i].open)
            ok = tn_key_push(&s->key, first_alike(edge, i));
        for (size_t w = 0; ok && w < s->answer_words; w++)
            ok = tn_push_long(&s->key, edge->answers[i * s->answer_words + w]);
    }
    return ok ? tn_intern(&s->asked, s->key.data, s->key.size) : UINT32_MAX;
}

/* Lower roofs, which may stand before openings of the trays beside. */
static bool push_roofs(const tn_cutting *c, tn_key *key)
{
    uint32_t storeys = c->strip->form->record->storey_count;
    bool ok = true;
    for (uint32_t i = 0; ok && i < c->house.cell_count; i++) {
        const tn_cell *cell = &c->house.cells[i];
        const tn_shape_record *shape = tn_house_shape(&c->house, cell->zone, TN_CHOICE_ROOF);
        if (cell->storey + 1 == storeys || !tn_cell_is_top(&c->house, i))
            continue;
        bool across = shape && shape->flags & TN_ROOF_ACROSS;
        ok = tn_key_push(key, shape ? (uint32_t)shape->roof : TN_ROOF_FLAT) &&
             tn_key_push(key, shape ? (uint32_t)shape->rise : 0) &&
             tn_key_push(key, shape ? (uint32_t)shape->run : 0) &&
             tn_push_long(key, shape ? (uint64_t)shape->height : 0) &&
             tn_push_long(key, across ? (uint64_t)(cell->at.x1 - cell->at.x0) : 0);
    }
    return ok;
}

/* The edge's cells, read back from its key; what is in the inner faces, from the house at hand. */
static bool keep_edge(tn_cutting *c, tn_strip_edge *edge)
{
    tn_strip *s = c->strip;
    size_t count = c->house.cell_count;
    *edge = (tn_strip_edge){.tray = c->tray, .count = (uint32_t)count};
    edge->cells = malloc((count + 1) * sizeof *edge->cells);
    edge->answers = malloc((count * s->answer_words + 1) * sizeof *edge->answers);
    edge->inner = malloc((c->house.face_count + 1) * sizeof *edge->inner);
    if (!edge->cells || !edge->answers || !edge->inner)
        return false;
    const uint32_t *words = s->key.data + 1;
    for (size_t i = 0; i < count; i++, words += 6 + 2 * s->answer_words) {
        const tn_cell *cell = &c->house.cells[i];
        edge->cells[i] = (tn_strip_cell){cell->at.y0,    cell->at.y1, cell->storey,
                                         cell->function, cell->open,  !cell->open && s->tiled[cell->function]};
        for (size_t w = 0; w < s->answer_words; w++)
            edge->answers[i * s->answer_words + w] = tn_both(words + 6 + 2 * w);
    }
    for (size_t i = 0; i < c->house.face_count; i++)
        if (is_inner(&c->house.faces[i]))
            edge->inner[edge->inner_count++] = c->house.faces[i].kind;
    edge->asked = number_asked(s, edge);
    return edge->asked != UINT32_MAX;
}

/* What the costs of planes beside the tray depend on. */
static tn_status find_shape(tn_cutting *c, uint32_t *shape, tn_error *error)
{
    tn_strip_prices *p = &c->strip->prices;
    p->key.size = 0;
    bool ok = tn_strip_push_shape(c->strip, &c->house, &p->key) && push_ends(c, &p->key);
    *shape = ok ? tn_intern(&p->shapes, p->key.data, p->key.size) : UINT32_MAX;
    return *shape != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static tn_status find_edge(tn_cutting *c, uint32_t cost, uint32_t *edge, tn_error *error)
{
    tn_strip *s = c->strip;
    uint32_t before = s->edge_keys.count, shape = 0;
    tn_status status = s->prices.asked ? find_shape(c, &shape, error) : TN_OK;
    s->key.size = 0;
    if (status != TN_OK)
        return status;
    if (!push_cells(c, &s->key) || !push_ends(c, &s->key) || !push_roofs(c, &s->key) ||
        (s->prices.asked && !tn_key_push(&s->key, shape)))
        return tn_fail_memory(error);
    if (!tn_array_reserve(&s->edges, &s->edge_room, before, 1, sizeof *s->edges))
        return tn_fail_memory(error);
    *edge = tn_intern(&s->edge_keys, s->key.data, s->key.size);
    if (*edge == UINT32_MAX)
        return tn_fail_memory(error);
    if (*edge < before)
        return TN_OK;
    bool kept = keep_edge(c, &s->edges[*edge]);
    s->edges[*edge].shape = shape;
    s->edges[*edge].cost = cost;
    return kept ? TN_OK : tn_fail_memory(error);
}

/* ---- slices */

/* The kinds in the inner faces of a cell, as far as rooms ask for them. */
static uint64_t inner_marks(const tn_cutting *c, uint32_t cell)
{
    uint64_t marks = 0;
    for (size_t i = 0; i < c->house.face_count; i++) {
        const tn_face *face = &c->house.faces[i];
        if (is_inner(face) && (face->first == cell || face->second == cell))
            marks |= tn_strip_marks(c->strip, face->kind);
    }
    return marks;
}

static uint32_t area_of(tn_cutting *c, uint32_t i)
{
    const tn_cell *cell = &c->house.cells[i];
    bool asked = c->strip->questions.area_most > 0 || tn_strip_sees_glass(c->strip, &c->house, i);
    return tn_strip_number_area(c->strip, asked && !cell->open ? tn_cell_area(cell) : 0);
}

/* What is glazed in its outside faces at the back and the front, if any question depends on that. */
static uint32_t inner_glass(tn_cutting *c, uint32_t cell)
{
    tn_int128 glass = 0;
    bool asked = tn_strip_sees_glass(c->strip, &c->house, cell);
    for (size_t i = 0; asked && i < c->house.face_count; i++)
        if (is_inner(&c->house.faces[i]) && c->house.faces[i].first == cell)
            glass += tn_face_glazing(&c->house, &c->house.faces[i]);
    return tn_strip_number_area(c->strip, glass);
}

static tn_status push_inner_cells(tn_cutting *c, tn_key *key, tn_error *error)
{
    uint32_t *rooms = NULL;
    tn_status status = tn_house_rooms(&c->house, &rooms, error);
    for (uint32_t i = 0; status == TN_OK && i < c->house.cell_count; i++) {
        uint32_t base = 0;
        if (!c->house.cells[i].open && c->strip->tiled[c->house.cells[i].function])
            status = tn_strip_fit_base(c->strip, &c->house, i, &base, error);
        uint32_t area = area_of(c, i), glass = inner_glass(c, i);
        if (status == TN_OK &&
            (area == UINT32_MAX || glass == UINT32_MAX || !tn_key_push(key, base) || !tn_key_push(key, area) ||
             !tn_key_push(key, glass) || !tn_push_long(key, inner_marks(c, i)) || !tn_key_push(key, rooms[i])))
            status = tn_fail_memory(error);
    }
    free(rooms);
    return status;
}

static bool push_inner_steps(tn_cutting *c, tn_key *key)
{
    size_t at = key->size;
    bool ok = tn_key_push(key, 0);
    for (size_t i = 0; ok && i < c->house.face_count; i++) {
        const tn_face *face = &c->house.faces[i];
        uint32_t how = 0;
        for (uint32_t w = 0; face->second != TN_NO_CELL && w < c->strip->questions.walk_count; w++)
            how |= (uint32_t)tn_strip_steps(c->strip, &c->house, face, w) << (w + 1);
        if (how == 0)
            continue;
        ok = tn_key_push(key, face->first) && tn_key_push(key, face->second) && tn_key_push(key, how);
        key->data[at]++;
    }
    return ok;
}

/* A word for each cell: 0, or 1 and what of its own walls matters to its tiles. */
static bool push_tiles(const tn_strip_edge *edge, const uint32_t *cells, tn_key *key)
{
    bool ok = true;
    key->size = 0;
    for (uint32_t i = 0; ok && i < edge->count; i++)
        ok = tn_key_push(key, edge->cells[i].tiled ? cells[(size_t)CELL_WORDS * i + CELL_TILE] + 1 : 0);
    return ok;
}

/* What rooms and walks meet in a slice: its edge, then its cells, tiles left aside, and its steps. */
static bool push_inside(const uint32_t *slice, const uint32_t *end, uint32_t count, tn_key *key)
{
    bool ok = true;
    key->size = 0;
    for (const uint32_t *word = slice; ok && word < end; word++) {
        size_t at = (size_t)(word - slice);
        bool tile = at >= SLICE_CELLS && at < SLICE_CELLS + (size_t)CELL_WORDS * count &&
                    (at - SLICE_CELLS) % CELL_WORDS == CELL_TILE;
        ok = tn_key_push(key, tile ? 0 : *word);
    }
    return ok;
}

/* The parts of a new slice, whose key is `joined`. */
static bool keep_slice(tn_strip *s, uint32_t slice)
{
    const uint32_t *words = s->joined.data, *cells = words + SLICE_CELLS;
    const tn_strip_edge *edge = &s->edges[words[SLICE_EDGE]];
    const uint32_t *steps = cells + (size_t)CELL_WORDS * edge->count;
    const uint32_t *bases = steps + 1 + (size_t)STEP_WORDS * *steps, *gains = bases + s->clause_count;
    tn_strip_slice *parts = &s->slices[slice];
    *parts = (tn_strip_slice){.edge = words[SLICE_EDGE], .bases = tn_intern(&s->letters, bases, s->clause_count)};
    parts->tiles = push_tiles(edge, cells, &s->key) ? tn_intern(&s->fit_lists, s->key.data, s->key.size) : UINT32_MAX;
    if (!push_inside(words, bases, edge->count, &s->key))
        return false;
    parts->inside = tn_intern(&s->insides, s->key.data, s->key.size);
    s->key.data[SLICE_EDGE] = edge->asked;
    parts->met = tn_intern(&s->mets, s->key.data, s->key.size);
    for (uint32_t k = 0; k < s->added->count; k++)
        parts->gains[k] = (int64_t)tn_both(gains + 2 * (size_t)k);
    parts->cost = s->prices.asked ? gains[2 * (size_t)s->added->count] : 0;
    return parts->bases != UINT32_MAX && parts->tiles != UINT32_MAX && parts->inside != UINT32_MAX &&
           parts->met != UINT32_MAX;
}

/* The slice that the house at hand is. */
static tn_status add_slice(tn_cutting *c, tn_error *error)
{
    tn_strip *s = c->strip;
    uint32_t edge = 0, base = 0, cost = 0;
    tn_status status = s->prices.asked ? tn_strip_tray_cost(s, &c->house, &cost, error) : TN_OK;
    if (status == TN_OK)
        status = find_edge(c, cost, &edge, error);
    tn_key *key = &s->joined;
    key->size = 0;
    if (status == TN_OK && !tn_key_push(key, edge))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = push_inner_cells(c, key, error);
    if (status == TN_OK && !push_inner_steps(c, key))
        status = tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < s->clause_count; i++) {
        status = tn_strip_base(s, &s->clauses[i], &c->house, &base, error);
        if (status == TN_OK && !tn_key_push(key, base))
            status = tn_fail_memory(error);
    }
    for (uint32_t k = 0; status == TN_OK && k < s->added->count; k++) {
        int64_t tray = 0;
        if (k >= s->added->measures)
            status = tn_strip_tray_adds(s, k, c->house.trays[0], &tray, error);
        if (status == TN_OK &&
            !tn_push_long(key, (uint64_t)(tn_house_weights_cells(s->added->of[k], &c->house) + tray)))
            status = tn_fail_memory(error);
    }
    if (status == TN_OK && s->prices.asked && !tn_key_push(key, cost))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    uint32_t before = s->slice_keys.count;
    if (!tn_array_reserve(&s->slices, &s->slice_room, before, 1, sizeof *s->slices))
        return tn_fail_memory(error);
    uint32_t slice = tn_intern(&s->slice_keys, key->data, key->size);
    if (slice == before && !keep_slice(s, slice))
        return tn_fail_memory(error);
    uint32_t at = slice == UINT32_MAX ? UINT32_MAX : tn_number(&c->found, slice);
    if (at == UINT32_MAX || !tn_array_reserve_from(&c->list->items, &c->list->room, 8, at, 1, sizeof *c->list->items))
        return tn_fail_memory(error);
    if (at == c->list->count)
        c->list->items[c->list->count++] = (tn_strip_choice){.slice = slice};
    c->list->items[at].times++;
    return TN_OK;
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

static tn_status cut_faces(tn_cutting *c, tn_error *error)
{
    tn_options *options = malloc((c->house.face_count + 1) * sizeof *options);
    size_t count = 0;
    if (!options)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < c->house.face_count; i++) {
        if (!is_inner(&c->house.faces[i]))
            continue;
        options[count] = (tn_options){.of = i};
        options[count].count = (uint32_t)tn_face_options(&c->house, &c->house.faces[i], options[count].items);
        count++;
    }
    tn_status status = TN_OK;
    do {
        for (size_t i = 0; i < count; i++)
            c->house.faces[options[i].of].kind = options[i].items[options[i].at];
        status = ++c->tried <= TN_STRIP_CHOICES_MAX
                     ? add_slice(c, error)
                     : tn_strip_limit(c->strip, NULL, "a tray has more than 4,000,000 choices", error);
    } while (status == TN_OK && turn(options, count));
    free(options);
    return status;
}

static tn_status cut_functions(tn_cutting *c, tn_error *error)
{
    const tn_house_form *form = c->strip->form;
    tn_options *options = malloc((c->house.cell_count + 1) * sizeof *options);
    size_t count = 0;
    uint64_t ways = 1;
    bool possible = true;
    if (!options)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < c->house.cell_count; i++) {
        if (c->house.cells[i].open)
            continue;
        options[count] = (tn_options){.of = i};
        for (uint32_t f = 0; f < tn_form_functions(form); f++)
            if (tn_cell_may(&c->house, &c->house.cells[i], f))
                options[count].items[options[count].count++] = f;
        possible = possible && options[count].count > 0;
        ways = ways > TN_STRIP_FUNCTIONS_MAX ? ways : ways * options[count].count;
        count++;
    }
    tn_status status = TN_OK;
    if (ways > TN_STRIP_FUNCTIONS_MAX)
        status =
            tn_strip_limit(c->strip, NULL, "the cells of a tray have more than 1,000,000 choices of functions", error);
    while (possible && status == TN_OK) {
        for (size_t i = 0; i < count; i++)
            c->house.cells[options[i].of].function = options[i].items[options[i].at];
        status = cut_faces(c, error);
        if (!turn(options, count))
            break;
    }
    free(options);
    return status;
}

tn_status tn_strip_slices(tn_strip *strip, tn_tray tray, tn_error *error)
{
    tn_cutting c = {.strip = strip, .tray = tray, .list = &strip->of_tray[tray]};
    if (c.list->made)
        return TN_OK;
    c.list->made = true;
    tn_status status = tn_house_stand(strip->form, &tray, 1, strip->shapes, &c.house, error);
    if (status == TN_OK && c.house.cell_count > TN_STRIP_CELLS_MAX)
        status = tn_strip_limit(strip, NULL, "a tray has more than 60 cells", error);
    if (status == TN_OK)
        status = cut_functions(&c, error);
    tn_house_clear(&c.house);
    tn_numbering_clear(&c.found);
    return status;
}
