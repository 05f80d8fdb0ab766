/* Writes the plans or houses that a question finds, one after another, as the options say. */
#ifndef TARTAN_CLI_PLAN_FOUND_ROWS_H
#define TARTAN_CLI_PLAN_FOUND_ROWS_H

#include "ask/plan/found.h"
#include "cli/common/row_output.h"
#include "cli/plan/library_job.h"

typedef struct tn_found_rows {
    tn_job *job;
    const tn_written_settings *settings;
    const char *made;      /* the command, in words that decide the result */
    bool sample;           /* a part of it is not one: that is said if an interrupt leaves a part in a database */
    bool enumerates;       /* progress is shown, and if it is interrupted, how to go on is said */
    bool all_ranks;        /* each rank up to the last is written */
    tn_option_number most; /* that are written; or not given */

    tn_taker taker;
    tn_found_of of;
    tn_plan_writer *writer;  /* NULL: it has not begun, or is closed */
    mpz_t first, next;       /* ranks: the first of all, before anything was resumed, and the next */
    uint64_t written;        /* those resumed included */
    tn_buffer line, members; /* of a house */
    tn_progress progress;
} tn_found_rows;

/* The job's session is to give what it finds to these rows. End them in any case. */
void tn_found_rows_begin(tn_found_rows *rows, tn_job *job, const tn_written_settings *settings, const char *made);

/* Takes note of what the question came to, and finishes the file as tn_job_rows_close does. */
void tn_found_rows_end(tn_found_rows *rows, tn_status status);

#endif
