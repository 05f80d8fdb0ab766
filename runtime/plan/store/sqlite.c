/* Plan libraries in SQLite: read, written, and their table of trays for questions in SQL. */
#include "runtime/plan/store/sqlite.h"

#include <errno.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "runtime/base/file.h"
#include "runtime/plan/store/tables.h"
#include "runtime/plan/text/database.h"
#include "runtime/plan/text/pack.h"
#include "runtime/plan/text/reader.h"
#include "runtime/plan/text/writer.h"

static void writer_sqlite_free(tn_plan_writer *writer); /* rolls back the batch in hand */

static bool trays_insert(tn_plan_writer *writer, const tn_tray *trays, size_t length); /* of plan writer->number */

static tn_status trays_create(tn_plan_writer *writer, tn_error *error);
static tn_status trays_prepare(tn_plan_writer *writer, tn_error *error);
static tn_status trays_index(tn_plan_writer *writer, tn_error *error);

/* ---- reading */

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

static tn_status reader_sqlite_open(tn_plan_reader *reader, tn_error *error)
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

static tn_status reader_sqlite_next(tn_plan_reader *reader, bool *found, tn_error *error)
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

static void reader_sqlite_close(tn_plan_reader *reader)
{
    sqlite3_finalize(reader->rows);
    sqlite3_close(reader->database);
}

/* ---- writing: a table, and what there is beside it */

