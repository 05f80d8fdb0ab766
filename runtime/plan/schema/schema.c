/* Makes a schema ready: its legal trays and their numbers. */
#include "runtime/plan/schema/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/length.h"
#include "runtime/choices/choices.h"

/* A number that goes through all combinations of values in order: the last field turns fastest. */
static bool odometer_step(const tn_schema *schema, uint8_t *values)
{
    for (uint32_t field = schema->field_count; field-- > 0;) {
        if (++values[field] < schema->fields[field].value_count)
            return true;
        values[field] = 0;
    }
    return false;
}

static void mask_of_values(const tn_schema *schema, const uint8_t *values, uint64_t *mask)
{
    memset(mask, 0, schema->mask_words * sizeof *mask);
    for (uint32_t field = 0; field < schema->field_count; field++) {
        uint32_t bit = schema->value_start[field] + values[field];
        mask[bit / 64] |= UINT64_C(1) << (bit % 64);
    }
}

/* A tray meets a specifier if the bit of each of its values is set there. */
static bool mask_within(const tn_schema *schema, const uint64_t *mask, uint32_t spec)
{
    for (uint32_t word = 0; word < schema->mask_words; word++) {
        if (mask[word] & ~tn_spec_word(schema->module, spec, word))
            return false;
    }
    return true;
}

static uint32_t forbidding_spec(const tn_schema *schema, const uint64_t *mask)
{
    for (uint32_t i = 0; i < schema->record->forbid_count; i++) {
        if (mask_within(schema, mask, schema->record->forbid_first + i))
            return schema->record->forbid_first + i;
    }
    return UINT32_MAX;
}

static tn_status too_many(const tn_schema *schema, uint64_t trays, tn_error *error)
{
    const char *name = tn_text(schema->module, schema->record->name);
    if (trays < UINT64_MAX)
        tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS, "schema %s has %llu legal trays, more than the limit of %u", name,
                (unsigned long long)trays, TN_SCHEMA_TRAYS_MAX);
    else
        tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS, "schema %s has more legal trays than the limit of %u", name,
                TN_SCHEMA_TRAYS_MAX);
    tn_error_help(error,
                  "name fewer values, or fewer fields, or say by `only` or `forbid` which trays there are: every "
                  "legal tray has a number");
    return TN_LIMIT;
}

tn_status tn_schema_listed(const tn_schema *schema, const char *what, tn_error *error)
{
    if (!schema->legal)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS, "%s through the trays one by one, and schema %s has %u legal trays",
            what, tn_text(schema->module, schema->record->name), schema->tray_count);
    tn_error_help(error,
                  "trays are listed up to %u: name fewer values, or fewer fields, or say by `only` or `forbid` "
                  "which trays there are",
                  TN_SCHEMA_TRAYS_DEFAULT);
    return TN_LIMIT;
}

/* What the tables below rely on: fields with 1 to 256 values each, one field's after another's, of lengths in range. */
static tn_status check_fields(const tn_schema *schema, tn_error *error)
{
    uint32_t next = schema->field_count > 0 ? schema->fields[0].value_first : 0;
    for (uint32_t i = 0; i < schema->field_count; i++) {
        const tn_field_record *field = &schema->fields[i];
        const char *name = tn_text(schema->module, field->name);
        if (field->value_first != next || field->value_count == 0)
            return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "the values of field %s are not where they belong",
                           name);
        if (field->value_count > TN_FIELD_VALUES_MAX)
            return tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS, "field %s has %u values, more than the limit of %u", name,
                           (unsigned)field->value_count, TN_FIELD_VALUES_MAX);
        for (uint32_t v = 0; v < field->value_count; v++) {
            int64_t length = schema->module->VALUE_records[next + v].length;
            if (length < 0 || length > TN_LENGTH_MAX)
                return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "field %s has a length that is out of range", name);
        }
        next += field->value_count;
    }
    return TN_OK;
}

/* Sets value_start, value_count, mask_words, code_count. */
static void count_codes(tn_schema *schema)
{
    uint64_t codes = 1;
    uint32_t start = 0;
    for (uint32_t i = 0; i < schema->field_count; i++) {
        schema->value_start[i] = start;
        start += schema->fields[i].value_count;
        codes = codes > UINT64_MAX / TN_FIELD_VALUES_MAX ? UINT64_MAX : codes * schema->fields[i].value_count;
    }
    schema->value_start[schema->field_count] = start;
    schema->value_count = start;
    schema->mask_words = (start + 63) / 64;
    schema->code_count = codes;
}

