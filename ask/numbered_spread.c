/* How the houses of a library, or those on one plan, are spread over the values of a measure. */
#include "ask/numbered_count.h"

static tn_status fill(const tn_numbered *n, const tn_plan *plan, tn_house_measured measure, tn_spread *spread,
                      tn_error *error)
{
    tn_house_weights *weights = NULL;
    tn_houses *houses = NULL;
    tn_status status = tn_house_weights_new(&n->form, measure, &weights, error);
    tn_house_measures measures = {.count = 1, .of = {weights}};
    tn_houses_what what = {.measures = &measures};
    if (plan) {
        what.only = plan->trays;
        what.length = (uint32_t)plan->length;
    }
    if (status == TN_OK)
        status = tn_houses_of(&n->form, n->record, n->plans, &what, n->max_states, &houses, error);
    if (status == TN_OK)
        status = tn_houses_spread(houses, &spread->d, error);
    if (status == TN_OK)
        status = tn_spread_finish(spread, error);
    tn_houses_free(houses);
    tn_house_weights_free(weights);
    return status;
}

tn_status tn_numbered_spread(tn_numbered *n, const tn_plan *plan, uint32_t measure, tn_spread *spread, tn_error *error)
{
    const tn_module *module = n->form.module;
    tn_house_measured of = tn_house_measured_of(module, measure);
    tn_spread_begin(spread, n->schema, module->SUM_records[of.sum].power);
    spread->library = tn_text(module, n->record->name);
    spread->name = tn_text(module, of.name);
    spread->doc = tn_text(module, of.doc);
    spread->of = "house";
    return fill(n, plan, of, spread, error);
}
