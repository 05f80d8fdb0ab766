/* Writes plans in the format that the options ask for. */
#include "cli/plan/plan_output.h"

#include <inttypes.h>

#include "runtime/plan/store/sqlite.h"

bool tn_job_plan_writer(tn_job *job, const tn_ready_library *ready, const tn_written_settings *settings,
                        const char *made, tn_plan_writer **writer)
{
    const tn_module *module = job->opened.module;
    if (!tn_job_takes_text(job, settings->output))
        return false;
    if (settings->csv_safe && settings->format != TN_FORMAT_CSV) {
        tn_job_usage(job, "--csv-safe is about --format csv");
        return false;
    }
    char library_hash[33], rules_hash[20] = "", command[400];
    snprintf(command, sizeof command, "%s%s", made, settings->columns ? " --columns" : "");
    tn_library_hash(ready->library, library_hash);
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    if (producer)
        snprintf(rules_hash, sizeof rules_hash, "%016" PRIx64, (uint64_t)producer->sources_hash);
    tn_writer_options options = {
        .format = (tn_plan_format)settings->format,
        .metadata = {.library = tn_text(module, ready->record->name),
                     .library_hash = library_hash,
                     .rules_hash = rules_hash,
                     .rules_path = job->settings->operands.items[0],
                     .version = producer ? tn_text(module, producer->version) : NULL,
                     .command = settings->columns ? command : made},
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
