/* What operands are, and where in the source an instruction comes from. */
#include "runtime/module/code.h"

#include "runtime/module/records.h"

/* ---- the operands of each kind */

#define SLOT_NOTHING                                                                                                   \
    {                                                                                                                  \
        .kind = TN_SLOT_NOTHING                                                                                        \
    }
#define SLOT_U32                                                                                                       \
    {                                                                                                                  \
        .kind = TN_SLOT_U32                                                                                            \
    }
#define SLOT_I64                                                                                                       \
    {                                                                                                                  \
        .kind = TN_SLOT_I64                                                                                            \
    }
#define SLOT_F64                                                                                                       \
    {                                                                                                                  \
        .kind = TN_SLOT_F64                                                                                            \
    }
#define SLOT_STRING                                                                                                    \
    {                                                                                                                  \
        .kind = TN_SLOT_STRING                                                                                         \
    }
#define SLOT_INDEX(SECTION)                                                                                            \
    {                                                                                                                  \
        .kind = TN_SLOT_INDEX, .section = TN_SECTION_##SECTION                                                         \
    }

const tn_slot tn_operand_slots[TN_OPERANDS_COUNT][2] = {
#define OPERANDS(NAME, FIRST, SECOND) {SLOT_##FIRST, SLOT_##SECOND},
#include "runtime/module/operands.def"
};

/* ---- places in the source */

/* The record whose code has the offset: where that code begins. Records' code is contiguous and in their order. */
static bool begin_in(const tn_table *table, tn_section_info info, const tn_member *code, uint32_t offset,
                     uint32_t *begin)
{
    size_t low = 0, high = table->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const char *record = (const char *)table->records + middle * info.size;
        uint32_t first = (uint32_t)tn_member_whole(record, code), end = (uint32_t)tn_member_whole(record, code + 1);
        if (end <= offset) {
            low = middle + 1;
        } else if (first > offset) {
            high = middle;
        } else {
            *begin = first;
            return true;
        }
    }
    return false;
}

/* Where the code begins of the record, of any section, that holds the offset; false if none does. */
static bool code_begin(const tn_module *module, uint32_t offset, uint32_t *begin)
{
    for (tn_section section = 0; section < TN_SECTION_COUNT; section++) {
        tn_section_info info = tn_section_describe(section);
        for (size_t i = 0; i < info.members.count && module->tables[section].count > 0; i++)
            if (info.members.items[i].kind == TN_MEMBER_CODE &&
                begin_in(&module->tables[section], info, &info.members.items[i], offset, begin))
                return true;
    }
    return false;
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
