/* Finds what comes of a part of a plane, of one storey or more, with what is in its faces: meetings, steps, what rooms
 * and tiles see of both sides. */
#include <stdlib.h>

#include "runtime/house/frontier/plane.h"
#include "runtime/house/rule/asked.h"

uint64_t tn_strip_marks(const tn_strip *strip, uint32_t kind)
{
    for (uint32_t i = 0; i < strip->questions.kind_count; i++)
        if (strip->questions.kinds[i] == kind)
            return UINT64_C(1) << i;
    return 0;
}

bool tn_strip_steps(const tn_strip *strip, const tn_house *house, const tn_face *face, uint32_t walk)
{
    return tn_house_is_step(house, &strip->form->module->MEETING_records[strip->questions.walks[walk]], face);
}

bool tn_strip_meets(const tn_strip *strip, const tn_house *house, const tn_face *face, uint32_t meeting)
{
    return tn_face_meets(house, &strip->form->module->MEETING_records[strip->questions.meetings[meeting]], face);
}

bool tn_strip_joins(const tn_house *house, const tn_face *face)
{
    if (face->second == TN_NO_CELL || face->kind != TN_FACE_OPEN)
        return false;
    const tn_cell *a = &house->cells[face->first], *b = &house->cells[face->second];
    return !a->open && !b->open && a->function == b->function;
}

/* ---- steps */

/* The cell among those of its edge. */
static const tn_strip_edge *edge_of(const tn_plane_house *c, uint32_t cell, uint32_t *at)
{
    bool left = cell < c->left_cells;
    *at = left ? cell : cell - c->left_cells;
    return &c->strip->edges[left ? c->left : c->right];
}

/* Do its cells become one room, of which something may be asked? */
static bool joins(const tn_plane_house *c, const tn_face *face)
{
    bool asked = c->strip->questions.placed_count > 0 || c->open[face->first].any || c->open[face->second].any;
    return asked && tn_strip_joins(&c->house, face);
}

static tn_strip_role role_of(const tn_strip *strip, uint32_t walk, const tn_strip_edge *edge, uint32_t cell)
{
    return tn_strip_role_of(strip, walk, tn_edge_answers(strip, edge, cell), edge->cells[cell].open);
}

/* Can a step through it make a difference to the walk? */
static bool leads(const tn_plane_house *c, const tn_face *face, uint32_t walk)
{
    uint32_t a, b;
    const tn_strip_edge *left = edge_of(c, face->first, &a), *right = edge_of(c, face->second, &b);
    tn_strip_role from = role_of(c->strip, walk, left, a), to = role_of(c->strip, walk, right, b);
    return (from.through && (to.through || to.source || to.goal)) || (from.source && (to.through || to.goal)) ||
           (from.goal && (to.through || to.source));
}

/* How a face matters to rooms and walks, as in STEP_HOW. */
static uint32_t find_how(const tn_plane_house *c, const tn_face *face, uint64_t *meetings)
{
    const tn_strip *s = c->strip;
    if (face->second == TN_NO_CELL)
        return 0;
    uint32_t how = joins(c, face);
    for (uint32_t w = 0; w < s->questions.walk_count; w++)
        how |= (uint32_t)(leads(c, face, w) && tn_strip_steps(s, &c->house, face, w)) << (w + 1);
    for (uint32_t m = 0; m < s->questions.meeting_count; m++)
        *meetings |= (uint64_t)tn_strip_meets(s, &c->house, face, m) << m;
    return how;
}

/* ---- sides */

/* What of the cell's glass is in the plane, if any question depends on that. */
static tn_int128 plane_glass(const tn_plane_house *c, uint32_t cell)
{
    tn_int128 glass = 0;
    for (size_t k = 0; c->open[cell].glass && k < c->count; k++)
        if (c->house.faces[c->faces[k]].first == cell)
            glass += tn_face_glazing(&c->house, &c->house.faces[c->faces[k]]);
    return glass;
}

