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
 * on the lattice of what the model's rule places first where it starts. E1338 if it places none of the wanted parts
 * there. Otherwise as above. */
tn_status tn_count_inside(const tn_place_rules *rules, const bool *wanted, uint32_t parts, unsigned threads,
                          tn_watch *watch, uint64_t *count, tn_error *error);

/* A set of slots: the lowest first, then as it grew. Anything but TN_OK ends the walk. */
typedef tn_status tn_slots_visit(void *context, const uint32_t *slots, tn_error *error);

/* Those that are taken to themselves by quarter turns, so many at once (1 or 2), about any vertical. */
tn_status tn_count_turned(const tn_lattice *lattice, uint32_t parts, uint32_t turns, unsigned threads, tn_watch *watch,
                          uint64_t *count, tn_error *error);

/* Listing the buildings that count.h counts: each once, always in the same order, in memory that does not grow with
 * their number. */

typedef enum tn_buildings_kind {
    TN_BUILDINGS_TURNED, /* those that differ by a turn about the vertical are one */
    TN_BUILDINGS_FIXED,  /* each turn of it is another */
    TN_BUILDINGS_INSIDE, /* where they stand, inside of the space of the rules' model */
} tn_buildings_kind;

/* A building: its parts from the lowest up, and in a layer from back to front and right to left. The first stands at
 * the origin, but for those inside of a space. Colours are those of models that name none. The model is borrowed for
 * the call. Anything but TN_OK ends the list. */
typedef tn_status tn_building_visit(void *context, const tn_placed_model *model, tn_error *error);

typedef struct tn_building_list {
    const tn_place_rules *rules; /* with a space for INSIDE alone */
    const bool *wanted;          /* as in tn_count_buildings */
    uint32_t parts;              /* 1 to TN_COUNT_PARTS_MAX */
    tn_buildings_kind kind;
    tn_building_visit *visit;
    void *context;
} tn_building_list;

/* TN_MEMORY, TN_STOPPED, TN_LIMIT (E1313), E1338 as in count.h, or what the visit says. */
tn_status tn_list_buildings(const tn_building_list *list, tn_watch *watch, tn_error *error);

#endif
