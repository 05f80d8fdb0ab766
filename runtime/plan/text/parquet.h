/* The calls that read and write plans in Parquet. They lie in driver/parquet, which programs that want only text
 * need not have; whoever opens a reader or writer hands them over.
 */
#ifndef TARTAN_PLAN_TEXT_PARQUET_H
#define TARTAN_PLAN_TEXT_PARQUET_H

#include "runtime/plan/text/stream.h"

struct tn_plan_parquet {
    /* Reads what the reader's file, which is open, says of its columns. What it opened before it failed, close_reader
     * closes. */
    tn_status (*open_reader)(tn_plan_reader *reader, tn_error *error);
    tn_status (*next)(tn_plan_reader *reader, bool *found, tn_error *error);
    void (*close_reader)(tn_plan_reader *reader);
    tn_plan_part (*groups)(const tn_plan_reader *reader);                 /* all row groups */
    uint64_t (*count)(const tn_plan_reader *reader, tn_plan_part groups); /* plans in some of them */
    void (*restrict_to)(tn_plan_reader *reader, tn_plan_part groups);     /* before a plan is read */

    /* Begins the writer's file, which is open. */
    tn_status (*open_writer)(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error);
    tn_status (*write)(tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length, tn_error *error);
    tn_status (*close_writer)(tn_plan_writer *writer, tn_error *error); /* writes what is left, and the footer */
    void (*free_writer)(tn_plan_writer *writer);
};

#endif
