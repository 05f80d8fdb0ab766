/* The layers of slices, and what is owned by them. */
#include "runtime/slices/slices.h"

#include <math.h>
#include <stdlib.h>

#define LAYERS_MAX 1000000u

void tn_slices_clear(tn_slices *slices)
{
    free(slices->points);
    free(slices->line_first);
    free(slices->layer_first);
    free(slices->heights);
    *slices = (tn_slices){0};
}

tn_status tn_slices_layers(double low, double high, double thickness, tn_slices *slices, tn_error *error)
{
    double layers = ceil((high - low) / thickness - 1e-9);
    *slices = (tn_slices){0};
    if (!(thickness > 0) || !(layers >= 1) || layers > LAYERS_MAX) {
        tn_fail(error, TN_INVALID, E_FIELD_LAYER, "layers %.6g high do not fill a box %.6g high", thickness,
                high - low);
        tn_error_help(error, "--layer takes a height above 0 that gives at most %u layers", LAYERS_MAX);
        return TN_INVALID;
    }
    slices->layer_count = (size_t)layers;
    slices->heights = calloc(slices->layer_count, sizeof *slices->heights);
    slices->layer_first = calloc(slices->layer_count + 1, sizeof *slices->layer_first);
    if (!slices->heights || !slices->layer_first)
        return tn_fail_memory(error);
    for (size_t i = 0; i < slices->layer_count; i++) /* the last layer may be lower */
        slices->heights[i] =
            fmin(low + ((double)i + 0.5) * thickness, 0.5 * (low + (double)i * thickness) + 0.5 * high);
    return TN_OK;
}
