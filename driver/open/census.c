/* The joint distribution of a library as a census. */
#include "driver/open/census.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/load.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/crosstab.h"
#include "runtime/plan/measure/named.h"

/* What is open for a census. */
typedef struct counted {
    tn_module *module;
    tn_schema *schema;
    tn_library *library;
    tn_bundle_measure *measures;
    tn_crosstab table;
} counted;

static uint32_t library_named(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->LIBRARY_count; i++)
        if (strcmp(tn_text(module, module->LIBRARY_records[i].name), name) == 0)
            return i;
    return TN_NO_RECORD;
}

static tn_status find_measures(const tn_census_request *request, counted *c, size_t *column, tn_error *error)
{
    const tn_library_record *record = tn_library_record_of(c->library);
    c->measures = calloc(request->measure_count + 1, sizeof *c->measures);
    if (!c->measures)
        return tn_fail_memory(error);
    for (size_t i = 0; i < request->measure_count; i++) {
        uint32_t measure = tn_named_measure_find(c->module, record, request->measures[i]);
        *column = i;
        if (measure == TN_NO_RECORD)
            return tn_fail(error, TN_INVALID, E_PLAN_VALUES, "`%.200s` is no measure of the plans of library `%.200s`",
                           request->measures[i], request->library);
        c->measures[i] = tn_bundle_measure_of(c->module, record, measure);
    }
    *column = SIZE_MAX;
    return TN_OK;
}

static tn_status open_library(const tn_census_request *request, counted *c, size_t *column, tn_error *error)
{
    tn_status status = tn_module_load(request->module, request->module_size, NULL, &c->module, error);
    if (status == TN_OK)
        c->module->watch = request->watch;
    uint32_t index = status == TN_OK ? library_named(c->module, request->library) : TN_NO_RECORD;
    if (status == TN_OK && index == TN_NO_RECORD)
        status = tn_fail(error, TN_INVALID, E_NO_PLANS, "there is no library `%.200s` of plans to be counted",
                         request->library);
    if (status == TN_OK)
        status = tn_schema_new(c->module, c->module->LIBRARY_records[index].schema, 0, &c->schema, error);
    const tn_library_options options = {.max_states = request->brief ? TN_CENSUS_BRIEF_STATES : 0};
    if (status == TN_OK)
        status = tn_library_new(c->schema, index, &options, &c->library, error);
    return status == TN_OK ? find_measures(request, c, column, error) : status;
}

/* ---- what no field can have */

static tn_status no_plans(const tn_census_request *request, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_NO_PLANS, "library `%.200s` has no plan, so there would be no tray", request->library);
    tn_error_help(error, "`tartan check` says which clauses of `%.100s` contradict one another", request->library);
    return TN_INVALID;
}

static tn_status without_value(const tn_census_request *request, const counted *c, size_t column, tn_error *error)
{
    mpz_t plans;
    mpz_init(plans);
    for (size_t i = 0; i < c->table.count; i++)
        if (!c->table.rows[i].valued[column])
            mpz_add(plans, plans, c->table.rows[i].plans);
    char *count = mpz_get_str(NULL, 10, plans);
    tn_fail(error, TN_INVALID, E_PLAN_VALUES, "%.100s plans of library `%.120s` have no value of `%.120s`",
            count ? count : "some", request->library, request->measures[column]);
    tn_error_help(error, "every tray has one: name a library that leaves these plans out, made `from %.100s`",
                  request->library);
    free(count);
    mpz_clear(plans);
    return TN_INVALID;
}

static int compare_values(const void *left, const void *right)
{
    return mpq_cmp(**(mpq_t *const *)left, **(mpq_t *const *)right);
}

/* How many different values a measure has. */
static tn_status count_values(const counted *c, size_t column, size_t *count, tn_error *error)
{
    mpq_t **values = calloc(c->table.count + 1, sizeof *values);
    *count = 0;
    if (!values)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->table.count; i++)
        values[i] = &c->table.rows[i].values[column];
    qsort(values, c->table.count, sizeof *values, compare_values);
    for (size_t i = 0; i < c->table.count; i++)
        *count += i == 0 || mpq_cmp(*values[i - 1], *values[i]) != 0;
    free(values);
    return TN_OK;
}

static tn_status check_column(const tn_census_request *request, const counted *c, size_t column, tn_error *error)
{
    for (size_t i = 0; i < c->table.count; i++)
        if (!c->table.rows[i].valued[column])
            return without_value(request, c, column, error);
    size_t values;
    tn_status status = count_values(c, column, &values, error);
    if (status != TN_OK || values <= request->most_values)
        return status;
    tn_fail(error, TN_INVALID, E_PLAN_VALUES,
            "the plans of library `%.120s` have %zu different values of `%.120s`, more than the limit of %zu",
            request->library, values, request->measures[column], request->most_values);
    tn_error_help(error, "ask rules that say what matters of it, or name a smaller library");
    return TN_INVALID;
}

