/* How much a module's growth sections may hold beyond what records.def says of each field, and what is measured. */
#ifndef TARTAN_GROWTH_RECORDS_H
#define TARTAN_GROWTH_RECORDS_H

#include "runtime/module/values.h"

#define TN_NO_LABEL TN_NO_RECORD
#define TN_LABELS_MAX 32767u       /* labels of one system: a label is 15 bits of an edge's state */
#define TN_TEMPLATES_MAX 65000u    /* successors of one system: 16 bits of what replaces an edge */
#define TN_AXIOM_MAX 100000u       /* edges of a seed */
#define TN_SURROUNDINGS_MAX 10000u /* forces, and boundaries, of one environment */

/* What becomes of an age, as a file writes it behind an edge's name. */
extern const char *const tn_age_suffixes[TN_AGE_CHANGE_COUNT];

/* What goals and requirements can ask for: the terms, counts, and whether the surface can be built. */
typedef enum tn_measured {
    TN_MEASURED_VERTICES = TN_FITNESS_TERM_COUNT,
    TN_MEASURED_EDGES,
    TN_MEASURED_FACES,
    TN_MEASURED_WIDTH, /* from here on: what is measured where it is asked for (soundness.h) */
    TN_MEASURED_DEPTH,
    TN_MEASURED_HEIGHT,
    TN_MEASURED_AREA,
    TN_MEASURED_VOLUME,
    TN_MEASURED_PLANARITY,
    TN_MEASURED_WORST_PLANARITY,
    TN_MEASURED_EDGE_SPREAD,
    TN_MEASURED_SMALLEST_ANGLE,
    TN_MEASURED_SPAN,
    TN_MEASURED_CROSSED_FACES,
    TN_MEASURED_TURNED_FACES,
    TN_MEASURED_CROSSINGS,
    TN_MEASURED_SUNLIT,
    TN_MEASURED_DISTANCE_TO,
    TN_MEASURED_COUNT
} tn_measured;

/* As studies write them. */
extern const char *const tn_measured_names[TN_MEASURED_COUNT];

#define TN_EXPRESSIONS_MAX 64u /* named fitness expressions of one study */

#endif
