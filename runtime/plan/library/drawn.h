/* Numbers drawn below a bound, in a hash table. Internal to runtime/plan/library. */
#ifndef TARTAN_PLAN_LIBRARY_DRAWN_H
#define TARTAN_PLAN_LIBRARY_DRAWN_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/base/hash_table.h"

/* Numbers of one size in limbs, those drawn so far. Begin with tn_drawn_make; clear in any case. */
typedef struct tn_drawn {
    mpz_srcptr bound;
    size_t limbs;
    unsigned spare;    /* bits of the highest limb that the bound does not have */
    mp_limb_t *values; /* [count][limbs], in the order drawn */
    size_t count, room;
    tn_hash_table index;
    mp_limb_t *candidate; /* [limbs] */
} tn_drawn;

/* count: how many there will be at least. The bound is above 0, and borrowed. */
bool tn_drawn_make(tn_drawn *drawn, const mpz_t bound, size_t count);
void tn_drawn_clear(tn_drawn *drawn);

/* Attempt a takes random words a * limbs and following of a stream, cut to as many bits as the bound has. Is the
 * candidate below the bound? Attempts at or past it are thrown away, so that the rest are uniform. */
bool tn_drawn_try(tn_drawn *drawn, uint64_t seed, uint64_t stream, uint64_t attempt);

uint64_t tn_drawn_hash(const tn_drawn *drawn); /* of the candidate */

/* Adds the candidate. *fresh: it was not there. TN_MEMORY. */
tn_status tn_drawn_add(tn_drawn *drawn, bool *fresh, tn_error *error);

/* Gives the numbers drawn, ascending; ranks are [count], initialised. */
void tn_drawn_give(const tn_drawn *drawn, mpz_t *ranks);

#endif
