/* Houses that differ as people see it: first in their plans, then in storeys and roofs, then in what the rooms are for,
 * then in doors and windows, and last in what stands in the rooms. Houses are compared by their lines. */
#ifndef TARTAN_ASK_HOUSE_DIVERSE_H
#define TARTAN_ASK_HOUSE_DIVERSE_H

#include "runtime/base/error.h"
#include "runtime/house/rank/rank.h"

/* The most houses: each is held against all before it. */
#define TN_DIVERSE_HOUSES_MAX 500u

/* The lines of houses that were taken; owned. Free with tn_lines_taken_clear. */
typedef struct tn_lines_taken {
    char **items;
    size_t count, room;
} tn_lines_taken;
void tn_lines_taken_clear(tn_lines_taken *taken);

/* *differs: the house differs from each that was taken in its plan (alike: PLAN), in that or its section (SECTION), and
 * so on. If it does, it is taken. */
tn_status tn_lines_take(tn_lines_taken *taken, const tn_house *house, tn_house_alike alike, bool *differs,
                        tn_error *error);

/* Chooses so many of the lines, or all if there are fewer: the one of that number is the first; each next is the one
 * whose least distance from those chosen is greatest, of equal ones the first. Distances are compared part by part: how
 * many words of the plan differ (of a tray that only one has: all), then of the section, how many functions only one
 * has, how many stand elsewhere, then of the faces, then of the tiles. chosen: [lines], false to begin with. */
tn_status tn_lines_choose(const char *const *lines, size_t count, size_t first, size_t wanted, bool *chosen,
                          tn_error *error);

#endif