static uint64_t bytes_of_tray(const tn_schema *schema)
{
    return schema->field_count + sizeof(uint64_t) * (uint64_t)schema->mask_words;
}

/* Can all combinations be gone through one by one, and have a place in a table? */
static bool is_small(const tn_schema *schema, uint64_t max_listed)
{
    uint64_t codes = schema->code_count;
    return codes <= max_listed && bytes_of_tray(schema) * codes <= TN_SCHEMA_BYTES_MAX &&
           codes * ((uint64_t)schema->record->forbid_count * schema->mask_words) <= TN_SCHEMA_CHECKS_MAX;
}

/* Numbers the legal combinations and fills the tables. `values` and `mask` are room for one tray. */
static void number_trays(tn_schema *schema, uint8_t *values, uint64_t *mask)
{
    memset(values, 0, schema->field_count);
    uint64_t code = 0;
    do {
        mask_of_values(schema, values, mask);
        schema->tray_of_code[code] = TN_NO_TRAY;
        if (forbidding_spec(schema, mask) == UINT32_MAX) {
            uint32_t tray = schema->tray_count++;
            schema->tray_of_code[code] = tray;
            memcpy(schema->tray_values + (size_t)tray * schema->field_count, values, schema->field_count);
            memcpy(schema->tray_masks + (size_t)tray * schema->mask_words, mask, schema->mask_words * sizeof *mask);
        }
        code++;
    } while (odometer_step(schema, values));
}

/* Plans are made of trays: without one, nothing about a schema has an answer. */
static tn_status forbids_all(const tn_schema *schema, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_NOTHING_LEGAL, "schema %s forbids every tray",
            tn_text(schema->module, schema->record->name));
    tn_error_help(error, "leave one `forbid` out, or narrow it with more items");
    return TN_INVALID;
}

static tn_status make_few(tn_schema *schema, tn_error *error)
{
    size_t codes = (size_t)schema->code_count;
    schema->tray_values = malloc(codes * schema->field_count + 1);
    schema->tray_masks = malloc((codes * schema->mask_words + 1) * sizeof *schema->tray_masks);
    schema->tray_of_code = malloc(codes * sizeof *schema->tray_of_code);
    uint8_t *values = malloc(schema->field_count + 1u);
    uint64_t *mask = malloc((schema->mask_words + 1u) * sizeof *mask);
    bool ready = schema->tray_values && schema->tray_masks && schema->tray_of_code && values && mask;
    if (ready)
        number_trays(schema, values, mask);
    free(values);
    free(mask);
    return ready ? TN_OK : tn_fail_memory(error);
}

/* ---- schemas of so many combinations that they are not gone through one by one */

/* The combinations that no `forbid` forbids. */
static tn_choice_set legal_trays(const tn_schema *schema, tn_choice_diagram *choices)
{
    uint32_t count = schema->record->forbid_count;
    tn_choice_set *boxes = malloc((count + 1u) * sizeof *boxes);
    uint64_t *mask = malloc((schema->mask_words + 1u) * sizeof *mask);
    for (uint32_t i = 0; boxes && mask && i < count; i++) {
        for (uint32_t word = 0; word < schema->mask_words; word++)
            mask[word] = tn_spec_word(schema->module, schema->record->forbid_first + i, word);
        boxes[i] = tn_choices_box(choices, mask);
    }
    tn_choice_set legal =
        boxes && mask ? tn_choices_not(choices, tn_choices_any_of(choices, boxes, count)) : TN_CHOICE_LOST;
    free(boxes);
    free(mask);
    return legal;
}

static bool add_tray(void *context, const uint8_t *values)
{
    tn_schema *schema = context;
    uint32_t tray = schema->tray_count++;
    memcpy(schema->tray_values + (size_t)tray * schema->field_count, values, schema->field_count);
    mask_of_values(schema, values, schema->tray_masks + (size_t)tray * schema->mask_words);
    return true;
}

