/* Rows of plans: what the plans of a library stand for whose schema is of another library.
 *
 * A tray of such a schema stands for so many plans of that library, and a row of trays for as many rows of plans as the
 * product. Rows of plans are counted over the library's automaton with the trays' numbers as weights. They are ranked
 * by the row of trays first, then by the plans: the first plan counts most.
 *
 * Immutable once made; borrows the library. */
#ifndef TARTAN_PLAN_LIBRARY_PLAN_ROWS_H
#define TARTAN_PLAN_LIBRARY_PLAN_ROWS_H

#include "runtime/plan/library/library.h"

typedef struct tn_plan_rows tn_plan_rows;

/* Of a library whose trays do (tn_schema_of_plans). E0841 past the limit on memory. */
tn_status tn_plan_rows_new(const tn_library *library, tn_plan_rows **rows, tn_error *error);
void tn_plan_rows_free(tn_plan_rows *rows);

/* Rows of plans of one length, or (TN_ALL_LENGTHS) of all. `count` is initialised. */
void tn_plan_rows_count(const tn_plan_rows *rows, uint32_t length, mpz_t count);

/* Those of the lengths below: the first rank of a length of the library's (TN_ALL_LENGTHS: of all, 0). */
void tn_plan_rows_before(const tn_plan_rows *rows, uint32_t length, mpz_t before);

/* For how many plans a tray stands. */
mpz_srcptr tn_plan_rows_of_tray(const tn_plan_rows *rows, tn_tray tray);

/* The row of plans of a rank: its trays (room for tn_library_max), and of each the number of its plan among those that
 * the tray stands for, from 0 (initialised, as many). false where there are no so many. */
bool tn_plan_rows_unrank(const tn_plan_rows *rows, const mpz_t rank, tn_tray *trays, uint32_t *length, mpz_t *plans);

/* The rank of a row of plans, whose numbers are of plans that its trays stand for. false: the library has no such row
 * of trays. */
bool tn_plan_rows_rank(const tn_plan_rows *rows, const tn_tray *trays, uint32_t length, const mpz_t *plans, mpz_t rank);

#endif
