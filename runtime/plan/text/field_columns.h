/* How the columns of fields are called in files with a column for each field: no two columns have one name.
 */
#ifndef TARTAN_PLAN_TEXT_FIELD_COLUMNS_H
#define TARTAN_PLAN_TEXT_FIELD_COLUMNS_H

#include "runtime/plan/schema/schema.h"

#define TN_COLUMN_NAME_SIZE (TN_NAME_MAX + 16)

/* Files that have columns of their own besides those of fields. */
typedef enum tn_column_file {
    TN_COLUMNS_CSV,     /* rank, tray; and `plan` says that a row is a plan */
    TN_COLUMNS_PARQUET, /* rank, length, total, plan */
    TN_COLUMN_FILES
} tn_column_file;

/* The name of a field's column: the field's, with _2, _3, ... behind it where a column before has that name already.
 * Programs take capital and small letters for the same. */
void tn_field_column(const tn_schema *schema, uint32_t field, tn_column_file file, char name[TN_COLUMN_NAME_SIZE]);

#endif
