/* The distribution of a measure, as text and JSON. */
#include "cli/plan/count_by.h"

#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "driver/measure/spread.h"
#include "driver/open/digits.h"
#include "runtime/number/rational.h"

enum { BINS_MAX = 100000 };

/* As the options say, or by how many values there are. */
static bool choose_bins(tn_job *job, const tn_count_by_options *options, tn_bins *p)
{
    if (options->step) {
        bool good = tn_decimal_read(options->step, strlen(options->step), p->step) && mpq_sgn(p->step) > 0;
        if (!good) {
            tn_diagnostic *d = tn_job_usage(job, "the step is a number above 0, not `%.60s`", options->step);
            tn_help(tn_job_diagnostics(job), d, "write it in %s, without the unit: --step 50",
                    *tn_amount_unit_name(p->unit) ? tn_amount_unit_name(p->unit) : "the measure's numbers");
            return false;
        }
    }
    p->binned =
        p->d->count > 0 && (options->step || options->bins.given || (p->d->count > TN_VALUES_LISTED && !options->json));
    if (!p->binned)
        return true;
    if (!options->step)
        tn_bins_few(p, options->bins.given ? (unsigned long)options->bins.value : TN_BINS_DEFAULT);
    bool good = tn_bins_at_most(p, BINS_MAX);
    if (!good)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "the step makes more than %d bins", BINS_MAX),
                "give a greater one");
    return good;
}

/* ---- JSON */

static void put_exact(tn_json *json, const char *key, const mpq_t value)
{
    char *text = mpq_get_str(NULL, 10, value);
    tn_json_string(json, key, text);
    free(text);
}

static const char *things(const tn_spread *p)
{
    return strcmp(p->of, "plan") == 0 ? "plans" : "houses";
}

