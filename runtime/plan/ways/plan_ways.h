/* In how many ways a plan is derived: a chart of its stretches, and so for plans of any length. */
#ifndef TARTAN_PLAN_WAYS_PLAN_WAYS_H
#define TARTAN_PLAN_WAYS_PLAN_WAYS_H

#include "runtime/plan/match/vm.h"
#include "runtime/plan/ways/derivation.h"

/* What a chart may take: bytes for its numbers (E0807 past it), and steps, about a nanosecond each (E0808). */
#define TN_WAYS_MEMORY (UINT64_C(1) << 30)
#define TN_WAYS_WORK (UINT64_C(1) << 34)

/* ways: initialised; 0 if the plan is not derived. The vm decides the facts; what it found before is forgotten. */
tn_status tn_plan_ways(const tn_derivation *derivation, tn_plan_vm *vm, const tn_tray *trays, size_t length, mpz_t ways,
                       tn_error *error);

#endif
