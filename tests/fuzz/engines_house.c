/* Forms and libraries of houses from anywhere: what house, count, rank, unrank, vary and `count --by` do with them. */
#include "tests/fuzz/engines_house.h"

#include <gmp.h>
#include <stdlib.h>

#include "runtime/house/count/listing.h"
#include "runtime/house/rank/rank.h"
#include "runtime/house/rule/change.h"
#include "runtime/house/schedule/cost.h"
#include "runtime/house/schedule/describe.h"
#include "tests/fuzz/engines.h"

enum {
    FORMS = 8,
    CODES = 4096,
    LIBRARIES = 3,
    STATES = 80,
    TABLE = 1 << 20,
    LENGTH = 4,
    PLANS = 3,
    CELLS = 40, /* of a house that is counted */
    WORK = 400, /* steps on a plan */
    HOUSE_STATES = 200,
    MEASURES = 3
};

/* ---- a house */

static void build(const tn_house *house)
{
    tn_error error = {0};
    tn_solids solids = {0};
    tn_buffer text = {0};
    tn_costs costs = {0};
    if (tn_house_solids(house, &solids, &error) == TN_OK) {
        tn_house_describe(house, &solids, NULL, 0, &text, &error);
        if (tn_form_has_costs(house->form))
            tn_house_costs(house, &solids, &costs, &error);
    }
    tn_costs_clear(&costs);
    tn_solids_clear(&solids);
    free(text.data);
}

static void measure(const tn_house *house, tn_house_rules *rules)
{
    tn_error error = {0};
    const tn_module *module = house->form->module;
    tn_worth worth;
    mpq_t value, cost;
    mpq_inits(value, cost, NULL);
    for (uint32_t i = 0; i < module->HOUSE_MEASURE_count && i < MEASURES; i++)
        if (module->HOUSE_MEASURE_records[i].form == house->form->record - module->FORM_records)
            tn_house_rules_measure(rules, tn_house_measured_of(module, i), value, cost, &worth, &error);
    mpq_clears(value, cost, NULL);
}

/* ---- the houses on a plan */

typedef struct fuzzed {
    const tn_house_library_record *library;
    tn_house_listing *variants;
    tn_house_rules *rules;
    const tn_tray *trays;
    size_t length;
} fuzzed;

/* A changed house is one of the library: it has a number there. */
static tn_status check_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    const fuzzed *f = context;
    mpz_t number;
    (void)change;
    mpz_init(number);
    tn_status status = tn_house_listing_number(f->variants, changed, number, error);
    mpz_clear(number);
    if (status == TN_INVALID)
        fuzz_broken("a change of a house leaves its library");
    return status;
}

static void check_house(fuzzed *f, const mpz_t number)
{
    tn_error error = {0};
    tn_house house;
    bool kept = false;
    mpz_t again;
    mpz_init(again);
    tn_status status = tn_house_listing_at(f->variants, f->trays, f->length, number, &house, &error);
    if (status == TN_INVALID)
        fuzz_broken("a house that is counted has no number");
    if (status == TN_OK && tn_house_listing_number(f->variants, &house, again, &error) == TN_OK &&
        mpz_cmp(number, again) != 0)
        fuzz_broken("a house's number is another");
    if (status == TN_OK && tn_house_rules_start(f->rules, &house, &error) == TN_OK) {
        if (tn_house_rules_keep(f->rules, f->library, &kept, &error) == TN_OK && !kept)
            fuzz_broken("a house that is counted is not kept");
        measure(&house, f->rules);
        tn_house_changes(&house, f->rules, f->library, 0, check_change, f, &error);
        build(&house);
    }
    tn_house_clear(&house);
    mpz_clear(again);
}

static void check_together(const fuzzed *f, const tn_house_form *form, const tn_library *plans,
                           const tn_house_counts *counts)
{
    tn_error error = {0};
    const tn_houses_what what = {.only = f->trays, .length = (uint32_t)f->length};
    tn_houses *houses;
    mpz_t number;
    mpz_init(number);
    if (tn_houses_of(form, f->library, plans, &what, HOUSE_STATES, &houses, &error) == TN_OK) {
        tn_houses_count(houses, TN_ALL_LENGTHS, number);
        if (mpz_cmp(number, counts->houses) != 0)
            fuzz_broken("houses are counted in two ways, with two results");
        tn_houses_free(houses);
    }
    mpz_clear(number);
}

static bool is_small(const tn_house_form *form, const tn_tray *trays, size_t length)
{
    tn_error error = {0};
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    tn_house house;
    bool small = tn_house_stand(form, trays, length, shapes, &house, &error) == TN_OK && house.cell_count <= CELLS;
    tn_house_clear(&house);
    return small;
}

