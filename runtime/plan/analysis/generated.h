/* How far a plan goes along with what a library generates: the longest beginning of it that some generated plan of the
 * library's lengths has, too, and which trays may follow there.
 */
#ifndef TARTAN_PLAN_ANALYSIS_GENERATED_H
#define TARTAN_PLAN_ANALYSIS_GENERATED_H

#include "runtime/plan/schema/schema.h"

typedef struct tn_generated_beginning {
    bool known;       /* false: finding it out would take more than the limits of automata */
    uint32_t length;  /* trays of the plan */
    bool may_end;     /* a generated plan ends there */
    uint8_t *follows; /* [trays of the schema]: 1: some generated plan goes on with it. Owned; NULL: not known */
    uint32_t count;   /* of those */
} tn_generated_beginning;

/* function: of the clause (kind HOLDS). trays_min, trays_max: of the library's plans. TN_MEMORY, TN_STOPPED; a limit is
 * no failure. Clear in any case. */
tn_status tn_generated_beginning_find(const tn_schema *schema, uint32_t function, uint32_t trays_min,
                                      uint32_t trays_max, const tn_tray *trays, size_t length,
                                      tn_generated_beginning *found, tn_error *error);
void tn_generated_beginning_clear(tn_generated_beginning *found);

#endif
