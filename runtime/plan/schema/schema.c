/* Makes a schema ready: its legal trays and their numbers. */
#include "runtime/plan/schema/schema.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/length.h"

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

static tn_status too_many(const tn_schema *schema, uint64_t limit, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS, "schema %s has more combinations of values than the limit of %llu",
            tn_text(schema->module, schema->record->name), (unsigned long long)limit);
    tn_error_help(error, "name fewer values, or fewer fields: every legal tray has a number and a place in a table");
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
static tn_status count_codes(tn_schema *schema, uint64_t max_codes, tn_error *error)
{
    uint64_t codes = 1;
    uint32_t start = 0;
    for (uint32_t i = 0; i < schema->field_count; i++) {
        schema->value_start[i] = start;
        start += schema->fields[i].value_count;
        codes *= schema->fields[i].value_count; /* cannot overflow: at most max_codes times 256 */
        if (codes > max_codes)
            return too_many(schema, max_codes, error);
    }
    schema->value_start[schema->field_count] = start;
    schema->value_count = start;
    schema->mask_words = (start + 63) / 64;
    schema->code_count = codes;

    uint64_t tray_bytes = schema->field_count + sizeof(uint64_t) * (uint64_t)schema->mask_words;
    if (tray_bytes * codes > TN_SCHEMA_BYTES_MAX)
        return tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS,
                       "the trays of schema %s need more memory than the limit of %llu bytes",
                       tn_text(schema->module, schema->record->name), (unsigned long long)TN_SCHEMA_BYTES_MAX);
    if (codes * ((uint64_t)schema->record->forbid_count * schema->mask_words) > TN_SCHEMA_CHECKS_MAX)
        return tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS,
                       "schema %s has too many combinations for its %u forbidden specifiers",
                       tn_text(schema->module, schema->record->name), (unsigned)schema->record->forbid_count);
    return TN_OK;
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

static tn_status make_trays(tn_schema *schema, tn_error *error)
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
    if (!ready)
        return tn_fail_memory(error);
    return schema->tray_count > 0 ? TN_OK : forbids_all(schema, error);
}

tn_status tn_schema_new(const tn_module *module, uint32_t index, uint64_t max_codes, tn_schema **out, tn_error *error)
{
    *out = NULL;
    if (max_codes == 0)
        max_codes = TN_SCHEMA_CODES_DEFAULT;
    if (max_codes > TN_NO_TRAY)
        max_codes = TN_NO_TRAY;
    tn_schema *schema = calloc(1, sizeof *schema);
    if (!schema)
        return tn_fail_memory(error);
    schema->module = module;
    schema->record = &module->SCHEMA_records[index];
    schema->fields = module->FIELD_records + schema->record->field_first;
    schema->field_count = schema->record->field_count;
    schema->value_start = malloc((schema->field_count + 1u) * sizeof *schema->value_start);
    tn_status status = schema->value_start ? check_fields(schema, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = count_codes(schema, max_codes, error);
    if (status == TN_OK) {
        schema->values = schema->field_count > 0 ? module->VALUE_records + schema->fields[0].value_first : NULL;
        status = make_trays(schema, error);
    }
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
    free(schema->tray_values);
    free(schema->tray_masks);
    free(schema->tray_of_code);
    free(schema);
}

tn_tray tn_schema_tray(const tn_schema *schema, const uint8_t *values)
{
    uint64_t code = 0;
    for (uint32_t field = 0; field < schema->field_count; field++)
        code = code * schema->fields[field].value_count + values[field];
    return schema->tray_of_code[code];
}

uint32_t tn_schema_forbidden_by(const tn_schema *schema, const uint8_t *values)
{
    for (uint32_t i = 0; i < schema->record->forbid_count; i++) {
        uint32_t spec = schema->record->forbid_first + i;
        bool meets = true;
        for (uint32_t field = 0; meets && field < schema->field_count; field++) {
            uint32_t bit = schema->value_start[field] + values[field];
            meets = tn_spec_word(schema->module, spec, bit / 64) >> (bit % 64) & 1;
        }
        if (meets)
            return spec;
    }
    return UINT32_MAX;
}

bool tn_spec_meets(const tn_schema *schema, uint32_t spec, tn_tray tray)
{
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
