/* The C interface: plans are read from text and written. */
#include <stdlib.h>
#include <string.h>

#include "api/runtime/api.h"
#include "runtime/plan/text/text.h"

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

tartan_status tartan_plan_read(const tartan_schema *schema, const char *line, size_t size, uint32_t *trays,
                               size_t capacity, size_t *length, tartan_error *error)
{
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

void tartan_text_free(char *text)
{
    free(text);
}
