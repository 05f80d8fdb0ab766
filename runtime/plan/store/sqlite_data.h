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
tn_status tn_writer_sqlite_write(tn_plan_writer *writer, const char *rank, const tn_tray *trays, size_t length,
                                 tn_error *error);
tn_status tn_writer_sqlite_close(tn_plan_writer *writer, tn_error *error);
void tn_writer_sqlite_free(tn_plan_writer *writer); /* rolls back the batch in hand */

#endif
