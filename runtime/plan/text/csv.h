/* Records of CSV (RFC 4180), as readers of plans take them apart. Internal to reader_csv.c and reader_columns.c. */
#ifndef TARTAN_PLAN_TEXT_CSV_H
#define TARTAN_PLAN_TEXT_CSV_H

#include "runtime/plan/text/reader.h"

/* A field of a record: its text without the quotes around it, where that begins in the line, and whether quotes are
 * doubled in it. */
typedef struct tn_csv_field {
    const char *text;
    size_t size;
    size_t column;
    bool doubled;
} tn_csv_field;

/* Takes the field at *at, and the comma after it; false (and *at on what is wrong) where it is not well-formed. */
bool tn_csv_take(const char *line, size_t size, size_t *at, tn_csv_field *field);
bool tn_csv_named(const tn_csv_field *field, const char *name);

/* The field's text with doubled quotes made single, in reader->quoted. False where out of memory. */
bool tn_csv_unquote(tn_plan_reader *reader, tn_csv_field *field);

/* 1 where the text begins with the mark that keeps a spreadsheet from computing what follows, which is no part of it.
 */
size_t tn_csv_mark(const tn_csv_field *field);

tn_status tn_csv_bad_record(tn_plan_reader *reader, size_t at, const char *message, const char *help, tn_error *error);

/* ---- a row a tray (reader_columns.c) */

/* Is the line a header with a column `tray` and one of a field of the schema? Sets the columns then. *is_header. */
tn_status tn_columns_header(tn_plan_reader *reader, const char *line, size_t size, bool *is_header, tn_error *error);
tn_status tn_columns_next(tn_plan_reader *reader, bool *found, tn_error *error);

#endif
