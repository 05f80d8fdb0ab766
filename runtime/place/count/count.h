/* How many buildings can be made of so many parts: sets of parts that hang together by joints, none overlapping
 * another. Each set counts once, up to where it stands and, unless `fixed`, how it is turned about the vertical. */
#ifndef TARTAN_PLACE_COUNT_COUNT_H
#define TARTAN_PLACE_COUNT_COUNT_H

#include "runtime/base/crew.h"
#include "runtime/place/count/lattice.h"

enum { TN_COUNT_PARTS_MAX = 32 };

/* buildings: up to turning; fixed: those that differ by a turn are told apart; half, quarter: those of them that half a
 * turn (a quarter) takes to themselves. */
typedef struct tn_building_counts {
    uint64_t fixed, half, quarter, buildings;
} tn_building_counts;

/* Counts the buildings of `parts` parts, of kinds as in tn_lattice_make. threads: 0: as many as there are processors.
 * TN_MEMORY, TN_STOPPED, TN_LIMIT (E1313) for tables that are too large. */
tn_status tn_count_buildings(const tn_place_rules *rules, const bool *wanted, uint32_t parts, bool fixed,
                             unsigned threads, tn_watch *watch, tn_building_counts *counts, tn_error *error);

/* Counts the sets of `parts` parts that hang together, each where it stands, inside of the space of the rules' model:
 * on the lattice of what the model's rule places first where it starts. E1338 where it places none of the wanted parts
 * there. Otherwise as above. */
tn_status tn_count_inside(const tn_place_rules *rules, const bool *wanted, uint32_t parts, unsigned threads,
                          tn_watch *watch, uint64_t *count, tn_error *error);

/* The lattice on which that is counted, through the anchor, and [slot] what is forbidden there: the caller clears the
 * one and frees the other in any case. */
tn_status tn_lattice_inside(const tn_place_rules *rules, const bool *wanted, tn_watch *watch, tn_lattice *lattice,
                            int32_t anchor[3], uint8_t **forbidden, tn_error *error);

/* The sets of so many slots that hang together and are allowed: [slot], 0 where it is. */
tn_status tn_count_allowed(const tn_lattice *lattice, const uint8_t *forbidden, uint32_t parts, unsigned threads,
                           tn_watch *watch, uint64_t *count, tn_error *error);

/* A set of slots: the lowest first, then as it grew. Anything but TN_OK ends the walk. */
typedef tn_status tn_slots_visit(void *context, const uint32_t *slots, tn_error *error);

/* Shows each of those sets once, always in the same order. forbidden NULL: all slots are allowed, and sets whose lowest
 * slot is at the middle are shown. TN_MEMORY, TN_STOPPED, or what the visit says. */
tn_status tn_visit_sets(const tn_lattice *lattice, const uint8_t *forbidden, uint32_t parts, tn_watch *watch,
                        tn_slots_visit *visit, void *context, tn_error *error);

/* Those that are taken to themselves by quarter turns, so many at once (1 or 2), about any vertical. */
tn_status tn_count_turned(const tn_lattice *lattice, uint32_t parts, uint32_t turns, unsigned threads, tn_watch *watch,
                          uint64_t *count, tn_error *error);

#endif
