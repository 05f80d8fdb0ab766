/* Measures of houses made ready: what a tray's cells, and rooms, add to each, in whole steps of its unit.
 *
 * How much houses cost is not in these steps: runtime/house/frontier/costs.c finds it out of parts of houses. A
 * tn_house_weights is immutable; it borrows the form.
 */
#ifndef TARTAN_HOUSE_MEASURE_H
#define TARTAN_HOUSE_MEASURE_H

#include <gmp.h>

#include "runtime/base/int128.h"
#include "runtime/house/house_names.h"
#include "runtime/plan/measure/weighed.h"

typedef struct tn_house_weight_term {
    tn_house_term_kind kind;
    uint32_t part;
    int64_t each; /* steps of each cell or room, or of each `area` */
    mpz_t area;   /* square nanometres, of which areas are multiples */
} tn_house_weight_term;

/* A measure that houses have: one about houses of their form, or one about their plans (without terms). */
typedef struct tn_house_measured {
    tn_string name, doc;
    uint32_t sum, term_first, term_count;
} tn_house_measured;

/* What a HOUSE_SUM record adds up, under the name of the clause that compares it. */
tn_house_measured tn_house_measured_sum(const tn_module *module, uint32_t sum, tn_string name);

/* measure: below the module's HOUSE_MEASUREs one of them, then its MEASUREs. */
tn_house_measured tn_house_measured_of(const tn_module *module, uint32_t measure);

typedef struct tn_house_weights {
    const tn_house_form *form;
    tn_house_measured of;
    uint32_t count;
    tn_house_weight_term *terms;
    int64_t plan; /* steps of a step of the plan's part */
    mpq_t unit;   /* a step, in nanometres to the measure's power; above 0 */
    mpq_t cost;   /* the factor of the cost of a house; 0: it asks for none */
    bool only_costs;
    mpq_t shown; /* a step of the values that are given out: `unit`, or with costs a hundredth of what is written */
} tn_house_weights;

/* E0424 (TN_LIMIT) where the numbers have no common step that is coarse enough. */
tn_status tn_house_weights_new(const tn_house_form *form, tn_house_measured measure, tn_house_weights **weights,
                               tn_error *error);
void tn_house_weights_free(tn_house_weights *weights);

/* Steps that the cells of a house add: of a house of one tray what that tray adds. */
int64_t tn_house_weights_cells(const tn_house_weights *weights, const tn_house *house);

/* Up to so many measures at a time: what each comes to, in its steps. */
typedef struct tn_house_gain {
    tn_int128 by[TN_WEIGHED_MAX];
} tn_house_gain;

/* The measures that houses are counted by, or put in order. Borrowed by whoever is given them. */
typedef struct tn_house_measures {
    uint32_t count;
    const tn_house_weights *of[TN_WEIGHED_MAX];
    bool most[TN_WEIGHED_MAX]; /* more of it is better: its values are those below 0 that it would be with less */
} tn_house_measures;

#define TN_COMPARED_MAX 8u /* numbers that the clauses of a library compare with 0 */
#define TN_ADDED_MAX (TN_WEIGHED_MAX + TN_COMPARED_MAX)

/* All that is added up over houses: the measures, then what clauses compare. */
typedef struct tn_house_added {
    uint32_t measures, count;
    const tn_house_weights *of[TN_ADDED_MAX];
    uint32_t sums[TN_ADDED_MAX]; /* of what is compared: HOUSE_SUM records */
} tn_house_added;

/* ---- steps */

/* unit := the greatest number that unit and `other` are multiples of; both are not below 0. */
void tn_common_unit(mpq_t unit, const mpq_t other);

/* How many steps a number is. False where it is no whole number of them, or more than 2^99. */
bool tn_steps_of(const mpq_t number, const mpq_t unit, tn_int128 *steps);

/* number := steps * unit */
void tn_steps_number(tn_int128 steps, const mpq_t unit, mpq_t number);
tn_status tn_too_fine(tn_error *error); /* E0424 */

#endif
