/* In how many ways the plans of a projected library come about: how many plans of the other library are each of them,
 * without their newer fields. Its derivations are read as rests (rests.h): a rest is a state of the other library's
 * plans, and a letter leads to others in as many ways as newer trays do.
 */
#ifndef TARTAN_PLAN_WAYS_PROJECTED_H
#define TARTAN_PLAN_WAYS_PROJECTED_H

#include <gmp.h>

#include "runtime/automata/sparse.h"
#include "runtime/plan/schema/classes.h"

typedef struct tn_projected {
    tn_projection *projection;
    tn_classes *newer;
    tn_sparse *plans;    /* of the other library, over `newer` */
    tn_classes *letters; /* of older trays: as many newer ones of each column of `plans` lie above all trays of one */
    tn_interner above;   /* pairs: a column, and how many trays of it */
    uint32_t *above_of;  /* [letters] */
} tn_projected;

/* classes: letters are as fine as these, too; or NULL. longest: the most trays that a plan has. TN_LIMIT (E0802) if the
 * other library passes the limits. */
tn_status tn_projected_new(const tn_schema *schema, const tn_instruction *image, const tn_classes *classes,
                           uint32_t max_states, uint32_t longest, tn_projected **projected, tn_error *error);
void tn_projected_free(tn_projected *projected);

/* Of one plan, which has at most so many trays. ways: initialised; 0 if it does not come about. */
tn_status tn_projected_ways(const tn_projected *projected, const tn_tray *trays, size_t length, mpz_t ways,
                            tn_error *error);

#endif
