#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/plan/schema/boxes.h"
#include "tests/support/test_rule.h"

static tn_module *module_of(const test_schema *schema)
{
    tn_builder *builder = tn_builder_new();
    assert_non_null(builder);
    test_schema_add(builder, schema);
    return test_module(builder);
}

static void test_trays_are_numbered_in_order(void **state)
{
    (void)state;
    tn_module *module = module_of(&test_schema_house);
    tn_schema *schema = test_schema_open(module, 0);
    assert_int_equal(schema->code_count, 36);
    assert_int_equal(schema->tray_count, 34); /* two of them double 4' trays with a dense 4' machine */
    const uint8_t *before = NULL;
    for (tn_tray tray = 0; tray < schema->tray_count; tray++) {
        const uint8_t *values = schema->tray_values + (size_t)tray * schema->field_count;
        assert_true(!before || memcmp(before, values, schema->field_count) < 0);
        assert_int_equal(tn_schema_tray(schema, values), tray);
        assert_int_equal(tn_schema_forbidden_by(schema, values), UINT32_MAX);
        before = values;
    }
    tn_schema_free(schema);
    tn_module_free(module);
}

static void test_forbidden_trays_have_no_number(void **state)
{
    (void)state;
    tn_module *module = module_of(&test_schema_house);
    tn_schema *schema = test_schema_open(module, 0);
    const uint8_t forbidden[] = {0, 1, 1, 0}, legal[] = {0, 1, 1, 1};
    assert_int_equal(tn_schema_tray(schema, forbidden), TN_NO_TRAY);
    assert_int_equal(tn_schema_forbidden_by(schema, forbidden), schema->record->forbid_first);
    assert_int_not_equal(tn_schema_tray(schema, legal), TN_NO_TRAY);
    tn_schema_free(schema);
    tn_module_free(module);
}

/* Two that overlap and leave nothing: a module's, since the compiler refuses such a source. */
static void test_no_legal_tray(void **state)
{
    (void)state;
    test_schema all = test_schema_tiny;
    tn_schema *schema;
    tn_error error;
    all.forbid_count = 2;
    all.forbids[0] = 0x0d;
    all.forbids[1] = 0x0e;
    tn_module *module = module_of(&all);
    assert_int_equal(tn_schema_new(module, 0, 0, &schema, &error), TN_INVALID);
    assert_int_equal(error.code, E_NOTHING_LEGAL);
    assert_null(schema);
    tn_module_free(module);
}

static void test_specifiers(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    uint32_t index = test_schema_add(builder, &test_schema_house);
    uint64_t any = 0x3ff;
    uint64_t dense = any & ~(UINT64_C(1) << test_schema_bit(&test_schema_house, 3, 2));
    uint32_t any_spec = test_spec_add(builder, index, any), dense_spec = test_spec_add(builder, index, dense);
    tn_module *module = test_module(builder);
    tn_schema *schema = test_schema_open(module, index);
    for (tn_tray tray = 0; tray < schema->tray_count; tray++) {
        assert_true(tn_spec_meets(schema, any_spec, tray));
        assert_int_equal(tn_spec_meets(schema, dense_spec, tray), tn_tray_value(schema, tray, 3) != 2);
    }
    tn_schema_free(schema);
    tn_module_free(module);
}

static void test_fields(void **state)
{
    (void)state;
    tn_module *module = module_of(&test_schema_paper);
    tn_schema *schema = test_schema_open(module, 0);
    assert_int_equal(schema->tray_count, 864);
    assert_int_equal(tn_schema_field(schema, "body"), 5);
    assert_int_equal(tn_schema_field(schema, "bod"), UINT32_MAX);
    assert_int_equal(tn_schema_length_field(schema), 0);
    assert_int_equal(tn_schema_length_unit(schema, 0), 4 * TN_FOOT_NM);
    assert_int_equal(tn_schema_length_unit(schema, 6), TN_FOOT_NM); /* 3', 4' and none */
    assert_int_equal(tn_schema_length_unit(schema, 1), 1);          /* no lengths at all */
    assert_string_equal(tn_text(module, tn_tray_value_record(schema, 0, 5)->spelling), "open:8'");
    tn_schema_free(schema);
    tn_module_free(module);
}

