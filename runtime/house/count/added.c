/* What is added up over the houses of a library: the measures that are asked for, and what its clauses compare with 0;
 * and the steps that these values are counted in. */
#include <string.h>

#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"

typedef struct tn_added_finding {
    tn_houses *houses;
    const tn_house_clause_record *clause;
} tn_added_finding;

static bool is_known(const tn_house_added *added, uint32_t sum)
{
    for (uint32_t k = added->measures; k < added->count; k++)
        if (added->sums[k] == sum)
            return true;
    return false;
}

static tn_status too_much(const tn_added_finding *c, const char *what, tn_error *error)
{
    const tn_module *module = c->houses->form->module;
    tn_fail(error, TN_LIMIT, E_FRONTIER, "`%.60s` %s: the houses of all plans together cannot be counted",
            tn_text(module, c->clause->name), what);
    tn_error_help(error, "ask about one plan (--plan PLAN or '#P'), or name a house by #P:V");
    return TN_LIMIT;
}

/* Trays and the house add up tray by tray; places of several trays do not. */
static bool counts_places(const tn_module *module, uint32_t sum)
{
    const tn_sum_record *of_plan = &module->SUM_records[module->HOUSE_SUM_records[sum].sum];
    for (uint32_t i = 0; i < of_plan->term_count; i++)
        if (module->TERM_records[of_plan->term_first + i].kind != TN_SUM_SINGLES)
            return true;
    return false;
}

static tn_status see(void *context, const tn_instruction *op, tn_relation_use use, tn_error *error)
{
    const tn_added_finding *c = context;
    tn_houses *h = c->houses;
    const tn_form_record *forms = h->form->module->FORM_records;
    uint32_t sum = (uint32_t)op->first;
    (void)use;
    if (!tn_code_compares_house(op->opcode) || is_known(&h->added, sum))
        return TN_OK;
    if (counts_places(h->form->module, sum))
        return too_much(c, "compares a number of the house with `occurrences`", error);
    if (h->added.count == h->added.measures + TN_COMPARED_MAX)
        return too_much(c, "is about more comparisons of houses than can be counted at once", error);
    if (&forms[h->form->module->HOUSE_SUM_records[sum].form] != h->form->record)
        return tn_fail(error, TN_INVALID, E_OTHER_FORM, "a clause of the library is about houses of another form");
    tn_house_weights *weights = NULL;
    tn_status status =
        tn_house_weights_new(h->form, tn_house_measured_sum(h->form->module, sum, c->clause->name), &weights, error);
    if (status != TN_OK)
        return status;
    h->added.sums[h->added.count] = sum;
    h->added.of[h->added.count++] = h->compared[h->compared_count++] = weights;
    return TN_OK;
}

tn_status tn_houses_find_added(tn_houses *h, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t k = 0; h->measures && k < h->measures->count; k++)
        h->added.of[k] = h->measures->of[k];
    h->added.measures = h->added.count = h->measures ? h->measures->count : 0;
    for (uint32_t i = 0; status == TN_OK && i < h->library->clause_count; i++) {
        tn_added_finding comparing = {h, &h->form->module->HOUSE_CLAUSE_records[h->library->clause_first + i]};
        status = tn_rule_uses(h->form->module, comparing.clause->holds, see, &comparing, error);
    }
    for (uint32_t k = 0; k < h->added.count; k++) /* costs are of each section by itself */
        h->sections.apart = h->sections.apart || mpq_sgn(h->added.of[k]->cost) != 0;
    return status;
}

void tn_houses_added_clear(tn_houses *h)
{
    for (uint32_t k = 0; k < h->compared_count; k++)
        tn_house_weights_free(h->compared[k]);
}

/* ==== units
 *
 * The steps that values are counted in, and given out in. */

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
