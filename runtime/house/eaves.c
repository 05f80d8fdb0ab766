/* What of a roof reaches beyond the walls, and where rooms are open up to their roof. */
#include <stdlib.h>

#include "runtime/house/solids.h"

/* ---- eaves */

static int64_t eaves_of(const tn_house *house, uint32_t cell)
{
    const tn_shape_record *shape = tn_house_shape(house, house->cells[cell].zone, TN_CHOICE_ROOF);
    return shape ? shape->eaves : 0;
}

/* Strips along the sides, then corners. */
static void eaves_at(tn_rectangle r, int64_t wide, bool corners, tn_rectangle out[4])
{
    if (!corners) {
        out[0] = (tn_rectangle){r.x0, r.x1, r.y0 - wide, r.y0};
        out[1] = (tn_rectangle){r.x0, r.x1, r.y1, r.y1 + wide};
        out[2] = (tn_rectangle){r.x0 - wide, r.x0, r.y0, r.y1};
        out[3] = (tn_rectangle){r.x1, r.x1 + wide, r.y0, r.y1};
        return;
    }
    for (int i = 0; i < 4; i++) {
        int64_t x = i / 2 ? r.x1 : r.x0 - wide, y = i % 2 ? r.y1 : r.y0 - wide;
        out[i] = (tn_rectangle){x, x + wide, y, y + wide};
    }
}

static bool is_less(tn_fraction a, tn_fraction b)
{
    return a.top * b.bottom < b.top * a.bottom;
}

/* The lowest of a roof's line, or the highest. */
static tn_fraction extreme_of(const tn_solids *solids, const tn_prism *prism, bool highest)
{
    const tn_roof_point *points = solids->points + prism->point_first;
    tn_fraction extreme = points[0].z;
    for (size_t i = 1; i < prism->point_count; i++)
        if (highest ? is_less(extreme, points[i].z) : is_less(points[i].z, extreme))
            extreme = points[i].z;
    return extreme;
}

static tn_rectangle plan_of(const tn_solids *solids, const tn_prism *prism)
{
    const tn_roof_point *points = solids->points + prism->point_first, *last = points + prism->point_count - 1;
    int64_t from = (int64_t)(points->y.top / points->y.bottom), to = (int64_t)(last->y.top / last->y.bottom);
    return prism->across ? (tn_rectangle){from, to, prism->from, prism->to}
                         : (tn_rectangle){prism->from, prism->to, from, to};
}

/* Takes a strip's eaves out of the solids again where they would come down on a lower roof; that is kept free then. */
static tn_status clear_below(tn_solids *solids, size_t lower, size_t *kept, tn_rectangles *met, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t e = *kept; status == TN_OK && e < solids->prism_count; e++) {
        const tn_prism *eave = &solids->prisms[e];
        tn_rectangle at = plan_of(solids, eave);
        tn_fraction low = extreme_of(solids, eave, false);
        low.top -= (tn_int128)eave->slab * low.bottom;
        for (size_t i = 0; status == TN_OK && i < lower; i++) {
            tn_rectangle under = plan_of(solids, &solids->prisms[i]);
            bool over = at.x0 < under.x1 && under.x0 < at.x1 && at.y0 < under.y1 && under.y0 < at.y1;
            if (over && !is_less(extreme_of(solids, &solids->prisms[i], true), low))
                status = tn_rectangles_add(met, under, error);
        }
    }
    return status;
}

static tn_status put_free(const tn_house *house, uint32_t cell, const tn_rectangles *free, tn_solids *solids,
                          tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < free->count; i++)
        status = tn_roof_put(house, cell, free->items[i], true, house->form->level[house->cells[cell].storey + 1],
                             solids, error);
    return status;
}

