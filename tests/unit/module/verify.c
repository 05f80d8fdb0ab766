/* The verifier: each rule that it enforces is broken once, in an otherwise good module. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "runtime/load.h"
#include "tests/support/sample_module.h"

/* What a builder makes is refused for this reason; NULL: it loads. */
static void expect(tn_builder *builder, tn_status wanted, const char *reason)
{
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    tn_error error = {0};
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, &error), TN_OK);
    tn_status status = tn_module_load(bytes, size, NULL, &module, &error);
    if (reason && !strstr(error.message, reason))
        fail_msg("wanted \"%s\", got \"%s\"", reason, error.message);
    if (!reason && status != TN_OK)
        fail_msg("wanted it to load, got \"%s\"", error.message);
    assert_int_equal(status, wanted);
    tn_module_free(module);
    tn_builder_free(builder);
    free(bytes);
}

/* Changes record `index` of a section of the sample, by an assignment, and expects that reason. */
#define REFUSED(NAME, TYPE, index, assignment, reason)                                                                 \
    do {                                                                                                               \
        tn_builder *changed = sample_builder();                                                                        \
        TYPE record = sample_##NAME(index);                                                                            \
        record.assignment;                                                                                             \
        tn_builder_set_##NAME(changed, index, &record);                                                                \
        expect(changed, TN_INVALID, reason);                                                                           \
    } while (0)

