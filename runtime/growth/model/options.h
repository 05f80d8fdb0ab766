/* What a growth is told and what it counts: options, and why branches did not join. */
#ifndef TARTAN_GROWTH_MODEL_OPTIONS_H
#define TARTAN_GROWTH_MODEL_OPTIONS_H

#include "runtime/base/watch.h"

typedef struct tn_growth_options {
    double scale[3];      /* factor of each step, by axis; > 0 */
    double start[3];      /* centre of the seed */
    double start_length;  /* side of the seed; > 0 */
    double branch_angle;  /* degrees; negative: the system's own */
    double branch_length; /* of joins, in multiples of start_length times the mean scale to the power of the step;
                             negative: any */
    bool fixed_centre;    /* scale about the start rather than about the mean of the vertices */
    bool fixed_perimeter; /* vertices of the outline stay */
    bool facing;          /* branches join only where each points towards the other */
    bool mirror;          /* '+' turns right, as in files of Genr8 */
    bool interpret;       /* run the rules' code for every edge (pass/interpret.c): the same surface, more slowly */
    bool explain;         /* count why branches did not join */
    uint64_t seed;        /* of weighted rules */
    uint64_t edge_limit;  /* most edges; 0: TN_EDGES_MAX */
    int threads;          /* 0: as many as the machine has */
    tn_watch *watch;      /* or NULL: a step gives up (TN_STOPPED) once this says so, and the map is then unusable */
} tn_growth_options;

/* Scale 1.5, start at the origin with length 1, branches of any length, seed 1: the defaults of Genr8. */
tn_growth_options tn_growth_options_default(void);

/* Why branches did not join, each counted under the furthest that any partner came. */
typedef enum tn_join_failure {
    TN_FAIL_SIDE,     /* leaves along the path or straight out of the surface: no region */
    TN_FAIL_OUTER,    /* outside the surface */
    TN_FAIL_LABEL,    /* no other branch of its label in its region */
    TN_FAIL_ANGLE,    /* none that points against it closely enough */
    TN_FAIL_FACING,   /* none in front of it */
    TN_FAIL_DISTANCE, /* none near enough */
    TN_FAIL_ADJACENT, /* only at its own vertex or at one that an edge leads to already */
    TN_FAIL_TAKEN,    /* its partners joined others, or a join came between */
    TN_JOIN_FAILURE_COUNT
} tn_join_failure;

typedef struct tn_growth_counts {
    uint64_t rewrites, joins;
    uint64_t refused;                         /* shortenings that would have left a face of fewer than three edges */
    uint64_t failures[TN_JOIN_FAILURE_COUNT]; /* where options.explain */
} tn_growth_counts;

/* A growing surface; growth.h has what can be done with it. */
typedef struct tn_growth tn_growth;

#endif
