/* The summary of a model, as text. */
#include <inttypes.h>
#include <stdlib.h>

#include "cli/place/place.h"

tn_status tn_place_summary(const tn_placed_model *model, FILE *out, tn_error *error)
{
    tn_part_count *counts;
    size_t kinds;
    tn_status status = tn_place_count_parts(model, &counts, &kinds, error);
    if (status != TN_OK)
        return status;
    fprintf(out, "%zu part%s\n", model->count, model->count == 1 ? "" : "s");
    for (size_t i = 0; i < kinds; i++)
        fprintf(out, "%8" PRIu64 "  %s in colour %d\n", counts[i].count, counts[i].name, counts[i].colour);
    free(counts);
    return TN_OK;
}
