/* Scores sentences: matching a text, and fitting data. */
#include "runtime/genome/breeding/problem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/math/elementary.h"
#include "runtime/number/data.h"
#include "runtime/number/formula.h"
#include "runtime/number/run.h"
#include "runtime/number/shared.h"

/* ==== measures of errors, of numbers and of classes */

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

static bool fit_has_classes(tn_fit_error error)
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
    if (!fit_has_classes(error))
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

/* -log(1 / (1 + exp(-z))), where z is on the right side of 0 if it is positive. */
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
    if (fit_has_classes(w->error) && !has_values(values, w->count))
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

/* The error of each value by itself, for selections that look at cases: without its sign, or 0 and 1 for classes. */
static void fill_cases(const tn_fit_wanted *w, const double *values, double *errors)
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

#define BATCH_MAX 32u                  /* sentences evaluated together, which share what they have in common */
#define BATCH_VALUES ((size_t)4 << 20) /* numbers that their values may be, where that is less */

/* What a thread evaluates sentences with. */
typedef struct workplace {
    tn_formula formula;
    tn_number_rows rows;
    tn_shared shared;
    double *values;  /* [sentence of a batch][point] */
    double *scratch; /* [point] */
} workplace;

/* Columns of data, readable up to a whole row; the last is wanted. */
typedef struct data {
    double **columns;
    size_t points;
    tn_fit_wanted wanted;
} data;

struct tn_problem {
    char *target;
    size_t target_size;
    char **names;
    size_t variables;
    data given, held; /* held: for testing only; without points where there is none */
    tn_fit_options options;
    size_t batch;
    workplace *places; /* by thread */
    bool unnamed;      /* its columns have names of ours */
};

static void data_clear(data *d, size_t variables)
{
    for (size_t i = 0; d->columns && i <= variables; i++)
        free(d->columns[i]);
    free(d->columns);
    tn_fit_wanted_clear(&d->wanted);
}

void tn_problem_free(tn_problem *p)
{
    if (!p)
        return;
    for (size_t i = 0; p->names && i < p->variables; i++)
        free(p->names[i]);
    for (unsigned t = 0; p->places && t < p->options.threads; t++) {
        tn_formula_clear(&p->places[t].formula);
        tn_number_rows_clear(&p->places[t].rows);
        tn_shared_clear(&p->places[t].shared);
        free(p->places[t].values);
        free(p->places[t].scratch);
    }
    data_clear(&p->given, p->variables);
    data_clear(&p->held, p->variables);
    free(p->target);
    free(p->names);
    free(p->places);
    free(p);
}

/* ---- matching a string */

tn_status tn_problem_match(const char *target, tn_problem **problem, tn_error *error)
{
    *problem = calloc(1, sizeof **problem);
    if (!*problem || !((*problem)->target = strdup(target))) {
        tn_problem_free(*problem);
        *problem = NULL;
        return tn_fail_memory(error);
    }
    (*problem)->target_size = strlen(target);
    return TN_OK;
}

static tn_status match(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                       char message[200], tn_error *error)
{
    const tn_problem *p = context;
    (void)thread;
    (void)message;
    (void)error;
    size_t longer = size > p->target_size ? size : p->target_size,
           shorter = size < p->target_size ? size : p->target_size;
    double distance = (double)longer;
    for (size_t i = 0; i < shorter; i++) {
        int difference = (unsigned char)sentence[i] - (unsigned char)p->target[i];
        distance -= 1.0 / (1 + abs(difference));
    }
    score->objectives[0] = distance;
    return TN_OK;
}

/* ---- fitting data */

static tn_status data_of(const double *const *columns, size_t variables, size_t points, tn_fit_error measure,
                         const tn_fit_wanted *like, data *d, tn_error *error)
{
    d->points = points;
    d->columns = calloc(variables + 1, sizeof *d->columns);
    bool well = d->columns != NULL;
    for (size_t i = 0; well && i <= variables; i++) {
        well = (d->columns[i] = calloc(points + TN_ROW, sizeof **d->columns)) != NULL;
        if (well)
            memcpy(d->columns[i], columns[i], points * sizeof **columns);
    }
    return well ? tn_fit_wanted_of(measure, d->columns[variables], points, like, &d->wanted, error)
                : tn_fail_memory(error);
}

static tn_status make_places(tn_problem *p, tn_error *error)
{
    size_t points = p->given.points > p->held.points ? p->given.points : p->held.points;
    size_t fits = BATCH_VALUES / points;
    p->batch = fits > BATCH_MAX ? BATCH_MAX : fits ? fits : 1;
    p->places = calloc(p->options.threads, sizeof *p->places);
    bool well = p->places != NULL;
    for (unsigned t = 0; well && t < p->options.threads; t++) {
        p->places[t].values = calloc(p->batch * points + 1, sizeof(double));
        p->places[t].scratch = calloc(points + 1, sizeof(double));
        well = p->places[t].values && p->places[t].scratch;
    }
    return well ? TN_OK : tn_fail_memory(error);
}

