/* In how many ways plans of a library are derived by what it generates. If it generates nothing, each in one way. */
#ifndef TARTAN_ASK_PLAN_WAYS_H
#define TARTAN_ASK_PLAN_WAYS_H

#include "ask/session/session.h"
#include "runtime/plan/ways/derivation.h"
#include "runtime/plan/ways/projected.h"

typedef struct tn_plan_vm tn_plan_vm; /* runtime/plan/match/vm.h */

/* Makes ready to ask about one plan after another. Close it in any case. */
typedef struct tn_ways_of_plans {
    tn_derivation derivation;
    tn_plan_vm *vm;          /* NULL: nothing generates */
    tn_projected *projected; /* of a library that is projected, or NULL */
    mpz_t ways;              /* of the plan asked about last */
} tn_ways_of_plans;

tn_status tn_ways_open(tn_ways_of_plans *ways, const tn_ready_library *ready, tn_error *error);
tn_status tn_ways_find(tn_ways_of_plans *ways, const tn_tray *trays, size_t length, tn_error *error);
void tn_ways_close(tn_ways_of_plans *ways);

/* Answers `count` with `ways`. */
tn_status tn_count_ways(tn_session *session, const tn_count_request *request, tn_reply *answer);

/* Ways are of plans, and this is about houses. */
tn_status tn_ways_refuse_houses(tn_session *session);

#endif
