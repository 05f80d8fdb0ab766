/* Known problems that need nothing but numbers: matching a string, fitting data. Each gives a tn_evaluator. */
#ifndef TARTAN_GENOME_BREEDING_PROBLEM_H
#define TARTAN_GENOME_BREEDING_PROBLEM_H

#include "runtime/genome/breeding/evolve.h"
#include "runtime/genome/breeding/fit_error.h"

typedef struct tn_problem tn_problem;

/* How far a sentence is from the target: for each place of the longer one 1, less 1 where the bytes are equal, less
 * 1 / (1 + their difference) where they are not (PonyGE2's string_match). */
tn_status tn_problem_match(const char *target, tn_problem **problem, tn_error *error);

typedef struct tn_fit_options {
    tn_fit_error error;
    bool scaled; /* a sentence's values are first put through the line that brings them nearest to what is wanted */
    unsigned threads;
} tn_fit_options;

/* The error of a sentence, read as arithmetic (runtime/number/sentence.h) in the variables named, at points
 * columns[variable][point]; the last column is the value wanted. Copies the numbers. */
tn_status tn_problem_fit(const char *const *names, const double *const *columns, size_t variables, size_t points,
                         const tn_fit_options *options, tn_problem **problem, tn_error *error);

/* The same from a text of data (runtime/number/data.h); the last column is the value wanted. E1243 with the place. */
tn_status tn_problem_fit_csv(const char *text, size_t size, const tn_fit_options *options, tn_problem **problem,
                             tn_error *error);

/* Did the data have no line of names? */
bool tn_problem_unnamed(const tn_problem *problem);

/* Data of the same columns that nothing is scored by, for testing what was found. E1243. */
tn_status tn_problem_hold_csv(tn_problem *problem, const char *text, size_t size, tn_error *error);
bool tn_problem_holds(const tn_problem *problem);

/* The columns that sentences can name. */
const char *const *tn_problem_columns(const tn_problem *problem, size_t *count);

/* Does a sentence name any? While nothing is evaluated. */
tn_status tn_problem_names_column(tn_problem *problem, const char *sentence, size_t size, bool *names, tn_error *error);

/* What else there is to say about a sentence. */
typedef struct tn_fit_report {
    double test;    /* its error with the data held; not a number where there are none, or it has no value */
    double line[2]; /* with scaling: a and b of a + b * value */
} tn_fit_report;

/* While nothing is evaluated. */
tn_status tn_problem_examine(tn_problem *problem, const char *sentence, size_t size, tn_fit_report *report,
                             tn_error *error);

tn_evaluator tn_problem_evaluator(tn_problem *problem);
void tn_problem_free(tn_problem *problem);

#endif