static void rows_json(const tn_spread *p, tn_json *json)
{
    tn_bin_row r;
    tn_bin_row_init(&p->bins, &r);
    tn_json_list(json, "distribution");
    while (tn_bin_row_next(&p->bins, &r)) {
        tn_json_object(json, NULL);
        put_exact(json, p->bins.binned ? "from" : "value", r.from);
        if (p->bins.binned)
            put_exact(json, "to", r.to);
        tn_json_digits(json, things(p), r.plans);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
    tn_bin_row_clear(&r);
}

static void statistics_json(const tn_spread *p, tn_json *json)
{
    static const char *const none[] = {"least", "most", "mean", "variance", "deviation", "quartiles"};
    const tn_distribution *d = &p->d;
    for (size_t i = 0; d->count == 0 && i < sizeof none / sizeof *none; i++)
        tn_json_null(json, none[i]);
    if (d->count == 0)
        return;
    mpq_t value, variance;
    mpq_inits(value, variance, NULL);
    tn_bins_value(&p->bins, 0, value);
    put_exact(json, "least", value);
    tn_bins_value(&p->bins, d->count - 1, value);
    put_exact(json, "most", value);
    tn_distribution_moments(d, value, variance);
    tn_buffer deviation = {0};
    tn_amount_write_root(p->bins.unit, variance, &deviation);
    tn_amount_convert(p->bins.unit, value);
    tn_amount_convert(p->bins.unit, variance);
    tn_amount_convert(p->bins.unit, variance);
    put_exact(json, "mean", value);
    put_exact(json, "variance", variance);
    tn_json_string(json, "deviation", deviation.data);
    free(deviation.data);
    tn_json_list(json, "quartiles");
    for (unsigned q = 1; q <= 3; q++) {
        tn_bins_value(&p->bins, tn_distribution_quartile(d, q), value);
        put_exact(json, NULL, value);
    }
    tn_json_list_end(json);
    mpq_clears(value, variance, NULL);
}

static void write_json(const tn_spread *p, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_LINES);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "measure", p->name);
    tn_json_whole(&json, "dimension", p->bins.unit.power);
    tn_json_string(&json, "unit", tn_amount_unit_name(p->bins.unit));
    tn_json_digits(&json, things(p), p->d.all);
    rows_json(p, &json);
    statistics_json(p, &json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

/* ---- text */

static void write_statistics(const tn_spread *p, FILE *out)
{
    for (unsigned i = 0; i < TN_SPREAD_FACTS; i++)
        fprintf(out, "%-20s  %s\n", p->names[i], p->facts[i]);
    fputc('\n', out);
}

static void put_bound(const tn_spread *p, const mpq_t value, tn_buffer *text)
{
    tn_amount_unit plain = {p->bins.unit.feet, 0};
    tn_amount_write(plain, value, text);
}

static void write_rows(const tn_spread *p, FILE *out)
{
    mpz_t running;
    tn_bin_row r;
    mpz_init(running);
    tn_bin_row_init(&p->bins, &r);
    tn_buffer heading = {0};
    if (p->bins.binned) {
        put_bound(p, p->bins.step, &heading);
        const char *unit = tn_amount_unit_name(p->bins.unit);
        fprintf(out, "%zu values, in bins of %s%s%s\n", p->d.count, heading.data ? heading.data : "", *unit ? " " : "",
                unit);
    }
    free(heading.data);
    fprintf(out, "%24s  %24s  %7s  %7s\n", p->bins.binned ? "from, to below" : "value", things(p), "share", "so far");
    while (tn_bin_row_next(&p->bins, &r)) {
        tn_buffer text = {0};
        put_bound(p, r.from, &text);
        if (p->bins.binned) {
            tn_buffer_printf(&text, " .. ");
            put_bound(p, r.to, &text);
        }
        char *plans = tn_digits(r.plans, true);
        mpz_add(running, running, r.plans);
        fprintf(out, "%24s  %24s  %6.2f%%  %6.2f%%\n", text.data ? text.data : "", plans ? plans : "",
                100 * tn_bins_share(r.plans, p->d.all), 100 * tn_bins_share(running, p->d.all));
        free(plans);
        free(text.data);
    }
    tn_bin_row_clear(&r);
    mpz_clear(running);
}

static void write_text(const tn_spread *p, FILE *out)
{
    const char *doc = p->doc, *unit = tn_amount_unit_name(p->bins.unit);
    char *all = tn_digits(p->d.all, true);
    fprintf(out, "%s%s%s%s%s%s of %s %s of %s\n\n", p->name, *doc ? " " : "", doc, *unit ? " (" : "", unit,
            *unit ? ")" : "", all ? all : "", things(p), p->library);
    free(all);
    if (p->d.count == 0)
        return;
    write_statistics(p, out);
    write_rows(p, out);
}

static void write_spread(tn_job *job, const tn_spread *spread, bool json, const char *path)
{
    tn_error error;
    tn_output output;
    tn_job_show(job);
    if (tn_job_draws(path)) {
        if (tn_spread_draw(spread, &(tn_picture){.path = path}, &error) != TN_OK)
            tn_job_fail(job, &error);
    } else if (tn_job_output(job, path, &output)) {
        (json ? write_json : write_text)(spread, output.stream);
        tn_job_commit(job, &output);
    }
}

void tn_count_by(tn_job *job, const tn_ready_library *ready, const char *measure, const tn_count_by_options *options,
                 const char *path)
{
    uint32_t index;
    tn_spread spread;
    tn_error error;
    if (options->json && !tn_job_takes_text(job, path))
        return;
    tn_status status = tn_measure_choose(&job->opened, measure, ready->record->schema, &index);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    tn_progress progress;
    tn_progress_watch(&progress, "counting by the measure", tn_interrupt_waiting());
    status = tn_spread_make(&spread, ready, index, &error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    if (status != TN_OK)
        tn_job_fail(job, &error);
    else
        tn_show_spread(job, &spread, options, path);
    tn_spread_clear(&spread);
}

void tn_show_spread(tn_job *job, tn_spread *spread, const tn_count_by_options *options, const char *path)
{
    if (choose_bins(job, options, &spread->bins))
        write_spread(job, spread, options->json, path);
}
