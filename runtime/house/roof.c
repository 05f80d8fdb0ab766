/* Builds the roofs: which cell covers what, the decks below, and prisms under a flat, a sloped or a vaulted line. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/solids.h"

static tn_status add_point(tn_solids *solids, tn_roof_point point, tn_error *error)
{
    if (!tn_array_reserve_from(&solids->points, &solids->point_room, 64, solids->point_count, 1,
                               sizeof *solids->points))
        return tn_fail_memory(error);
    solids->points[solids->point_count++] = point;
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

tn_status tn_roof_put(const tn_house *house, uint32_t index, tn_rectangle r, bool slab, int64_t base, tn_solids *solids,
                      tn_error *error)
{
    const tn_cell *cell = &house->cells[index];
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    bool across = shape && shape->flags & TN_ROOF_ACROSS;
    tn_profile profile = tn_roof_profile(house, cell);
    int64_t eaves = house->form->level[cell->storey + 1] + house->form->record->roof;
    tn_prism prism = {.of = index,
                      .across = across,
                      .from = across ? r.y0 : r.x0,
                      .to = across ? r.y1 : r.x1,
                      .base = base,
                      .slab = slab ? house->form->record->roof : 0,
                      .point_first = solids->point_count};
    tn_int128 first = (tn_int128)(across ? r.x0 : r.y0) * profile.y_bottom,
              last = (tn_int128)(across ? r.x1 : r.y1) * profile.y_bottom;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < profile.count + 2; i++) {
        tn_int128 y = i == 0 ? first : i == profile.count + 1 ? last : profile.y[i - 1];
        bool between = y > first && y < last;
        if (i == 0 || i == profile.count + 1 || between)
            status = add_point(
                solids, (tn_roof_point){tn_fraction_new(y, profile.y_bottom), tn_profile_height(&profile, y, eaves)},
                error);
    }
    prism.point_count = solids->point_count - prism.point_first;
    return status == TN_OK ? add_prism(solids, prism, error) : status;
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

static tn_status put_roof(const tn_house *house, uint32_t cell, const tn_rectangles *over, bool slab, int64_t base,
                          tn_solids *solids, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < over->count; i++)
        status = tn_roof_put(house, cell, over->items[i], slab, base, solids, error);
    return status;
}

/* A room that is open to its roof has a slab above, without a deck. Over walls and beside other roofs it is solid. */
static tn_status put_open(const tn_house *house, const tn_parcel *decked, const tn_parcel *land,
                          const tn_rectangles *foot, tn_solids *solids, tn_error *error)
{
    int64_t level = house->form->level[house->cells[land->cell].storey + 1];
    tn_rectangles inside = {0}, solid = {0}, slab = {0}, deck = {0};
    tn_status status = tn_roof_inside(house, land->cell, foot, &inside, error);
    if (status == TN_OK)
        status = tn_region_cut(&decked->own, &land->own, &deck, error);
    if (status == TN_OK)
        status = tn_region_cut(&land->own, &inside, &solid, error);
    if (status == TN_OK)
        status = tn_region_cut(&land->own, &solid, &slab, error);
    if (status == TN_OK)
        status = put_deck(house, land->cell, &deck, solids, error);
    if (status == TN_OK)
        status = put_roof(house, land->cell, &solid, false, level - house->form->record->deck, solids, error);
    if (status == TN_OK)
        status = put_roof(house, land->cell, &slab, true, level, solids, error);
    free(inside.items);
    free(solid.items);
    free(slab.items);
    free(deck.items);
    return status;
}

static tn_status put_parcel(const tn_house *house, const tn_parcel *decked, const tn_parcel *land,
                            const tn_rectangles *foot, tn_solids *solids, tn_error *error)
{
    const tn_cell *cell = &house->cells[land->cell];
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    if (shape && shape->flags & TN_ROOF_OPEN)
        return put_open(house, decked, land, foot, solids, error);
    tn_status status = put_deck(house, land->cell, &decked->own, solids, error);
    return status == TN_OK
               ? put_roof(house, land->cell, &land->own, false, house->form->level[cell->storey + 1], solids, error)
               : status;
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
