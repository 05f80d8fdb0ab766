/* The joint distribution of a library by any number of measures: which values its plans have together, exactly. */
#ifndef TARTAN_PLAN_MEASURE_CROSSTAB_H
#define TARTAN_PLAN_MEASURE_CROSSTAB_H

#include "runtime/plan/measure/bundle.h"

#define TN_CROSSTAB_VALUES_MAX 200000u /* pairs of a state and values, of the plans of one length */

typedef struct tn_crosstab_row {
    mpq_t *values; /* [measures]: in nanometres to the measure's power; 0 without a value */
    bool *valued;  /* [measures] */
    mpz_t plans;   /* how many plans have these */
    uint32_t measures;
} tn_crosstab_row;

typedef struct tn_crosstab {
    uint32_t measures;
    tn_crosstab_row *rows; /* ascending by the first measure, then by the next; those without a value last */
    size_t count;
    mpq_t *values; /* [numbers]: of all rows */
    bool *valued;  /* [numbers] */
    size_t numbers;
} tn_crosstab;

/* most: of what is held at a time; 0: TN_CROSSTAB_VALUES_MAX; E0832 past it. Otherwise as tn_bundle_new. Clear in any
 * case. */
tn_status tn_crosstab_make(tn_crosstab *table, const tn_library *library, const tn_bundle_measure *measures,
                           uint32_t count, size_t most, tn_error *error);
void tn_crosstab_clear(tn_crosstab *table);

#endif
