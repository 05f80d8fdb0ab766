/* Compares records of two modules by what they say: each field by its row in records.def, code by its rows in
 * opcodes.def and operands.def. */
#include "runtime/module/same.h"

#include "runtime/module/code.h"
#include "runtime/module/records.h"

#define DEPTH_MAX 64 /* of references; rules within rules that go deeper are taken for different ones */

typedef struct tn_same {
    const tn_module *modules[2];
    unsigned depth;
    int64_t schemas[2]; /* that are compared, or have been: nothing goes on after a difference */
} tn_same;

static bool records_same(tn_same *same, tn_section section, const int64_t at[2]);

static bool texts_same(const tn_same *same, const int64_t at[2])
{
    return strcmp(tn_text(same->modules[0], (tn_string)at[0]), tn_text(same->modules[1], (tn_string)at[1])) == 0;
}

/* ---- code */

static bool slot_same(tn_same *same, tn_slot slot, const int64_t operand[2])
{
    if (slot.kind == TN_SLOT_STRING)
        return texts_same(same, operand);
    if (slot.kind == TN_SLOT_INDEX)
        return records_same(same, slot.section, operand);
    return operand[0] == operand[1];
}

static bool code_same(tn_same *same, const int64_t begin[2], const int64_t end[2])
{
    int64_t at[2] = {begin[0], begin[1]};
    while (at[0] < end[0] && at[1] < end[1]) {
        const tn_instruction a = tn_code_read(same->modules[0]->code, (uint32_t)at[0]);
        const tn_instruction b = tn_code_read(same->modules[1]->code, (uint32_t)at[1]);
        if (a.opcode != b.opcode)
            return false;
        const tn_slot *slots = tn_operand_slots[tn_code_operands((uint8_t)a.opcode)];
        if (!slot_same(same, slots[0], (int64_t[]){a.first, b.first}) ||
            !slot_same(same, slots[1], (int64_t[]){a.second, b.second}))
            return false;
        at[0] += a.length;
        at[1] += b.length;
    }
    return at[0] == end[0] && at[1] == end[1];
}

/* ---- records */

/* What nothing goes by: docs, places; and the names of what is told by its line. */
static bool says_nothing(tn_section section, const tn_member *member)
{
    bool named = section == TN_SECTION_FUNCTION || section == TN_SECTION_CLAUSE || section == TN_SECTION_HOUSE_CLAUSE;
    return member->kind == TN_MEMBER_FILE || member->kind == TN_MEMBER_BEGIN || member->kind == TN_MEMBER_END ||
           strcmp(member->name, "doc") == 0 || (named && strcmp(member->name, "name") == 0) ||
           (member->kind == TN_MEMBER_FLAGS && strcmp(member->words, "imported") == 0);
}

static bool lists_same(tn_same *same, tn_section section, const int64_t first[2], const int64_t count[2])
{
    bool good = count[0] == count[1];
    for (int64_t i = 0; good && i < count[0]; i++)
        good = records_same(same, section, (int64_t[]){first[0] + i, first[1] + i});
    return good;
}

/* next: the values of the field after it. */
static bool member_same(tn_same *same, tn_section section, const tn_member *member, const int64_t value[2],
                        const int64_t next[2])
{
    switch (member->kind) {
    case TN_MEMBER_TEXT:
        return texts_same(same, value);
    case TN_MEMBER_REF:
        return records_same(same, member->section, value);
    case TN_MEMBER_REF_OR_NONE:
        return value[0] == TN_NO_RECORD || value[1] == TN_NO_RECORD ? value[0] == value[1]
                                                                    : records_same(same, member->section, value);
    case TN_MEMBER_REF_AT_TIMES: /* what a function works on is plain from its code */
        return section == TN_SECTION_FUNCTION || value[0] == value[1];
    case TN_MEMBER_RUN:
    case TN_MEMBER_SLICE:
        return lists_same(same, member->section, value, next);
    case TN_MEMBER_CODE:
        return code_same(same, value, next);
    case TN_MEMBER_CODE_END:
    case TN_MEMBER_COUNT: /* compared with what they end */
        return true;
    default:
        return value[0] == value[1];
    }
}

static const char *record_of(const tn_module *module, tn_section section, int64_t at)
{
    return (const char *)module->tables[section].records + (size_t)at * tn_section_describe(section).size;
}

static void read_values(const tn_same *same, tn_section section, const tn_member *member, const int64_t at[2],
                        int64_t value[2])
{
    for (int i = 0; i < 2; i++)
        value[i] = tn_member_whole(record_of(same->modules[i], section, at[i]), member);
}

static bool members_same(tn_same *same, tn_section section, const int64_t at[2])
{
    const tn_members members = tn_section_describe(section).members;
    bool good = true;
    for (size_t i = 0; good && i < members.count; i++) {
        int64_t value[2], next[2] = {0, 0};
        if (says_nothing(section, &members.items[i]))
            continue;
        read_values(same, section, &members.items[i], at, value);
        if (i + 1 < members.count)
            read_values(same, section, &members.items[i + 1], at, next);
        good = member_same(same, section, &members.items[i], value, next);
    }
    return good;
}

/* A specifier has a bit for each value of its schema. */
static bool specs_same(tn_same *same, const int64_t at[2])
{
    const tn_module *a = same->modules[0], *b = same->modules[1];
    const tn_spec_record *first = &a->SPEC_records[at[0]], *second = &b->SPEC_records[at[1]];
    const tn_schema_record *schema = &a->SCHEMA_records[first->schema];
    uint32_t values = 0;
    if (!records_same(same, TN_SECTION_SCHEMA, (int64_t[]){first->schema, second->schema}))
        return false;
    for (uint32_t f = 0; f < schema->field_count; f++)
        values += a->FIELD_records[schema->field_first + f].value_count;
    for (uint32_t w = 0; w < (values + 63) / 64; w++)
        if (a->MASK_records[first->mask_first + w].bits != b->MASK_records[second->mask_first + w].bits)
            return false;
    return true;
}

static bool records_same(tn_same *same, tn_section section, const int64_t at[2])
{
    if (section == TN_SECTION_SCHEMA && same->schemas[0] == at[0] && same->schemas[1] == at[1])
        return true;
    if (section == TN_SECTION_SCHEMA)
        memcpy(same->schemas, at, sizeof same->schemas);
    if (same->depth == DEPTH_MAX)
        return false;
    same->depth++;
    bool good = section == TN_SECTION_SPEC ? specs_same(same, at) : members_same(same, section, at);
    if (section == TN_SECTION_SHAPE) /* two choices may have values that say the same */
        good = good && at[0] == at[1];
    same->depth--;
    return good;
}

bool tn_records_same(const tn_module *first, uint32_t of_first, const tn_module *second, uint32_t of_second,
                     tn_section section)
{
    tn_same same = {.modules = {first, second}, .schemas = {-1, -1}};
    return records_same(&same, section, (int64_t[]){of_first, of_second});
}
