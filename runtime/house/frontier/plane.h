/* The plane between two trays while its outcomes are found: plane.c goes through what can be in its faces, part.c says
 * what comes of that in a storey, outcome.c in the whole plane. */
#ifndef TARTAN_HOUSE_FRONTIER_PLANE_H
#define TARTAN_HOUSE_FRONTIER_PLANE_H

#include "runtime/house/frontier/parts.h"

/* Words of what comes of a part: the meetings (two words), the number of steps and STEP_WORDS for each, then for each
 * cell of its storeys its place and SIDE_WORDS; then, where costs are asked for, the number of the plane's. */
enum { PART_MEETINGS, PART_STEPS = PART_MEETINGS + 2 };

/* What comes of its faces, of `parts`, and of how many choices. */
typedef struct tn_plane_found {
    uint32_t part;
    uint64_t times;
} tn_plane_found;

/* Outcomes of the plane are the combinations of what its parts have. */
typedef struct tn_plane_part {
    uint64_t storeys; /* a bit each */
    tn_plane_found *found;
    size_t count, room;
    size_t at; /* of found: where a combination is at */
} tn_plane_part;

/* The house of the two trays. */
typedef struct tn_plane_house {
    tn_strip *strip;
    uint32_t left, right; /* edges, or TN_STRIP_NONE */
    uint32_t left_cells;  /* those of the left edge come first */
    bool has_left, has_right;
    tn_house house;
    uint32_t *faces; /* those in the plane */
    size_t count;
    tn_room_open *open; /* [cells]: of the rooms that they are in */
    uint32_t *sides;    /* [cells][SIDE_WORDS] */
    uint64_t changed;   /* storeys of whose faces one has another kind than when sides were found */
    int64_t x;
    tn_plane_part *parts;
    size_t part_count;
    tn_key words; /* scratch */
    tn_numbering found;
    tn_strip_list *list;
    tn_strip_ordered *ordered; /* where these are wanted, and no list */
} tn_plane_house;

static inline bool tn_plane_part_has(const tn_plane_part *part, uint32_t storey)
{
    return part->storeys >> storey & 1;
}

/* Numbers what comes of the part's faces as they are: of `parts`. */
tn_status tn_plane_number_part(tn_plane_house *plane, const tn_plane_part *part, uint32_t *number, tn_error *error);

/* The outcome that parts (of `parts`) have together. */
tn_status tn_plane_find_outcome(tn_plane_house *plane, const uint32_t *parts, size_t count, uint32_t *outcome,
                                tn_error *error);

/* The same for all parts of the plane, which may have been met together; parts: their numbers, then that of the cells
 * at the left. */
tn_status tn_plane_know_outcome(tn_plane_house *plane, const tn_key *parts, uint32_t *outcome, tn_error *error);

#endif
