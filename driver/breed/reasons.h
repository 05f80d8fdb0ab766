/* Why individuals of a generation have no score, each reason once. */
#ifndef TARTAN_DRIVER_BREED_REASONS_H
#define TARTAN_DRIVER_BREED_REASONS_H

#include "driver/breed/evolve.h"

#define TN_REASONS_MAX 32u /* reasons that are told apart; what else there is counts as the last */

typedef struct tn_reason {
    char text[200];
    tn_score_state state;
    uint32_t count;
    uint64_t first; /* the lowest id of them */
} tn_reason;

/* The most frequent first. */
typedef struct tn_reasons {
    tn_reason items[TN_REASONS_MAX];
    size_t count;
} tn_reasons;

/* Of the members that failed or passed a limit. Messages are not stored with scores that are known already: such a
 * sentence is evaluated once more, if the database does not say why either. TN_OK, or what went wrong. */
tn_status tn_run_reasons(const tn_run *run, tn_reasons *reasons, tn_error *error);

#endif
