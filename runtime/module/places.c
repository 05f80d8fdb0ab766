/* Finds where in the source an instruction comes from. */
#include "runtime/module/module.h"

/* The function whose code holds the offset; functions' code is contiguous and in their order. */
static const tn_function_record *function_at(const tn_module *module, uint32_t offset)
{
    size_t low = 0, high = module->FUNCTION_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (module->FUNCTION_records[middle].code_end <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low < module->FUNCTION_count ? &module->FUNCTION_records[low] : NULL;
}

const tn_source_map_record *tn_module_place(const tn_module *module, uint32_t offset)
{
    const tn_function_record *function = function_at(module, offset);
    size_t low = 0, high = module->SOURCE_MAP_count; /* how many records lie at or before the offset */
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (module->SOURCE_MAP_records[middle].offset <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    if (!function || low == 0 || module->SOURCE_MAP_records[low - 1].offset < function->code_begin)
        return NULL;
    return &module->SOURCE_MAP_records[low - 1];
}
