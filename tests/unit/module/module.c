/* Loading: a good module comes back as it was built; a damaged one is refused; a changed one with the right hash is
 * refused or harmless. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "runtime/module/code.h"
#include "runtime/module/layout.h"
#include "tests/support/sample_module.h"

typedef struct sample {
    uint8_t *bytes;
    size_t size;
} sample;

static sample build(void)
{
    sample result;
    tn_error error;
    tn_builder *builder = sample_builder();
    assert_non_null(builder);
    assert_int_equal(tn_builder_finish(builder, &result.bytes, &result.size, &error), TN_OK);
    tn_builder_free(builder);
    return result;
}

static void test_good_module_loads(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    tn_error error;
    tn_status status = tn_module_load(good.bytes, good.size, NULL, &module, &error);
    if (status != TN_OK)
        fail_msg("%s", error.message);
    assert_string_equal(tn_text(module, module->SCHEMA_records[0].name), "toy");
    assert_int_equal(module->FIELD_count, 4);
    assert_int_equal(module->VALUE_records[1].length, 8 * TN_FOOT_NM);
    assert_int_equal(module->MASK_records[1].bits, 0xFD);
    assert_int_equal(module->PRODUCER_records[0].sources_hash, 77);
    assert_string_equal(tn_text(module, module->SOURCE_records[0].text), SAMPLE_SOURCE);
    tn_module_free(module);
    free(good.bytes);
}

static void test_sample_has_every_opcode(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    assert_int_equal(tn_module_load(good.bytes, good.size, NULL, &module, NULL), TN_OK);
    bool seen[TN_OPCODE_COUNT] = {false};
    uint32_t length;
    for (uint32_t at = 0; at < module->code_size; at += length) {
        length = tn_opcode_describe(module->code[at])->length;
        assert_int_equal(tn_code_read(module->code, at).length, length);
        seen[module->code[at]] = true;
    }
    for (int i = 0; i < TN_OPCODE_COUNT; i++)
        if (!seen[i] && !tn_code_compares((tn_opcode)i) &&             /* plan.measures has these */
            !tn_code_asks_house((tn_opcode)i) &&                       /* cli.house_oracle these */
            tn_opcode_describe((uint8_t)i)->code <= TN_CODE_CONDITION) /* unit.gene_compile and
                                                                                        unit.measure have the others */
            fail_msg("the sample has no %s", tn_opcode_describe((uint8_t)i)->name);
    tn_module_free(module);
    free(good.bytes);
}

static void test_negative_numbers_survive(void **state)
{
    (void)state;
    tn_builder *builder = sample_builder();
    tn_builder_set_PRODUCER(builder, 0, &(tn_producer_record){.sources_hash = INT64_MIN});
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, NULL), TN_OK);
    assert_int_equal(tn_module_load(bytes, size, NULL, &module, NULL), TN_OK);
    assert_true(module->PRODUCER_records[0].sources_hash == INT64_MIN);
    tn_module_free(module);
    tn_builder_free(builder);
    free(bytes);
}

/* The same input gives the same bytes. */
static void test_building_is_deterministic(void **state)
{
    (void)state;
    sample first = build(), second = build();
    assert_int_equal(first.size, second.size);
    assert_memory_equal(first.bytes, second.bytes, first.size);
    free(first.bytes);
    free(second.bytes);
}

static void test_strings_are_shared(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    char text[24];
    tn_string first[3000];
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < 3000; i++) {
            snprintf(text, sizeof text, "name-%d", i);
            tn_string string = tn_builder_string(builder, text);
            if (round == 0)
                first[i] = string;
            assert_int_equal(string, first[i]);
        }
    }
    assert_int_equal(tn_builder_string(builder, ""), 0);
    assert_int_equal(tn_builder_string(builder, NULL), 0);
    assert_int_equal(tn_builder_string_n(builder, "name-7 and more", 6), first[7]);
    assert_int_equal(tn_builder_string_n(builder, "name-7\0tail", 11), first[7]);
    tn_builder_free(builder);
}

static void test_every_truncation_is_refused(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    for (size_t size = 0; size < good.size; size++) {
        /* memory of just that size, so that a read past the end is seen */
        uint8_t *part = malloc(size + !size);
        memcpy(part, good.bytes, size);
        tn_error error;
        assert_int_equal(tn_module_load(part, size, NULL, &module, &error), TN_INVALID);
        assert_null(module);
        assert_int_equal(error.code, size < TN_MAGIC_SIZE ? 701 : 702);
        tn_module_rehash(part, size);
        assert_int_equal(tn_module_load(part, size, NULL, &module, &error), TN_INVALID);
        if (size >= TN_HEADER_BYTES) { /* and with the length made right too */
            for (int i = 0; i < 8; i++)
                part[TN_HEADER_SIZE + i] = (uint8_t)((uint64_t)size >> (8 * i));
            tn_module_rehash(part, size);
            assert_int_equal(tn_module_load(part, size, NULL, &module, &error), TN_INVALID);
        }
        free(part);
    }
    free(good.bytes);
}

static void test_bytes_after_the_end_are_refused(void **state)
{
    (void)state;
    sample good = build();
    uint8_t *longer = calloc(good.size + 1, 1);
    memcpy(longer, good.bytes, good.size);
    tn_module *module;
    assert_int_equal(tn_module_load(longer, good.size + 1, NULL, &module, NULL), TN_INVALID);
    free(longer);
    free(good.bytes);
}

