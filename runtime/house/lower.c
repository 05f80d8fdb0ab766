/* How high lower roofs stand before an opening. */
#include "runtime/house/solids.h"

bool tn_cell_is_top(const tn_house *house, uint32_t cell)
{
    const tn_cell *c = &house->cells[cell], *above = c + 1; /* cells are in order */
    return cell + 1 == house->cell_count || above->tray != c->tray || above->zone != c->zone;
}

/* Sets y0 and y1 to where the roof of a cell begins and ends in its tray: half a wall beyond the cell, or where other
 * cells of the storey begin, or the walls of those of the next. */
static tn_rectangle roof_of(const tn_house *house, uint32_t index)
{
    const tn_cell *cell = &house->cells[index];
    tn_rectangle r = tn_cell_grown(house, cell);
    for (uint32_t i = house->tray_first[cell->tray]; i < house->tray_first[cell->tray + 1]; i++) {
        const tn_cell *other = &house->cells[i];
        int64_t half = other->storey > cell->storey ? house->form->record->wall / 2 : 0;
        if (i == index || other->storey < cell->storey || other->storey > cell->storey + 1)
            continue;
        if (other->at.y1 <= cell->at.y0 && other->at.y1 + half > r.y0)
            r.y0 = other->at.y1 + half;
        if (other->at.y0 >= cell->at.y1 && other->at.y0 - half < r.y1)
            r.y1 = other->at.y0 - half;
    }
    return r;
}

/* The line on the outer side of a face's wall along which an opening stands, or (NULL) the whole wall. */
static tn_rectangle opening_line(const tn_house *house, const tn_face *face, const tn_opening_record *opening)
{
    bool along = face->side == TN_HOUSE_LEFT || face->side == TN_HOUSE_RIGHT;
    int64_t half = house->form->record->wall / 2;
    int64_t out = face->side == TN_HOUSE_LEFT || face->side == TN_HOUSE_BACK ? -half : half;
    int64_t at = along ? face->at.x0 + out : face->at.y0 + out;
    int64_t from = along ? face->at.y0 : face->at.x0, to = along ? face->at.y1 : face->at.x1;
    if (opening) {
        from = tn_opening_begins(face, opening);
        to = from + opening->wide;
    }
    return along ? (tn_rectangle){at, at, from, to} : (tn_rectangle){from, to, at, at};
}

/* Cuts the line down to where the roof of a cell stands against it; false where it does not. */
static bool meets_roof(const tn_house *house, const tn_face *face, uint32_t cell, tn_rectangle *line)
{
    tn_rectangle roof = roof_of(house, cell);
    if (face->side == TN_HOUSE_BACK || face->side == TN_HOUSE_FRONT)
        return roof.y0 < roof.y1 && line->y0 == (face->side == TN_HOUSE_BACK ? roof.y1 : roof.y0);
    line->y0 = line->y0 > roof.y0 ? line->y0 : roof.y0;
    line->y1 = line->y1 < roof.y1 ? line->y1 : roof.y1;
    return line->y0 < line->y1;
}

/* Raises the top to the highest point of a cell's roof along a line. A hip counts as the gable that it is cut from: how
 * far away its ends are is nothing that trays beside each other know. */
static void raise_along(const tn_house *house, uint32_t index, tn_rectangle line, bool *any, tn_fraction *top)
{
    const tn_cell *cell = &house->cells[index];
    tn_slopes slopes = tn_roof_slopes(house, cell);
    tn_fraction height =
        tn_slopes_highest(&slopes, line, house->form->level[cell->storey + 1] + house->form->record->roof);
    if (!*any || tn_fraction_less(*top, height))
        *top = height;
    *any = true;
}

bool tn_face_roofed(const tn_house *house, const tn_face *face, const tn_opening_record *opening, tn_fraction *top)
{
    uint32_t tray = house->cells[face->first].tray;
    bool any = false;
    if (face->relation != TN_FACE_OUTSIDE || face->storey == 0 || (face->side == TN_HOUSE_LEFT && tray == 0))
        return false;
    tray += face->side == TN_HOUSE_RIGHT ? 1u : face->side == TN_HOUSE_LEFT ? UINT32_MAX : 0u;
    if (tray == house->length)
        return false;
    for (uint32_t i = house->tray_first[tray]; i < house->tray_first[tray + 1]; i++) {
        tn_rectangle line = opening_line(house, face, opening);
        if (house->cells[i].storey < face->storey && tn_cell_is_top(house, i) && meets_roof(house, face, i, &line))
            raise_along(house, i, line, &any, top);
    }
    return any;
}
