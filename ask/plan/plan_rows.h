/* Rows of plans, for questions about a library whose schema is of another one: each tray of a row with the plan that
 * stands there.
 *
 *   12m corner sunny [3m shop | 4m home | 5m home] | 7m - shady [3m home | 4m home]
 *
 * A row of plans is a tray and its plan in brackets, and so on. Ranks go by rows of trays, then by plans
 * (runtime/plan/library/plan_rows.h). */
#ifndef TARTAN_ASK_PLAN_PLAN_ROWS_H
#define TARTAN_ASK_PLAN_PLAN_ROWS_H

#include "ask/plan/found.h"
#include "runtime/plan/library/plan_rows.h"
#include "runtime/plan/measure/standing_plans.h"

typedef struct tn_rows_of_plans {
    tn_session *session;
    const tn_ready_library *ready; /* borrowed */
    size_t longest;                /* plan that is read */
    tn_ready_library below;        /* whose plans stand there */
    tn_plan_rows *rows;
    tn_standing_plans *plans;
    /* The row that was found or read last. */
    tn_tray *trays; /* room for the longest row */
    uint32_t length;
    mpz_t *numbers;  /* of each tray's plan among those that the tray stands for */
    tn_tray *stands; /* room for the longest plan */
} tn_rows_of_plans;

/* Makes ready. What is wrong is said: also where trays of the library stand for no plans. Close it in any case. */
tn_status tn_rows_open(tn_rows_of_plans *rows, tn_session *session, const tn_ready_library *ready,
                       const tn_library_asked *asked);
void tn_rows_close(tn_rows_of_plans *rows);

/* Says that rows of plans are not asked about together with that: "houses", "--ways". Returns TN_INVALID. */
tn_status tn_rows_refuse_with(tn_session *session, const char *other);

/* Finds the row of a rank. false: there are no so many. */
bool tn_rows_find(tn_rows_of_plans *rows, const mpz_t rank);

/* The row found last as answers have it, to be freed, also after a failure: its line, and the members of JSON that
 * plan_members says. */
tn_status tn_rows_texts(tn_rows_of_plans *rows, char **line, char **members, tn_error *error);

/* Gives the row of a rank, which is there, to what a question finds. */
tn_status tn_rows_give(tn_rows_of_plans *rows, const mpz_t rank, tn_finds *finds, tn_error *error);

/* Reads a row of plans, whose trays stand for them. What is wrong is said. */
tn_status tn_rows_read(tn_rows_of_plans *rows, const char *text);

/* Says that the library has no row of plans of that rank, and how many it has. Returns TN_INVALID. */
tn_status tn_rows_no_rank(const tn_rows_of_plans *rows, const char *rank);

#endif