/* Past the limit, trays are kept as a diagram, and what goes through them one by one is refused. */
static void test_more_than_are_listed(void **state)
{
    (void)state;
    tn_module *module = module_of(&test_schema_paper);
    tn_schema *schema = NULL;
    tn_error error;
    assert_int_equal(tn_schema_new(module, 0, 863, &schema, &error), TN_OK);
    assert_int_equal(schema->tray_count, 864);
    assert_int_equal(tn_schema_listed(schema, "this goes", &error), TN_LIMIT);
    assert_int_equal(error.code, 803);
    assert_non_null(strstr(error.message, "864"));
    tn_schema_free(schema);
    assert_int_equal(tn_schema_new(module, 0, 864, &schema, &error), TN_OK);
    assert_int_equal(tn_schema_listed(schema, "this goes", &error), TN_OK);
    tn_schema_free(schema);
    tn_module_free(module);
}

/* 40 flags are 2^40 trays: they have no numbers, and are counted. */
static void test_huge_schema_is_refused(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_tiny);
    tn_schema_record record = {.name = tn_builder_string(builder, "huge"),
                               .field_first = (uint32_t)tn_builder_count(builder, TN_SECTION_FIELD),
                               .field_count = 40,
                               .forbid_first = (uint32_t)tn_builder_count(builder, TN_SECTION_SPEC),
                               .from = TN_NO_RECORD,
                               .of = TN_NO_RECORD};
    for (unsigned i = 0; i < 40; i++) {
        char name[16];
        snprintf(name, sizeof name, "flag%u", i);
        tn_field_record field = {.name = tn_builder_string(builder, name),
                                 .kind = TN_FIELD_FLAG,
                                 .value_first = (uint32_t)tn_builder_count(builder, TN_SECTION_VALUE),
                                 .value_count = 2};
        tn_string unset = tn_builder_string(builder, "-");
        tn_builder_add_VALUE(builder, &(tn_value_record){.name = unset, .spelling = unset});
        tn_builder_add_VALUE(builder, &(tn_value_record){.name = field.name, .spelling = field.name});
        tn_builder_add_FIELD(builder, &field);
    }
    uint32_t index = tn_builder_add_SCHEMA(builder, &record);
    tn_module *module = test_module(builder);
    tn_schema *schema = NULL;
    tn_error error;
    assert_int_equal(tn_schema_new(module, index, 0, &schema, &error), TN_LIMIT);
    assert_int_equal(error.code, 803);
    assert_non_null(strstr(error.message, "huge has 1099511627776 legal trays"));
    /* Of what is listed there may be any limit. */
    assert_int_equal(tn_schema_new(module, index, UINT64_MAX, &schema, &error), TN_LIMIT);
    assert_int_equal(error.code, 803);
    tn_module_free(module);
}

/* Boxes have just the trays asked for, and none could have one value more. */
static void check_boxes(const tn_schema *schema, const bool *in)
{
    uint64_t *boxes;
    size_t count;
    tn_error error;
    test_ok(tn_tray_boxes(schema, in, &boxes, &count, &error), &error);
    for (tn_tray t = 0; t < schema->tray_count; t++) {
        bool has = false;
        for (size_t i = 0; i < count; i++)
            has = has || tn_box_has(schema, boxes + i * schema->mask_words, t);
        assert_int_equal(has, in[t]);
    }
    for (size_t i = 0; i < count; i++)
        for (uint32_t v = 0; v < schema->value_count; v++) {
            uint64_t *box = boxes + i * schema->mask_words, before = box[v / 64];
            bool others = tn_box_has_value(box, v);
            box[v / 64] |= UINT64_C(1) << (v % 64);
            for (tn_tray t = 0; t < schema->tray_count; t++)
                others = others || (tn_box_has(schema, box, t) && !in[t]);
            assert_true(others);
            box[v / 64] = before;
        }
    free(boxes);
}

static void test_boxes(void **state)
{
    (void)state;
    test_random random = {.seed = 3};
    for (uint32_t n = 0; n < 200; n++) {
        tn_module *module = module_of(n % 4 ? &test_schema_house : &test_schema_tiny);
        tn_schema *schema = test_schema_open(module, 0);
        bool in[64];
        assert_true(schema->tray_count <= 64);
        for (tn_tray t = 0; t < schema->tray_count; t++)
            in[t] = test_random_below(&random, 8) <= n % 10;
        check_boxes(schema, in);
        tn_schema_free(schema);
        tn_module_free(module);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trays_are_numbered_in_order),
        cmocka_unit_test(test_forbidden_trays_have_no_number),
        cmocka_unit_test(test_no_legal_tray),
        cmocka_unit_test(test_specifiers),
        cmocka_unit_test(test_fields),
        cmocka_unit_test(test_more_than_are_listed),
        cmocka_unit_test(test_huge_schema_is_refused),
        cmocka_unit_test(test_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