static void test_every_changed_byte_is_refused(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    for (size_t at = 0; at < good.size; at++) {
        uint8_t kept = good.bytes[at];
        for (int change = 1; change < 256; change += at < TN_HEADER_BYTES + 16 * TN_ENTRY_BYTES ? 1 : 37) {
            good.bytes[at] = (uint8_t)(kept ^ change);
            assert_int_equal(tn_module_load(good.bytes, good.size, NULL, &module, NULL), TN_INVALID);
        }
        good.bytes[at] = kept;
    }
    free(good.bytes);
}

/* Lists a module, which walks all of it. */
static void walk(const tn_module *module)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_true(tn_module_disassemble(module, out));
    fclose(out);
    free(text);
}

static void test_changed_bytes_with_the_right_hash_are_harmless(void **state)
{
    (void)state;
    static const int values[] = {0, 1, 2, 3, 7, 8, 64, 127, 128, 200, 254, 255};
    sample good = build();
    size_t refused = 0, loaded = 0;
    for (size_t at = 0; at < good.size; at++) {
        uint8_t kept = good.bytes[at];
        for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
            good.bytes[at] = (uint8_t)values[i];
            tn_module_rehash(good.bytes, good.size);
            tn_module *module;
            tn_error error;
            tn_status status = tn_module_load(good.bytes, good.size, NULL, &module, &error);
            if (status == TN_OK) {
                walk(module);
                tn_module_free(module);
                loaded++;
            } else {
                assert_true(error.message[0] != '\0' && error.code >= 701);
                refused++;
            }
        }
        good.bytes[at] = kept;
    }
    assert_true(refused > good.size && loaded > 0); /* both happen, or the test tests nothing */
    free(good.bytes);
}

static void test_limits(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    tn_error error;
    tn_module_limits limits = tn_module_limits_default();
    limits.bytes = good.size - 1;
    assert_int_equal(tn_module_load(good.bytes, good.size, &limits, &module, &error), TN_LIMIT);
    assert_int_equal(error.code, 810);
    limits = tn_module_limits_default();
    limits.records = 7;
    assert_int_equal(tn_module_load(good.bytes, good.size, &limits, &module, &error), TN_LIMIT);
    assert_non_null(strstr(error.message, "8 records in its section VALUE; the limit is 7"));
    limits = tn_module_limits_default();
    limits.stack = 2;
    assert_int_equal(tn_module_load(good.bytes, good.size, &limits, &module, &error), TN_LIMIT);
    assert_non_null(strstr(error.message, "declares a stack of 3; the limit is 2"));
    limits = (tn_module_limits){SIZE_MAX, SIZE_MAX, SIZE_MAX}; /* some bounds stay */
    assert_int_equal(tn_module_load(good.bytes, good.size, &limits, &module, &error), TN_OK);
    tn_module_free(module);
    free(good.bytes);
    tn_builder *builder = sample_builder();
    tn_builder_set_FUNCTION(
        builder, 0,
        &(tn_function_record){.kind = TN_FUNCTION_CONDITION, .code_end = 67, .stack_max = TN_STACK_MAX + 1});
    assert_int_equal(tn_builder_finish(builder, &good.bytes, &good.size, &error), TN_OK);
    assert_int_equal(tn_module_load(good.bytes, good.size, &limits, &module, &error), TN_LIMIT);
    assert_string_equal(error.message, "function 0 declares a stack of 65537; the limit is 65536");
    tn_builder_free(builder);
    free(good.bytes);
}

static void test_other_format_is_said_to_be_one(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    tn_error error;
    good.bytes[TN_HEADER_FORMAT] = 9;
    assert_int_equal(tn_module_load(good.bytes, good.size, NULL, &module, &error), TN_INVALID);
    assert_int_equal(error.code, 702);
    assert_string_equal(error.message, "the module has format 9; this program reads format 2");
    assert_int_equal(tn_module_load("rule a = any\n", 13, NULL, &module, &error), TN_INVALID);
    assert_int_equal(error.code, 701);
    free(good.bytes);
}

static void test_places(void **state)
{
    (void)state;
    sample good = build();
    tn_module *module;
    assert_int_equal(tn_module_load(good.bytes, good.size, NULL, &module, NULL), TN_OK);
    const tn_function_record *condition = &module->FUNCTION_records[0], *whole = &module->FUNCTION_records[1];
    assert_null(tn_module_place(module, condition->code_begin)); /* the condition has no places of its own */
    assert_ptr_equal(tn_module_place(module, whole->code_begin), &module->SOURCE_MAP_records[0]);
    assert_ptr_equal(tn_module_place(module, whole->code_end - 1), &module->SOURCE_MAP_records[0]);
    assert_ptr_equal(tn_module_place(module, whole->code_end), &module->SOURCE_MAP_records[1]);
    assert_null(tn_module_place(module, (uint32_t)module->code_size));
    assert_null(tn_module_place(module, UINT32_MAX));
    tn_module_free(module);
    free(good.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_good_module_loads),
        cmocka_unit_test(test_sample_has_every_opcode),
        cmocka_unit_test(test_negative_numbers_survive),
        cmocka_unit_test(test_building_is_deterministic),
        cmocka_unit_test(test_strings_are_shared),
        cmocka_unit_test(test_every_truncation_is_refused),
        cmocka_unit_test(test_bytes_after_the_end_are_refused),
        cmocka_unit_test(test_every_changed_byte_is_refused),
        cmocka_unit_test(test_changed_bytes_with_the_right_hash_are_harmless),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_other_format_is_said_to_be_one),
        cmocka_unit_test(test_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