/* What a side of the cell is, in SIDE_WORDS. posts: of its storey. */
static tn_status find_side(const tn_plane_house *c, uint32_t i, const tn_posts *posts, uint32_t *side, tn_error *error)
{
    tn_strip *s = c->strip;
    const tn_cell *cell = &c->house.cells[i];
    bool tiled = !cell->open && s->tiled[cell->function];
    uint32_t fit = 0, glass = tn_strip_number_area(s, plane_glass(c, i));
    uint64_t marks = 0;
    tn_status status = glass != UINT32_MAX ? TN_OK : tn_fail_memory(error);
    for (size_t k = 0; c->open[i].kinds != 0 && k < c->count; k++) {
        const tn_face *face = &c->house.faces[c->faces[k]];
        marks |= face->first == i || face->second == i ? tn_strip_marks(s, face->kind) : 0;
    }
    marks &= c->open[i].kinds;
    if (status == TN_OK && tiled)
        status = tn_strip_fit_side(s, &c->house, i, i < c->left_cells ? TN_HOUSE_RIGHT : TN_HOUSE_LEFT, c->x, posts,
                                   &fit, error);
    side[SIDE_MARKS] = tn_low(marks);
    side[SIDE_MARKS_HIGH] = tn_high(marks);
    side[SIDE_FIT] = fit + tiled;
    side[SIDE_GLASS] = glass;
    return status;
}

static bool has_tiles(const tn_plane_house *c, uint32_t storey)
{
    for (size_t i = 0; i < c->house.cell_count; i++) {
        const tn_cell *cell = &c->house.cells[i];
        if (cell->storey == storey && !cell->open && c->strip->tiled[cell->function])
            return true;
    }
    return false;
}

/* Storeys do not see each other's faces. */
static tn_status find_sides(tn_plane_house *c, uint32_t storey, tn_error *error)
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

static bool push_steps(const tn_plane_house *c, const tn_plane_part *part, tn_key *key)
{
    uint64_t meetings = 0;
    bool ok = tn_push_long(key, 0) && tn_key_push(key, 0);
    for (size_t i = 0; ok && i < c->count; i++) {
        const tn_face *face = &c->house.faces[c->faces[i]];
        uint32_t how = tn_plane_part_has(part, face->storey) ? find_how(c, face, &meetings) : 0;
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

static bool push_side(const tn_plane_house *c, uint32_t cell, tn_key *key)
{
    bool ok = tn_key_push(key, cell);
    for (size_t w = 0; ok && w < SIDE_WORDS; w++)
        ok = tn_key_push(key, c->sides[(size_t)SIDE_WORDS * cell + w]);
    return ok;
}

/* Of storeys in which no face has changed, sides are what they were. */
static tn_status push_sides(tn_plane_house *c, const tn_plane_part *part, tn_key *key, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t storey = 0; status == TN_OK && storey < TN_STOREYS_MAX; storey++)
        if (c->changed >> storey & 1 && tn_plane_part_has(part, storey))
            status = find_sides(c, storey, error);
    c->changed = status == TN_OK ? c->changed & ~part->storeys : c->changed;
    for (uint32_t i = 0; status == TN_OK && i < c->house.cell_count; i++)
        if (tn_plane_part_has(part, c->house.cells[i].storey) && !push_side(c, i, key))
            status = tn_fail_memory(error);
    return status;
}

static tn_status push_cost(const tn_plane_house *c, tn_key *key, tn_error *error)
{
    tn_strip *s = c->strip;
    const tn_strip_border border = {.left = c->has_left ? &s->edges[c->left] : NULL,
                                    .right = c->has_right ? &s->edges[c->right] : NULL,
                                    .faces = c->faces,
                                    .count = c->count};
    uint32_t cost = 0;
    tn_status status = tn_strip_plane_cost(s, &border, &c->house, &cost, error);
    return status == TN_OK && !tn_key_push(key, cost) ? tn_fail_memory(error) : status;
}

/* Numbers what comes of its faces as they are. */
tn_status tn_plane_number_part(tn_plane_house *c, const tn_plane_part *part, uint32_t *number, tn_error *error)
{
    tn_strip *s = c->strip;
    tn_key *key = &s->joined;
    key->size = 0;
    if (!push_steps(c, part, key))
        return tn_fail_memory(error);
    tn_status status = push_sides(c, part, key, error);
    if (status == TN_OK && s->prices.asked)
        status = push_cost(c, key, error);
    *number = status == TN_OK ? tn_intern(&s->parts, key->data, key->size) : UINT32_MAX;
    return status == TN_OK && *number == UINT32_MAX ? tn_fail_memory(error) : status;
}
