/* Reads a design from a module, and gives its cells. */
#include "runtime/solid/design.h"

#include <stdlib.h>
#include <string.h>

tn_status tn_design_read(const tn_module *module, uint32_t solid, tn_design *design, tn_error *error)
{
    const tn_solid_record *record = &module->SOLID_records[solid];
    *design = (tn_design){
        .box_count = record->box_count, .flags = record->flags, .unit = {record->unit_top, record->unit_bottom}};
    design->boxes = calloc(record->box_count + 1u, sizeof *design->boxes);
    if (!design->boxes)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < record->box_count; i++) {
        const tn_box_record *b = &module->BOX_records[record->box_first + i];
        tn_solid_box *box = &design->boxes[i];
        *box = (tn_solid_box){.low = {b->low_x, b->low_y, b->low_z},
                              .high = {b->high_x, b->high_y, b->high_z},
                              .normal = {b->normal_x, b->normal_y, b->normal_z},
                              .distance = b->planedist,
                              .rigid = b->flags & TN_BOX_RIGID,
                              .clipped = (b->flags & TN_BOX_CLIPPED) && !(record->flags & TN_SOLID_NOCLIP)};
        for (int k = 0; k < 3; k++)
            box->void_ |= !(box->high[k] > box->low[k]);
    }
    return TN_OK;
}

tn_status tn_design_copy(const tn_design *design, tn_design *copy, tn_error *error)
{
    *copy = *design;
    copy->boxes = malloc((design->box_count + 1u) * sizeof *copy->boxes);
    if (!copy->boxes)
        return tn_fail_memory(error);
    memcpy(copy->boxes, design->boxes, design->box_count * sizeof *copy->boxes);
    return TN_OK;
}

void tn_design_clear(tn_design *design)
{
    free(design->boxes);
    *design = (tn_design){0};
}

void tn_history_clear(tn_history *history)
{
    free(history->items);
    *history = (tn_history){0};
}

uint32_t tn_design_images(const tn_design *design)
{
    return 1u << __builtin_popcount(design->flags & TN_SOLID_SYMMETRY);
}

uint32_t tn_design_image(const tn_design *design, uint32_t number)
{
    uint32_t mask = 0;
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (!(design->flags & TN_SOLID_SYMMETRY_X << axis))
            continue;
        mask |= (number & 1) << axis;
        number >>= 1;
    }
    return mask;
}

void tn_design_cell(const tn_design *design, uint32_t box, uint32_t image, tn_cut_box *cell)
{
    const tn_solid_box *b = &design->boxes[box];
    if (b->void_) {
        memset(cell, 0, sizeof *cell);
        return;
    }
    tn_cut_box_clip(b->low, b->high, b->clipped ? b->normal : NULL, b->distance, cell);
    for (int axis = 0; axis < 3; axis++)
        if (image >> axis & 1)
            tn_cut_box_mirror(cell, axis);
}
