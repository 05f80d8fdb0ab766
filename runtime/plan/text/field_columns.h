/* Which columns a file of plans in Parquet has: rank, length, total where the schema has lengths, a list for each
 * field, and the plan line where that is asked for. */
#ifndef TARTAN_DRIVER_PARQUET_COLUMNS_H
#define TARTAN_DRIVER_PARQUET_COLUMNS_H

#include "runtime/plan/schema/schema.h"

#define TN_COLUMN_NAME_SIZE (TN_NAME_MAX + 16)

/* The name of a field's column: the field's, with _2, _3, ... behind it where a column before has that name already.
 * Programs take capital and small letters for the same. */
void tn_parquet_name(const tn_schema *schema, uint32_t field, char name[TN_COLUMN_NAME_SIZE]);

#endif
