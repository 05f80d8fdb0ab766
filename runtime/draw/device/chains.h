/* Joins lines: where exactly two of a path end in one place, they are one. */
#ifndef TARTAN_DRAW_DEVICE_CHAINS_H
#define TARTAN_DRAW_DEVICE_CHAINS_H

#include "runtime/draw/device/device.h"

/* The steps of the path with its single lines joined, in another order; what consists of more than a line stays as it
 * is. The caller frees *steps. TN_MEMORY. */
tn_status tn_chains_join(const tn_drawn_path *path, tn_drawn_step **steps, size_t *count);

#endif
