/* Finds where in the source an instruction comes from. */
#include <string.h>

#include "runtime/module/module.h"

/* The first of `count` records, `stride` bytes apart, whose code ends behind the offset: records' code is contiguous
 * and in their order. `end` is that of the first record. */
static size_t record_at(const uint32_t *end, size_t stride, size_t count, uint32_t offset)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        uint32_t its_end;
        memcpy(&its_end, (const char *)end + middle * stride, sizeof its_end);
        if (its_end <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Where the code of the function or production begins that holds the offset; false where none does. */
static bool code_begin(const tn_module *module, uint32_t offset, uint32_t *begin)
{
    const tn_function_record *functions = module->FUNCTION_records;
    const tn_production_record *productions = module->PRODUCTION_records;
    size_t count = module->FUNCTION_count, i = 0;
    if (count > 0 && (i = record_at(&functions->code_end, sizeof *functions, count, offset)) < count) {
        *begin = functions[i].code_begin;
        return true;
    }
    count = module->PRODUCTION_count;
    if (count == 0 || (i = record_at(&productions->code_end, sizeof *productions, count, offset)) == count)
        return false;
    *begin = productions[i].code_begin;
    return true;
}

const tn_source_map_record *tn_module_place(const tn_module *module, uint32_t offset)
{
    uint32_t begin;
    size_t low = 0, high = module->SOURCE_MAP_count; /* how many records lie at or before the offset */
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (module->SOURCE_MAP_records[middle].offset <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    if (!code_begin(module, offset, &begin) || low == 0 || module->SOURCE_MAP_records[low - 1].offset < begin)
        return NULL;
    return &module->SOURCE_MAP_records[low - 1];
}
