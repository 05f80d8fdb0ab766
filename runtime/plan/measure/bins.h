/* A distribution in rows: value by value, or in bins of one width. */
#ifndef TARTAN_PLAN_MEASURE_BINS_H
#define TARTAN_PLAN_MEASURE_BINS_H

#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/distribution.h"

#define TN_VALUES_LISTED 200u /* more values are shown in bins */
#define TN_BINS_DEFAULT 40u

typedef struct tn_bins {
    const tn_distribution *d; /* borrowed */
    tn_amount_unit unit;
    bool binned;
    mpq_t step; /* of bins, in the unit */
} tn_bins;

/* Value by value, until it is told otherwise. Clear it. */
void tn_bins_init(tn_bins *bins, const tn_distribution *d, tn_amount_unit unit);
void tn_bins_clear(tn_bins *bins);

/* Value i in the unit; `value` is initialised. */
void tn_bins_value(const tn_bins *bins, size_t i, mpq_t value);

/* The least step of 1, 2 or 5 times a power of ten of the unit that makes at most so many bins. */
void tn_bins_few(tn_bins *bins, uint64_t most);

/* Are there at most so many bins, with the step as it is? */
bool tn_bins_at_most(const tn_bins *bins, uint64_t most);

/* The rows one by one, empty bins too. */
typedef struct tn_bin_row {
    mpq_t from, to; /* in the unit; of a value both are it */
    mpz_t plans;
    size_t next; /* value not yet taken */
    mpz_t bin;
} tn_bin_row;

void tn_bin_row_init(const tn_bins *bins, tn_bin_row *row);
bool tn_bin_row_next(const tn_bins *bins, tn_bin_row *row); /* false past the last */
void tn_bin_row_clear(tn_bin_row *row);

/* part / all as a double; 0 of nothing. */
double tn_bins_share(const mpz_t part, const mpz_t all);

#endif
