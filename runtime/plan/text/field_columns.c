/* Names the columns of fields. */
#include "runtime/plan/text/field_columns.h"

#include <stdio.h>
#include <strings.h>

static const char *field_name(const tn_schema *schema, uint32_t field)
{
    return tn_text(schema->module, schema->fields[field].name);
}

static bool is_own(const char *name, tn_column_file file)
{
    static const char *const own[TN_COLUMN_FILES][5] = {
        [TN_COLUMNS_CSV] = {"rank", "tray", "plan"},
        [TN_COLUMNS_PARQUET] = {"rank", "length", "total", "plan", "rank_text"}};
    for (size_t i = 0; i < 5 && own[file][i]; i++)
        if (strcasecmp(name, own[file][i]) == 0)
            return true;
    return false;
}

/* How many of the first `end` fields are called so. */
static unsigned fields_called(const tn_schema *schema, uint32_t end, const char *name)
{
    unsigned count = 0;
    for (uint32_t f = 0; f < end; f++)
        count += strcasecmp(field_name(schema, f), name) == 0;
    return count;
}

void tn_field_column(const tn_schema *schema, uint32_t field, tn_column_file file, char name[TN_COLUMN_NAME_SIZE])
{
    const char *plain = field_name(schema, field);
    unsigned before = fields_called(schema, field, plain) + is_own(plain, file);
    snprintf(name, TN_COLUMN_NAME_SIZE, "%s", plain);
    for (unsigned number = 2; before > 0; number++) {
        snprintf(name, TN_COLUMN_NAME_SIZE, "%s_%u", plain, number);
        before -= fields_called(schema, schema->field_count, name) == 0;
    }
}
