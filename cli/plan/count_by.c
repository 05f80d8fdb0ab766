/* The distribution of a measure, as text and JSON. */
#include "cli/plan/count_by.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"
#include "runtime/number/rational.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/distribution.h"

enum { VALUES_LISTED = 200, BINS_DEFAULT = 40, BINS_MAX = 100000 };

typedef struct paper {
    const tn_ready_library *ready;
    const tn_measure_record *measure;
    const tn_distribution *d;
    tn_amount_unit unit;
    bool binned;
    mpq_t step; /* of bins, in the unit */
} paper;

/* value i in the unit. */
static void value_of(const paper *p, size_t i, mpq_t value)
{
    tn_distribution_value(p->d, i, value);
    tn_amount_convert(p->unit, value);
}

/* The bin that value i lies in: floor(value / step). */
static void bin_of(const paper *p, size_t i, mpz_t bin)
{
    mpq_t value;
    mpq_init(value);
    value_of(p, i, value);
    mpq_div(value, value, p->step);
    mpz_fdiv_q(bin, mpq_numref(value), mpq_denref(value));
    mpq_clear(value);
}

static void count_bins(const paper *p, mpz_t bins)
{
    mpz_t first;
    mpz_init(first);
    bin_of(p, 0, first);
    bin_of(p, p->d->count - 1, bins);
    mpz_sub(bins, bins, first);
    mpz_add_ui(bins, bins, 1);
    mpz_clear(first);
}

/* The least step of 1, 2 or 5 times a power of ten of the unit that makes at most so many bins. */
static void find_step(paper *p, unsigned long most)
{
    static const unsigned factors[] = {1, 2, 5};
    mpz_t bins;
    mpz_init(bins);
    for (int power = -12, done = 0; power < 300 && !done; power++) {
        for (size_t f = 0; f < 3 && !done; f++) {
            mpq_t ten;
            mpq_init(ten);
            mpq_set_ui(ten, 10, 1);
            tn_rational_power(p->step, ten, power);
            mpq_set_ui(ten, factors[f], 1);
            mpq_mul(p->step, p->step, ten);
            mpq_clear(ten);
            count_bins(p, bins);
            done = mpz_cmp_ui(bins, most) <= 0;
        }
    }
    mpz_clear(bins);
}

/* As the options say, or by how many values there are. */
static bool choose_bins(tn_job *job, const tn_count_by_options *options, paper *p)
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
        p->d->count > 0 && (options->step || options->bins.given || (p->d->count > VALUES_LISTED && !options->json));
    if (!p->binned)
        return true;
    if (!options->step)
        find_step(p, options->bins.given ? (unsigned long)options->bins.value : BINS_DEFAULT);
    mpz_t bins;
    mpz_init(bins);
    count_bins(p, bins);
    bool good = mpz_cmp_ui(bins, BINS_MAX) <= 0;
    mpz_clear(bins);
    if (!good)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "the step makes more than %d bins", BINS_MAX),
                "give a greater one");
    return good;
}

/* Walks the values one by one, or bin by bin, empty ones too. */
typedef struct row {
    mpq_t from, to; /* to: only of bins */
    mpz_t plans;
    size_t next; /* value not yet taken */
    mpz_t bin;
} row;

static void row_init(const paper *p, row *r)
{
    mpq_inits(r->from, r->to, NULL);
    mpz_inits(r->plans, r->bin, NULL);
    r->next = 0;
    if (p->binned)
        bin_of(p, 0, r->bin);
}

static bool row_next(const paper *p, row *r)
{
    if (r->next == p->d->count)
        return false;
    mpz_set_ui(r->plans, 0);
    if (!p->binned) {
        value_of(p, r->next, r->from);
        mpz_set(r->plans, p->d->plans[r->next++]);
        return true;
    }
    mpz_t bin;
    mpz_init(bin);
    mpq_set_z(r->from, r->bin);
    mpq_mul(r->from, r->from, p->step);
    mpq_add(r->to, r->from, p->step);
    for (; r->next < p->d->count; r->next++) {
        bin_of(p, r->next, bin);
        if (mpz_cmp(bin, r->bin) != 0)
            break;
        mpz_add(r->plans, r->plans, p->d->plans[r->next]);
    }
    mpz_add_ui(r->bin, r->bin, 1);
    mpz_clear(bin);
    return true;
}

