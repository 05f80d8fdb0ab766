/* Writes houses that a question finds as tables (driver/house/tables.h): of houses, of their rooms and of their faces.
 */
#ifndef TARTAN_CLI_PLAN_HOUSE_TABLES_H
#define TARTAN_CLI_PLAN_HOUSE_TABLES_H

#include "ask/plan/found.h"
#include "driver/house/tables.h"
#include "driver/parquet/table.h"
#include "runtime/base/file.h"
#include "runtime/plan/text/database.h"

#define TN_TABLES_METADATA 7u

/* Tables under way. Starts as zeros, but for csv_safe, named, and `written`, if houses stand before these. named: the
 * file of houses has the table's name, too: houses.houses.csv. */
typedef struct tn_house_tables_file {
    const struct tn_numbered *houses;
    tn_house_tables *tables;
    const tn_plan_database *database; /* NULL: files */
    tn_stored_tables *file;
    bool parquet; /* the files are, else CSV */
    tn_parquet_table *packed[TN_HOUSE_TABLES];
    tn_parquet_column *columns[TN_HOUSE_TABLES]; /* of these; owned */
    const char *metadata[TN_TABLES_METADATA][2]; /* names and values; of the caller's */
    bool csv_safe, named, open[TN_HOUSE_TABLES];
    char *paths[TN_HOUSE_TABLES]; /* owned; NULL: the table is not written */
    tn_output outputs[TN_HOUSE_TABLES];
    tn_buffer line;
    uint64_t written;
} tn_house_tables_file;

/* Begins the files of CSV or Parquet (houses.csv, houses.rooms.csv and houses.faces.csv; of standard output the houses
 * alone), or the tables of a database. The metadata is borrowed till it is closed. Close it in any case. */
tn_status tn_house_tables_open(tn_house_tables_file *file, const struct tn_numbered *houses, const char *path,
                               tn_plan_format format, const tn_plan_metadata *metadata, tn_error *error);

/* rank: among the houses of the library, or NULL. */
tn_status tn_house_tables_write(tn_house_tables_file *file, const tn_house *house, mpz_srcptr rank, tn_error *error);

/* A row that is written already, as tn_house_tables_add gives it: `file` is such tables. */
tn_status tn_house_tables_row(void *file, tn_house_table table, const char *const *cells, tn_error *error);

/* Puts the files in place if all went well, or else gives them up. */
tn_status tn_house_tables_close(tn_house_tables_file *file, bool complete, tn_error *error);

#endif
