/* The best plans of a library on a sheet: for `best` and `draw --best`. */
#ifndef TARTAN_CLI_MEASURE_BEST_SHEET_H
#define TARTAN_CLI_MEASURE_BEST_SHEET_H

#include "cli/measure/wishes.h"
#include "cli/plan/sheet.h"

typedef struct tn_best_sheet {
    tn_job *job;
    const tn_ready_library *ready; /* the session's */
    tn_wishes wishes;
    tn_plan_sheet drawn; /* with their places and values as captions */
} tn_best_sheet;

/* False if it failed, which is reported. Clear what is drawn in any case. */
bool tn_job_best_sheet(tn_job *job, const tn_best_request *request, tn_best_sheet *sheet);

/* "the 10 of 5,000 plans with the least cost, then the most area": false without memory. */
bool tn_best_sheet_aim(const tn_best_sheet *sheet, char *note, size_t size);

#endif
