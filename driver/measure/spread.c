/* Makes the distribution of a measure, says it in words, and draws it. */
#include "driver/measure/spread.h"

#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"
#include "runtime/base/array.h"
#include "runtime/chart/chart.h"
#include "runtime/number/rational.h"
#include "runtime/plan/measure/named.h"

enum { LEAST, QUARTER, HALF, THREE_QUARTERS, MOST, MEAN, DEVIATION };

static bool put_value(tn_spread *s, int fact, size_t i)
{
    mpq_t value;
    tn_buffer text = {0};
    mpq_init(value);
    tn_distribution_value(&s->d, i, value);
    bool ok = tn_amount_write(s->bins.unit, value, &text);
    mpq_clear(value);
    s->facts[fact] = text.data;
    return ok;
}

/* Mean and deviation have many digits: six are shown. */
static bool put_moments(tn_spread *s)
{
    mpq_t mean, variance;
    tn_buffer about = {0}, root = {0}, deviation = {0};
    mpq_inits(mean, variance, NULL);
    tn_distribution_moments(&s->d, mean, variance);
    tn_amount_convert(s->bins.unit, mean);
    bool ok = tn_amount_write_about(s->bins.unit, mean, &about) &&
              tn_amount_write_root(s->bins.unit, variance, &root) &&
              tn_decimal_read(root.data, strlen(root.data), variance) &&
              tn_amount_write_about(s->bins.unit, variance, &deviation);
    mpq_clears(mean, variance, NULL);
    s->facts[MEAN] = about.data;
    s->facts[DEVIATION] = deviation.data;
    free(root.data);
    return ok;
}

static bool put_facts(tn_spread *s)
{
    static const char *const names[TN_SPREAD_FACTS] = {
        "least", "a quarter is at most", "half is at most", "3 quarters at most", "most", "mean", "standard deviation"};
    memcpy(s->names, names, sizeof names);
    if (s->d.count == 0)
        return true;
    bool ok = put_value(s, LEAST, 0) && put_value(s, MOST, s->d.count - 1);
    for (unsigned q = 1; ok && q <= 3; q++)
        ok = put_value(s, LEAST + (int)q, tn_distribution_quartile(&s->d, q));
    return ok && put_moments(s);
}

void tn_spread_begin(tn_spread *s, const tn_schema *schema, int power)
{
    *s = (tn_spread){0};
    tn_distribution_init(&s->d);
    tn_bins_init(&s->bins, &s->d, tn_amount_unit_of(schema, power));
}

tn_status tn_spread_finish(tn_spread *s, tn_error *error)
{
    return put_facts(s) ? TN_OK : tn_fail_memory(error);
}

tn_status tn_spread_make(tn_spread *s, const tn_ready_library *ready, uint32_t measure, tn_error *error)
{
    const tn_module *module = ready->schema->module;
    tn_spread_begin(s, ready->schema, tn_named_measure_power(module, measure));
    s->library = tn_text(module, ready->record->name);
    s->name = tn_named_measure(module, measure);
    s->doc = tn_named_measure_doc(module, measure);
    s->of = "plan";
    tn_status status = tn_weighed_new(ready->library, &measure, 1, &s->weighed, error);
    if (status == TN_OK)
        status = tn_distribution_make(&s->d, s->weighed, error);
    return status == TN_OK ? tn_spread_finish(s, error) : status;
}

static void clear_facts(tn_spread *s)
{
    for (unsigned i = 0; i < TN_SPREAD_FACTS; i++) {
        free(s->facts[i]);
        s->facts[i] = NULL;
    }
}

tn_status tn_spread_show(tn_spread *s, tn_error *error)
{
    clear_facts(s);
    s->bins.unit.shown = true;
    return tn_spread_finish(s, error);
}

void tn_spread_clear(tn_spread *s)
{
    clear_facts(s);
    tn_bins_clear(&s->bins);
    tn_distribution_clear(&s->d);
    tn_weighed_free(s->weighed);
}

