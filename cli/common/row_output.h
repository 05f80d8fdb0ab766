/* Writing ranked rows as the options say: plans or houses, as lines, JSON, CSV, packed, a SQLite library, or Parquet.
 */
#ifndef TARTAN_CLI_COMMON_ROW_OUTPUT_H
#define TARTAN_CLI_COMMON_ROW_OUTPUT_H

#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "runtime/plan/text/stream.h"

/* How ranked plans are written. Commands embed it as `written`. */
typedef struct tn_written_settings {
    const char *output;
    int format; /* a tn_plan_format */
    bool columns;
    bool csv_safe;
    bool resume;
    bool plan_lines;
    tn_option_number row_group;
} tn_written_settings;

#define OPTION_PLAN_FORMAT                                                                                             \
    CHOICE("format", 'f', "FORMAT", written.format, "auto|lines|json|csv|bin|sqlite|parquet",                          \
           "what to write: lines, json, csv, bin, sqlite or parquet (default: what the name behind -o ends in, "       \
           "otherwise lines)")
#define OPTION_COLUMNS                                                                                                 \
    FLAG("columns", 0, written.columns,                                                                                \
         "in CSV a row for each tray, with a column for each field; in a database such rows in a second table")
#define OPTION_CSV_SAFE                                                                                                \
    FLAG("csv-safe", 0, written.csv_safe,                                                                              \
         "in CSV, put ' before a plan that begins with = + - or @, so that no spreadsheet computes it")
#define OPTION_ROW_GROUP                                                                                               \
    NUMBER("row-group", 0, "N", written.row_group, 1, UINT32_MAX, "in Parquet, plans of a row group (default 1000000)")
#define OPTION_PLAN_LINES FLAG("plan-lines", 0, written.plan_lines, "in Parquet, add a column of plan lines")
#define TN_WRITES_ROWS                                                                                                 \
    (TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES(CSV) | TN_WRITES(BIN) | TN_WRITES(SQLITE) | TN_WRITES(PARQUET))
#define OPTION_PLAN_OUTPUT                                                                                             \
    OUTPUT(written.output, TN_WRITES_ROWS,                                                                             \
           "write to FILE instead of standard output, as its ending says: .json, .csv, .bin, .sqlite and .db, "        \
           ".parquet; otherwise as lines")

/* What is written, besides what the options say. */
typedef struct tn_row_source {
    const tn_schema *schema;
    const tn_plan_metadata *metadata;
    const tn_row_columns *rows; /* NULL: plans */
    mpz_srcptr ranks;           /* all ranks are below */
} tn_row_source;

/* Opens the output that --output and --format ask for. False where that failed. */
bool tn_job_row_writer(tn_job *job, const tn_written_settings *settings, const tn_row_source *source,
                       tn_plan_writer **writer);

/* Finishes the file, unless the job has failed: then it is given up (a database keeps its whole batches). Frees the
 * writer. */
void tn_job_rows_close(tn_job *job, tn_plan_writer *writer);

#endif
