/* Reads a module's file: checks its header, finds its sections, decodes their records and has them verified. */
#include "runtime/module/read.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/module/layout.h"
#include "runtime/module/records.h"
#include "runtime/module/verify.h"

/* ---- the header */

/* A section as the file has it; no bytes where it has none. */
typedef struct tn_stored {
    const uint8_t *bytes;
    uint32_t stored; /* bytes of a record */
    size_t count;
} tn_stored;

static tn_status damaged(tn_error *error, const char *what)
{
    tn_fail(error, TN_INVALID, E_DAMAGED_MODULE, "the module is damaged: %s", what);
    tn_error_help(error, "compile it again from its rule files");
    return TN_INVALID;
}

/* What an older program can't know, and may not skip: nobody would have verified it. */
static tn_status newer(tn_error *error)
{
    tn_error_help(error, "run it with the Tartan that made it, or compile it again from its rule files with this one");
    return TN_INVALID;
}

/* The limits are there so that a damaged or hostile file cannot ask for more than a rule file ever needs: no option
 * raises them. */
static tn_status too_much(tn_error *error)
{
    tn_error_help(error, "this limit is fixed: divide the rules between several files");
    return TN_LIMIT;
}

static tn_status check_format(const uint8_t *bytes, tn_error *error)
{
    uint32_t format = tn_get_u32(bytes + TN_HEADER_FORMAT);
    if (format == TN_MODULE_FORMAT)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_DAMAGED_MODULE, "the module has format %u; this program reads format %u", format,
            TN_MODULE_FORMAT);
    tn_error_help(error, "compile it again from its rule files with this version");
    return TN_INVALID;
}

static tn_status check_header(const uint8_t *bytes, size_t size, const tn_module_limits *limits, tn_error *error)
{
    if (size > limits->bytes) {
        tn_fail(error, TN_LIMIT, E_MODULE_TOO_LARGE, "the module is %zu bytes long; the limit is %zu", size,
                limits->bytes);
        return too_much(error);
    }
    if (!tn_module_has_magic(bytes, size))
        return tn_fail(error, TN_INVALID, E_NOT_A_MODULE, "the file is not a compiled module");
    if (size < TN_HEADER_BYTES)
        return damaged(error, "it ends within its header");
    tn_status status = check_format(bytes, error);
    if (status != TN_OK)
        return status;
    if (tn_get_u64(bytes + TN_HEADER_SIZE) != size)
        return damaged(error, "its length is not the one that its header says");
    if (tn_get_u64(bytes + TN_HEADER_HASH) != tn_module_hash_bytes(bytes, size))
        return damaged(error, "its contents do not have the hash that its header says");
    return TN_OK;
}

/* ---- sections */

/* A record of another size than this program writes: an older Tartan's, which lacks fields at its end, or none. */
static tn_status check_stored(tn_section section, uint32_t stored, tn_error *error)
{
    uint32_t known = tn_section_stored(section);
    if (stored == known || tn_records_fit(section, stored))
        return TN_OK;
    if (stored < known)
        return damaged(error, "a section's records end within a field");
    char title[TN_TITLE_MAX];
    tn_section_title(section, title);
    tn_fail(error, TN_INVALID, E_DAMAGED_MODULE,
            "the module's %s records have %u bytes, and this program knows %u: was it made by a newer Tartan?", title,
            stored, known);
    return newer(error);
}

/* Reads an entry of the table of sections; they ascend by number. */
static tn_status read_entry(const uint8_t *entry, uint32_t *above, tn_section *section, tn_stored *stored,
                            tn_error *error)
{
    uint32_t number = entry[TN_ENTRY_NUMBER] | (uint32_t)entry[TN_ENTRY_NUMBER + 1] << 8;
    *stored = (tn_stored){.stored = entry[TN_ENTRY_STORED] | (uint32_t)entry[TN_ENTRY_STORED + 1] << 8,
                          .count = tn_get_u32(entry + TN_ENTRY_COUNT)};
    if (number < *above || stored->count == 0)
        return damaged(error, "its table of sections is out of order or names an empty section");
    *above = number + 1;
    *section = tn_section_numbered(number);
    if (*section != TN_SECTION_COUNT)
        return check_stored(*section, stored->stored, error);
    tn_fail(error, TN_INVALID, E_DAMAGED_MODULE,
            "the module has a section %u, which this program does not know: was it made by a newer Tartan?", number);
    return newer(error);
}

