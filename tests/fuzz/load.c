/* Loading and running any bytes as a module. The hash is made right first, and what is then still no container of
 * sections is made one, so that what is behind these checks is reached. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/random.h"
#include "runtime/module/builder.h"
#include "runtime/module/disasm.h"
#include "runtime/module/layout.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/match/rules.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/grow.h"

enum { PLANS = 8, PLAN_TRAYS = 6, STATES = 200, RULES = 32, CODES = 4096, LENGTH = 12 };

static void disassemble(const tn_module *module)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        tn_module_disassemble(module, out);
        fclose(out);
    }
    free(text);
}

/* Both engines on a few plans; where both answer, they answer the same. */
static void match(const tn_schema *schema, uint32_t function)
{
    tn_rules *vm = NULL, *dfa = NULL;
    tn_matcher *by_vm = NULL, *by_dfa = NULL;
    tn_error error;
    bool both =
        tn_rules_new(schema, &function, 1, &(tn_rules_options){TN_ENGINE_VM, STATES, LENGTH, false, TN_SIMD_BEST}, &vm,
                     &error) == TN_OK &&
        tn_rules_new(schema, &function, 1, &(tn_rules_options){TN_ENGINE_DFA, STATES, LENGTH, false, TN_SIMD_BEST},
                     &dfa, &error) == TN_OK &&
        tn_matcher_new(vm, &by_vm, &error) == TN_OK && tn_matcher_new(dfa, &by_dfa, &error) == TN_OK;
    for (uint64_t i = 0; both && i < PLANS; i++) {
        tn_tray trays[PLAN_TRAYS];
        size_t length = i % (PLAN_TRAYS + 1);
        for (size_t k = 0; k < length; k++)
            trays[k] = (tn_tray)(tn_random64(function, i, k) % schema->tray_count);
        uint64_t one = 0, other = 0;
        if (tn_match(by_vm, trays, length, &one, &error) == TN_OK &&
            tn_match(by_dfa, trays, length, &other, &error) == TN_OK && one != other) {
            fprintf(stderr, "the engines decide differently\n");
            abort();
        }
    }
    tn_matcher_free(by_vm);
    tn_matcher_free(by_dfa);
    tn_rules_free(vm);
    tn_rules_free(dfa);
}

static void count(const tn_schema *schema, uint32_t index)
{
    tn_library *library;
    tn_error error;
    tn_library_options options = {.max_states = STATES, .max_length = LENGTH, .max_table = 1u << 20};
    if (tn_library_new(schema, index, &options, &library, &error) != TN_OK)
        return;
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    mpz_clear(kept);
    tn_library_free(library);
}

static void run(const tn_module *module)
{
    disassemble(module);
    for (size_t i = 0; i < module->SCHEMA_count; i++) {
        tn_schema *schema;
        tn_error error;
        if (tn_schema_new(module, (uint32_t)i, CODES, &schema, &error) != TN_OK)
            continue;
        for (size_t r = 0; r < module->RULE_count && r < RULES; r++)
            if (module->RULE_records[r].schema == i && schema->tray_count > 0)
                match(schema, module->RULE_records[r].holds);
        for (size_t l = 0; l < module->LIBRARY_count && l < RULES; l++)
            if (module->LIBRARY_records[l].schema == i)
                count(schema, (uint32_t)l);
        tn_schema_free(schema);
    }
}

static tn_status load_and_run(uint8_t *bytes, size_t size)
{
    tn_module *module;
    tn_error error;
    tn_module_limits limits = {.bytes = 1u << 20, .records = 10000, .stack = 64};
    tn_module_rehash(bytes, size);
    tn_status status = tn_module_load(bytes, size, &limits, &module, &error);
    if (status == TN_OK)
        run(module);
    if (status == TN_OK)
        grow_module(module);
    tn_module_free(module);
    return status;
}

/* Makes the header and the table of sections fit: sizes are taken as they are where there is room, offsets and all else
 * follow. Returns the size up to which the bytes are then a container. */
static size_t repair(uint8_t *bytes, size_t size)
{
    if (size < TN_CONTENTS)
        return size;
    memcpy(bytes, TN_MAGIC, TN_MAGIC_SIZE);
    size_t offset = TN_CONTENTS;
    for (uint32_t i = 0; i < TN_SECTION_COUNT; i++) {
        uint8_t *entry = bytes + TN_HEADER_BYTES + i * TN_ENTRY_BYTES;
        uint64_t length = tn_get_u64(entry + TN_ENTRY_SIZE);
        length = length < size - offset ? length : size - offset;
        tn_put_u64(entry + TN_ENTRY_NUMBER, i);
        tn_put_u64(entry + TN_ENTRY_OFFSET, offset);
        tn_put_u64(entry + TN_ENTRY_SIZE, length);
        offset += length;
    }
    tn_put_u32(bytes + TN_HEADER_FORMAT, TN_MODULE_FORMAT);
    tn_put_u32(bytes + TN_HEADER_SECTIONS, TN_SECTION_COUNT);
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
