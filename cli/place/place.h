/* What `tartan place` and `tartan inspect` print of a model: how many parts there are of which kind. */
#ifndef TARTAN_CLI_PLACE_PLACE_H
#define TARTAN_CLI_PLACE_PLACE_H

#include <stdio.h>

#include "cli/common/job.h"
#include "runtime/place/write.h"

void tn_parts_text(const tn_placed_kind *kinds, size_t count, FILE *out);

/* The same of a model that no question was asked about. */
tn_status tn_place_summary(const tn_placed_model *model, FILE *out, tn_error *error);

#endif