/* The sections lie one after another in the order of their numbers and fill the file. */
static tn_status find_sections(const uint8_t *bytes, size_t size, tn_stored *sections, tn_error *error)
{
    uint32_t count = tn_get_u32(bytes + TN_HEADER_SECTIONS), above = 0;
    if (count > (size - TN_HEADER_BYTES) / TN_ENTRY_BYTES)
        return damaged(error, "it ends within its table of sections");
    size_t offset = TN_HEADER_BYTES + (size_t)count * TN_ENTRY_BYTES;
    for (uint32_t i = 0; i < count; i++) {
        tn_section section = TN_SECTION_STRINGS;
        tn_stored stored;
        tn_status status = read_entry(bytes + TN_HEADER_BYTES + i * TN_ENTRY_BYTES, &above, &section, &stored, error);
        if (status != TN_OK)
            return status;
        if (stored.count > (size - offset) / stored.stored)
            return damaged(error, "its table of sections does not fit its contents");
        stored.bytes = bytes + offset;
        offset += stored.count * stored.stored;
        sections[section] = stored;
    }
    return offset == size ? TN_OK : damaged(error, "something follows its last section");
}

/* ---- decoding: one block holds the module and all that it points to */

static size_t aligned(size_t size)
{
    size_t unit = _Alignof(max_align_t);
    return (size + unit - 1) / unit * unit;
}

static tn_status check_counts(const tn_stored *sections, const tn_module_limits *limits, size_t *block, tn_error *error)
{
    *block = aligned(sizeof(tn_module));
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++) {
        tn_section_info info = tn_section_describe(i);
        if (info.members.count > 0 && sections[i].count > limits->records) {
            tn_fail(error, TN_LIMIT, E_MODULE_TOO_LARGE,
                    "the module has %zu records in its section %s; the limit is %zu", sections[i].count, info.name,
                    limits->records);
            return too_much(error);
        }
        if (*block + (uint64_t)sections[i].count * info.size > TN_SIZE_MOST / 2) /* what it grows to is a size, too */
            return tn_fail_memory(error);
        *block += aligned(sections[i].count * info.size);
    }
    return TN_OK;
}

static void decode(const tn_stored *sections, tn_module *module)
{
    char *block = (char *)module + aligned(sizeof *module);
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++) {
        tn_section_info info = tn_section_describe(i);
        module->tables[i] = (tn_table){block, sections[i].count};
        if (info.members.count > 0)
            tn_records_read(i, sections[i].bytes, sections[i].count, sections[i].stored, block);
        else if (sections[i].count > 0)
            memcpy(block, sections[i].bytes, sections[i].count);
        block += aligned(sections[i].count * info.size);
    }
    module->strings = module->tables[TN_SECTION_STRINGS].records;
    module->strings_size = module->tables[TN_SECTION_STRINGS].count;
    module->code = module->tables[TN_SECTION_CODE].records;
    module->code_size = module->tables[TN_SECTION_CODE].count;
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    module->NAME##_records = module->tables[TN_SECTION_##NAME].records;                                                \
    module->NAME##_count = module->tables[TN_SECTION_##NAME].count;
#include "runtime/module/records.def"
}

tn_status tn_module_read(const void *bytes, size_t size, const tn_engines *engines, const tn_module_limits *limits,
                         tn_module **module, tn_error *error)
{
    *module = NULL;
    tn_module_limits bounds = limits ? *limits : tn_module_limits_default();
    bounds.records = bounds.records < UINT32_MAX - 1 ? bounds.records : UINT32_MAX - 1;
    bounds.stack = bounds.stack < TN_STACK_MAX ? bounds.stack : TN_STACK_MAX;
    tn_stored sections[TN_SECTION_COUNT] = {{.bytes = NULL}};
    size_t block_size = 0;
    tn_status status = check_header(bytes, size, &bounds, error);
    if (status == TN_OK)
        status = find_sections(bytes, size, sections, error);
    if (status == TN_OK)
        status = check_counts(sections, &bounds, &block_size, error);
    if (status != TN_OK)
        return status;
    tn_module *loaded = calloc(1, block_size);
    if (!loaded)
        return tn_fail_memory(error);
    decode(sections, loaded);
    loaded->hash = tn_get_u64((const uint8_t *)bytes + TN_HEADER_HASH);
    status = tn_module_verify(loaded, engines, &bounds, error);
    if (status != TN_OK) {
        free(loaded);
        return status;
    }
    *module = loaded;
    return TN_OK;
}
