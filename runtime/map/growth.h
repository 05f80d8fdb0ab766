/* Growing a surface: a rewrite system, an environment and options, one derivation step after another.
 *
 * A growth borrows its system and environment and belongs to one thread at a time (it uses several inside). The same
 * inputs give the same bytes at any number of threads. After a failed step the map is not usable: grow again to the
 * last complete step (tn_growth_regrow), which costs less memory than a copy kept at hand.
 *
 * Source: "Genr8" paper, section 4.3; docs/growth.md.
 */
#ifndef TARTAN_MAP_GROWTH_H
#define TARTAN_MAP_GROWTH_H

#include "runtime/map/environment.h"
#include "runtime/map/map.h"

typedef struct tn_growth_options {
    double scale[3];       /* factor of each step, by axis; > 0 */
    double start[3];       /* centre of the seed */
    double start_length;   /* side of the seed; > 0 */
    double branch_angle;   /* degrees; negative: the system's own */
    double branch_length;  /* of joins, in multiples of start_length times the mean scale to the power of the step;
                              negative: any */
    bool fixed_centre;     /* scale about the start rather than about the mean of the vertices */
    bool fixed_perimeter;  /* vertices of the outline stay */
    bool facing;           /* branches join only where each points towards the other */
    bool mirror;           /* '+' turns right, as in files of Genr8 */
    bool explain;          /* count why branches did not join */
    uint64_t seed;         /* of weighted rules */
    uint64_t edge_limit;   /* most edges; 0: TN_EDGES_MAX */
    uint64_t memory_limit; /* most bytes; 0: none */
    int threads;           /* 0: as many as the machine has */
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

typedef struct tn_growth tn_growth;

/* The seed, ready to grow. Options are checked (TN_INVALID). */
tn_status tn_growth_new(const tn_growth_system *system, const tn_environment *environment,
                        const tn_growth_options *options, tn_growth **growth, tn_error *error);
void tn_growth_free(tn_growth *growth);

/* The seed of another growth in the memory of this one, whose map is gone: growing many surfaces one after another so
 * takes fresh memory only where one is larger than all before. After a failure it can be renewed again, or freed. */
tn_status tn_growth_renew(tn_growth *growth, const tn_growth_system *system, const tn_environment *environment,
                          const tn_growth_options *options, tn_error *error);

/* One derivation step. TN_LIMIT: more edges or memory than the options allow, an age beyond 32,767, or a coordinate
 * that is no longer finite; the map is then unusable. */
tn_status tn_growth_step(tn_growth *growth, tn_error *error);

/* Back to the seed, and `steps` steps. */
tn_status tn_growth_regrow(tn_growth *growth, uint32_t steps, tn_error *error);

const tn_map *tn_growth_map(const tn_growth *growth);
uint32_t tn_growth_steps(const tn_growth *growth);
const tn_growth_system *tn_growth_rules(const tn_growth *growth);
const tn_environment *tn_growth_surroundings(const tn_growth *growth);
const tn_growth_options *tn_growth_settings(const tn_growth *growth);
tn_growth_counts tn_growth_last_counts(const tn_growth *growth); /* of the last step */

/* Did the last step leave everything as it was, with nothing random in the system? Then no later step changes anything.
 */
bool tn_growth_at_rest(const tn_growth *growth);

#endif