/* A copy of a record of the sample, as loading gives it. */
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    __attribute__((unused)) static TYPE sample_##NAME(size_t index)                                                    \
    {                                                                                                                  \
        tn_builder *builder = sample_builder();                                                                        \
        uint8_t *bytes;                                                                                                \
        size_t size;                                                                                                   \
        tn_module *module;                                                                                             \
        assert_int_equal(tn_builder_finish(builder, &bytes, &size, NULL), TN_OK);                                      \
        assert_int_equal(tn_module_load(bytes, size, NULL, &module, NULL), TN_OK);                                     \
        assert_true(index < module->NAME##_count);                                                                     \
        TYPE record = module->NAME##_records[index];                                                                   \
        tn_module_free(module);                                                                                        \
        tn_builder_free(builder);                                                                                      \
        free(bytes);                                                                                                   \
        return record;                                                                                                 \
    }
#include "runtime/module/records.def"

static void test_sample_is_good(void **state)
{
    (void)state;
    expect(sample_builder(), TN_OK, NULL);
    tn_builder *nothing = tn_builder_new();
    expect(nothing, TN_OK, NULL); /* an empty module is one too */
}

static void test_strings(void **state)
{
    (void)state;
    REFUSED(SCHEMA, tn_schema_record, 0, name = 1000000, "schema 0: name is no string");
    REFUSED(RULE, tn_rule_record, 0, doc = 2, "rule 0: doc is no string");
    tn_builder *builder = sample_builder();
    tn_builder_string(builder, "\xC0\xAF");
    expect(builder, TN_INVALID, "not UTF-8");
    char longest[TN_NAME_MAX + 2];
    memset(longest, 'n', sizeof longest);
    for (int over = 0; over < 2; over++) {
        builder = sample_builder();
        tn_field_record field = sample_FIELD(0);
        field.name = tn_builder_string_n(builder, longest, TN_NAME_MAX + (size_t)over);
        tn_builder_set_FIELD(builder, 0, &field);
        expect(builder, over ? TN_INVALID : TN_OK, over ? "field 0: name has more than 255 bytes" : NULL);
    }
}

static void test_names(void **state)
{
    (void)state;
    REFUSED(SCHEMA, tn_schema_record, 0, name = 0, "schema 0: name is empty");
    REFUSED(FIELD, tn_field_record, 2, name = 0, "field 2: name is empty");
    REFUSED(FIELD, tn_field_record, 2, name = sample_FIELD(0).name, "two fields of a schema have the same name");
    REFUSED(VALUE, tn_value_record, 3, name = 0, "value 3: name is empty");
    REFUSED(VALUE, tn_value_record, 3, spelling = 0, "value 3: spelling is empty");
    REFUSED(VALUE, tn_value_record, 3, spelling = sample_VALUE(2).spelling, "two values of a field are spelled alike");
    REFUSED(RULE, tn_rule_record, 0, name = 0, "rule 0: name is empty");
    REFUSED(LIBRARY, tn_library_record, 0, name = 0, "library 0: name is empty");
    REFUSED(CLAUSE, tn_clause_record, 1, name = 0, "clause 1: name is empty");
    tn_builder *builder = sample_builder();
    tn_rule_record rule = sample_RULE(0);
    tn_builder_add_RULE(builder, &rule);
    expect(builder, TN_INVALID, "two rules have the same name");
    builder = sample_builder();
    tn_library_record library = sample_LIBRARY(0);
    library.clause_first = 2;
    library.clause_count = 0;
    tn_builder_add_LIBRARY(builder, &library);
    expect(builder, TN_INVALID, "two libraries have the same name");
}

static void test_schemas(void **state)
{
    (void)state;
    REFUSED(SCHEMA, tn_schema_record, 0, field_count = 0, "schema 0: field_count is 0; 1 to 64 are possible");
    REFUSED(SCHEMA, tn_schema_record, 0, field_count = 65, "schema 0: field_count is 65; 1 to 64 are possible");
    REFUSED(SCHEMA, tn_schema_record, 0, field_count = 3, "it has field records that belong to no schema record");
    REFUSED(SCHEMA, tn_schema_record, 0, field_count = 5,
            "schema 0: its run of field records does not follow the one before");
    REFUSED(SCHEMA, tn_schema_record, 0, field_first = 1,
            "schema 0: its run of field records does not follow the one before");
    REFUSED(SCHEMA, tn_schema_record, 0, forbid_first = 3,
            "schema 0: forbid_first and forbid_count name records that are not there");
    REFUSED(SCHEMA, tn_schema_record, 0, forbid_count = UINT32_MAX,
            "schema 0: forbid_first and forbid_count name records that are not there");
    REFUSED(FIELD, tn_field_record, 0, kind = TN_FIELD_KIND_COUNT, "field 0: kind is 4; 0 to 3 are possible");
    REFUSED(FIELD, tn_field_record, 0, role = TN_FIELD_ROLE_COUNT, "field 0: role is 9; 0 to 8 are possible");
    REFUSED(FIELD, tn_field_record, 0, value_count = 0, "field 0: value_count is 0; 1 to 255 are possible");
    REFUSED(FIELD, tn_field_record, 0, value_count = 256, "field 0: value_count is 256; 1 to 255 are possible");
    REFUSED(FIELD, tn_field_record, 0, value_count = 9, "field 0: its run of value records does not follow");
    REFUSED(FIELD, tn_field_record, 1, value_first = 1, "field 1: its run of value records does not follow");
    REFUSED(FIELD, tn_field_record, 2, value_count = 1, "field 3: its run of value records does not follow");
    REFUSED(VALUE, tn_value_record, 1, length = -1, "value 1: length is ");
    REFUSED(VALUE, tn_value_record, 1, length = TN_LENGTH_MAX + 1, "value 1: length is ");
    REFUSED(VALUE, tn_value_record, 7, role = TN_FILL_ROLE_COUNT, "value 7: role is 4; 0 to 3 are possible");
    tn_builder *builder = sample_builder();
    tn_builder_add_VALUE(builder, &(tn_value_record){.name = 1, .spelling = 1});
    expect(builder, TN_INVALID, "it has value records that belong to no field record");
}

/* What the compiler refuses too: the same length twice, and more trays than a plan can have. */
static void test_as_the_compiler(void **state)
{
    (void)state;
    REFUSED(VALUE, tn_value_record, 1, length = 4 * TN_FOOT_NM, "two values of a field are the same");
    REFUSED(LIBRARY, tn_library_record, 0, trays_max = TN_TRAYS_MAX + 1, "library 0: trays_max");
}

/* A non-terminal whose one production leads to `expands`, beside one that ends. */
static void expect_grammar(uint32_t expands, uint32_t flags, const char *reason)
{
    tn_builder *builder = sample_builder();
    tn_grammar_record grammar = {
        .name = tn_builder_string(builder, "g"), .flags = flags, .rule_count = 2, .repair = TN_REPAIR_OFF};
    grammar.rewrite_rule = grammar.predecessor = grammar.successor = TN_NO_RECORD;
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t begin = tn_builder_offset(builder);
        tn_builder_emit(builder, i == 0 ? TN_OP_EXPAND : TN_OP_EMIT, i == 0 ? expands : 0, 0);
        tn_builder_emit(builder, TN_OP_DONE, 0, 0);
        tn_builder_add_PRODUCTION(builder,
                                  &(tn_production_record){.code_begin = begin, .code_end = tn_builder_offset(builder)});
        tn_builder_add_NONTERMINAL(builder, &(tn_nonterminal_record){.name = tn_builder_string(builder, i ? "b" : "a"),
                                                                     .production_first = i,
                                                                     .production_count = 1});
    }
    tn_builder_add_GRAMMAR(builder, &grammar);
    expect(builder, reason ? TN_INVALID : TN_OK, reason);
}

static void test_grammars_end(void **state)
{
    (void)state;
    expect_grammar(1, 0, NULL);
    expect_grammar(0, 0, "non-terminal 0 can never end");
}

