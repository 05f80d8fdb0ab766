/* Tables of any columns in SQLite: the calls of runtime/plan/text/database.h about them. */
#ifndef TARTAN_PLAN_STORE_TABLES_H
#define TARTAN_PLAN_STORE_TABLES_H

#include "runtime/plan/text/database.h"

#define TN_LIBRARY_BUSY_MILLISECONDS 10000 /* how long to wait for somebody who reads the library */

tn_status tn_tables_open(const char *path, const tn_stored_table *tables, size_t count,
                         const char *const (*metadata)[2], size_t metadata_count, tn_stored_tables **file,
                         tn_error *error);
tn_status tn_tables_add(tn_stored_tables *file, size_t table, const char *const *cells, tn_error *error);
tn_status tn_tables_close(tn_stored_tables *file, tn_error *error);
void tn_tables_free(tn_stored_tables *file);

#endif
