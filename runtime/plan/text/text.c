/* Reads and writes plan lines. */
#include "runtime/plan/text/text.h"

#include <string.h>

static bool append_text(tn_buffer *out, const char *text)
{
    return tn_buffer_append(out, text, strlen(text));
}

bool tn_plan_write_line(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out)
{
    for (size_t k = 0; k < length; k++) {
        if (k > 0 && !append_text(out, " | "))
            return false;
        for (uint32_t field = 0; field < schema->field_count; field++) {
            const tn_value_record *value = tn_tray_value_record(schema, trays[k], field);
            if (field > 0 && !append_text(out, " "))
                return false;
            if (!append_text(out, tn_text(schema->module, value->spelling)))
                return false;
        }
    }
    return true;
}

static void write_value(const tn_schema *schema, uint32_t field, tn_tray tray, tn_json *json)
{
    const tn_value_record *value = tn_tray_value_record(schema, tray, field);
    const char *key = tn_text(schema->module, schema->fields[field].name);
    const char *measure = tn_text(schema->module, value->measure);
    switch (schema->fields[field].kind) {
    case TN_FIELD_FLAG:
        tn_json_bool(json, key, tn_tray_value(schema, tray, field));
        break;
    case TN_FIELD_ZONE:
        tn_json_object(json, key);
        tn_json_string(json, "fill", tn_text(schema->module, value->name));
        if (*measure)
            tn_json_string(json, "depth", measure);
        tn_json_object_end(json);
        break;
    default:
        tn_json_string(json, key, tn_text(schema->module, value->spelling));
        break;
    }
}

void tn_plan_write_trays(const tn_schema *schema, const tn_tray *trays, size_t length, tn_json *json)
{
    tn_json_list(json, "trays");
    for (size_t k = 0; k < length; k++) {
        tn_json_object(json, NULL);
        for (uint32_t field = 0; field < schema->field_count; field++)
            write_value(schema, field, trays[k], json);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

bool tn_plan_write_json(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out)
{
    tn_json json = tn_json_text(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_plan_write_trays(schema, trays, length, &json);
    tn_json_object_end(&json);
    return !out->failed;
}
