/* Counts the houses with the functions at hand. Faces that clauses can depend on are turned together; those that only
 * matter to the tiles of one cell are summed up cell by cell, and the cells multiplied. */
#include "runtime/house/variant/furnish.h"
#include "runtime/house/variant/parts.h"

/* Posts stand at both ends of an open side, also in the cells beside: their tiles can depend on it. */
static bool may_be_open(const tn_house_variants *v, const tn_wheel *w)
{
    bool open = false;
    for (uint32_t k = 0; k < w->count; k++)
        open = open || v->faces.choices[w->first + k] == TN_FACE_OPEN;
    return open;
}

/* Of the wheels that are set there is only the choice at hand. What is outside of a cell comes after what is outside of
 * the cells before it: faces are in that order. */
static tn_status split_faces(tn_house_variants *v, tn_error *error)
{
    tn_status status = TN_OK;
    tn_wheels_clear(&v->shared);
    tn_wheels_clear(&v->own);
    for (size_t i = 0; status == TN_OK && i < v->faces.count; i++) {
        const tn_wheel *w = &v->faces.items[i];
        bool relevant = v->asks_costs || may_be_open(v, w) ||
                        tn_face_relevant(&v->house, &v->questions, &v->house.faces[w->of]),
             set = i < v->faces_set;
        status = tn_wheels_add(relevant ? &v->shared : &v->own, w->of, v->faces.choices + w->first + (set ? w->at : 0),
                               set ? 1 : w->count, error);
    }
    return status;
}

static void set_kinds(tn_house_variants *v, const tn_wheels *wheels, size_t first, size_t end)
{
    for (size_t i = first; i < end; i++)
        v->house.faces[wheels->items[i].of].kind = tn_wheel_chosen(wheels, i);
}

/* The houses that differ in one cell only: in the tiles that fit it, and in what is in its own faces. */
typedef struct tn_cell_count {
    uint64_t houses, faced; /* tiles of all kinds of its faces; kinds that leave a tile */
} tn_cell_count;

/* A cell without tiles takes whatever is in its faces. */
static tn_cell_count take_any(const tn_wheels *wheels, size_t first, size_t end)
{
    tn_cell_count count = {1, 1};
    for (size_t i = first; i < end; i++)
        count.houses *= wheels->items[i].count;
    count.faced = count.houses;
    return count;
}

static tn_status count_cell(tn_house_variants *v, uint32_t cell, size_t first, size_t end, tn_cell_count *count,
                            tn_error *error)
{
    if (!tn_fits_wanted(&v->fits, &v->house.cells[cell])) {
        *count = take_any(&v->own, first, end);
        return tn_variants_spend(v, 1, error);
    }
    tn_status status;
    *count = (tn_cell_count){0};
    do {
        size_t tiles = 0;
        set_kinds(v, &v->own, first, end);
        status = tn_variants_spend(v, 1, error);
        if (status == TN_OK)
            status = tn_fits_count(&v->fits, &v->house, cell, &tiles, error);
        count->houses += tiles;
        count->faced += tiles > 0;
    } while (status == TN_OK && tn_wheels_turn(&v->own, first, end));
    return status;
}

static tn_status count_cells(tn_house_variants *v, mpz_t houses, mpz_t faced, tn_error *error)
{
    tn_status status = TN_OK;
    size_t first = 0;
    mpz_set_ui(houses, 1);
    mpz_set_ui(faced, 1);
    for (uint32_t i = 0; status == TN_OK && i < v->house.cell_count && mpz_sgn(houses) > 0; i++) {
        tn_cell_count count;
        size_t end = first;
        while (end < v->own.count && v->house.faces[v->own.items[end].of].first == i)
            end++;
        status = count_cell(v, i, first, end, &count, error);
        mpz_mul_ui(houses, houses, count.houses);
        mpz_mul_ui(faced, faced, count.faced);
        first = end;
    }
    return status;
}

/* All faces are known: the combinations of tiles with which clauses keep the house. */
static tn_status count_kept(tn_house_variants *v, mpz_t houses, mpz_t faced, tn_error *error)
{
    bool fit = false;
    mpz_set_ui(houses, 0);
    tn_status status = tn_variants_count_tiles(v, &fit, error);
    if (status == TN_OK && fit)
        status = tn_furnish(v, error);
    if (status == TN_OK && fit)
        tn_furnished_count(v, houses);
    mpz_set_ui(faced, mpz_sgn(houses) > 0);
    return status;
}

tn_status tn_variants_count_set(tn_house_variants *v, tn_house_counts *counts, tn_error *error)
{
    bool kept = false, zoned = false;
    mpz_t houses, faced;
    mpz_inits(houses, faced, NULL);
    tn_status status = split_faces(v, error);
    do {
        set_kinds(v, &v->shared, 0, v->shared.count);
        if (status == TN_OK)
            status = tn_variants_keep(v, TN_STAGE_FACES, &kept, error);
        if (status != TN_OK || !kept)
            continue;
        status = (v->asks_costs ? count_kept : count_cells)(v, houses, faced, error);
        mpz_add(counts->houses, counts->houses, houses);
        counts->faced += mpz_sgn(houses) > 0 ? mpz_get_ui(faced) : 0;
        zoned |= mpz_sgn(houses) > 0;
    } while (status == TN_OK && tn_wheels_turn(&v->shared, 0, v->shared.count));
    counts->zoned += zoned;
    mpz_clears(houses, faced, NULL);
    return status;
}

tn_status tn_variants_count_faces(tn_house_variants *v, tn_house_counts *counts, tn_error *error)
{
    bool kept = false;
    tn_status status = tn_variants_keep(v, TN_STAGE_FUNCTIONS, &kept, error);
    if (status == TN_OK && kept)
        status = tn_variants_set_faces(v, error);
    return status == TN_OK && kept ? tn_variants_count_set(v, counts, error) : status;
}
