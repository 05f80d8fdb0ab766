/* Plan libraries in SQLite: the table `plans`, packed where the library was made with this very schema, else its plan
 * lines. */
#include <string.h>
#include <unistd.h>

#include "runtime/plan/store/sqlite_data.h"
#include "runtime/plan/text/pack.h"

static tn_status failed(const tn_plan_reader *reader, tn_error *error)
{
    int code = sqlite3_errcode(reader->database);
    if (code == SQLITE_NOMEM)
        return tn_fail_memory(error);
    bool damaged = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR;
    bool opening = reader->line == 0; /* later the error has a line, and so a file */
    return tn_fail(error, damaged ? TN_INVALID : TN_IO, damaged ? E_PLAN_FILE : E_CANNOT_READ, "%s%s%s",
                   opening ? reader->path : "", opening ? ": " : "", sqlite3_errmsg(reader->database));
}

/* Was the library made with this schema? A library without metadata is read by its plan lines. */
static tn_status check_schema(tn_plan_reader *reader, tn_error *error)
{
    sqlite3_stmt *row = NULL;
    char expected[24];
    sqlite3_snprintf(sizeof expected, expected, "%016llx", (unsigned long long)tn_pack_schema_hash(reader->schema));
    int code =
        sqlite3_prepare_v2(reader->database, "SELECT value FROM metadata WHERE key = 'schema_hash'", -1, &row, NULL);
    if (code == SQLITE_OK && sqlite3_step(row) == SQLITE_ROW) {
        const char *found = (const char *)sqlite3_column_text(row, 0);
        reader->packed = found && strcmp(found, expected) == 0;
    }
    sqlite3_finalize(row);
    return code == SQLITE_NOMEM ? tn_fail_memory(error) : TN_OK;
}

/* From here on SQLite's locks keep other programs that use it from changing the file: a change is somebody's who writes
 * over it. Where changes are logged beside the file (WAL), it changes by the way, and only SQLite can tell. */
static tn_status begin_reading(tn_plan_reader *reader, tn_error *error)
{
    sqlite3_stmt *row = NULL;
    if (sqlite3_exec(reader->database, "BEGIN; SELECT 1 FROM sqlite_master", NULL, NULL, NULL) != SQLITE_OK)
        return failed(reader, error);
    int code = sqlite3_prepare_v2(reader->database, "PRAGMA journal_mode", -1, &row, NULL);
    bool told = code == SQLITE_OK && sqlite3_step(row) == SQLITE_ROW;
    const char *mode = told ? (const char *)sqlite3_column_text(row, 0) : NULL;
    bool logged = !mode || strcmp(mode, "wal") == 0;
    sqlite3_finalize(row);
    reader->opened = logged ? (tn_file_state){0} : tn_file_state_of(reader->file);
    return code == SQLITE_NOMEM ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_reader_sqlite_open(tn_plan_reader *reader, tn_error *error)
{
    if (reader->file == STDIN_FILENO)
        return tn_fail(error, TN_INVALID, E_PLAN_FILE,
                       "a SQLite library cannot be read from standard input: name its file");
    /* The file stays open until the database is closed: closing it would give up SQLite's locks.
     * Opened for writing where that is allowed, as SQLite must roll back what a killed writer left half done. */
    if (sqlite3_open_v2(reader->path, &reader->database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_PRIVATECACHE, NULL) !=
        SQLITE_OK)
        return reader->database ? failed(reader, error) : tn_fail_memory(error);
    sqlite3_busy_timeout(reader->database, 10000);
    sqlite3_db_config(reader->database, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    sqlite3_db_config(reader->database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    sqlite3_db_config(reader->database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
    sqlite3_limit(reader->database, SQLITE_LIMIT_LENGTH,
                  (int)(reader->max_line < 1u << 30 ? reader->max_line + 4096 : 1u << 30));
    if (sqlite3_exec(reader->database, "PRAGMA query_only = 1; PRAGMA cell_size_check = 1", NULL, NULL, NULL) !=
        SQLITE_OK)
        return failed(reader, error);
    tn_status status = begin_reading(reader, error);
    if (status == TN_OK)
        status = check_schema(reader, error);
    if (status != TN_OK)
        return status;
    const char *select = "SELECT rank, plan, packed FROM plans ORDER BY number";
    if (sqlite3_prepare_v2(reader->database, select, -1, &reader->rows, NULL) != SQLITE_OK) {
        status = failed(reader, error);
        tn_error_help(error, "a plan library has a table plans(number, rank, plan, packed, ...)");
        return status;
    }
    return TN_OK;
}

static tn_status read_packed(tn_plan_reader *reader, tn_error *error)
{
    const uint8_t *bytes = sqlite3_column_blob(reader->rows, 2);
    size_t size = (size_t)sqlite3_column_bytes(reader->rows, 2);
    unsigned tray_bytes = tn_pack_tray_bytes(reader->schema);
    size_t length = size / tray_bytes;
    if (length > reader->max_length)
        return tn_reader_too_long(reader, length, error);
    if (!tn_plan_reserve(&reader->plan, length))
        return tn_fail_memory(error);
    reader->plan.length = length;
    if (size % tray_bytes != 0 || !tn_unpack_trays(reader->schema, bytes, length, reader->plan.trays))
        return tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "the packed plan holds a tray that the schema does not have");
    return TN_OK;
}

tn_status tn_reader_sqlite_next(tn_plan_reader *reader, bool *found, tn_error *error)
{
    int code = sqlite3_step(reader->rows);
    *found = code == SQLITE_ROW;
    if (code != SQLITE_ROW && tn_plan_reader_unchanged(reader, error) != TN_OK)
        return TN_IO;
    if (code == SQLITE_DONE)
        return TN_OK;
    if (code != SQLITE_ROW)
        return failed(reader, error);
    reader->line++;
    const char *rank = (const char *)sqlite3_column_text(reader->rows, 0);
    if (rank && !tn_buffer_append(&reader->rank, rank, strlen(rank)))
        return tn_fail_memory(error);
    if (reader->packed)
        return read_packed(reader, error);
    const char *plan = (const char *)sqlite3_column_text(reader->rows, 1);
    return tn_plan_scan_line(reader->scanner, plan ? plan : "", (size_t)sqlite3_column_bytes(reader->rows, 1),
                             reader->max_length, &reader->plan, error);
}

void tn_reader_sqlite_close(tn_plan_reader *reader)
{
    sqlite3_finalize(reader->rows);
    sqlite3_close(reader->database);
}
