/* A module built by hand that has a record in every section and every opcode in its code: what the tests of the loader,
 * the verifier and the disassembler change and look at. */
#ifndef TARTAN_TESTS_SAMPLE_MODULE_H
#define TARTAN_TESTS_SAMPLE_MODULE_H

#include <string.h>

#include "runtime/base/length.h"
#include "runtime/module/builder.h"

#define SAMPLE_SOURCE                                                                                                  \
    "schema toy {\n"                                                                                                   \
    "  width = 4' | 8'\n"                                                                                              \
    "}\n"                                                                                                              \
    "rule pair = neighbour(tray(4'), tray(4'))\n"                                                                      \
    "library toys using toy { trays 1..6 prune pair }\n"

/* The place of a piece of SAMPLE_SOURCE. */
static inline uint32_t sample_begin(const char *piece)
{
    return (uint32_t)(strstr(SAMPLE_SOURCE, piece) - SAMPLE_SOURCE);
}

static inline void sample_value(tn_builder *builder, const char *name, const char *spelling, const char *measure,
                                uint32_t role, int64_t length)
{
    tn_builder_add_VALUE(builder, &(tn_value_record){.name = tn_builder_string(builder, name),
                                                     .spelling = tn_builder_string(builder, spelling),
                                                     .measure = tn_builder_string(builder, measure),
                                                     .role = role,
                                                     .length = length});
}

static inline void sample_field(tn_builder *builder, const char *name, tn_field_kind kind, tn_field_role role)
{
    uint32_t first = (uint32_t)tn_builder_count(builder, TN_SECTION_VALUE);
    tn_builder_add_FIELD(builder, &(tn_field_record){.name = tn_builder_string(builder, name),
                                                     .doc = tn_builder_string(builder, "a field"),
                                                     .kind = kind,
                                                     .role = role,
                                                     .value_first = first,
                                                     .value_count = 2});
}

static inline void sample_schema(tn_builder *builder)
{
    tn_builder_add_SCHEMA(builder, &(tn_schema_record){.name = tn_builder_string(builder, "toy"),
                                                       .doc = tn_builder_string(builder, "small trays"),
                                                       .field_count = 4,
                                                       .forbid_count = 1,
                                                       .end = sample_begin("rule"),
                                                       .from = TN_NO_RECORD,
                                                       .of = TN_NO_RECORD});
    sample_field(builder, "width", TN_FIELD_LENGTH, TN_ROLE_LENGTH);
    sample_value(builder, "4'", "4'", "", TN_FILL_NONE, 4 * TN_FOOT_NM);
    sample_value(builder, "8'", "8'", "", TN_FILL_NONE, 8 * TN_FOOT_NM);
    sample_field(builder, "height", TN_FIELD_CHOICE, TN_ROLE_LEVEL);
    sample_value(builder, "single", "single", "", TN_FILL_NONE, 0);
    sample_value(builder, "double", "double", "", TN_FILL_NONE, 0);
    sample_field(builder, "public", TN_FIELD_FLAG, TN_ROLE_PUBLIC_END);
    sample_value(builder, "-", "-", "", TN_FILL_NONE, 0);
    sample_value(builder, "public", "public", "", TN_FILL_NONE, 0);
    sample_field(builder, "body", TN_FIELD_ZONE, TN_ROLE_BAND);
    sample_value(builder, "open", "open:8'", "8'", TN_FILL_VOID, 8 * TN_FOOT_NM);
    sample_value(builder, "empty", "empty", "", TN_FILL_ABSENT, 0);
}

static inline uint32_t sample_spec(tn_builder *builder, uint64_t bits)
{
    uint32_t mask = tn_builder_add_MASK(builder, &(tn_mask_record){.bits = (int64_t)bits});
    uint32_t begin = sample_begin("tray(4')");
    return tn_builder_add_SPEC(builder, &(tn_spec_record){.mask_first = mask, .begin = begin, .end = begin + 8});
}

static inline void sample_map(tn_builder *builder, const char *piece)
{
    uint32_t begin = sample_begin(piece);
    tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){.offset = tn_builder_offset(builder),
                                                               .begin = begin,
                                                               .end = begin + (uint32_t)strlen(piece)});
}

/* Ends the function whose code began at `begin`. */
static inline uint32_t sample_function(tn_builder *builder, const char *name, tn_function_kind kind, uint32_t begin,
                                       uint32_t stack_max)
{
    tn_builder_emit(builder, kind == TN_FUNCTION_CONDITION ? TN_OP_ANSWER : TN_OP_RETURN, 0, 0);
    return tn_builder_add_FUNCTION(builder, &(tn_function_record){.name = tn_builder_string(builder, name),
                                                                  .kind = kind,
                                                                  .code_begin = begin,
                                                                  .code_end = tn_builder_offset(builder),
                                                                  .stack_max = stack_max});
}

static inline uint32_t sample_condition(tn_builder *builder)
{
    uint32_t begin = tn_builder_offset(builder);
    tn_builder_emit(builder, TN_OP_LESS, 5, 0);
    tn_builder_emit(builder, TN_OP_EQUAL, -1, 0);
    tn_builder_emit(builder, TN_OP_EITHER, 0, 0);
    tn_builder_emit(builder, TN_OP_GREATER, 1, 0);
    tn_builder_emit(builder, TN_OP_BOTH, 0, 0);
    tn_builder_emit(builder, TN_OP_WITHIN, 2, 4);
    tn_builder_emit(builder, TN_OP_NEITHER, 0, 0);
    tn_builder_emit(builder, TN_OP_BOTH, 0, 0);
    tn_builder_emit(builder, TN_OP_REMAINDER, 3, 1);
    tn_builder_emit(builder, TN_OP_EITHER, 0, 0);
    return sample_function(builder, "", TN_FUNCTION_CONDITION, begin, 2);
}

