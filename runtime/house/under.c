/* What is below the slab of a roof: walls, and otherwise nothing. */
#include <stdlib.h>

#include "runtime/house/solids.h"

bool tn_cell_is_open_above(const tn_house *house, uint32_t cell)
{
    const tn_shape_record *shape = tn_house_shape(house, house->cells[cell].zone, TN_CHOICE_ROOF);
    return tn_cell_is_top(house, cell) && shape && shape->flags & TN_ROOF_OPEN;
}

/* Is the roof that of the cell before, too, in one line? One that goes across the row has a ridge for each cell. */
static bool is_one_roof(const tn_house *house, const tn_face *face)
{
    if (face->second == TN_NO_CELL)
        return false;
    const tn_cell *a = &house->cells[face->first], *b = &house->cells[face->second];
    const tn_shape_record *shape = tn_house_shape(house, a->zone, TN_CHOICE_ROOF);
    return a->zone == b->zone && a->at.y0 == b->at.y0 && a->at.y1 == b->at.y1 && tn_cell_is_top(house, face->first) &&
           tn_cell_is_top(house, face->second) && !(shape && shape->flags & TN_ROOF_ACROSS);
}

/* Does the roof of a cell rise to a level line at a face? *at: how high it is there, above its foot. */
static bool rises_to(const tn_house *house, uint32_t cell, const tn_rectangle *face, tn_fraction *at)
{
    tn_slopes slopes = tn_roof_slopes_of(house, cell);
    tn_fraction end = tn_slopes_at(&slopes, tn_fraction_whole(face->x1), tn_fraction_whole(face->y1), 0),
                highest = tn_slopes_highest(&slopes, house->cells[cell].at, 0);
    *at = tn_slopes_at(&slopes, tn_fraction_whole(face->x0), tn_fraction_whole(face->y0), 0);
    return !tn_fraction_less(*at, highest) && !tn_fraction_less(end, highest);
}

/* Do two roofs rise to each other, as sheds do to a ridge? If one is higher, it is by less than the slab, so that
 * nothing is open between them. */
static bool meet_at_ridge(const tn_house *house, const tn_face *face)
{
    int64_t roof = house->form->record->roof;
    tn_fraction first, second;
    return face->second != TN_NO_CELL && tn_cell_is_top(house, face->first) && tn_cell_is_top(house, face->second) &&
           tn_cell_is_open_above(house, face->first) == tn_cell_is_open_above(house, face->second) &&
           rises_to(house, face->first, &face->at, &first) && rises_to(house, face->second, &face->at, &second) &&
           tn_fraction_less(first, tn_fraction_raised(second, roof)) &&
           tn_fraction_less(second, tn_fraction_raised(first, roof));
}

/* Does nothing stand between both cells below their roof? Two attics are one; two rooms are if their side is open. */
static bool goes_on(const tn_house *house, const tn_face *face, bool open)
{
    return (is_one_roof(house, face) || meet_at_ridge(house, face)) && face->kind != TN_FACE_PARTY && (!open || face->kind == TN_FACE_OPEN);
}

/* The strips along faces where a wall goes up to the roof, half a wall to either side. */
static tn_status add_strips(const tn_house *house, uint32_t cell, bool open, tn_rectangles *strips, tn_error *error)
{
    const tn_form_record *form = house->form->record;
    int64_t half = (form->wall > form->partition ? form->wall : form->partition) / 2;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER || (face->first != cell && face->second != cell) ||
            goes_on(house, face, open))
            continue;
        status = tn_rectangles_add(strips, tn_rectangle_grown(&face->at, half), error);
    }
    return status;
}

tn_status tn_roof_walls_at(const tn_house *house, uint32_t cell, uint32_t index, tn_rectangles *walls,
                           tn_rectangles *at, tn_error *error)
{
    const tn_face *face = &house->faces[index];
    tn_rectangle strip = tn_rectangle_grown(&face->at, house->form->record->wall / 2);
    tn_rectangles rest = {0};
    tn_status status = TN_OK;
    if (face->relation == TN_FACE_UNDER || (face->first != cell && face->second != cell) ||
        goes_on(house, face, tn_cell_is_open_above(house, cell)))
        return TN_OK;
    for (size_t i = 0; status == TN_OK && i < walls->count; i++)
        if (tn_rectangles_meet(&walls->items[i], &strip))
            status = tn_rectangles_add(at, tn_rectangles_common(&walls->items[i], &strip), error);
    if (status == TN_OK)
        status = tn_region_cut(walls, at, &rest, error);
    free(walls->items);
    *walls = rest;
    return status;
}

tn_status tn_roof_walls(const tn_house *house, const tn_parcel *land, const tn_rectangles *foot, tn_rectangles *walls,
                        tn_rectangles *empty, tn_error *error)
{
    bool open = tn_cell_is_open_above(house, land->cell);
    tn_rectangles less = {0}, inside = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && open && i < foot->count; i++)
        status = tn_rectangles_add(&less, foot->items[i], error);
    if (status == TN_OK)
        status = add_strips(house, land->cell, open, &less, error);
    if (status == TN_OK && open) { /* a room ends at the planes of its cell */
        tn_rectangles cell = {.items = (tn_rectangle[]){house->cells[land->cell].at}, .count = 1};
        status = tn_region_cut(&cell, &less, &inside, error);
    } else if (status == TN_OK) {
        status = tn_region_cut(&land->own, &less, &inside, error);
    }
    if (status == TN_OK)
        status = tn_region_cut(&land->own, &inside, walls, error);
    if (status == TN_OK)
        status = tn_region_cut(&land->own, walls, empty, error);
    free(less.items);
    free(inside.items);
    return status;
}
