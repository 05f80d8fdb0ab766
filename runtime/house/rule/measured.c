/* The value of a measure on one house, from what it adds up. */
#include "runtime/house/rule/asked_data.h"

/* to += factor * number */
static void add(mpq_t to, const tn_module *module, const tn_house_term_record *term, tn_int128 number)
{
    mpq_t factor, more;
    mpq_inits(factor, more, NULL);
    mpq_set_str(factor, tn_text(module, term->factor), 10);
    mpz_set_ui(mpq_numref(more), (unsigned long)(number >> 64));
    mpz_mul_2exp(mpq_numref(more), mpq_numref(more), 64);
    mpz_add_ui(mpq_numref(more), mpq_numref(more), (unsigned long)(uint64_t)number);
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

tn_status tn_house_rules_measure(tn_house_rules *rules, tn_house_measured measure, mpq_t value, mpq_t cost,
                                 tn_error *error)
{
    const tn_module *module = rules->house->form->module;
    tn_status status = tn_rooms_gather(rules, error);
    if (status == TN_OK)
        status = tn_plan_vm_value(rules->vm, measure.sum, value, error);
    mpq_set_ui(cost, 0, 1);
    for (uint32_t i = 0; status == TN_OK && i < measure.term_count; i++) {
        const tn_house_term_record *term = &module->HOUSE_TERM_records[measure.term_first + i];
        add(term->kind == TN_HOUSE_COST ? cost : value, module, term, number_of(rules, term));
    }
    return status;
}
