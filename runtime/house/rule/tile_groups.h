/* The tiles of a house's cells in groups, where nothing that clauses ask tells those of a group apart: combinations of
 * groups are asked about, and combinations of tiles counted by them.
 *
 * A state is the groups of the tiles of the cells so far, as one number: 0 before the first cell. Owns its arrays.
 */
#ifndef TARTAN_HOUSE_TILE_GROUPS_H
#define TARTAN_HOUSE_TILE_GROUPS_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/base/error.h"

#define TN_TILE_STATES_MAX 16384u /* combinations of groups of a house */

typedef struct tn_tile_groups {
    size_t cells;
    uint32_t **group;   /* [cell][tile] */
    size_t *counts;     /* [cells] groups */
    size_t **sizes;     /* [cell][group] tiles */
    mpz_t **ahead;      /* [cells + 1][states] how many combinations of tiles, from this cell on, are kept */
    size_t *states;     /* [cells + 1] */
    uint64_t asked;     /* combinations of groups that were asked about */
} tn_tile_groups;

/* Begins a house of so many cells. Clear it in any case. */
tn_status tn_tile_groups_begin(tn_tile_groups *groups, size_t cells, tn_error *error);
void tn_tile_groups_clear(tn_tile_groups *groups);

/* The tiles of a cell, by numbers: those with the same are a group. At least one. */
tn_status tn_tile_groups_add(tn_tile_groups *groups, size_t cell, const uint64_t *numbers, size_t tiles,
                             tn_error *error);

/* Is a house kept, with these tiles ([cells], one of each group)? */
typedef tn_status tn_tiles_asked(void *context, const size_t *tiles, bool *kept, tn_error *error);

/* Asks about all combinations of groups. TN_LIMIT (E1617) where they are more than TN_TILE_STATES_MAX. */
tn_status tn_tile_groups_ask(tn_tile_groups *groups, tn_tiles_asked *ask, void *context, tn_error *error);

static inline size_t tn_tile_groups_next(const tn_tile_groups *groups, size_t cell, size_t state, size_t tile)
{
    return state * groups->counts[cell] + groups->group[cell][tile];
}

#endif
