/* Names the columns of fields. */
#include "driver/parquet/columns.h"

#include <stdio.h>
#include <strings.h>

static const char *field_name(const tn_schema *schema, uint32_t field)
{
    return tn_text(schema->module, schema->fields[field].name);
}

static bool is_own(const char *name)
{
    static const char *const own[] = {"rank", "length", "total", "plan"};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strcasecmp(name, own[i]) == 0)
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

void tn_parquet_name(const tn_schema *schema, uint32_t field, char name[TN_COLUMN_NAME_SIZE])
{
    const char *plain = field_name(schema, field);
    unsigned before = fields_called(schema, field, plain) + is_own(plain);
    snprintf(name, TN_COLUMN_NAME_SIZE, "%s", plain);
    for (unsigned number = 2; before > 0; number++) {
        snprintf(name, TN_COLUMN_NAME_SIZE, "%s_%u", plain, number);
        before -= fields_called(schema, schema->field_count, name) == 0;
    }
}
