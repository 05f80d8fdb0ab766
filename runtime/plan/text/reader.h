/* Inside of tn_plan_reader: its buffer of input, and one function a format. */
#ifndef TARTAN_PLAN_TEXT_READER_H
#define TARTAN_PLAN_TEXT_READER_H

#include "runtime/base/file.h"
#include "runtime/plan/text/compression.h"
#include "runtime/plan/text/database.h"
#include "runtime/plan/text/parquet.h"
#include "runtime/plan/text/scanner.h"
#include "runtime/plan/text/stream.h"

struct tn_plan_reader {
    const tn_schema *schema;
    tn_plan_scanner *scanner;
    tn_plan_format format;
    size_t max_length, max_line;
    char *path;
    uint64_t line; /* of the plan read last */
    bool at_end;
    tn_plan plan;
    tn_buffer rank; /* of the plan read last, in digits; empty where the file gives none */

    /* Input of every format but SQLite: data[begin, end) is read and not yet used. */
    int file; /* descriptor, or -1 */
    tn_file_state opened;
    bool input_ended;
    uint64_t left;                          /* bytes of the file that may still be read; UINT64_MAX: all */
    const tn_plan_compression *compression; /* NULL: none is known */
    void *decompressing;                    /* its state, where the input is compressed */
    uint64_t shared, shared_end;            /* bytes of the file that were given up to tn_plan_lines_read */
    char *data;
    size_t begin, end, capacity;
    const char *text; /* the line of the plan read last */
    size_t text_size;

    /* CSV: the columns of the plan and (or SIZE_MAX) its rank, and the texts of quoted fields */
    size_t plan_column, rank_column;
    tn_buffer quoted;

    /* CSV with a row a tray: the column of the tray's place, and the field of each column (or UINT32_MAX); NULL: a row
     * is a plan */
    size_t tray_column, column_count;
    uint32_t *column_fields;
    bool skipping; /* the rows of a plan of which one was bad */

    unsigned tray_bytes; /* packed */

    const tn_plan_parquet *parquet; /* where it is Parquet that is read */
    void *parquet_state;

    const tn_plan_database *sqlite; /* where it is SQLite that is read */
    struct sqlite3 *database;
    struct sqlite3_stmt *rows;
    bool packed; /* the library's packed plans are of this schema */
};

/* Reads more input, so that at least `wanted` bytes are there or the input has ended. */
tn_status tn_reader_fill(tn_plan_reader *reader, size_t wanted, tn_error *error);

/* The next line, without its end, into reader->text; *found is false at the end. E0605 (and the line is skipped) where
 * it is too long. */
tn_status tn_reader_line(tn_plan_reader *reader, bool *found, tn_error *error);

/* E0605 for that, at a line. */
tn_status tn_reader_line_too_long(size_t max_line, uint64_t line, tn_error *error);

/* The first character of a line that is no blank, or 0. */
char tn_reader_first(const char *text, size_t size);

/* Looks at the first line of text without taking it: is it the header of a CSV file? Takes it and sets the columns if
 * so. */
tn_status tn_reader_csv_open(tn_plan_reader *reader, bool *is_csv, tn_error *error);
tn_status tn_reader_csv_next(tn_plan_reader *reader, bool *found, tn_error *error);

tn_status tn_reader_bin_open(tn_plan_reader *reader, tn_error *error);
tn_status tn_reader_bin_step(tn_plan_reader *reader, tn_error *error); /* skips a plan unread */
tn_status tn_reader_bin_next(tn_plan_reader *reader, bool *found, tn_error *error);

/* E0805 for a plan of so many trays. */
tn_status tn_reader_too_long(const tn_plan_reader *reader, uint64_t length, tn_error *error);

#endif
