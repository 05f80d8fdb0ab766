/* Sorts trays into classes that no rule tells apart. */
#include "runtime/plan/schema/classes.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"
#include "runtime/plan/schema/sum.h"

typedef struct tn_class_finder {
    const tn_schema *schema;
    tn_classes *classes;
    uint8_t *seen_function; /* [FUNCTION records] */
    uint8_t *seen_spec;     /* [SPEC records] */
    uint8_t *seen_field;    /* [FIELD records] */
    uint8_t *seen_sum;      /* [SUM records] */
    tn_key pending;         /* functions to read */
    uint64_t looked;        /* trays compared so far */
} tn_class_finder;

#define NO_CLASS UINT32_MAX

enum { SEEN_LENGTHS = 1, SEEN_VALUES = 2 }; /* of a field */

/* Splits every class in two by whether its trays meet a specifier. */
static bool split_by_spec(tn_class_finder *finder, uint32_t spec)
{
    tn_classes *classes = finder->classes;
    const tn_schema *schema = finder->schema;
    uint32_t *made = malloc(((size_t)classes->count * 2 + 1) * sizeof *made); /* [class][meets]: the new class */
    if (!made)
        return false;
    memset(made, 0xff, (size_t)classes->count * 2 * sizeof *made);
    classes->count = 0;
    for (tn_tray t = 0; t < schema->tray_count; t++) {
        uint32_t *to = &made[2 * (size_t)classes->of_tray[t] + tn_spec_meets(schema, spec, t)];
        if (*to == NO_CLASS)
            *to = classes->count++;
        classes->of_tray[t] = *to;
    }
    free(made);
    return true;
}

/* Splits every class by the lengths that its trays have in a field (index within the schema). */
static bool split_by_length(tn_class_finder *finder, uint32_t field)
{
    tn_classes *classes = finder->classes;
    const tn_schema *schema = finder->schema;
    tn_numbering pairs = {0};
    bool ok = true;
    for (tn_tray t = 0; ok && t < schema->tray_count; t++) {
        int64_t length = tn_tray_value_record(schema, t, field)->length;
        uint32_t value = 0; /* the first of the field's values that is as long */
        while (schema->values[schema->value_start[field] + value].length != length)
            value++;
        uint32_t pair = tn_number(&pairs, (uint64_t)classes->of_tray[t] << 32 | value);
        ok = pair != UINT32_MAX;
        classes->of_tray[t] = pair;
    }
    classes->count = pairs.count;
    tn_numbering_clear(&pairs);
    return ok;
}

/* Splits every class by the values that its trays have in a field (index within the schema). */
static bool split_by_value(tn_class_finder *finder, uint32_t field)
{
    tn_classes *classes = finder->classes;
    const tn_schema *schema = finder->schema;
    tn_numbering pairs = {0};
    bool ok = true;
    for (tn_tray t = 0; ok && t < schema->tray_count; t++) {
        uint32_t pair = tn_number(&pairs, (uint64_t)classes->of_tray[t] << 32 | tn_tray_value(schema, t, field));
        ok = pair != UINT32_MAX;
        classes->of_tray[t] = pair;
    }
    if (schema->tray_count > 0)
        classes->count = pairs.count;
    tn_numbering_clear(&pairs);
    return ok;
}

/* Counts the trays looked at, or the words of the diagram that is split, against a bound. */
static tn_status look_at_trays(tn_class_finder *finder, tn_error *error)
{
    finder->looked +=
        finder->schema->legal ? tn_kinds_of(&finder->classes->kinds)->nodes.words_used : finder->schema->tray_count;
    if (finder->looked <= TN_CLASS_LOOKS_MAX)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS,
            "telling %u trays apart by so many specifiers takes more than %llu comparisons", finder->schema->tray_count,
            (unsigned long long)TN_CLASS_LOOKS_MAX);
    tn_error_help(error, "give the schema fewer values, or split the rules over several files");
    return TN_LIMIT;
}

