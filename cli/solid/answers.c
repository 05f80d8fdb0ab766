/* What `test` and `explain` say of designs of boxes. */
#include <stdlib.h>

#include "cli/solid/solid.h"

char *tn_job_test_solids(tn_job *job, uint32_t most, bool json, tn_solid_tally *tally)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    tn_error error;
    if (out) {
        tn_job_status(job, tn_solid_tests_run(&job->opened, most, json, out, tally));
        if (fclose(out) == 0)
            return text;
        free(text);
    }
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    return NULL;
}

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
