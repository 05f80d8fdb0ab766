/* The houses of a whole library whose clauses ask for walks. They cannot be counted together (E1687), but those of the
 * same library without these clauses can: houses of that one are tried, and those that all clauses keep are kept.
 */
#ifndef TARTAN_ASK_HOUSE_TRIED_H
#define TARTAN_ASK_HOUSE_TRIED_H

#include "ask/house/numbered.h"
#include "runtime/house/count/houses.h"

#define TN_DRAWN_HOUSES_DEFAULT 5000u /* that are drawn, which takes some milliseconds each */
#define TN_DRAWN_HOUSES_MAX 50000000u /* their ranks are all in memory */
#define TN_LISTED_HOUSES_DEFAULT 100000u

/* `without` borrows `other`: neither may be moved. */
typedef struct tn_tried_houses {
    tn_numbered *n;
    tn_house_clause_record *clauses; /* those that do not ask for walks; owned */
    tn_other_clauses other;
    tn_numbered without; /* the library of these clauses */
    uint64_t most, tried, kept;
} tn_tried_houses;

/* n is borrowed. So many houses are tried at most, if n does not say how many. Clear it in any case. */
tn_status tn_tried_begin(tn_numbered *n, uint64_t most, tn_tried_houses *tried, tn_error *error);
void tn_tried_clear(tn_tried_houses *tried);

/* May another house be tried? */
bool tn_tried_more(const tn_tried_houses *tried);

/* Tries a house of `without`. */
tn_status tn_tried_try(tn_tried_houses *tried, const tn_house *house, bool *kept, tn_error *error);

/* After the last try, which was not enough for so many houses (0: for all): a note of how many were kept of how many;
 * TN_LIMIT (E1688) if none was. */
tn_status tn_tried_end(const tn_tried_houses *tried, uint64_t wanted, tn_error *error);

#endif
