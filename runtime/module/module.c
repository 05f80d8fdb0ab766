#include "runtime/module/module.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/module/layout.h"
#include "runtime/module/verify.h"

/* A section as the file's table of sections has it. */
typedef struct tn_stored {
    const uint8_t *bytes;
    size_t size;
} tn_stored;

tn_module_limits tn_module_limits_default(void)
{
    return (tn_module_limits){.bytes = (size_t)256 << 20, .records = 1000000, .stack = 4096};
}

static tn_status damaged(tn_error *error, const char *what)
{
    tn_fail(error, TN_INVALID, E_DAMAGED_MODULE, "the module is damaged: %s", what);
    tn_error_help(error, "compile it again from its rule files");
    return TN_INVALID;
}

/* The limits are there so that a damaged or hostile file cannot ask for more than a rule file ever needs: no option
 * raises them. */
static tn_status too_much(tn_error *error)
{
    tn_error_help(error, "this limit is fixed: divide the rules between several files");
    return TN_LIMIT;
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
    if (size < TN_CONTENTS)
        return damaged(error, "it ends within its header");
    uint32_t format = tn_get_u32(bytes + TN_HEADER_FORMAT);
    if (format != TN_MODULE_FORMAT) {
        tn_fail(error, TN_INVALID, E_DAMAGED_MODULE, "the module has format %u; this program reads format %u", format,
                TN_MODULE_FORMAT);
        tn_error_help(error, "compile it again from its rule files with this version");
        return TN_INVALID;
    }
    if (tn_get_u64(bytes + TN_HEADER_SIZE) != size)
        return damaged(error, "its length is not the one that its header says");
    if (tn_get_u64(bytes + TN_HEADER_HASH) != tn_module_hash_bytes(bytes, size))
        return damaged(error, "its contents do not have the hash that its header says");
    if (tn_get_u32(bytes + TN_HEADER_SECTIONS) != TN_SECTION_COUNT)
        return damaged(error, "it does not have the sections of its format");
    return TN_OK;
}

/* The sections lie one after another in the order of their numbers and fill the file. */
static tn_status find_sections(const uint8_t *bytes, size_t size, tn_stored *sections, tn_error *error)
{
    uint64_t offset = TN_CONTENTS;
    for (uint32_t i = 0; i < TN_SECTION_COUNT; i++) {
        const uint8_t *entry = bytes + TN_HEADER_BYTES + i * TN_ENTRY_BYTES;
        uint64_t length = tn_get_u64(entry + TN_ENTRY_SIZE);
        if (tn_get_u32(entry + TN_ENTRY_NUMBER) != i || tn_get_u32(entry + TN_ENTRY_NUMBER + 4) != 0 ||
            tn_get_u64(entry + TN_ENTRY_OFFSET) != offset || length > size - offset)
            return damaged(error, "its table of sections does not fit its contents");
        sections[i] = (tn_stored){bytes + offset, (size_t)length};
        offset += length;
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
    if (sections[TN_SECTION_STRINGS].size > UINT32_MAX || sections[TN_SECTION_CODE].size > UINT32_MAX)
        return tn_fail(error, TN_LIMIT, E_MODULE_TOO_LARGE, "the module's strings or code pass 4 GiB");
    *block = aligned(sizeof(tn_module)) + aligned(sections[TN_SECTION_STRINGS].size) +
             aligned(sections[TN_SECTION_CODE].size);
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    if (sections[NUMBER].size % TN_STORED_##NAME != 0)                                                                 \
        return damaged(error, "its section " #NAME " ends within a record");                                           \
    if (sections[NUMBER].size / TN_STORED_##NAME > limits->records) {                                                  \
        tn_fail(error, TN_LIMIT, E_MODULE_TOO_LARGE,                                                                   \
                "the module has %zu records in its section " #NAME "; the limit is %zu",                               \
                sections[NUMBER].size / TN_STORED_##NAME, limits->records);                                            \
        return too_much(error);                                                                                        \
    }                                                                                                                  \
    *block += aligned(sections[NUMBER].size / TN_STORED_##NAME * sizeof(TYPE));
#include "runtime/module/records.def"
#undef SECTION
    return TN_OK;
}

#define TN_READ_STR (from += 4, tn_get_u32(from - 4))
#define TN_READ_U32 (from += 4, tn_get_u32(from - 4))
#define TN_READ_I64 (from += 8, tn_get_i64(from - 8))
#define TN_READ_F64 (from += 8, tn_double_of((uint64_t)tn_get_i64(from - 8)))
#define F(KIND, FIELD) records[i].FIELD = TN_READ_##KIND;
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    static void read_##NAME(TYPE *records, size_t count, const uint8_t *from)                                          \
    {                                                                                                                  \
        for (size_t i = 0; i < count; i++) {                                                                           \
            FIELDS                                                                                                     \
        }                                                                                                              \
    }
#include "runtime/module/records.def"
#undef SECTION
#undef F

static void decode(const tn_stored *sections, char *block, tn_module *module)
{
    block += aligned(sizeof *module);
    memcpy(block, sections[TN_SECTION_STRINGS].bytes, sections[TN_SECTION_STRINGS].size);
    module->strings = block;
    module->strings_size = sections[TN_SECTION_STRINGS].size;
    block += aligned(module->strings_size);
    memcpy(block, sections[TN_SECTION_CODE].bytes, sections[TN_SECTION_CODE].size);
    module->code = (const uint8_t *)block;
    module->code_size = sections[TN_SECTION_CODE].size;
    block += aligned(module->code_size);
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    module->NAME##_count = sections[NUMBER].size / TN_STORED_##NAME;                                                   \
    module->NAME##_records = (const TYPE *)(const void *)block;                                                        \
    read_##NAME((TYPE *)(void *)block, module->NAME##_count, sections[NUMBER].bytes);                                  \
    block += aligned(module->NAME##_count * sizeof(TYPE));
#include "runtime/module/records.def"
#undef SECTION
}

tn_status tn_module_load(const void *bytes, size_t size, const tn_module_limits *limits, tn_module **module,
                         tn_error *error)
{
    *module = NULL;
    tn_module_limits bounds = limits ? *limits : tn_module_limits_default();
    bounds.records = bounds.records < UINT32_MAX - 1 ? bounds.records : UINT32_MAX - 1;
    bounds.stack = bounds.stack < TN_STACK_MAX ? bounds.stack : TN_STACK_MAX;
    tn_stored sections[TN_SECTION_COUNT];
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
    decode(sections, (char *)loaded, loaded);
    loaded->hash = tn_get_u64((const uint8_t *)bytes + TN_HEADER_HASH);
    status = tn_module_verify(loaded, &bounds, error);
    if (status != TN_OK) {
        free(loaded);
        return status;
    }
    *module = loaded;
    return TN_OK;
}

void tn_module_free(tn_module *module)
{
    free(module);
}

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

const tn_map_record *tn_module_place(const tn_module *module, uint32_t offset)
{
    const tn_function_record *function = function_at(module, offset);
    size_t low = 0, high = module->MAP_count; /* how many map records lie at or before the offset */
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (module->MAP_records[middle].offset <= offset)
            low = middle + 1;
        else
            high = middle;
    }
    if (!function || low == 0 || module->MAP_records[low - 1].offset < function->code_begin)
        return NULL;
    return &module->MAP_records[low - 1];
}
