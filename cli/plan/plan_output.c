/* Writes plans in the format that the options ask for. */
#include "cli/plan/plan_output.h"

#include "driver/plan/made.h"

bool tn_job_plan_writer(tn_job *job, const tn_ready_library *ready, const tn_written_settings *settings,
                        const char *made, tn_plan_writer **writer)
{
    char command[400];
    snprintf(command, sizeof command, "%s%s", made, settings->columns ? " --columns" : "");
    tn_made described;
    tn_made_describe(&job->opened, ready, job->settings->operands.items[0], settings->columns ? command : made,
                     &described);
    mpz_t ranks;
    mpz_init(ranks);
    tn_library_kept(ready->library, TN_ALL_LENGTHS, ranks);
    const tn_row_source source = {.schema = ready->schema, .metadata = &described.metadata, .ranks = ranks};
    bool opened = tn_job_row_writer(job, settings, &source, writer);
    mpz_clear(ranks);
    return opened;
}
