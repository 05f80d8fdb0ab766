/* The houses of a library, or those on one plan, in the order of measures: values that were counted together, or, as
 * something asks for walks, found by going through the houses on the plan (walked.h). Whoever wants the best houses
 * asks here: the command, the studio and the C interface.
 */
#ifndef TARTAN_ASK_HOUSE_ORDERED_H
#define TARTAN_ASK_HOUSE_ORDERED_H

#include "ask/house/walked.h"
#include "runtime/house/rank/rank.h"
#include "runtime/plan/measure/amount.h"

typedef struct tn_ordered_houses {
    tn_numbered *n;
    const tn_plan *plan; /* NULL: those on all plans */
    tn_house_weights *weights[TN_WEIGHED_MAX];
    tn_house_measures measures;
    tn_amount_unit units[TN_WEIGHED_MAX];
    tn_houses *houses;              /* or NULL: */
    tn_walked_houses walked;        /* they were gone through */
    size_t point;                   /* the one at hand, */
    int64_t values[TN_WEIGHED_MAX]; /* of `houses` its values */
    mpz_t count;                    /* houses there */
} tn_ordered_houses;

/* What is better: more of a measure, or less. */
typedef struct tn_ordered_wish {
    const char *measure;
    bool most;
} tn_ordered_wish;

/* Makes the measures ready; n and plan are borrowed. What is wrong is said. Clear it in any case. */
tn_status tn_ordered_begin(tn_ordered_houses *ordered, tn_numbered *n, const tn_plan *plan,
                           const tn_ordered_wish *wishes, uint32_t count);
void tn_ordered_clear(tn_ordered_houses *ordered);

/* The name of measure k. */
const char *tn_ordered_name(const tn_ordered_houses *ordered, uint32_t k);

/* Finds the values that are aimed at, of so many houses if the least are: again, of more of them. */
tn_status tn_ordered_find(tn_ordered_houses *ordered, tn_houses_aim aim, uint64_t wanted, tn_error *error);

/* How many values there are: points, the best first. Comes to one, with `count`. */
size_t tn_ordered_points(const tn_ordered_houses *ordered);
void tn_ordered_come(tn_ordered_houses *ordered, size_t point);

/* The value of measure k at the point at hand, in nanometres to its power. */
void tn_ordered_value(const tn_ordered_houses *ordered, uint32_t k, mpq_t value);

/* Calls `each` with the houses of the point at hand, in the order of their ranks, until *stop. */
tn_status tn_ordered_each(tn_ordered_houses *ordered, tn_house_alike alike, tn_house_each *each, void *context,
                          tn_error *error);

#endif