static void test_flags_of_grammars(void **state)
{
    (void)state;
    expect_grammar(1, TN_SKIP_SINGLE, NULL);
    expect_grammar(1, TN_POSITION_INDEPENDENT, NULL);
    expect_grammar(1, TN_SKIP_SINGLE | TN_POSITION_INDEPENDENT, "reads codons in pairs, and none for single choices");
    expect_grammar(1, TN_GRAMMAR_FLAGS + 1, "flags");
}

static void test_second_schema(void **state)
{
    (void)state;
    tn_builder *builder = sample_builder();
    tn_builder_add_SCHEMA(builder, &(tn_schema_record){.name = tn_builder_string(builder, "other"),
                                                       .field_first = 4,
                                                       .field_count = 1,
                                                       .forbid_count = 1,
                                                       .from = TN_NO_RECORD,
                                                       .of = TN_NO_RECORD});
    sample_field(builder, "width", TN_FIELD_CHOICE, TN_ROLE_NONE);
    sample_value(builder, "a", "a", "", 0, 0);
    sample_value(builder, "b", "b", "", 0, 0);
    expect(builder, TN_INVALID, "schema 1 forbids a tray of another schema");
    builder = sample_builder();
    tn_schema_record schema = sample_SCHEMA(0);
    schema.field_first = 4;
    schema.field_count = 1;
    schema.forbid_count = 0;
    tn_builder_add_SCHEMA(builder, &schema);
    sample_field(builder, "width", TN_FIELD_CHOICE, TN_ROLE_NONE);
    sample_value(builder, "a", "a", "", 0, 0);
    sample_value(builder, "b", "b", "", 0, 0);
    expect(builder, TN_INVALID, "two schemas have the same name");
}

/* A schema that is made from the first: the first field as it is there, or without its second value. */
static void test_schema_made_from_another(void **state)
{
    (void)state;
    for (uint32_t count = 1; count <= 4; count += 3) {
        tn_builder *builder = sample_builder();
        tn_schema_record schema = sample_SCHEMA(0);
        schema.name = tn_builder_string(builder, "newer");
        schema.from = 0;
        schema.field_first = 4;
        schema.field_count = count;
        schema.forbid_count = 0;
        tn_builder_add_SCHEMA(builder, &schema);
        uint32_t value_first = 8;
        for (uint32_t f = 0; f < count; f++) {
            tn_field_record field = sample_FIELD(f);
            field.value_first = value_first;
            value_first += field.value_count;
            tn_builder_add_FIELD(builder, &field);
            for (uint32_t v = 0; v < field.value_count; v++) {
                tn_value_record value = sample_VALUE(sample_FIELD(f).value_first + v);
                tn_builder_add_VALUE(builder, &value);
            }
        }
        expect(builder, count == 4 ? TN_OK : TN_INVALID,
               count == 4 ? NULL : "schema 1 lacks a field or value of the schema it is made from");
    }
    REFUSED(SCHEMA, tn_schema_record, 0, from = 1, "schema 0: from is schema 1, which is not there");
}

static void test_specifiers(void **state)
{
    (void)state;
    REFUSED(SPEC, tn_spec_record, 1, schema = 1, "spec 1: schema is schema 1, which is not there");
    REFUSED(SPEC, tn_spec_record, 1, mask_first = 2, "spec 1: mask_first is mask 2, which is not there");
    REFUSED(SPEC, tn_spec_record, 1, mask_first = UINT32_MAX, "spec 1: mask_first is mask 4294967295");
    REFUSED(MASK, tn_mask_record, 1, bits = 0x1FD, "specifier 1 has a bit beyond the schema's last value");
    REFUSED(MASK, tn_mask_record, 1, bits = -1, "specifier 1 has a bit beyond the schema's last value");
}

static void test_places(void **state)
{
    (void)state;
    uint32_t size = (uint32_t)strlen(SAMPLE_SOURCE);
    REFUSED(SCHEMA, tn_schema_record, 0, file = 1, "schema 0: it names a place outside its source");
    REFUSED(SPEC, tn_spec_record, 1, end = size + 1, "spec 1: it names a place outside its source");
    REFUSED(RULE, tn_rule_record, 0, begin = size, "rule 0: it names a place outside its source");
    REFUSED(LIBRARY, tn_library_record, 0, end = size + 1, "library 0: it names a place outside its source");
    REFUSED(CLAUSE, tn_clause_record, 1, begin = 1, "clause 1: it names a place outside its source");
    REFUSED(SOURCE_MAP, tn_source_map_record, 2, end = UINT32_MAX, "source map 2: it names a place outside its source");
}

