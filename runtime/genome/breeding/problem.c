/* Scores sentences: matching a text, and fitting data. */
#include "runtime/genome/breeding/problem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/number/run.h"
#include "runtime/number/sentence.h"

/* What a thread evaluates a sentence with. */
typedef struct workplace {
    tn_formula formula;
    tn_number_rows rows;
    double *values;
} workplace;

struct tn_problem {
    char *target;
    size_t target_size;
    char **names;
    double **columns; /* the last is the value wanted */
    size_t variables, points;
    workplace *places; /* by thread */
    unsigned threads;
};

void tn_problem_free(tn_problem *p)
{
    if (!p)
        return;
    for (size_t i = 0; p->names && i < p->variables; i++)
        free(p->names[i]);
    for (size_t i = 0; p->columns && i <= p->variables; i++)
        free(p->columns[i]);
    for (unsigned t = 0; p->places && t < p->threads; t++) {
        tn_formula_clear(&p->places[t].formula);
        tn_number_rows_clear(&p->places[t].rows);
        free(p->places[t].values);
    }
    free(p->target);
    free(p->names);
    free(p->columns);
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

static tn_status fit_new(size_t variables, size_t points, unsigned threads, tn_problem **problem, tn_error *error)
{
    tn_problem *p = calloc(1, sizeof *p);
    *problem = p;
    if (!p)
        return tn_fail_memory(error);
    p->variables = variables;
    p->points = points;
    p->threads = threads;
    p->names = calloc(variables + 1, sizeof *p->names);
    p->columns = calloc(variables + 1, sizeof *p->columns);
    p->places = calloc(threads, sizeof *p->places);
    bool well = p->names && p->columns && p->places;
    for (size_t i = 0; well && i <= variables; i++)
        well = (p->columns[i] = calloc(points + TN_ROW, sizeof **p->columns)) != NULL;
    for (unsigned t = 0; well && t < threads; t++)
        well = (p->places[t].values = calloc(points + 1, sizeof *p->places[t].values)) != NULL;
    if (well)
        return TN_OK;
    tn_problem_free(p);
    *problem = NULL;
    return tn_fail_memory(error);
}

tn_status tn_problem_fit(const char *const *names, const double *const *columns, size_t variables, size_t points,
                         unsigned threads, tn_problem **problem, tn_error *error)
{
    tn_status status = fit_new(variables, points, threads, problem, error);
    for (size_t i = 0; status == TN_OK && i <= variables; i++) {
        memcpy((*problem)->columns[i], columns[i], points * sizeof **columns);
        if (i < variables && !((*problem)->names[i] = strdup(names[i])))
            status = tn_fail_memory(error);
    }
    if (status != TN_OK) {
        tn_problem_free(*problem);
        *problem = NULL;
    }
    return status;
}

/* The sum is made of eight, each of every eighth point: the same shape whatever the machine. */
static double mean_squared_error(const double *values, const double *wanted, size_t points)
{
    double sums[8] = {0};
    size_t whole = points - points % 8;
    for (size_t i = 0; i < whole; i += 8)
        for (size_t k = 0; k < 8; k++) {
            double difference = values[i + k] - wanted[i + k];
            sums[k] += difference * difference;
        }
    for (size_t i = whole; i < points; i++) {
        double difference = values[i] - wanted[i];
        sums[i - whole] += difference * difference;
    }
    for (size_t step = 4; step; step /= 2)
        for (size_t k = 0; k < step; k++)
            sums[k] += sums[k + step];
    return sums[0] / (double)points;
}

static tn_status fit(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                     char message[200], tn_error *error)
{
    tn_problem *p = context;
    workplace *place = &p->places[thread];
    tn_formula *formula = &place->formula;
    tn_error wrong = {0};
    tn_status status = tn_sentence_read(sentence, size, (const char *const *)p->names, p->variables, formula, &wrong);
    if (status != TN_OK)
        return tn_score_refuse(status, &wrong, score, message, error);
    status = tn_number_run_rows(&place->rows, formula->code, 0, formula->depth, (const double *const *)p->columns,
                                p->points, place->values, error);
    if (status == TN_OK)
        score->objectives[0] = sqrt(mean_squared_error(place->values, p->columns[p->variables], p->points));
    return status;
}

tn_evaluator tn_problem_evaluator(tn_problem *problem)
{
    return (tn_evaluator){.context = problem, .objectives = 1, .evaluate = problem->target ? match : fit};
}
