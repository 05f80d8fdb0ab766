/* The value of a measure on one house, from what it adds up, and comparisons of such values. */
#include "runtime/house/form/form.h"
#include "runtime/house/rule/asked_data.h"
#include "runtime/house/schedule/cost.h"

/* to += factor * number */
static void add(mpq_t to, const tn_module *module, const tn_house_term_record *term, tn_int128 number)
{
    mpq_t factor, more;
    mpq_inits(factor, more, NULL);
    mpq_set_str(factor, tn_text(module, term->factor), 10);
    mpz_set_ui(mpq_numref(more), (uint64_t)(number >> 64));
    mpz_mul_2exp(mpq_numref(more), mpq_numref(more), 64);
    mpz_add_ui(mpq_numref(more), mpq_numref(more), (uint64_t)number);
    mpq_mul(factor, factor, more);
    mpq_add(to, to, factor);
    mpq_clears(factor, more, NULL);
}

static tn_int128 number_of(const tn_house_rules *rules, const tn_house_term_record *term)
{
    const tn_house *house = rules->house;
    tn_int128 number = 0;
    if (term->kind == TN_HOUSE_COST)
        return 1;
    for (size_t r = 0; term->kind == TN_HOUSE_ROOMS && r < rules->room_count; r++)
        number += tn_room_decide(rules, term->part, &rules->rooms[r]);
    for (size_t i = 0; term->kind != TN_HOUSE_ROOMS && i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        if (tn_house_decide(house, term->part, cell))
            number += term->kind == TN_HOUSE_CELLS ? 1 : cell->open ? 0 : tn_cell_area(cell);
    }
    return number;
}

/* What a number is worth with one term more: if one is below all numbers and another above them, it is nothing. */
static tn_worth join_worths(tn_worth a, tn_worth b)
{
    return a == TN_HAS_WORTH || a == b ? b : b == TN_HAS_WORTH ? a : TN_NO_WORTH;
}

static tn_worth turned(tn_worth worth)
{
    return worth == TN_BELOW_ALL ? TN_ABOVE_ALL : worth == TN_ABOVE_ALL ? TN_BELOW_ALL : worth;
}

static tn_status add_walked(tn_house_rules *rules, const tn_house_term_record *term, mpq_t value, tn_worth *worth,
                            tn_error *error)
{
    const tn_module *module = rules->house->form->module;
    bool negative = *tn_text(module, term->factor) == '-';
    tn_walked walked;
    tn_status status = tn_house_walked(rules, term, &walked, error);
    if (status != TN_OK)
        return status;
    *worth = join_worths(*worth, negative ? turned(walked.worth) : walked.worth);
    add(value, module, term, walked.number);
    return TN_OK;
}

/* Adds the terms; what is in parts of the house's cost, to `cost`. */
static tn_status add_terms(tn_house_rules *rules, uint32_t first, uint32_t count, mpq_t value, mpq_t cost,
                           tn_worth *worth, tn_error *error)
{
    const tn_module *module = rules->house->form->module;
    tn_status status = TN_OK;
    mpq_set_ui(cost, 0, 1);
    *worth = TN_HAS_WORTH;
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        const tn_house_term_record *term = &module->HOUSE_TERM_records[first + i];
        if (tn_house_term_of_floors(term->kind))
            status = add_walked(rules, term, value, worth, error);
        else
            add(term->kind == TN_HOUSE_COST ? cost : value, module, term, number_of(rules, term));
    }
    return status;
}

tn_status tn_house_rules_measure(tn_house_rules *rules, tn_house_measured measure, mpq_t value, mpq_t cost,
                                 tn_worth *worth, tn_error *error)
{
    bool has; /* what it has of the plan always has a value */
    tn_status status = tn_rooms_gather(rules, error);
    if (status == TN_OK)
        status = tn_plan_vm_value(rules->vm, measure.sum, value, &has, error);
    return status == TN_OK ? add_terms(rules, measure.term_first, measure.term_count, value, cost, worth, error)
                           : status;
}

/* ---- comparisons */

static tn_status plan_value(tn_house_rules *rules, uint32_t sum, mpq_t value, tn_error *error)
{
    const tn_house *house = rules->house;
    tn_status status = TN_OK;
    if (!rules->sums_vm)
        status = tn_plan_vm_new(house->form->schema, rules->max_length, &rules->sums_vm, error);
    if (status == TN_OK && !rules->summed)
        status = tn_plan_vm_plan(rules->sums_vm, house->trays, house->length, error);
    rules->summed = status == TN_OK;
    bool has;
    return status == TN_OK ? tn_plan_vm_value(rules->sums_vm, sum, value, &has, error) : status;
}

