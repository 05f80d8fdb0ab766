/* Known problems that need nothing but numbers: matching a string, fitting data. Each gives a tn_evaluator. */
#ifndef TARTAN_GENOME_BREEDING_PROBLEM_H
#define TARTAN_GENOME_BREEDING_PROBLEM_H

#include "runtime/base/error.h"
#include "runtime/genome/breeding/evolve.h"

/* How wrong values are that were computed for wanted ones. All measures are costs: 0 is the best. */

/* In the order of the words of `error` in settings.def. */
typedef enum tn_fit_error {
    TN_FIT_RMSE,     /* the root of the mean squared error */
    TN_FIT_MSE,      /* the mean squared error */
    TN_FIT_MAE,      /* the mean of the errors without their signs */
    TN_FIT_R2,       /* 1 less the coefficient of determination */
    TN_FIT_LOG_LOSS, /* of two classes: the mean of -log(probability of the right one); a value v means 1/(1+exp(-v)) */
    TN_FIT_ACCURACY, /* the share of wrong classes */
    TN_FIT_F1,       /* 1 less the F1 score: of two classes that of the larger, of more the mean of all */
    TN_FIT_ERROR_COUNT
} tn_fit_error;

/* The wanted values of a measure, and what it needs to know of them. Clear it in any case. */
typedef struct tn_fit_wanted {
    tn_fit_error error;
    const double *values; /* borrowed */
    size_t count;
    double *classes; /* owned: the different values, the smallest first; NULL if the measure has none */
    size_t class_count;
    double variance; /* their sum of squares about their mean */
} tn_fit_wanted;

#define TN_FIT_CLASSES_MAX 100u

/* like: of the data that the classes are taken from, or NULL: from `values`. E1243 if there are not two classes or
 * more, of which log loss takes two. */
tn_status tn_fit_wanted_of(tn_fit_error error, const double *values, size_t count, const tn_fit_wanted *like,
                           tn_fit_wanted *wanted, tn_error *error_out);
void tn_fit_wanted_clear(tn_fit_wanted *wanted);

/* The measure of computed values; not a number where one of them is none. `scratch`: room for as many. */
double tn_fit_cost(const tn_fit_wanted *wanted, const double *values, double *scratch);

/* The line a + b v through values v that comes nearest to what is wanted (least squares). Where the values do not
 * vary, b is 0 and a the mean. */
void tn_fit_line(const tn_fit_wanted *wanted, const double *values, double *scratch, double line[2]);

typedef struct tn_problem tn_problem;

/* How far a sentence is from the target: for each place of the longer one 1, less 1 where the bytes are equal, less
 * 1 / (1 + their difference) where they are not (PonyGE2's string_match). */
tn_status tn_problem_match(const char *target, tn_problem **problem, tn_error *error);

typedef struct tn_fit_options {
    tn_fit_error error;
    bool scaled; /* a sentence's values are first put through the line that brings them nearest to what is wanted */
    unsigned threads;
} tn_fit_options;

/* The error of a sentence, read as arithmetic (runtime/number/formula.h) in the variables named, at points
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
