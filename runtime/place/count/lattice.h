/* Parts as they lie in a building that is counted: each kind in each of its looks, which pairs join, and which overlap.
 *
 * A building's parts lie on a lattice: steps between lowest corners of parts that join are multiples of `step`. A part
 * in a building is a slot: a place of the lattice and a look, as one number, in a table around the middle. So what
 * joins a slot, or overlaps it, lies at constant distances from it. Constant once made; threads share it. */
#ifndef TARTAN_PLACE_COUNT_LATTICE_H
#define TARTAN_PLACE_COUNT_LATTICE_H

#include "runtime/place/search/choices.h"

/* A kind in one heading, of those in which it looks different. */
typedef struct tn_look {
    uint32_t kind, heading;
    int32_t size[3];
    uint32_t joining_first, joining_count, overlapping_first, overlapping_count; /* pairs */
} tn_look;

/* Another look, and where its lowest corner is from that of the first: in cells, and as a distance of slots. */
typedef struct tn_look_pair {
    int32_t by[3];
    uint32_t look;
    int64_t slots;
} tn_look_pair;

typedef struct tn_lattice {
    tn_site_choices kinds; /* of the kit: only these */
    tn_look *looks;
    tn_look_pair *pairs;
    uint32_t look_count;
    size_t pair_count, pair_capacity;
    int32_t step[3], most[3];  /* most: of the distances of parts that join or overlap, in cells */
    int32_t reach[3], side[3]; /* the table: side = 2 reach + 1 places */
    size_t slot_count, middle; /* middle: slot of look 0 at place 0, 0, 0 */
} tn_lattice;

/* The looks of those parts of a kit that are wanted ([part of the kit]; NULL: all). TN_MEMORY, or TN_LIMIT (E1313) for
 * more than 2^21 pairs. Clear it in any case. */
tn_status tn_lattice_make(const tn_place_rules *rules, const bool *wanted, tn_lattice *lattice, tn_error *error);
void tn_lattice_clear(tn_lattice *lattice);

/* Makes the table large enough for buildings of so many parts about the middle. TN_LIMIT (E1313) past 2^28 slots. */
tn_status tn_lattice_size(tn_lattice *lattice, uint32_t parts, tn_error *error);

/* Makes the table hold all parts whose lowest corner is inside of a box of cells, and what joins or overlaps these. The
 * same limit. */
tn_status tn_lattice_cover(tn_lattice *lattice, const tn_cell_box *box, tn_error *error);

/* The look of a slot, and its lowest corner in cells from that of the middle. */
uint32_t tn_slot_look(const tn_lattice *lattice, size_t slot, int32_t corner[3]);

/* Would what lies in two slots share a cell? By search, also where parts are large. */
bool tn_slots_overlap(const tn_lattice *l, size_t a, size_t b);

/* The slot of a look at a corner; SIZE_MAX: off the lattice, or outside of the table. */
size_t tn_slot_at(const tn_lattice *lattice, uint32_t look, const int32_t corner[3]);

/* The look of a kind in a heading. */
uint32_t tn_look_of(const tn_lattice *lattice, uint32_t kind, uint32_t heading);

#endif
