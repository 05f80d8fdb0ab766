/* Finds the step that all numbers of a measure of houses are multiples of. */
#include "runtime/house/measure/measure.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/house/house.h"
#include "runtime/number/rational.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/schema/sum.h"

tn_house_measured tn_house_measured_of(const tn_module *module, uint32_t measure)
{
    if (measure < module->HOUSE_MEASURE_count) {
        const tn_house_measure_record *r = &module->HOUSE_MEASURE_records[measure];
        return (tn_house_measured){r->name, r->doc, r->sum, r->term_first, r->term_count};
    }
    const tn_measure_record *r = &module->MEASURE_records[measure - module->HOUSE_MEASURE_count];
    return (tn_house_measured){.name = r->name, .doc = r->doc, .sum = r->sum};
}

tn_house_measured tn_house_measured_sum(const tn_module *module, uint32_t sum, tn_string name)
{
    const tn_house_sum_record *r = &module->HOUSE_SUM_records[sum];
    return (tn_house_measured){.name = name, .sum = r->sum, .term_first = r->term_first, .term_count = r->term_count};
}

static const tn_house_term_record *term_record(const tn_house_weights *w, uint32_t i)
{
    return &w->form->module->HOUSE_TERM_records[w->of.term_first + i];
}

/* ---- areas */

static void set_area(mpz_t to, tn_int128 area)
{
    mpz_set_ui(to, (uint64_t)(area >> 64));
    mpz_mul_2exp(to, to, 64);
    mpz_add_ui(to, to, (uint64_t)area);
}

/* What the areas of all cells that a tray can have are multiples of. */
static void common_area(const tn_house_form *form, mpz_t common)
{
    const tn_schema *schema = form->schema;
    mpz_t area;
    mpz_init(area);
    mpz_set_ui(common, 0);
    for (tn_tray t = 0; t < schema->tray_count; t++) {
        tn_int128 width = tn_tray_value_record(schema, t, form->width)->length;
        for (uint32_t z = 0; z < form->zone_count; z++) {
            set_area(area, width * tn_tray_value_record(schema, t, form->zones[z])->length);
            mpz_gcd(common, common, area);
        }
    }
    if (mpz_sgn(common) == 0)
        mpz_set_ui(common, 1);
    mpz_clear(area);
}

/* ---- steps */

void tn_common_unit(mpq_t unit, const mpq_t other)
{
    mpz_t a, b;
    mpz_inits(a, b, NULL);
    mpz_mul(a, mpq_numref(unit), mpq_denref(other));
    mpz_mul(b, mpq_numref(other), mpq_denref(unit));
    mpz_gcd(mpq_numref(unit), a, b);
    mpz_mul(mpq_denref(unit), mpq_denref(unit), mpq_denref(other));
    mpq_canonicalize(unit);
    mpz_clears(a, b, NULL);
}

tn_status tn_too_fine(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_FINE,
            "the numbers of the measure have no step in common that they are few times of");
    tn_error_help(error, "use rounder numbers: prices in steps of 10 or 50, lengths in whole units");
    return TN_LIMIT;
}

static bool to_steps(const tn_house_weights *w, const mpq_t number, int64_t *steps)
{
    tn_int128 wide;
    bool fits = tn_steps_of(number, w->unit, &wide) && wide >> 45 == wide >> 127; /* TN_SUM_STEPS_MAX */
    *steps = fits ? (int64_t)wide : 0;
    return fits;
}

bool tn_steps_of(const mpq_t number, const mpq_t unit, tn_int128 *steps)
{
    uint64_t words[2] = {0};
    mpq_t quotient;
    mpq_init(quotient);
    mpq_div(quotient, number, unit);
    bool fits = mpz_cmp_ui(mpq_denref(quotient), 1) == 0 && mpz_sizeinbase(mpq_numref(quotient), 2) < 100;
    if (fits)
        mpz_export(words, NULL, -1, sizeof *words, 0, 0, mpq_numref(quotient));
    *steps = (tn_int128)words[1] << 64 | words[0];
    *steps = mpq_sgn(quotient) < 0 ? -*steps : *steps;
    mpq_clear(quotient);
    return fits;
}

void tn_steps_number(tn_int128 steps, const mpq_t unit, mpq_t number)
{
    tn_int128 size = steps < 0 ? -steps : steps;
    const uint64_t words[2] = {(uint64_t)size, (uint64_t)(size >> 64)};
    mpq_set_ui(number, 0, 1);
    mpz_import(mpq_numref(number), 2, -1, sizeof *words, 0, 0, words);
    if (steps < 0)
        mpq_neg(number, number);
    mpq_mul(number, number, unit);
}

/* number := what one cell, room or common area adds. */
static void number_of(const tn_house_weights *w, uint32_t i, mpq_t number)
{
    mpq_t area;
    mpq_init(area);
    mpq_set_str(number, tn_text(w->form->module, term_record(w, i)->factor), 10);
    mpq_set_z(area, w->terms[i].area);
    mpq_mul(number, number, area);
    mpq_clear(area);
}