static void test_rules_and_libraries(void **state)
{
    (void)state;
    const char *reason = "rule 0 names a function of another kind or schema";
    REFUSED(RULE, tn_rule_record, 0, whole = 2, reason);
    REFUSED(RULE, tn_rule_record, 0, holds = 1, reason);
    REFUSED(RULE, tn_rule_record, 0, holds = 6, "rule 0: holds is function 6, which is not there");
    REFUSED(RULE, tn_rule_record, 0, holds = 0, reason);
    REFUSED(RULE, tn_rule_record, 0, schema = 1, "rule 0: schema is schema 1, which is not there");
    REFUSED(RULE, tn_rule_record, 0, flags = 2, "rule 0: flags has unknown bits");
    REFUSED(LIBRARY, tn_library_record, 0, flags = 2, "library 0: flags has unknown bits");
    REFUSED(LIBRARY, tn_library_record, 0, schema = 1, "library 0: schema is schema 1, which is not there");
    REFUSED(LIBRARY, tn_library_record, 0, trays_min = 7, "library 0 has fewer trays at most than at least");
    REFUSED(LIBRARY, tn_library_record, 0, clause_count = 1, "it has clause records that belong to no library record");
    REFUSED(LIBRARY, tn_library_record, 0, clause_count = 3, "library 0: its run of clause records does not follow");
    REFUSED(LIBRARY, tn_library_record, 0, clause_first = 1, "library 0: its run of clause records does not follow");
    REFUSED(CLAUSE, tn_clause_record, 0, kind = TN_CLAUSE_KIND_COUNT, "clause 0: kind is 5; 0 to 4 are possible");
    REFUSED(CLAUSE, tn_clause_record, 0, holds = 1, "clause 0 names a function of another kind or schema");
    tn_builder *builder = sample_builder();
    tn_builder_add_PRODUCER(builder, &(tn_producer_record){0});
    expect(builder, TN_INVALID, "more than one producer");
}

static void test_functions(void **state)
{
    (void)state;
    REFUSED(FUNCTION, tn_function_record, 1, kind = TN_FUNCTION_KIND_COUNT, "function 1: kind is 15");
    REFUSED(FUNCTION, tn_function_record, 0, kind = TN_FUNCTION_KIND_COUNT,
            "function 0: kind is 15; 0 to 14 are possible");
    REFUSED(FUNCTION, tn_function_record, 1, stack_max = 1, "the stack passes the 1 that the function declares");
    REFUSED(FUNCTION, tn_function_record, 1, code_begin = 0, "not the stretch after the one before");
    REFUSED(FUNCTION, tn_function_record, 3, code_end = UINT32_MAX, "not the stretch after the one before");
    REFUSED(FUNCTION, tn_function_record, 1, code_end = 0, "not the stretch after the one before");
    REFUSED(FUNCTION, tn_function_record, 0, code_end = 0, "function 0, code offset 0: its code is not the stretch");
    REFUSED(FUNCTION, tn_function_record, 0, code_end = 5, "LESS runs past its end");
    REFUSED(FUNCTION, tn_function_record, 0, kind = TN_FUNCTION_WHOLE, "LESS does not belong in this kind of code");
    tn_builder *builder = sample_builder();
    tn_builder_emit(builder, TN_OP_NOT, 0, 0);
    expect(builder, TN_INVALID, "code that belongs to no function or production");
}

/* One more function, of these instructions, each an opcode and its two operands; ended by -1. */
static tn_builder *with_code(tn_function_kind kind, uint32_t stack_max, const int64_t *code)
{
    tn_builder *builder = sample_builder();
    uint32_t begin = tn_builder_offset(builder);
    for (; code[0] >= 0; code += 3)
        tn_builder_emit(builder, (tn_opcode)code[0], code[1], code[2]);
    tn_builder_add_FUNCTION(builder, &(tn_function_record){.kind = kind,
                                                           .code_begin = begin,
                                                           .code_end = tn_builder_offset(builder),
                                                           .stack_max = stack_max});
    return builder;
}

#define CODE(...) ((const int64_t[]){__VA_ARGS__, -1})
#define RETURN TN_OP_RETURN, 0, 0
#define ANSWER TN_OP_ANSWER, 0, 0

