/* How plans, or houses, are spread over the values of a measure. */
#include <stdlib.h>
#include <string.h>

#include "ask/plan/count.h"
#include "runtime/number/rational.h"

static tn_status refuse_step(tn_session *session, const char *step, const tn_bins *bins)
{
    const char *unit = tn_amount_unit_name(bins->unit);
    char help[120];
    snprintf(help, sizeof help, "write it in %s, without the unit: --step 50", *unit ? unit : "the measure's numbers");
    return tn_session_refuse(session, help, "the step is a number above 0, not `%.60s`", step);
}

/* As it is asked for, or by how many values there are. */
static tn_status choose_bins(tn_session *session, const tn_count_request *request, tn_bins *bins)
{
    const char *step = request->step;
    if (step && !(tn_decimal_read(step, strlen(step), bins->step) && mpq_sgn(bins->step) > 0))
        return refuse_step(session, step, bins);
    bins->binned =
        bins->d->count > 0 && (step || request->has_bins || (bins->d->count > TN_VALUES_LISTED && !request->values));
    if (!bins->binned)
        return TN_OK;
    if (!step)
        tn_bins_few(bins, request->has_bins ? request->bins : TN_BINS_DEFAULT);
    return tn_bins_at_most(bins, TN_BINS_MAX)
               ? TN_OK
               : tn_session_refuse(session, "give a greater one", "the step makes more than %u bins", TN_BINS_MAX);
}

static size_t count_rows(const tn_bins *bins)
{
    tn_bin_row row;
    size_t count = 0;
    tn_bin_row_init(bins, &row);
    while (tn_bin_row_next(bins, &row))
        count++;
    tn_bin_row_clear(&row);
    return count;
}

static tn_status give_rows(const tn_spread *spread, bool of_houses, tn_counted_values *counted, tn_error *error)
{
    const tn_bins *bins = &spread->bins;
    tn_status status =
        tn_message_list(&tn_message_spread_row, count_rows(bins), (tn_list *)&counted->distribution, error);
    tn_bin_row row;
    tn_bin_row_init(bins, &row);
    for (size_t i = 0; status == TN_OK && tn_bin_row_next(bins, &row); i++) {
        tn_spread_row *given = &counted->distribution.items[i];
        given->has_from = given->has_to = bins->binned;
        given->has_value = !bins->binned;
        given->has_houses = of_houses;
        given->has_plans = !of_houses;
        mpq_set(bins->binned ? given->from : given->value, row.from);
        mpq_set(given->to, row.to);
        mpz_set(of_houses ? given->houses : given->plans, row.plans);
    }
    tn_bin_row_clear(&row);
    return status;
}

static tn_status give_quartiles(const tn_bins *bins, tn_exacts *quartiles, tn_error *error)
{
    tn_status status = tn_exacts_room(quartiles, 3, error);
    for (unsigned i = 0; status == TN_OK && i < 3; i++)
        tn_bins_value(bins, tn_distribution_quartile(bins->d, i + 1), quartiles->items[i]);
    return status;
}

static tn_status give_statistics(const tn_bins *bins, tn_counted_values *counted, tn_error *error)
{
    tn_buffer deviation = {0};
    counted->has_least = counted->has_most = counted->has_mean = counted->has_variance = true;
    counted->has_deviation = counted->has_quartiles = true;
    tn_bins_value(bins, 0, counted->least);
    tn_bins_value(bins, bins->d->count - 1, counted->most);
    tn_distribution_moments(bins->d, counted->mean, counted->variance);
    tn_amount_write_root(bins->unit, counted->variance, &deviation);
    tn_amount_convert(bins->unit, counted->mean);
    tn_amount_convert(bins->unit, counted->variance);
    tn_amount_convert(bins->unit, counted->variance);
    counted->deviation = deviation.data;
    return deviation.data ? give_quartiles(bins, &counted->quartiles, error) : tn_fail_memory(error);
}

static tn_status give(const tn_spread *spread, tn_counted_values *counted, tn_error *error)
{
    bool of_houses = strcmp(spread->of, "house") == 0;
    counted->measure = spread->name;
    counted->dimension = spread->bins.unit.power;
    counted->unit = tn_amount_unit_name(spread->bins.unit);
    counted->has_houses = of_houses;
    counted->has_plans = !of_houses;
    mpz_set(of_houses ? counted->houses : counted->plans, spread->d.all);
    counted->has_none = mpz_sgn(spread->d.without) > 0;
    mpz_set(counted->none, spread->d.without);
    tn_status status = give_rows(spread, of_houses, counted, error);
    return status == TN_OK && spread->d.count > 0 ? give_statistics(&spread->bins, counted, error) : status;
}

static void free_spread(void *spread)
{
    tn_spread_clear(spread);
    free(spread);
}

tn_spread *tn_spread_room(tn_session *session)
{
    tn_error error;
    tn_spread *spread = calloc(1, sizeof *spread);
    if (!spread) {
        tn_fail_memory(&error);
        tn_session_fail(session, &error);
    }
    return spread;
}

tn_status tn_reply_spread(tn_session *session, const tn_count_request *request, tn_spread *spread, tn_reply *answer)
{
    tn_error error;
    tn_status status = choose_bins(session, request, &spread->bins);
    if (status != TN_OK) {
        free_spread(spread);
        return status;
    }
    status = tn_reply_new(&tn_message_counted_values, answer, &error);
    if (status != TN_OK) {
        free_spread(spread);
        return tn_session_fail(session, &error);
    }
    tn_counted_values *counted = answer->value;
    counted->spread = (tn_boxed){spread, free_spread};
    status = give(spread, counted, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

tn_status tn_count_plans_by(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    uint32_t index;
    tn_error error;
    tn_status status = tn_session_library(session, &request->subject, &ready);
    if (status == TN_OK)
        status = tn_measure_choose(session->opened, request->by, ready->record, &index);
    if (status != TN_OK)
        return status;
    tn_spread *spread = tn_spread_room(session);
    if (!spread)
        return TN_MEMORY;
    tn_session_begins(session, "counting by the measure");
    status = tn_spread_make(spread, ready, index, &error);
    tn_session_ends(session);
    if (status == TN_OK)
        return tn_reply_spread(session, request, spread, answer);
    free_spread(spread);
    return tn_session_fail(session, &error);
}
