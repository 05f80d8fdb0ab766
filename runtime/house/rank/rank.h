/* Ranks of the houses of a library, whatever number of them there is.
 *
 * Ranks compare the plan first: the rank of a house is that of the first house on its plan, and its number among the
 * houses on that plan. These are in the order of section, functions, faces, tiles. No list of plans or houses is gone
 * through: what is ahead is counted tray by tray (runtime/house/frontier).
 */
#ifndef TARTAN_HOUSE_RANK_RANK_H
#define TARTAN_HOUSE_RANK_RANK_H

#include "runtime/house/count/houses.h"
#include "runtime/house/line.h"

/* How many houses come before the first on this plan, one of the library's. */
tn_status tn_houses_before(tn_houses *houses, const tn_tray *trays, uint32_t length, mpz_t before, tn_error *error);

/* The plan of the house of a rank: fills trays (room for tn_library_max) and its length; rank becomes the house's
 * number among those on the plan, of which there are so many. TN_INVALID (E1618) if no house has the rank. */
tn_status tn_houses_find(tn_houses *houses, mpz_t rank, tn_tray *trays, uint32_t *length, mpz_t on_plan,
                         tn_error *error);

/* The houses on one plan of these houses, whose states are found once. Borrows all that it is made of. Free with
 * tn_plan_houses_free, also after a failure. */
typedef struct tn_plan_houses tn_plan_houses;
tn_status tn_plan_houses_new(tn_houses *houses, const tn_tray *trays, uint32_t length, tn_plan_houses **plan,
                             tn_error *error);
void tn_plan_houses_free(tn_plan_houses *plan);

/* How many houses there are on the plan. */
tn_status tn_plan_houses_count(tn_plan_houses *plan, mpz_t houses, tn_error *error);

/* The house that `variant` others come before. TN_INVALID (E1618) if there are not so many. Clear *house in any
 * case. */
tn_status tn_plan_houses_at(tn_plan_houses *plan, const mpz_t variant, tn_house *house, tn_error *error);

/* Calls `each` with the houses from that number on, in order, until there are no more or *stop. From one house to the
 * next only what changes is chosen anew. */
tn_status tn_plan_houses_each(tn_plan_houses *plan, const mpz_t from, tn_house_each *each, void *context,
                              tn_error *error);

/* How many there are without their tiles, gone through one by one; *known: they are at most so many. If clauses compare
 * what tiles cost, this is not counted with the houses (tn_houses_faced_known). */
tn_status tn_plan_houses_faced(tn_plan_houses *plan, uint64_t most, uint64_t *faced, bool *known, tn_error *error);

/* How many houses come before this one, which is on the plan. TN_INVALID (E1618) if the library does not keep it. */
tn_status tn_plan_houses_number(tn_plan_houses *plan, const tn_house *house, mpz_t variant, tn_error *error);

/* The first house that has what is typed of a line (its plan is not looked at); *found: there is one. work: choices
 * that may be tried, TN_TYPED_WORK to begin with; past them it is TN_LIMIT (E1617). What stands before what is left out
 * is counted with; what stands behind it is tried. Clear *house in any case. */
#define TN_TYPED_WORK 200000u
tn_status tn_plan_houses_typed(tn_plan_houses *plan, const tn_line_asked *asked, uint64_t *work, tn_house *house,
                               bool *found, tn_error *error);

/* Takes one of the choices that may be tried, of which `work` are left; TN_LIMIT (E1617) past the last. */
tn_status tn_typed_try(uint64_t *work, tn_error *error);

/* Has a house what is typed that has this line, as tn_house_write writes it? Its plan is not looked at. */
bool tn_typed_line_fits(const tn_line_asked *asked, const char *line);

/* Houses by rank. The plans that were asked for last are kept with their states, as long as these are not too many.
 * Borrows the houses. Free with tn_house_ranks_free, also after a failure. */
typedef struct tn_house_ranks tn_house_ranks;
tn_status tn_house_ranks_new(tn_houses *houses, tn_house_ranks **ranks, tn_error *error);
void tn_house_ranks_free(tn_house_ranks *ranks);

/* The same as tn_houses_find. */
tn_status tn_house_ranks_find(tn_house_ranks *ranks, mpz_t rank, tn_tray *trays, uint32_t *length, tn_error *error);

/* The houses on a plan; borrowed until the next call. */
tn_status tn_house_ranks_plan(tn_house_ranks *ranks, const tn_tray *trays, uint32_t length, tn_plan_houses **plan,
                              tn_error *error);

/* Which houses are shown: all, or of those that are alike so far the first alone. */
typedef enum tn_house_alike {
    TN_ALIKE_PLAN,      /* the first on each plan */
    TN_ALIKE_SECTION,   /* the first of each section of a plan */
    TN_ALIKE_FUNCTIONS, /* the first with the same functions in these */
    TN_ALIKE_FACES,     /* the first with the same faces in these */
    TN_ALIKE_NOTHING    /* all */
} tn_house_alike;

/* Calls `each` with the houses that have value `point` of these (count/houses.h), in the order of their ranks, until
 * there are no more or *stop. No other house is looked at. The house is borrowed for the call. */
tn_status tn_houses_point_each(tn_houses *houses, size_t point, tn_house_alike alike, tn_house_each *each,
                               void *context, tn_error *error);

#endif
