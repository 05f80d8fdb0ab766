#include "runtime/module/builder.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/bytes.h"
#include "runtime/module/layout.h"

/* A growing array of bytes or of records. */
typedef struct tn_run {
    void *items;
    size_t count, capacity;
} tn_run;

struct tn_builder {
    tn_run sections[TN_SECTION_COUNT]; /* strings and code hold bytes, the others their records' structs */
    tn_string *interned;               /* hash table of offsets; 0 is a free place */
    size_t interned_count, interned_capacity;
    bool out_of_memory;
    bool too_large; /* a section passed what its u32 indices can name */
};

/* Room for `count` more items; the first of them, or NULL (remembered). */
static void *extend(tn_builder *builder, tn_section section, size_t item_size, size_t count)
{
    tn_run *run = &builder->sections[section];
    if (count > UINT32_MAX - 1 - run->count) {
        builder->too_large = true;
        return NULL;
    }
    if (run->count + count > run->capacity) {
        size_t capacity = run->capacity ? run->capacity : 64;
        while (capacity < run->count + count)
            capacity *= 2;
        void *items = realloc(run->items, capacity * item_size);
        if (!items) {
            builder->out_of_memory = true;
            return NULL;
        }
        run->items = items;
        run->capacity = capacity;
    }
    void *first = (char *)run->items + run->count * item_size;
    run->count += count;
    return first;
}

tn_builder *tn_builder_new(void)
{
    tn_builder *builder = calloc(1, sizeof *builder);
    if (!builder)
        return NULL;
    char *empty = extend(builder, TN_SECTION_STRINGS, 1, 1);
    if (!empty) {
        free(builder);
        return NULL;
    }
    *empty = '\0';
    return builder;
}

void tn_builder_free(tn_builder *builder)
{
    if (!builder)
        return;
    for (size_t i = 0; i < TN_SECTION_COUNT; i++)
        free(builder->sections[i].items);
    free(builder->interned);
    free(builder);
}

/* ---- strings */

static const char *string_at(const tn_builder *builder, tn_string string)
{
    return (const char *)builder->sections[TN_SECTION_STRINGS].items + string;
}

/* Where the text is in the table, or the free place where it belongs. The table is never full. */
static size_t find_string(const tn_builder *builder, const char *text, size_t length)
{
    size_t mask = builder->interned_capacity - 1;
    size_t place = (size_t)XXH3_64bits(text, length) & mask;
    for (;; place = (place + 1) & mask) {
        tn_string string = builder->interned[place];
        if (string == 0)
            return place;
        const char *known = string_at(builder, string);
        if (strncmp(known, text, length) == 0 && known[length] == '\0')
            return place;
    }
}

/* Keeps the table at most half full. */
static bool reserve_string(tn_builder *builder)
{
    if (builder->interned_count * 2 < builder->interned_capacity)
        return true;
    size_t old_capacity = builder->interned_capacity;
    tn_string *old = builder->interned;
    size_t capacity = old_capacity ? old_capacity * 2 : 256;
    tn_string *table = calloc(capacity, sizeof *table);
    if (!table) {
        builder->out_of_memory = true;
        return false;
    }
    builder->interned = table;
    builder->interned_capacity = capacity;
    for (size_t i = 0; i < old_capacity; i++) {
        if (old[i] == 0)
            continue;
        const char *text = string_at(builder, old[i]);
        table[find_string(builder, text, strlen(text))] = old[i];
    }
    free(old);
    return true;
}

tn_string tn_builder_string_n(tn_builder *builder, const char *text, size_t length)
{
    const char *zero = length ? memchr(text, '\0', length) : NULL;
    if (zero) /* strings end at their first zero byte */
        length = (size_t)(zero - text);
    if (length == 0 || !reserve_string(builder))
        return 0;
    size_t place = find_string(builder, text, length);
    if (builder->interned[place] != 0)
        return builder->interned[place];
    tn_string string = (tn_string)builder->sections[TN_SECTION_STRINGS].count;
    char *copy = extend(builder, TN_SECTION_STRINGS, 1, length + 1);
    if (!copy)
        return 0;
    memcpy(copy, text, length);
    copy[length] = '\0';
    builder->interned[place] = string;
    builder->interned_count++;
    return string;
}

tn_string tn_builder_string(tn_builder *builder, const char *text)
{
    return text ? tn_builder_string_n(builder, text, strlen(text)) : 0;
}

/* ---- records and code */

