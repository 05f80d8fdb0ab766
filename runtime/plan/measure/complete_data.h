/* What the files of open plans share: the pattern made ready, and what is found out about each place of the plans. */
#ifndef TARTAN_PLAN_MEASURE_COMPLETE_DATA_H
#define TARTAN_PLAN_MEASURE_COMPLETE_DATA_H

#include "runtime/automata/numbering.h"
#include "runtime/automata/walk.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/complete.h"

/* A run of written trays without a gap between them. */
typedef struct tn_open_segment {
    uint32_t first, count;
    bool floats; /* after a gap, and not bound to the plan's end */
} tn_open_segment;

typedef struct tn_completer {
    const tn_library *library;
    tn_weighed *weighed; /* whose states take the place of the library's; or NULL */
    int64_t sign;        /* that makes less better */
    uint32_t items;
    tn_open_segment segments[TN_PATTERN_MAX + 1];
    uint32_t segment_of[TN_PATTERN_MAX + 1];
    uint32_t segment_count;
    bool gap_first, gap_last;
    uint64_t *fits;      /* [trays]: bit i: the tray fits written tray i */
    uint32_t *letter_of; /* [trays] */
    uint32_t letters;
    tn_tray *first;       /* [letters] */
    uint64_t *size;       /* [letters] */
    tn_interner states;   /* {library's state, placed, gap, earlier in two words} */
    tn_layers walk;       /* by trays before; forwards: plans until there, backwards: plans from there */
    mpz_t *placed;        /* [items][letters]: plans in which such a tray is placed there */
    int64_t *best_placed; /* the same of the measure; WORST if there is none */
} tn_completer;

/* Reads the pattern, and which trays fit which of its places (complete_pattern.c). */
tn_status tn_completer_read(tn_completer *c, const tn_open_plan *open, tn_error *error);

/* Is there a gap before the written tray? */
bool tn_completer_gap_before(const tn_completer *c, uint32_t item);

/* Where the machine that places written trays is: so many placed; in the gap before the next run; runs that started
 * earlier, bit k: k + 1 of their trays have been met. */
typedef struct tn_machine {
    uint32_t placed;
    bool gap;
    uint64_t earlier;
} tn_machine;

/* One way on: the machine after it, and whether the tray read is a written one. */
typedef struct tn_machine_way {
    tn_machine to;
    bool places;
} tn_machine_way;

tn_machine tn_machine_start(const tn_completer *c);

/* The ways on with a tray that fits so: at most two. */
size_t tn_machine_ways(const tn_completer *c, tn_machine m, uint64_t fits, tn_machine_way ways[2]);

void tn_completer_clear_pattern(tn_completer *c);

#endif