static tn_status find_steps(tn_house_weights *w, mpq_t number, tn_error *error)
{
    tn_sum *plan = NULL;
    tn_status status = tn_sum_new(w->form->schema, w->of.sum, &plan, error);
    if (status != TN_OK)
        return status;
    bool of_plans = plan->count > 0 || plan->constant != 0;
    if (of_plans)
        mpq_set(w->unit, plan->unit);
    for (uint32_t i = 0; i < w->count; i++) {
        number_of(w, i, number);
        mpq_abs(number, number);
        tn_common_unit(w->unit, number);
    }
    w->only_costs = mpq_sgn(w->unit) == 0;
    if (w->only_costs)
        mpq_set_ui(w->unit, 1, 1);
    mpq_set(number, plan->unit);
    bool good = tn_rational_fits(w->unit) && (!of_plans || to_steps(w, number, &w->plan));
    for (uint32_t i = 0; good && i < w->count; i++) {
        number_of(w, i, number);
        good = to_steps(w, number, &w->terms[i].each);
    }
    tn_sum_free(plan);
    return good ? TN_OK : tn_too_fine(error);
}

static void add_cost(tn_house_weights *w, const tn_house_term_record *record)
{
    mpq_t factor;
    mpq_init(factor);
    mpq_set_str(factor, tn_text(w->form->module, record->factor), 10);
    mpq_add(w->cost, w->cost, factor);
    mpq_clear(factor);
}

static void take_terms(tn_house_weights *w)
{
    mpz_t common;
    mpz_init(common);
    common_area(w->form, common);
    for (; w->count < w->of.term_count; w->count++) {
        const tn_house_term_record *record = term_record(w, w->count);
        tn_house_weight_term *term = &w->terms[w->count];
        *term = (tn_house_weight_term){.kind = (tn_house_term_kind)record->kind, .part = record->part};
        mpz_init_set_ui(term->area, 1);
        if (term->kind == TN_HOUSE_AREAS)
            mpz_set(term->area, common);
        if (term->kind == TN_HOUSE_COST) {
            mpz_set_ui(term->area, 0);
            add_cost(w, record);
        }
    }
    mpz_clear(common);
}

/* Costs are shown to the hundredth of what they are written in. */
static void find_shown(tn_house_weights *w)
{
    uint32_t power = w->form->module->SUM_records[w->of.sum].power;
    mpq_set(w->shown, w->unit);
    if (mpq_sgn(w->cost) == 0)
        return;
    mpq_set_ui(w->shown, 100, 1);
    tn_amount_convert(tn_amount_unit_of(w->form->schema, power), w->shown);
    mpq_inv(w->shown, w->shown);
}

tn_status tn_house_weights_new(const tn_house_form *form, tn_house_measured measure, tn_house_weights **out,
                               tn_error *error)
{
    tn_house_weights *w = *out = calloc(1, sizeof *w);
    mpq_t number;
    if (!w)
        return tn_fail_memory(error);
    *w = (tn_house_weights){.form = form, .of = measure};
    mpq_init(number);
    mpq_inits(w->unit, w->shown, w->cost, NULL);
    w->terms = calloc((size_t)w->of.term_count + 1, sizeof *w->terms);
    tn_status status = w->terms ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        take_terms(w);
        status = find_steps(w, number, error);
    }
    if (status == TN_OK)
        find_shown(w);
    mpq_clear(number);
    if (status != TN_OK) {
        tn_house_weights_free(w);
        *out = NULL;
    }
    return status;
}

void tn_house_weights_free(tn_house_weights *w)
{
    if (!w)
        return;
    for (uint32_t i = 0; i < w->count; i++)
        mpz_clear(w->terms[i].area);
    free(w->terms);
    mpq_clears(w->unit, w->shown, w->cost, NULL);
    free(w);
}

/* ---- houses */

static int64_t cell_steps(const tn_house_weight_term *term, const tn_cell *cell)
{
    if (term->kind != TN_HOUSE_AREAS)
        return term->each;
    if (cell->open)
        return 0;
    mpz_t area;
    mpz_init(area);
    set_area(area, tn_cell_area(cell));
    mpz_divexact(area, area, term->area);
    int64_t steps = mpz_get_si(area) * term->each;
    mpz_clear(area);
    return steps;
}

static bool is_of_cells(tn_house_term_kind kind)
{
    return kind == TN_HOUSE_CELLS || kind == TN_HOUSE_AREAS;
}

int64_t tn_house_weights_cells(const tn_house_weights *w, const tn_house *house)
{
    int64_t steps = 0;
    for (uint32_t i = 0; i < w->count; i++)
        for (size_t c = 0; is_of_cells(w->terms[i].kind) && c < house->cell_count; c++)
            if (tn_house_decide(house, w->terms[i].part, &house->cells[c]))
                steps += cell_steps(&w->terms[i], &house->cells[c]);
    return steps;
}
