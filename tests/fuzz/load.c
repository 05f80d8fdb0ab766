/* Loading and running any bytes as a module. The hash is made right first, and what is then still no container of
 * sections is made one, so that what is behind these checks is reached. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/load.h"
#include "runtime/module/builder.h"
#include "runtime/module/layout.h"
#include "runtime/module/records.h"
#include "tests/fuzz/engines.h"
#include "tests/fuzz/fuzz.h"

static tn_status load_and_run(uint8_t *bytes, size_t size)
{
    tn_module *module;
    tn_error error;
    tn_module_limits limits = {.bytes = 1u << 20, .records = 10000, .stack = 64};
    tn_module_rehash(bytes, size);
    tn_status status = tn_module_load(bytes, size, &limits, &module, &error);
    if (status == TN_OK)
        fuzz_engines(module);
    tn_module_free(module);
    return status;
}

/* Makes an entry of the table fit: it names a section of at least the number `above`, the records are of the size that
 * this program knows, and as many as there is room for. Returns the bytes that they take; 0: no such section. */
static size_t repair_entry(uint8_t *entry, uint32_t above, size_t room)
{
    uint32_t number = entry[TN_ENTRY_NUMBER], count = tn_get_u32(entry + TN_ENTRY_COUNT);
    while (number < above || (number < 256 && tn_section_numbered(number) == TN_SECTION_COUNT))
        number++;
    if (number == 256)
        return 0;
    uint32_t stored = tn_section_stored(tn_section_numbered(number));
    size_t most = room / stored;
    count = count < 1 ? 1 : count;
    count = count < most ? count : (uint32_t)most;
    tn_put_u32(entry, number | stored << 16);
    tn_put_u32(entry + TN_ENTRY_COUNT, count);
    return (size_t)count * stored;
}

/* Makes the header and the table of sections fit. Returns the size up to which the bytes are then a container. */
static size_t repair(uint8_t *bytes, size_t size)
{
    if (size < TN_HEADER_BYTES)
        return size;
    uint32_t sections = bytes[TN_HEADER_SECTIONS] % TN_SECTION_COUNT, above = 0;
    size_t offset = TN_HEADER_BYTES + sections * (size_t)TN_ENTRY_BYTES;
    if (offset > size)
        return size;
    memcpy(bytes, TN_MAGIC, TN_MAGIC_SIZE);
    for (uint32_t i = 0; i < sections; i++) {
        uint8_t *entry = bytes + TN_HEADER_BYTES + i * TN_ENTRY_BYTES;
        offset += repair_entry(entry, above, size - offset);
        above = entry[TN_ENTRY_NUMBER] + 1u;
    }
    tn_put_u32(bytes + TN_HEADER_FORMAT, TN_MODULE_FORMAT);
    tn_put_u32(bytes + TN_HEADER_SECTIONS, sections);
    tn_put_u64(bytes + TN_HEADER_SIZE, offset);
    return offset;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *bytes = malloc(size ? size : 1);
    if (!bytes)
        return 0;
    if (size)
        memcpy(bytes, data, size);
    if (load_and_run(bytes, size) != TN_OK)
        load_and_run(bytes, repair(bytes, size));
    free(bytes);
    return 0;
}
