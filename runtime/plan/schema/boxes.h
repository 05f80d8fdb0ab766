/* A set of trays as a person would say it: products of values ("width 4' 8', not great"). */
#ifndef TARTAN_PLAN_SCHEMA_BOXES_H
#define TARTAN_PLAN_SCHEMA_BOXES_H

#include "runtime/plan/schema/schema.h"

/* Boxes whose legal trays together are exactly those that are `in` ([trays]). A box is a specifier's words
 * (schema->mask_words of them): a bit for each value that its trays may have. Each box is as large as it can be, the
 * first fields first; they may overlap. The caller frees *boxes. */
tn_status tn_tray_boxes(const tn_schema *schema, const bool *in, uint64_t **boxes, size_t *count, tn_error *error);

/* Is the tray in the box? */
static inline bool tn_box_has(const tn_schema *schema, const uint64_t *box, tn_tray tray)
{
    const uint64_t *mask = tn_tray_mask(schema, tray);
    for (uint32_t w = 0; w < schema->mask_words; w++)
        if (mask[w] & ~box[w])
            return false;
    return true;
}

static inline bool tn_box_has_value(const uint64_t *box, uint32_t value)
{
    return box[value / 64] >> (value % 64) & 1;
}

#endif
