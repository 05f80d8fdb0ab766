/* Finds the edges of a tray: what it shows the planes at its sides, as far as that can matter there. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"
#include "runtime/house/solids.h"

/* The decisions that can matter at the plane. */
static const uint64_t *matter_at(const tn_inside *in, tn_strip_role_at role, uint32_t cell)
{
    const tn_strip *s = in->strip;
    return s->borders.matter[role] + in->cells[cell]->description * s->answer_words;
}

/* A room of cells that something is asked of goes on into cells with the same function. Where it is asked where rooms
 * are, all cells have their functions. */
static bool push_cells(const tn_inside *in, tn_strip_role_at role, tn_key *key)
{
    tn_strip *s = in->strip;
    bool ok = tn_key_push(key, role) && tn_key_push(key, (uint32_t)in->house.cell_count);
    for (size_t i = 0; ok && i < in->house.cell_count; i++) {
        const tn_cell *cell = &in->house.cells[i];
        const tn_strip_cut *known = in->cells[i];
        const tn_strip_reach *reach = tn_inside_reach(in, role, (uint32_t)i);
        const uint64_t *matter = matter_at(in, role, (uint32_t)i);
        bool tiled = !cell->open && s->tiled[cell->function],
             goes_on =
                 !cell->open && (s->questions.placed_count > 0 || (reach->open && s->asked_function[cell->function]));
        ok = tn_push_long(key, (uint64_t)cell->at.y0) && tn_push_long(key, (uint64_t)cell->at.y1) &&
             tn_key_push(key, cell->storey << 2 | (uint32_t)cell->open << 1 | tiled) &&
             tn_key_push(key, goes_on ? cell->function : TN_NO_FUNCTION) &&
             tn_key_push(key, s->borders.classes[role][known->description]);
        for (size_t w = 0; ok && w < s->answer_words; w++)
            ok = tn_push_long(key, known->answers[w] & matter[w]);
    }
    return ok;
}

/* Walls across end at the planes on both sides of the tray. */
static bool push_ends(const tn_inside *in, tn_key *key)
{
    bool ok = true;
    for (size_t i = 0; ok && i < in->house.face_count; i++) {
        const tn_face *face = &in->house.faces[i];
        int64_t thick =
            face->relation == TN_FACE_UNDER || !tn_face_is_inner(face) ? 0 : tn_face_thickness(&in->house, face);
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
static bool push_roofs(const tn_inside *in, tn_key *key)
{
    uint32_t storeys = in->strip->form->record->storey_count;
    bool ok = true;
    for (uint32_t i = 0; ok && i < in->house.cell_count; i++) {
        const tn_cell *cell = &in->house.cells[i];
        const tn_shape_record *shape = tn_house_shape(&in->house, cell->zone, TN_CHOICE_ROOF);
        if (cell->storey + 1 == storeys || !tn_cell_is_top(&in->house, i))
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

/* Its cells, and what is in the inner faces, are those of the house at hand. */
static bool keep_edge(const tn_inside *in, tn_strip_role_at role, tn_strip_edge *edge)
{
    tn_strip *s = in->strip;
    size_t count = in->house.cell_count;
    *edge = (tn_strip_edge){.tray = in->tray, .count = (uint32_t)count};
    edge->cells = malloc((count + 1) * sizeof *edge->cells);
    edge->answers = malloc((count * s->answer_words + 1) * sizeof *edge->answers);
    edge->inner = malloc((in->house.face_count + 1) * sizeof *edge->inner);
    if (!edge->cells || !edge->answers || !edge->inner)
        return false;
    for (size_t i = 0; i < count; i++) {
        const tn_cell *cell = &in->house.cells[i];
        edge->cells[i] = (tn_strip_cell){cell->at.y0,    cell->at.y1, cell->storey,
                                         cell->function, cell->open,  !cell->open && s->tiled[cell->function]};
        for (size_t w = 0; w < s->answer_words; w++)
            edge->answers[i * s->answer_words + w] = in->cells[i]->answers[w] & matter_at(in, role, (uint32_t)i)[w];
    }
    for (size_t i = 0; i < in->house.face_count; i++)
        if (tn_face_is_inner(&in->house.faces[i]))
            edge->inner[edge->inner_count++] = in->house.faces[i].kind;
    edge->asked = number_asked(s, edge);
    return edge->asked != UINT32_MAX;
}

/* What the costs of planes beside the tray depend on. */
static tn_status find_shape(const tn_inside *in, uint32_t *shape, tn_error *error)
{
    tn_strip_prices *p = &in->strip->prices;
    p->key.size = 0;
    bool ok = tn_strip_push_shape(in->strip, &in->house, &p->key) && push_ends(in, &p->key);
    *shape = ok ? tn_intern(&p->shapes, p->key.data, p->key.size) : UINT32_MAX;
    return *shape != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

tn_status tn_strip_find_edge(const tn_inside *in, tn_strip_role_at role, uint32_t cost, uint32_t *edge, tn_error *error)
{
    tn_strip *s = in->strip;
    uint32_t before = s->edge_keys.count, shape = 0;
    tn_status status = s->prices.asked ? find_shape(in, &shape, error) : TN_OK;
    s->key.size = 0;
    if (status != TN_OK)
        return status;
    if (!push_cells(in, role, &s->key) || !push_ends(in, &s->key) || !push_roofs(in, &s->key) ||
        (s->prices.asked && !tn_key_push(&s->key, shape)))
        return tn_fail_memory(error);
    if (!tn_array_reserve(&s->edges, &s->edge_room, before, 1, sizeof *s->edges))
        return tn_fail_memory(error);
    *edge = tn_intern(&s->edge_keys, s->key.data, s->key.size);
    if (*edge == UINT32_MAX)
        return tn_fail_memory(error);
    if (*edge < before)
        return TN_OK;
    bool kept = keep_edge(in, role, &s->edges[*edge]);
    s->edges[*edge].shape = shape;
    s->edges[*edge].cost = cost;
    return kept ? TN_OK : tn_fail_memory(error);
}
