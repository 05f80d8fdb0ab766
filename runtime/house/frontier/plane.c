/* Finds what can stand in the plane between two edges, or where the row begins and ends: each storey by itself, as
 * storeys do not see each other's faces, then their combinations. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/plane.h"

/* ---- the house of the two trays */

static bool in_plane(const tn_plane_house *c, const tn_face *face)
{
    return face->at.x0 == c->x && face->at.x1 == c->x;
}

static void furnish(tn_plane_house *c, const tn_strip_edge *edge, size_t first_cell, size_t *face)
{
    for (uint32_t i = 0; i < edge->count; i++)
        c->house.cells[first_cell + i].function = edge->cells[i].function;
    for (size_t i = 0; i < edge->inner_count; ++*face) {
        tn_face *f = &c->house.faces[*face];
        if (f->relation == TN_FACE_UNDER || f->side == TN_HOUSE_BACK || f->side == TN_HOUSE_FRONT)
            f->kind = edge->inner[i++];
    }
}

static tn_status find_open(tn_plane_house *c, tn_error *error)
{
    tn_status status = TN_OK;
    c->open = malloc((c->house.cell_count + 1) * sizeof *c->open);
    if (!c->open)
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < c->house.cell_count; i++) {
        bool left = i < c->left_cells;
        uint32_t at = left ? i : i - c->left_cells;
        const tn_strip_edge *edge = &c->strip->edges[left ? c->left : c->right];
        status = tn_strip_room_open(c->strip, tn_strip_fails(c->strip, edge, at), &c->open[i], error);
    }
    return status;
}

static tn_status stand(tn_plane_house *c, tn_error *error)
{
    const tn_strip *s = c->strip;
    uint32_t left = c->left, right = c->right;
    tn_tray trays[2];
    size_t length = 0, face = 0;
    c->has_left = left != TN_STRIP_NONE;
    c->has_right = right != TN_STRIP_NONE;
    if (c->has_left)
        trays[length++] = s->edges[left].tray;
    if (c->has_right)
        trays[length++] = s->edges[right].tray;
    tn_status status = tn_house_stand(s->form, trays, length, s->shapes, &c->house, error);
    c->faces = status == TN_OK ? malloc((c->house.face_count + 1) * sizeof *c->faces) : NULL;
    if (status == TN_OK && !c->faces)
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    c->left_cells = c->has_left ? s->edges[left].count : 0;
    if (c->has_left)
        furnish(c, &s->edges[left], 0, &face);
    if (c->has_right)
        furnish(c, &s->edges[right], c->left_cells, &face);
    c->x = c->has_left ? tn_tray_value_record(s->form->schema, trays[0], s->form->width)->length : 0;
    for (uint32_t i = 0; i < c->house.face_count; i++)
        if (in_plane(c, &c->house.faces[i]) && c->house.faces[i].relation != TN_FACE_UNDER)
            c->faces[c->count++] = i;
    return find_open(c, error);
}

/* ---- combinations of parts */

static tn_status add_to_list(tn_plane_house *c, uint32_t outcome, uint64_t times, tn_error *error)
{
    uint32_t at = tn_number(&c->found, outcome);
    if (at == UINT32_MAX || !tn_array_reserve_from(&c->list->items, &c->list->room, 1, at, 1, sizeof *c->list->items))
        return tn_fail_memory(error);
    if (at == c->list->count)
        c->list->items[c->list->count++] = (tn_strip_choice){.slice = outcome};
    c->list->items[at].times += times;
    return TN_OK;
}

static tn_status too_many(const tn_plane_house *c, tn_error *error)
{
    return tn_strip_limit(c->strip, NULL, "two trays have more than 4,000,000 choices between them", error);
}

static bool turn_parts(const tn_plane_house *c)
{
    for (size_t p = c->part_count; p-- > 0;) {
        if (++c->parts[p].at < c->parts[p].count)
            return true;
        c->parts[p].at = 0;
    }
    return false;
}

/* words := the part that each is at, and the number of the left cells. *times: choices that have these. */
static tn_status begin_combination(tn_plane_house *c, uint64_t *times, tn_error *error)
{
    bool ok = true;
    *times = 1;
    c->words.size = 0;
    for (size_t p = 0; ok && p < c->part_count; p++) {
        const tn_plane_found *found = &c->parts[p].found[c->parts[p].at];
        *times *= found->times;
        ok = tn_key_push(&c->words, found->part);
    }
    return ok && tn_key_push(&c->words, c->left_cells) ? TN_OK : tn_fail_memory(error);
}

/* Adds the outcomes of all combinations of what the parts have. */
static tn_status combine(tn_plane_house *c, tn_error *error)
{
    uint64_t tried = 0;
    tn_status status;
    do {
        uint64_t times = 0;
        uint32_t outcome = 0;
        status = ++tried <= TN_STRIP_CHOICES_MAX ? begin_combination(c, &times, error) : too_many(c, error);
        if (status == TN_OK)
            status = tn_plane_know_outcome(c, &c->words, &outcome, error);
        if (status == TN_OK)
            status = add_to_list(c, outcome, times, error);
    } while (status == TN_OK && turn_parts(c));
    return status;
}

/* ---- choices of what is in the faces */

typedef struct tn_plane_wheel {
    tn_face *face;
    uint32_t count, at, kinds[TN_FACE_KINDS_MAX];
} tn_plane_wheel;

