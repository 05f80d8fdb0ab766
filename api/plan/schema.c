/* The C interface to schemas, their fields and trays, and plans as text. */
#include <stdlib.h>
#include <string.h>

#include "api/plan/plan.h"
#include "runtime/plan/text/text.h"

_Static_assert((int)TARTAN_FIELD_LENGTH == (int)TN_FIELD_LENGTH && (int)TARTAN_FIELD_ZONE == (int)TN_FIELD_ZONE,
               "kinds of fields are the same numbers");

const char *tartan_schema_name(const tartan_schema *schema)
{
    const tn_schema *s = tn_api_schema(schema);
    return tn_text(s->module, s->record->name);
}

uint32_t tartan_schema_tray_count(const tartan_schema *schema)
{
    return tn_api_schema(schema)->tray_count;
}

tn_status tn_api_trays(const tn_schema *schema, const uint32_t *trays, size_t length, tn_error *error)
{
    for (size_t i = 0; i < length; i++)
        if (trays[i] >= schema->tray_count)
            return tn_fail(error, TN_INVALID, TN_CODE_NONE,
                           "tray %zu of the plan has number %u, and schema `%s` has trays 0 to %u", i + 1,
                           (unsigned)trays[i], tn_text(schema->module, schema->record->name),
                           (unsigned)schema->tray_count - 1);
    return TN_OK;
}

/* ---- fields */

size_t tartan_schema_field_count(const tartan_schema *schema)
{
    return tn_api_schema(schema)->field_count;
}

static tartan_status no_field(const tn_schema *schema, size_t field, tartan_error *error)
{
    return tn_api_refuse(error, TARTAN_INVALID, "schema `%s` has fields 0 to %u, and no field %zu",
                         tn_text(schema->module, schema->record->name), (unsigned)schema->field_count - 1, field);
}

tartan_status tartan_schema_field(const tartan_schema *schema, size_t i, tartan_field *field, tartan_error *error)
{
    if (!schema || !field)
        return tn_api_missing(error, schema ? "field to fill" : "schema");
    const tn_schema *s = tn_api_schema(schema);
    if (i >= s->field_count)
        return no_field(s, i, error);
    const tn_field_record *record = &s->fields[i];
    const tartan_field own = {.name = tn_text(s->module, record->name),
                              .doc = tn_text(s->module, record->doc),
                              .kind = (tartan_field_kind)record->kind,
                              .value_count = record->value_count};
    return TN_API_GIVE(tartan_field, field, &own, error);
}

tartan_status tartan_schema_value(const tartan_schema *schema, size_t field, size_t i, tartan_value *value,
                                  tartan_error *error)
{
    if (!schema || !value)
        return tn_api_missing(error, schema ? "value to fill" : "schema");
    const tn_schema *s = tn_api_schema(schema);
    if (field >= s->field_count)
        return no_field(s, field, error);
    if (i >= s->fields[field].value_count)
        return tn_api_refuse(error, TARTAN_INVALID, "field `%s` has no value %zu",
                             tn_text(s->module, s->fields[field].name), i);
    const tn_value_record *record = &s->values[s->value_start[field] + i];
    const tartan_value own = {.name = tn_text(s->module, record->name),
                              .spelling = tn_text(s->module, record->spelling),
                              .doc = tn_text(s->module, record->doc),
                              .length = record->length};
    return TN_API_GIVE(tartan_value, value, &own, error);
}

tartan_status tartan_schema_trays(const tartan_schema *schema, size_t field, uint32_t *values, tartan_error *error)
{
    if (!schema || !values)
        return tn_api_missing(error, schema ? "room for values" : "schema");
    const tn_schema *s = tn_api_schema(schema);
    if (field >= s->field_count)
        return no_field(s, field, error);
    for (tn_tray tray = 0; tray < s->tray_count; tray++)
        values[tray] = tn_tray_value(s, tray, (uint32_t)field);
    return TARTAN_OK;
}

/* ---- plans as text */

tartan_status tartan_plan_read(const tartan_schema *schema, const char *line, size_t size, uint32_t *trays,
                               size_t capacity, size_t *length, tartan_error *error)
{
    if (!schema || (size && !line) || (capacity && !trays) || !length)
        return tn_api_missing(error, !schema ? "schema" : "plan");
    tn_plan plan = {0};
    tn_error found;
    tn_status status = tn_plan_parse_line(tn_api_schema(schema), line, size, capacity, &plan, &found);
    if (status == TN_OK) {
        if (plan.length)
            memcpy(trays, plan.trays, plan.length * sizeof *trays);
        *length = plan.length;
    }
    free(plan.trays);
    if (status == TN_LIMIT)
        tn_error_help(&found, "give it room for more than %zu trays", capacity);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_plan_write(const tartan_schema *schema, const uint32_t *trays, size_t length, char **line,
                                tartan_error *error)
{
    if (!schema || (length && !trays))
        return tn_api_missing(error, !schema ? "schema" : "plan");
    tn_error found;
    if (tn_api_trays(tn_api_schema(schema), trays, length, &found) != TN_OK)
        return tn_api_fail(&found, error);
    tn_buffer text = {0};
    /* The empty plan writes nothing, and is still a text. */
    if (!tn_buffer_append(&text, "", 0) || !tn_plan_write_line(tn_api_schema(schema), trays, length, &text) ||
        !text.data) {
        free(text.data);
        tn_fail_memory(&found);
        return tn_api_fail(&found, error);
    }
    *line = text.data;
    return TARTAN_OK;
}
