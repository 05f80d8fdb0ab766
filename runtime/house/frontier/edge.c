/* The edges of trays: what a tray shows the interfaces at its sides, as far as that can matter there.
 *
 * ==== classes of cells
 *
 * Cells of which lines of faces say the same at an interface, whatever can stand beside them, are of one class.
 *
 * A cell is described by its storey, its function and the lines that speak of it. Two descriptions can meet at an
 * interface if trays with such cells can follow one another in a plan of the library. For each of a description's
 * partners the lines are listed that apply, up to the first that always has a kind that fits: the others are never
 * asked. So if two houses of a row are parted by a party wall, whatever stands beyond it, all cells beside that wall
 * are of one class. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"
#include "runtime/house/rule/asked.h"
#include "runtime/house/ways.h"

/* Bits of a line in a description. */
enum { LINE_FIRST, LINE_SECOND, LINE_BITS };

static const tn_face_line_record *line_at(const tn_house_form *form, uint32_t line)
{
    return &form->module->FACE_LINE_records[form->record->face_first + line];
}

/* ---- descriptions */

/* Their words: then come the bits of the lines. */
enum { OF_STOREY, OF_FUNCTION, OF_OUTDOOR, OF_LINES };

tn_status tn_frontier_describe(tn_frontier *frontier, const tn_house *house, uint32_t cell, uint32_t *description,
                               tn_error *error)
{
    const tn_house_form *form = frontier->form;
    const tn_cell *at = &house->cells[cell];
    tn_key *key = &frontier->key;
    uint32_t word = 0, used = 0;
    key->size = 0;
    bool ok = tn_key_push(key, at->storey) && tn_key_push(key, at->function) &&
              tn_key_push(key, tn_cell_is_outdoor(house, cell));
    for (uint32_t i = 0; ok && i < form->record->face_count; i++) {
        const tn_face_line_record *line = line_at(form, i);
        if (line->relation == TN_FACE_UNDER || line->relation == TN_FACE_ACROSS)
            continue;
        bool first = tn_house_decide(house, line->first, at),
             second = line->relation != TN_FACE_OUTSIDE && tn_house_decide(house, line->second, at);
        word |= ((uint32_t)first << LINE_FIRST | (uint32_t)second << LINE_SECOND) << used;
        used += LINE_BITS;
        if (used == 32) {
            ok = tn_key_push(key, word);
            word = used = 0;
        }
    }
    ok = ok && tn_key_push(key, word);
    *description = ok ? tn_intern(&frontier->edges.borders.descriptions, key->data, key->size) : UINT32_MAX;
    return *description != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

static bool speaks(const uint32_t *description, uint32_t place, uint32_t bit)
{
    uint32_t at = place * LINE_BITS + bit;
    return description[OF_LINES + at / 32] >> at % 32 & 1;
}

/* ---- which of them can meet */

/* The trays in which a description stands: a bit each. */
typedef struct tn_describing {
    tn_frontier *frontier;
    const tn_frontier_trays *trays;
    uint64_t *stands; /* [descriptions][words] */
    size_t room;
} tn_describing;

static tn_status note(tn_describing *d, uint32_t description, tn_tray tray, tn_error *error)
{
    size_t words = d->trays->words, before = d->room;
    if (!tn_array_reserve(&d->stands, &d->room, description * words, words, sizeof *d->stands))
        return tn_fail_memory(error);
    memset(d->stands + before, 0, (d->room - before) * sizeof *d->stands);
    d->stands[description * words + tray / 64] |= UINT64_C(1) << tray % 64;
    return TN_OK;
}

/* Can something be asked of a room with this cell? */
static tn_status note_function(tn_frontier *frontier, const tn_house *house, const tn_cell *cell, tn_error *error)
{
    const tn_frontier_questions *q = &frontier->questions;
    tn_room_open open;
    uint64_t fails = 0;
    for (uint32_t i = 0; i < q->all_count; i++)
        fails |= (uint64_t)!tn_house_decide(house, q->all[i], cell) << i;
    tn_status status = tn_frontier_room_open(frontier, fails, &open, error);
    if (status == TN_OK)
        frontier->questions.asked_function[cell->function] =
            frontier->questions.asked_function[cell->function] || open.any;
    return status;
}

static tn_status describe_cell(tn_describing *d, const tn_house *house, uint32_t cell, tn_error *error)
{
    uint32_t description;
    tn_status status = tn_frontier_describe(d->frontier, house, cell, &description, error);
    if (status == TN_OK)
        status = note(d, description, house->trays[0], error);
    return status == TN_OK && !house->cells[cell].open ? note_function(d->frontier, house, &house->cells[cell], error)
                                                       : status;
}

/* All that the cells of a tray can be. What is said of a void depends on the cell that it belongs to. */
static tn_status describe_tray(tn_describing *d, tn_tray tray, tn_error *error)
{
    tn_house house;
    const tn_house_form *form = d->frontier->form;
    tn_status status = tn_house_stand(form, &tray, 1, d->frontier->shapes, &house, error);
    for (uint32_t i = 0, of = 0; status == TN_OK && i < house.cell_count; i++) {
        of = house.cells[i].open ? of : i;
        for (uint32_t f = 0; status == TN_OK && f < tn_form_functions(form); f++) {
            if (!tn_cell_may(&house, &house.cells[of], f))
                continue;
            house.cells[of].function = f;
            status = describe_cell(d, &house, i, error);
        }
    }
    tn_house_clear(&house);
    return status;
}

/* trays: those that can follow a description's. */
static void follow(const tn_describing *d, uint32_t description, uint64_t *trays)
{
    size_t words = d->trays->words;
    const uint64_t *stands = d->stands + description * words;
    memset(trays, 0, words * sizeof *trays);
    for (size_t t = 0; t < 64 * words; t++)
        for (size_t w = 0; stands[t / 64] >> t % 64 & 1 && w < words; w++)
            trays[w] |= d->trays->follows[t * words + w];
}

static bool overlap(const uint64_t *a, const uint64_t *b, size_t words)
{
    for (size_t w = 0; w < words; w++)
        if (a[w] & b[w])
            return true;
    return false;
}

/* ---- classes */

/* Does a kind of the line fit wherever it applies? */
static bool always_fits(const tn_house_form *form, const tn_face_line_record *line)
{
    for (uint32_t k = 0; k < line->kind_count; k++) {
        uint32_t kind = form->module->HOUSE_ITEM_records[line->kind_first + k].number;
        if (!tn_form_opening(form, kind) && !tn_form_flight(form, kind) &&
            (kind != TN_FACE_OPEN || line->relation != TN_FACE_OUTSIDE))
            return true;
    }
    return false;
}

static bool applies(const tn_face_line_record *line, uint32_t place, const uint32_t *left, const uint32_t *right)
{
    if (line->relation == TN_FACE_OUTSIDE)
        return false;
    return (speaks(left, place, LINE_FIRST) && speaks(right, place, LINE_SECOND)) ||
           (line->relation == TN_FACE_BESIDE && speaks(left, place, LINE_SECOND) && speaks(right, place, LINE_FIRST));
}

static bool is_outside(const tn_face_line_record *line, uint32_t place, const uint32_t *cell, uint32_t side)
{
    return line->relation == TN_FACE_OUTSIDE && speaks(cell, place, LINE_FIRST) &&
           (line->side == TN_HOUSE_ANY_SIDE || line->side == side);
}

/* A face between two cells (left and right), or outside on a side of one (right: NULL). outer: one of the two is in the
 * open; sheltered: the one that is not, whose outside face it is on its side, or NULL. */
typedef struct tn_border_face {
    const uint32_t *left, *right, *sheltered;
    uint32_t side;
    bool outer;
} tn_border_face;

static tn_border_face face_between(const uint32_t *left, const uint32_t *right)
{
    bool one = left[OF_OUTDOOR], other = right[OF_OUTDOOR];
    return (tn_border_face){left, right,
                            one == other ? NULL
                            : one        ? right
                                         : left,
                            one ? TN_HOUSE_LEFT : TN_HOUSE_RIGHT, one || other};
}

static tn_border_face face_outside(const uint32_t *cell, tn_frontier_role_at role)
{
    return (tn_border_face){cell, NULL, cell, role == TN_FRONTIER_EXIT ? TN_HOUSE_RIGHT : TN_HOUSE_LEFT, true};
}

/* Appends the lines that are asked of a face: those between its cells, or (outside) those outside of one, up to the
 * first that always has a kind that fits. Which of two cells a line names first matters to leaves of doors, if the form
 * asks for ways: the lowest bit. *more: none of them always has one. */
static bool push_asked(const tn_house_form *form, const tn_border_face *face, bool outside, tn_key *key, bool *more)
{
    const uint32_t *left = face->left, *right = face->right;
    bool ok = true, ways = tn_form_asks_ways(form);
    for (uint32_t i = 0, place = 0; ok && *more && i < form->record->face_count; i++) {
        const tn_face_line_record *line = line_at(form, i);
        if (line->relation == TN_FACE_UNDER || line->relation == TN_FACE_ACROSS)
            continue;
        uint32_t at = place++;
        if (outside ? !is_outside(line, at, face->sheltered, face->side)
                    : !applies(line, at, left, right) || (face->outer && !tn_form_names_both(form, line)))
            continue;
        bool as_written = ways && !outside && speaks(left, at, LINE_FIRST) && speaks(right, at, LINE_SECOND);
        ok = tn_key_push(key, i << 1 | as_written);
        *more = !always_fits(form, line);
    }
    return ok;
}

/* Those of a face beside a cell in the open are lines that name both cells, then those outside of the other one. */
static bool push_lines(const tn_frontier *frontier, const tn_border_face *face, tn_key *key)
{
    bool more = true, ok = !face->right || push_asked(frontier->form, face, false, key, &more);
    ok = ok && (!face->sheltered || push_asked(frontier->form, face, true, key, &more));
    return ok && tn_key_push(key, TN_FRONTIER_NONE);
}

/* ---- what can be in its faces there */

/* What is on the other side of the face. */
typedef enum tn_reached_over { OVER_NOTHING, OVER_OTHER, OVER_SAME_FUNCTION } tn_reached_over;

static void reach_kind(const tn_frontier *frontier, uint32_t kind, tn_reached_over over, bool outer,
                       tn_frontier_reach *reach)
{
    const tn_frontier_questions *q = &frontier->questions;
    const tn_module *module = frontier->form->module;
    const tn_opening_record *opening = tn_form_opening(frontier->form, kind);
    reach->marks |= tn_frontier_marks(frontier, kind);
    reach->glazed = reach->glazed || (outer && opening && opening->flags & TN_GLAZED);
    if (over == OVER_NOTHING)
        return;
    reach->open = reach->open || (over == OVER_SAME_FUNCTION && kind == TN_FACE_OPEN);
    reach->ways = reach->ways || kind == TN_FACE_OPEN;
    for (uint32_t w = 0; w < q->walk_count; w++)
        reach->walks |= (uint32_t)tn_walk_goes_through(frontier->form, &module->MEETING_records[q->walks[w]], kind)
                        << w;
    for (uint32_t m = 0; m < q->meeting_count; m++)
        reach->meetings |= (uint64_t)tn_meeting_has(module, &module->MEETING_records[q->meetings[m]], kind) << m;
}

/* The kinds of the lines in a list of push_lines; what is there if none of them fits, too: a wall, or nothing. */
static void reach_lines(const tn_frontier *frontier, const uint32_t *lines, const uint32_t *end,
                        const tn_border_face *face, tn_frontier_reach *reach)
{
    tn_reached_over over = !face->right                                          ? OVER_NOTHING
                           : face->left[OF_FUNCTION] == face->right[OF_FUNCTION] ? OVER_SAME_FUNCTION
                                                                                 : OVER_OTHER;
    const tn_house_form *form = frontier->form;
    for (; lines < end && *lines != TN_FRONTIER_NONE; lines++) {
        const tn_face_line_record *line = line_at(form, *lines >> 1);
        for (uint32_t k = 0; k < line->kind_count; k++)
            reach_kind(frontier, form->module->HOUSE_ITEM_records[line->kind_first + k].number, over, face->outer,
                       reach);
    }
    reach_kind(frontier, face->outer && !face->sheltered ? TN_FACE_OPEN : TN_FACE_WALL, over, face->outer, reach);
}

/* meets: [descriptions], those that can stand at the right of the one, or at its left. */
static bool classify(tn_frontier *frontier, uint32_t description, const bool *meets, tn_frontier_role_at role,
                     tn_interner *classes, uint32_t *class)
{
    tn_frontier_reach *reach = &frontier->edges.borders.reach[role][description];
    const tn_interner *all = &frontier->edges.borders.descriptions;
    size_t size;
    const uint32_t *own = tn_interned(all, description, &size);
    uint32_t storey = own[OF_STOREY];
    tn_key *key = &frontier->key;
    tn_border_face face = face_outside(own, role);
    key->size = 0;
    bool ok = tn_key_push(key, own[OF_OUTDOOR]) && push_lines(frontier, &face, key);
    if (ok)
        reach_lines(frontier, key->data + 1, key->data + key->size, &face, reach);
    for (uint32_t d = 0; ok && d < all->count; d++) {
        const uint32_t *other = tn_interned(all, d, &size);
        if (!meets[d] || other[OF_STOREY] != storey)
            continue;
        ok = tn_key_push(key, d);
        size_t first = key->size;
        face = role == TN_FRONTIER_EXIT ? face_between(own, other) : face_between(other, own);
        ok = ok && push_lines(frontier, &face, key);
        if (ok)
            reach_lines(frontier, key->data + first, key->data + key->size, &face, reach);
    }
    *class = ok ? tn_intern(classes, key->data, key->size) : UINT32_MAX;
    return *class != UINT32_MAX;
}

static void let_matter(uint64_t *matter, size_t decision)
{
    matter[decision / 64] |= UINT64_C(1) << decision % 64;
}

/* The decisions on a cell that can matter at the interface: to a walk if one can step there, to a meeting if it can be
 * there, to a room if it can go on there or something is seen of it. */
static void find_matter(const tn_frontier *frontier, const tn_frontier_reach *reach, uint64_t *matter)
{
    const tn_frontier_questions *q = &frontier->questions;
    for (uint32_t w = 0; w < q->walk_count; w++) {
        if (!(reach->walks >> w & 1))
            continue;
        let_matter(matter, q->walk_parts[w].first);
        let_matter(matter, q->walk_parts[w].second);
        if (!q->walk_parts[w].any)
            let_matter(matter, q->walk_parts[w].through);
    }
    for (uint32_t m = 0; m < q->meeting_count; m++)
        if (reach->meetings >> m & 1) {
            let_matter(matter, q->meeting_parts[m].first);
            let_matter(matter, q->meeting_parts[m].second);
        }
    for (uint32_t i = 0; i < q->all_count && tn_frontier_reaches_rooms(reach); i++)
        let_matter(matter, q->all_decisions[i]);
}

/* meet: [descriptions][descriptions], left and right. */
static bool find_classes(tn_frontier *frontier, const bool *meet)
{
    tn_frontier_borders *b = &frontier->edges.borders;
    uint32_t count = b->descriptions.count;
    tn_interner classes[TN_FRONTIER_ROLES] = {{0}};
    bool *meets = malloc((size_t)count + 1), ok = meets != NULL;
    for (int role = 0; role < TN_FRONTIER_ROLES; role++) {
        b->classes[role] = malloc(((size_t)count + 1) * sizeof *b->classes[role]);
        b->reach[role] = calloc((size_t)count + 1, sizeof *b->reach[role]);
        b->matter[role] = calloc(count * frontier->questions.answer_words + 1, sizeof *b->matter[role]);
        ok = ok && b->classes[role] && b->reach[role] && b->matter[role];
        for (uint32_t i = 0; ok && i < count; i++) {
            for (uint32_t d = 0; d < count; d++)
                meets[d] = role == TN_FRONTIER_EXIT ? meet[(size_t)i * count + d] : meet[(size_t)d * count + i];
            ok = classify(frontier, i, meets, (tn_frontier_role_at)role, &classes[role], &b->classes[role][i]);
            if (ok)
                find_matter(frontier, &b->reach[role][i], b->matter[role] + i * frontier->questions.answer_words);
        }
        tn_interner_clear(&classes[role]);
    }
    free(meets);
    return ok;
}

static bool find_meetings(const tn_describing *d, bool *meet)
{
    size_t words = d->trays->words, count = d->frontier->edges.borders.descriptions.count;
    uint64_t *next = malloc((words + 1) * sizeof *next);
    for (uint32_t i = 0; next && i < count; i++) {
        if (d->trays->follows)
            follow(d, i, next);
        for (uint32_t k = 0; k < count; k++)
            meet[i * count + k] = !d->trays->follows || overlap(next, d->stands + k * words, words);
    }
    free(next);
    return next != NULL;
}

tn_status tn_frontier_borders_find(tn_frontier *frontier, const tn_frontier_trays *trays, tn_error *error)
{
    tn_describing d = {.frontier = frontier, .trays = trays};
    tn_status status = TN_OK;
    for (tn_tray t = 0; status == TN_OK && t < frontier->form->schema->tray_count; t++)
        if (trays->stand[t])
            status = describe_tray(&d, t, error);
    size_t count = frontier->edges.borders.descriptions.count;
    bool *meet = malloc(tn_size_of(count, count) + 1);
    if (status == TN_OK && !(meet && find_meetings(&d, meet) && find_classes(frontier, meet)))
        status = tn_fail_memory(error);
    free(meet);
    free(d.stands);
    return status;
}

static void clear_borders(tn_frontier_borders *borders)
{
    tn_interner_clear(&borders->descriptions);
    for (int role = 0; role < TN_FRONTIER_ROLES; role++) {
        free(borders->classes[role]);
        free(borders->reach[role]);
        free(borders->matter[role]);
    }
}

/* ==== edges
 *
 * Finds the edges of a tray: what it shows the interfaces at its sides, as far as that can matter there. */

/* The decisions that can matter at the interface. */
static const uint64_t *matter_at(const tn_inside *in, tn_frontier_role_at role, uint32_t cell)
{
    const tn_frontier *s = in->frontier;
    return s->edges.borders.matter[role] + in->cells[cell]->description * s->questions.answer_words;
}

/* Over an open side, a flight of stairs may begin or end on the floor of a bare cell. */
static bool is_bare(const tn_frontier *frontier, const tn_cell *cell)
{
    return tn_form_asks_ways(frontier->form) && !cell->open && tn_form_is_bare(frontier->form, cell->function);
}

/* A room of cells that something is asked of goes on into cells with the same function. If it is asked where rooms are,
 * all cells have their functions. */
static bool push_cells(const tn_inside *in, tn_frontier_role_at role, tn_key *key)
{
    tn_frontier *s = in->frontier;
    bool ok = tn_key_push(key, role) && tn_key_push(key, (uint32_t)in->house.cell_count);
    for (size_t i = 0; ok && i < in->house.cell_count; i++) {
        const tn_cell *cell = &in->house.cells[i];
        const tn_frontier_cut *known = in->cells[i];
        const tn_frontier_reach *reach = tn_inside_reach(in, role, (uint32_t)i);
        const uint64_t *matter = matter_at(in, role, (uint32_t)i);
        bool tiled = tn_frontier_fills(s, &in->house, (uint32_t)i), bare = reach->ways && is_bare(s, cell),
             furnished = tiled && s->tiles.furnished[cell->function],
             goes_on = !cell->open &&
                       (s->questions.placed_count > 0 || (reach->open && s->questions.asked_function[cell->function]));
        ok = tn_push_long(key, (uint64_t)cell->at.y0) && tn_push_long(key, (uint64_t)cell->at.y1) &&
             tn_key_push(key, cell->storey << 4 | (uint32_t)furnished << 3 | (uint32_t)bare << 2 |
                                  (uint32_t)cell->open << 1 | tiled) &&
             (!bare || tn_push_long(key, (uint64_t)(cell->at.x1 - cell->at.x0))) &&
             tn_key_push(key, goes_on ? cell->function : TN_NO_FUNCTION) &&
             tn_key_push(key, s->edges.borders.classes[role][known->description]);
        for (size_t w = 0; ok && w < s->questions.answer_words; w++)
            ok = tn_push_long(key, known->answers[w] & matter[w]);
    }
    return ok;
}

/* If costs are asked for: which layers a wall has that ends there, and in what order. */
static bool push_layers(const tn_inside *in, const tn_face *face, tn_key *key)
{
    if (!in->frontier->prices.asked || in->frontier->form->record->layer_count == 0)
        return true;
    tn_layering layers = tn_face_layering(&in->house, face);
    return tn_key_push(key, layers.first << 1 | layers.from_high) && tn_key_push(key, layers.count);
}

/* Walls across, and posts of open sides, end at the interfaces on both sides of the tray. */
static bool push_ends(const tn_inside *in, tn_key *key)
{
    bool ok = true;
    for (size_t i = 0; ok && i < in->house.face_count; i++) {
        const tn_face *face = &in->house.faces[i];
        if (face->relation == TN_FACE_UNDER || !tn_face_is_inner(face))
            continue;
        int64_t thick = tn_face_thickness(&in->house, face);
        bool posts = tn_face_is_open_side(&in->house, face);
        if (thick > 0 || posts)
            ok = tn_key_push(key, face->storey << 1 | posts) && tn_push_long(key, (uint64_t)face->at.y0) &&
                 tn_push_long(key, (uint64_t)thick) && (thick == 0 || push_layers(in, face, key));
    }
    return ok;
}

/* The first cell that has the function of this one. */
static uint32_t first_alike(const tn_frontier_edge *edge, size_t cell)
{
    uint32_t i = 0;
    while (edge->cells[i].open || edge->cells[i].function != edge->cells[cell].function)
        i++;
    return i;
}

/* Numbers what is asked of the cells of the edge. */
static uint32_t number_asked(tn_frontier *s, const tn_frontier_edge *edge)
{
    bool ok = true;
    s->key.size = 0;
    for (size_t i = 0; ok && i < edge->count; i++) {
        ok = tn_key_push(&s->key, edge->cells[i].open);
        if (ok && s->questions.placed_count > 0 && !edge->cells[i].open)
            ok = tn_key_push(&s->key, first_alike(edge, i));
        for (size_t w = 0; ok && w < s->questions.answer_words; w++)
            ok = tn_push_long(&s->key, edge->answers[i * s->questions.answer_words + w]);
    }
    return ok ? tn_intern(&s->edges.asked, s->key.data, s->key.size) : UINT32_MAX;
}

/* Lower roofs, which may stand before openings of the trays beside. */
static bool push_roofs(const tn_inside *in, tn_key *key)
{
    uint32_t storeys = in->frontier->form->record->storey_count;
    bool ok = true;
    for (uint32_t i = 0; ok && i < in->house.cell_count; i++) {
        const tn_cell *cell = &in->house.cells[i];
        const tn_shape_record *shape = tn_house_shape(&in->house, cell->zone, TN_CHOICE_ROOF);
        if (cell->storey + 1 == storeys || !tn_cell_is_top(&in->house, i))
            continue;
        bool across = shape && (shape->flags & TN_ROOF_ACROSS || shape->roof == TN_ROOF_CROSS_GABLE);
        ok = tn_key_push(key, shape ? (uint32_t)shape->roof : TN_ROOF_FLAT) &&
             tn_key_push(key, shape ? (uint32_t)shape->rise : 0) &&
             tn_key_push(key, shape ? (uint32_t)shape->run : 0) &&
             tn_push_long(key, shape ? (uint64_t)shape->height : 0) &&
             tn_push_long(key, across ? (uint64_t)(cell->at.x1 - cell->at.x0) : 0);
    }
    return ok;
}

/* Its cells, and what is in the inner faces, are those of the house at hand. */
static bool keep_edge(const tn_inside *in, tn_frontier_role_at role, tn_frontier_edge *edge)
{
    tn_frontier *s = in->frontier;
    size_t count = in->house.cell_count;
    *edge = (tn_frontier_edge){.tray = in->tray, .count = (uint32_t)count};
    edge->cells = malloc((count + 1) * sizeof *edge->cells);
    edge->answers = malloc((count * s->questions.answer_words + 1) * sizeof *edge->answers);
    edge->inner = malloc((in->house.face_count + 1) * sizeof *edge->inner);
    if (!edge->cells || !edge->answers || !edge->inner)
        return false;
    for (size_t i = 0; i < count; i++) {
        const tn_cell *cell = &in->house.cells[i];
        edge->cells[i] = (tn_frontier_cell){cell->at.y0,    cell->at.y1, cell->storey,
                                            cell->function, cell->open,  tn_frontier_fills(s, &in->house, (uint32_t)i)};
        for (size_t w = 0; w < s->questions.answer_words; w++)
            edge->answers[i * s->questions.answer_words + w] =
                in->cells[i]->answers[w] & matter_at(in, role, (uint32_t)i)[w];
    }
    for (size_t i = 0; i < in->house.face_count; i++)
        if (tn_face_is_inner(&in->house.faces[i]))
            edge->inner[edge->inner_count++] = in->house.faces[i].kind;
    edge->asked = number_asked(s, edge);
    return edge->asked != UINT32_MAX;
}

/* What the costs of interfaces beside the tray depend on. */
static tn_status find_shape(const tn_inside *in, uint32_t *shape, tn_error *error)
{
    tn_frontier_prices *p = &in->frontier->prices;
    p->key.size = 0;
    bool ok = tn_frontier_push_shape(in->frontier, &in->house, &p->key) && push_ends(in, &p->key);
    *shape = ok ? tn_intern(&p->shapes, p->key.data, p->key.size) : UINT32_MAX;
    return *shape != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

tn_status tn_frontier_find_edge(const tn_inside *in, tn_frontier_role_at role, uint32_t cost, uint32_t *edge,
                                tn_error *error)
{
    tn_frontier *s = in->frontier;
    uint32_t before = s->edges.keys.count, shape = 0;
    tn_status status = s->prices.asked ? find_shape(in, &shape, error) : TN_OK;
    s->key.size = 0;
    if (status != TN_OK)
        return status;
    if (!push_cells(in, role, &s->key) || !push_ends(in, &s->key) || !push_roofs(in, &s->key) ||
        (s->prices.asked && !tn_key_push(&s->key, shape)))
        return tn_fail_memory(error);
    if (!tn_array_reserve(&s->edges.items, &s->edges.room, before, 1, sizeof *s->edges.items))
        return tn_fail_memory(error);
    *edge = tn_intern(&s->edges.keys, s->key.data, s->key.size);
    if (*edge == UINT32_MAX)
        return tn_fail_memory(error);
    if (*edge < before)
        return TN_OK;
    bool kept = keep_edge(in, role, &s->edges.items[*edge]);
    s->edges.items[*edge].shape = shape;
    s->edges.items[*edge].cost = cost;
    return kept ? TN_OK : tn_fail_memory(error);
}

void tn_frontier_edges_clear(tn_frontier_edges *edges)
{
    for (uint32_t i = 0; i < edges->keys.count; i++) {
        free(edges->items[i].cells);
        free(edges->items[i].answers);
        free(edges->items[i].inner);
    }
    tn_interner_clear(&edges->keys);
    tn_interner_clear(&edges->asked);
    clear_borders(&edges->borders);
    free(edges->items);
}