static void row_clear(row *r)
{
    mpq_clears(r->from, r->to, NULL);
    mpz_clears(r->plans, r->bin, NULL);
}

/* ---- JSON */

static void set_exact(json_t *object, const char *key, const mpq_t value)
{
    char *text = mpq_get_str(NULL, 10, value);
    json_object_set_new(object, key, json_string(text ? text : ""));
    free(text);
}

static void set_plans(json_t *object, const char *key, const mpz_t plans)
{
    char *text = tn_digits(plans, false);
    json_object_set_new(object, key, json_string(text ? text : ""));
    free(text);
}

static json_t *rows_json(const paper *p)
{
    json_t *list = json_array();
    row r;
    row_init(p, &r);
    while (row_next(p, &r)) {
        json_t *item = json_object();
        set_exact(item, p->binned ? "from" : "value", r.from);
        if (p->binned)
            set_exact(item, "to", r.to);
        set_plans(item, "plans", r.plans);
        json_array_append_new(list, item);
    }
    row_clear(&r);
    return list;
}

static void set_statistics(const paper *p, json_t *root)
{
    static const char *const none[] = {"least", "most", "mean", "variance", "deviation", "quartiles"};
    const tn_distribution *d = p->d;
    for (size_t i = 0; d->count == 0 && i < sizeof none / sizeof *none; i++)
        json_object_set_new(root, none[i], json_null());
    if (d->count == 0)
        return;
    mpq_t value, variance;
    mpq_inits(value, variance, NULL);
    value_of(p, 0, value);
    set_exact(root, "least", value);
    value_of(p, d->count - 1, value);
    set_exact(root, "most", value);
    tn_distribution_moments(d, value, variance);
    tn_buffer deviation = {0};
    tn_amount_write_root(p->unit, variance, &deviation);
    tn_amount_convert(p->unit, value);
    tn_amount_convert(p->unit, variance);
    tn_amount_convert(p->unit, variance);
    set_exact(root, "mean", value);
    set_exact(root, "variance", variance);
    json_object_set_new(root, "deviation", json_string(deviation.data ? deviation.data : ""));
    free(deviation.data);
    json_t *quartiles = json_array();
    for (unsigned q = 1; q <= 3; q++) {
        value_of(p, tn_distribution_quartile(d, q), value);
        char *text = mpq_get_str(NULL, 10, value);
        json_array_append_new(quartiles, json_string(text ? text : ""));
        free(text);
    }
    json_object_set_new(root, "quartiles", quartiles);
    mpq_clears(value, variance, NULL);
}

static void write_json(const paper *p, FILE *out)
{
    json_t *root = json_object();
    json_object_set_new(root, "measure", json_string(tn_text(p->ready->schema->module, p->measure->name)));
    json_object_set_new(root, "dimension", json_integer(p->unit.power));
    json_object_set_new(root, "unit", json_string(tn_amount_unit_name(p->unit)));
    set_plans(root, "plans", p->d->all);
    json_object_set_new(root, "distribution", rows_json(p));
    set_statistics(p, root);
    json_dumpf(root, out, JSON_INDENT(2));
    fputc('\n', out);
    json_decref(root);
}

/* ---- text */

static void put_value(const paper *p, const char *what, const mpq_t nanometres, FILE *out)
{
    tn_buffer text = {0};
    tn_amount_write(p->unit, nanometres, &text);
    fprintf(out, "%-20s  %s\n", what, text.data ? text.data : "");
    free(text.data);
}

static void put_about(const paper *p, const char *what, const mpq_t converted, FILE *out)
{
    tn_buffer text = {0};
    tn_amount_write_about(p->unit, converted, &text);
    fprintf(out, "%-20s  %s\n", what, text.data ? text.data : "");
    free(text.data);
}

