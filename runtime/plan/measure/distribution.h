/* How the plans of a library are spread over the values of a measure, exactly. */
#ifndef TARTAN_PLAN_MEASURE_DISTRIBUTION_H
#define TARTAN_PLAN_MEASURE_DISTRIBUTION_H

#include "runtime/plan/measure/weighed.h"

/* Words that are held at a time, of 8 bytes: for each pair of state and value the value, and its number of plans, which
 * in long plans has many words. */
#define TN_DISTRIBUTION_WORDS UINT64_C(64000000)

typedef struct tn_distribution {
    size_t count;   /* values, ascending */
    int64_t *value; /* steps of the unit; NULL: of a quotient */
    mpq_t *exact;   /* of a quotient; NULL: of a sum */
    mpz_t *plans;   /* [room], of which `count` are used */
    size_t room;
    mpz_t all;     /* plans in all that have a value */
    mpz_t without; /* plans that have none */
    mpq_t unit;    /* nanometres to the power */
} tn_distribution;

void tn_distribution_init(tn_distribution *distribution);
void tn_distribution_clear(tn_distribution *distribution);

/* Of the first measure; `distribution` is initialised. E0832 past TN_DISTRIBUTION_WORDS. */
tn_status tn_distribution_make(tn_distribution *distribution, tn_weighed *weighed, tn_error *error);

/* Value i in nanometres to the power; `value` is initialised. */
void tn_distribution_value(const tn_distribution *distribution, size_t i, mpq_t value);

/* Mean and variance of all plans; of a library with plans. Initialised. */
void tn_distribution_moments(const tn_distribution *distribution, mpq_t mean, mpq_t variance);

/* The index of the smallest value that at least quarter/4 of the plans do not pass. */
size_t tn_distribution_quartile(const tn_distribution *distribution, unsigned quarter);

#endif
