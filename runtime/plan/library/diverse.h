/* Plans of a library that differ from one another as much as a few draws allow. */
#ifndef TARTAN_PLAN_LIBRARY_DIVERSE_H
#define TARTAN_PLAN_LIBRARY_DIVERSE_H

#include "runtime/plan/library/library.h"

/* The most plans: each is held against all before it, so the work grows with the square. */
#define TN_DIVERSE_MAX 500u

/* `count` ranks of one length (or TN_ALL_LENGTHS), ascending. The first is drawn; each next is the one of 1,000 fresh
 * draws whose least distance to those before is greatest, of equal ones that of lowest rank. The distance of two plans:
 * a changed field costs 1, a tray added or removed as many as it has fields. Depends on (seed, arguments) alone. ranks:
 * an initialised array of `count`; *found < count where all that is drawn is there already. */
tn_status tn_library_diverse(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                             size_t *found, tn_error *error);

#endif
