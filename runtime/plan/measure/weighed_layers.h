/* The plans of a library with measures as a graph in layers (walk.h). Its context is the tn_weighed, the label of an
 * edge is a tn_weighed_edge. Only states are met from which a kept plan of the library's lengths follows. */
#ifndef TARTAN_PLAN_MEASURE_WEIGHED_LAYERS_H
#define TARTAN_PLAN_MEASURE_WEIGHED_LAYERS_H

#include "runtime/automata/walk.h"
#include "runtime/plan/measure/weighed.h"

/* Layer n: states after n trays. */
extern const tn_walk_graph tn_weighed_after;

/* Layer n: states with max - n trays to come; the walk starts in a layer for each length. */
extern const tn_walk_graph tn_weighed_to_come;

/* The number of the last layer of either. */
uint32_t tn_weighed_last_layer(const tn_weighed *weighed);

/* Does a plan that is kept and has a value of each measure end in the state? */
bool tn_weighed_ends(const tn_weighed *weighed, uint32_t state);

#endif
