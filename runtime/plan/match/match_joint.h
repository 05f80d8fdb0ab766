/* Automata walked by table look-ups, for every processor.
 *
 * Small rules are joined: the product of some rules, each state with the bits of the rules that match there, takes one
 * look-up a tray for all of them. Rules join as long as the table stays in half of a first-level cache, with states of
 * one byte; the ten rules of the benchmark make a few such tables, and so a few look-ups a tray instead of ten. A table
 * is indexed by row and state, so that all the automata share the rows' addresses.
 *
 * A rule too large for that is walked alone, over columns of its own (a look-up more a tray, but a table that does not
 * grow with the other rules' classes).
 */
#ifndef TARTAN_PLAN_MATCH_MATCH_JOINT_H
#define TARTAN_PLAN_MATCH_MATCH_JOINT_H

#include "runtime/plan/match/match_lanes.h"

typedef struct tn_joint {
    uint32_t word; /* of the result; all of its rules have their bits in it */
    uint8_t width; /* bytes of a table entry: 1: joined, table[row << shift | state]; 2 and 4: alone,
                      table[state + column[row]] with states premultiplied */
    uint8_t shift;
    void *table;
    uint32_t *column; /* [rows + 1], of a rule alone */
    uint64_t *bits;   /* [states], by state or its premultiplied number: the rules that match there */
} tn_joint;

typedef struct tn_joints {
    tn_joint *items;
    size_t count;
} tn_joints;

/* Tables for the automata (NULL: none) that are not taken. Free with tn_joints_clear, also after a failure. */
tn_status tn_joints_make(tn_joints *joints, const tn_row_map *map, tn_dfa *const *dfas, size_t count, const bool *taken,
                         tn_error *error);
void tn_joints_clear(tn_joints *joints);

/* Adds the bits of its rules to bits[lane * words + word]. */
void tn_joint_walk(const tn_joint *joint, const tn_lanes *lanes, uint64_t *bits, size_t words);

#endif