static tn_status takes_too_long(const tn_schema *schema, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS, "which trays of schema %s are legal takes too long to find out",
            tn_text(schema->module, schema->record->name));
    tn_error_help(error, "name fewer values, or fewer fields, or forbid trays by fewer fields at once");
    return TN_LIMIT;
}

static tn_status list_legal(tn_schema *schema, const tn_choice_diagram *choices, tn_choice_set legal, uint64_t trays,
                            tn_error *error)
{
    schema->tray_values = malloc((size_t)trays * schema->field_count + 1);
    schema->tray_masks = malloc(((size_t)trays * schema->mask_words + 1) * sizeof *schema->tray_masks);
    if (!schema->tray_values || !schema->tray_masks)
        return tn_fail_memory(error);
    tn_choices_each(choices, legal, add_tray, schema);
    return TN_OK;
}

static tn_status keep_legal(tn_schema *schema, const tn_choice_diagram *choices, tn_choice_set legal, tn_error *error)
{
    tn_status status = tn_labelling_of_set(choices, legal, &schema->legal);
    if (status != TN_OK)
        return status == TN_MEMORY ? tn_fail_memory(error) : takes_too_long(schema, error);
    schema->tray_count = schema->legal->count;
    return TN_OK;
}

static tn_status number_legal(tn_schema *schema, tn_choice_diagram *choices, uint64_t max_listed, tn_error *error)
{
    tn_choice_set legal = legal_trays(schema, choices);
    if (legal == TN_CHOICE_LOST)
        return tn_choices_full(choices) ? takes_too_long(schema, error) : tn_fail_memory(error);
    uint64_t trays;
    if (!tn_choices_count(choices, legal, &trays))
        return tn_fail_memory(error);
    if (trays > TN_SCHEMA_TRAYS_MAX)
        return too_many(schema, trays, error);
    if (trays <= max_listed && trays <= TN_SCHEMA_BYTES_MAX / bytes_of_tray(schema))
        return list_legal(schema, choices, legal, trays, error);
    return keep_legal(schema, choices, legal, error);
}

static tn_status make_many(tn_schema *schema, uint64_t max_listed, tn_error *error)
{
    uint32_t counts[TN_FIELDS_MAX];
    for (uint32_t i = 0; i < schema->field_count; i++)
        counts[i] = schema->fields[i].value_count;
    tn_choice_diagram *choices = tn_choices_new(counts, schema->field_count, TN_CHOICES_ROOM);
    tn_status status = choices ? number_legal(schema, choices, max_listed, error) : tn_fail_memory(error);
    tn_choices_free(choices);
    return status;
}

/* ---- schemas of libraries */

/* Records and trays are in one order as far as fields allow: the next record is tried first. */
static tn_status find_tray_plans(tn_schema *schema, tn_error *error)
{
    uint32_t first = schema->record->tray_plans_first, count = schema->record->tray_plans_count, at = 0;
    uint64_t looks = 0;
    tn_status status = tn_schema_listed(schema, "a schema of a library goes", error);
    if (status != TN_OK)
        return status;
    schema->tray_plans = malloc(((size_t)schema->tray_count + 1) * sizeof *schema->tray_plans);
    if (!schema->tray_plans)
        return tn_fail_memory(error);
    for (tn_tray tray = 0; tray < schema->tray_count; tray++) {
        uint32_t tried = 0;
        while (tried < count && !tn_spec_meets(schema, schema->module->TRAY_PLANS_records[first + at].spec, tray)) {
            at = (at + 1) % count;
            tried++;
        }
        looks += tried;
        if (looks > TN_SCHEMA_CHECKS_MAX)
            return takes_too_long(schema, error);
        if (tried == count)
            return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "a tray of schema %s stands for no plan",
                           tn_text(schema->module, schema->record->name));
        schema->tray_plans[tray] = first + at;
    }
    return TN_OK;
}

