/* The C interface to plan libraries. */
#include "runtime/plan/library/library.h"

#include <stdlib.h>
#include <string.h>

#include "api/plan/plan.h"

_Static_assert(TARTAN_ANY_LENGTH == TN_ALL_LENGTHS, "one number for any length");

/* Either a cursor over a run of ranks, or ranks drawn. */
struct tartan_plans {
    const tn_library *library;
    tn_cursor *cursor; /* or NULL */
    mpz_t *ranks;
    size_t count, capacity, next;
    uint32_t *trays;
};

static tartan_status unknown(const tn_module *module, const char *name, tartan_error *error)
{
    const char **names = malloc((module->LIBRARY_count + 1) * sizeof *names);
    for (size_t i = 0; names && i < module->LIBRARY_count; i++)
        names[i] = tn_text(module, module->LIBRARY_records[i].name);
    return tn_api_unknown(error, "library", name, names, module->LIBRARY_count);
}

tartan_status tn_api_library_find(const tn_module *module, const char *name, uint32_t *index, tartan_error *error)
{
    size_t found = 0;
    for (size_t i = 0; i < module->LIBRARY_count; i++) {
        const tn_library_record *record = &module->LIBRARY_records[i];
        if (name ? strcmp(tn_text(module, record->name), name) == 0 : !(record->flags & TN_IMPORTED)) {
            *index = (uint32_t)i;
            found++;
        }
    }
    if (found == 0 && name)
        return unknown(module, name, error);
    if (found == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no library of its own");
    if (found > 1)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has %zu libraries: say which by its name", found);
    return TARTAN_OK;
}

static tartan_status open_library(tartan_library *library, uint32_t index, const tartan_library_options *given,
                                  tartan_error *error)
{
    const tn_module *module = &library->plans.module;
    const tn_library_options options = {.max_states = given->max_states,
                                        .all_generated = given->all_generated,
                                        .override_trays = given->trays_max > 0,
                                        .trays_min = given->trays_min,
                                        .trays_max = given->trays_max};
    tn_error found;
    tn_status status = tn_schema_new(module, module->LIBRARY_records[index].schema, 0, &library->plans.schema, &found);
    if (status == TN_OK)
        status = tn_library_new(library->plans.schema, index, &options, &library->owned, &found);
    library->schema = library->plans.schema;
    library->library = library->owned;
    library->index = index;
    library->bare = given->all_generated;
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_library_open(const tartan_module *module, const tartan_library_options *options,
                                  const tartan_watch *watch, tartan_library **library, tartan_error *error)
{
    uint32_t index = 0;
    tartan_library_options own;
    tartan_library *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = TN_API_TAKE(tartan_library_options, &own, options, error);
    if (status == TARTAN_OK)
        status = tn_api_plans_begin(module, watch, &made->plans, error);
    if (status == TARTAN_OK)
        status = tn_api_library_find(&made->plans.module, own.name, &index, error);
    if (status == TARTAN_OK)
        status = open_library(made, index, &own, error);
    if (status != TARTAN_OK) {
        tartan_library_free(made);
        return status;
    }
    tn_api_plans_made(&made->plans);
    *library = made;
    return TARTAN_OK;
}

void tartan_library_free(tartan_library *library)
{
    if (!library)
        return;
    tn_library_free(library->owned);
    tn_api_plans_clear(&library->plans);
    free(library);
}

/* ---- its clauses */

static const tn_clause_record *clause(const tartan_library *library, size_t i)
{
    if (!library->owned)
        return NULL; /* a part of a diff */
    const tn_module *module = &library->plans.module;
    const tn_library_record *record = &module->LIBRARY_records[library->index];
    return i < record->clause_count ? &module->CLAUSE_records[record->clause_first + i] : NULL;
}

size_t tartan_library_clause_count(const tartan_library *library)
{
    return library->owned ? library->plans.module.LIBRARY_records[library->index].clause_count : 0;
}

const char *tartan_library_clause_name(const tartan_library *library, size_t i)
{
    const tn_clause_record *record = clause(library, i);
    return record ? tn_text(&library->plans.module, record->name) : NULL;
}

bool tartan_library_clause_prunes(const tartan_library *library, size_t i)
{
    const tn_clause_record *record = clause(library, i);
    return record && record->kind == TN_CLAUSE_PRUNE;
}

const tartan_schema *tartan_library_schema(const tartan_library *library)
{
    return tn_api_public_schema(library->schema);
}

uint32_t tartan_library_min_trays(const tartan_library *library)
{
    return tn_library_min(library->library);
}

uint32_t tartan_library_max_trays(const tartan_library *library)
{
    return tn_library_max(library->library);
}

void tartan_library_hash(const tartan_library *library, char hex[33])
{
    tn_library_hash(library->library, hex);
}

/* A number as a new decimal text. */
tartan_status tn_api_decimal(const mpz_t number, char **text, tartan_error *error)
{
    char *digits = malloc(mpz_sizeinbase(number, 10) + 2);
    if (!digits)
        return tn_api_memory(error);
    *text = mpz_get_str(digits, 10, number);
    return TARTAN_OK;
}

/* A rank from its text; `number` is initialised. */
static tartan_status read_rank(const char *text, mpz_t number, tartan_error *error)
{
    if (!text)
        return tn_api_missing(error, "rank");
    if (text[0] == '\0' || strspn(text, "0123456789") != strlen(text))
        return tn_api_refuse(error, TARTAN_INVALID, "a rank is a decimal number, not `%.40s`", text);
    if (mpz_set_str(number, text, 10) != 0)
        return tn_api_memory(error);
    return TARTAN_OK;
}

tartan_status tartan_library_clause_effect(const tartan_library *library, size_t i, char **out, char **only,
                                           tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library");
    const tn_clause_record *record = clause(library, i);
    if (!record)
        return tn_api_refuse(error, TARTAN_INVALID, "the library has no clause %zu", i);
    if (record->kind == TN_CLAUSE_PRUNE && library->bare)
        return tn_api_refuse(error, TARTAN_INVALID, "the library was opened without pruning");
    mpz_t numbers[2];
    uint32_t states;
    tn_error found;
    char *first = NULL;
    mpz_inits(numbers[0], numbers[1], NULL);
    tn_status status = tn_library_effect(library->library, (uint32_t)i, numbers[0], numbers[1], &states, &found);
    tartan_status result = status == TN_OK ? tn_api_decimal(numbers[0], &first, error) : tn_api_fail(&found, error);
    if (result == TARTAN_OK)
        result = tn_api_decimal(numbers[1], only, error);
    if (result == TARTAN_OK)
        *out = first;
    else
        free(first);
    mpz_clears(numbers[0], numbers[1], NULL);
    return result;
}

tartan_status tartan_library_count(const tartan_library *library, uint32_t length, char **count, tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library");
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library->library, length, kept);
    tartan_status status = tn_api_decimal(kept, count, error);
    mpz_clear(kept);
    return status;
}

tartan_status tartan_library_rank(const tartan_library *library, const uint32_t *trays, size_t length, char **rank,
                                  tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library");
    tn_error found;
    if (tn_api_trays(library->schema, trays, length, &found) != TN_OK)
        return tn_api_fail(&found, error);
    mpz_t number;
    mpz_init(number);
    tartan_status status;
    if (tn_library_rank(library->library, trays, length, number))
        status = tn_api_decimal(number, rank, error);
    else
        status = tn_api_refuse(error, TARTAN_INVALID, "the plan is not in the library");
    mpz_clear(number);
    return status;
}

tartan_status tartan_library_unrank(const tartan_library *library, const char *rank, uint32_t *trays, size_t *length,
                                    tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library");
    mpz_t number;
    mpz_init(number);
    uint32_t found = 0;
    tartan_status status = read_rank(rank, number, error);
    if (status == TARTAN_OK && !tn_library_unrank(library->library, number, trays, &found))
        status = tn_api_refuse(error, TARTAN_INVALID, "there is no plan of rank %.60s: the library has fewer", rank);
    mpz_clear(number);
    if (status == TARTAN_OK)
        *length = found;
    return status;
}

tartan_status tartan_library_plans(const tartan_library *library, const char *from, const char *to,
                                   tartan_plans **plans, tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library");
    tartan_plans *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    mpz_t first, end;
    mpz_inits(first, end, NULL);
    tn_library_kept(library->library, TN_ALL_LENGTHS, end);
    made->library = library->library;
    tartan_status status = from ? read_rank(from, first, error) : TARTAN_OK;
    if (status == TARTAN_OK && to) {
        mpz_t asked;
        mpz_init(asked);
        status = read_rank(to, asked, error);
        if (mpz_cmp(asked, end) < 0)
            mpz_set(end, asked);
        mpz_clear(asked);
    }
    if (mpz_cmp(first, end) > 0)
        mpz_set(first, end);
    tn_error found;
    if (status == TARTAN_OK && tn_cursor_new(library->library, first, end, &made->cursor, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    mpz_clears(first, end, NULL);
    if (status != TARTAN_OK)
        tartan_plans_free(made);
    else
        *plans = made;
    return status;
}

/* No more than the plans that there are: memory is asked for by this. */
static size_t at_most_kept(const tn_library *library, uint32_t length, size_t count)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, length, kept);
    if (mpz_cmp_ui(kept, count) < 0)
        count = (size_t)mpz_get_ui(kept);
    mpz_clear(kept);
    return count;
}

tartan_status tartan_library_sample(const tartan_library *library, uint64_t seed, uint32_t length, size_t count,
                                    tartan_plans **plans, tartan_error *error)
{
    if (!library)
        return tn_api_missing(error, "library");
    tartan_plans *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    made->library = library->library;
    count = at_most_kept(library->library, length, count);
    made->ranks = calloc(count ? count : 1, sizeof *made->ranks);
    made->trays = calloc((size_t)tn_library_max(library->library) + 1, sizeof *made->trays);
    if (!made->ranks || !made->trays) {
        tartan_plans_free(made);
        return tn_api_memory(error);
    }
    for (; made->capacity < count; made->capacity++)
        mpz_init(made->ranks[made->capacity]);
    tn_error found;
    if (tn_library_sample(library->library, seed, length, count, made->ranks, &made->count, &found) != TN_OK) {
        tartan_plans_free(made);
        return tn_api_fail(&found, error);
    }
    *plans = made;
    return TARTAN_OK;
}

bool tartan_plans_next(tartan_plans *plans, const uint32_t **trays, size_t *length)
{
    uint32_t found = 0;
    if (plans->cursor) {
        if (!tn_cursor_next(plans->cursor, trays, &found))
            return false;
    } else {
        if (plans->next == plans->count ||
            !tn_library_unrank(plans->library, plans->ranks[plans->next], plans->trays, &found))
            return false;
        plans->next++;
        *trays = plans->trays;
    }
    *length = found;
    return true;
}

size_t tartan_plans_take(tartan_plans *plans, size_t most, uint32_t *trays, size_t capacity, size_t *ends)
{
    size_t longest = tn_library_max(plans->library), taken = 0, end = 0, length;
    const uint32_t *plan;
    while (taken < most && capacity - end >= longest && tartan_plans_next(plans, &plan, &length)) {
        if (length)
            memcpy(trays + end, plan, length * sizeof *trays);
        end += length;
        ends[taken++] = end;
    }
    return taken;
}

void tartan_plans_free(tartan_plans *plans)
{
    if (!plans)
        return;
    tn_cursor_free(plans->cursor);
    for (size_t i = 0; i < plans->capacity; i++)
        mpz_clear(plans->ranks[i]);
    free(plans->ranks);
    free(plans->trays);
    free(plans);
}
