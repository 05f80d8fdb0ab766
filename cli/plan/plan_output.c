/* Writes plans in the format that the options ask for. */
#include "cli/plan/plan_output.h"

#include "driver/plan/made.h"
#include "runtime/plan/store/sqlite.h"

bool tn_job_plan_writer(tn_job *job, const tn_ready_library *ready, const tn_written_settings *settings,
                        const char *made, tn_plan_writer **writer)
{
    if (!tn_job_takes_text(job, settings->output))
        return false;
    if (settings->csv_safe && settings->format != TN_FORMAT_CSV) {
        tn_job_usage(job, "--csv-safe is about --format csv");
        return false;
    }
    char command[400];
    snprintf(command, sizeof command, "%s%s", made, settings->columns ? " --columns" : "");
    tn_made described;
    tn_made_describe(&job->opened, ready, job->settings->operands.items[0], settings->columns ? command : made,
                     &described);
    tn_writer_options options = {
        .format = (tn_plan_format)settings->format,
        .metadata = described.metadata,
        .columns = settings->columns,
        .csv_safe = settings->csv_safe,
        .resume = settings->resume,
        .sqlite = tn_plan_sqlite(),
    };
    tn_error error;
    if (tn_plan_writer_open(ready->schema, settings->output ? settings->output : "-", &options, writer, &error) ==
        TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

void tn_job_plan_close(tn_job *job, tn_plan_writer *writer)
{
    tn_error error;
    if (job->exit_code == TN_EXIT_DONE && !job->reader_gone && tn_plan_writer_close(writer, &error) != TN_OK)
        tn_job_fail(job, &error);
    tn_plan_writer_free(writer);
}
