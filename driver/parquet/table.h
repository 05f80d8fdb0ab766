/* A table of any columns in Parquet, such as one of houses: each column has numbers or texts, or no value. */
#ifndef TARTAN_DRIVER_PARQUET_TABLE_H
#define TARTAN_DRIVER_PARQUET_TABLE_H

#include <stdio.h>

#include "driver/parquet/page.h"
#include "runtime/base/error.h"

/* type: INT64, DOUBLE or TEXT. */
typedef struct tn_parquet_column {
    const char *name;
    enum tn_parquet_type type;
} tn_parquet_column;

typedef struct tn_parquet_table tn_parquet_table;

/* Begins a table in a file that is open, and borrowed with its path until the table is freed, as the columns and the
 * metadata (names and values; those without a value are left out) are. Free it in any case. */
tn_status tn_parquet_table_begin(FILE *out, const char *path, const tn_parquet_column *columns, size_t count,
                                 const char *const (*metadata)[2], size_t metadata_count, tn_parquet_table **table,
                                 tn_error *error);

/* Adds a row: a text for each column, NULL where it has no value. */
tn_status tn_parquet_table_add(tn_parquet_table *table, const char *const *cells, tn_error *error);

/* Writes what is left, and the footer. */
tn_status tn_parquet_table_end(tn_parquet_table *table, tn_error *error);
void tn_parquet_table_free(tn_parquet_table *table);

#endif
