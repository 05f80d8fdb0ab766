/* Projection: which plans of a schema lie below a plan that meets the clauses of a library of a newer schema. As an
 * automaton, for all plans at once; and searched for above one plan (image_search.h).
 */
#ifndef TARTAN_PLAN_MATCH_IMAGE_H
#define TARTAN_PLAN_MATCH_IMAGE_H

#include "runtime/automata/dfa.h"
#include "runtime/plan/schema/classes.h"

typedef struct tn_image_options {
    uint32_t max_states; /* of the automata of a clause */
    uint32_t max_trays;  /* of the plans that automata are asked about, and may be wrong of longer ones; 0: of any */
    bool reversed;       /* of the plans turned round */
} tn_image_options;

/* The automata of the clauses of a projection's library over the newer classes (tn_classes_above): an array of them, to
 * be freed with tn_image_clauses_free. TN_LIMIT (E0802) names the clause. */
tn_status tn_image_clauses(const tn_projection *projection, const tn_classes *newer, const tn_image_options *options,
                           tn_dfa ***clauses, tn_error *error);
void tn_image_clauses_free(const tn_projection *projection, tn_dfa **clauses);

/* The minimal automaton, over the classes, of the plans that an IMAGE holds of. The library's clauses are put together
 * over the newer trays; then each edge is read as the trays below it, and sets of states are followed. */
tn_status tn_image_lower(const tn_classes *classes, const tn_instruction *image, const tn_image_options *options,
                         tn_dfa **out, tn_error *error);

#endif
