/* What the numbers in a module's growth sections mean (records.def), and how large they may be. */
#ifndef TARTAN_GROWTH_RECORDS_H
#define TARTAN_GROWTH_RECORDS_H

#include <stdint.h>

#define TN_NO_LABEL UINT32_MAX
#define TN_LABELS_MAX 32767u        /* labels of one system: a label is 15 bits of an edge's state */
#define TN_TEMPLATES_MAX 65000u     /* successors of one system: 16 bits of what replaces an edge */
#define TN_TEMPLATE_ITEMS_MAX 4096u /* segments, and branches, of one successor */
#define TN_AXIOM_MAX 100000u        /* edges of a seed */
#define TN_CHAIN_MAX 64u            /* edges of a predecessor */
#define TN_STEPS_MAX 100000u
#define TN_COORDINATE_MAX 1e12     /* of anything in a rewrite system or an environment */
#define TN_SURROUNDINGS_MAX 10000u /* forces, and boundaries, of one environment */

/* What becomes of the age i of the replaced edge: Edge0, Edge0_i, Edge0_i+1, Edge0_i-1. */
typedef enum tn_age_change { TN_AGE_ZERO, TN_AGE_KEEP, TN_AGE_MORE, TN_AGE_LESS, TN_AGE_CHANGE_COUNT } tn_age_change;

typedef enum tn_side { TN_SIDE_NONE, TN_SIDE_LEFT, TN_SIDE_RIGHT, TN_SIDE_COUNT } tn_side;

/* When an alternative applies: always, or where the age is below, above or equal to its bound. */
typedef enum tn_comparison { TN_ALWAYS, TN_AGE_BELOW, TN_AGE_ABOVE, TN_AGE_EQUALS, TN_COMPARISON_COUNT } tn_comparison;

/* Flags of a study. */
#define TN_STUDY_FIXED_CENTRE 1u
#define TN_STUDY_FIXED_PERIMETER 2u
#define TN_STUDY_FACING 4u
#define TN_STUDY_MIRROR 8u
#define TN_STUDY_RAW_FITNESS 16u
#define TN_STUDY_FLAGS 31u

typedef enum tn_force_kind { TN_ATTRACTOR, TN_REPELLER, TN_GRAVITY, TN_FORCE_KIND_COUNT } tn_force_kind;

typedef enum tn_boundary_kind {
    TN_BOUNDARY_PLANE,
    TN_BOUNDARY_BOX,
    TN_BOUNDARY_SPHERE,
    TN_BOUNDARY_MESH,
    TN_BOUNDARY_KIND_COUNT
} tn_boundary_kind;

/* What becomes of a vertex that meets a boundary. */
typedef enum tn_boundary_mode {
    TN_SLIDE, /* it goes on along the boundary */
    TN_STOP,  /* it stays where it met it */
    TN_SOFT,  /* it passes, and counts in the fitness term of soft boundaries */
    TN_BOUNDARY_MODE_COUNT
} tn_boundary_mode;

typedef enum tn_fitness_term {
    TN_TERM_SIZE,
    TN_TERM_SMOOTHNESS,
    TN_TERM_SOFT_BOUNDARY,
    TN_TERM_SUBDIVISIONS,
    TN_TERM_SYMMETRY,
    TN_TERM_UNDULATION,
    TN_FITNESS_TERM_COUNT
} tn_fitness_term;

/* What fitness expressions can ask for: the terms, and counts. */
typedef enum tn_measured {
    TN_MEASURED_VERTICES = TN_FITNESS_TERM_COUNT,
    TN_MEASURED_EDGES,
    TN_MEASURED_FACES,
    TN_MEASURED_COUNT
} tn_measured;

/* As studies write them. */
extern const char *const tn_measured_names[TN_MEASURED_COUNT];

#define TN_EXPRESSIONS_MAX 64u    /* named fitness expressions of one study */
#define TN_MEASURE_STACK_MAX 256u /* numbers that evaluating one holds at once */

#endif
