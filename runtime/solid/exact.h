/* Coordinates of designs as whole numbers, so that what decimals decide is not decided by how doubles round: which of
 * two distances is larger, whether two boxes overlap. A design that is moved or scaled by decimals is then built alike.
 */
#ifndef TARTAN_SOLID_EXACT_H
#define TARTAN_SOLID_EXACT_H

#include <stddef.h>

#include "runtime/geometry/union/wide.h"

#define TN_DECIMAL_DIGITS_MAX 36

/* digits * 10^-places */
typedef struct tn_exact {
    tn_int128 digits;
    int places;
} tn_exact;

tn_int128 tn_power_of_ten(int exponent);

/* Reads digits with a point and an exponent. False if there are more than 36 digits. */
bool tn_exact_read(const char *text, size_t size, tn_exact *number);

/* The decimal with the fewest digits that is rounded to this double. */
tn_exact tn_exact_of(double value);

/* The unit in which a design's coordinates are held: top / bottom, or where these are 0 the last of 36 places. A
 * coordinate is a whole number of units times 2^64, since squashing halves again and again; beyond that it is rounded
 * down. */
typedef struct tn_face_unit {
    int64_t top, bottom; /* at most TN_SOLID_UNIT_MAX */
} tn_face_unit;

/* A coordinate of at most TN_SOLID_COORDINATE_MAX. */
tn_wide tn_face_units(const tn_face_unit *unit, double value);

/* The nearest double. */
double tn_face_value(const tn_face_unit *unit, tn_wide coordinate);

#endif
