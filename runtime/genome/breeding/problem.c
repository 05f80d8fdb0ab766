/* Scores sentences: matching a text, and fitting data. */
#include "runtime/genome/breeding/problem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/number/data.h"
#include "runtime/number/formula.h"
#include "runtime/number/run.h"
#include "runtime/number/shared.h"

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
        tn_fit_cases(&p->given.wanted, place->values, errors);
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
