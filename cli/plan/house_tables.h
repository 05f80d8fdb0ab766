/* Writes houses that a question finds as tables (driver/house/tables.h): of houses, of their rooms and of their faces.
 */
#ifndef TARTAN_CLI_PLAN_HOUSE_TABLES_H
#define TARTAN_CLI_PLAN_HOUSE_TABLES_H

#include "ask/plan/found.h"
#include "cli/common/job.h"
#include "driver/house/tables.h"
#include "driver/parquet/table.h"
#include "runtime/plan/text/database.h"

#define TN_TABLES_METADATA 7u

/* Tables under way. Starts as zeros. */
typedef struct tn_house_tables_file {
    tn_job *job;
    const struct tn_numbered *houses;
    tn_house_tables *tables;
    const tn_plan_database *database; /* NULL: files */
    tn_stored_tables *file;
    bool parquet; /* the files are, else CSV */
    tn_parquet_table *packed[TN_HOUSE_TABLES];
    tn_parquet_column *columns[TN_HOUSE_TABLES]; /* of these; owned */
    const char *metadata[TN_TABLES_METADATA][2]; /* names and values; of the caller's */
    bool csv_safe, open[TN_HOUSE_TABLES];
    char *paths[TN_HOUSE_TABLES]; /* owned; NULL: the table is not written */
    tn_output outputs[TN_HOUSE_TABLES];
    tn_buffer line;
    uint64_t written;
} tn_house_tables_file;

/* Begins the files of CSV or Parquet (houses.csv, houses.rooms.csv and houses.faces.csv; of standard output the houses
 * alone), or the tables of a database. The metadata is borrowed till it is closed. What is wrong is said; false then.
 * Close it in any case. */
bool tn_house_tables_open(tn_house_tables_file *file, tn_job *job, const struct tn_numbered *houses, const char *path,
                          tn_plan_format format, bool csv_safe, const tn_plan_metadata *metadata);
tn_status tn_house_tables_write(tn_house_tables_file *file, const tn_found_one *found, tn_error *error);

/* Puts the files in place if all went well, or else gives them up. */
void tn_house_tables_close(tn_house_tables_file *file, bool complete);

#endif
