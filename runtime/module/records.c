/* Makes data of the rows of records.def and values.def, and reads and writes records by it. */
#include "runtime/module/records.h"

#include <float.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/length.h"

/* ---- enumerations */

#define VALUE(ID, NUMBER, WORD) [NUMBER] = (WORD),
#define ENUMERATION(NAME, TYPE, VALUES) const char *const tn_names_##NAME[TN_##NAME##_COUNT] = {VALUES};
#include "runtime/module/values.def"

/* ---- the fields of each section */

#define MEMBER(FIELD, KIND, STORAGE, ...)                                                                              \
    {.name = #FIELD,                                                                                                   \
     .kind = TN_MEMBER_##KIND,                                                                                         \
     .storage = TN_STORAGE_##STORAGE,                                                                                  \
     .at = offsetof(record, FIELD),                                                                                    \
     __VA_ARGS__},
#define STR(FIELD) MEMBER(FIELD, TEXT, U32, .high = UINT32_MAX)
#define NAME(FIELD, MOST) MEMBER(FIELD, TEXT, U32, .low = 1, .high = MOST)
#define NAME_OR_NONE(FIELD, MOST) MEMBER(FIELD, TEXT, U32, .high = MOST)
#define U32(FIELD, LOW, HIGH) MEMBER(FIELD, WHOLE, U32, .low = LOW, .high = HIGH)
#define I64(FIELD, LOW, HIGH) MEMBER(FIELD, WHOLE, I64, .low = LOW, .high = HIGH)
#define F64(FIELD, LOW, HIGH) MEMBER(FIELD, REAL, F64, .least = LOW, .most = HIGH)
#define BITS(FIELD) MEMBER(FIELD, BITS, I64, .low = INT64_MIN, .high = INT64_MAX)
#define ENUM(FIELD, OF) MEMBER(FIELD, WHOLE, U32, .high = TN_##OF##_COUNT - 1, .names = tn_names_##OF)
#define FLAGS(FIELD, MASK, WORDS) MEMBER(FIELD, FLAGS, U32, .high = MASK, .words = WORDS)
#define REF(FIELD, OF) MEMBER(FIELD, REF, U32, .section = TN_SECTION_##OF)
#define REF_OR_NONE(FIELD, OF) MEMBER(FIELD, REF_OR_NONE, U32, .section = TN_SECTION_##OF)
#define REF_AT_TIMES(FIELD, OF) MEMBER(FIELD, REF_AT_TIMES, U32, .section = TN_SECTION_##OF)
#define PART(FIELD, KIND, OF, LOW, HIGH)                                                                               \
    MEMBER(FIELD##_first, KIND, U32, .section = TN_SECTION_##OF)                                                       \
    MEMBER(FIELD##_count, COUNT, U32, .section = TN_SECTION_##OF, .low = LOW, .high = HIGH)
#define RUN(FIELD, OF, LOW, HIGH) PART(FIELD, RUN, OF, LOW, HIGH)
#define SLICE(FIELD, OF) PART(FIELD, SLICE, OF, 0, UINT32_MAX)
#define CODE(FIELD) MEMBER(FIELD##_begin, CODE, U32, .low = 0) MEMBER(FIELD##_end, CODE_END, U32, .low = 0)
#define PLACE()                                                                                                        \
    MEMBER(file, FILE, U32, .section = TN_SECTION_SOURCE)                                                              \
    MEMBER(begin, BEGIN, U32, .low = 0) MEMBER(end, END, U32, .low = 0)
#define DEFAULT(FIELD, VALUE)
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    static tn_members members_##NAME(void)                                                                             \
    {                                                                                                                  \
        typedef TYPE record;                                                                                           \
        static const tn_member members[] = {FIELDS};                                                                   \
        return (tn_members){members, sizeof members / sizeof *members};                                                \
    }
#include "runtime/module/records.def"

/* ---- what fields are that a record lacks */

#define STR(FIELD)
#define NAME(FIELD, MOST)
#define NAME_OR_NONE(FIELD, MOST)
#define U32(FIELD, LOW, HIGH)
#define I64(FIELD, LOW, HIGH)
#define F64(FIELD, LOW, HIGH)
#define BITS(FIELD)
#define ENUM(FIELD, OF)
#define FLAGS(FIELD, MASK, WORDS)
#define REF(FIELD, OF)
#define REF_OR_NONE(FIELD, OF)
#define REF_AT_TIMES(FIELD, OF)
#define RUN(FIELD, OF, LOW, HIGH)
#define SLICE(FIELD, OF)
#define CODE(FIELD)
#define PLACE()
#define DEFAULT(FIELD, VALUE) , .FIELD = VALUE
#define SECTION(NAME, NUMBER, TYPE, FIELDS) static const TYPE missing_##NAME = {0 FIELDS};
#include "runtime/module/records.def"

/* ---- sections */

typedef struct tn_row {
    const char *name;
    uint16_t number;
    uint16_t size;
    tn_members (*members)(void);
    const void *missing;
} tn_row;

static tn_members no_members(void)
{
    return (tn_members){NULL, 0};
}

static const tn_row rows[TN_SECTION_COUNT] = {
    {"STRINGS", 0, 1, no_members, NULL},
    {"CODE", 1, 1, no_members, NULL},
#define SECTION(NAME, NUMBER, TYPE, FIELDS) {#NAME, NUMBER, sizeof(TYPE), members_##NAME, &missing_##NAME},
#include "runtime/module/records.def"
};

tn_section_info tn_section_describe(tn_section section)
{
    const tn_row *row = &rows[section];
    return (tn_section_info){row->name, row->number, row->size, row->members()};
}

void tn_section_title(tn_section section, char title[TN_TITLE_MAX])
{
    const char *name = rows[section].name;
    size_t size = 0;
    for (; name[size] && size < TN_TITLE_MAX - 1; size++)
        title[size] = name[size] == '_' ? ' ' : (char)(name[size] - 'A' + 'a');
    title[size] = '\0';
}

tn_section tn_section_numbered(uint32_t number)
{
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        if (rows[i].number == number)
            return i;
    return TN_SECTION_COUNT;
}

uint32_t tn_section_stored(tn_section section)
{
    tn_members members = rows[section].members();
    uint32_t bytes = members.count == 0;
    for (size_t i = 0; i < members.count; i++)
        bytes += tn_storage_bytes(members.items[i].storage);
    return bytes;
}

/* ---- fields */

/* One field of records whose first is stored at `from`, `stored` bytes from each to the next. */
static void read_member(const tn_member *member, const uint8_t *from, size_t stored, char *records, size_t size,
                        size_t count)
{
    char *at = records + member->at;
    if (member->storage == TN_STORAGE_U32) {
        for (size_t i = 0; i < count; i++, at += size, from += stored) {
            uint32_t value = tn_get_u32(from);
            memcpy(at, &value, sizeof value);
        }
    } else if (member->storage == TN_STORAGE_I64) {
        for (size_t i = 0; i < count; i++, at += size, from += stored) {
            int64_t value = tn_get_i64(from);
            memcpy(at, &value, sizeof value);
        }
    } else {
        for (size_t i = 0; i < count; i++, at += size, from += stored) {
            double value = tn_double_of(tn_get_u64(from));
            memcpy(at, &value, sizeof value);
        }
    }
}

static void write_member(const tn_member *member, const void *record, uint8_t *to)
{
    if (member->storage == TN_STORAGE_U32)
        tn_put_u32(to, (uint32_t)tn_member_whole(record, member));
    else if (member->storage == TN_STORAGE_I64)
        tn_put_u64(to, (uint64_t)tn_member_whole(record, member));
    else
        tn_put_u64(to, tn_bits_of(tn_member_real(record, member)));
}

/* ---- records */

bool tn_records_fit(tn_section section, uint32_t stored)
{
    tn_members members = rows[section].members();
    uint32_t end = members.count == 0;
    for (size_t i = 0; i < members.count && end < stored; i++)
        end += tn_storage_bytes(members.items[i].storage);
    return end == stored && stored > 0;
}

void tn_records_read(tn_section section, const uint8_t *from, size_t count, uint32_t stored, void *records)
{
    const tn_row *row = &rows[section];
    tn_members members = row->members();
    uint32_t at = 0;
    for (size_t i = 0; i < count && stored < tn_section_stored(section); i++)
        memcpy((char *)records + i * row->size, row->missing, row->size);
    for (const tn_member *member = members.items; at < stored; member++) {
        read_member(member, from + at, stored, records, row->size, count);
        at += tn_storage_bytes(member->storage);
    }
}

uint8_t *tn_records_write(tn_section section, const void *records, size_t count, uint8_t *to)
{
    const tn_row *row = &rows[section];
    tn_members members = row->members();
    for (size_t i = 0; i < count; i++) {
        const char *record = (const char *)records + i * row->size;
        for (size_t k = 0; k < members.count; k++) {
            write_member(&members.items[k], record, to);
            to += tn_storage_bytes(members.items[k].storage);
        }
    }
    return to;
}