/* Libraries above one another: each asks for plans of the one before. */
static void test_images(void **state)
{
    (void)state;
    REFUSED(CLAUSE, tn_clause_record, 0, holds = 5,
            "function 5 asks library 0, which has functions that are not lower");
    tn_builder *summed = sample_builder();
    tn_builder_add_SUM(summed, &(tn_sum_record){.constant = tn_builder_string(summed, "0"), .term_count = 1});
    tn_builder_add_TERM(summed, &(tn_term_record){.kind = TN_SUM_MATCHES,
                                                  .factor = tn_builder_string(summed, "1"),
                                                  .part = 5,
                                                  .tally = TN_NO_RECORD,
                                                  .other = TN_NO_RECORD});
    expect(summed, TN_INVALID, "term 0 asks for plans of another library");
    tn_builder *deep[2] = {sample_builder(), sample_builder()};
    for (uint32_t i = 0; i < 16; i++)
        for (uint32_t b = i == 15; b < 2; b++) {
            char name[16];
            snprintf(name, sizeof name, "toys-%u", (unsigned)i);
            tn_builder_add_LIBRARY(deep[b], &(tn_library_record){.name = tn_builder_string(deep[b], name),
                                                                 .clause_first = 2 + i,
                                                                 .clause_count = 1});
            tn_builder_add_CLAUSE(deep[b], &(tn_clause_record){.name = tn_builder_string(deep[b], "toys"),
                                                               .kind = TN_CLAUSE_ONTO,
                                                               .holds = 5 + i});
            uint32_t begin = tn_builder_offset(deep[b]);
            tn_builder_emit(deep[b], TN_OP_IMAGE, 1 + i, 0);
            tn_builder_emit(deep[b], TN_OP_RETURN, 0, 0);
            tn_builder_add_FUNCTION(deep[b], &(tn_function_record){.kind = TN_FUNCTION_HOLDS,
                                                                   .code_begin = begin,
                                                                   .code_end = tn_builder_offset(deep[b]),
                                                                   .stack_max = 1});
        }
    expect(deep[0], TN_OK, NULL);
    expect(deep[1], TN_INVALID, "more than 16 libraries lie above one another");
}

static void test_operands(void **state)
{
    (void)state;
    tn_function_kind rule = TN_FUNCTION_HOLDS, condition = TN_FUNCTION_CONDITION;
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 1, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 2, 0, RETURN)), TN_INVALID, "there is no spec 2");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 6, 0, RETURN)), TN_INVALID, "function 6, which is not a lower one");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 7, 0, RETURN)), TN_INVALID, "there is no function 7");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 4, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 9, CODE(TN_OP_AGAIN, 4, 0, RETURN)), TN_INVALID, "is not in a circle with it");
    expect(with_code(TN_FUNCTION_CIRCLE, 9, CODE(TN_OP_AGAIN, 1, 0, RETURN)), TN_INVALID, "is not in a circle with it");
    expect(with_code(TN_FUNCTION_CIRCLE, 9, CODE(TN_OP_AGAIN, 6, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_REPEATED, 2, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_REPEATED, 0, 2, RETURN)), TN_INVALID, "is cut into 1 to");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_REPEATED, 3, 2, RETURN)), TN_INVALID, "is cut into 1 to");
    expect(with_code(rule, 9, CODE(TN_OP_IMAGE, 0, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 9, CODE(TN_OP_IMAGE, 1, 0, RETURN)), TN_INVALID, "there is no library 1");
    expect(with_code(rule, 9, CODE(TN_OP_IMAGE, 0, 1, RETURN)), TN_INVALID, "there is no schema 1");
    expect(with_code(TN_FUNCTION_WHOLE, 9, CODE(TN_OP_IMAGE, 0, 0, RETURN)), TN_INVALID,
           "asks for plans of library 0 beside other things");
    expect(with_code(rule, 9, CODE(TN_OP_IMAGE, 0, 0, TN_OP_NOT, 0, 0, RETURN)), TN_INVALID,
           "asks for plans of library 0 beside other things");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 5, 0, RETURN)), TN_INVALID,
           "calls function 5, which asks for plans of another library");
    expect(with_code(rule, 9, CODE(TN_OP_MIRROR, 0, 0, RETURN)), TN_INVALID, "function 0, which is not part of a rule");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_QUANTITY, 1, 0, RETURN)), TN_INVALID,
           "function 1 is no condition");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_OCCURRENCES, 9, 0, RETURN)), TN_INVALID,
           "there is no function 9");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_SUM, 3, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_SUM, 1, 0, RETURN)), TN_INVALID, "field 1 has no lengths");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_SUM, 4, 0, RETURN)), TN_INVALID, "there is no field 4");
    expect(with_code(rule, 9, CODE(TN_OP_CALL, 1, 0, TN_OP_SUM, 0, 1, RETURN)), TN_INVALID,
           "function 1 is no condition");
    expect(with_code(condition, 9, CODE(TN_OP_REMAINDER, 1, 0, ANSWER)), TN_OK, NULL);
    expect(with_code(condition, 9, CODE(TN_OP_REMAINDER, 0, 0, ANSWER)), TN_INVALID, "a divisor above 0");
    expect(with_code(condition, 9, CODE(TN_OP_REMAINDER, 3, -1, ANSWER)), TN_INVALID, "a rest not below 0");
    expect(with_code(condition, 9, CODE(TN_OP_WITHIN, INT64_MAX, INT64_MIN, ANSWER)), TN_OK, NULL);
}

