/* Writes rows in the format that the options ask for. */
#include "cli/common/row_output.h"

#include "driver/parquet/parquet.h"
#include "runtime/plan/store/sqlite.h"

bool tn_job_row_writer(tn_job *job, const tn_written_settings *settings, const tn_row_source *source,
                       tn_plan_writer **writer)
{
    if (!tn_job_writes(job, source->rows ? "a list of houses" : "a list of plans", settings->output,
                       source->rows ? TN_WRITES_ROWS & ~(TN_WRITES(BIN) | TN_WRITES(PARQUET)) : TN_WRITES_ROWS))
        return false;
    if (settings->csv_safe && settings->format != TN_FORMAT_CSV) {
        tn_job_usage(job, "--csv-safe is about --format csv");
        return false;
    }
    if ((settings->plan_lines || settings->row_group.given) && settings->format != TN_FORMAT_PARQUET) {
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "--plan-lines and --row-group are about Parquet"),
                "write to a file that ends in .parquet, or give --format parquet");
        return false;
    }
    tn_writer_options options = {
        .format = (tn_plan_format)settings->format,
        .rows = source->rows,
        .metadata = *source->metadata,
        .columns = settings->columns,
        .csv_safe = settings->csv_safe,
        .resume = settings->resume,
        .row_group = (uint32_t)settings->row_group.value,
        .plan_lines = settings->plan_lines,
        .ranks = source->ranks,
        .sqlite = tn_plan_sqlite(),
        .parquet = tn_plan_parquet_calls(),
    };
    tn_error error;
    tn_status status =
        tn_plan_writer_open(source->schema, settings->output ? settings->output : "-", &options, writer, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

void tn_job_rows_close(tn_job *job, tn_plan_writer *writer)
{
    tn_error error;
    if (job->exit_code == TN_EXIT_DONE && !job->reader_gone && tn_plan_writer_close(writer, &error) != TN_OK)
        tn_job_fail(job, &error);
    tn_plan_writer_free(writer);
}
