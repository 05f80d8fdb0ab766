/* The houses of a library on one plan, gone through one by one in the order of their numbers: section, functions,
 * faces, tiles.
 *
 * This is no second engine: houses are counted, numbered and found by the frontier method (houses.h, rank/rank.h). It
 * has limits, on what a tray and what clauses may ask (TN_LIMIT, E1640): a tray of more than 60 cells, a clause that
 * compares `occurrences`, more states than are allowed. Houses beyond these are found here, the slow way: sections,
 * then functions, then what is in the faces are tried one after another, and a clause is asked as soon as what it asks
 * for is known, so that what it drops is not gone into. Only tiles are counted together (rule/furnish.h). It takes as
 * long as there are houses without tiles that no earlier clause drops: past a limit of `work` it is TN_LIMIT (E1617).
 * Tests, and builds that check their counts, hold the frontier method to it.
 *
 * A tn_house_listing belongs to one thread and borrows the form.
 */
#ifndef TARTAN_HOUSE_LISTING_H
#define TARTAN_HOUSE_LISTING_H

#include <gmp.h>

#include "runtime/house/rule/asked.h"

#define TN_LISTING_WORK_DEFAULT UINT64_C(20000000) /* assignments looked at: some minutes */

typedef struct tn_house_listing tn_house_listing;

/* library: whose clauses keep houses. work: 0 is the default. */
tn_status tn_house_listing_new(const tn_house_form *form, const tn_house_library_record *library, uint64_t work,
                               tn_house_listing **listing, tn_error *error);
void tn_house_listing_free(tn_house_listing *listing);

/* zoned: sections with functions that have a house; faced: those with what is in the faces, too. */
typedef struct tn_house_counts {
    uint64_t zoned, faced;
    mpz_t houses;
} tn_house_counts;
void tn_house_counts_init(tn_house_counts *counts);
void tn_house_counts_clear(tn_house_counts *counts);

/* How many houses there are on a plan. Adds to what is there: begin with tn_house_counts_init. */
tn_status tn_house_listing_count(tn_house_listing *listing, const tn_tray *trays, size_t length,
                                 tn_house_counts *counts, tn_error *error);

/* The same section by section: calls `each` with the values of each section that has a house. */
typedef tn_status tn_section_each(void *context, const uint32_t *shapes, const tn_house_counts *counts,
                                  tn_error *error);
tn_status tn_house_listing_sections(tn_house_listing *listing, const tn_tray *trays, size_t length,
                                    tn_section_each *each, void *context, tn_error *error);

/* Calls `each` with the houses on a plan, in order, from number `from` on, until there are no more or *stop. The house
 * is borrowed for the call. The limit of work is for the way to the next house. */
tn_status tn_house_listing_each(tn_house_listing *listing, const tn_tray *trays, size_t length, const mpz_t from,
                                tn_house_each *each, void *context, tn_error *error);

/* The house that `number` others come before; TN_INVALID (E1618) if there are not so many. Clear *house in any case. */
tn_status tn_house_listing_at(tn_house_listing *listing, const tn_tray *trays, size_t length, const mpz_t number,
                              tn_house *house, tn_error *error);

/* How many houses on its plan come before this one. TN_INVALID (E1618) if the library does not keep it. */
tn_status tn_house_listing_number(tn_house_listing *listing, const tn_house *house, mpz_t number, tn_error *error);

/* TN_INVALID (E1618): a house is asked for by a number that a plan with so many houses does not have; the library does
 * not keep a house whose number is asked for. */
tn_status tn_house_too_few(const mpz_t houses, tn_error *error);
tn_status tn_house_not_kept(tn_error *error);

#endif