static void test_stack(void **state)
{
    (void)state;
    tn_function_kind rule = TN_FUNCTION_HOLDS, condition = TN_FUNCTION_CONDITION;
    expect(with_code(rule, 9, CODE(RETURN)), TN_INVALID, "RETURN takes 1 from a stack of 0");
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 1, 0, TN_OP_AND, 0, 0, RETURN)), TN_INVALID,
           "AND takes 2 from a stack of 1");
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 1, 0, TN_OP_TRAY, 1, 0, RETURN)), TN_INVALID, "RETURN leaves 1");
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 1, 0)), TN_INVALID, "does not end with RETURN");
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 1, 0, RETURN, TN_OP_TRAY, 1, 0, RETURN)), TN_INVALID,
           "code follows the function's end");
    expect(with_code(rule, 1, CODE(TN_OP_TRAY, 1, 0, TN_OP_TRAY, 1, 0, TN_OP_OR, 0, 0, RETURN)), TN_INVALID,
           "the stack passes the 1 that the function declares");
    expect(with_code(rule, 4096, CODE(TN_OP_TRAY, 1, 0, RETURN)), TN_OK, NULL);
    expect(with_code(rule, 4097, CODE(TN_OP_TRAY, 1, 0, RETURN)), TN_LIMIT,
           "declares a stack of 4097; the limit is 4096");
    expect(with_code(rule, 9, CODE(TN_OP_TRAY, 1, 0, ANSWER)), TN_INVALID, "ANSWER does not belong");
    expect(with_code(condition, 9, CODE(TN_OP_LESS, 1, 0, RETURN)), TN_INVALID, "RETURN does not belong");
    expect(with_code(condition, 9, CODE(TN_OP_LESS, 1, 0, TN_OP_BOTH, 0, 0, ANSWER)), TN_INVALID,
           "BOTH takes 2 from a stack of 1");
}

static void test_map(void **state)
{
    (void)state;
    REFUSED(SOURCE_MAP, tn_source_map_record, 1, offset = sample_SOURCE_MAP(1).offset + 1,
            "the source map's record 1 names no instruction");
    REFUSED(SOURCE_MAP, tn_source_map_record, 1, offset = sample_SOURCE_MAP(0).offset,
            "the source map does not ascend at its record 1");
    REFUSED(SOURCE_MAP, tn_source_map_record, 0, offset = sample_SOURCE_MAP(1).offset,
            "the source map does not ascend at its record 1");
    REFUSED(SOURCE_MAP, tn_source_map_record, 2, offset = UINT32_MAX, "the source map names places past the code");
}

/* The reason names the code offset, so that a finding can be shown in the source. */
static void test_error_has_the_code_offset(void **state)
{
    (void)state;
    tn_builder *builder = with_code(TN_FUNCTION_HOLDS, 9, CODE(TN_OP_TRAY, 1, 0, TN_OP_AND, 0, 0, RETURN));
    uint32_t offset = tn_builder_offset(builder) - 2;
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    tn_error error;
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, &error), TN_OK);
    assert_int_equal(tn_module_load(bytes, size, NULL, &module, &error), TN_INVALID);
    assert_int_equal(error.code, 703);
    assert_int_equal(error.code_offset, offset);
    tn_builder_free(builder);
    free(bytes);
}

/* Texts that many records share are not measured without end. */
static void test_sources_are_bounded_together(void **state)
{
    (void)state;
    tn_builder *builder = tn_builder_new();
    size_t length = 1000000;
    char *text = malloc(length);
    memset(text, 'x', length);
    tn_string shared = tn_builder_string_n(builder, text, length);
    for (int i = 0; i < 1000; i++)
        tn_builder_add_SOURCE(builder, &(tn_source_record){.text = shared});
    free(text);
    expect(builder, TN_LIMIT, "the module's sources together pass the limit of 268435456 bytes");
}

/* A function that decides on all cells; its number. */
static uint32_t add_every_cell(tn_builder *builder)
{
    uint32_t function = (uint32_t)tn_builder_count(builder, TN_SECTION_FUNCTION), begin = tn_builder_offset(builder);
    tn_builder_emit(builder, TN_OP_EVERY, 0, 0);
    tn_builder_emit(builder, TN_OP_DECIDE, 0, 0);
    tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, "cells"),
                                                           .kind = TN_FUNCTION_CELL,
                                                           .code_begin = begin,
                                                           .code_end = tn_builder_offset(builder),
                                                           .stack_max = 1});
    return function;
}

