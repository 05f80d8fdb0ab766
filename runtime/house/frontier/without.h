/* A library of which a part is left out, for coverage. */
#ifndef TARTAN_HOUSE_FRONTIER_WITHOUT_H
#define TARTAN_HOUSE_FRONTIER_WITHOUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the instructions at these code offsets make is empty in the library's clauses from `first` on (counted within
 * it; borrowed). differs: these keep the houses of which the clause says otherwise then. */
typedef struct tn_frontier_without {
    const uint32_t *offsets;
    size_t count;
    uint32_t first;
    bool differs;
} tn_frontier_without;

#endif
