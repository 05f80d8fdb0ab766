/* Schemas, fields, values, specifiers. */
#include "compiler/plan/emit/emit.h"

#include <string.h>

static tn_string text(tn_emit *emit, const char *string)
{
    return tn_builder_string(emit->builder, string);
}

static const char *said_by(const tn_checked_field *field)
{
    return tn_field_is_said(field->ast) ? field->ast->said_by->text : NULL;
}

static void emit_field(tn_emit *emit, const tn_checked_field *field)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_VALUE);
    for (uint32_t v = 0; v < field->value_count; v++) {
        const tn_checked_value *value = &field->values[v];
        tn_builder_add_VALUE(emit->builder, &(tn_value_record){
                                                .name = text(emit, value->name),
                                                .spelling = text(emit, value->spelling),
                                                .measure = text(emit, value->measure),
                                                .doc = text(emit, value->doc),
                                                .role = value->role,
                                                .length = value->length,
                                                .number = text(emit, field->measured ? value->number : NULL),
                                            });
    }
    tn_builder_add_FIELD(emit->builder, &(tn_field_record){
                                            .name = text(emit, field->name),
                                            .doc = text(emit, field->doc),
                                            .kind = field->kind,
                                            .role = field->role,
                                            .value_first = first,
                                            .value_count = field->value_count,
                                            .said_by = text(emit, said_by(field)),
                                        });
}

static uint32_t add_spec(tn_emit *emit, const tn_checked_spec *spec, tn_span span)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_MASK);
    for (uint32_t w = 0; w < spec->schema->words; w++)
        tn_builder_add_MASK(emit->builder, &(tn_mask_record){(int64_t)spec->mask[w]});
    return tn_builder_add_SPEC(emit->builder,
                               &(tn_spec_record){spec->schema->index, first, span.file, span.begin, span.end});
}

uint32_t tn_emit_spec(tn_emit *emit, tn_checked_spec *spec)
{
    if (spec->index == TN_NONE)
        spec->index = add_spec(emit, spec, spec->span);
    return spec->index;
}

/* The forbidding specifiers are a run of records: equal ones are repeated. */
static uint32_t emit_forbids(tn_emit *emit, tn_checked_schema *schema)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_SPEC);
    for (uint32_t i = 0; i < schema->forbid_count; i++) {
        uint32_t index = add_spec(emit, schema->forbids[i], schema->forbid_places[i]);
        if (schema->forbids[i]->index == TN_NONE)
            schema->forbids[i]->index = index;
    }
    return first;
}

/* Of a schema of a library: how many plans trays stand for. Returns the first of the records. */
static uint32_t emit_tray_plans(tn_emit *emit, tn_checked_schema *schema, uint32_t *count)
{
    const tn_census *census = tn_schema_census(schema);
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TRAY_PLANS);
    tn_checked_spec spec = {.schema = schema, .mask = TN_NEW_ARRAY(emit->arena, uint64_t, schema->words)};
    *count = census && spec.mask ? (uint32_t)census->count : 0;
    for (uint32_t i = 0; i < *count; i++) {
        tn_schema_row_mask(schema, i, spec.mask);
        uint32_t index = add_spec(emit, &spec, schema->ast->top.node.span);
        tn_builder_add_TRAY_PLANS(emit->builder, &(tn_tray_plans_record){index, text(emit, census->rows[i].plans)});
    }
    return first;
}

static uint32_t library_of(const tn_emit *emit, const tn_checked_schema *schema)
{
    const tn_checked_schema *of = tn_schema_of_library(schema);
    for (size_t i = 0; of && i < emit->checked->library_count; i++)
        if (strcmp(emit->checked->libraries[i]->name, of->ast->of->text) == 0)
            return emit->checked->libraries[i]->index;
    return TN_NO_RECORD;
}

void tn_emit_said(tn_emit *emit)
{
    for (size_t i = 0; i < emit->checked->schema_count; i++) {
        const tn_checked_schema *schema = emit->checked->schemas[i], *of = tn_schema_of_library(schema);
        for (uint32_t f = 0; of && f < of->field_count; f++) {
            tn_checked_sum *sum = of->fields[f].said;
            if (!sum)
                continue;
            uint32_t index = tn_emit_sum(emit, sum, of->fields[f].name);
            tn_builder_add_SAID(emit->builder, &(tn_said_record){
                                                   .field = schema->field_first + f,
                                                   .sum = index,
                                                   .over = sum->over ? sum->over->index : TN_NO_RECORD,
                                               });
        }
    }
}

void tn_emit_schemas(tn_emit *emit)
{
    for (size_t i = 0; i < emit->checked->schema_count; i++) {
        tn_checked_schema *schema = emit->checked->schemas[i];
        tn_span span = schema->ast->top.node.span;
        schema->field_first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_FIELD);
        for (uint32_t f = 0; f < schema->field_count; f++)
            emit_field(emit, &schema->fields[f]);
        uint32_t forbid_first = emit_forbids(emit, schema), plans_count;
        uint32_t plans_first = emit_tray_plans(emit, schema, &plans_count);
        tn_builder_add_SCHEMA(emit->builder, &(tn_schema_record){
                                                 .name = text(emit, schema->name),
                                                 .doc = text(emit, schema->doc),
                                                 .field_first = schema->field_first,
                                                 .field_count = schema->field_count,
                                                 .forbid_first = forbid_first,
                                                 .forbid_count = schema->forbid_count,
                                                 .file = span.file,
                                                 .begin = span.begin,
                                                 .end = span.end,
                                                 .from = schema->base ? schema->base->index : TN_NO_RECORD,
                                                 .of = library_of(emit, schema),
                                                 .tray_plans_first = plans_first,
                                                 .tray_plans_count = plans_count,
                                             });
    }
}