/* ---- the picture */

static bool find_bars(const tn_spread *s, tn_chart_bar **bars, size_t *count)
{
    size_t room = 0;
    tn_bin_row row;
    bool ok = true;
    tn_bin_row_init(&s->bins, &row);
    while (ok && tn_bin_row_next(&s->bins, &row)) {
        ok = tn_array_reserve(bars, &room, *count, 1, sizeof **bars);
        if (ok)
            (*bars)[(*count)++] =
                (tn_chart_bar){mpq_get_d(row.from), mpq_get_d(row.to), tn_bins_share(row.plans, s->d.all)};
    }
    tn_bin_row_clear(&row);
    return ok;
}

static double value_at(const tn_spread *s, size_t i)
{
    mpq_t value;
    mpq_init(value);
    tn_bins_value(&s->bins, i, value);
    double number = mpq_get_d(value);
    mpq_clear(value);
    return number;
}

static double mean_of(const tn_spread *s)
{
    mpq_t mean, variance;
    mpq_inits(mean, variance, NULL);
    tn_distribution_moments(&s->d, mean, variance);
    tn_amount_convert(s->bins.unit, mean);
    double number = mpq_get_d(mean);
    mpq_clears(mean, variance, NULL);
    return number;
}

/* "12 plans of mews, 5 values; 3 without a value" */
static bool write_about(const tn_spread *s, tn_buffer *text)
{
    char *all = tn_digits(s->d.all, true);
    const char *unit = tn_amount_unit_name(s->bins.unit);
    bool ok =
        all && tn_buffer_printf(text, "%s %s%s of %s, %zu value%s", all, s->of, mpz_cmp_ui(s->d.all, 1) ? "s" : "",
                                s->library, s->d.count, s->d.count == 1 ? "" : "s");
    if (ok && s->bins.binned)
        ok = tn_buffer_printf(text, ", in bins of ") &&
             tn_amount_write((tn_amount_unit){.feet = s->bins.unit.feet}, s->bins.step, text) &&
             tn_buffer_printf(text, "%s%s", *unit ? " " : "", unit);
    char *without = ok && mpz_sgn(s->d.without) > 0 ? tn_digits(s->d.without, true) : NULL;
    if (without)
        ok = tn_buffer_printf(text, "; %s without a value", without);
    free(without);
    free(all);
    return ok;
}

static void take_numbers(const tn_spread *s, tn_histogram *h)
{
    if (s->d.count == 0)
        return;
    h->least = value_at(s, 0);
    h->most = value_at(s, s->d.count - 1);
    h->mean = mean_of(s);
    for (unsigned q = 1; q <= 3; q++)
        h->quartiles[q - 1] = value_at(s, tn_distribution_quartile(&s->d, q));
    for (; h->fact_count < TN_SPREAD_FACTS; h->fact_count++)
        h->facts[h->fact_count] = (tn_chart_fact){s->names[h->fact_count], s->facts[h->fact_count]};
}

/* s: with units as pictures have them. */
static tn_status draw(const tn_spread *s, tn_picture *to, tn_error *error)
{
    tn_chart_bar *bars = NULL;
    tn_buffer about = {0};
    tn_histogram h = {.title = s->name, .doc = s->doc, .unit = tn_amount_unit_name(s->bins.unit)};
    bool ok = (s->d.count == 0 || find_bars(s, &bars, &h.count)) && write_about(s, &about);
    tn_status status = ok ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        h.bars = bars;
        h.about = about.data;
        take_numbers(s, &h);
        status = tn_histogram_draw(&h, to, error);
    }
    free(about.data);
    free(bars);
    return status;
}

tn_status tn_spread_draw(const tn_spread *spread, tn_picture *to, tn_error *error)
{
    tn_spread shown = *spread;
    memset(shown.facts, 0, sizeof shown.facts);
    tn_status status = tn_spread_show(&shown, error);
    if (status == TN_OK)
        status = draw(&shown, to, error);
    clear_facts(&shown);
    return status;
}