/* Where a file cannot be made, SQLite looks for one to read, and keeps the reason why there is none: asked again. */
static int why_not_opened(const tn_plan_writer *writer)
{
    int file = open(writer->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
        return errno;
    close(file);
    return sqlite3_system_errno(writer->database);
}

/* What went wrong with the database last, as an error. */
static tn_status writer_sqlite_failed(const tn_plan_writer *writer, tn_error *error)
{
    int code = writer->database ? sqlite3_errcode(writer->database) : SQLITE_NOMEM;
    if (code == SQLITE_NOMEM)
        return tn_fail_memory(error);
    if (code == SQLITE_CONSTRAINT) {
        tn_fail(error, TN_INVALID, E_PLAN_RESUME, "%s: the library holds such a plan already", writer->path);
        tn_error_help(error, "somebody else may be writing to it");
        return TN_INVALID;
    }
    int reason = code == SQLITE_FULL ? ENOSPC : code == SQLITE_READONLY ? EACCES : 0;
    if (code == SQLITE_CANTOPEN)
        reason = why_not_opened(writer);
    if (reason)
        return tn_cannot_write(writer->path, reason, error);
    return tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %s: %s", writer->path, sqlite3_errmsg(writer->database));
}

static tn_status run(tn_plan_writer *writer, const char *sql, tn_error *error)
{
    return sqlite3_exec(writer->database, sql, NULL, NULL, NULL) == SQLITE_OK ? TN_OK
                                                                              : writer_sqlite_failed(writer, error);
}

/* Runs a statement made with sqlite3_mprintf, and frees it; NULL: out of memory. */
static tn_status writer_sqlite_run(tn_plan_writer *writer, char *sql, tn_error *error)
{
    if (!sql)
        return tn_fail_memory(error);
    tn_status status = run(writer, sql, error);
    sqlite3_free(sql);
    return status;
}

/* ---- a new library */

/* What the rows are in: plans, or what the options name. */
static const char *table_of(const tn_plan_writer *writer)
{
    return writer->rows ? writer->rows->table : "plans";
}

static tn_status create_tables(tn_plan_writer *writer, tn_error *error)
{
    const tn_schema *schema = writer->schema;
    sqlite3_str *sql = sqlite3_str_new(writer->database);
    sqlite3_str_appendf(sql,
                        "PRAGMA application_id = %d;"
                        "CREATE TABLE metadata (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
                        "CREATE TABLE %s (number INTEGER PRIMARY KEY, rank TEXT NOT NULL, length INTEGER NOT NULL, ",
                        TN_LIBRARY_APPLICATION_ID, table_of(writer));
    if (writer->length_field != UINT32_MAX)
        sqlite3_str_appendf(sql, "\"%w_total\" INTEGER NOT NULL, ",
                            tn_text(schema->module, schema->fields[writer->length_field].name));
    sqlite3_str_appendall(sql, "plan TEXT NOT NULL, packed BLOB NOT NULL");
    for (size_t i = 0; i < tn_writer_texts(writer); i++)
        sqlite3_str_appendf(sql, ", %s TEXT NOT NULL", writer->rows->names[i]);
    sqlite3_str_appendall(sql, ");");
    tn_status status = writer_sqlite_run(writer, sqlite3_str_finish(sql), error);
    return status == TN_OK && writer->columns ? trays_create(writer, error) : status;
}

static tn_status set_metadata(tn_plan_writer *writer, const char *key, const char *value, tn_error *error)
{
    return writer_sqlite_run(writer, sqlite3_mprintf("INSERT OR REPLACE INTO metadata VALUES (%Q, %Q)", key, value),
                             error);
}

/* Makes the tables of a new library, in place of those that are there: within one transaction, so that whoever reads it
 * sees the old library or the new one. A library that is there is replaced with the first batch, not before. */
static tn_status create(tn_plan_writer *writer, const tn_plan_metadata *metadata, bool is_new, tn_error *error)
{
    tn_metadata_room room;
    tn_metadata_item items[TN_METADATA_ITEMS];
    tn_writer_metadata(writer, metadata, &room, items);
    tn_status status = run(writer,
                           "BEGIN IMMEDIATE; DROP TABLE IF EXISTS trays; DROP TABLE IF EXISTS plans; "
                           "DROP TABLE IF EXISTS houses; DROP TABLE IF EXISTS rooms; DROP TABLE IF EXISTS faces; "
                           "DROP TABLE IF EXISTS metadata",
                           error);
    if (status == TN_OK)
        status = create_tables(writer, error);
    for (size_t i = 0; status == TN_OK && i < TN_METADATA_ITEMS; i++) {
        if (items[i].value)
            status = set_metadata(writer, items[i].key, items[i].value, error);
    }
    if (status == TN_OK)
        status = set_metadata(writer, "complete", "0", error);
    writer->replaces = writer->had_library = !is_new;
    return status == TN_OK && is_new ? run(writer, "COMMIT", error) : status;
}

/* Begins a batch; the first may belong to what is begun already. */
static tn_status begin_batch(tn_plan_writer *writer, tn_error *error)
{
    return writer->replaces ? TN_OK : run(writer, "BEGIN IMMEDIATE", error);
}

static tn_status end_batch(tn_plan_writer *writer, tn_error *error)
{
    tn_status status = run(writer, "COMMIT", error);
    writer->replaces = writer->replaces && status != TN_OK;
    return status;
}

/* ---- a library that is there */

/* The text of the one value that a query gives, or NULL where it gives none; the caller frees it. */
static tn_status query_text(tn_plan_writer *writer, const char *sql, char **text, tn_error *error)
{
    sqlite3_stmt *row = NULL;
    *text = NULL;
    int code = sqlite3_prepare_v2(writer->database, sql, -1, &row, NULL);
    if (code == SQLITE_OK && (code = sqlite3_step(row)) == SQLITE_ROW) {
        const char *found = (const char *)sqlite3_column_text(row, 0);
        *text = found ? strdup(found) : NULL;
        code = found && !*text ? SQLITE_NOMEM : code;
    }
    sqlite3_finalize(row);
    return code == SQLITE_NOMEM ? tn_fail_memory(error) : TN_OK;
}

/* Is there nothing in the file yet? Refuses what is there and is no library of ours, so that no other file is written
 * over. */
static tn_status look(tn_plan_writer *writer, bool *is_new, tn_error *error)
{
    char *pages = NULL, *id = NULL;
    tn_status status = query_text(writer, "PRAGMA page_count", &pages, error);
    if (status == TN_OK)
        status = query_text(writer, "PRAGMA application_id", &id, error);
    *is_new = pages && strcmp(pages, "0") == 0;
    bool is_library = id && strtol(id, NULL, 10) == TN_LIBRARY_APPLICATION_ID;
    free(pages);
    free(id);
    if (status != TN_OK || *is_new || is_library)
        return status;
    tn_fail(error, TN_IO, E_CANNOT_WRITE, "%s: the file exists already, and it is not a plan library", writer->path);
    tn_error_help(error, "name another file, or remove this one");
    return TN_IO;
}

/* One member of the metadata must be as it was. */
static tn_status check_item(tn_plan_writer *writer, const tn_metadata_item *item, tn_error *error)
{
    char sql[80], *found;
    sqlite3_snprintf(sizeof sql, sql, "SELECT value FROM metadata WHERE key = '%s'", item->key);
    tn_status status = query_text(writer, sql, &found, error);
    bool same = strcmp(found ? found : "", item->value ? item->value : "") == 0;
    if (status == TN_OK && !same) {
        status = tn_fail(error, TN_INVALID, E_PLAN_RESUME, "%s: its %s is %.100s, and now it would be %.100s",
                         writer->path, item->key, found ? found : "not known", item->value ? item->value : "none");
        tn_error_help(
            error,
            "an interrupted library is continued with the same rules and the same command; leave out --resume to start "
            "anew");
    }
    free(found);
    return status;
}

/* Everything that decides which plans come. */
static tn_status check_metadata(tn_plan_writer *writer, const tn_plan_metadata *metadata, tn_error *error)
{
    static const char *const decisive[] = {"library_hash", "schema_hash", "command", "params"};
    tn_metadata_room room;
    tn_metadata_item items[TN_METADATA_ITEMS];
    tn_writer_metadata(writer, metadata, &room, items);
    tn_status status = TN_OK;
    for (size_t i = 0; i < TN_METADATA_ITEMS; i++) {
        for (size_t k = 0; k < sizeof decisive / sizeof *decisive; k++) {
            if (status == TN_OK && strcmp(items[i].key, decisive[k]) == 0)
                status = check_item(writer, &items[i], error);
        }
    }
    return status;
}

static tn_status find_last(tn_plan_writer *writer, tn_error *error)
{
    sqlite3_stmt *row = NULL;
    char sql[96];
    sqlite3_snprintf(sizeof sql, sql, "SELECT number, rank FROM %s ORDER BY number DESC LIMIT 1", table_of(writer));
    int code = sqlite3_prepare_v2(writer->database, sql, -1, &row, NULL);
    tn_status status = TN_OK;
    if (code == SQLITE_OK && (code = sqlite3_step(row)) == SQLITE_ROW) {
        const char *rank = (const char *)sqlite3_column_text(row, 1);
        writer->number = (uint64_t)sqlite3_column_int64(row, 0);
        if (!rank || !*rank || strspn(rank, "0123456789") != strlen(rank))
            status = tn_fail(error, TN_INVALID, E_PLAN_RESUME, "%s: its last plan has no rank", writer->path);
        else if (!tn_buffer_append(&writer->last_rank, rank, strlen(rank)))
            status = tn_fail_memory(error);
        writer->resumed = writer->number;
    } else if (code != SQLITE_DONE) {
        status = writer_sqlite_failed(writer, error);
    }
    sqlite3_finalize(row);
    return status;
}

static tn_status resume(tn_plan_writer *writer, const tn_plan_metadata *metadata, tn_error *error)
{
    tn_status status = check_metadata(writer, metadata, error);
    return status == TN_OK ? find_last(writer, error) : status;
}

/* ---- opening */

static tn_status open_database(tn_plan_writer *writer, tn_error *error)
{
    int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_PRIVATECACHE | SQLITE_OPEN_NOMUTEX;
    if (sqlite3_open_v2(writer->path, &writer->database, flags, NULL) != SQLITE_OK)
        return writer_sqlite_failed(writer, error);
    sqlite3_busy_timeout(writer->database, TN_LIBRARY_BUSY_MILLISECONDS);
    sqlite3_db_config(writer->database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    return run(writer, "PRAGMA cell_size_check = 1", error);
}

/* A statement that inserts so many plans. */
static tn_status prepare_insert(tn_plan_writer *writer, size_t plans, sqlite3_stmt **insert, tn_error *error)
{
    size_t columns = (writer->length_field != UINT32_MAX ? 6 : 5) + tn_writer_texts(writer);
    sqlite3_str *sql = sqlite3_str_new(writer->database);
    sqlite3_str_appendf(sql, "INSERT INTO %s VALUES ", table_of(writer));
    for (size_t i = 0; i < plans; i++) {
        sqlite3_str_appendall(sql, i ? ",(?" : "(?");
        for (size_t k = 1; k < columns; k++)
            sqlite3_str_appendall(sql, ",?");
        sqlite3_str_appendall(sql, ")");
    }
    char *text = sqlite3_str_finish(sql);
    if (!text)
        return tn_fail_memory(error);
    int code = sqlite3_prepare_v2(writer->database, text, -1, insert, NULL);
    sqlite3_free(text);
    return code == SQLITE_OK ? TN_OK : writer_sqlite_failed(writer, error);
}

static tn_status prepare_inserts(tn_plan_writer *writer, tn_error *error)
{
    tn_status status = prepare_insert(writer, 1, &writer->insert_one, error);
    if (status == TN_OK)
        status = prepare_insert(writer, TN_WAITING_MAX, &writer->insert_waiting, error);
    return status == TN_OK && writer->columns ? trays_prepare(writer, error) : status;
}

static tn_status writer_sqlite_open(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error)
{
    if (strcmp(writer->path, "-") == 0)
        return tn_fail(error, TN_INVALID, E_USAGE,
                       "a SQLite library cannot be written to standard output: name a file");
    tn_status status = open_database(writer, error);
    bool is_new = false;
    if (status == TN_OK)
        status = look(writer, &is_new, error);
    if (status == TN_OK && options->resume && !is_new)
        status = resume(writer, &options->metadata, error);
    else if (status == TN_OK)
        status = create(writer, &options->metadata, is_new, error);
    return status == TN_OK ? prepare_inserts(writer, error) : status;
}

/* ---- writing
 *
 * A statement has a price of its own, whatever it inserts: plans wait for one another and go in so many a statement. */

/* Adds the plan to those that wait. */
static bool make_plan(tn_plan_writer *writer, const char *rank, const tn_plan_row *row)
{
    const tn_tray *trays = row->trays;
    size_t length = row->length;
    tn_waiting_plan *plan = &writer->waiting[writer->waiting_count++];
    plan->rank = writer->text.size;
    bool done = tn_buffer_append(&writer->text, rank, strlen(rank));
    plan->text = writer->text.size;
    done = done && tn_writer_line(writer, trays, length, &writer->text);
    plan->text_end = writer->text.size;
    for (size_t i = 0; done && i < tn_writer_texts(writer); i++) {
        done = tn_buffer_append(&writer->text, row->texts[i], strlen(row->texts[i]));
        plan->row_end[i] = writer->text.size;
    }
    plan->packed = writer->packed.size;
    done = done && tn_buffer_append(&writer->packed, "", 0); /* no bytes, and not NULL: the plan without trays */
    done = done && tn_pack_trays(writer->schema, trays, length, &writer->packed);
    plan->packed_end = writer->packed.size;
    plan->length = length;
    plan->total = writer->length_field != UINT32_MAX ? tn_writer_total(writer, trays, length) : 0;
    plan->number = ++writer->number;
    return done;
}

static void bind_plan(const tn_plan_writer *writer, sqlite3_stmt *insert, const tn_waiting_plan *plan, int *column)
{
    const char *text = writer->text.data, *packed = writer->packed.data;
    sqlite3_bind_int64(insert, ++*column, (sqlite3_int64)plan->number);
    sqlite3_bind_text(insert, ++*column, text + plan->rank, (int)(plan->text - plan->rank), SQLITE_STATIC);
    sqlite3_bind_int64(insert, ++*column, (sqlite3_int64)plan->length);
    if (writer->length_field != UINT32_MAX)
        sqlite3_bind_int64(insert, ++*column, plan->total);
    sqlite3_bind_text(insert, ++*column, text + plan->text, (int)(plan->text_end - plan->text), SQLITE_STATIC);
    sqlite3_bind_blob(insert, ++*column, packed + plan->packed, (int)(plan->packed_end - plan->packed), SQLITE_STATIC);
    size_t begin = plan->text_end;
    for (size_t i = 0; i < tn_writer_texts(writer); begin = plan->row_end[i++])
        sqlite3_bind_text(insert, ++*column, text + begin, (int)(plan->row_end[i] - begin), SQLITE_STATIC);
}

/* Inserts the plans that wait. */
static tn_status flush(tn_plan_writer *writer, tn_error *error)
{
    bool full = writer->waiting_count == TN_WAITING_MAX;
    sqlite3_stmt *insert = full ? writer->insert_waiting : writer->insert_one;
    int column = 0;
    for (size_t i = 0; i < writer->waiting_count; i++) {
        bind_plan(writer, insert, &writer->waiting[i], &column);
        if (full && i + 1 < TN_WAITING_MAX)
            continue;
        int code = sqlite3_step(insert);
        sqlite3_reset(insert);
        if (code != SQLITE_DONE)
            return writer_sqlite_failed(writer, error);
        column = 0;
    }
    writer->waiting_count = writer->text.size = writer->packed.size = 0;
    return TN_OK;
}

static tn_status writer_sqlite_write(tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_error *error)
{
    tn_status status = writer->in_batch == 0 ? begin_batch(writer, error) : TN_OK;
    if (status != TN_OK)
        return status;
    if (!make_plan(writer, rank, row))
        return tn_fail_memory(error);
    if (writer->columns && !trays_insert(writer, row->trays, row->length))
        return writer_sqlite_failed(writer, error);
    bool batch_ends = ++writer->in_batch == writer->batch;
    if (batch_ends || writer->waiting_count == TN_WAITING_MAX)
        status = flush(writer, error);
    if (status != TN_OK || !batch_ends)
        return status;
    writer->in_batch = 0;
    return end_batch(writer, error);
}

static void finalize(tn_plan_writer *writer)
{
    sqlite3_finalize(writer->insert_one);
    sqlite3_finalize(writer->insert_waiting);
    sqlite3_finalize(writer->insert_tray);
    writer->insert_one = writer->insert_waiting = writer->insert_tray = NULL;
}

static tn_status writer_sqlite_close(tn_plan_writer *writer, tn_error *error)
{
    tn_status status = writer->in_batch > 0 ? flush(writer, error) : begin_batch(writer, error);
    writer->in_batch = 0;
    if (status == TN_OK)
        status = writer_sqlite_run(writer,
                                   sqlite3_mprintf("CREATE UNIQUE INDEX IF NOT EXISTS %s_rank ON %s (rank)",
                                                   table_of(writer), table_of(writer)),
                                   error);
    if (status == TN_OK && writer->columns)
        status = trays_index(writer, error);
    if (status == TN_OK)
        status = set_metadata(writer, "complete", "1", error);
    if (status == TN_OK)
        status = end_batch(writer, error);
    finalize(writer);
    if (status == TN_OK && writer->had_library)
        status = run(writer, "VACUUM", error); /* gives back the space of the library that was there */
    if (status == TN_OK && sqlite3_close(writer->database) != SQLITE_OK)
        return writer_sqlite_failed(writer, error);
    if (status == TN_OK)
        writer->database = NULL;
    return status;
}

static void writer_sqlite_free(tn_plan_writer *writer)
{
    finalize(writer);
    sqlite3_close(writer->database);
}

/* ---- the table `trays` of a plan library in SQLite, for questions in SQL */

enum { COLUMNS_MAX = 2 + 2 * TN_FIELDS_MAX, NAME_SIZE = TN_NAME_MAX + 16 };

typedef struct tn_tray_columns {
    char names[COLUMNS_MAX][NAME_SIZE];
    const char *types[COLUMNS_MAX];
    size_t count;
} tn_tray_columns;

static bool is_taken(const tn_tray_columns *columns, const char *name)
{
    for (size_t i = 0; i < columns->count; i++)
        if (strcasecmp(columns->names[i], name) == 0)
            return true;
    return false;
}

static void add_column(tn_tray_columns *columns, const char *name, const char *ending, const char *type)
{
    char *made = columns->names[columns->count];
    snprintf(made, NAME_SIZE, "%s%s", name, ending);
    for (unsigned n = 2; is_taken(columns, made); n++)
        snprintf(made, NAME_SIZE, "%s%s_%u", name, ending, n);
    columns->types[columns->count++] = type;
}

static bool is_measured(const tn_field_record *field)
{
    return field->kind == TN_FIELD_LENGTH || field->kind == TN_FIELD_ZONE;
}

static void find_columns(const tn_schema *schema, tn_tray_columns *columns)
{
    columns->count = 0;
    add_column(columns, "number", "", "INTEGER");
    add_column(columns, "tray", "", "INTEGER");
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const char *name = tn_text(schema->module, schema->fields[f].name);
        add_column(columns, name, "", schema->fields[f].kind == TN_FIELD_FLAG ? "INTEGER" : "TEXT");
        if (is_measured(&schema->fields[f]))
            add_column(columns, name, "_mm", "REAL");
    }
}

static tn_status trays_create(tn_plan_writer *writer, tn_error *error)
{
    tn_tray_columns columns;
    find_columns(writer->schema, &columns);
    sqlite3_str *sql = sqlite3_str_new(writer->database);
    sqlite3_str_appendall(sql, "CREATE TABLE trays (");
    for (size_t i = 0; i < columns.count; i++)
        sqlite3_str_appendf(sql, "\"%w\" %s NOT NULL, ", columns.names[i], columns.types[i]);
    sqlite3_str_appendall(sql, "PRIMARY KEY (number, tray)) WITHOUT ROWID");
    return writer_sqlite_run(writer, sqlite3_str_finish(sql), error);
}

static tn_status trays_prepare(tn_plan_writer *writer, tn_error *error)
{
    tn_tray_columns columns;
    find_columns(writer->schema, &columns);
    sqlite3_str *sql = sqlite3_str_new(writer->database);
    sqlite3_str_appendall(sql, "INSERT INTO trays VALUES (?");
    for (size_t i = 1; i < columns.count; i++)
        sqlite3_str_appendall(sql, ",?");
    sqlite3_str_appendall(sql, ")");
    char *text = sqlite3_str_finish(sql);
    if (!text)
        return tn_fail_memory(error);
    int code = sqlite3_prepare_v2(writer->database, text, -1, &writer->insert_tray, NULL);
    sqlite3_free(text);
    return code == SQLITE_OK ? TN_OK : writer_sqlite_failed(writer, error);
}

static void bind_tray(const tn_plan_writer *writer, tn_tray tray)
{
    const tn_schema *schema = writer->schema;
    sqlite3_stmt *insert = writer->insert_tray;
    int column = 2;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_value_record *value = tn_tray_value_record(schema, tray, f);
        if (schema->fields[f].kind == TN_FIELD_FLAG)
            sqlite3_bind_int(insert, ++column, tn_tray_value(schema, tray, f) != 0);
        else
            sqlite3_bind_text(insert, ++column, tn_text(schema->module, value->name), -1, SQLITE_STATIC);
        if (is_measured(&schema->fields[f]))
            sqlite3_bind_double(insert, ++column, (double)value->length / 1e6); /* nanometres */
    }
}

