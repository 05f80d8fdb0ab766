/* What the commands do with designs of boxes. */
#ifndef TARTAN_CLI_SOLID_SOLID_H
#define TARTAN_CLI_SOLID_SOLID_H

#include "cli/common/job.h"
#include "driver/solid/solid.h"

/* Prints how boxes of the design of this name (NULL: the only one) were squashed, as `tartan explain` does. */
void tn_job_explain_solid(tn_job *job, const char *name, bool json);

/* Measures the designs of the file that is open and tests their requirements. The measures come out as text that the
 * caller frees; NULL where out of memory, which is reported. */
char *tn_job_test_solids(tn_job *job, bool json, tn_solid_tally *tally);

#endif
