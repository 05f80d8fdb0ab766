/* The C interface to libraries of houses: opening and counting them. */
#include <stdlib.h>
#include <string.h>

#include "api/house/house.h"
#include "ask/house/numbered_count.h"
#include "driver/plan/library.h"
#include "runtime/base/integers.h"
#include "runtime/plan/measure/amount.h"

/* ---- questions */

/* What was said of another question is forgotten. */
static void forget_said(tartan_house_library *library)
{
    tn_compilation *compilation = &library->opened.compilation;
    tn_diagnostics_clear(&compilation->diagnostics);
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
}

tartan_status tn_api_houses_begin(tartan_house_library *library, const tartan_watch *watch, tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library of houses");
    tartan_status status = tn_api_watch(watch, &library->watch, error);
    if (status != TARTAN_OK)
        return status;
    forget_said(library);
    library->opened.module->watch = &library->watch;
    return TARTAN_OK;
}

/* Nobody waits any more. What was being counted by a question that failed is counted again. */
static void end(tartan_house_library *library, bool whole)
{
    library->opened.module->watch = NULL;
    if (!whole)
        tn_numbered_forget_ranks(&library->numbered);
}

tartan_status tn_api_houses_end(tartan_house_library *library, tn_status status, const tn_error *found,
                                tartan_error *error)
{
    end(library, status == TN_OK);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(found, error);
}

tartan_status tn_api_houses_said(tartan_house_library *library, tn_status status, tartan_error *error)
{
    end(library, status == TN_OK);
    return status == TN_OK
               ? TARTAN_OK
               : tn_api_first_error(&library->opened.compilation.diagnostics, status, &library->watch, error);
}

static tn_status check_plan(const tartan_house_library *library, const tartan_on_plan *plan, tn_error *error)
{
    if (plan->length > 0 && !plan->trays)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the plan is NULL");
    tn_status status = tn_api_trays(library->numbered.schema, plan->trays, plan->length, error);
    if (status != TN_OK)
        return status;
    mpz_t rank;
    mpz_init(rank);
    if (!tn_library_rank(library->numbered.plans, plan->trays, plan->length, rank))
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the plan is none of the library's");
    mpz_clear(rank);
    return status;
}

tn_status tn_api_houses_on(tartan_house_library *library, const tartan_on_plan *given, const tn_plan **of,
                           tn_error *error)
{
    *of = NULL;
    if (!given)
        return TN_OK;
    tn_status status = check_plan(library, given, error);
    if (status != TN_OK)
        return status;
    if (given->length > 0)
        memcpy(library->plan.trays, given->trays, given->length * sizeof *given->trays);
    library->plan.length = given->length;
    *of = &library->plan;
    return TN_OK;
}

/* ---- opened */

static tartan_status open_library(tartan_house_library *library, const tartan_module *module,
                                  const tartan_house_library_options *options, const tartan_watch *watch,
                                  tartan_error *error)
{
    const tn_house_settings settings = {.library = options->name,
                                        .max_length = TN_HOUSE_TRAYS_DEFAULT,
                                        .max_houses = options->max_houses,
                                        .plans = {.max_states = options->max_states}};
    tn_status status = tn_open_bytes("the module", module->bytes, module->size, false, &library->opened);
    if (status != TN_OK)
        return tn_api_first_error(&library->opened.compilation.diagnostics, status, NULL, error);
    library->session = (tn_session){.opened = &library->opened};
    tartan_status begun = tn_api_houses_begin(library, watch, error);
    if (begun != TARTAN_OK)
        return begun;
    library->ready = true;
    status = tn_numbered_open(&library->numbered, &library->session, &settings);
    if (status == TN_OK) {
        tn_error none;
        library->plan.trays = tn_numbered_tray_room(&library->numbered, &none);
        status = library->plan.trays ? TN_OK : TN_MEMORY;
    }
    return tn_api_houses_said(library, status, error);
}

