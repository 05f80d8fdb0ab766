/* Finds the values of measures on single houses. */
#include "driver/house/values.h"

#include <stdlib.h>

#include "runtime/house/schedule/cost.h"
#include "runtime/plan/measure/named.h"

struct tn_house_valuer {
    const tn_house_form *form;
    tn_house_rules *rules;
    tn_house_value *values;
    tn_house_measured *measures; /* [count] */
    size_t count;
    bool priced; /* one asks what the house costs */
};

static bool has_measure(const tn_house_form *form, uint32_t measure)
{
    const tn_module *module = form->module;
    uint32_t of_plans = measure - (uint32_t)module->HOUSE_MEASURE_count;
    if (measure < module->HOUSE_MEASURE_count)
        return &module->FORM_records[module->HOUSE_MEASURE_records[measure].form] == form->record;
    return module->MEASURE_records[of_plans].schema == form->record->schema &&
           !tn_named_measure_partial(module, of_plans);
}

static void add_measure(tn_house_valuer *v, tn_house_measured of)
{
    const tn_module *module = v->form->module;
    tn_house_value *value = &v->values[v->count];
    v->measures[v->count++] = of;
    value->measure = tn_text(module, of.name);
    value->unit = tn_amount_unit_of(v->form->schema, (int)module->SUM_records[of.sum].power);
    mpq_init(value->value);
    for (uint32_t i = 0; i < of.term_count; i++)
        v->priced = v->priced || module->HOUSE_TERM_records[of.term_first + i].kind == TN_HOUSE_COST;
}

static void add_all(tn_house_valuer *v)
{
    const tn_module *module = v->form->module;
    for (uint32_t i = 0; i < module->HOUSE_MEASURE_count + module->MEASURE_count; i++)
        if (has_measure(v->form, i))
            add_measure(v, tn_house_measured_of(module, i));
}

tn_status tn_house_valuer_new(const tn_house_form *form, size_t max_length, const tn_house_measured *measures,
                              size_t count, tn_house_valuer **valuer, tn_error *error)
{
    tn_house_valuer *v = calloc(1, sizeof *v);
    size_t room = measures ? count : form->module->HOUSE_MEASURE_count + form->module->MEASURE_count;
    *valuer = v;
    if (!v)
        return tn_fail_memory(error);
    v->form = form;
    v->values = calloc(room + 1, sizeof *v->values);
    v->measures = malloc((room + 1) * sizeof *v->measures);
    if (!v->values || !v->measures)
        return tn_fail_memory(error);
    for (size_t i = 0; measures && i < count; i++)
        add_measure(v, measures[i]);
    if (!measures)
        add_all(v);
    return tn_house_rules_new(form, max_length, &v->rules, error);
}

void tn_house_valuer_free(tn_house_valuer *v)
{
    if (!v)
        return;
    for (size_t i = 0; i < v->count; i++)
        mpq_clear(v->values[i].value);
    tn_house_rules_free(v->rules);
    free(v->values);
    free(v->measures);
    free(v);
}

const tn_house_value *tn_house_values(const tn_house_valuer *v, size_t *count)
{
    *count = v->count;
    return v->values;
}

static tn_status find_value(tn_house_valuer *v, size_t i, const mpq_t price, tn_error *error)
{
    tn_house_value *to = &v->values[i];
    tn_worth worth = TN_NO_WORTH;
    mpq_t cost;
    mpq_init(cost);
    tn_status status = tn_house_rules_measure(v->rules, v->measures[i], to->value, cost, &worth, error);
    to->has = status == TN_OK && worth == TN_HAS_WORTH;
    if (to->has) {
        mpq_mul(cost, cost, price);
        mpq_add(to->value, to->value, cost);
    }
    mpq_clear(cost);
    return status;
}

tn_status tn_house_values_find(tn_house_valuer *v, const tn_house *house, mpq_srcptr price, tn_error *error)
{
    mpq_t paid;
    if (v->count == 0)
        return TN_OK;
    mpq_init(paid);
    tn_status status = TN_OK;
    if (price)
        mpq_set(paid, price);
    else if (v->priced)
        status = tn_house_exact_cost(house, tn_house_solids, paid, error);
    if (status == TN_OK)
        status = tn_house_rules_start(v->rules, house, error);
    if (status == TN_OK)
        tn_house_rules_price(v->rules, paid);
    for (size_t i = 0; status == TN_OK && i < v->count; i++)
        status = find_value(v, i, paid, error);
    mpq_clear(paid);
    return status;
}
