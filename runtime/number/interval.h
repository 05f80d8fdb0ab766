/* Intervals that hold all values of an expression over a box: the column `bounds` of operations.def, rounded outward.
 */
#ifndef TARTAN_NUMBER_INTERVAL_H
#define TARTAN_NUMBER_INTERVAL_H

#include <stdbool.h>

#include "runtime/module/opcodes.h"

/* Every value lies between the two, or is none if `fails` says that this may be. Where low is above high there is no
 * value anywhere. */
typedef struct tn_interval {
    double low, high;
    bool fails;
} tn_interval;

static inline tn_interval tn_interval_of(double number)
{
    return (tn_interval){number, number, number != number};
}

/* From `low` to `high`, widened by one unit in the last place on both sides. */
tn_interval tn_interval_around(double low, double high, bool fails);

static inline bool tn_interval_is_none(tn_interval a)
{
    return !(a.low <= a.high);
}

/* The values of an operation. Two operands that are one and the same pointer have the same value. */
tn_interval tn_operation_bounds(tn_opcode opcode, const tn_interval *const *operands);

#endif
