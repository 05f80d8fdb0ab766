/* The C interface to measures: names, units, distributions, the best plans, fronts, open plans. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/plan/plan.h"
#include "runtime/plan/match/match_lanes.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/complete.h"
#include "runtime/plan/measure/distribution.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/measure/pareto.h"
#include "runtime/plan/measure/weighed.h"
#include "runtime/plan/schema/sum.h"

/* Wishes made ready: the library weighed by their measures. */
typedef struct api_wishes {
    tn_weighed *weighed;
    uint32_t count;
    bool most[TN_WEIGHED_MAX];
    tn_amount_unit unit[TN_WEIGHED_MAX];
} api_wishes;

struct tartan_distribution {
    tn_distribution d;
    tn_amount_unit unit;
};

/* The MEASURE record named so, of the library's trays. */
static tartan_status api_measure_find(const tartan_library *library, const char *name, uint32_t *measure,
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

static tn_amount_unit api_measure_unit(const tartan_library *library, uint32_t measure)
{
    return tn_amount_unit_of(library->schema, tn_named_measure_power(library->schema->module, measure));
}

const char *tartan_measure_unit(const tartan_library *library, const char *measure)
{
    uint32_t index;
    if (api_measure_find(library, measure, &index, NULL) != TARTAN_OK)
        return NULL;
    return tn_amount_unit_name(api_measure_unit(library, index));
}

static tartan_status api_amount(tn_amount_unit unit, const mpq_t value, char **text, tartan_error *error)
{
    tn_buffer written = {0};
    if (!tn_amount_write_exact(unit, value, &written)) {
        free(written.data);
        return tn_api_memory(error);
    }
    *text = written.data;
    return TARTAN_OK;
}

/* ---- of single plans */

/* A measure, asked of one plan after another by interpretation. */
typedef struct api_measured {
    const tartan_library *library;
    uint32_t measure; /* of named.h */
    tn_plan_vm *vm;
} api_measured;

static tartan_status api_measured_begin(const tartan_library *library, const char *name, api_measured *measured,
                                        tartan_error *error)
{
    tn_error found;
    *measured = (api_measured){.library = library};
    tartan_status status = api_measure_find(library, name, &measured->measure, error);
    if (status != TARTAN_OK)
        return status;
    return tn_plan_vm_new(library->schema, 0, &measured->vm, &found) == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

/* The value on a plan, in the measure's unit. */
static tn_status api_measured_value(api_measured *measured, const uint32_t *trays, size_t length, mpq_t value,
                                    bool *has, tn_error *error)
{
    const tn_schema *schema = measured->library->schema;
    const tn_module *module = schema->module;
    tn_status status = tn_api_trays(schema, trays, length, error);
    if (status == TN_OK)
        status = tn_plan_vm_plan(measured->vm, trays, length, error);
    if (status == TN_OK && measured->measure == TN_PREFERENCE)
        status =
            tn_plan_vm_value(measured->vm, tn_preferred_sum(module, &module->LIBRARY_records[measured->library->index]),
                             value, has, error);
    else if (status == TN_OK)
        status = tn_plan_vm_measure(measured->vm, measured->measure, value, has, error);
    if (status == TN_OK)
        tn_amount_convert(api_measure_unit(measured->library, measured->measure), value);
    return status;
}

tartan_status tartan_measure_plan(const tartan_library *library, const char *measure, const uint32_t *trays,
                                  size_t length, char **value, tartan_error *error)
{
    api_measured measured;
    tn_error found;
    bool has = false;
    if (!value || (length && !trays))
        return tn_api_missing(error, value ? "plan" : "place for a value");
    tartan_status status = api_measured_begin(library, measure, &measured, error);
    if (status != TARTAN_OK)
        return status;
    mpq_t number;
    mpq_init(number);
    if (api_measured_value(&measured, trays, length, number, &has, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    char *text = status == TARTAN_OK && has ? mpq_get_str(NULL, 10, number) : NULL;
    mpq_clear(number);
    tn_plan_vm_free(measured.vm);
    if (status == TARTAN_OK)
        *value = text;
    return status;
}

/* The double nearest to a number, the even one of two: GMP rounds towards 0. */
static double api_nearest(const mpq_t number)
{
    double low = mpq_get_d(number), high = nextafter(low, mpq_sgn(number) < 0 ? -INFINITY : INFINITY);
    mpq_t middle, above;
    if (!isfinite(high))
        return low;
    mpq_inits(middle, above, NULL);
    mpq_set_d(middle, low);
    mpq_set_d(above, high);
    mpq_add(middle, middle, above);
    mpq_div_2exp(middle, middle, 1);
    int past = mpq_cmp(number, middle) * (mpq_sgn(number) < 0 ? -1 : 1);
    uint64_t bits;
    memcpy(&bits, &low, sizeof bits);
    mpq_clears(middle, above, NULL);
    return past > 0 || (past == 0 && bits % 2) ? high : low;
}

static tn_status api_measure_each(api_measured *measured, const tn_plan_array *plans, tn_watch *watch, double *values,
                                  tn_error *error)
{
    mpq_t number;
    mpq_init(number);
    size_t begin = 0;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < plans->count; begin = plans->ends[i++]) {
        bool has = false;
        if (i % 256 == 0) {
            tn_watch_tell(watch, (double)i, (double)plans->count);
            if (tn_watch_check(watch, error) != TN_OK)
                status = TN_STOPPED;
        }
        if (status == TN_OK)
            status = api_measured_value(measured, plans->trays + begin, plans->ends[i] - begin, number, &has, error);
        if (status == TN_OK)
            values[i] = has ? api_nearest(number) : NAN;
    }
    mpq_clear(number);
    return status;
}

tartan_status tartan_measure_plans(const tartan_library *library, const char *measure, const uint32_t *trays,
                                   const size_t *ends, size_t count, const tartan_watch *given, double *values,
                                   tartan_error *error)
{
    tn_watch watch;
    api_measured measured;
    tn_error found;
    if (count && (!ends || !values))
        return tn_api_missing(error, ends ? "room for values" : "array of ends");
    tartan_status status = tn_api_plan_array(trays, ends, count, error);
    if (status == TARTAN_OK)
        status = tn_api_watch(given, &watch, error);
    if (status == TARTAN_OK)
        status = api_measured_begin(library, measure, &measured, error);
    if (status != TARTAN_OK)
        return status;
    const tn_plan_array plans = {trays, 0, ends, count};
    if (api_measure_each(&measured, &plans, &watch, values, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    tn_plan_vm_free(measured.vm);
    return status;
}

/* ---- wishes */

/* `least` wishes are needed. Clear in any case. */
static tartan_status api_wishes_take(const tartan_library *library, const tartan_wish *given, size_t count,
                                     size_t least, api_wishes *wishes, tartan_error *error)
{
    uint32_t measures[TN_WEIGHED_MAX];
    tn_error found;
    *wishes = (api_wishes){0};
    if (!library || !given)
        return tn_api_missing(error, library ? "array of wishes" : "library");
    if (count < least || count > TN_WEIGHED_MAX)
        return tn_api_refuse(error, TARTAN_INVALID, "there are %zu wishes; %zu to %d are possible", count, least,
                             TN_WEIGHED_MAX);
    for (size_t i = 0; i < count; i++) {
        tartan_status status = api_measure_find(library, given[i].measure, &measures[i], error);
        if (status != TARTAN_OK)
            return status;
        wishes->most[i] = given[i].most;
        wishes->unit[i] = api_measure_unit(library, measures[i]);
    }
    wishes->count = (uint32_t)count;
    tn_status status = tn_weighed_new(library->library, measures, wishes->count, &wishes->weighed, &found);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

static void api_wishes_clear(api_wishes *wishes)
{
    tn_weighed_free(wishes->weighed);
    *wishes = (api_wishes){0};
}

/* A value in steps as a new text; one in nanometres. */
static tartan_status api_wish_value(const api_wishes *wishes, size_t wish, const int64_t *values, char **value,
                                    tartan_error *error)
{
    if (wish >= wishes->count)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no wish %zu", wish);
    mpq_t number;
    mpq_init(number);
    tn_weighed_value(wishes->weighed, (uint32_t)wish, values, number);
    tartan_status status = api_amount(wishes->unit[wish], number, value, error);
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
    tartan_status status = api_measure_find(library, measure, &index, error);
    if (status != TARTAN_OK)
        return status;
    tartan_distribution *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    made->unit = api_measure_unit(library, index);
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
    tartan_status status = api_amount(distribution->unit, number, &text, error);
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
    tartan_status status = api_amount(unit, statistic == TARTAN_VARIANCE ? variance : number, value, error);
    mpq_clears(number, variance, NULL);
    return status;
}

/* ---- the best plans of a library, and to fronts */

struct tartan_best {
    api_wishes wishes;
    tn_best *best;
    tn_tray *trays;
    int64_t values[TN_WEIGHED_MAX];
    bool stepped; /* on a plan */
};

struct tartan_front {
    api_wishes wishes;
    tn_pareto_front front;
};

/* ---- best plans */

tartan_status tartan_best_new(const tartan_library *library, const tartan_wish *wishes, size_t count,
                              tartan_best **best, tartan_error *error)
{
    tn_error found;
    tartan_best *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = api_wishes_take(library, wishes, count, 1, &made->wishes, error);
    if (status == TARTAN_OK) {
        made->trays = calloc((size_t)tn_library_max(library->library) + 1, sizeof *made->trays);
        status = made->trays ? TARTAN_OK : tn_api_memory(error);
    }
    if (status == TARTAN_OK && tn_best_new(made->wishes.weighed, made->wishes.most, &made->best, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    if (status == TARTAN_OK)
        *best = made;
    else
        tartan_best_free(made);
    return status;
}

void tartan_best_free(tartan_best *best)
{
    if (!best)
        return;
    tn_best_free(best->best);
    api_wishes_clear(&best->wishes);
    free(best->trays);
    free(best);
}

tartan_status tartan_best_next(tartan_best *best, const uint32_t **trays, size_t *length, bool *found,
                               tartan_error *error)
{
    tn_error failed;
    uint32_t count = 0;
    bool more = false;
    if (!best)
        return tn_api_missing(error, "object of best plans");
    tn_status status = tn_best_next(best->best, best->trays, &count, best->values, &more, &failed);
    best->stepped = status == TN_OK && more;
    if (status != TN_OK)
        return tn_api_fail(&failed, error);
    *found = more;
    if (more) {
        *trays = best->trays;
        *length = count;
    }
    return TARTAN_OK;
}

tartan_status tartan_best_value(const tartan_best *best, size_t wish, char **value, tartan_error *error)
{
    if (!best)
        return tn_api_missing(error, "object of best plans");
    if (!best->stepped)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no plan at hand");
    return api_wish_value(&best->wishes, wish, best->values, value, error);
}

/* ---- fronts */

tartan_status tartan_front_new(const tartan_library *library, const tartan_wish *wishes, size_t count,
                               tartan_front **front, tartan_error *error)
{
    tn_error found;
    tartan_front *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = api_wishes_take(library, wishes, count, 2, &made->wishes, error);
    if (status == TARTAN_OK && tn_pareto_make(&made->front, made->wishes.weighed, made->wishes.most, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    if (status == TARTAN_OK)
        *front = made;
    else
        tartan_front_free(made);
    return status;
}

void tartan_front_free(tartan_front *front)
{
    if (!front)
        return;
    tn_pareto_clear(&front->front);
    api_wishes_clear(&front->wishes);
    free(front);
}

size_t tartan_front_count(const tartan_front *front)
{
    return front->front.count;
}

static tartan_status check_point(const tartan_front *front, size_t point, tartan_error *error)
{
    if (!front)
        return tn_api_missing(error, "front");
    if (point >= front->front.count)
        return tn_api_refuse(error, TARTAN_INVALID, "the front has no point %zu", point);
    return TARTAN_OK;
}

tartan_status tartan_front_value(const tartan_front *front, size_t point, size_t wish, char **value,
                                 tartan_error *error)
{
    tartan_status status = check_point(front, point, error);
    if (status != TARTAN_OK)
        return status;
    return api_wish_value(&front->wishes, wish, front->front.points[point].values, value, error);
}

tartan_status tartan_front_plans(const tartan_front *front, size_t point, char **plans, const uint32_t **trays,
                                 size_t *length, tartan_error *error)
{
    tartan_status status = check_point(front, point, error);
    if (status == TARTAN_OK)
        status = tn_api_decimal(front->front.points[point].plans, plans, error);
    if (status != TARTAN_OK)
        return status;
    *trays = front->front.points[point].trays;
    *length = front->front.points[point].length;
    return TARTAN_OK;
}

/* ---- open plans */

struct tartan_completions {
    const tn_schema *schema;
    tn_completions found;
    char *plans;
    char **counts, **bests; /* [trays][values]; bests NULL without a wish */
};

void tartan_completions_free(tartan_completions *completions)
{
    if (!completions)
        return;
    size_t count = (size_t)completions->found.trays * completions->found.values;
    for (size_t i = 0; i < count; i++) {
        free(completions->counts ? completions->counts[i] : NULL);
        free(completions->bests ? completions->bests[i] : NULL);
    }
    free(completions->counts);
    free(completions->bests);
    free(completions->plans);
    tn_completions_clear(&completions->found);
    free(completions);
}

static tartan_status write_texts(tartan_completions *made, const api_wishes *wishes, tartan_error *error)
{
    size_t count = (size_t)made->found.trays * made->found.values;
    made->counts = calloc(count + 1, sizeof *made->counts);
    made->bests = wishes->weighed ? calloc(count + 1, sizeof *made->bests) : NULL;
    if (!made->counts || (wishes->weighed && !made->bests))
        return tn_api_memory(error);
    tartan_status status = tn_api_decimal(made->found.plans, &made->plans, error);
    for (size_t i = 0; status == TARTAN_OK && i < count; i++) {
        status = tn_api_decimal(made->found.counts[i], &made->counts[i], error);
        if (status == TARTAN_OK && made->bests && made->found.best[i] != TN_NO_BEST)
            status = api_wish_value(wishes, 0, &made->found.best[i], &made->bests[i], error);
    }
    return status;
}

static tartan_status find(const tartan_library *library, const tartan_open_tray *places, size_t count,
                          const api_wishes *wishes, tartan_completions *made, tartan_error *error)
{
    tn_open_tray *open = calloc(count + 1, sizeof *open);
    tn_error found;
    if (!open)
        return tn_api_memory(error);
    for (size_t i = 0; i < count; i++)
        open[i] = (tn_open_tray){places[i].fits, places[i].gap};
    const tn_open_plan plan = {.trays = open, .count = count, .weighed = wishes->weighed, .most = wishes->most[0]};
    tn_status status = tn_complete(&made->found, library->library, &plan, &found);
    free(open);
    return status == TN_OK ? write_texts(made, wishes, error) : tn_api_fail(&found, error);
}

tartan_status tartan_completions_new(const tartan_library *library, const tartan_open_tray *places, size_t count,
                                     const tartan_wish *wish, tartan_completions **completions, tartan_error *error)
{
    api_wishes wishes = {0};
    if (!library || (count && !places))
        return tn_api_missing(error, library ? "array of places" : "library");
    tartan_status status = wish ? api_wishes_take(library, wish, 1, 1, &wishes, error) : TARTAN_OK;
    tartan_completions *made = NULL;
    if (status == TARTAN_OK) {
        made = calloc(1, sizeof *made);
        status = made ? TARTAN_OK : tn_api_memory(error);
    }
    if (status == TARTAN_OK) {
        made->schema = library->schema;
        status = find(library, places, count, &wishes, made, error);
    }
    api_wishes_clear(&wishes);
    if (status == TARTAN_OK)
        *completions = made;
    else
        tartan_completions_free(made);
    return status;
}

const char *tartan_completions_plans(const tartan_completions *completions)
{
    return completions->plans;
}

size_t tartan_completions_count(const tartan_completions *completions, size_t place)
{
    return place < completions->found.trays ? completions->found.values : 0;
}

tartan_status tartan_completions_choice(const tartan_completions *completions, size_t place, size_t i,
                                        tartan_choice *choice, tartan_error *error)
{
    if (!completions || !choice)
        return tn_api_missing(error, completions ? "choice to fill" : "object of completions");
    if (i >= tartan_completions_count(completions, place))
        return tn_api_refuse(error, TARTAN_INVALID, "there is no choice %zu at place %zu", i, place);
    const tn_schema *schema = completions->schema;
    size_t at = place * completions->found.values + i;
    uint32_t field = 0;
    while (schema->value_start[field + 1] <= i)
        field++;
    *choice = (tartan_choice){tn_text(schema->module, schema->fields[field].name),
                              tn_text(schema->module, schema->values[i].spelling), completions->counts[at],
                              completions->bests ? completions->bests[at] : NULL};
    return TARTAN_OK;
}
