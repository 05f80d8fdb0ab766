/* Builds the roofs: which cell covers what, the decks below, and slabs over it, with walls below them. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/solids.h"

/* ---- slabs */

static tn_status add_corner(tn_solids *solids, tn_prism_corner corner, tn_error *error)
{
    if (!tn_array_reserve_from(&solids->corners, &solids->corner_room, 64, solids->corner_count, 1,
                               sizeof *solids->corners))
        return tn_fail_memory(error);
    solids->corners[solids->corner_count++] = corner;
    return TN_OK;
}

static tn_status add_prism(tn_solids *solids, tn_prism prism, tn_error *error)
{
    if (!tn_array_reserve_from(&solids->prisms, &solids->prism_room, 32, solids->prism_count, 1,
                               sizeof *solids->prisms))
        return tn_fail_memory(error);
    solids->prisms[solids->prism_count++] = prism;
    return TN_OK;
}

/* The slab over a facet whose foot is at a level, or the wall from a level up to that. */
static tn_status put_facet(const tn_slopes *slopes, const tn_facet *facet, tn_prism prism, int64_t foot, int64_t thick,
                           const int64_t *base, tn_solids *solids, tn_error *error)
{
    tn_int128 rise = slopes->items[facet->plane].x + slopes->items[facet->plane].y; /* one of them is 0 */
    bool high = false;
    tn_status status = TN_OK;
    prism.plane = facet->plane;
    prism.rise = tn_fraction_new(rise < 0 ? -rise : rise, slopes->bottom);
    prism.corner_first = solids->corner_count;
    prism.corner_count = facet->count;
    for (size_t i = 0; status == TN_OK && i < facet->count; i++) {
        tn_fraction x = facet->at[i][0], y = facet->at[i][1], z = tn_slope_at(slopes, facet->plane, x, y, foot);
        tn_prism_corner corner = {x, y, z, tn_fraction_raised(z, thick)};
        if (base)
            corner = (tn_prism_corner){x, y, tn_fraction_whole(*base), z};
        high = high || tn_fraction_less(corner.low, corner.high);
        status = add_corner(solids, corner, error);
    }
    if (status == TN_OK && high)
        return add_prism(solids, prism, error);
    solids->corner_count = prism.corner_first; /* on a deck below a flat roof no wall stands */
    return status;
}

tn_status tn_roof_put(const tn_house *house, uint32_t index, tn_rectangle r, const tn_gable *wall, tn_solids *solids,
                      tn_error *error)
{
    tn_facet facets[TN_FACETS_MAX];
    tn_slopes slopes = tn_roof_slopes_of(house, index);
    size_t count = tn_slopes_cut(&slopes, r, facets);
    int64_t foot = house->form->level[house->cells[index].storey + 1], thick = house->form->record->roof;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_prism prism = {.kind = TN_SOLID_ROOF, .of = index, .over = r};
        status = put_facet(&slopes, &facets[i], prism, foot, thick, NULL, solids, error);
        if (status != TN_OK || !wall)
            continue;
        prism.kind = TN_SOLID_GABLE;
        prism.item = wall->face;
        status = put_facet(&slopes, &facets[i], prism, foot, thick, &wall->base, solids, error);
    }
    return status;
}

/* ---- layers */

/* A layer of a slab is a slab. */
static tn_status put_slab_layer(const tn_solids *solids, const tn_prism *slab, const tn_layering *layers,
                                uint32_t layer, tn_solids *pieces, tn_error *error)
{
    int64_t thick = tn_form_layer(layers->form, layer)->thick, above = 0;
    tn_prism piece = *slab;
    tn_status status = TN_OK;
    for (uint32_t i = layers->first; i < layer; i++)
        above += tn_form_layer(layers->form, i)->thick;
    piece.corner_first = pieces->corner_count;
    for (size_t i = 0; status == TN_OK && i < slab->corner_count; i++) {
        tn_prism_corner corner = solids->corners[slab->corner_first + i];
        corner.high = tn_fraction_raised(corner.high, -above);
        corner.low = tn_fraction_raised(corner.high, -thick);
        status = add_corner(pieces, corner, error);
    }
    return status == TN_OK ? add_prism(pieces, piece, error) : status;
}

static tn_facet facet_of(const tn_solids *solids, const tn_prism *prism)
{
    tn_facet facet = {.plane = prism->plane, .count = prism->corner_count};
    for (size_t i = 0; i < facet.count; i++) {
        facet.at[i][0] = solids->corners[prism->corner_first + i].x;
        facet.at[i][1] = solids->corners[prism->corner_first + i].y;
    }
    return facet;
}

