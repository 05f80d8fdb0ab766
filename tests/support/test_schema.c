#include "tests/support/test_schema.h"
#include "runtime/load.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define FEET(n) (TN_FOOT_NM * (n))
#define LENGTH(n)                                                                                                      \
    {                                                                                                                  \
#n "'", #n "'", "", FEET(n)                                                                                    \
    }
#define NAME(n)                                                                                                        \
    {                                                                                                                  \
        n, n, "", 0                                                                                                    \
    }
#define ZONE(fill, n)                                                                                                  \
    {                                                                                                                  \
        fill, fill ":" #n "'", #n "'", FEET(n)                                                                         \
    }
#define EMPTY                                                                                                          \
    {                                                                                                                  \
        "empty", "empty", "", 0                                                                                        \
    }

const test_schema test_schema_tiny = {
    "tiny",
    2,
    {{"width", TN_FIELD_LENGTH, 2, {LENGTH(4), LENGTH(8)}}, {"open", TN_FIELD_FLAG, 2, {NAME("-"), NAME("open")}}},
    0,
    {0}};

const test_schema test_schema_house = {"house",
                                       4,
                                       {{"width", TN_FIELD_LENGTH, 3, {LENGTH(4), LENGTH(8), LENGTH(12)}},
                                        {"height", TN_FIELD_CHOICE, 2, {NAME("single"), NAME("double")}},
                                        {"public", TN_FIELD_FLAG, 2, {NAME("-"), NAME("public")}},
                                        {"machine", TN_FIELD_ZONE, 3, {ZONE("dense", 4), ZONE("dense", 8), EMPTY}}},
                                       1,
                                       {0x01 | 0x10 | 0x60 | 0x80}}; /* a double 4' tray with a dense:4' machine */

const test_schema test_schema_paper = {
    "paper",
    7,
    {{"width", TN_FIELD_LENGTH, 3, {LENGTH(4), LENGTH(8), LENGTH(12)}},
     {"height", TN_FIELD_CHOICE, 2, {NAME("single"), NAME("double")}},
     {"public", TN_FIELD_FLAG, 2, {NAME("-"), NAME("public")}},
     {"great", TN_FIELD_FLAG, 2, {NAME("-"), NAME("great")}},
     {"machine", TN_FIELD_ZONE, 3, {ZONE("dense", 4), ZONE("dense", 8), EMPTY}},
     {"body", TN_FIELD_ZONE, 4, {ZONE("open", 8), ZONE("open", 12), ZONE("dense", 8), ZONE("dense", 12)}},
     {"bay", TN_FIELD_ZONE, 3, {ZONE("open", 3), ZONE("open", 4), EMPTY}}},
    0,
    {0}};

uint32_t test_schema_bit(const test_schema *schema, uint32_t field, uint32_t value)
{
    uint32_t bit = value;
    for (uint32_t i = 0; i < field; i++)
        bit += schema->fields[i].value_count;
    return bit;
}

uint32_t test_spec_add(tn_builder *builder, uint32_t schema, uint64_t mask)
{
    uint32_t first = tn_builder_add_MASK(builder, &(tn_mask_record){.bits = (int64_t)mask});
    return tn_builder_add_SPEC(builder, &(tn_spec_record){.schema = schema, .mask_first = first});
}

static void add_field(tn_builder *builder, const test_field *field)
{
    tn_field_record record = {.name = tn_builder_string(builder, field->name),
                              .kind = field->kind,
                              .value_first = (uint32_t)tn_builder_count(builder, TN_SECTION_VALUE),
                              .value_count = field->value_count};
    for (uint32_t v = 0; v < field->value_count; v++) {
        const test_value *value = &field->values[v];
        /* A flag's name is its field's; its unset value is written "-". */
        tn_builder_add_VALUE(builder, &(tn_value_record){.name = tn_builder_string(builder, value->name),
                                                         .spelling = tn_builder_string(builder, value->spelling),
                                                         .measure = tn_builder_string(builder, value->measure),
                                                         .length = value->length});
    }
    tn_builder_add_FIELD(builder, &record);
}

uint32_t test_schema_add(tn_builder *builder, const test_schema *schema)
{
    if (tn_builder_count(builder, TN_SECTION_SOURCE) == 0) {
        tn_builder_add_SOURCE(builder, &(tn_source_record){.path = tn_builder_string(builder, "test.plan"),
                                                           .text = tn_builder_string(builder, "forbid it")});
        tn_builder_add_PRODUCER(
            builder, &(tn_producer_record){.version = tn_builder_string(builder, "test"), .sources_hash = 7});
    }
    uint32_t index = (uint32_t)tn_builder_count(builder, TN_SECTION_SCHEMA);
    tn_schema_record record = {.name = tn_builder_string(builder, schema->name),
                               .field_first = (uint32_t)tn_builder_count(builder, TN_SECTION_FIELD),
                               .field_count = schema->field_count,
                               .forbid_first = (uint32_t)tn_builder_count(builder, TN_SECTION_SPEC),
                               .forbid_count = schema->forbid_count,
                               .from = TN_NO_RECORD,
                               .of = TN_NO_RECORD};
    for (uint32_t i = 0; i < schema->field_count; i++)
        add_field(builder, &schema->fields[i]);
    for (uint32_t i = 0; i < schema->forbid_count; i++) {
        uint32_t spec = test_spec_add(builder, index, schema->forbids[i]);
        uint32_t mask = (uint32_t)tn_builder_count(builder, TN_SECTION_MASK) - 1;
        tn_builder_set_SPEC(builder, spec,
                            &(tn_spec_record){.schema = index, .mask_first = mask, .begin = 0, .end = 9});
    }
    return tn_builder_add_SCHEMA(builder, &record);
}

void test_ok(tn_status status, const tn_error *error)
{
    if (status != TN_OK)
        fail_msg("status %d, E%04u: %s", (int)status, (unsigned)error->code, error->message);
}

tn_module *test_module(tn_builder *builder)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    tn_error error;
    test_ok(tn_builder_finish(builder, &bytes, &size, &error), &error);
    tn_builder_free(builder);
    tn_module *module = NULL;
    test_ok(tn_module_load(bytes, size, NULL, &module, &error), &error);
    free(bytes);
    return module;
}

tn_schema *test_schema_open(const tn_module *module, uint32_t index)
{
    tn_schema *schema = NULL;
    tn_error error;
    test_ok(tn_schema_new(module, index, 0, &schema, &error), &error);
    return schema;
}
