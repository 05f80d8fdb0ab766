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

static bool append_value(const tn_schema *schema, uint32_t field, tn_tray tray, tn_buffer *out)
{
    const tn_value_record *value = tn_tray_value_record(schema, tray, field);
    const char *name = tn_text(schema->module, value->name), *measure = tn_text(schema->module, value->measure);
    switch (schema->fields[field].kind) {
    case TN_FIELD_FLAG:
        return append_text(out, tn_tray_value(schema, tray, field) ? "true" : "false");
    case TN_FIELD_ZONE:
        return append_text(out, "{\"fill\":") && tn_buffer_append_json(out, name) &&
               (!*measure || (append_text(out, ",\"depth\":") && tn_buffer_append_json(out, measure))) &&
               append_text(out, "}");
    default:
        return tn_buffer_append_json(out, tn_text(schema->module, value->spelling));
    }
}

static bool append_tray(const tn_schema *schema, tn_tray tray, tn_buffer *out)
{
    if (!append_text(out, "{"))
        return false;
    for (uint32_t field = 0; field < schema->field_count; field++) {
        bool done = (field == 0 || append_text(out, ",")) &&
                    tn_buffer_append_json(out, tn_text(schema->module, schema->fields[field].name)) &&
                    append_text(out, ":") && append_value(schema, field, tray, out);
        if (!done)
            return false;
    }
    return append_text(out, "}");
}

bool tn_plan_write_trays(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out)
{
    if (!append_text(out, "["))
        return false;
    for (size_t k = 0; k < length; k++) {
        if ((k > 0 && !append_text(out, ",")) || !append_tray(schema, trays[k], out))
            return false;
    }
    return append_text(out, "]");
}

bool tn_plan_write_json(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out)
{
    return append_text(out, "{\"trays\":") && tn_plan_write_trays(schema, trays, length, out) && append_text(out, "}");
}
