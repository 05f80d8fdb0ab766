/* What beginning, replaying and resuming a run share. Of no use elsewhere. */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_BEGIN_H
#define TARTAN_DRIVER_BREED_EVOLVE_BEGIN_H

#include "driver/breed/evolve.h"

/* What beginning, replaying and resuming a run share. Of no use elsewhere. */

/* Together: makes the stored generations again, without evaluating; up to the one that `until` is born in, or all. What
 * waits for the next generation is kept in run->waiting. */
tn_status tn_run_repeat(tn_run *run, uint64_t until, tn_error *error);

/* Finds what is worth saying of a run's first generation, which was just made, before more are bred from it: all else
 * comes from these sentences. A help says only what was tried: where it says that another depth gives more, a
 * generation of that depth was made. TN_MEMORY and the like, or TN_OK. */
tn_status tn_run_first_look(const tn_run *run, tn_first_look *look, tn_error *error);

/* Together: scores are of the job's inputs from here on, and all members are scored again. */
tn_status tn_run_take_inputs(tn_run *run, tn_error *error);

#endif