/* The sample with a form that has a function, a void and so wide ways; the function that decides on their cells. */
static tn_builder *builder_of_form(const tn_cell_rule_record *void_rule, const tn_form_record *form, uint32_t *function)
{
    tn_builder *builder = sample_builder();
    *function = add_every_cell(builder);
    tn_cell_rule_record rule = {.name = tn_builder_string(builder, "porch"), .decides = *function, .flags = TN_OUTDOOR};
    tn_builder_add_STOREY(builder, &(tn_storey_record){.name = tn_builder_string(builder, "ground"), .height = 9});
    tn_builder_add_CELL_RULE(builder, &rule);
    rule = *void_rule;
    rule.name = tn_builder_string(builder, NULL);
    rule.decides = *function;
    tn_builder_add_CELL_RULE(builder, &rule);
    tn_form_record record = *form;
    record.name = tn_builder_string(builder, "huts");
    record.spine = 3;
    record.wall = record.partition = 2;
    record.deck = record.roof = 1;
    record.storey_count = 1;
    record.rule_count = 2;
    tn_builder_add_FORM(builder, &record);
    return builder;
}

static void expect_form(const tn_cell_rule_record *void_rule, const tn_form_record *form, const char *reason)
{
    uint32_t function;
    expect(builder_of_form(void_rule, form, &function), reason ? TN_INVALID : TN_OK, reason);
}

enum { EVERY_CELL = 1000, NO_CELLS, PAST_ALL }; /* functions of walks, beside those of the sample */

static uint32_t function_of_walk(tn_builder *builder, uint32_t function, uint32_t every)
{
    return function == EVERY_CELL ? every
           : function == NO_CELLS ? TN_NO_RECORD
           : function == PAST_ALL ? (uint32_t)tn_builder_count(builder, TN_SECTION_FUNCTION)
                                  : function;
}

/* The same with ways so wide and a measure of one term: of the walk, unless its own is NO_CELLS. */
static void expect_walk(int64_t way, tn_meeting_record walk, tn_house_term_record term, const char *factor,
                        const char *reason)
{
    uint32_t every;
    tn_builder *builder = builder_of_form(&(tn_cell_rule_record){.kind = TN_CELL_VOID},
                                          &(tn_form_record){.way = way, .headroom = way > 0}, &every);
    uint32_t sum = (uint32_t)tn_builder_count(builder, TN_SECTION_SUM),
             meeting = (uint32_t)tn_builder_count(builder, TN_SECTION_MEETING),
             first = (uint32_t)tn_builder_count(builder, TN_SECTION_HOUSE_TERM);
    walk.first = function_of_walk(builder, walk.first, every);
    walk.second = function_of_walk(builder, walk.second, every);
    walk.through = function_of_walk(builder, walk.through, every);
    tn_builder_add_MEETING(builder, &walk);
    term.factor = tn_builder_string(builder, factor);
    term.part = function_of_walk(builder, term.part, every);
    term.walk = term.walk == NO_CELLS ? TN_NO_RECORD : term.walk == PAST_ALL ? meeting + 1 : meeting;
    tn_builder_add_HOUSE_TERM(builder, &term);
    tn_builder_add_SUM(builder, &(tn_sum_record){.power = 1, .constant = tn_builder_string(builder, "0")});
    tn_builder_add_HOUSE_MEASURE(
        builder, &(tn_house_measure_record){
                     .name = tn_builder_string(builder, "far"), .sum = sum, .term_first = first, .term_count = 1});
    expect(builder, reason ? TN_INVALID : TN_OK, reason);
}

/* A term of a walk between any cells, by way of any; of ways out of any. */
static void test_walks(void **state)
{
    (void)state;
    const tn_meeting_record any = {.first = EVERY_CELL, .second = EVERY_CELL, .through = EVERY_CELL};
    const tn_house_term_record walk = {.kind = TN_HOUSE_LONGEST_WALK, .part = NO_CELLS},
                               least = {.kind = TN_HOUSE_SHORTEST_WALK, .part = NO_CELLS},
                               exits = {.kind = TN_HOUSE_EXITS, .part = EVERY_CELL, .walk = NO_CELLS};
    tn_meeting_record m = any;
    tn_house_term_record t = walk;
    expect_walk(2, any, walk, "1", NULL);
    expect_walk(2, any, least, "-1/3", NULL);
    expect_walk(2, any, exits, "1", NULL);
    m.second = m.through = NO_CELLS; /* to the outside, by any cells */
    expect_walk(2, m, walk, "1", NULL);
    expect_walk(0, any, walk, "1", "is of walks, and the form does not ask for ways");
    expect_walk(0, any, least, "1", "is of walks, and the form does not ask for ways");
    expect_walk(0, any, exits, "1", "is of walks, and the form does not ask for ways");
    expect_walk(2, any, walk, "0", "has no factor, or 0");
    expect_walk(2, any, walk, "a", "has no factor, or 0");
    for (uint32_t kind = TN_HOUSE_LONGEST_WALK; kind <= TN_HOUSE_EXITS; kind++) {
        t = (tn_house_term_record){.kind = kind, .part = EVERY_CELL};
        expect_walk(2, any, t, "1", "does not say what it adds up");
        t = (tn_house_term_record){.kind = kind, .part = NO_CELLS, .walk = NO_CELLS};
        expect_walk(2, any, t, "1", "does not say what it adds up");
        t = (tn_house_term_record){.kind = kind, .part = NO_CELLS, .walk = PAST_ALL};
        expect_walk(2, any, t, "1", "walk");
    }
    t = exits;
    t.part = 0;
    expect_walk(2, any, t, "1", "names a function of another kind or schema");
    t.part = PAST_ALL;
    expect_walk(2, any, t, "1", "part");
    t = walk;
    t.kind = TN_HOUSE_EXITS + 1;
    expect_walk(2, any, t, "1", "kind");
    uint32_t *const ends[] = {&m.first, &m.second, &m.through};
    for (size_t i = 0; i < 3; i++) {
        m = any;
        *ends[i] = 0;
        expect_walk(2, m, walk, "1", "is not between cells");
        *ends[i] = PAST_ALL;
        expect_walk(2, m, walk, "1", i == 0 ? "first" : i == 1 ? "second" : "through");
    }
    m = any;
    m.first = NO_CELLS;
    expect_walk(2, m, walk, "1", "first");
    m = any;
    m.kind_count = 1;
    expect_walk(2, m, walk, "1", "kind");
}

