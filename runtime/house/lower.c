/* The line of a roof, and how high lower roofs stand before an opening. */
#include "runtime/house/solids.h"

enum { VAULT_STEPS = TN_PROFILE_MAX - 1 };

/* ---- the line of a roof */

static tn_profile profile_of(const tn_shape_record *shape, int64_t y0, int64_t y1)
{
    tn_int128 from = y0, to = y1, wide = to - from, rise = shape ? shape->rise : 0;
    tn_int128 run = shape && shape->run ? shape->run : 1;
    switch (shape ? (tn_roof_kind)shape->roof : TN_ROOF_FLAT) {
    case TN_ROOF_SHED_BACK:
        return (tn_profile){{from, to}, {0, wide * rise}, 1, run, 2};
    case TN_ROOF_SHED_FRONT:
        return (tn_profile){{from, to}, {wide * rise, 0}, 1, run, 2};
    case TN_ROOF_GABLE:
        return (tn_profile){{2 * from, from + to, 2 * to}, {0, wide * rise, 0}, 2, 2 * run, 3};
    case TN_ROOF_VAULT: {
        tn_profile profile = {.y_bottom = VAULT_STEPS, .z_bottom = VAULT_STEPS * VAULT_STEPS, .count = TN_PROFILE_MAX};
        for (int i = 0; i <= VAULT_STEPS; i++) {
            profile.y[i] = from * VAULT_STEPS + wide * i;
            profile.z[i] = (tn_int128)shape->height * 4 * i * (VAULT_STEPS - i);
        }
        return profile;
    }
    default:
        return (tn_profile){{from, to}, {0, 0}, 1, 1, 2};
    }
}

tn_fraction tn_profile_height(const tn_profile *profile, tn_int128 y, int64_t base)
{
    size_t i = 0;
    while (i + 2 < profile->count && profile->y[i + 1] < y)
        i++;
    tn_int128 run = profile->y[i + 1] - profile->y[i], rise = profile->z[i + 1] - profile->z[i];
    tn_fraction slope = tn_fraction_new(rise, run * profile->z_bottom); /* of a y in fractions */
    tn_fraction part = tn_fraction_new((y - profile->y[i]) * slope.top, slope.bottom);
    tn_fraction start = tn_fraction_new(profile->z[i] + (tn_int128)base * profile->z_bottom, profile->z_bottom);
    return tn_fraction_new(start.top * part.bottom + part.top * start.bottom, start.bottom * part.bottom);
}

tn_profile tn_roof_profile(const tn_house *house, const tn_cell *cell)
{
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    tn_rectangle grown = tn_cell_grown(house, cell);
    bool across = shape && shape->flags & TN_ROOF_ACROSS;
    return across ? profile_of(shape, grown.x0, grown.x1) : profile_of(shape, grown.y0, grown.y1);
}

/* ---- lower roofs */

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

static void raise_to(tn_fraction height, bool *any, tn_fraction *top)
{
    if (!*any || height.top * top->bottom > top->top * height.bottom)
        *top = height;
    *any = true;
}

/* Raises the top to the highest point of a cell's roof along a line. */
static void raise_along(const tn_house *house, uint32_t index, tn_rectangle line, bool *any, tn_fraction *top)
{
    const tn_cell *cell = &house->cells[index];
    const tn_shape_record *shape = tn_house_shape(house, cell->zone, TN_CHOICE_ROOF);
    bool across = shape && shape->flags & TN_ROOF_ACROSS;
    tn_profile profile = tn_roof_profile(house, cell);
    int64_t base = house->form->level[cell->storey + 1] + house->form->record->roof;
    tn_int128 from = (tn_int128)(across ? line.x0 : line.y0) * profile.y_bottom,
              to = (tn_int128)(across ? line.x1 : line.y1) * profile.y_bottom;
    raise_to(tn_profile_height(&profile, from, base), any, top);
    raise_to(tn_profile_height(&profile, to, base), any, top);
    for (size_t i = 0; i < profile.count; i++)
        if (profile.y[i] > from && profile.y[i] < to)
            raise_to(tn_profile_height(&profile, profile.y[i], base), any, top);
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
