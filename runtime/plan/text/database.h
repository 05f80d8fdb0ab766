/* The calls that read and write plan libraries in a database. They lie in runtime/plan/store, which programs that want
 * only text need not have; whoever opens a reader or writer hands them over.
 */
#ifndef TARTAN_PLAN_TEXT_DATABASE_H
#define TARTAN_PLAN_TEXT_DATABASE_H

#include "runtime/plan/text/stream.h"

/* Tables of any columns, such as those of houses. type: of SQLite's: "TEXT", "INTEGER", "REAL". */
typedef struct tn_stored_column {
    const char *name, *type;
} tn_stored_column;

typedef struct tn_stored_table {
    const char *name;
    const tn_stored_column *columns;
    size_t count;
} tn_stored_table;

/* Such tables under way in a file. It is as it was until they are closed, all at once. */
typedef struct tn_stored_tables tn_stored_tables;

struct tn_plan_database {
    /* Opens the database at the reader's path. What it opened before it failed, close_reader closes. */
    tn_status (*open_reader)(tn_plan_reader *reader, tn_error *error);
    tn_status (*next)(tn_plan_reader *reader, bool *found, tn_error *error);
    void (*close_reader)(tn_plan_reader *reader);

    /* The same for a writer. */
    tn_status (*open_writer)(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error);
    tn_status (*write)(tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_error *error);
    tn_status (*close_writer)(tn_plan_writer *writer, tn_error *error);
    void (*free_writer)(tn_plan_writer *writer);

    /* Begins tables in a file that is not there or is a library of ours, whose tables go. All is borrowed while it is
     * opened. metadata: names and values, as many as there are. free_tables in any case. */
    tn_status (*open_tables)(const char *path, const tn_stored_table *tables, size_t count,
                             const char *const (*metadata)[2], size_t metadata_count, tn_stored_tables **file,
                             tn_error *error);
    /* A text for each column, NULL where there is no value. */
    tn_status (*add_row)(tn_stored_tables *file, size_t table, const char *const *cells, tn_error *error);
    tn_status (*close_tables)(tn_stored_tables *file, tn_error *error);
    void (*free_tables)(tn_stored_tables *file);
};

#endif
