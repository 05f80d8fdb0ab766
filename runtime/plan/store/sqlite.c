/* The calls by which plan libraries in SQLite are read and written. */
#include "runtime/plan/store/sqlite.h"

#include "runtime/plan/store/sqlite_data.h"

const tn_plan_database *tn_plan_sqlite(void)
{
    static const tn_plan_database calls = {
        .open_reader = tn_reader_sqlite_open,
        .next = tn_reader_sqlite_next,
        .close_reader = tn_reader_sqlite_close,
        .open_writer = tn_writer_sqlite_open,
        .write = tn_writer_sqlite_write,
        .close_writer = tn_writer_sqlite_close,
        .free_writer = tn_writer_sqlite_free,
    };
    return &calls;
}