tartan_status tartan_house_library_open(const tartan_module *module, const tartan_house_library_options *options,
                                        const tartan_watch *watch, tartan_house_library **library, tartan_error *error)
{
    tartan_house_library_options own;
    if (!module || !library)
        return tn_api_missing(error, module ? "room for the library of houses" : "module");
    tartan_status status = TN_API_TAKE(tartan_house_library_options, &own, options, error);
    if (status != TARTAN_OK)
        return status;
    tartan_house_library *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    status = open_library(made, module, &own, watch, error);
    if (status == TARTAN_OK)
        *library = made;
    else
        tartan_house_library_free(made);
    return status;
}

void tartan_house_library_free(tartan_house_library *library)
{
    if (!library)
        return;
    if (library->ready)
        tn_numbered_close(&library->numbered);
    free(library->plan.trays);
    tn_session_forget(&library->session);
    tn_close(&library->opened);
    free(library);
}

const char *tartan_house_library_name(const tartan_house_library *library)
{
    return tn_text(library->opened.module, library->numbered.record->name);
}

const tartan_schema *tartan_house_library_schema(const tartan_house_library *library)
{
    return tn_api_public_schema(library->numbered.schema);
}

/* ---- counted */

/* The houses on plans of the length, or of any, in one number. */
static tn_status count_lengths(tn_numbered *n, uint32_t length, mpz_t count, tn_error *error)
{
    uint32_t low = tn_library_min(n->plans), high = tn_library_max(n->plans);
    if (length != TARTAN_ANY_LENGTH && (length < low || length > high))
        return TN_OK;
    if (length == TARTAN_ANY_LENGTH)
        return tn_numbered_houses(n, NULL, count, error);
    return tn_numbered_lengths(n, length, length, (mpz_t *)count, error);
}

/* Gives the number if it was counted. */
static tartan_status give_count(tartan_house_library *library, tn_status status, const tn_error *found,
                                const mpz_t number, char **count, tartan_error *error)
{
    tartan_status counted = tn_api_houses_end(library, status, found, error);
    return counted == TARTAN_OK ? tn_api_decimal(number, count, error) : counted;
}

tartan_status tartan_house_library_count(tartan_house_library *library, uint32_t length, const tartan_watch *watch,
                                         char **count, tartan_error *error)
{
    tn_error found;
    tartan_status status = tn_api_houses_begin(library, watch, error);
    if (status != TARTAN_OK)
        return status;
    mpz_t number;
    mpz_init(number);
    tn_status counted = count_lengths(&library->numbered, length, number, &found);
    status = give_count(library, counted, &found, number, count, error);
    mpz_clear(number);
    return status;
}

tartan_status tartan_house_library_count_on(tartan_house_library *library, const tartan_on_plan *plan,
                                            const tartan_watch *watch, char **count, tartan_error *error)
{
    tn_error found;
    const tn_plan *of;
    if (!plan)
        return tn_api_missing(error, "plan");
    tartan_status status = tn_api_houses_begin(library, watch, error);
    if (status != TARTAN_OK)
        return status;
    mpz_t number;
    mpz_init(number);
    tn_status counted = tn_api_houses_on(library, plan, &of, &found);
    if (counted == TN_OK)
        counted = tn_numbered_houses(&library->numbered, of, number, &found);
    status = give_count(library, counted, &found, number, count, error);
    mpz_clear(number);
    return status;
}

const char *tartan_house_library_unit(tartan_house_library *library, const char *measure)
{
    uint32_t index;
    if (!measure || tn_api_houses_begin(library, NULL, NULL) != TARTAN_OK)
        return NULL;
    const tn_numbered *n = &library->numbered;
    tn_status status = tn_house_measure_choose(&library->opened, measure, n->record->form, &index);
    if (tn_api_houses_said(library, status, NULL) != TARTAN_OK)
        return NULL;
    const tn_module *module = n->form.module;
    tn_house_measured of = tn_house_measured_of(module, index);
    return tn_amount_unit_name(tn_amount_unit_of(n->schema, module->SUM_records[of.sum].power));
}