static bool turn(tn_plane_wheel *wheels, size_t count)
{
    for (size_t i = count; i-- > 0;) {
        if (++wheels[i].at < wheels[i].count)
            return true;
        wheels[i].at = 0;
    }
    return false;
}

static void set_kind(tn_plane_house *c, tn_face *face, uint32_t kind)
{
    c->changed |= (uint64_t)(face->kind != kind) << face->storey;
    face->kind = kind;
}

/* In order, the outcome itself; else what the part has, to be combined with the others. */
static tn_status add_choice(tn_plane_house *c, tn_plane_part *part, tn_error *error)
{
    uint32_t number, outcome;
    tn_status status = tn_plane_number_part(c, part, &number, error);
    if (status == TN_OK && c->ordered) {
        status = tn_plane_find_outcome(c, &number, 1, &outcome, error);
        return status == TN_OK && !tn_strip_ordered_add(c->ordered, outcome) ? tn_fail_memory(error) : status;
    }
    size_t at = 0;
    while (status == TN_OK && at < part->count && part->found[at].part != number)
        at++;
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve_from(&part->found, &part->room, 4, at, 1, sizeof *part->found))
        return tn_fail_memory(error);
    if (at == part->count)
        part->found[part->count++] = (tn_plane_found){.part = number};
    part->found[at].times++;
    return TN_OK;
}

static tn_status add_choices(tn_plane_house *c, tn_plane_part *part, tn_error *error)
{
    tn_plane_wheel *wheels = malloc((c->count + 1) * sizeof *wheels);
    uint64_t tried = 0;
    size_t count = 0;
    if (!wheels)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->count; i++) {
        tn_face *face = &c->house.faces[c->faces[i]];
        if (!tn_plane_part_has(part, face->storey))
            continue;
        wheels[count] = (tn_plane_wheel){.face = face};
        wheels[count].count = (uint32_t)tn_face_options(&c->house, face, wheels[count].kinds);
        count++;
    }
    tn_status status = TN_OK;
    do {
        for (size_t i = 0; i < count; i++)
            set_kind(c, wheels[i].face, wheels[i].kinds[wheels[i].at]);
        status = ++tried <= TN_STRIP_CHOICES_MAX ? add_choice(c, part, error) : too_many(c, error);
    } while (status == TN_OK && turn(wheels, count));
    free(wheels);
    return status;
}

/* Storeys are parts of their own. Not where choices are wanted in their order, nor where costs are asked for, which are
 * of the plane as a whole. */
static tn_status find_parts(tn_plane_house *c, tn_error *error)
{
    uint64_t storeys = 0;
    for (size_t i = 0; i < c->house.cell_count; i++)
        storeys |= UINT64_C(1) << c->house.cells[i].storey;
    bool whole = c->ordered || c->strip->prices.asked;
    c->parts = calloc(TN_STOREYS_MAX, sizeof *c->parts);
    if (!c->parts)
        return tn_fail_memory(error);
    for (uint32_t storey = 0; !whole && storey < TN_STOREYS_MAX; storey++)
        if (storeys >> storey & 1)
            c->parts[c->part_count++].storeys = UINT64_C(1) << storey;
    if (whole)
        c->parts[c->part_count++].storeys = UINT64_MAX;
    return TN_OK;
}

static tn_status add_outcomes(tn_plane_house *c, tn_error *error)
{
    c->sides = malloc((c->house.cell_count + 1) * SIDE_WORDS * sizeof *c->sides);
    c->changed = UINT64_MAX;
    tn_status status = c->sides ? find_parts(c, error) : tn_fail_memory(error);
    for (size_t p = 0; status == TN_OK && p < c->part_count; p++)
        status = add_choices(c, &c->parts[p], error);
    return status == TN_OK && !c->ordered ? combine(c, error) : status;
}

static void end(tn_plane_house *c)
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

tn_status tn_strip_plane(tn_strip *strip, uint32_t left, uint32_t right, const tn_strip_list **plane, tn_error *error)
{
    uint32_t before = strip->plane_keys.count;
    if (!tn_array_reserve(&strip->planes, &strip->plane_room, before, 1, sizeof *strip->planes))
        return tn_fail_memory(error);
    uint32_t at = tn_number(&strip->plane_keys, (uint64_t)left << 32 | right);
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    if (at == before)
        strip->planes[at] = (tn_strip_list){0};
    *plane = &strip->planes[at];
    if (strip->planes[at].made)
        return TN_OK;
    tn_plane_house c = {.strip = strip, .left = left, .right = right, .list = &strip->planes[at]};
    tn_status status = stand(&c, error);
    if (status == TN_OK)
        status = add_outcomes(&c, error);
    strip->planes[at].made = status == TN_OK;
    strip->plane_outcomes += strip->planes[at].count;
    end(&c);
    return status;
}

tn_status tn_strip_order_outcomes(tn_strip *strip, uint32_t left, uint32_t right, const tn_cell *like,
                                  tn_strip_ordered *outcomes, tn_error *error)
{
    tn_plane_house c = {.strip = strip, .left = left, .right = right, .ordered = outcomes};
    tn_status status = stand(&c, error);
    for (size_t i = 0; status == TN_OK && i < c.house.cell_count; i++)
        c.house.cells[i].function = like[i].function;
    if (status == TN_OK)
        status = add_outcomes(&c, error);
    end(&c);
    return status;
}
