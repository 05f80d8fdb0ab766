#include "runtime/plan/schema/projection.h"

#include <stdlib.h>
#include <string.h>

bool tn_function_is_image(const tn_module *module, uint32_t function, tn_instruction *image)
{
    *image = tn_code_read(module->code, module->FUNCTION_records[function].code_begin);
    return image->opcode == TN_OP_IMAGE;
}

/* Are all of a tray's values in the fields of the base values that the base has? */
static bool is_of_base(const tn_schema *schema, const tn_schema_record *base, tn_tray tray)
{
    const tn_field_record *fields = &schema->module->FIELD_records[base->field_first];
    for (uint32_t f = 0; f < base->field_count; f++)
        if (tn_tray_value(schema, tray, f) >= fields[f].value_count)
            return false;
    return true;
}

/* Trays are in the order of their values, the first field most significant, and so are those above them. */
static void find_ranges(tn_projection *projection, const tn_schema_record *base)
{
    const tn_schema *own = projection->schema, *newer = projection->newer;
    tn_tray next = 0, end = 0;
    const uint8_t *before = NULL;
    for (tn_tray t = 0; t < own->tray_count; t++) {
        const uint8_t *values = own->tray_values + (size_t)t * own->field_count;
        if (!before || memcmp(before, values, base->field_count) != 0) {
            const uint8_t *rows = newer->tray_values;
            size_t width = newer->field_count;
            for (next = end; next < newer->tray_count && memcmp(rows + next * width, values, base->field_count) < 0;)
                next++;
            for (end = next; end < newer->tray_count && memcmp(rows + end * width, values, base->field_count) == 0;)
                end++;
        }
        before = values;
        projection->begin[t] = next;
        projection->end[t] = is_of_base(own, base, t) ? end : next;
    }
}

tn_status tn_projection_new(const tn_schema *schema, const tn_instruction *image, tn_projection **out, tn_error *error)
{
    const tn_module *module = schema->module;
    tn_projection *projection = calloc(1, sizeof *projection);
    if (!projection)
        return tn_fail_memory(error);
    projection->schema = schema;
    projection->library = &module->LIBRARY_records[image->first];
    static const char what[] = "a library onto another schema goes";
    tn_status status = tn_schema_listed(schema, what, error);
    if (status == TN_OK)
        status = tn_schema_new(module, projection->library->schema, 0, &projection->newer, error);
    if (status == TN_OK)
        status = tn_schema_listed(projection->newer, what, error);
    if (status == TN_OK) {
        projection->begin = calloc((size_t)schema->tray_count + 1, sizeof *projection->begin);
        projection->end = calloc((size_t)schema->tray_count + 1, sizeof *projection->end);
        status = projection->begin && projection->end ? TN_OK : tn_fail_memory(error);
    }
    if (status != TN_OK) {
        tn_projection_free(projection);
        return status;
    }
    find_ranges(projection, &module->SCHEMA_records[image->second]);
    *out = projection;
    return TN_OK;
}

void tn_projection_free(tn_projection *projection)
{
    if (!projection)
        return;
    tn_schema_free(projection->newer);
    free(projection->begin);
    free(projection->end);
    free(projection);
}

bool tn_projection_list(const tn_projection *projection, const uint32_t *class_of, tn_tray tray, uint32_t *seen,
                        uint32_t stamp, tn_key *trays)
{
    for (tn_tray t = projection->begin[tray]; t < projection->end[tray]; t++) {
        uint32_t *met = &seen[class_of[t]];
        if (*met == stamp)
            continue;
        *met = stamp;
        if (!tn_key_push(trays, t))
            return false;
    }
    return true;
}
