/* The steps that values are counted in, and given out in. */
#include "runtime/house/count/data.h"

void tn_houses_units_init(tn_frontier_units *units)
{
    *units = (tn_frontier_units){0};
    mpq_init(units->cost);
    for (uint32_t k = 0; k < TN_ADDED_MAX; k++)
        mpq_init(units->measures[k]);
}

void tn_houses_units_clear(tn_frontier_units *units)
{
    mpq_clear(units->cost);
    for (uint32_t k = 0; k < TN_ADDED_MAX; k++)
        mpq_clear(units->measures[k]);
}

/* A measure's step: what the steps of its costs and of its other numbers are multiples of. */
static tn_status settle_measure(tn_frontier_units *units, uint32_t k, const tn_house_weights *w, tn_error *error)
{
    mpq_t costs;
    mpq_init(costs);
    mpq_mul(costs, w->cost, units->cost);
    mpq_abs(units->measures[k], costs);
    if (!w->only_costs || mpq_sgn(costs) == 0)
        tn_common_unit(units->measures[k], w->unit);
    bool good = tn_steps_of(costs, units->measures[k], &units->costs[k]);
    units->others[k] = 0;
    if (good && !w->only_costs)
        good = tn_steps_of(w->unit, units->measures[k], &units->others[k]);
    mpq_clear(costs);
    return good ? TN_OK : tn_too_fine(error);
}

/* Do sums over the whole row stay in 127 bits? Other numbers are of 45 bits each. */
static bool are_small(const tn_houses *h)
{
    tn_int128 most = 0, room = ((tn_int128)1 << 125) / (4 * ((tn_int128)h->high + 2));
    for (size_t i = 0; i < h->kind_count; i++)
        for (uint32_t n = 0; n < h->kinds[i].frontier->prices.numbers.count; n++) {
            tn_int128 steps = h->kinds[i].frontier->prices.steps[n];
            steps = steps < 0 ? -steps : steps;
            most = steps > most ? steps : most;
        }
    for (uint32_t k = 0; k < h->added.count; k++) {
        tn_int128 each = h->units.costs[k] < 0 ? -h->units.costs[k] : h->units.costs[k];
        if (each > 0 && most * TN_FRONTIER_CELLS_MAX > room / each)
            return false;
        if (h->units.others[k] > room >> 46)
            return false;
    }
    return true;
}

tn_status tn_houses_settle(tn_houses *h, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < h->kind_count; i++)
        tn_frontier_cost_unit(h->kinds[i].frontier, h->units.cost);
    if (mpq_sgn(h->units.cost) == 0)
        mpq_set_ui(h->units.cost, 1, 1);
    for (uint32_t k = 0; status == TN_OK && k < h->added.count; k++)
        status = settle_measure(&h->units, k, h->added.of[k], error);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++)
        status = tn_frontier_settle(h->kinds[i].frontier, &h->units, error);
    return status == TN_OK && !are_small(h) ? tn_too_fine(error) : status;
}

int64_t tn_houses_shown(const tn_houses *h, uint32_t measure, tn_int128 value)
{
    const tn_house_weights *w = h->measures->of[measure];
    mpq_t number;
    mpq_init(number);
    tn_steps_number(value, h->units.measures[measure], number);
    mpq_div(number, number, w->shown);
    mpz_mul_2exp(mpq_numref(number), mpq_numref(number), 1); /* half up: the floor of twice it and one, halved */
    mpz_add(mpq_numref(number), mpq_numref(number), mpq_denref(number));
    mpz_mul_2exp(mpq_denref(number), mpq_denref(number), 1);
    mpz_fdiv_q(mpq_numref(number), mpq_numref(number), mpq_denref(number));
    int64_t shown = mpz_get_si(mpq_numref(number));
    mpq_clear(number);
    return shown;
}
