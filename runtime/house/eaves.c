/* What of a roof reaches beyond the walls. */
#include <stdlib.h>

#include "runtime/house/solids.h"

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

/* The lowest corner of a prism, or the highest. */
static tn_fraction extreme_of(const tn_solids *solids, const tn_prism *prism, bool highest)
{
    const tn_prism_corner *corners = solids->corners + prism->corner_first;
    tn_fraction extreme = highest ? corners[0].high : corners[0].low;
    for (size_t i = 1; i < prism->corner_count; i++) {
        tn_fraction z = highest ? corners[i].high : corners[i].low;
        extreme = tn_fraction_less(highest ? extreme : z, highest ? z : extreme) ? z : extreme;
    }
    return extreme;
}

/* Where a strip's eaves, the prisms from `first` on, come down on a lower roof: the rectangles of that. */
static tn_status find_met(const tn_solids *solids, size_t lower, size_t first, tn_rectangles *met, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t e = first; status == TN_OK && e < solids->prism_count; e++) {
        const tn_prism *eave = &solids->prisms[e];
        tn_fraction low = extreme_of(solids, eave, false);
        for (size_t i = 0; status == TN_OK && i < lower; i++) {
            const tn_prism *under = &solids->prisms[i];
            if (tn_rectangles_meet(&eave->over, &under->over) &&
                !tn_fraction_less(extreme_of(solids, under, true), low))
                status = tn_rectangles_add(met, under->over, error);
        }
    }
    return status;
}

static tn_status put_free(const tn_house *house, uint32_t cell, const tn_rectangles *free, tn_solids *solids,
                          tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < free->count; i++)
        status = tn_roof_put(house, cell, free->items[i], NULL, solids, error);
    return status;
}

/* Eaves over what is free of four rectangles; those of the first `lower` roofs are on lower levels. */
static tn_status put_eaves(const tn_house *house, uint32_t cell, tn_rectangle parts[4], size_t lower,
                           tn_rectangles *taken, tn_solids *solids, tn_error *error)
{
    tn_rectangles wanted = {.items = parts, .count = 4}, got = {0}, met = {0}, clear = {0};
    size_t kept = solids->prism_count, corners = solids->corner_count;
    tn_status status = tn_region_cut(&wanted, taken, &got, error);
    if (status == TN_OK)
        status = put_free(house, cell, &got, solids, error);
    if (status == TN_OK)
        status = find_met(solids, lower, kept, &met, error);
    if (status == TN_OK && met.count > 0) {
        solids->prism_count = kept;
        solids->corner_count = corners;
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
