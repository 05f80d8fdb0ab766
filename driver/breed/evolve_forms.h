/* The part of a job that is about forms bred as what they are, fields and designs of boxes. Of no use elsewhere. */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_FORMS_H
#define TARTAN_DRIVER_BREED_EVOLVE_FORMS_H

#include "driver/breed/evolve.h"

/* Makes kind, first genomes and evaluator of a job whose settings are translated. */
tn_status tn_evolution_forms(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                             tn_error *error);

/* How many errors in single cases the scores of a job hold: where it selects by those that its program answers with. */
size_t tn_evolution_held_cases(const tn_evolution_job *job);

/* An evaluator's function for runs that only recall scores: TN_INTERNAL. */
tn_status tn_never_evaluate(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                            char message[200], tn_error *error);

#endif
