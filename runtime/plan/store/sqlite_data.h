/* What reading and writing plan libraries in SQLite is made of. */
#ifndef TARTAN_PLAN_STORE_SQLITE_DATA_H
#define TARTAN_PLAN_STORE_SQLITE_DATA_H

#include <sqlite3.h>

#include "runtime/plan/text/database.h"
#include "runtime/plan/text/reader.h"
#include "runtime/plan/text/writer.h"

tn_status tn_reader_sqlite_open(tn_plan_reader *reader, tn_error *error);
tn_status tn_reader_sqlite_next(tn_plan_reader *reader, bool *found, tn_error *error);
void tn_reader_sqlite_close(tn_plan_reader *reader);

tn_status tn_writer_sqlite_open(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error);
tn_status tn_writer_sqlite_write(tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_error *error);
tn_status tn_writer_sqlite_close(tn_plan_writer *writer, tn_error *error);
void tn_writer_sqlite_free(tn_plan_writer *writer); /* rolls back the batch in hand */

/* What went wrong with the database last, as an error. */
tn_status tn_writer_sqlite_failed(const tn_plan_writer *writer, tn_error *error);
/* Runs a statement made with sqlite3_mprintf, and frees it; NULL: out of memory. */
tn_status tn_writer_sqlite_run(tn_plan_writer *writer, char *sql, tn_error *error);

/* ---- trays_sqlite.c: the table `trays`, a row a tray and a column a field */
tn_status tn_trays_create(tn_plan_writer *writer, tn_error *error);
tn_status tn_trays_prepare(tn_plan_writer *writer, tn_error *error);
bool tn_trays_insert(tn_plan_writer *writer, const tn_tray *trays, size_t length); /* of plan writer->number */
tn_status tn_trays_index(tn_plan_writer *writer, tn_error *error);

#endif
