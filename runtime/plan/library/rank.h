/* Ranks of many plans, one after the other: what a plan begins with as the one before it did is not counted again. */
#ifndef TARTAN_PLAN_LIBRARY_RANK_H
#define TARTAN_PLAN_LIBRARY_RANK_H

#include "runtime/plan/library/library.h"

typedef struct tn_ranking tn_ranking;

/* Borrows the library. A ranking belongs to one thread. */
tn_status tn_ranking_new(const tn_library *library, tn_ranking **ranking, tn_error *error);
void tn_ranking_free(tn_ranking *ranking);

/* The rank of a plan of the library, borrowed until the next. NULL where the library does not have the plan. */
mpz_srcptr tn_ranking_next(tn_ranking *ranking, const tn_tray *trays, size_t length);

#endif