/* Splits every class by what its trays count in a term. */
static bool split_by_weight(tn_class_finder *finder, const int64_t *weight)
{
    tn_classes *classes = finder->classes;
    tn_numbering values = {0}, pairs = {0};
    bool ok = true;
    for (tn_tray t = 0; ok && t < finder->schema->tray_count; t++) {
        uint32_t value = tn_number(&values, (uint64_t)weight[t]);
        uint32_t pair = value == UINT32_MAX ? value : tn_number(&pairs, (uint64_t)classes->of_tray[t] << 32 | value);
        ok = pair != UINT32_MAX;
        classes->of_tray[t] = pair;
    }
    if (finder->schema->tray_count > 0)
        classes->count = pairs.count;
    tn_numbering_clear(&values);
    tn_numbering_clear(&pairs);
    return ok;
}

/* The same of kinds: those that count the same stay together. */
static tn_status split_by_steps(tn_class_finder *finder, const tn_sum_term *term, tn_error *error)
{
    const tn_labelling *kinds = tn_kinds_of(&term->kinds);
    uint32_t *numbers = malloc((kinds->labels + 1u) * sizeof *numbers);
    tn_numbering values = {0};
    bool ok = numbers != NULL;
    for (uint32_t k = 0; ok && k < kinds->labels; k++) {
        numbers[k] = tn_number(&values, (uint64_t)term->weight[k]);
        ok = numbers[k] != UINT32_MAX;
    }
    tn_status status = ok ? tn_kinds_by_kinds(&finder->classes->kinds, kinds, numbers, error) : tn_fail_memory(error);
    tn_numbering_clear(&values);
    free(numbers);
    return status;
}

static tn_status visit_weight(tn_class_finder *finder, const tn_sum_term *term, tn_error *error)
{
    tn_status status = look_at_trays(finder, error);
    if (status == TN_OK && finder->schema->legal)
        return split_by_steps(finder, term, error);
    return status != TN_OK || split_by_weight(finder, term->weight) ? status : tn_fail_memory(error);
}

static tn_status push_function(tn_class_finder *finder, uint32_t function, tn_error *error)
{
    if (finder->seen_function[function])
        return TN_OK;
    finder->seen_function[function] = 1;
    return tn_key_push(&finder->pending, function) ? TN_OK : tn_fail_memory(error);
}

/* A sum's trays differ by what they count, and by its parts. */
static tn_status visit_sum(tn_class_finder *finder, uint32_t index, tn_error *error)
{
    if (finder->seen_sum[index])
        return TN_OK;
    finder->seen_sum[index] = 1;
    tn_sum *sum = NULL;
    tn_status status = tn_sum_new(finder->schema, index, &sum, error);
    for (uint32_t i = 0; status == TN_OK && i < sum->count; i++) {
        status = push_function(finder, sum->terms[i].part, error);
        if (status == TN_OK && sum->terms[i].other != TN_NO_RECORD)
            status = push_function(finder, sum->terms[i].other, error);
        if (status == TN_OK && sum->terms[i].weight)
            status = visit_weight(finder, &sum->terms[i], error);
    }
    tn_sum_free(sum);
    return status;
}

/* A field of which each length, or each value, counts. */
static tn_status visit_field(tn_class_finder *finder, const tn_instruction *instruction, tn_error *error)
{
    uint32_t first = (uint32_t)instruction->first, field = first - finder->schema->record->field_first;
    bool values = instruction->opcode == TN_OP_MIRRORED;
    uint8_t seen = values ? SEEN_VALUES : SEEN_LENGTHS;
    if (finder->seen_field[first] & seen)
        return TN_OK;
    finder->seen_field[first] |= seen;
    tn_status status = look_at_trays(finder, error);
    if (status != TN_OK)
        return status;
    if (finder->schema->legal)
        return (values ? tn_kinds_by_values : tn_kinds_by_lengths)(&finder->classes->kinds, field, error);
    return (values ? split_by_value : split_by_length)(finder, field) ? TN_OK : tn_fail_memory(error);
}

