/* Builds a module's bytes. */
#include "runtime/module/builder.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/module/code.h"
#include "runtime/module/layout.h"
#include "runtime/module/records.h"

/* A growing array of bytes or of records. */
typedef struct tn_builder_run {
    void *items;
    size_t count, capacity;
} tn_builder_run;

struct tn_builder {
    tn_builder_run sections[TN_SECTION_COUNT]; /* strings and code hold bytes, the others their records' structs */
    tn_string *interned;                       /* hash table of offsets; 0 is a free place */
    size_t interned_count, interned_capacity;
    bool out_of_memory;
    bool too_large; /* a section passed what its u32 indices can name */
};

/* Room for `count` more items; the first of them, or NULL (remembered). */
static void *extend(tn_builder *builder, tn_section section, size_t item_size, size_t count)
{
    tn_builder_run *run = &builder->sections[section];
    if (count > UINT32_MAX - 1 - run->count) {
        builder->too_large = true;
        return NULL;
    }
    if (!tn_array_reserve(&run->items, &run->capacity, run->count, count, item_size)) {
        builder->out_of_memory = true;
        return NULL;
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
        tn_builder_run *run = &builder->sections[TN_SECTION_##NAME];                                                   \
        if (index < run->count)                                                                                        \
            ((TYPE *)run->items)[index] = *record;                                                                     \
    }
#include "runtime/module/records.def"

size_t tn_builder_count(const tn_builder *builder, tn_section section)
{
    return builder->sections[section].count;
}

uint32_t tn_builder_offset(const tn_builder *builder)
{
    return (uint32_t)builder->sections[TN_SECTION_CODE].count;
}

static void put_operand(uint8_t *place, uint8_t width, int64_t value)
{
    if (width == 4)
        tn_put_u32(place, (uint32_t)value);
    else if (width == 8)
        tn_put_u64(place, (uint64_t)value);
}

uint32_t tn_builder_emit(tn_builder *builder, tn_opcode opcode, int64_t first, int64_t second)
{
    uint32_t offset = tn_builder_offset(builder);
    const tn_opcode_info *info = tn_opcode_describe((uint8_t)opcode);
    uint8_t *place = extend(builder, TN_SECTION_CODE, 1, info->length);
    if (!place)
        return offset;
    *place++ = (uint8_t)opcode;
    tn_operand_widths widths = tn_code_widths((uint8_t)opcode);
    put_operand(place, widths.first, first);
    put_operand(place + widths.first, widths.second, second);
    return offset;
}

/* ---- the file */

static void write_entry(uint8_t *entry, tn_section section, size_t count)
{
    uint32_t stored = tn_section_stored(section), number = tn_section_describe(section).number;
    tn_put_u32(entry + TN_ENTRY_NUMBER, number | stored << 16);
    tn_put_u32(entry + TN_ENTRY_COUNT, (uint32_t)count);
}

/* The header and the table of the sections that are not empty; returns where their records go. */
static uint8_t *write_header(const tn_builder *builder, uint8_t *bytes, size_t size)
{
    uint8_t *entry = bytes + TN_HEADER_BYTES;
    memcpy(bytes, TN_MAGIC, TN_MAGIC_SIZE);
    tn_put_u32(bytes + TN_HEADER_FORMAT, TN_MODULE_FORMAT);
    tn_put_u64(bytes + TN_HEADER_SIZE, size);
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++) {
        if (builder->sections[i].count == 0)
            continue;
        write_entry(entry, i, builder->sections[i].count);
        entry += TN_ENTRY_BYTES;
    }
    tn_put_u32(bytes + TN_HEADER_SECTIONS, (uint32_t)((entry - bytes - TN_HEADER_BYTES) / TN_ENTRY_BYTES));
    return entry;
}

static uint8_t *write_section(const tn_builder *builder, tn_section section, uint8_t *to)
{
    const tn_builder_run *run = &builder->sections[section];
    if (section != TN_SECTION_STRINGS && section != TN_SECTION_CODE)
        return tn_records_write(section, run->items, run->count, to);
    if (run->count > 0)
        memcpy(to, run->items, run->count);
    return to + run->count;
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
    size_t total = TN_HEADER_BYTES;
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        if (builder->sections[i].count > 0)
            total += TN_ENTRY_BYTES + builder->sections[i].count * tn_section_stored(i);
    uint8_t *file = calloc(total, 1);
    if (!file)
        return tn_fail_memory(error);
    uint8_t *to = write_header(builder, file, total);
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        to = write_section(builder, i, to);
    if ((size_t)(to - file) != total) {
        free(file);
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the module's sections do not add up to its size");
    }
    tn_module_rehash(file, total);
    *bytes = file;
    *size = total;
    return TN_OK;
}

void tn_module_rehash(uint8_t *bytes, size_t size)
{
    if (size >= TN_HEADER_BYTES)
        tn_put_u64(bytes + TN_HEADER_HASH, tn_module_hash_bytes(bytes, size));
}
