/* Combinations of the tiles of a house whose faces are known, in their order: how many there are, one by its number,
 * the next one.
 *
 * Where no clause asks for costs, every combination is a house. Otherwise clauses are asked once for each sum that the
 * tiles can cost together, and combinations are counted by what the tiles from a cell on cost.
 */
#ifndef TARTAN_HOUSE_VARIANT_FURNISH_H
#define TARTAN_HOUSE_VARIANT_FURNISH_H

#include <gmp.h>

#include "runtime/house/variant/variant.h"

/* Finds the combinations for the house at hand, whose cells all have a tile (v->tiles). */
tn_status tn_furnish(tn_house_variants *v, tn_error *error);

/* How many of them clauses keep. */
void tn_furnished_count(const tn_house_variants *v, mpz_t count);

/* The one that so many kept ones come before, which is there. */
void tn_furnished_find(tn_house_variants *v, const mpz_t number);

/* The next kept one after that at hand. False: that was the last. */
bool tn_furnished_next(tn_house_variants *v);

/* How many kept ones come before the tiles of a house. */
void tn_furnished_before(const tn_house_variants *v, const tn_house *house, mpz_t count);

void tn_furnished_clear(tn_house_variants *v);

#endif
