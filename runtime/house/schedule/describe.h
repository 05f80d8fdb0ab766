/* Writes what a house is made of, for programs and tables. */
#ifndef TARTAN_HOUSE_DESCRIBE_H
#define TARTAN_HOUSE_DESCRIBE_H

#include <gmp.h>

#include "runtime/house/solids.h"

/* Appends one JSON object: the line, cells, faces, rooms, solids, roofs and parts with costs (docs/houses.md). Lengths
 * in nanometres, areas in square nanometres and what is not whole as texts. TN_MEMORY. */
tn_status tn_house_describe(const tn_house *house, const tn_solids *solids, tn_buffer *out, tn_error *error);

/* Appends the parts as CSV: their number, area and volume; where the form has materials, also prices and costs, with
 * the total in the last line. TN_MEMORY. */
tn_status tn_house_parts(const tn_house *house, const tn_solids *solids, tn_buffer *out, tn_error *error);

/* Appends an amount of hundredths, as "12.50". False where out of memory. */
bool tn_cost_write(tn_buffer *out, const mpz_t hundredths);

/* Appends the rooms as CSV: a head and a line a room. TN_MEMORY. */
tn_status tn_house_schedule(const tn_house *house, tn_buffer *out, tn_error *error);

#endif
