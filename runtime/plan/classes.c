#include "runtime/plan/classes.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/numbering.h"
#include "runtime/vm/code.h"

typedef struct tn_class_finder {
    const tn_schema *schema;
    tn_classes *classes;
    uint8_t *seen_function; /* [FUNCTION records] */
    uint8_t *seen_spec;     /* [SPEC records] */
    uint8_t *seen_field;    /* [FIELD records] */
    tn_key pending;         /* functions to read */
} tn_class_finder;

/* Splits every class by what `value` says of its trays. */
static bool split(tn_classes *classes, uint32_t operand,
                  uint64_t (*value)(const tn_schema *schema, uint32_t operand, tn_tray tray))
{
    tn_numbering values = {0}, pairs = {0};
    bool ok = true;
    for (tn_tray t = 0; ok && t < classes->schema->tray_count; t++) {
        uint32_t number = tn_number(&values, value(classes->schema, operand, t));
        uint32_t pair =
            number == UINT32_MAX ? UINT32_MAX : tn_number(&pairs, (uint64_t)classes->of_tray[t] << 32 | number);
        ok = pair != UINT32_MAX;
        classes->of_tray[t] = pair;
    }
    classes->count = pairs.count;
    tn_numbering_clear(&values);
    tn_numbering_clear(&pairs);
    return ok;
}

static uint64_t meets(const tn_schema *schema, uint32_t spec, tn_tray tray)
{
    return tn_spec_meets(schema, spec, tray);
}

static uint64_t length_of(const tn_schema *schema, uint32_t field, tn_tray tray)
{
    return (uint64_t)tn_tray_value_record(schema, tray, field)->length;
}

static bool visit(tn_class_finder *finder, const tn_instruction *instruction)
{
    uint32_t first = (uint32_t)instruction->first;
    switch (instruction->opcode) {
    case TN_OP_CALL:
    case TN_OP_MIRROR:
        if (finder->seen_function[first])
            return true;
        finder->seen_function[first] = 1;
        return tn_key_push(&finder->pending, first);
    case TN_OP_TRAY:
        if (finder->seen_spec[first])
            return true;
        finder->seen_spec[first] = 1;
        return split(finder->classes, first, meets);
    case TN_OP_SUM: {
        uint32_t field = first - finder->schema->record->field_first;
        if (finder->seen_field[field])
            return true;
        finder->seen_field[field] = 1;
        return split(finder->classes, field, length_of);
    }
    default:
        return true;
    }
}

static bool find(tn_class_finder *finder)
{
    const tn_module *module = finder->schema->module;
    while (finder->pending.size > 0) {
        uint32_t function = finder->pending.data[--finder->pending.size];
        const tn_function_record *record = &module->FUNCTION_records[function];
        for (uint32_t offset = record->code_begin; offset < record->code_end;) {
            tn_instruction instruction = tn_code_read(module->code, offset);
            if (!visit(finder, &instruction))
                return false;
            offset += instruction.length;
        }
    }
    return true;
}

static bool finish(tn_classes *classes)
{
    classes->representative = calloc((size_t)classes->count + 1, sizeof *classes->representative);
    classes->size = calloc((size_t)classes->count + 1, sizeof *classes->size);
    if (!classes->representative || !classes->size)
        return false;
    for (tn_tray t = classes->schema->tray_count; t-- > 0;) {
        classes->representative[classes->of_tray[t]] = t;
        classes->size[classes->of_tray[t]]++;
    }
    return true;
}

tn_status tn_classes_new(const tn_schema *schema, const uint32_t *functions, size_t count, tn_classes **out,
                         tn_error *error)
{
    const tn_module *module = schema->module;
    tn_classes *classes = calloc(1, sizeof *classes);
    if (!classes)
        return tn_fail_memory(error);
    classes->schema = schema;
    classes->count = schema->tray_count > 0;
    classes->of_tray = calloc((size_t)schema->tray_count + 1, sizeof *classes->of_tray);
    tn_class_finder finder = {.schema = schema, .classes = classes};
    finder.seen_function = calloc(module->FUNCTION_count + 1, 1);
    finder.seen_spec = calloc(module->SPEC_count + 1, 1);
    finder.seen_field = calloc(module->FIELD_count + 1, 1);
    bool ok = classes->of_tray && finder.seen_function && finder.seen_spec && finder.seen_field;
    for (size_t i = 0; ok && i < count; i++) {
        if (finder.seen_function[functions[i]])
            continue;
        finder.seen_function[functions[i]] = 1;
        ok = tn_key_push(&finder.pending, functions[i]);
    }
    ok = ok && find(&finder) && finish(classes);
    free(finder.seen_function);
    free(finder.seen_spec);
    free(finder.seen_field);
    free(finder.pending.data);
    if (!ok) {
        tn_classes_free(classes);
        return tn_fail_memory(error);
    }
    *out = classes;
    return TN_OK;
}

void tn_classes_free(tn_classes *classes)
{
    if (!classes)
        return;
    free(classes->of_tray);
    free(classes->representative);
    free(classes->size);
    free(classes);
}
