/* Counts the houses that some clauses keep, within a limit of states for all counts together. */
#include "driver/house/counter.h"

#include <stdlib.h>

#include "runtime/house/house.h"
#include "runtime/house/rank/rank.h"
#include "runtime/house/rule/stages.h"

tn_status tn_house_counter_open(const tn_module *module, uint32_t library, uint32_t plan_states, uint32_t max_states,
                                tn_house_counter *c, tn_error *error)
{
    const tn_library_options options = {.max_states = plan_states};
    *c = (tn_house_counter){.module = module,
                            .library = &module->HOUSE_LIBRARY_records[library],
                            .max_states = max_states,
                            .states_left = (uint64_t)max_states * TN_COUNTER_LIMITS};
    tn_status status = tn_form_schema(module, c->library->form, &c->schema, error);
    if (status != TN_OK)
        return status;
    tn_form_ready(module, c->library->form, c->schema, &c->form);
    status = tn_clauses_not_walking(&c->form, c->library, &c->clauses, &c->clause_count, error);
    return status == TN_OK ? tn_library_new(c->schema, c->library->plans, &options, &c->plans, error) : status;
}

void tn_house_counter_close(tn_house_counter *c)
{
    free(c->clauses);
    tn_library_free(c->plans);
    tn_schema_free(c->schema);
    *c = (tn_house_counter){0};
}

static tn_status past_limit(const tn_house_counter *c, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_FRONTIER,
            "counting what clauses keep takes more than %u states, or all such counts more "
            "than %u times as many",
            c->max_states, TN_COUNTER_LIMITS);
    tn_error_help(error, "--max-states N allows more; a library on plans of fewer trays takes fewer");
    return TN_LIMIT;
}

/* The houses borrow `other`. Free them with tn_houses_free. */
static tn_status count(tn_house_counter *c, const tn_house_clause_record *clauses, uint32_t clause_count,
                       const tn_frontier_without *without, tn_other_clauses *other, tn_houses **houses, tn_error *error)
{
    const tn_houses_what what = {.without = without};
    *houses = NULL;
    tn_other_clauses_set(&c->form, c->library, clauses, clause_count, other);
    if (c->states_left < c->max_states)
        return past_limit(c, error);
    tn_status status = tn_houses_of(&other->form, &other->library, c->plans, &what, c->max_states, houses, error);
    if (status == TN_OK) {
        uint64_t states = tn_houses_states(*houses);
        c->states_left -= states < c->states_left ? states : c->states_left;
    } else if (status == TN_LIMIT && (!error || error->code != E_WALKS_OF_ALL)) {
        c->states_left = 0; /* other counts of these clauses would take as many */
        tn_error_help(error, "--max-states N allows more; a library on plans of fewer trays takes fewer");
    }
    return status;
}

tn_status tn_house_counter_count(tn_house_counter *c, const tn_house_clause_record *clauses, uint32_t clause_count,
                                 const tn_frontier_without *without, mpz_t houses, tn_error *error)
{
    tn_other_clauses other;
    tn_houses *counted;
    tn_status status = count(c, clauses, clause_count, without, &other, &counted, error);
    if (status == TN_OK)
        tn_houses_count(counted, TN_ALL_LENGTHS, houses);
    tn_houses_free(counted);
    return status;
}

/* ---- the first */

static tn_status find_first(tn_houses *houses, tn_tray *trays, tn_house *house, tn_error *error)
{
    uint32_t length;
    tn_plan_houses *plan = NULL;
    mpz_t rank, on_plan;
    mpz_inits(rank, on_plan, NULL);
    tn_status status = tn_houses_find(houses, rank, trays, &length, on_plan, error);
    if (status == TN_OK)
        status = tn_plan_houses_new(houses, trays, length, &plan, error);
    mpz_set_ui(rank, 0);
    if (status == TN_OK)
        status = tn_plan_houses_at(plan, rank, house, error);
    tn_plan_houses_free(plan);
    mpz_clears(rank, on_plan, NULL);
    return status;
}

tn_status tn_house_counter_first(tn_house_counter *c, const tn_house_clause_record *clauses, uint32_t clause_count,
                                 bool *found, tn_house *house, tn_error *error)
{
    tn_other_clauses other;
    tn_houses *counted;
    mpz_t houses;
    *house = (tn_house){0};
    *found = false;
    mpz_init(houses);
    tn_tray *trays = malloc(((size_t)tn_library_max(c->plans) + 1) * sizeof *trays);
    tn_status status = trays ? count(c, clauses, clause_count, NULL, &other, &counted, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        tn_houses_count(counted, TN_ALL_LENGTHS, houses);
        *found = mpz_sgn(houses) > 0;
    }
    if (status == TN_OK && *found)
        status = find_first(counted, trays, house, error);
    if (house->form)
        house->form = &c->form;
    if (trays)
        tn_houses_free(counted);
    free(trays);
    mpz_clear(houses);
    return status;
}

/* ---- values */

tn_status tn_house_counter_values(tn_house_counter *c, mpz_t *houses, bool *stands, tn_error *error)
{
    tn_house section = {.form = &c->form};
    tn_other_clauses other;
    tn_houses *counted;
    mpz_t some;
    mpz_init(some);
    tn_status status = count(c, c->clauses, c->clause_count, NULL, &other, &counted, error);
    for (bool more = status == TN_OK; more; more = tn_form_next_section(&c->form, section.shapes)) {
        if (!tn_house_section_stands(&section))
            continue;
        tn_houses_of_section(counted, section.shapes, some);
        for (uint32_t i = 0; i < c->form.record->choice_count; i++) {
            uint32_t shape = tn_form_choice(&c->form, i)->shape_first + section.shapes[i];
            mpz_add(houses[shape], houses[shape], some);
            stands[shape] = true;
        }
    }
    tn_houses_free(counted);
    mpz_clear(some);
    return status;
}