static void test_forms(void **state)
{
    (void)state;
    const tn_cell_rule_record plain = {.kind = TN_CELL_VOID};
    expect_form(&plain, &(tn_form_record){0}, NULL);
    expect_form(&(tn_cell_rule_record){.kind = TN_CELL_VOID, .flags = TN_OUTDOOR}, &(tn_form_record){0},
                "line 1 of cells is outdoor and no function");
    expect_form(&(tn_cell_rule_record){.kind = TN_CELL_VOID, .flags = 2}, &(tn_form_record){0}, "flags");
    expect_form(&(tn_cell_rule_record){.kind = TN_CELL_VOID, .way = 2}, &(tn_form_record){0},
                "line 1 of cells has a way whose half is not whole, or that its form has not");
    expect_form(&plain, &(tn_form_record){.way = 3, .headroom = 1}, "ways whose halves are not whole");
    expect_form(&plain, &(tn_form_record){.way = 2}, "or without headroom");
}

/* The form with a classification of these parts. Its own are 7: those of every form, and guards. */
static void expect_classes(const uint32_t *parts, uint32_t count, const char *code, const char *reason)
{
    const tn_cell_rule_record plain = {.kind = TN_CELL_VOID};
    uint32_t function;
    tn_builder *builder = builder_of_form(&plain, &(tn_form_record){.classification_count = 1}, &function);
    for (uint32_t i = 0; i < count; i++)
        tn_builder_add_CLASS(builder, &(tn_class_record){.part = parts[i], .code = tn_builder_string(builder, code)});
    tn_builder_add_CLASSIFICATION(builder, &(tn_classification_record){.name = tn_builder_string(builder, "DIN 276"),
                                                                       .class_count = count});
    expect(builder, reason ? TN_INVALID : TN_OK, reason);
}

static void test_classifications(void **state)
{
    (void)state;
    enum { GUARD = TN_OF_COUNT, PORCH, VOID, PAST };
    const char *none = "classification 0 has a code for what cannot have one";
    expect_classes((uint32_t[]){TN_OF_WALL, TN_OF_ROOF, GUARD, PORCH}, 4, "330", NULL);
    expect_classes((uint32_t[]){VOID}, 1, "330", none);
    expect_classes((uint32_t[]){PAST}, 1, "330", none);
    expect_classes((uint32_t[]){UINT32_MAX}, 1, "330", none);
    expect_classes((uint32_t[]){TN_OF_ROOF, TN_OF_WALL}, 2, "330", "classification 0 has a code out of order");
    expect_classes((uint32_t[]){TN_OF_ROOF, TN_OF_ROOF}, 2, "330", "classification 0 has a code out of order");
    expect_classes((uint32_t[]){TN_OF_ROOF}, 1, "", "code");
    expect_classes(NULL, 0, "330", "class");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_walks),
        cmocka_unit_test(test_classifications),
        cmocka_unit_test(test_sample_is_good),
        cmocka_unit_test(test_strings),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_schemas),
        cmocka_unit_test(test_as_the_compiler),
        cmocka_unit_test(test_grammars_end),
        cmocka_unit_test(test_flags_of_grammars),
        cmocka_unit_test(test_second_schema),
        cmocka_unit_test(test_schema_made_from_another),
        cmocka_unit_test(test_specifiers),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_rules_and_libraries),
        cmocka_unit_test(test_functions),
        cmocka_unit_test(test_images),
        cmocka_unit_test(test_operands),
        cmocka_unit_test(test_stack),
        cmocka_unit_test(test_map),
        cmocka_unit_test(test_error_has_the_code_offset),
        cmocka_unit_test(test_sources_are_bounded_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
