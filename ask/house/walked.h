/* The houses on one plan by the values of measures that only single houses have, as those of walks and ways out: they
 * are gone through one by one, and their values kept.
 */
#ifndef TARTAN_ASK_HOUSE_WALKED_H
#define TARTAN_ASK_HOUSE_WALKED_H

#include "ask/house/numbered.h"
#include "runtime/house/count/houses.h"

#define TN_WALKED_HOUSES_DEFAULT 100000u

/* A house: its number on the plan, and its values, in nanometres to the power of each measure. */
typedef struct tn_walked_house {
    uint64_t number;
    const tn_house_measures *measures;
    mpq_t *values; /* [measures] */
} tn_walked_house;

/* By value, the best first, then by number. Houses without a value of one of the measures are left out. */
typedef struct tn_walked_houses {
    tn_numbered *n;
    const tn_plan *plan;
    tn_house_measures measures;
    tn_walked_house *items;
    size_t count, room;
    uint64_t without; /* houses that are left out */
    size_t *points;   /* [point_count + 1]: where the houses of each value begin, then the end */
    size_t point_count;
} tn_walked_houses;

/* How many houses may be gone through. */
uint64_t tn_walked_most(const tn_numbered *n);

/* Does a measure, or a clause of the library, ask for walks? */
bool tn_walked_asked(const tn_numbered *n, const tn_house_measures *measures);

/* Goes through the houses of the plan; both are borrowed. front: only the values are points that no house betters in
 * one measure without losing in another. TN_LIMIT (E1617) where there are more than tn_walked_most. Clear it in
 * any case. */
tn_status tn_walked_find(tn_numbered *n, const tn_plan *plan, const tn_house_measures *measures, bool front,
                         tn_walked_houses *walked, tn_error *error);
void tn_walked_clear(tn_walked_houses *walked);

/* Calls `each` with the houses of a value, in the order of their numbers, until *stop. */
tn_status tn_walked_each(const tn_walked_houses *walked, size_t point, tn_house_each *each, void *context,
                         tn_error *error);

/* How the houses are spread over the values of one measure, found as the least; `distribution` is initialised. */
tn_status tn_walked_spread(const tn_walked_houses *walked, tn_distribution *distribution, tn_error *error);

#endif
