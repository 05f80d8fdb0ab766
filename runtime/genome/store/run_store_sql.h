/* What writing (run_store.c) and reading (run_store_read.c) a run's database share. Of no use elsewhere. */
#ifndef TARTAN_GENOME_STORE_RUN_STORE_SQL_H
#define TARTAN_GENOME_STORE_RUN_STORE_SQL_H

#include <sqlite3.h>
#include <string.h>

#include "runtime/genome/store/run_store.h"

struct tn_run_store {
    sqlite3 *db;
    sqlite3_stmt *put_birth, *put_generation, *put_event, *put_rescore;
};

static inline tn_status wrong(tn_run_store *store, tn_error *error)
{
    int code = sqlite3_errcode(store->db);
    if (code == SQLITE_NOMEM)
        return tn_fail_memory(error);
    if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
        return tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database is damaged: %s",
                       sqlite3_errmsg(store->db));
    return tn_fail(error, TN_IO, E_CANNOT_WRITE, "the run's database: %s", sqlite3_errmsg(store->db));
}

static inline tn_status run(tn_run_store *store, const char *sql, tn_error *error)
{
    return sqlite3_exec(store->db, sql, NULL, NULL, NULL) == SQLITE_OK ? TN_OK : wrong(store, error);
}

static inline tn_status prepare(tn_run_store *store, const char *sql, sqlite3_stmt **statement, tn_error *error)
{
    return sqlite3_prepare_v2(store->db, sql, -1, statement, NULL) == SQLITE_OK ? TN_OK : wrong(store, error);
}

/* Runs a statement that gives no rows, and makes it ready for the next time. */
static inline tn_status finish_step(tn_run_store *store, sqlite3_stmt *statement, tn_error *error)
{
    bool done = sqlite3_step(statement) == SQLITE_DONE;
    tn_status status = done ? TN_OK : wrong(store, error);
    sqlite3_reset(statement);
    return status;
}

/* One number that a query gives. */
static inline tn_status query_number(tn_run_store *store, const char *sql, int64_t *value, tn_error *error)
{
    sqlite3_stmt *statement = NULL;
    tn_status status = prepare(store, sql, &statement, error);
    if (status == TN_OK) {
        if (sqlite3_step(statement) == SQLITE_ROW)
            *value = sqlite3_column_int64(statement, 0);
        else
            status = wrong(store, error);
    }
    sqlite3_finalize(statement);
    return status;
}

static inline char *copy_column(sqlite3_stmt *statement, int column)
{
    const char *text = (const char *)sqlite3_column_text(statement, column);
    return strdup(text ? text : "");
}

#endif