/* A layer of a wall below a slab is what that is over the layer's part of the plan. */
static tn_status put_gable_layer(const tn_house *house, const tn_solids *solids, const tn_prism *wall,
                                 const tn_layering *layers, uint32_t layer, tn_solids *pieces, tn_error *error)
{
    tn_rectangle at = tn_gable_layer_at(house, wall->item, layers, layer);
    tn_prism piece = *wall;
    tn_facet facet = facet_of(solids, wall);
    tn_slopes slopes = tn_roof_slopes_of(house, wall->of);
    int64_t foot = house->form->level[house->cells[wall->of].storey + 1],
            base = (int64_t)solids->corners[wall->corner_first].low.top; /* a whole number */
    piece.over = tn_rectangles_common(&wall->over, &at);
    tn_facet_keep(&facet, at);
    return facet.count > 0 ? put_facet(&slopes, &facet, piece, foot, 0, &base, pieces, error) : TN_OK;
}

tn_status tn_layer_prisms(const tn_house *house, const tn_solids *solids, const tn_prism *prism,
                          const tn_layering *layers, uint32_t layer, tn_solids *pieces, tn_error *error)
{
    return prism->kind == TN_SOLID_ROOF ? put_slab_layer(solids, prism, layers, layer, pieces, error)
                                        : put_gable_layer(house, solids, prism, layers, layer, pieces, error);
}

/* ---- who covers what */

/* The rectangles of one step: the cell; strips half a wall wide along its sides; corners. */
static size_t step_of(const tn_cell *cell, int64_t g, int step, tn_rectangle out[4])
{
    int64_t x0 = cell->at.x0, x1 = cell->at.x1, y0 = cell->at.y0, y1 = cell->at.y1;
    if (step == 0) {
        out[0] = cell->at;
        return 1;
    }
    if (step == 1) {
        out[0] = (tn_rectangle){x0, x1, y0 - g, y0};
        out[1] = (tn_rectangle){x0, x1, y1, y1 + g};
        out[2] = (tn_rectangle){x0 - g, x0, y0, y1};
        out[3] = (tn_rectangle){x1, x1 + g, y0, y1};
        return 4;
    }
    for (int i = 0; i < 4; i++) {
        int64_t x = i / 2 ? x1 : x0 - g, y = i % 2 ? y1 : y0 - g;
        out[i] = (tn_rectangle){x, x + g, y, y + g};
    }
    return 4;
}

static tn_status take(const tn_cell *cell, int64_t g, int step, tn_rectangles *taken, tn_rectangles *own,
                      tn_error *error)
{
    tn_rectangle parts[4];
    tn_rectangles wanted = {.items = parts, .count = step_of(cell, g, step, parts)}, got = {0};
    tn_status status = tn_region_cut(&wanted, taken, &got, error);
    for (size_t i = 0; status == TN_OK && i < got.count; i++) {
        status = tn_rectangles_add(own, got.items[i], error);
        if (status == TN_OK)
            status = tn_rectangles_add(taken, got.items[i], error);
    }
    free(got.items);
    return status;
}

/* Each cell takes what is free: first its rectangle, then the strips, then the corners, in cell order. */
static tn_status parcel(const tn_house *house, tn_parcel *covered, size_t count, const tn_rectangles *before,
                        tn_error *error)
{
    tn_rectangles taken = {0}, nothing = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < before->count; i++)
        status = tn_rectangles_add(&taken, before->items[i], error);
    for (int step = 0; step < 3; step++)
        for (size_t i = 0; status == TN_OK && i < count; i++)
            status = take(&house->cells[covered[i].cell], house->form->record->wall / 2, step, &taken, &covered[i].own,
                          error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_rectangles whole = {0};
        status = tn_region_cut(&covered[i].own, &nothing, &whole, error);
        free(covered[i].own.items);
        covered[i].own = whole;
    }
    free(taken.items);
    return status;
}

/* ---- a level */

/* What the cells of the storey above cover. */
static tn_status above_of(const tn_house *house, uint32_t storey, tn_rectangles *above, tn_error *error)
{
    tn_rectangles cells = {0}, nothing = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < house->cell_count; i++)
        if (house->cells[i].storey == storey + 1)
            status = tn_rectangles_add(&cells, tn_cell_grown(house, &house->cells[i]), error);
    if (status == TN_OK)
        status = tn_region_cut(&cells, &nothing, above, error);
    free(cells.items);
    return status;
}

static tn_status put_deck(const tn_house *house, uint32_t cell, const tn_rectangles *of, tn_solids *solids,
                          tn_error *error)
{
    int64_t level = house->form->level[house->cells[cell].storey + 1];
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < of->count; i++) {
        tn_rectangle r = of->items[i];
        tn_box at = {r.x0, r.x1, r.y0, r.y1, level - house->form->record->deck, level};
        status = tn_solids_add(solids, (tn_solid){.kind = TN_SOLID_ROOFDECK, .of = cell, .at = at}, error);
    }
    return status;
}

