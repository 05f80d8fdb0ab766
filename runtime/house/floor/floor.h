/* The free floor of a cell: where a person can stand, and whether one can go from each of its ways in to each other.
 *
 * A person is a square, whose side is the cell's `way`, that moves without turning. It stands in the clear rectangle of
 * the cell and meets no obstacle; in a passage it may stand up to half through the side, within the passage's stretch.
 * The places of its middle are the free floor: a closed set, so that it passes a gap of exactly its own side. The edges
 * of all that is there cut the plane into points, open segments and open rectangles; of each, either all is free or
 * nothing. Free ones that touch are of one part. So the answers are exact.
 *
 * A floor borrows what it is made of. An answer owns its arrays: clear it in any case.
 */
#ifndef TARTAN_HOUSE_FLOOR_FLOOR_H
#define TARTAN_HOUSE_FLOOR_FLOOR_H

#include <stddef.h>

#include "runtime/base/error.h"
#include "runtime/house/floor/rectangle.h"
#include "runtime/module/values.h"

/* A door or a gap in a wall; a side where no wall is; such a side before which a flight of stairs ends, so that one
 * comes to it by the flight. */
typedef enum tn_passage_kind { TN_PASSAGE_DOOR, TN_PASSAGE_OPEN, TN_PASSAGE_MET } tn_passage_kind;

/* from, to: its stretch along the side, at least as long as `way`. */
typedef struct tn_passage {
    tn_house_side side;
    tn_passage_kind kind;
    int64_t from, to;
} tn_passage;

/* way: an even number of nanometres. landings: where flights begin and end. leaves: what doors sweep that open into the
 * cell. in_air: holes and stairs, over which no leaf opens, even if a person may go below. */
typedef struct tn_floor {
    int64_t way;
    tn_rectangle clear;
    const tn_rectangle *obstacles, *keeps, *leaves, *landings, *in_air;
    size_t obstacle_count, keep_count, leaf_count, landing_count, in_air_count;
    const tn_passage *passages;
    size_t passage_count;
} tn_floor;

/* The places of a person's middle in a passage: on the side, and (the gate) from there inwards by half of the way. */
tn_rectangle tn_floor_points(const tn_floor *floor, const tn_passage *passage);
tn_rectangle tn_floor_gate(const tn_floor *floor, const tn_passage *passage);

/* Can a person stand in the clear rectangle at all, but for obstacles? */
bool tn_floor_has_room(const tn_floor *floor);

/* What is wrong first; of: a passage or, behind these, a landing; a keep; a leaf. */
typedef enum tn_floor_fault {
    TN_FLOOR_FITS,
    TN_FLOOR_SHUT,  /* nobody can stand in the passage, or on the landing */
    TN_FLOOR_APART, /* no way leads from the first of the passages and landings to it */
    TN_FLOOR_KEEP,  /* one cannot stand at what is kept free */
    TN_FLOOR_LEAF   /* it meets something, or another leaf */
} tn_floor_fault;

/* parts: of the free floor, numbered from the left to the right, in each column from the back to the front. */
typedef struct tn_floor_answer {
    uint32_t parts;
    size_t words;     /* of a set of parts, a bit each */
    uint64_t *joined; /* [passages, then landings][words] the parts that it touches */
    bool *keeps;      /* reached from what is joined */
    bool *leaves;     /* has room */
    bool ways,
        fits; /* ways: all passages and landings are joined, and all keeps reached. fits: leaves have room, too */
    tn_floor_fault fault;
    size_t of;
} tn_floor_answer;

/* TN_MEMORY. */
tn_status tn_floor_ask(const tn_floor *floor, tn_floor_answer *answer, tn_error *error);
void tn_floor_answer_clear(tn_floor_answer *answer);

/* How far a person comes on a floor that does not fit: over the ground, which is what the square covers on its ways
 * from all that is joined before the fault, in rectangles that are apart; then it stands at `square`, the place nearest
 * to what is missed: the stretch of a passage, a landing, a keep or a leaf. stands: false if nobody comes in at all;
 * then the square is where the passage or landing would have it. Of a leaf only that is told. */
typedef struct tn_floor_stop {
    tn_rectangle *ground;
    size_t ground_count;
    bool stands;
    tn_rectangle square, missed;
    int64_t short_by; /* from the square's place to one that would do, rounded up */
} tn_floor_stop;

/* answer: of that floor, with a fault. TN_MEMORY. Clear it in any case. */
tn_status tn_floor_stop_find(const tn_floor *floor, const tn_floor_answer *answer, tn_floor_stop *stop,
                             tn_error *error);
void tn_floor_stop_clear(tn_floor_stop *stop);

/* Can a person go from each keep to each other, wherever one comes in? *keep: the first that is not joined with those
 * before it; SIZE_MAX: there is none. TN_MEMORY. */
tn_status tn_floor_keeps_joined(const tn_floor *floor, size_t *keep, tn_error *error);

/* Does the leaf have room? */
bool tn_floor_leaf_has_room(const tn_floor *floor, size_t leaf);

/* Does the cell fit? */
tn_status tn_floor_fits(const tn_floor *floor, bool *fits, tn_error *error);

#endif
