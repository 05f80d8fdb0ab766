/* Describes sets of trays as boxes of values. */
#include "runtime/plan/schema/boxes.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* Lets a field have every value that brings in no tray but those that are `in`. */
static void widen(const tn_schema *schema, const bool *in, uint64_t *box, uint32_t field)
{
    bool brings_others[TN_FIELD_VALUES_MAX] = {false};
    uint32_t first = schema->value_start[field], end = schema->value_start[field + 1];
    for (uint32_t v = first; v < end; v++)
        box[v / 64] |= UINT64_C(1) << (v % 64);
    for (tn_tray t = 0; t < schema->tray_count; t++)
        if (!in[t] && tn_box_has(schema, box, t))
            brings_others[tn_tray_value(schema, t, field)] = true;
    for (uint32_t v = first; v < end; v++)
        if (brings_others[v - first])
            box[v / 64] &= ~(UINT64_C(1) << (v % 64));
}

tn_status tn_tray_boxes(const tn_schema *schema, const bool *in, uint64_t **boxes, size_t *count, tn_error *error)
{
    size_t words = schema->mask_words, room = 0;
    bool *covered = calloc((size_t)schema->tray_count + 1, sizeof *covered);
    tn_status status = covered ? TN_OK : tn_fail_memory(error);
    *boxes = NULL;
    *count = 0;
    for (tn_tray t = 0; status == TN_OK && t < schema->tray_count; t++) {
        if (!in[t] || covered[t])
            continue;
        if (!tn_array_reserve_from(boxes, &room, 8, *count, 1, words * sizeof **boxes)) {
            status = tn_fail_memory(error);
            break;
        }
        uint64_t *box = *boxes + (*count)++ * words;
        memcpy(box, tn_tray_mask(schema, t), words * sizeof *box);
        for (uint32_t f = 0; f < schema->field_count; f++)
            widen(schema, in, box, f);
        for (tn_tray u = t; u < schema->tray_count; u++)
            covered[u] = covered[u] || tn_box_has(schema, box, u);
    }
    free(covered);
    if (status == TN_OK)
        return TN_OK;
    free(*boxes);
    *boxes = NULL;
    return status;
}
