/* In how many ways the plans of a library are derived by what it generates (D of docs/plan-language.md), exactly and
 * without listing them: the plans with all their derivations are counted along the automaton of the kept plans.
 *
 * Which number of ways belongs to how many plans takes more: sets of rests with their numbers are told apart then. If
 * these pass a limit, the sum of the ways is still known.
 */
#ifndef TARTAN_PLAN_WAYS_LIBRARY_WAYS_H
#define TARTAN_PLAN_WAYS_LIBRARY_WAYS_H

#include "runtime/plan/library/library.h"

typedef struct tn_derived_row {
    mpz_t ways, plans; /* so many plans are derived in so many ways */
} tn_derived_row;

typedef struct tn_derived_ways {
    const char *clause; /* that generates, or by which it is projected; NULL: none, and each plan is made in one way */
    bool projected;     /* ways are plans of the other library */
    mpz_t plans, ways;  /* in all */
    bool has_most;
    mpz_t most;
    tn_tray *first; /* the first plan with the most, of so many trays; NULL: there is no plan */
    uint32_t length;
    bool has_rows;
    tn_derived_row *rows; /* ascending */
    size_t count, room;
} tn_derived_ways;

/* What telling plans apart by their ways may take. */
#define TN_WAYS_NODES (UINT32_C(1) << 20)  /* places of the automaton with rests and their numbers */
#define TN_WAYS_STEPS (UINT64_C(1) << 26)  /* rests that are met again */
#define TN_WAYS_ROWS 10000u                /* different numbers of ways */
#define TN_WAYS_PLACES (UINT32_C(1) << 22) /* of the sum alone, with as many trays read (E0802 past it) */

/* max_nodes: 0: TN_WAYS_NODES. TN_LIMIT (E0802) if even the sum takes too much. Clear in any case. */
tn_status tn_library_count_ways(const tn_library *library, uint32_t max_nodes, tn_derived_ways *found, tn_error *error);
void tn_derived_ways_clear(tn_derived_ways *found);

/* The place of the clause that generates among those of the library, or of the one by which it is projected; or
 * UINT32_MAX. */
uint32_t tn_library_generator(const tn_library *library);

#endif
