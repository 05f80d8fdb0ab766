/* The calls that read and write plan libraries in a database. They lie in runtime/plan/store, which programs that want
 * only text need not have; whoever opens a reader or writer hands them over.
 */
#ifndef TARTAN_PLAN_TEXT_DATABASE_H
#define TARTAN_PLAN_TEXT_DATABASE_H

#include "runtime/plan/text/stream.h"

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
};

#endif
