/* What `explain` says of designs of boxes. */
#include "cli/solid/solid.h"

void tn_job_explain_solid(tn_job *job, const char *name, uint32_t most, bool json)
{
    tn_output output;
    uint32_t solid;
    tn_status status = tn_solid_choose(&job->opened, name, &solid);
    tn_job_status(job, status);
    if (status != TN_OK || !tn_job_output(job, NULL, &output))
        return;
    tn_job_status(job, tn_solid_explain(&job->opened, solid, most, json, output.stream));
    tn_job_commit(job, &output);
}