/* Do all tiles that fit in a cell cost the same? */
static tn_status same_costs(const tn_house *house, uint32_t cell, bool *same, tn_error *error)
{
    tn_variants tiles;
    mpq_t first, cost;
    mpq_inits(first, cost, NULL);
    tn_status status = tn_tile_variants(house, cell, &tiles, error);
    *same = true;
    for (size_t i = 0; status == TN_OK && *same && i < tiles.count; i++) {
        const tn_tile_variant *tile = &tiles.variants[i];
        tn_house_items_cost(house, tiles.items + tile->item_first, tile->item_count, i == 0 ? first : cost);
        *same = i == 0 || mpq_equal(first, cost);
    }
    tn_variants_clear(&tiles);
    mpq_clears(first, cost, NULL);
    return status;
}

/* What a house costs whose line leaves its tiles out is known where that makes no difference. */
static tn_status check_tiles(const tn_house *house, tn_error *error)
{
    tn_status status = TN_OK;
    bool same = true;
    for (uint32_t i = 0; house->tiles_left_out && status == TN_OK && same && i < house->cell_count; i++)
        status = same_costs(house, i, &same, error);
    if (status != TN_OK || same)
        return status;
    tn_fail(error, TN_INVALID, E_COST_OF_TILES,
            "what this house costs depends on its tiles, which the line leaves out");
    tn_error_help(error, "write them after a last `;`: `tartan unrank` and `tartan sample` give whole lines");
    return TN_INVALID;
}

tn_status tn_house_rules_cost(tn_house_rules *rules, mpq_t cost, tn_error *error)
{
    tn_status status = rules->priced ? TN_OK : check_tiles(rules->house, error);
    if (status == TN_OK && !rules->priced)
        status = tn_house_exact_cost(rules->house, tn_house_solids, rules->cost, error);
    rules->priced = status == TN_OK;
    mpq_set(cost, rules->cost);
    return status;
}

void tn_house_rules_price(tn_house_rules *rules, const mpq_t cost)
{
    mpq_set(rules->cost, cost);
    rules->priced = true;
}

tn_status tn_house_rules_sum(tn_house_rules *rules, uint32_t sum, mpq_t value, tn_worth *worth, bool *costs,
                             tn_error *error)
{
    const tn_house_sum_record *record = &rules->house->form->module->HOUSE_SUM_records[sum];
    mpq_t cost, all;
    mpq_inits(cost, all, NULL);
    tn_status status = plan_value(rules, record->sum, value, error);
    if (status == TN_OK)
        status = tn_rooms_gather(rules, error);
    if (status == TN_OK)
        status = add_terms(rules, record->term_first, record->term_count, value, cost, worth, error);
    *costs = mpq_sgn(cost) != 0;
    if (status == TN_OK && *costs)
        status = tn_house_rules_cost(rules, all, error);
    mpq_mul(cost, cost, all);
    mpq_add(value, value, cost);
    mpq_clears(cost, all, NULL);
    return status;
}

static bool compares(uint32_t opcode, int sign)
{
    switch (opcode) {
    case TN_OP_HOUSE_BELOW:
        return sign < 0;
    case TN_OP_HOUSE_ZERO:
        return sign == 0;
    case TN_OP_HOUSE_ABOVE:
        return sign > 0;
    case TN_OP_HOUSE_NOT_BELOW:
        return sign >= 0;
    case TN_OP_HOUSE_NOT_ZERO:
        return sign != 0;
    default:
        return sign <= 0;
    }
}

tn_status tn_house_compare(tn_house_rules *rules, const tn_instruction *op, bool *so, tn_error *error)
{
    bool costs;
    tn_worth worth = TN_NO_WORTH;
    mpq_t value;
    mpq_init(value);
    tn_status status = tn_house_rules_sum(rules, (uint32_t)op->first, value, &worth, &costs, error);
    int sign = worth == TN_BELOW_ALL ? -1 : worth == TN_ABOVE_ALL ? 1 : mpq_sgn(value);
    *so = worth != TN_NO_WORTH && compares(op->opcode, sign);
    mpq_clear(value);
    return status;
}