#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    uint32_t tn_builder_add_##NAME(tn_builder *builder, const TYPE *record)                                            \
    {                                                                                                                  \
        uint32_t index = (uint32_t)builder->sections[TN_SECTION_##NAME].count;                                         \
        TYPE *place = extend(builder, TN_SECTION_##NAME, sizeof(TYPE), 1);                                             \
        if (place)                                                                                                     \
            *place = *record;                                                                                          \
        return index;                                                                                                  \
    }                                                                                                                  \
    void tn_builder_set_##NAME(tn_builder *builder, uint32_t index, const TYPE *record)                                \
    {                                                                                                                  \
        tn_run *run = &builder->sections[TN_SECTION_##NAME];                                                           \
        if (index < run->count)                                                                                        \
            ((TYPE *)run->items)[index] = *record;                                                                     \
    }
#include "runtime/module/records.def"
#undef SECTION

size_t tn_builder_count(const tn_builder *builder, tn_section section)
{
    return builder->sections[section].count;
}

uint32_t tn_builder_offset(const tn_builder *builder)
{
    return (uint32_t)builder->sections[TN_SECTION_CODE].count;
}

uint32_t tn_builder_emit(tn_builder *builder, tn_opcode opcode, int64_t first, int64_t second)
{
    uint32_t offset = tn_builder_offset(builder);
    const tn_opcode_info *info = tn_opcode_describe((uint8_t)opcode);
    uint8_t *place = extend(builder, TN_SECTION_CODE, 1, info->length);
    if (!place)
        return offset;
    *place++ = (uint8_t)opcode;
    switch (info->operands) {
    case TN_OPERANDS_NONE:
        break;
    case TN_OPERANDS_SPEC:
    case TN_OPERANDS_FUNC:
    case TN_OPERANDS_COND:
    case TN_OPERANDS_TEXT:
    case TN_OPERANDS_SYMBOL:
    case TN_OPERANDS_LETTER:
    case TN_OPERANDS_BODY:
    case TN_OPERANDS_TERM:
        tn_put_u32(place, (uint32_t)first);
        break;
    case TN_OPERANDS_FIELD_COND:
        tn_put_u32(place, (uint32_t)first);
        tn_put_u32(place + 4, (uint32_t)second);
        break;
    case TN_OPERANDS_INT2:
        tn_put_u64(place + 8, (uint64_t)second);
        tn_put_u64(place, (uint64_t)first);
        break;
    case TN_OPERANDS_INT:
    case TN_OPERANDS_REAL: /* its bits */
        tn_put_u64(place, (uint64_t)first);
        break;
    }
    return offset;
}

/* ---- the file */

static const size_t stored_sizes[TN_SECTION_COUNT] = {
    [TN_SECTION_STRINGS] = 1,
    [TN_SECTION_CODE] = 1,
#define SECTION(NAME, NUMBER, TYPE, FIELDS) [NUMBER] = TN_STORED_##NAME,
#include "runtime/module/records.def"
#undef SECTION
};

/* Each writes one section's records and returns where the next section goes. */
#define TN_WRITE_STR(value) (tn_put_u32(to, (value)), to += 4)
#define TN_WRITE_U32(value) (tn_put_u32(to, (value)), to += 4)
#define TN_WRITE_I64(value) (tn_put_u64(to, (uint64_t)(value)), to += 8)
#define TN_WRITE_F64(value) (tn_put_u64(to, tn_bits_of(value)), to += 8)
#define F(KIND, FIELD) TN_WRITE_##KIND(record->FIELD);
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    static uint8_t *write_##NAME(const tn_run *run, uint8_t *to)                                                       \
    {                                                                                                                  \
        const TYPE *records = run->items;                                                                              \
        for (size_t i = 0; i < run->count; i++) {                                                                      \
            const TYPE *record = &records[i];                                                                          \
            FIELDS                                                                                                     \
        }                                                                                                              \
        return to;                                                                                                     \
    }
#include "runtime/module/records.def"
#undef SECTION
#undef F

static uint8_t *write_bytes(const tn_run *run, uint8_t *to)
{
    if (run->count > 0)
        memcpy(to, run->items, run->count);
    return to + run->count;
}

static void write_header(const tn_builder *builder, uint8_t *bytes, size_t size)
{
    memcpy(bytes, TN_MAGIC, TN_MAGIC_SIZE);
    tn_put_u32(bytes + TN_HEADER_FORMAT, TN_MODULE_FORMAT);
    tn_put_u32(bytes + TN_HEADER_SECTIONS, TN_SECTION_COUNT);
    tn_put_u64(bytes + TN_HEADER_SIZE, size);
    uint64_t offset = TN_CONTENTS;
    for (uint32_t i = 0; i < TN_SECTION_COUNT; i++) {
        uint8_t *entry = bytes + TN_HEADER_BYTES + i * TN_ENTRY_BYTES;
        uint64_t section_size = builder->sections[i].count * stored_sizes[i];
        tn_put_u32(entry + TN_ENTRY_NUMBER, i);
        tn_put_u64(entry + TN_ENTRY_OFFSET, offset);
        tn_put_u64(entry + TN_ENTRY_SIZE, section_size);
        offset += section_size;
    }
}

tn_status tn_builder_finish(tn_builder *builder, uint8_t **bytes, size_t *size, tn_error *error)
{
    *bytes = NULL;
    *size = 0;
    if (builder->out_of_memory)
        return tn_fail_memory(error);
    if (builder->too_large)
        return tn_fail(error, TN_LIMIT, E_MODULE_TOO_LARGE,
                       "the module is too large: a section passed 4 GiB or 2^32 records");
    size_t total = TN_CONTENTS;
    for (size_t i = 0; i < TN_SECTION_COUNT; i++)
        total += builder->sections[i].count * stored_sizes[i];
    uint8_t *file = calloc(total, 1);
    if (!file)
        return tn_fail_memory(error);
    write_header(builder, file, total);
    uint8_t *to = file + TN_CONTENTS;
    to = write_bytes(&builder->sections[TN_SECTION_STRINGS], to);
    to = write_bytes(&builder->sections[TN_SECTION_CODE], to);
#define SECTION(NAME, NUMBER, TYPE, FIELDS) to = write_##NAME(&builder->sections[TN_SECTION_##NAME], to);
#include "runtime/module/records.def"
#undef SECTION
    if ((size_t)(to - file) != total) {
        free(file);
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the module's sections do not add up to its size");
    }
    tn_module_rehash(file, total);
    *bytes = file;
    *size = total;
    return TN_OK;
}
