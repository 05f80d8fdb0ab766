/* Faces of up to eight darts, stamped some darts at once (internal to the growth engine).
 *
 * The table of bases of such a face fits into two of AVX-512's registers, in which one instruction looks sixteen
 * references up. That takes a third of the instructions that looking them up one by one does, of which stamping is
 * made. */
#ifndef TARTAN_GROWTH_JOIN_STAMP_H
#define TARTAN_GROWTH_JOIN_STAMP_H

#include "runtime/growth/join/pattern.h"

#define TN_LANES_DARTS 8u

/* Has the processor what it takes? */
bool tn_stamp_has_lanes(void);

/* The darts of a cut of references, for the face of the `size` (at most TN_LANES_DARTS) darts from `first` on: `count`
 * references each of `origins` and `sides` are looked up and written. `bases`, aligned to 64 bytes, gets the face's
 * table. */
void tn_stamp_lanes(const tn_pass *pass, uint32_t first, uint32_t size, const uint32_t *origins, const uint32_t *sides,
                    uint32_t count, uint32_t *origin, uint32_t *side, uint32_t bases[TN_LANES_DARTS * TN_BASES]);

#endif
