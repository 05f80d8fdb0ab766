/* Height maps: pictures whose brightness is a height.
 *
 * A tn_heights owns its values; clear it in any case. */
#ifndef TARTAN_PLACE_HEIGHTS_H
#define TARTAN_PLACE_HEIGHTS_H

#include "runtime/base/error.h"

typedef struct tn_heights {
    uint16_t *values; /* [depth][width], the upper row of the picture first */
    uint32_t width, depth;
    uint32_t most; /* white; at least 1 */
} tn_heights;

/* Reads a grey picture: PGM, as text (P2) or binary (P5). TN_INVALID with what is wrong (no code), TN_LIMIT if it
 * has more than 65,536 pixels along a side or 67,108,864 in all, TN_MEMORY. */
tn_status tn_heights_read(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error);
void tn_heights_clear(tn_heights *heights);

/* The height, from 0 to 1, at a share of the width from the left and of the depth from above: between the middles of
 * four pixels it changes evenly; outside of all middles it is that of the nearest. */
double tn_heights_at(const tn_heights *heights, double across, double down);

#endif