void fuzz_houses_on(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans,
                    const tn_tray *trays, size_t length)
{
    tn_error error = {0};
    fuzzed f = {.library = library, .trays = trays, .length = length};
    tn_house_counts counts;
    if (!is_small(form, trays, length))
        return;
    tn_house_counts_init(&counts);
    if (tn_house_listing_new(form, library, WORK, &f.variants, &error) == TN_OK &&
        tn_house_rules_new(form, 0, &f.rules, &error) == TN_OK &&
        tn_house_listing_count(f.variants, trays, length, &counts, &error) == TN_OK) {
        if (plans)
            check_together(&f, form, plans, &counts);
        if (mpz_sgn(counts.houses) > 0) {
            mpz_sub_ui(counts.houses, counts.houses, 1);
            check_house(&f, counts.houses);
            mpz_set_ui(counts.houses, 0);
            check_house(&f, counts.houses);
        }
    }
    tn_house_rules_free(f.rules);
    tn_house_listing_free(f.variants);
    tn_house_counts_clear(&counts);
}

/* ---- libraries */

static void fuzz_plans(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans)
{
    tn_error error = {0};
    tn_cursor *cursor;
    const tn_tray *trays;
    uint32_t length;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(plans, TN_ALL_LENGTHS, to);
    if (tn_cursor_new(plans, from, to, &cursor, &error) == TN_OK) {
        for (size_t i = 0; i < PLANS && tn_cursor_next(cursor, &trays, &length); i++)
            fuzz_houses_on(form, library, plans, trays, length);
        tn_cursor_free(cursor);
    }
    mpz_clears(from, to, NULL);
}

/* The first house and the last, where all can be counted together. */
static void fuzz_together(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans)
{
    tn_error error = {0};
    tn_houses *houses;
    tn_tray trays[LENGTH];
    uint32_t length;
    mpz_t number;
    mpz_init(number);
    if (tn_houses_new(form, library, plans, HOUSE_STATES, &houses, &error) == TN_OK) {
        tn_houses_count(houses, TN_ALL_LENGTHS, number);
        for (int last = 1; last >= 0 && mpz_sgn(number) > 0; last--) {
            mpz_t rank, on_plan;
            mpz_inits(rank, on_plan, NULL);
            if (last)
                mpz_sub_ui(rank, number, 1);
            if (tn_houses_find(houses, rank, trays, &length, on_plan, &error) == TN_INVALID)
                fuzz_broken("a house that is counted has no rank");
            mpz_clears(rank, on_plan, NULL);
        }
        tn_houses_free(houses);
    }
    mpz_clear(number);
}

static void fuzz_libraries(const tn_house_form *form)
{
    tn_error error = {0};
    const tn_module *module = form->module;
    const tn_library_options options = {
        .max_states = STATES, .max_length = LENGTH, .max_table = TABLE, .max_eager = 1000, .threads = 1};
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count && i < LIBRARIES; i++) {
        const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[i];
        tn_library *plans;
        if (&module->FORM_records[library->form] != form->record ||
            tn_library_new(form->schema, library->plans, &options, &plans, &error) != TN_OK)
            continue;
        fuzz_plans(form, library, plans);
        fuzz_together(form, library, plans);
        tn_library_free(plans);
    }
}

/* ---- forms */

/* A short plan, with functions whether they may be there or not. */
static void fuzz_short_plan(const tn_house_form *form)
{
    tn_error error = {0};
    tn_house house;
    tn_tray trays[2] = {0, form->schema->tray_count - 1};
    uint32_t shapes[TN_CHOICES_MAX] = {0}, kinds[TN_FACE_KINDS_MAX], functions = tn_form_functions(form);
    if (tn_house_stand(form, trays, form->schema->tray_count ? 2 : 0, shapes, &house, &error) == TN_OK &&
        functions > 0) {
        for (size_t c = 0; c < house.cell_count; c++)
            house.cells[c].function = (uint32_t)c % functions;
        for (size_t f = 0; f < house.face_count; f++) {
            tn_face_options(&house, &house.faces[f], kinds);
            house.faces[f].kind = kinds[0];
        }
        build(&house);
    }
    tn_house_clear(&house);
}

void fuzz_house(const tn_module *module)
{
    tn_error error = {0};
    for (uint32_t i = 0; i < module->FORM_count && i < FORMS; i++) {
        tn_schema *schema;
        tn_house_form form;
        if (tn_schema_new(module, module->FORM_records[i].schema, CODES, &schema, &error) != TN_OK)
            continue;
        if (tn_schema_listed(schema, "a form goes", &error) == TN_OK) {
            tn_form_ready(module, i, schema, &form);
            fuzz_short_plan(&form);
            fuzz_libraries(&form);
        }
        tn_schema_free(schema);
    }
}
