/* Completes a house whose functions and faces are known by its tiles: combinations in their order, of which the last
 * cell's tile changes first; how many there are, one by its number, the next one.
 *
 * If no clause of the library asks for costs, every combination is a house. Otherwise clauses are asked once for each
 * sum that the tiles can cost together, and combinations are counted by what the tiles from a cell on cost. If a clause
 * asks for walks, tiles with which all walks are as long are a group, and clauses are asked for each combination of
 * groups.
 *
 * A tn_furnisher belongs to one thread and borrows the form.
 */
#ifndef TARTAN_HOUSE_FURNISH_H
#define TARTAN_HOUSE_FURNISH_H

#include <gmp.h>

#include "runtime/house/house_names.h"

typedef struct tn_furnisher tn_furnisher;

tn_status tn_furnisher_new(const tn_house_form *form, const tn_house_library_record *library, tn_furnisher **furnisher,
                           tn_error *error);
void tn_furnisher_free(tn_furnisher *furnisher);

/* Does a clause ask for costs, or for walks? */
bool tn_furnisher_prices(const tn_furnisher *furnisher);
bool tn_furnisher_walks(const tn_furnisher *furnisher);

/* How many combinations were asked about for the house at hand, if a clause asks for walks. */
uint64_t tn_furnisher_asked(const tn_furnisher *furnisher);

/* Finds the combinations for a house (borrowed, as what the functions below are about): those with which the clauses
 * that ask for costs or walks keep it. cost: NULL, or what all tiles have to cost together. count := how many there are; 0 also
 * if a cell wants a tile and none fits. The house has no tiles then. */
tn_status tn_furnish(tn_furnisher *furnisher, tn_house *house, mpq_srcptr cost, mpz_t count, tn_error *error);

/* The house gets the combination that so many others come before, which is there. */
void tn_furnish_at(tn_furnisher *furnisher, const mpz_t number);

/* The next one after that at hand. False: that was the last. */
bool tn_furnish_next(tn_furnisher *furnisher);

/* How many come before the tiles of a house that is the same in all else; is it one of them? */
void tn_furnish_before(const tn_furnisher *furnisher, const tn_house *house, mpz_t count);
bool tn_furnish_has(const tn_furnisher *furnisher, const tn_house *house);

#endif