/* Eaves over what is free of four rectangles; those of the first `lower` roofs are on lower levels. */
static tn_status put_eaves(const tn_house *house, uint32_t cell, tn_rectangle parts[4], size_t lower,
                           tn_rectangles *taken, tn_solids *solids, tn_error *error)
{
    tn_rectangles wanted = {.items = parts, .count = 4}, got = {0}, met = {0}, clear = {0};
    size_t kept = solids->prism_count, points = solids->point_count;
    tn_status status = tn_region_cut(&wanted, taken, &got, error);
    if (status == TN_OK)
        status = put_free(house, cell, &got, solids, error);
    if (status == TN_OK)
        status = clear_below(solids, lower, &kept, &met, error);
    if (status == TN_OK && met.count > 0) {
        solids->prism_count = kept;
        solids->point_count = points;
        status = tn_region_cut(&got, &met, &clear, error);
        if (status == TN_OK)
            status = put_free(house, cell, &clear, solids, error);
    }
    const tn_rectangles *own = met.count > 0 ? &clear : &got;
    for (size_t i = 0; status == TN_OK && i < own->count; i++)
        status = tn_rectangles_add(taken, own->items[i], error);
    free(got.items);
    free(met.items);
    free(clear.items);
    return status;
}

tn_status tn_roof_eaves(const tn_house *house, const tn_parcel *land, size_t count, tn_rectangles *taken,
                        tn_solids *solids, tn_error *error)
{
    tn_status status = TN_OK;
    size_t lower = 0; /* the roofs of a level come after those of lower ones */
    while (lower < solids->prism_count && count > 0 &&
           house->cells[solids->prisms[lower].of].storey < house->cells[land[0].cell].storey)
        lower++;
    for (size_t c = 0; status == TN_OK && c < count; c++)
        for (size_t i = 0; status == TN_OK && i < land[c].own.count; i++)
            status = tn_rectangles_add(taken, land[c].own.items[i], error);
    for (int corners = 0; corners < 2; corners++)
        for (size_t c = 0; status == TN_OK && c < count; c++) {
            int64_t wide = eaves_of(house, land[c].cell);
            tn_rectangle parts[4];
            if (wide == 0)
                continue;
            eaves_at(tn_cell_grown(house, &house->cells[land[c].cell]), wide, corners, parts);
            status = put_eaves(house, land[c].cell, parts, lower, taken, solids, error);
        }
    return status;
}

/* ---- rooms that are open to their roof */

static bool is_open_above(const tn_house *house, uint32_t cell)
{
    const tn_cell *c = &house->cells[cell], *above = c + 1;
    if (cell + 1 < house->cell_count && above->tray == c->tray && above->zone == c->zone)
        return false;
    const tn_shape_record *shape = tn_house_shape(house, c->zone, TN_CHOICE_ROOF);
    return shape && shape->flags & TN_ROOF_OPEN && !(shape->flags & TN_ROOF_ACROSS);
}

/* Does the roof go on in the same line beyond a face? */
static bool goes_on(const tn_house *house, const tn_face *face)
{
    if (face->second == TN_NO_CELL || face->kind != TN_FACE_OPEN)
        return false;
    const tn_cell *a = &house->cells[face->first], *b = &house->cells[face->second];
    return a->zone == b->zone && a->at.y0 == b->at.y0 && a->at.y1 == b->at.y1 && is_open_above(house, face->first) &&
           is_open_above(house, face->second);
}

tn_status tn_roof_inside(const tn_house *house, uint32_t cell, const tn_rectangles *foot, tn_rectangles *inside,
                         tn_error *error)
{
    const tn_form_record *form = house->form->record;
    int64_t half = (form->wall > form->partition ? form->wall : form->partition) / 2;
    tn_rectangles whole = {.items = (tn_rectangle[]){house->cells[cell].at}, .count = 1}, less = {0};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < foot->count; i++)
        status = tn_rectangles_add(&less, foot->items[i], error);
    for (size_t i = 0; status == TN_OK && i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->relation == TN_FACE_UNDER || (face->first != cell && face->second != cell) || goes_on(house, face))
            continue;
        tn_rectangle r = {face->at.x0 - half, face->at.x1 + half, face->at.y0 - half, face->at.y1 + half};
        status = tn_rectangles_add(&less, r, error);
    }
    if (status == TN_OK)
        status = tn_region_cut(&whole, &less, inside, error);
    free(less.items);
    return status;
}
