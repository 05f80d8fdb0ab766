/* Writes tables of any columns into a SQLite file, in one transaction. */
#include "runtime/plan/store/tables.h"

#include <errno.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/plan/text/writer.h"

struct tn_stored_tables {
    char *path;
    sqlite3 *database;
    sqlite3_stmt **inserts; /* [tables] */
    size_t *columns;        /* the same: how many */
    size_t count;
    bool replaces; /* a library that was there */
};

static tn_status failed(const tn_stored_tables *file, tn_error *error)
{
    int code = file->database ? sqlite3_errcode(file->database) : SQLITE_NOMEM;
    if (code == SQLITE_NOMEM)
        return tn_fail_memory(error);
    int reason = code == SQLITE_FULL ? ENOSPC : code == SQLITE_READONLY ? EACCES : 0;
    if (code == SQLITE_CANTOPEN)
        reason = sqlite3_system_errno(file->database);
    if (reason)
        return tn_cannot_write(file->path, reason, error);
    return tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %s: %s", file->path, sqlite3_errmsg(file->database));
}

static tn_status run(const tn_stored_tables *file, const char *sql, tn_error *error)
{
    return sqlite3_exec(file->database, sql, NULL, NULL, NULL) == SQLITE_OK ? TN_OK : failed(file, error);
}

/* Runs a statement made by sqlite3, and frees it; NULL: out of memory. */
static tn_status run_made(const tn_stored_tables *file, char *sql, tn_error *error)
{
    if (!sql)
        return tn_fail_memory(error);
    tn_status status = run(file, sql, error);
    sqlite3_free(sql);
    return status;
}

static sqlite3_int64 number_of(const tn_stored_tables *file, const char *query)
{
    sqlite3_stmt *row = NULL;
    sqlite3_int64 number = -1;
    if (sqlite3_prepare_v2(file->database, query, -1, &row, NULL) == SQLITE_OK && sqlite3_step(row) == SQLITE_ROW)
        number = sqlite3_column_int64(row, 0);
    sqlite3_finalize(row);
    return number;
}

/* Nothing is written over that is no library of ours. */
static tn_status look(tn_stored_tables *file, tn_error *error)
{
    sqlite3_int64 pages = number_of(file, "PRAGMA page_count");
    file->replaces = pages > 0;
    if (pages == 0 || number_of(file, "PRAGMA application_id") == TN_LIBRARY_APPLICATION_ID)
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_WRITE, "%s: the file exists already, and it is not a plan library", file->path);
    tn_error_help(error, "name another file, or remove this one");
    return TN_IO;
}

static tn_status create(tn_stored_tables *file, const tn_stored_table *table, size_t number, tn_error *error)
{
    sqlite3_str *sql = sqlite3_str_new(file->database), *insert = sqlite3_str_new(file->database);
    sqlite3_str_appendf(sql, "CREATE TABLE \"%w\" (", table->name);
    sqlite3_str_appendf(insert, "INSERT INTO \"%w\" VALUES (", table->name);
    for (size_t i = 0; i < table->count; i++) {
        sqlite3_str_appendf(sql, "%s\"%w\" %s", i ? ", " : "", table->columns[i].name, table->columns[i].type);
        sqlite3_str_appendall(insert, i ? ", ?" : "?");
    }
    sqlite3_str_appendall(sql, ")");
    sqlite3_str_appendall(insert, ")");
    char *prepared = sqlite3_str_finish(insert);
    tn_status status = run_made(file, sqlite3_str_finish(sql), error);
    if (status == TN_OK && !prepared)
        status = tn_fail_memory(error);
    file->columns[number] = table->count;
    if (status == TN_OK && sqlite3_prepare_v2(file->database, prepared, -1, &file->inserts[number], NULL) != SQLITE_OK)
        status = failed(file, error);
    sqlite3_free(prepared);
    return status;
}

static tn_status begin(const tn_stored_tables *file, tn_error *error)
{
    tn_status status = run(file,
                           "BEGIN IMMEDIATE; DROP TABLE IF EXISTS trays; DROP TABLE IF EXISTS plans; "
                           "DROP TABLE IF EXISTS houses; DROP TABLE IF EXISTS rooms; DROP TABLE IF EXISTS faces; "
                           "DROP TABLE IF EXISTS metadata; "
                           "CREATE TABLE metadata (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
                           error);
    return status == TN_OK
               ? run_made(file, sqlite3_mprintf("PRAGMA application_id = %d", TN_LIBRARY_APPLICATION_ID), error)
               : status;
}

static tn_status open_database(tn_stored_tables *file, tn_error *error)
{
    int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_PRIVATECACHE | SQLITE_OPEN_NOMUTEX;
    if (sqlite3_open_v2(file->path, &file->database, flags, NULL) != SQLITE_OK)
        return failed(file, error);
    sqlite3_busy_timeout(file->database, TN_LIBRARY_BUSY_MILLISECONDS);
    sqlite3_db_config(file->database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    return look(file, error);
}

tn_status tn_tables_open(const char *path, const tn_stored_table *tables, size_t count,
                         const char *const (*metadata)[2], size_t metadata_count, tn_stored_tables **made,
                         tn_error *error)
{
    tn_stored_tables *file = calloc(1, sizeof *file);
    *made = file;
    if (!file)
        return tn_fail_memory(error);
    file->path = strdup(path);
    file->inserts = calloc(count + 1, sizeof *file->inserts);
    file->columns = calloc(count + 1, sizeof *file->columns);
    file->count = count;
    if (!file->path || !file->inserts || !file->columns)
        return tn_fail_memory(error);
    if (strcmp(path, "-") == 0)
        return tn_fail(error, TN_INVALID, E_USAGE,
                       "a SQLite library cannot be written to standard output: name a file");
    tn_status status = open_database(file, error);
    if (status == TN_OK)
        status = begin(file, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = create(file, &tables[i], i, error);
    for (size_t i = 0; status == TN_OK && i < metadata_count; i++)
        if (metadata[i][1])
            status = run_made(
                file, sqlite3_mprintf("INSERT INTO metadata VALUES (%Q, %Q)", metadata[i][0], metadata[i][1]), error);
    return status;
}

/* The column's type makes a number of a text that is one. */
tn_status tn_tables_add(tn_stored_tables *file, size_t table, const char *const *cells, tn_error *error)
{
    sqlite3_stmt *insert = file->inserts[table];
    for (size_t i = 0; i < file->columns[table]; i++)
        sqlite3_bind_text(insert, (int)i + 1, cells[i], -1, SQLITE_STATIC);
    int code = sqlite3_step(insert);
    sqlite3_reset(insert);
    return code == SQLITE_DONE ? TN_OK : failed(file, error);
}

tn_status tn_tables_close(tn_stored_tables *file, tn_error *error)
{
    tn_status status = run(file, "COMMIT", error);
    for (size_t i = 0; i < file->count; i++) {
        sqlite3_finalize(file->inserts[i]);
        file->inserts[i] = NULL;
    }
    return status == TN_OK && file->replaces ? run(file, "VACUUM", error) : status;
}

void tn_tables_free(tn_stored_tables *file)
{
    if (!file)
        return;
    for (size_t i = 0; file->inserts && i < file->count; i++)
        sqlite3_finalize(file->inserts[i]);
    sqlite3_close(file->database); /* rolls back what was not closed */
    free(file->inserts);
    free(file->columns);
    free(file->path);
    free(file);
}
