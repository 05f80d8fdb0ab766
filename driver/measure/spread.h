/* How the plans of a library are spread over a measure: the distribution, what is said of it in words, and its
 * picture. */
#ifndef TARTAN_DRIVER_MEASURE_SPREAD_H
#define TARTAN_DRIVER_MEASURE_SPREAD_H

#include "driver/plan/library.h"
#include "runtime/base/picture.h"
#include "runtime/plan/measure/bins.h"

/* least, three quartiles, most, mean, standard deviation */
#define TN_SPREAD_FACTS 7u

typedef struct tn_spread {
    const char *library, *name, *doc; /* of the measure the last two */
    const char *of;                   /* what is counted: "plan" or "house" */
    tn_weighed *weighed;              /* NULL: of houses */
    tn_distribution d;
    tn_bins bins;                       /* values one by one, until told otherwise */
    const char *names[TN_SPREAD_FACTS]; /* "least" */
    char *facts[TN_SPREAD_FACTS];       /* "146.88 m2"; none of a library without plans */
} tn_spread;

/* measure: of the library (runtime/plan/measure/named.h). Borrows the library. Clear in any case. */
tn_status tn_spread_make(tn_spread *spread, const tn_ready_library *ready, uint32_t measure, tn_error *error);
void tn_spread_clear(tn_spread *spread);

/* A spread whose distribution is empty, and then filled; units are those of the schema. Clear in any case. */
void tn_spread_begin(tn_spread *spread, const tn_schema *schema, int power);
tn_status tn_spread_finish(tn_spread *spread, tn_error *error); /* says it in words */

/* Spells units as pages do, m² for m2. */
tn_status tn_spread_show(tn_spread *spread, tn_error *error);

/* The histogram, of the rows that the bins are set to. */
tn_status tn_spread_draw(const tn_spread *spread, tn_picture *to, tn_error *error);

#endif
