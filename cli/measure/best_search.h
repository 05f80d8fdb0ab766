/* The best plans of a library by measures, one after the other: for `best` and `draw --best`. */
#ifndef TARTAN_CLI_MEASURE_BEST_SEARCH_H
#define TARTAN_CLI_MEASURE_BEST_SEARCH_H

#include "cli/measure/wishes.h"
#include "cli/plan/sheet.h"
#include "runtime/plan/measure/best.h"

typedef struct tn_best_search {
    tn_job *job;
    const tn_ready_library *ready;
    tn_wishes wishes;
    tn_weighed *weighed;
    tn_best *best;
} tn_best_search;

/* A plan that was found. All is borrowed until the next. */
typedef struct tn_best_plan {
    const tn_tray *trays;
    uint32_t length;
    const int64_t *values; /* of each wish, in steps */
    mpz_srcptr rank;
} tn_best_plan;

typedef tn_status tn_best_take(void *to, const tn_best_plan *plan, tn_error *error);

/* `wanted` holds the wishes (--least, --most, --then-least, --then-most). False where it failed: then reported. Close
 * in any case. Borrows the job and the library. */
bool tn_best_search_open(tn_best_search *search, tn_job *job, const tn_ready_library *ready,
                         const tn_option_list *wanted);
void tn_best_search_close(tn_best_search *search);

/* Gives the next `count` plans, best first, fewer where the library ends; with `mirror`, a plan whose mirror image is
 * kept and of lower rank is left out. A failure is reported to the job. */
void tn_best_search_give(tn_best_search *search, uint64_t count, bool mirror, tn_best_take *take, void *to);

/* The same onto a sheet, with their places and values as captions. */
void tn_best_search_sheet(tn_best_search *search, uint64_t count, bool mirror, tn_plan_sheet *sheet);

/* "the 10 of 5,000 plans with the least cost, then the most area": false without memory. */
bool tn_best_search_aim(const tn_best_search *search, size_t count, char *note, size_t size);

#endif
