/* tartan unrank: the plan at a place in its library. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/plan/library_job.h"
#include "driver/house/judge.h"
#include "runtime/plan/text/text.h"

typedef struct unrank_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool json;
} unrank_settings;

static const unrank_settings *settings_of(const tn_job *job)
{
    return (const unrank_settings *)job->settings;
}

static void write_plan(tn_job *job, const tn_ready_library *ready, const tn_tray *trays, uint32_t length)
{
    tn_buffer line = {0};
    tn_output output;
    tn_error error;
    bool written = settings_of(job)->json ? tn_plan_write_json(ready->schema, trays, length, &line)
                                          : tn_plan_write_line(ready->schema, trays, length, &line);
    if (!written || !tn_buffer_append(&line, "\n", 1)) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, NULL, &output)) {
        fwrite(line.data, 1, line.size, output.stream);
        tn_job_commit(job, &output);
    }
    free(line.data);
}

static void unrank(tn_job *job, const tn_ready_library *ready, const char *text)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(ready->library) + 1));
    uint32_t length;
    mpz_t rank;
    tn_error error;
    if (!trays) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return;
    }
    mpz_init_set_str(rank, text, 10);
    if (tn_library_unrank(ready->library, rank, trays, &length))
        write_plan(job, ready, trays, length);
    else
        tn_job_answered(job, tn_session_no_rank(&job->session, ready->library, ready->record, text));
    mpz_clear(rank);
    free(trays);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const unrank_settings *settings = (const unrank_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    const char *text = common->operands.items[1];
    tn_job_begin(&job, common);
    bool digits = *text && strspn(text, "0123456789") == strlen(text);
    const tn_house_settings houses = tn_job_houses(&settings->plans);
    if (!digits && !tn_is_house_number(text)) {
        tn_diagnostic *d = tn_job_usage(&job, "a rank is a whole number from 0, not `%.60s`", text);
        tn_help(tn_job_diagnostics(&job), d, "the file comes first: tartan unrank FILE RANK");
    } else if (tn_job_open_plans(&job, common->operands.items[0], &settings->plans)) {
        if (!digits || (houses.library && tn_house_library_find(job.opened.module, houses.library) != TN_NO_RECORD))
            tn_job_unrank_house(&job, &houses, text, settings->json);
        else if (tn_job_opened_library(&job, &settings->plans, &ready))
            unrank(&job, &ready, text);
    }
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS unrank_settings
static const tn_option options[] = {
    OPTIONS_LIBRARY,
    FLAG("json", 0, json, "write the plan or house as a JSON object"),
    OPTIONS_LIBRARY_LIMITS,
};

const tn_command tn_command_unrank = {
    .name = "unrank",
    .summary = "print the plan of a number",
    .usage = "FILE RANK [--library NAME]\nFILE '#P:V' [--library HOUSES]",
    .description =
        "Writes the plan of a rank (a whole number from 0, of any size) as a plan line: the inverse of rank. "
        "#P:V is variant V of the plan of rank P in a library of houses, and is written as a house line; "
        "with --library HOUSES a number alone is the rank among all houses.",
    .example = "$ tartan unrank lahave-houses 123456789",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "a FILE and a RANK",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
