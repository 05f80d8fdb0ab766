/* Measures of errors, of numbers and of classes. */
#include "runtime/genome/breeding/fit_error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/numeric/numeric.h"

/* The sum is made of eight, each of every eighth term: the same shape whatever the machine. */
static double sum_of(const double *terms, size_t count)
{
    double sums[8] = {0};
    size_t whole = count - count % 8;
    for (size_t i = 0; i < whole; i += 8)
        for (size_t k = 0; k < 8; k++)
            sums[k] += terms[i + k];
    for (size_t i = whole; i < count; i++)
        sums[i - whole] += terms[i];
    for (size_t step = 4; step; step /= 2)
        for (size_t k = 0; k < step; k++)
            sums[k] += sums[k + step];
    return sums[0];
}

/* ---- what is wanted */

bool tn_fit_has_classes(tn_fit_error error)
{
    return error == TN_FIT_LOG_LOSS || error == TN_FIT_ACCURACY || error == TN_FIT_F1;
}

void tn_fit_wanted_clear(tn_fit_wanted *wanted)
{
    free(wanted->classes);
    *wanted = (tn_fit_wanted){0};
}

static int compare_numbers(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

static tn_status find_classes(tn_fit_wanted *w, tn_error *error)
{
    double *sorted = malloc((w->count + 1) * sizeof *sorted);
    if (!sorted)
        return tn_fail_memory(error);
    memcpy(sorted, w->values, w->count * sizeof *sorted);
    qsort(sorted, w->count, sizeof *sorted, compare_numbers);
    for (size_t i = 0; i < w->count; i++)
        if (i == 0 || sorted[i] != sorted[i - 1])
            sorted[w->class_count++] = sorted[i];
    w->classes = sorted;
    bool two = w->error == TN_FIT_LOG_LOSS;
    if (w->class_count >= 2 && w->class_count <= (two ? 2 : TN_FIT_CLASSES_MAX))
        return TN_OK;
    tn_fail(error, TN_INVALID, E_DATA, "the last column has %zu different value%s, and this error is about %s classes",
            w->class_count, w->class_count == 1 ? "" : "s", two ? "two" : "2 to 100");
    tn_error_help(error, two ? "write `error accuracy` for more classes" : "write `error rmse` to fit numbers");
    return TN_INVALID;
}

tn_status tn_fit_wanted_of(tn_fit_error error, const double *values, size_t count, const tn_fit_wanted *like,
                           tn_fit_wanted *w, tn_error *error_out)
{
    double mean = sum_of(values, count) / (double)count;
    *w = (tn_fit_wanted){.error = error, .values = values, .count = count};
    for (size_t i = 0; i < count; i++)
        w->variance += (values[i] - mean) * (values[i] - mean);
    if (!tn_fit_has_classes(error))
        return TN_OK;
    if (!like)
        return find_classes(w, error_out);
    w->class_count = like->class_count;
    w->classes = malloc((w->class_count + 1) * sizeof *w->classes);
    if (!w->classes)
        return tn_fail_memory(error_out);
    memcpy(w->classes, like->classes, w->class_count * sizeof *w->classes);
    return TN_OK;
}

/* ---- classes */

/* Where there are the classes 0 and 1, a value above 0 means 1; otherwise it means the nearest class. */
static size_t class_of(const tn_fit_wanted *w, double value)
{
    if (w->class_count == 2 && w->classes[0] == 0 && w->classes[1] == 1)
        return value > 0;
    size_t nearest = 0;
    for (size_t i = 1; i < w->class_count; i++)
        if (fabs(value - w->classes[i]) < fabs(value - w->classes[nearest]))
            nearest = i;
    return nearest;
}

static bool is_right(const tn_fit_wanted *w, const double *values, size_t i)
{
    return w->classes[class_of(w, values[i])] == w->values[i];
}

static double error_share(const tn_fit_wanted *w, const double *values)
{
    size_t wrong = 0;
    for (size_t i = 0; i < w->count; i++)
        wrong += !is_right(w, values, i);
    return (double)wrong / (double)w->count;
}

/* Of one class: twice those that are found, through all that are of it or taken for it. */
static double f1_of(const tn_fit_wanted *w, const double *values, size_t class)
{
    size_t found = 0, of_it = 0, taken = 0;
    for (size_t i = 0; i < w->count; i++) {
        bool is = w->values[i] == w->classes[class], said = class_of(w, values[i]) == class;
        found += is && said;
        of_it += is;
        taken += said;
    }
    return of_it + taken ? 2 * (double)found / (double)(of_it + taken) : 0;
}

static double f1(const tn_fit_wanted *w, const double *values)
{
    double sum = 0;
    if (w->class_count == 2)
        return f1_of(w, values, 1);
    for (size_t class = 0; class < w->class_count; class ++)
        sum += f1_of(w, values, class);
    return sum / (double)w->class_count;
}

/* -log(1 / (1 + exp(-z))), where z is on the right side of 0 where it is positive. */
static double loss(const tn_fit_wanted *w, const double *values, size_t i)
{
    double z = w->values[i] == w->classes[1] ? values[i] : -values[i];
    return z > 0 ? tn_log(1 + tn_exp(-z)) : tn_log(1 + tn_exp(z)) - z;
}

/* ---- costs */

static bool has_values(const double *values, size_t count)
{
    bool none = false;
    for (size_t i = 0; i < count; i++)
        none |= values[i] != values[i];
    return !none;
}

/* Not a number where a value is none. */
static double sum_of_squares(const double *values, const double *wanted, size_t count)
{
    double sums[8] = {0};
    size_t whole = count - count % 8;
    for (size_t i = 0; i < whole; i += 8)
        for (size_t k = 0; k < 8; k++) {
            double difference = values[i + k] - wanted[i + k];
            sums[k] += difference * difference;
        }
    for (size_t i = whole; i < count; i++) {
        double difference = values[i] - wanted[i];
        sums[i - whole] += difference * difference;
    }
    for (size_t step = 4; step; step /= 2)
        for (size_t k = 0; k < step; k++)
            sums[k] += sums[k + step];
    return sums[0];
}

static double mean_of_cases(const tn_fit_wanted *w, const double *values, double *scratch)
{
    for (size_t i = 0; i < w->count; i++)
        scratch[i] = w->error == TN_FIT_MAE ? fabs(values[i] - w->values[i]) : loss(w, values, i);
    return sum_of(scratch, w->count) / (double)w->count;
}

double tn_fit_cost(const tn_fit_wanted *w, const double *values, double *scratch)
{
    if (tn_fit_has_classes(w->error) && !has_values(values, w->count))
        return NAN;
    switch (w->error) {
    case TN_FIT_ACCURACY:
        return error_share(w, values);
    case TN_FIT_F1:
        return 1 - f1(w, values);
    case TN_FIT_MAE:
    case TN_FIT_LOG_LOSS:
        return mean_of_cases(w, values, scratch);
    default:
        break;
    }
    double sum = sum_of_squares(values, w->values, w->count);
    if (w->error == TN_FIT_R2)
        return w->variance > 0 || sum != sum ? sum / w->variance : sum > 0 ? HUGE_VAL : 0;
    double mean = sum / (double)w->count;
    return w->error == TN_FIT_RMSE ? sqrt(mean) : mean;
}

void tn_fit_cases(const tn_fit_wanted *w, const double *values, double *errors)
{
    for (size_t i = 0; i < w->count; i++) {
        bool classes = w->error == TN_FIT_ACCURACY || w->error == TN_FIT_F1;
        double difference = w->error == TN_FIT_LOG_LOSS ? loss(w, values, i)
                            : classes                   ? !is_right(w, values, i)
                                                        : fabs(values[i] - w->values[i]);
        errors[i] = difference == difference ? difference : HUGE_VAL;
    }
}

void tn_fit_line(const tn_fit_wanted *w, const double *values, double *scratch, double line[2])
{
    double mean = sum_of(values, w->count) / (double)w->count, wanted = sum_of(w->values, w->count) / (double)w->count;
    for (size_t i = 0; i < w->count; i++)
        scratch[i] = (values[i] - mean) * (values[i] - mean);
    double variance = sum_of(scratch, w->count);
    for (size_t i = 0; i < w->count; i++)
        scratch[i] = (values[i] - mean) * (w->values[i] - wanted);
    double slope = sum_of(scratch, w->count) / variance;
    line[1] = variance > 0 && isfinite(slope) ? slope : 0;
    line[0] = line[1] == 0 ? wanted : wanted - line[1] * mean;
}
