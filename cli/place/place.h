/* What `tartan place` prints: a summary, figures, and what became of each alternative. */
#ifndef TARTAN_CLI_PLACE_PLACE_H
#define TARTAN_CLI_PLACE_PLACE_H

#include <stdio.h>

#include "cli/common/job.h"
#include "runtime/place/write.h"

/* Parts by name and colour. */
tn_status tn_place_summary(const tn_placed_model *model, FILE *out, tn_error *error);

void tn_place_stats(const tn_placed_model *model, bool json, FILE *out);

/* One line about an event. */
void tn_place_trace(tn_job *job, const tn_place_rules *rules, const tn_place_event *event, FILE *out);

#endif