/* Splits every class by which classes of newer trays lie above its trays. */
static tn_status split_by_above(tn_class_finder *finder, const tn_projection *projection, const tn_classes *newer,
                                tn_error *error)
{
    tn_classes *classes = finder->classes;
    uint32_t *seen = calloc((size_t)newer->count + 1, sizeof *seen);
    tn_interner sets = {0};
    tn_numbering pairs = {0};
    tn_key set = {0};
    bool ok = seen != NULL;
    for (tn_tray t = 0; ok && t < finder->schema->tray_count; t++) {
        set.size = 0;
        ok = tn_projection_list(projection, newer->of_tray, t, seen, t + 1, &set);
        for (size_t i = 0; i < set.size; i++)
            set.data[i] = newer->of_tray[set.data[i]];
        if (set.size > 1)
            qsort(set.data, set.size, sizeof *set.data, tn_words_compare);
        uint32_t number = ok ? tn_intern(&sets, set.data, set.size) : UINT32_MAX;
        uint32_t pair = number == UINT32_MAX ? number : tn_number(&pairs, (uint64_t)classes->of_tray[t] << 32 | number);
        ok = pair != UINT32_MAX;
        classes->of_tray[t] = pair;
    }
    if (finder->schema->tray_count > 0)
        classes->count = pairs.count;
    tn_interner_clear(&sets);
    tn_numbering_clear(&pairs);
    free(set.data);
    free(seen);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* Plans of a library lie above, or do not: trays differ by those above them. */
static tn_status visit_image(tn_class_finder *finder, const tn_instruction *instruction, tn_error *error)
{
    tn_projection *projection = NULL;
    tn_classes *newer = NULL;
    tn_status status = look_at_trays(finder, error);
    if (status == TN_OK)
        status = tn_projection_new(finder->schema, instruction, &projection, error);
    if (status == TN_OK)
        status = tn_classes_above(projection, &newer, error);
    if (status == TN_OK)
        status = split_by_above(finder, projection, newer, error);
    tn_classes_free(newer);
    tn_projection_free(projection);
    return status;
}

static tn_status visit(tn_class_finder *finder, const tn_instruction *instruction, tn_error *error)
{
    uint32_t first = (uint32_t)instruction->first;
    if (tn_code_compares(instruction->opcode))
        return visit_sum(finder, first, error);
    switch (instruction->opcode) {
    case TN_OP_CALL:
    case TN_OP_MIRROR:
    case TN_OP_AGAIN:
        return push_function(finder, first, error);
    case TN_OP_SUM:
    case TN_OP_MIRRORED:
        return visit_field(finder, instruction, error);
    case TN_OP_IMAGE:
        return visit_image(finder, instruction, error);
    case TN_OP_TRAY: {
        if (finder->seen_spec[first])
            return TN_OK;
        finder->seen_spec[first] = 1;
        tn_status status = look_at_trays(finder, error);
        if (status == TN_OK && finder->schema->legal)
            return tn_kinds_by_spec(&finder->classes->kinds, first, error);
        return status != TN_OK || split_by_spec(finder, first) ? status : tn_fail_memory(error);
    }
    default:
        return TN_OK;
    }
}

static tn_status find(tn_class_finder *finder, tn_error *error)
{
    const tn_module *module = finder->schema->module;
    while (finder->pending.size > 0) {
        uint32_t function = finder->pending.data[--finder->pending.size];
        const tn_function_record *record = &module->FUNCTION_records[function];
        for (uint32_t offset = record->code_begin; offset < record->code_end;) {
            tn_instruction instruction = tn_code_read(module->code, offset);
            tn_status status = visit(finder, &instruction, error);
            if (status != TN_OK)
                return status;
            offset += instruction.length;
        }
    }
    return TN_OK;
}

static bool finish(tn_classes *classes)
{
    if (!classes->of_tray)
        classes->count = tn_kinds_of(&classes->kinds)->labels;
    classes->representative = calloc((size_t)classes->count + 1, sizeof *classes->representative);
    classes->size = calloc((size_t)classes->count + 1, sizeof *classes->size);
    if (!classes->representative || !classes->size)
        return false;
    if (!classes->of_tray) {
        const tn_labelling *kinds = tn_kinds_of(&classes->kinds);
        memcpy(classes->representative, kinds->first, kinds->labels * sizeof *kinds->first);
        for (uint32_t c = 0; c < kinds->labels; c++)
            classes->size[c] = tn_labelling_size(kinds, c);
        return true;
    }
    for (tn_tray t = classes->schema->tray_count; t-- > 0;) {
        classes->representative[classes->of_tray[t]] = t;
        classes->size[classes->of_tray[t]]++;
    }
    return true;
}

tn_status tn_classes_new(const tn_schema *schema, const uint32_t *functions, size_t count, tn_classes **out,
                         tn_error *error)
{
    return tn_classes_with_sums(schema, functions, count, NULL, 0, out, error);
}

tn_status tn_classes_above(const tn_projection *projection, tn_classes **out, tn_error *error)
{
    uint32_t count = projection->library->clause_count;
    uint32_t *functions = calloc((size_t)count + 1, sizeof *functions);
    if (!functions)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        functions[i] = tn_projection_clause(projection, i)->holds;
    tn_status status = tn_classes_new(projection->newer, functions, count, out, error);
    free(functions);
    return status;
}

tn_status tn_classes_with_sums(const tn_schema *schema, const uint32_t *functions, size_t count, const uint32_t *sums,
                               size_t sum_count, tn_classes **out, tn_error *error)
{
    const tn_module *module = schema->module;
    tn_classes *classes = calloc(1, sizeof *classes);
    if (!classes)
        return tn_fail_memory(error);
    classes->schema = schema;
    classes->kinds.schema = schema;
    classes->count = schema->tray_count > 0;
    if (!schema->legal)
        classes->of_tray = calloc((size_t)schema->tray_count + 1, sizeof *classes->of_tray);
    tn_class_finder finder = {.schema = schema, .classes = classes};
    finder.seen_function = calloc(module->FUNCTION_count + 1, 1);
    finder.seen_spec = calloc(module->SPEC_count + 1, 1);
    finder.seen_field = calloc(module->FIELD_count + 1, 1);
    finder.seen_sum = calloc(module->SUM_count + 1, 1);
    bool ok = (classes->of_tray || schema->legal) && finder.seen_function && finder.seen_spec && finder.seen_field &&
              finder.seen_sum;
    tn_status status = ok ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = push_function(&finder, functions[i], error);
    for (size_t i = 0; status == TN_OK && i < sum_count; i++)
        status = visit_sum(&finder, sums[i], error);
    if (status == TN_OK)
        status = find(&finder, error);
    if (status == TN_OK && !finish(classes))
        status = tn_fail_memory(error);
    free(finder.seen_function);
    free(finder.seen_spec);
    free(finder.seen_field);
    free(finder.seen_sum);
    free(finder.pending.data);
    if (status != TN_OK) {
        tn_classes_free(classes);
        return status;
    }
    *out = classes;
    return TN_OK;
}

tn_status tn_classes_refine(tn_classes *classes, const tn_classes *other, tn_error *error)
{
    tn_numbering pairs = {0};
    bool ok = true;
    if (!classes->of_tray) {
        tn_status status = tn_kinds_by_kinds(&classes->kinds, tn_kinds_of(&other->kinds), NULL, error);
        if (status != TN_OK)
            return status;
    }
    for (tn_tray t = 0; ok && classes->of_tray && t < classes->schema->tray_count; t++) {
        uint32_t pair = tn_number(&pairs, (uint64_t)classes->of_tray[t] << 32 | other->of_tray[t]);
        ok = pair != UINT32_MAX;
        classes->of_tray[t] = pair;
    }
    classes->count = pairs.count;
    tn_numbering_clear(&pairs);
    free(classes->representative);
    free(classes->size);
    classes->representative = classes->size = NULL;
    return ok && finish(classes) ? TN_OK : tn_fail_memory(error);
}

void tn_classes_free(tn_classes *classes)
{
    if (!classes)
        return;
    free(classes->of_tray);
    tn_labelling_free(classes->kinds.made);
    free(classes->representative);
    free(classes->size);
    free(classes);
}