/* neighbour(tray(4'), tray(4')) taken whole, and then one instruction of every other kind. */
static inline void sample_rule(tn_builder *builder, uint32_t narrow, uint32_t condition)
{
    uint32_t begin = tn_builder_offset(builder);
    sample_map(builder, "neighbour(tray(4'), tray(4'))");
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_NONEMPTY, 0, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_CHAIN, 0, 0);
    uint32_t whole = sample_function(builder, "pair", TN_FUNCTION_WHOLE, begin, 2);
    begin = tn_builder_offset(builder);
    sample_map(builder, "pair");
    tn_builder_emit(builder, TN_OP_CALL, whole, 0);
    tn_builder_emit(builder, TN_OP_SOMEWHERE, 0, 0);
    uint32_t holds = sample_function(builder, "pair", TN_FUNCTION_HOLDS, begin, 1);
    begin = tn_builder_offset(builder);
    sample_map(builder, "library");
    tn_builder_emit(builder, TN_OP_MIRROR, whole, 0);
    tn_builder_emit(builder, TN_OP_QUANTITY, condition, 0);
    tn_builder_emit(builder, TN_OP_CALL, whole, 0);
    tn_builder_emit(builder, TN_OP_SUM, 0, condition);
    tn_builder_emit(builder, TN_OP_AND, 0, 0);
    tn_builder_emit(builder, TN_OP_OCCURRENCES, condition, 0);
    tn_builder_emit(builder, TN_OP_NOT, 0, 0);
    tn_builder_emit(builder, TN_OP_BEGINNING, 0, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_MANY, 0, 0);
    tn_builder_emit(builder, TN_OP_REPEATED, 2, 3);
    tn_builder_emit(builder, TN_OP_OPTIONAL, 0, 0);
    tn_builder_emit(builder, TN_OP_END, 0, 0);
    tn_builder_emit(builder, TN_OP_CALL, holds, 0);
    tn_builder_emit(builder, TN_OP_DISTANCE, 0, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_NEAR, 0, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_FAR, 0, 0);
    tn_builder_emit(builder, TN_OP_MIRRORED, 0, 0);
    tn_builder_emit(builder, TN_OP_WHERE, 0, 0);
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_OR, 0, 0);
    tn_builder_emit(builder, TN_OP_ONCE, 0, 0);
    uint32_t all = sample_function(builder, "everything", TN_FUNCTION_HOLDS, begin, 3);
    begin = tn_builder_offset(builder);
    sample_map(builder, "pair");
    tn_builder_emit(builder, TN_OP_TRAY, narrow, 0);
    tn_builder_emit(builder, TN_OP_NONEMPTY, 0, 0);
    tn_builder_emit(builder, TN_OP_AGAIN, all + 1, 0);
    tn_builder_emit(builder, TN_OP_OPTIONAL, 0, 0);
    tn_builder_emit(builder, TN_OP_CHAIN, 0, 0);
    sample_function(builder, "row", TN_FUNCTION_CIRCLE, begin, 2);
    begin = tn_builder_offset(builder);
    sample_map(builder, "library");
    tn_builder_emit(builder, TN_OP_IMAGE, 0, 0);
    sample_function(builder, "toys", TN_FUNCTION_HOLDS, begin, 1);
    tn_builder_add_RULE(builder, &(tn_rule_record){.name = tn_builder_string(builder, "pair"),
                                                   .doc = tn_builder_string(builder, "two 4' trays"),
                                                   .whole = whole,
                                                   .holds = holds,
                                                   .begin = sample_begin("rule"),
                                                   .end = sample_begin("library")});
    tn_builder_add_LIBRARY(builder, &(tn_library_record){.name = tn_builder_string(builder, "toys"),
                                                         .trays_min = 1,
                                                         .trays_max = 6,
                                                         .clause_count = 2,
                                                         .begin = sample_begin("library"),
                                                         .end = (uint32_t)strlen(SAMPLE_SOURCE)});
    tn_builder_add_CLAUSE(
        builder,
        &(tn_clause_record){.name = tn_builder_string(builder, "pair"), .kind = TN_CLAUSE_PRUNE, .holds = holds});
    tn_builder_add_CLAUSE(
        builder,
        &(tn_clause_record){.name = tn_builder_string(builder, "require@5"), .kind = TN_CLAUSE_REQUIRE, .holds = all});
}

/* A builder that holds the sample, not finished: a test may change it first. NULL where out of memory. */
static inline tn_builder *sample_builder(void)
{
    tn_builder *builder = tn_builder_new();
    if (!builder)
        return NULL;
    tn_builder_add_SOURCE(builder, &(tn_source_record){.path = tn_builder_string(builder, "toy.plan"),
                                                       .text = tn_builder_string(builder, SAMPLE_SOURCE)});
    tn_builder_add_PRODUCER(
        builder, &(tn_producer_record){.version = tn_builder_string(builder, "tartan 0.0.0"), .sources_hash = 77});
    sample_schema(builder);
    sample_spec(builder, 0xBE);                   /* forbidden: 8' with an empty body */
    uint32_t narrow = sample_spec(builder, 0xFD); /* 4' */
    uint32_t condition = sample_condition(builder);
    sample_rule(builder, narrow, condition);
    return builder;
}

#endif
