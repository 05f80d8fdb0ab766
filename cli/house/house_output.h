/* Writes ranked houses as the options say: house lines, JSON, CSV, or a SQLite library. Internal to cli/house. */
#ifndef TARTAN_CLI_HOUSE_HOUSE_OUTPUT_H
#define TARTAN_CLI_HOUSE_HOUSE_OUTPUT_H

#include "cli/common/row_output.h"
#include "cli/house/houses.h"

typedef struct tn_house_rows {
    const tn_numbered *n;
    tn_plan_writer *writer;
    tn_buffer line, members;
    bool json;
} tn_house_rows;

/* Opens the output. `made`: the command, in words that decide the result. False where that failed. */
bool tn_house_rows_open(tn_house_rows *w, const tn_numbered *n, const tn_written_settings *settings, const char *made);

/* Writes a house: its rank in what is written, and its number among the houses on its plan. */
tn_status tn_house_rows_write(tn_house_rows *w, const tn_house *house, const mpz_t rank, const mpz_t variant,
                              tn_error *error);

/* Finishes the file as tn_job_rows_close does, unless it has been closed, and frees what the writer holds. */
void tn_house_rows_close(tn_house_rows *w);

#endif
