/* Puts the program that a study names for scores behind its problem. */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_PROGRAM_H
#define TARTAN_DRIVER_BREED_EVOLVE_PROGRAM_H

#include "driver/breed/evolve.h"

/* After the problem is made: from here on the job's evaluator asks the program too. `path` is that of the study. E1253
 * where programs may not be run, E1254 where this one cannot be. */
tn_status tn_evolution_job_ask(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                               tn_error *error);

#endif