tn_status tn_schema_new(const tn_module *module, uint32_t index, uint64_t max_listed, tn_schema **out, tn_error *error)
{
    *out = NULL;
    if (max_listed == 0)
        max_listed = TN_SCHEMA_TRAYS_DEFAULT;
    if (max_listed > TN_SCHEMA_TRAYS_MAX)
        max_listed = TN_SCHEMA_TRAYS_MAX;
    tn_schema *schema = calloc(1, sizeof *schema);
    if (!schema)
        return tn_fail_memory(error);
    schema->module = module;
    schema->record = &module->SCHEMA_records[index];
    schema->fields = module->FIELD_records + schema->record->field_first;
    schema->field_count = schema->record->field_count;
    schema->value_start = malloc((schema->field_count + 1u) * sizeof *schema->value_start);
    tn_status status = schema->value_start ? check_fields(schema, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        count_codes(schema);
        schema->values = schema->field_count > 0 ? module->VALUE_records + schema->fields[0].value_first : NULL;
        status = is_small(schema, max_listed) ? make_few(schema, error) : make_many(schema, max_listed, error);
    }
    if (status == TN_OK && schema->tray_count == 0)
        status = forbids_all(schema, error);
    if (status == TN_OK && schema->record->tray_plans_count > 0)
        status = find_tray_plans(schema, error);
    if (status != TN_OK) {
        tn_schema_free(schema);
        return status;
    }
    *out = schema;
    return TN_OK;
}

void tn_schema_free(tn_schema *schema)
{
    if (!schema)
        return;
    free(schema->value_start);
    tn_labelling_free(schema->legal);
    free(schema->tray_values);
    free(schema->tray_masks);
    free(schema->tray_of_code);
    free(schema->tray_plans);
    free(schema);
}

uint32_t tn_tray_value_below(const tn_schema *schema, tn_tray tray, uint32_t field)
{
    uint8_t values[TN_FIELDS_MAX];
    tn_labelling_at(schema->legal, tray, values);
    return values[field];
}

/* Trays are in the order of their values. */
static tn_tray look_up(const tn_schema *schema, const uint8_t *values)
{
    tn_tray low = 0, high = schema->tray_count;
    while (low < high) {
        tn_tray middle = low + (high - low) / 2;
        int order = memcmp(schema->tray_values + (size_t)middle * schema->field_count, values, schema->field_count);
        if (order == 0)
            return middle;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return TN_NO_TRAY;
}

tn_tray tn_schema_tray(const tn_schema *schema, const uint8_t *values)
{
    if (schema->legal)
        return tn_labelling_number(schema->legal, values);
    if (!schema->tray_of_code)
        return look_up(schema, values);
    uint64_t code = 0;
    for (uint32_t field = 0; field < schema->field_count; field++)
        code = code * schema->fields[field].value_count + values[field];
    return schema->tray_of_code[code];
}

static bool values_within(const tn_schema *schema, const uint8_t *values, uint32_t spec)
{
    for (uint32_t field = 0; field < schema->field_count; field++) {
        uint32_t bit = schema->value_start[field] + values[field];
        if (!(tn_spec_word(schema->module, spec, bit / 64) >> (bit % 64) & 1))
            return false;
    }
    return true;
}

uint32_t tn_schema_forbidden_by(const tn_schema *schema, const uint8_t *values)
{
    for (uint32_t i = 0; i < schema->record->forbid_count; i++) {
        uint32_t spec = schema->record->forbid_first + i;
        if (values_within(schema, values, spec))
            return spec;
    }
    return UINT32_MAX;
}

bool tn_spec_meets(const tn_schema *schema, uint32_t spec, tn_tray tray)
{
    uint8_t values[TN_FIELDS_MAX];
    if (schema->legal) {
        tn_labelling_at(schema->legal, tray, values);
        return values_within(schema, values, spec);
    }
    return mask_within(schema, tn_tray_mask(schema, tray), spec);
}

uint32_t tn_schema_field(const tn_schema *schema, const char *name)
{
    for (uint32_t field = 0; field < schema->field_count; field++) {
        if (strcmp(tn_text(schema->module, schema->fields[field].name), name) == 0)
            return field;
    }
    return UINT32_MAX;
}

uint32_t tn_schema_length_field(const tn_schema *schema)
{
    for (uint32_t field = 0; field < schema->field_count; field++) {
        if (schema->fields[field].kind == TN_FIELD_LENGTH)
            return field;
    }
    return UINT32_MAX;
}

int64_t tn_schema_length_unit(const tn_schema *schema, uint32_t field)
{
    int64_t unit = 0;
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++) {
        int64_t rest = schema->values[schema->value_start[field] + v].length;
        while (rest != 0) { /* Euclid */
            int64_t next = unit % rest;
            unit = rest;
            rest = next;
        }
    }
    return unit > 0 ? unit : 1;
}