static tn_status given(tn_problem *p, tn_status status, tn_problem **problem)
{
    *problem = status == TN_OK ? p : NULL;
    if (status != TN_OK)
        tn_problem_free(p);
    return status;
}

tn_status tn_problem_fit(const char *const *names, const double *const *columns, size_t variables, size_t points,
                         const tn_fit_options *options, tn_problem **problem, tn_error *error)
{
    tn_problem *p = calloc(1, sizeof *p);
    *problem = NULL;
    if (!p)
        return tn_fail_memory(error);
    p->variables = variables;
    p->options = *options;
    p->names = calloc(variables + 1, sizeof *p->names);
    tn_status status = p->names ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < variables; i++)
        if (!(p->names[i] = strdup(names[i])))
            status = tn_fail_memory(error);
    if (status == TN_OK)
        status = data_of(columns, variables, points, options->error, NULL, &p->given, error);
    if (status == TN_OK)
        status = make_places(p, error);
    return given(p, status, problem);
}

tn_status tn_problem_fit_csv(const char *text, size_t size, const tn_fit_options *options, tn_problem **problem,
                             tn_error *error)
{
    tn_data *table = calloc(1, sizeof *table);
    *problem = NULL;
    if (!table)
        return tn_fail_memory(error);
    tn_status status = tn_data_read(text, size, table, error);
    if (status == TN_OK)
        status = tn_problem_fit((const char *const *)table->names, (const double *const *)table->columns,
                                table->width - 1, table->points, options, problem, error);
    if (status == TN_OK)
        (*problem)->unnamed = table->unnamed;
    tn_data_clear(table);
    free(table);
    return status;
}

/* The test's columns are those of the data, by their names. */
static tn_status match_columns(const tn_problem *p, const tn_data *table, tn_error *error)
{
    bool same = table->width == p->variables + 1;
    for (size_t i = 0; same && i < p->variables; i++)
        same = strcmp(table->names[i], p->names[i]) == 0;
    if (same)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_DATA, "the columns are not those of the data to fit: there are %zu, and %zu there",
            table->width, p->variables + 1);
    tn_error_help(error, "both files name the same columns in the same order");
    return TN_INVALID;
}

tn_status tn_problem_hold_csv(tn_problem *p, const char *text, size_t size, tn_error *error)
{
    tn_data *table = calloc(1, sizeof *table);
    if (!table)
        return tn_fail_memory(error);
    tn_status status = tn_data_read(text, size, table, error);
    if (status == TN_OK)
        status = match_columns(p, table, error);
    if (status == TN_OK)
        status = data_of((const double *const *)table->columns, p->variables, table->points, p->options.error,
                         &p->given.wanted, &p->held, error);
    for (unsigned t = 0; status == TN_OK && t < p->options.threads; t++) {
        workplace *place = &p->places[t];
        size_t points = p->given.points > p->held.points ? p->given.points : p->held.points;
        free(place->values);
        free(place->scratch);
        place->values = calloc(p->batch * points + 1, sizeof(double));
        place->scratch = calloc(points + 1, sizeof(double));
        if (!place->values || !place->scratch)
            status = tn_fail_memory(error);
    }
    tn_data_clear(table);
    free(table);
    return status;
}

bool tn_problem_unnamed(const tn_problem *p)
{
    return p->unnamed;
}

bool tn_problem_holds(const tn_problem *p)
{
    return p->held.points > 0;
}

/* ---- scores */

static void scale(double *values, size_t count, const double line[2])
{
    for (size_t i = 0; i < count; i++)
        values[i] = line[0] + line[1] * values[i];
}

/* Scales values computed for the given data, where that is wished. */
static void scale_given(const tn_problem *p, workplace *place, double *values, double line[2])
{
    line[0] = 0;
    line[1] = 1;
    if (!p->options.scaled)
        return;
    tn_fit_line(&p->given.wanted, values, place->scratch, line);
    scale(values, p->given.points, line);
}

static void give_score(const tn_problem *p, workplace *place, double *values, tn_score *score, char message[200])
{
    double line[2];
    scale_given(p, place, values, line);
    double cost = tn_fit_cost(&p->given.wanted, values, place->scratch);
    score->objectives[0] = cost;
    if (cost == cost)
        return;
    score->state = TN_SCORE_FAILED;
    snprintf(message, 200, "its value is not a number for some of the data");
}

