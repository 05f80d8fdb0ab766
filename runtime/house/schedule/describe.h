/* Writes what a house is made of, for programs and tables. */
#ifndef TARTAN_HOUSE_DESCRIBE_H
#define TARTAN_HOUSE_DESCRIBE_H

#include <gmp.h>

#include "runtime/house/solids.h"
#include "runtime/plan/measure/amount.h"

/* What a measure is worth on a house, in nanometres to the power of its unit; has: it has a value. */
typedef struct tn_house_value {
    const char *measure; /* borrowed of the module */
    tn_amount_unit unit;
    bool has;
    mpq_t value;
} tn_house_value;

/* Appends one JSON object: the line, cells, faces, rooms, solids, roofs, parts with costs, and the values of measures
 * (docs/houses.md). Lengths in nanometres, areas in square nanometres and what is not whole as texts; values of measures
 * in feet or metres. TN_MEMORY. */
tn_status tn_house_describe(const tn_house *house, const tn_solids *solids, const tn_house_value *values,
                            size_t value_count, tn_buffer *out, tn_error *error);

/* Appends the parts as CSV: their number, area and volume; where the form has materials, also prices and costs, with
 * the total in the last line. TN_MEMORY. */
tn_status tn_house_parts(const tn_house *house, const tn_solids *solids, tn_buffer *out, tn_error *error);

/* Appends an amount of hundredths, as "12.50". False where out of memory. */
bool tn_cost_write(tn_buffer *out, const mpz_t hundredths);

/* Appends the rooms as CSV: a head and a line a room. TN_MEMORY. */
tn_status tn_house_schedule(const tn_house *house, tn_buffer *out, tn_error *error);

#endif