static void write_statistics(const paper *p, FILE *out)
{
    static const char *const quartiles[] = {"a quarter is at most", "half is at most", "3 quarters at most"};
    mpq_t value, variance;
    mpq_inits(value, variance, NULL);
    tn_distribution_value(p->d, 0, value);
    put_value(p, "least", value, out);
    for (unsigned q = 1; q <= 3; q++) {
        tn_distribution_value(p->d, tn_distribution_quartile(p->d, q), value);
        put_value(p, quartiles[q - 1], value, out);
    }
    tn_distribution_value(p->d, p->d->count - 1, value);
    put_value(p, "most", value, out);
    tn_distribution_moments(p->d, value, variance);
    tn_amount_convert(p->unit, value);
    put_about(p, "mean", value, out);
    tn_buffer deviation = {0};
    tn_amount_write_root(p->unit, variance, &deviation);
    if (deviation.data && tn_decimal_read(deviation.data, strlen(deviation.data), value))
        put_about(p, "standard deviation", value, out);
    fputc('\n', out);
    free(deviation.data);
    mpq_clears(value, variance, NULL);
}

static double share(const mpz_t plans, const mpz_t all)
{
    mpq_t part;
    mpq_init(part);
    mpq_set_num(part, plans);
    mpq_set_den(part, all);
    mpq_canonicalize(part);
    double percent = 100 * mpq_get_d(part);
    mpq_clear(part);
    return percent;
}

static void put_bound(const paper *p, const mpq_t value, tn_buffer *text)
{
    tn_amount_unit plain = {p->unit.feet, 0};
    tn_amount_write(plain, value, text);
}

static void write_rows(const paper *p, FILE *out)
{
    mpz_t running;
    row r;
    mpz_init(running);
    row_init(p, &r);
    tn_buffer heading = {0};
    if (p->binned) {
        put_bound(p, p->step, &heading);
        const char *unit = tn_amount_unit_name(p->unit);
        fprintf(out, "%zu values, in bins of %s%s%s\n", p->d->count, heading.data ? heading.data : "", *unit ? " " : "",
                unit);
    }
    free(heading.data);
    fprintf(out, "%24s  %24s  %7s  %7s\n", p->binned ? "from, to below" : "value", "plans", "share", "so far");
    while (row_next(p, &r)) {
        tn_buffer text = {0};
        put_bound(p, r.from, &text);
        if (p->binned) {
            tn_buffer_printf(&text, " .. ");
            put_bound(p, r.to, &text);
        }
        char *plans = tn_digits(r.plans, true);
        mpz_add(running, running, r.plans);
        fprintf(out, "%24s  %24s  %6.2f%%  %6.2f%%\n", text.data ? text.data : "", plans ? plans : "",
                share(r.plans, p->d->all), share(running, p->d->all));
        free(plans);
        free(text.data);
    }
    row_clear(&r);
    mpz_clear(running);
}

static void write_text(const paper *p, FILE *out)
{
    const tn_module *module = p->ready->schema->module;
    const char *doc = tn_text(module, p->measure->doc), *unit = tn_amount_unit_name(p->unit);
    char *all = tn_digits(p->d->all, true);
    fprintf(out, "%s%s%s%s%s%s of %s plans of %s\n\n", tn_text(module, p->measure->name), *doc ? " " : "", doc,
            *unit ? " (" : "", unit, *unit ? ")" : "", all ? all : "", tn_text(module, p->ready->record->name));
    free(all);
    if (p->d->count == 0)
        return;
    write_statistics(p, out);
    write_rows(p, out);
}

void tn_count_by(tn_job *job, const tn_ready_library *ready, const char *measure, const tn_count_by_options *options,
                 const char *path)
{
    const tn_module *module = job->opened.module;
    uint32_t index;
    tn_weighed *weighed = NULL;
    tn_distribution d;
    tn_error error;
    tn_output output;
    tn_status status = tn_measure_choose(&job->opened, measure, ready->record->schema, &index);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    tn_distribution_init(&d);
    status = tn_weighed_new(ready->library, &index, 1, &weighed, &error);
    if (status == TN_OK)
        status = tn_distribution_make(&d, weighed, &error);
    paper p = {.ready = ready, .measure = &module->MEASURE_records[index], .d = &d};
    p.unit = tn_amount_unit_of(ready->schema, module->SUM_records[p.measure->sum].power);
    mpq_init(p.step);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (choose_bins(job, options, &p)) {
        tn_job_show(job);
        if (tn_job_output(job, path, &output)) {
            (options->json ? write_json : write_text)(&p, output.stream);
            tn_job_commit(job, &output);
        }
    }
    mpq_clear(p.step);
    tn_distribution_clear(&d);
    tn_weighed_free(weighed);
}
