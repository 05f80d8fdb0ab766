/* Writes the plans or houses that a question finds, one after another, as the options say. */
#ifndef TARTAN_CLI_PLAN_FOUND_ROWS_H
#define TARTAN_CLI_PLAN_FOUND_ROWS_H

#include "ask/plan/found.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/house_tables.h"
#include "cli/plan/library_job.h"
#include "driver/plan/provenance.h"
#include "runtime/plan/text/stream.h"

/* Writing ranked rows as the options say: plans or houses, as lines, JSON, CSV, packed, a SQLite library, or Parquet.
 */

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
         "in CSV a row for each tray, with a column for each field; in a database such rows in a second table. Of "    \
         "houses a column for each choice, function, measure and price, and tables of rooms and faces")
#define OPTION_CSV_SAFE                                                                                                \
    FLAG("csv-safe", 0, written.csv_safe,                                                                              \
         "in CSV, put ' before a plan that begins with = + - or @, so that no spreadsheet computes it")
#define OPTION_ROW_GROUP                                                                                               \
    NUMBER("row-group", 0, "N", written.row_group, 1, UINT32_MAX, "in Parquet, plans of a row group (default 1000000)")
#define OPTION_PLAN_WAYS                                                                                               \
    FLAG("ways", 0, ways, "also in how many ways each plan is derived by what the library generates")
#define OPTION_ROWS_OF_PLANS(member, does)                                                                             \
    FLAG("plans", 0, member,                                                                                           \
         does ", of a library whose trays stand for plans: each tray with its plan in brackets; ranks are among "      \
              "rows of plans")
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

typedef struct tn_found_rows {
    tn_job *job;
    const tn_written_settings *settings;
    const char *made;      /* the command, in words that decide the result */
    bool sample;           /* a part of it is not one: that is said if an interrupt leaves a part in a database */
    bool enumerates;       /* progress is shown, and if it is interrupted, how to go on is said */
    bool all_ranks;        /* each rank up to the last is written */
    tn_option_number most; /* that are written; or not given */

    tn_taker taker;
    tn_found_of of;
    tn_plan_writer *writer; /* NULL: it has not begun, or is closed */
    bool in_tables;         /* they are houses, and written as tables */
    tn_house_tables_file tables;
    tn_provenance described; /* of houses */
    mpz_t first, next;       /* ranks: the first of all, before anything was resumed, and the next */
    uint64_t written;        /* those resumed included */
    bool put_failed;         /* plans that were made together could not be written */
    tn_buffer line, members; /* of a house */
    tn_progress progress;
} tn_found_rows;

/* The job's session is to give what it finds to these rows. End them in any case. */
void tn_found_rows_begin(tn_found_rows *rows, tn_job *job, const tn_written_settings *settings, const char *made);

/* Takes note of what the question came to, and finishes the file as tn_job_rows_close does. */
void tn_found_rows_end(tn_found_rows *rows, tn_status status);

#endif
