/* What the commands do with designs of boxes; `most` as in driver/solid/solid.h. */
#ifndef TARTAN_CLI_SOLID_SOLID_H
#define TARTAN_CLI_SOLID_SOLID_H

#include "cli/common/job.h"
#include "driver/solid/solid.h"

/* Prints how boxes of the design of this name (NULL: the only one) were squashed, as `tartan explain` does. */
void tn_job_explain_solid(tn_job *job, const char *name, uint32_t most, bool json);

#endif
