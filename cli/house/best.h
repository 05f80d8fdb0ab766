/* The best houses of a library, or on one plan, by measures; and the best trade-offs. */
#ifndef TARTAN_CLI_HOUSE_BEST_H
#define TARTAN_CLI_HOUSE_BEST_H

#include "cli/house/houses.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/complete.h"

/* plan: a plan line or #P; NULL: all plans. wanted: how many houses, for the best. */
typedef struct tn_house_wishes {
    const char *plan;
    uint32_t count;
    const char *names[TN_WEIGHED_MAX];
    bool most[TN_WEIGHED_MAX];
    uint64_t wanted;
    bool json;
    const char *output;
} tn_house_wishes;

/* Writes the lines of the best houses, each below its values. */
void tn_job_best_houses(tn_job *job, const tn_house_settings *settings, const tn_house_wishes *wishes);

/* Writes the values that no house betters in one measure without losing in another, how many houses have them, and the
 * first of these by rank. */
void tn_job_front_of_houses(tn_job *job, const tn_house_settings *settings, const tn_house_wishes *wishes);

/* The houses that complete an open plan. measure: NULL where none was wished for. */
typedef struct tn_house_completed {
    const tn_schema *schema;
    const tn_house_library_record *library;
    const tn_open_plan *open;
    const tn_completions *found;
    const char *measure;
    bool most;
    mpq_srcptr step; /* in nanometres to the measure's power */
    tn_amount_unit unit;
} tn_house_completed;

/* Counts them, and calls `show`. wishes: none or one measure. */
void tn_job_complete_houses(tn_job *job, const tn_house_settings *settings, const tn_house_wishes *wishes,
                            const tn_open_plan *open, void show(tn_job *job, const tn_house_completed *completed));

#endif
