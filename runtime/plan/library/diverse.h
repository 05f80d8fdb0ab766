/* Plans that differ from one another: of plans at hand, or of a library, as much as a few draws allow. The distance of
 * two plans: a changed field costs 1, a tray added or removed as many as it has fields. */
#ifndef TARTAN_PLAN_LIBRARY_DIVERSE_H
#define TARTAN_PLAN_LIBRARY_DIVERSE_H

#include "runtime/plan/library/library.h"
#include "runtime/plan/text/text.h"

/* The most plans: each is held against all before it, so the work grows with the square. */
#define TN_DIVERSE_MAX 500u

/* `count` ranks of one length (or TN_ALL_LENGTHS), ascending. The first is drawn; each next is the one of 1,000 fresh
 * draws whose least distance to those before is greatest, of equal ones that of lowest rank. The distance of two plans:
 * a changed field costs 1, a tray added or removed as many as it has fields. Depends on (seed, arguments) alone. ranks:
 * an initialised array of `count`; *found < count where all that is drawn is there already. */
tn_status tn_library_diverse(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                             size_t *found, tn_error *error);

/* Chooses so many of the plans, or as many as differ: the first, and then each time the one whose least distance to
 * those before is greatest, of equal ones the first. chosen: [count]. */
tn_status tn_plans_diverse(const tn_schema *schema, const tn_plan *plans, size_t count, size_t wanted, bool *chosen,
                           tn_error *error);

#endif