static tn_status put_over(const tn_house *house, uint32_t cell, const tn_rectangles *over, const tn_gable *wall,
                          tn_solids *solids, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < over->count; i++)
        status = tn_roof_put(house, cell, over->items[i], wall, solids, error);
    return status;
}

/* Walls from a level up; if walls have layers, each as the wall of one of the cell's faces. Takes them out of the
 * list. */
static tn_status put_walls(const tn_house *house, uint32_t cell, int64_t base, tn_rectangles *walls, tn_solids *solids,
                           tn_error *error)
{
    bool layered = house->form->layers_end[TN_LAYERED_PARTY] > 0;
    tn_status status = TN_OK;
    for (int in_y = 0; layered && in_y < 2; in_y++)
        for (uint32_t f = 0; status == TN_OK && f < house->face_count; f++) {
            const tn_face *face = &house->faces[f];
            tn_rectangles at = {0};
            if ((face->at.x0 == face->at.x1) != in_y)
                continue;
            status = tn_roof_walls_at(house, cell, f, walls, &at, error);
            if (status == TN_OK)
                status = put_over(house, cell, &at, &(tn_gable){base, f}, solids, error);
            free(at.items);
        }
    return status == TN_OK ? put_over(house, cell, walls, &(tn_gable){base, TN_NO_FACE}, solids, error) : status;
}

/* A room that is open to its roof has no deck below that, but where what stands above it leaves one. */
static tn_status put_decks(const tn_house *house, const tn_parcel *decked, const tn_parcel *land, bool open,
                           tn_solids *solids, tn_error *error)
{
    tn_rectangles deck = {0};
    if (!open)
        return put_deck(house, land->cell, &decked->own, solids, error);
    tn_status status = tn_region_cut(&decked->own, &land->own, &deck, error);
    if (status == TN_OK)
        status = put_deck(house, land->cell, &deck, solids, error);
    free(deck.items);
    return status;
}

/* The deck, the slab and the walls between them; without a deck these go up from the walls of the storey. */
static tn_status put_parcel(const tn_house *house, const tn_parcel *decked, const tn_parcel *land,
                            const tn_rectangles *foot, tn_solids *solids, tn_error *error)
{
    bool open = tn_cell_is_open_above(house, land->cell);
    int64_t base = house->form->level[house->cells[land->cell].storey + 1] - (open ? house->form->record->deck : 0);
    tn_rectangles walls = {0}, empty = {0};
    tn_status status = put_decks(house, decked, land, open, solids, error);
    if (status == TN_OK)
        status = tn_roof_walls(house, land, foot, &walls, &empty, error);
    if (status == TN_OK)
        status = put_walls(house, land->cell, base, &walls, solids, error);
    if (status == TN_OK)
        status = put_over(house, land->cell, &empty, NULL, solids, error);
    free(walls.items);
    free(empty.items);
    return status;
}

/* The roofs over the cells of a storey that end their stacks. */
static tn_status put_level(const tn_house *house, uint32_t storey, const tn_rectangles *deck, const tn_rectangles *foot,
                           tn_solids *solids, tn_error *error)
{
    tn_parcel *land = calloc(2 * house->cell_count + 1, sizeof *land), *decked = land ? land + house->cell_count : NULL;
    tn_rectangles above = {0};
    size_t count = 0;
    if (!land)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < house->cell_count; i++)
        if (house->cells[i].storey == storey && tn_cell_is_top(house, i)) {
            land[count].cell = i;
            decked[count++].cell = i;
        }
    tn_status status = count ? above_of(house, storey, &above, error) : TN_OK;
    if (status == TN_OK)
        status = parcel(house, decked, count, deck, error);
    if (status == TN_OK)
        status = parcel(house, land, count, &above, error);
    for (size_t c = 0; status == TN_OK && c < count; c++)
        status = put_parcel(house, &decked[c], &land[c], foot, solids, error);
    if (status == TN_OK)
        status = tn_roof_eaves(house, land, count, &above, solids, error);
    for (size_t i = 0; i < count; i++) {
        free(land[i].own.items);
        free(decked[i].own.items);
    }
    free(above.items);
    free(land);
    return status;
}

tn_status tn_house_roofs(const tn_house *house, const tn_rectangles *decks, const tn_rectangles *foot,
                         tn_solids *solids, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < house->form->record->storey_count; k++)
        status = put_level(house, k, &decks[k + 1], &foot[k], solids, error);
    return status;
}
