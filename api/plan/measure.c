/* The C interface to measures: names, units, distributions. */
#include <stdlib.h>
#include <string.h>

#include "api/plan/measure_data.h"
#include "runtime/plan/measure/distribution.h"
#include "runtime/plan/measure/named.h"

struct tartan_distribution {
    tn_distribution d;
    tn_amount_unit unit;
};

tartan_status tn_api_measure_find(const tartan_library *library, const char *name, uint32_t *measure,
                                  tartan_error *error)
{
    if (!library || !name)
        return tn_api_missing(error, library ? "measure" : "library");
    if (!library->owned)
        return tn_api_refuse(error, TARTAN_INVALID, "a part of a comparison has no measures");
    const tn_module *module = library->schema->module;
    const tn_library_record *record = &module->LIBRARY_records[library->index];
    *measure = tn_named_measure_find(module, record, name);
    if (*measure != TN_NO_RECORD)
        return TARTAN_OK;
    size_t count = 0;
    const char **names = malloc((module->MEASURE_count + 1) * sizeof *names);
    for (uint32_t i = TN_NO_RECORD; names && tn_named_measure_next(module, record, &i);)
        names[count++] = tn_named_measure(module, i);
    return tn_api_unknown(error, "measure", name, names, count);
}

tn_amount_unit tn_api_measure_unit(const tartan_library *library, uint32_t measure)
{
    return tn_amount_unit_of(library->schema, tn_named_measure_power(library->schema->module, measure));
}

const char *tartan_measure_unit(const tartan_library *library, const char *measure)
{
    uint32_t index;
    if (tn_api_measure_find(library, measure, &index, NULL) != TARTAN_OK)
        return NULL;
    return tn_amount_unit_name(tn_api_measure_unit(library, index));
}

tartan_status tn_api_amount(tn_amount_unit unit, const mpq_t value, char **text, tartan_error *error)
{
    tn_buffer written = {0};
    if (!tn_amount_write_exact(unit, value, &written)) {
        free(written.data);
        return tn_api_memory(error);
    }
    *text = written.data;
    return TARTAN_OK;
}

/* ---- wishes */

tartan_status tn_api_wishes_take(const tartan_library *library, const tartan_wish *given, size_t count, size_t least,
                                 tn_api_wishes *wishes, tartan_error *error)
{
    uint32_t measures[TN_WEIGHED_MAX];
    tn_error found;
    *wishes = (tn_api_wishes){0};
    if (!library || !given)
        return tn_api_missing(error, library ? "array of wishes" : "library");
    if (count < least || count > TN_WEIGHED_MAX)
        return tn_api_refuse(error, TARTAN_INVALID, "there are %zu wishes; %zu to %d are possible", count, least,
                             TN_WEIGHED_MAX);
    for (size_t i = 0; i < count; i++) {
        tartan_status status = tn_api_measure_find(library, given[i].measure, &measures[i], error);
        if (status != TARTAN_OK)
            return status;
        wishes->most[i] = given[i].most;
        wishes->unit[i] = tn_api_measure_unit(library, measures[i]);
    }
    wishes->count = (uint32_t)count;
    tn_status status = tn_weighed_new(library->library, measures, wishes->count, &wishes->weighed, &found);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

void tn_api_wishes_clear(tn_api_wishes *wishes)
{
    tn_weighed_free(wishes->weighed);
    *wishes = (tn_api_wishes){0};
}

tartan_status tn_api_wish_value(const tn_api_wishes *wishes, size_t wish, const int64_t *values, char **value,
                                tartan_error *error)
{
    if (wish >= wishes->count)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no wish %zu", wish);
    mpq_t number;
    mpq_init(number);
    tn_weighed_value(wishes->weighed, (uint32_t)wish, values, number);
    tartan_status status = tn_api_amount(wishes->unit[wish], number, value, error);
    mpq_clear(number);
    return status;
}

/* ---- distributions */

tartan_status tartan_distribution_new(const tartan_library *library, const char *measure,
                                      tartan_distribution **distribution, tartan_error *error)
{
    uint32_t index;
    tn_weighed *weighed = NULL;
    tn_error found;
    tartan_status status = tn_api_measure_find(library, measure, &index, error);
    if (status != TARTAN_OK)
        return status;
    tartan_distribution *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    made->unit = tn_api_measure_unit(library, index);
    tn_distribution_init(&made->d);
    tn_status worked = tn_weighed_new(library->library, &index, 1, &weighed, &found);
    if (worked == TN_OK)
        worked = tn_distribution_make(&made->d, weighed, &found);
    tn_weighed_free(weighed);
    if (worked != TN_OK) {
        tartan_distribution_free(made);
        return tn_api_fail(&found, error);
    }
    *distribution = made;
    return TARTAN_OK;
}

void tartan_distribution_free(tartan_distribution *distribution)
{
    if (!distribution)
        return;
    tn_distribution_clear(&distribution->d);
    free(distribution);
}

size_t tartan_distribution_count(const tartan_distribution *distribution)
{
    return distribution->d.count;
}

tartan_status tartan_distribution_value(const tartan_distribution *distribution, size_t i, char **value, char **plans,
                                        tartan_error *error)
{
    if (!distribution)
        return tn_api_missing(error, "distribution");
    if (i >= distribution->d.count)
        return tn_api_refuse(error, TARTAN_INVALID, "the distribution has no value %zu", i);
    char *text = NULL;
    mpq_t number;
    mpq_init(number);
    tn_distribution_value(&distribution->d, i, number);
    tartan_status status = tn_api_amount(distribution->unit, number, &text, error);
    mpq_clear(number);
    if (status == TARTAN_OK)
        status = tn_api_decimal(distribution->d.plans[i], plans, error);
    if (status == TARTAN_OK)
        *value = text;
    else
        free(text);
    return status;
}

tartan_status tartan_distribution_none(const tartan_distribution *distribution, char **plans, tartan_error *error)
{
    return distribution ? tn_api_decimal(distribution->d.without, plans, error) : tn_api_missing(error, "distribution");
}

tartan_status tartan_distribution_statistic(const tartan_distribution *distribution, tartan_statistic statistic,
                                            char **value, tartan_error *error)
{
    if (!distribution)
        return tn_api_missing(error, "distribution");
    if ((unsigned)statistic > TARTAN_VARIANCE)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no statistic %d", (int)statistic);
    if (distribution->d.count == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "no plan of the library has a value");
    const tn_distribution *d = &distribution->d;
    tn_amount_unit unit = distribution->unit;
    mpq_t number, variance;
    mpq_inits(number, variance, NULL);
    if (statistic == TARTAN_MEAN || statistic == TARTAN_VARIANCE)
        tn_distribution_moments(d, number, variance);
    else if (statistic == TARTAN_LEAST || statistic == TARTAN_MOST)
        tn_distribution_value(d, statistic == TARTAN_LEAST ? 0 : d->count - 1, number);
    else
        tn_distribution_value(d, tn_distribution_quartile(d, (unsigned)(statistic - TARTAN_LEAST)), number);
    unit.power *= statistic == TARTAN_VARIANCE ? 2 : 1;
    tartan_status status = tn_api_amount(unit, statistic == TARTAN_VARIANCE ? variance : number, value, error);
    mpq_clears(number, variance, NULL);
    return status;
}