/* Reads a sentence into the workplace's formula; one that cannot be read has its score by that. */
static tn_status read_sentence(const tn_problem *p, workplace *place, const char *sentence, size_t size,
                               tn_score *score, char message[200], bool *read, tn_error *error)
{
    tn_error wrong = {0};
    tn_status status =
        tn_sentence_read(sentence, size, (const char *const *)p->names, p->variables, &place->formula, &wrong);
    *read = status == TN_OK;
    return *read ? TN_OK : tn_score_refuse(status, &wrong, score, message, error);
}

static tn_status run_alone(workplace *place, const data *d, tn_error *error)
{
    return tn_number_run_rows(&place->rows, place->formula.code, 0, place->formula.depth,
                              (const double *const *)d->columns, d->points, place->values, error);
}

static tn_status fit(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                     char message[200], tn_error *error)
{
    tn_problem *p = context;
    workplace *place = &p->places[thread];
    bool read;
    tn_status status = read_sentence(p, place, sentence, size, score, message, &read, error);
    if (status != TN_OK || !read)
        return status;
    status = run_alone(place, &p->given, error);
    if (status == TN_OK)
        give_score(p, place, place->values, score, message);
    return status;
}

static tn_status fit_many(void *context, unsigned thread, tn_individual *const *individuals, size_t count,
                          tn_error *error)
{
    tn_problem *p = context;
    workplace *place = &p->places[thread];
    tn_individual *read[BATCH_MAX];
    size_t formulas = 0;
    tn_status status = TN_OK;
    tn_shared_begin(&place->shared);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        tn_individual *one = individuals[i];
        bool well;
        status = read_sentence(p, place, one->sentence, one->sentence_size, &one->score, one->message, &well, error);
        if (status == TN_OK && well) {
            status = tn_shared_add(&place->shared, place->formula.code, error);
            read[formulas++] = one;
        }
    }
    if (status == TN_OK)
        status = tn_shared_run(&place->shared, (const double *const *)p->given.columns, p->given.points, place->values,
                               error);
    for (size_t i = 0; i < formulas && status == TN_OK; i++)
        give_score(p, place, place->values + i * p->given.points, &read[i]->score, read[i]->message);
    return status;
}

static tn_status fit_cases(void *context, unsigned thread, const char *sentence, size_t size, double *errors,
                           tn_error *error)
{
    tn_problem *p = context;
    workplace *place = &p->places[thread];
    tn_score score = {0};
    char message[200];
    double line[2];
    bool read;
    tn_status status = read_sentence(p, place, sentence, size, &score, message, &read, error);
    if (status == TN_OK && read)
        status = run_alone(place, &p->given, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < p->given.points && !read; i++)
        errors[i] = HUGE_VAL;
    if (read) {
        scale_given(p, place, place->values, line);
        fill_cases(&p->given.wanted, place->values, errors);
    }
    return TN_OK;
}

tn_status tn_problem_examine(tn_problem *p, const char *sentence, size_t size, tn_fit_report *report, tn_error *error)
{
    workplace *place = &p->places[0];
    tn_score score = {0};
    char message[200];
    bool read;
    *report = (tn_fit_report){.test = NAN};
    tn_status status = read_sentence(p, place, sentence, size, &score, message, &read, error);
    if (status == TN_OK && read)
        status = run_alone(place, &p->given, error);
    if (status != TN_OK || !read)
        return status;
    scale_given(p, place, place->values, report->line);
    if (p->held.points == 0)
        return TN_OK;
    status = run_alone(place, &p->held, error);
    if (status != TN_OK)
        return status;
    if (p->options.scaled)
        scale(place->values, p->held.points, report->line);
    report->test = tn_fit_cost(&p->held.wanted, place->values, place->scratch);
    return TN_OK;
}

const char *const *tn_problem_columns(const tn_problem *p, size_t *count)
{
    *count = p->variables;
    return (const char *const *)p->names;
}

tn_status tn_problem_names_column(tn_problem *p, const char *sentence, size_t size, bool *names, tn_error *error)
{
    tn_score score = {0};
    char message[200];
    bool read;
    tn_status status = read_sentence(p, &p->places[0], sentence, size, &score, message, &read, error);
    *names = status == TN_OK && read && tn_formula_has_terms(&p->places[0].formula);
    return status;
}

tn_evaluator tn_problem_evaluator(tn_problem *problem)
{
    if (problem->target)
        return (tn_evaluator){.context = problem, .objectives = 1, .evaluate = match};
    return (tn_evaluator){.context = problem,
                          .objectives = 1,
                          .evaluate = fit,
                          .evaluate_many = fit_many,
                          .batch = problem->batch,
                          .cases = problem->given.points,
                          .evaluate_cases = fit_cases};
}
