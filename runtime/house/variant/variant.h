/* The houses of a library on one plan, in the order of their ranks: section, functions, faces, tiles.
 *
 * Sections, then functions, then what is in the faces are tried one after another; a clause is asked as soon as what it
 * asks for is known, so that what it drops is not gone into. Tiles change only what a house costs: they are multiplied,
 * or, where a clause asks for costs, added up (furnish.h). Counts are exact. Going through all takes as long as there
 * are faced houses that no earlier clause drops: past a limit of `work` it is TN_LIMIT (E1617).
 *
 * A tn_house_variants belongs to one thread and borrows the form.
 */
#ifndef TARTAN_HOUSE_VARIANT_VARIANT_H
#define TARTAN_HOUSE_VARIANT_VARIANT_H

#include <gmp.h>

#include "runtime/house/rule/asked.h"

#define TN_VARIANT_WORK_DEFAULT UINT64_C(20000000) /* assignments looked at: some minutes */

typedef struct tn_house_variants tn_house_variants;

/* library: whose clauses keep houses. work: 0 is the default. */
tn_status tn_house_variants_new(const tn_house_form *form, const tn_house_library_record *library, uint64_t work,
                                tn_house_variants **variants, tn_error *error);
void tn_house_variants_free(tn_house_variants *variants);

/* How many there are on a plan. zoned: sections with functions that have a house; faced: those with what is in the
 * faces, too. Adds to what is there: begin with tn_house_counts_init. */
typedef struct tn_house_counts {
    uint64_t zoned, faced;
    mpz_t houses;
} tn_house_counts;
void tn_house_counts_init(tn_house_counts *counts);
void tn_house_counts_clear(tn_house_counts *counts);

tn_status tn_house_variants_count(tn_house_variants *variants, const tn_tray *trays, size_t length,
                                  tn_house_counts *counts, tn_error *error);

/* The same section by section: calls `each` with the values of each section that has a house. */
typedef tn_status tn_section_each(void *context, const uint32_t *shapes, const tn_house_counts *counts,
                                  tn_error *error);
tn_status tn_house_variants_sections(tn_house_variants *variants, const tn_tray *trays, size_t length,
                                     tn_section_each *each, void *context, tn_error *error);

/* Calls `each` with the houses on a plan, in order, from number `from` on, until there are no more or *stop. The house
 * is borrowed for the call. The limit of work is for the way to the next house. */
typedef tn_status tn_house_each(void *context, const tn_house *house, bool *stop, tn_error *error);
tn_status tn_house_variants_each(tn_house_variants *variants, const tn_tray *trays, size_t length, const mpz_t from,
                                 tn_house_each *each, void *context, tn_error *error);

/* Calls `faced` with the house that is like this one, which has functions and faces, without its tiles. tiles: [cells]
 * how many fit in each, 1 where it wants none; the callee may set the cells' variants below these. */
typedef tn_status tn_house_faced(void *context, tn_house *house, const size_t *tiles, tn_error *error);
tn_status tn_house_variants_faced(tn_house_variants *variants, const tn_house *like, tn_house_faced *faced,
                                  void *context, tn_error *error);

/* Calls `each` with a house that the library keeps, and with those after it that differ from it only in tiles, until
 * *stop. */
tn_status tn_house_variants_tiles_from(tn_house_variants *variants, const tn_house *house, tn_house_each *each,
                                       void *context, tn_error *error);

/* While tn_house_faced is called: do the clauses that ask what tiles cost keep the house with those that are set? */
bool tn_house_variants_keep_tiles(const tn_house_variants *variants, const tn_house *house);

/* The house that `variant` others come before; TN_INVALID (E1618) where there are not so many. Clear *house in any
 * case. */
tn_status tn_house_variants_at(tn_house_variants *variants, const tn_tray *trays, size_t length, const mpz_t variant,
                               tn_house *house, tn_error *error);

/* TN_INVALID (E1618): a house is asked for by a number that a plan with so many houses does not have. */
tn_status tn_house_variants_too_few(const mpz_t houses, tn_error *error);

/* TN_INVALID (E1618): the library does not keep a house whose number is asked for. */
tn_status tn_house_variants_no_house(tn_error *error);

/* The house that is like this one in everything but its tiles, which have so many kept combinations before them; the
 * clauses that do not ask for costs are taken to keep it. Clear *house in any case. */
tn_status tn_house_variants_furnish(tn_house_variants *variants, const tn_house *like, const mpz_t number,
                                    tn_house *house, tn_error *error);

/* How many kept combinations of tiles come before those of the house; the same. TN_INVALID (E1618) where its own is not
 * kept. */
tn_status tn_house_variants_furnished(tn_house_variants *variants, const tn_house *house, mpz_t number,
                                      tn_error *error);

/* How many houses on its plan come before this one, which the library keeps. TN_INVALID (E1618) where it does not. */
tn_status tn_house_variants_rank(tn_house_variants *variants, const tn_house *house, mpz_t variant, tn_error *error);

#endif