static tn_status check_all(const tn_census_request *request, const counted *c, size_t *column, tn_error *error)
{
    if (c->table.count == 0)
        return no_plans(request, error);
    for (*column = 0; *column < request->measure_count; ++*column) {
        tn_status status = check_column(request, c, *column, error);
        if (status != TN_OK)
            return status;
    }
    *column = SIZE_MAX;
    if (c->table.count <= TN_CENSUS_ROWS_MAX)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS,
            "the plans of library `%.200s` are trays of %zu kinds, more than the limit of %u", request->library,
            c->table.count, TN_CENSUS_ROWS_MAX);
    tn_error_help(error, "declare fewer fields, or ask rules in place of measures");
    return TN_LIMIT;
}

/* ---- the census */

/* A number's text in the arena; of GMP's own memory. NULL: out of memory. */
static const char *keep(tn_arena *arena, char *text)
{
    const char *kept = text ? tn_arena_copy(arena, text, strlen(text)) : NULL;
    free(text);
    return kept;
}

/* A value as a word (malloc); NULL: out of memory. */
static char *word_of(const counted *c, int power, const mpq_t value)
{
    tn_buffer text = {0};
    if (tn_amount_write_word(tn_amount_unit_of(c->schema, power), value, &text) && tn_buffer_append(&text, "", 1))
        return text.data;
    free(text.data);
    return NULL;
}

static tn_length_style style_of(const tn_schema *schema)
{
    uint32_t field = tn_schema_length_field(schema);
    return field == UINT32_MAX
               ? TN_STYLE_METRES
               : tn_length_style_of(tn_text(schema->module, schema->values[schema->value_start[field]].name));
}

/* Of a length: what the measure is. */
static int power_of(const counted *c, size_t column)
{
    const tn_bundle_measure *measure = &c->measures[column];
    int power = (int)c->module->SUM_records[measure->sum].power;
    return measure->over == TN_NO_RECORD ? power : power - (int)c->module->SUM_records[measure->over].power;
}

static tn_status fill(const counted *c, tn_arena *arena, tn_census *census, tn_error *error)
{
    size_t columns = c->table.measures;
    int *powers = tn_arena_alloc_array(arena, sizeof *powers, columns + 1);
    census->rows = tn_arena_alloc_array(arena, sizeof *census->rows, c->table.count);
    if (!powers || !census->rows)
        return tn_fail_memory(error);
    for (size_t k = 0; k < columns; k++)
        powers[k] = power_of(c, k);
    for (size_t i = 0; i < c->table.count; i++) {
        tn_census_row *row = &census->rows[i];
        row->values = tn_arena_alloc_array(arena, sizeof *row->values, columns + 1);
        row->texts = tn_arena_alloc_array(arena, sizeof *row->texts, columns + 1);
        row->plans = keep(arena, mpz_get_str(NULL, 10, c->table.rows[i].plans));
        bool good = row->values && row->texts && row->plans;
        for (size_t k = 0; good && k < columns; k++) {
            row->values[k] = keep(arena, mpq_get_str(NULL, 10, c->table.rows[i].values[k]));
            row->texts[k] = keep(arena, word_of(c, powers[k], c->table.rows[i].values[k]));
            good = row->values[k] && row->texts[k];
        }
        if (!good)
            return tn_fail_memory(error);
    }
    census->count = c->table.count;
    census->columns = columns;
    census->powers = powers;
    census->style = style_of(c->schema);
    return tn_arena_failed(arena) ? tn_fail_memory(error) : TN_OK;
}

static tn_status take(void *context, const tn_census_request *request, tn_arena *arena, tn_census *census,
                      size_t *column, tn_error *error)
{
    counted c = {0};
    (void)context;
    tn_status status = open_library(request, &c, column, error);
    if (status == TN_OK)
        status = tn_crosstab_make(&c.table, c.library, c.measures, (uint32_t)request->measure_count,
                                  request->brief ? TN_CENSUS_BRIEF_VALUES : 0, error);
    if (status == TN_OK)
        status = check_all(request, &c, column, error);
    if (status == TN_OK)
        status = fill(&c, arena, census, error);
    tn_crosstab_clear(&c.table);
    free(c.measures);
    tn_library_free(c.library);
    tn_schema_free(c.schema);
    tn_module_free(c.module);
    return status;
}

const tn_census_taker tn_plan_census = {.take = take};
