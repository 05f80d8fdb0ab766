/* The C interface: plan libraries are counted, ranked and listed. */
#include "runtime/plan/library/library.h"

#include <stdlib.h>
#include <string.h>

#include "api/runtime/api.h"

_Static_assert(TARTAN_ANY_LENGTH == TN_ALL_LENGTHS, "one number for any length");

struct tartan_library {
    tn_schema *schema;
    tn_library *library;
};

/* Either a cursor over a run of ranks, or ranks drawn. */
struct tartan_plans {
    const tn_library *library;
    tn_cursor *cursor; /* or NULL */
    mpz_t *ranks;
    size_t count, capacity, next;
    uint32_t *trays;
};

static tartan_status out_of_memory(tartan_error *error)
{
    tn_error found;
    tn_fail_memory(&found);
    return tn_api_fail(&found, error);
}

static tartan_status unknown(const tn_module *module, const char *name, tartan_error *error)
{
    const char **names = malloc((module->LIBRARY_count + 1) * sizeof *names);
    for (size_t i = 0; names && i < module->LIBRARY_count; i++)
        names[i] = tn_text(module, module->LIBRARY_records[i].name);
    return tn_api_unknown(error, "library", name, names, module->LIBRARY_count);
}

static tartan_status find(const tn_module *module, const char *name, uint32_t *index, tartan_error *error)
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

tartan_status tartan_library_open(const tartan_module *module, const char *name, tartan_library **library,
                                  tartan_error *error)
{
    return tartan_library_open_within(module, name, 0, library, error);
}

tartan_status tartan_library_open_within(const tartan_module *module, const char *name, uint32_t max_states,
                                         tartan_library **library, tartan_error *error)
{
    uint32_t index = 0;
    tartan_status status = find(module->module, name, &index, error);
    if (status != TARTAN_OK)
        return status;
    tartan_library *made = calloc(1, sizeof *made);
    if (!made)
        return out_of_memory(error);
    tn_error found;
    tn_status opened =
        tn_schema_new(module->module, module->module->LIBRARY_records[index].schema, 0, &made->schema, &found);
    const tn_library_options options = {.max_states = max_states};
    if (opened == TN_OK)
        opened = tn_library_new(made->schema, index, &options, &made->library, &found);
    if (opened != TN_OK) {
        tartan_library_free(made);
        return tn_api_fail(&found, error);
    }
    *library = made;
    return TARTAN_OK;
}

void tartan_library_free(tartan_library *library)
{
    if (!library)
        return;
    tn_library_free(library->library);
    tn_schema_free(library->schema);
    free(library);
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
static tartan_status decimal(const mpz_t number, char **text, tartan_error *error)
{
    char *digits = malloc(mpz_sizeinbase(number, 10) + 2);
    if (!digits)
        return out_of_memory(error);
    *text = mpz_get_str(digits, 10, number);
    return TARTAN_OK;
}

/* A rank from its text; `number` is initialised. */
static tartan_status read_rank(const char *text, mpz_t number, tartan_error *error)
{
    if (text[0] == '\0' || strspn(text, "0123456789") != strlen(text))
        return tn_api_refuse(error, TARTAN_INVALID, "a rank is a decimal number, not `%.40s`", text);
    if (mpz_set_str(number, text, 10) != 0)
        return out_of_memory(error);
    return TARTAN_OK;
}

tartan_status tartan_library_count(const tartan_library *library, uint32_t length, char **count, tartan_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library->library, length, kept);
    tartan_status status = decimal(kept, count, error);
    mpz_clear(kept);
    return status;
}

tartan_status tartan_library_rank(const tartan_library *library, const uint32_t *trays, size_t length, char **rank,
                                  tartan_error *error)
{
    tn_error found;
    if (tn_api_trays(library->schema, trays, length, &found) != TN_OK)
        return tn_api_fail(&found, error);
    mpz_t number;
    mpz_init(number);
    tartan_status status;
    if (tn_library_rank(library->library, trays, length, number))
        status = decimal(number, rank, error);
    else
        status = tn_api_refuse(error, TARTAN_INVALID, "the plan is not in the library");
    mpz_clear(number);
    return status;
}

tartan_status tartan_library_unrank(const tartan_library *library, const char *rank, uint32_t *trays, size_t *length,
                                    tartan_error *error)
{
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
    tartan_plans *made = calloc(1, sizeof *made);
    if (!made)
        return out_of_memory(error);
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
        count = mpz_get_ui(kept);
    mpz_clear(kept);
    return count;
}

tartan_status tartan_library_sample(const tartan_library *library, uint64_t seed, uint32_t length, size_t count,
                                    tartan_plans **plans, tartan_error *error)
{
    tartan_plans *made = calloc(1, sizeof *made);
    if (!made)
        return out_of_memory(error);
    made->library = library->library;
    count = at_most_kept(library->library, length, count);
    made->ranks = calloc(count ? count : 1, sizeof *made->ranks);
    made->trays = calloc((size_t)tn_library_max(library->library) + 1, sizeof *made->trays);
    if (!made->ranks || !made->trays) {
        tartan_plans_free(made);
        return out_of_memory(error);
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
