/* How wrong values are that were computed for wanted ones. All measures are costs: 0 is the best. */
#ifndef TARTAN_GENOME_BREEDING_FIT_ERROR_H
#define TARTAN_GENOME_BREEDING_FIT_ERROR_H

#include "runtime/base/error.h"

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
    double *classes; /* owned: the different values, the smallest first; NULL where the measure has none */
    size_t class_count;
    double variance; /* their sum of squares about their mean */
} tn_fit_wanted;

#define TN_FIT_CLASSES_MAX 100u

bool tn_fit_has_classes(tn_fit_error error);

/* like: of the data that the classes are taken from, or NULL: from `values`. E1243 where there are not two classes or
 * more, of which log loss takes two. */
tn_status tn_fit_wanted_of(tn_fit_error error, const double *values, size_t count, const tn_fit_wanted *like,
                           tn_fit_wanted *wanted, tn_error *error_out);
void tn_fit_wanted_clear(tn_fit_wanted *wanted);

/* The measure of computed values; not a number where one of them is none. `scratch`: room for as many. */
double tn_fit_cost(const tn_fit_wanted *wanted, const double *values, double *scratch);

/* The error of each value by itself, for selections that look at cases: without its sign, or 0 and 1 for classes. */
void tn_fit_cases(const tn_fit_wanted *wanted, const double *values, double *errors);

/* The line a + b v through values v that comes nearest to what is wanted (least squares). Where the values do not
 * vary, b is 0 and a the mean. */
void tn_fit_line(const tn_fit_wanted *wanted, const double *values, double *scratch, double line[2]);

#endif
