/* Numbers about a map: counts by label, age and face size, and the fitness terms ("Genr8", 5.3; docs/growth.md). */
#ifndef TARTAN_GROWTH_STATS_H
#define TARTAN_GROWTH_STATS_H

#include "runtime/growth/growth.h"

typedef struct tn_age_count {
    uint32_t label; /* index into the system's labels */
    int32_t age;
    uint64_t count;
} tn_age_count;

typedef struct tn_size_count {
    uint32_t sides;
    uint64_t count;
} tn_size_count;

/* The fitness terms, each as measured (none is a target or a weight). */
typedef struct tn_fitness {
    double size;                /* extent in x plus extent in y */
    double smoothness;          /* sum over edges of the difference in z: larger is rougher */
    double soft_boundary_nodes; /* vertices on the wrong side of a soft boundary */
    double subdivisions;        /* vertices / edges */
    double symmetry;            /* mean over x and y of the ratio of vertices on either side of their mean */
    double undulation;          /* extent in z */
    double vertices, edges, faces;
    double further[TN_MEASURED_COUNT - TN_MEASURED_WIDTH]; /* tn_soundness_measure fills in what is asked for; else 0 */
} tn_fitness;

typedef struct tn_stats {
    uint32_t step;
    uint64_t vertices, edges, faces; /* without the outer face */
    uint64_t *labels;                /* [label of the system] */
    tn_age_count *ages;              /* by label, then age; no zeros */
    size_t age_count;
    tn_size_count *sides; /* ascending; no zeros */
    size_t side_count;
    double low[3], high[3]; /* bounding box */
    tn_fitness fitness;
} tn_stats;

/* Measures a growth as it stands. Free with tn_stats_clear in any case. */
tn_status tn_stats_measure(const tn_growth *growth, tn_stats *stats, tn_error *error);
void tn_stats_clear(tn_stats *stats);

/* The fitness terms alone, which is much less work. */
tn_fitness tn_fitness_measure(const tn_growth *growth);

/* The targets that a growth is measured against. A term counts where it is wanted; soft boundaries' target is 0. */
typedef struct tn_fitness_goal {
    bool wanted[TN_FITNESS_TERM_COUNT];
    double target[TN_FITNESS_TERM_COUNT];
    double weight[TN_FITNESS_TERM_COUNT];
    bool raw; /* the sum of weight times value, as the paper prints it, rather than of the distances to the targets */
    struct tn_named_goal *named; /* expressions; owned by the study */
    uint32_t named_count;
    struct tn_named_goal *required; /* how far each requirement is from holding; owned by the study; no names */
    uint32_t required_count;
    double requirement_weight; /* of what they lack, in the sum */
    uint64_t asked;            /* a bit for each tn_measured that an expression or requirement needs */
} tn_fitness_goal;

typedef struct tn_named_goal {
    const char *name;    /* borrowed from the module, as is the code */
    const uint8_t *code; /* of the module */
    uint32_t offset;
    double target, weight;
} tn_named_goal;

double tn_fitness_value(const tn_fitness *fitness, tn_measured term);

/* All that expressions speak of; terms that were not measured are what they are in `fitness`. */
void tn_fitness_terms(const tn_fitness *fitness, double terms[TN_MEASURED_COUNT]);
const char *tn_fitness_term_name(tn_measured term);

/* The value of a named expression; not finite where it has none. */
double tn_named_value(const tn_named_goal *goal, const tn_fitness *fitness);

/* How far the requirements are from holding, together, each distance as a share of its bound's size or of 1: 0 where
 * all hold; not finite where one has no value. */
double tn_fitness_lacking(const tn_fitness *fitness, const tn_fitness_goal *goals);

/* What one goal adds to the sum: `goal` counts the terms, then the named ones. 0 if the term is not wanted. */
double tn_fitness_part(const tn_fitness *fitness, const tn_fitness_goal *goals, uint32_t goal, double start_length);

/* The sum over wanted terms and expressions of weight * |value - target| / max(|target|, unit), to be made small; the
 * unit is 1, or the seed's side for the size. With `raw`: the sum of weight * value. What the requirements lack is
 * added, requirement_weight times. */
double tn_fitness_total(const tn_fitness *fitness, const tn_fitness_goal *goals, double start_length);

#endif
