/* What a house is made of, and what that costs: a line for each kind of part.
 *
 * Quantities are exact: nanometres squared and cubed. The area of a slope is that of its plan times a factor that is
 * rounded down to a billionth, however the roof is cut; volumes of roofs are exact fractions. A line's cost is rounded
 * half up to the hundredth, and the total is the sum of the lines. A tn_costs owns its lines; free them with
 * tn_costs_clear.
 */
#ifndef TARTAN_HOUSE_COST_H
#define TARTAN_HOUSE_COST_H

#include <gmp.h>

#include "runtime/house/solids.h"

/* part: as in MATERIAL. material: a MATERIAL record, TN_NO_RECORD where the form names none for the part. */
typedef struct tn_cost_line {
    uint32_t part, material;
    size_t count;
    mpq_t area, volume, cost; /* unrounded */
    mpz_t hundredths;
} tn_cost_line;

/* Is there some of it? Walls below roofs are no walls more, and may be all that there is of a part. */
static inline bool tn_cost_line_stands(const tn_cost_line *line)
{
    return line->count > 0 || mpq_sgn(line->volume) > 0;
}

typedef struct tn_costs {
    tn_cost_line *lines; /* one for each part that the form can have, in the order of their numbers */
    size_t count;
    mpz_t hundredths; /* of all lines */
    mpq_t exact;      /* unrounded */
} tn_costs;

/* Has the form materials, so that houses have costs? */
static inline bool tn_form_has_costs(const tn_house_form *form)
{
    return form->record->material_count > 0;
}

/* Has one of them a price, so that costs say something? */
static inline bool tn_form_has_prices(const tn_house_form *form)
{
    const tn_form_record *record = form->record;
    for (uint32_t i = 0; i < record->material_count; i++)
        if (form->module->MATERIAL_records[record->material_first + i].price > 0)
            return true;
    return false;
}

/* How many numbers of parts a form has: some of them, of later boxes of the same name, are never used. */
uint32_t tn_form_parts(const tn_house_form *form);

/* That of guards; beams follow. */
uint32_t tn_form_guard_part(const tn_house_form *form);

/* The part that a layer of a form is: the first of its name. */
uint32_t tn_layer_part(const tn_house_form *form, uint32_t layer);

/* The part that a solid is one of: also of a leaf or a pane. */
uint32_t tn_solid_whole_part(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item);

/* The same, but of one that has layers the part of the first of these, which is what is seen of it. */
uint32_t tn_solid_made_part(const tn_house *house, tn_solid_kind kind, uint32_t of, uint32_t item);

/* The first material for the part where the section is so: a MATERIAL record, or TN_NO_RECORD. */
uint32_t tn_part_material(const tn_house *house, uint32_t part);

const char *tn_form_part_text(const tn_house_form *form, uint32_t part);

/* tn_costs_clear also after a failure. TN_MEMORY. */
tn_status tn_house_costs(const tn_house *house, const tn_solids *solids, tn_costs *costs, tn_error *error);
void tn_costs_clear(tn_costs *costs);

/* What is built of a house: tn_house_solids, or tn_house_shell without what stands in its rooms. */
typedef tn_status tn_house_build(const tn_house *house, tn_solids *solids, tn_error *error);

/* What that costs. tn_costs_clear also after a failure. TN_MEMORY. */
tn_status tn_house_bill(const tn_house *house, tn_house_build *build, tn_costs *costs, tn_error *error);

/* cost := what that costs, unrounded; unchanged after a failure. TN_MEMORY. */
tn_status tn_house_exact_cost(const tn_house *house, tn_house_build *build, mpq_t cost, tn_error *error);

/* Half up to the hundredth, as bills are written. */
void tn_round_to_cent(mpq_t cost);

/* cost := what things cost, unrounded, that stand so in a house. */
void tn_house_items_cost(const tn_house *house, const tn_standing_item *items, size_t count, mpq_t cost);

#endif