static bool trays_insert(tn_plan_writer *writer, const tn_tray *trays, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        sqlite3_bind_int64(writer->insert_tray, 1, (sqlite3_int64)writer->number);
        sqlite3_bind_int64(writer->insert_tray, 2, (sqlite3_int64)i + 1);
        bind_tray(writer, trays[i]);
        int code = sqlite3_step(writer->insert_tray);
        sqlite3_reset(writer->insert_tray);
        if (code != SQLITE_DONE)
            return false;
    }
    return true;
}

/* One for each column that a question may begin with. */
static tn_status trays_index(tn_plan_writer *writer, tn_error *error)
{
    tn_tray_columns columns;
    find_columns(writer->schema, &columns);
    tn_status status = TN_OK;
    for (size_t i = 2; status == TN_OK && i < columns.count; i++)
        status = writer_sqlite_run(writer,
                                   sqlite3_mprintf("CREATE INDEX IF NOT EXISTS \"trays_%w\" ON trays (\"%w\")",
                                                   columns.names[i], columns.names[i]),
                                   error);
    return status;
}

const tn_plan_database *tn_plan_sqlite(void)
{
    static const tn_plan_database calls = {
        .open_reader = reader_sqlite_open,
        .next = reader_sqlite_next,
        .close_reader = reader_sqlite_close,
        .open_writer = writer_sqlite_open,
        .write = writer_sqlite_write,
        .close_writer = writer_sqlite_close,
        .free_writer = writer_sqlite_free,
        .open_tables = tn_tables_open,
        .add_row = tn_tables_add,
        .close_tables = tn_tables_close,
        .free_tables = tn_tables_free,
    };
    return &calls;
}
