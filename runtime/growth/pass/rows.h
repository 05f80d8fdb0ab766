/* Rows of numbers, one for each of some edges or faces, which compilers work out in one go (internal to the growth
 * engine). The same operations in the same order as vector.h's, and so the same numbers. */
#ifndef TARTAN_GROWTH_PASS_ROWS_H
#define TARTAN_GROWTH_PASS_ROWS_H

#include <stdint.h>

#include "runtime/geometry/vector.h"
#include "runtime/numeric/any_width.h"

#define TN_ROW 32u
typedef double tn_row[TN_ROW];

/* How much of a row is worked out where `count` are needed: one of three lengths, so that all are constants where the
 * work is inlined: TN_EACH_LENGTH. */
static inline uint32_t tn_row_length(uint32_t count)
{
    return count <= 8 ? 8 : count <= 16 ? 16 : TN_ROW;
}

#define TN_EACH_LENGTH(count, work, ...)                                                                               \
    (count) <= 8 ? work(__VA_ARGS__, 8) : (count) <= 16 ? work(__VA_ARGS__, 16) : work(__VA_ARGS__, TN_ROW)

#define TN_INLINED static inline __attribute__((always_inline))

/* Vectors are three rows. */
static inline tn_vector tn_rows_at(tn_row rows[3], uint32_t i)
{
    return (tn_vector){rows[0][i], rows[1][i], rows[2][i]};
}

static inline void tn_rows_put(tn_row rows[3], uint32_t i, tn_vector a)
{
    rows[0][i] = a.x;
    rows[1][i] = a.y;
    rows[2][i] = a.z;
}

/* Zeros after the first `count`, as far as the row is worked out. */
static inline void tn_rows_fill(tn_row rows[3], uint32_t count)
{
    for (uint32_t length = tn_row_length(count); count < length; count++)
        tn_rows_put(rows, count, (tn_vector){0, 0, 0});
}

#endif
