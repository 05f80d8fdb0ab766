/* tartan rank: a plan's place in its library. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/house/judged.h"
#include "cli/plan/library_job.h"
#include "driver/plan/clauses.h"
#include "runtime/plan/text/text.h"

typedef struct rank_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool of_all;
} rank_settings;

static const rank_settings *settings_of(const tn_job *job)
{
    return (const rank_settings *)job->settings;
}

/* Names one clause that the plan fails, and where it is written. */
static void name_clause(tn_job *job, tn_diagnostic *why, uint32_t clause)
{
    const tn_module *module = job->opened.module;
    const tn_clause_record *record = &module->CLAUSE_records[clause];
    const char *doc = tn_text(module, record->doc);
    tn_span span = {record->file, record->begin, record->end};
    bool known = record->file < job->opened.compilation.sources.count;
    tn_note(tn_job_diagnostics(job), why, known ? &span : NULL, "it fails `%s`%s%s", tn_text(module, record->name),
            *doc ? ": " : "", doc);
}

/* Why the plan has no rank: each clause that it fails, as the interpreter finds them. */
static tn_status say_why(tn_job *job, const tn_ready_library *ready, const tn_plan *plan, tn_error *error)
{
    const tn_module *module = job->opened.module;
    tn_rules_options options = {.engine = TN_ENGINE_VM, .max_length = tn_job_max_length(&settings_of(job)->plans)};
    tn_rules *rules = NULL;
    tn_matcher *matcher = NULL;
    uint64_t *bits = calloc(ready->record->clause_count / 64 + 1, sizeof *bits);
    tn_diagnostics *list = tn_job_diagnostics(job);
    tn_diagnostic *why = tn_report_bare(list, TN_ERROR, E_NOT_IN_LIBRARY, "the plan is not in `%s`",
                                        tn_text(module, ready->record->name));
    tn_status status =
        bits ? tn_clause_rules_new(ready->schema, ready->record, &options, &rules, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_matcher_new(rules, &matcher, error);
    if (status == TN_OK)
        status = tn_match(matcher, plan->trays, plan->length, bits, error);
    if (plan->length < tn_library_min(ready->library) || plan->length > tn_library_max(ready->library))
        tn_note(list, why, NULL, "it fails `trays`: it has %zu, and plans there have %u to %u", plan->length,
                tn_library_min(ready->library), tn_library_max(ready->library));
    for (uint32_t i = 0; status == TN_OK && i < ready->record->clause_count; i++)
        if (tn_clause_drops(module, ready->record, i, bits))
            name_clause(job, why, ready->record->clause_first + i);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    free(bits);
    return status == TN_OK ? TN_INVALID : status;
}

static void write_rank(tn_job *job, const mpz_t rank)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    mpz_out_str(output.stream, 10, rank);
    fputc('\n', output.stream);
    tn_job_commit(job, &output);
}

static void rank_plan(tn_job *job, const tn_ready_library *ready, const tn_plan *plan)
{
    mpz_t rank;
    tn_error error;
    mpz_init(rank);
    if (tn_library_rank(ready->library, plan->trays, plan->length, rank)) {
        write_rank(job, rank);
    } else {
        tn_status status = say_why(job, ready, plan, &error);
        if (status == TN_INVALID)
            tn_job_status(job, status);
        else
            tn_job_fail(job, &error);
    }
    mpz_clear(rank);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const rank_settings *settings = (const rank_settings *)common;
    tn_job job;
    tn_ready_library ready = {0};
    const char *text = common->operands.items[1];
    tn_job_begin(&job, common);
    bool open = tn_job_open_plans(&job, common->operands.items[0], &settings->plans);
    if (open && tn_is_house_line(text)) {
        const tn_house_settings houses = tn_job_houses(&settings->plans);
        tn_job_rank_house(&job, &houses, text, settings->of_all);
    } else if (open && settings->of_all) {
        tn_diagnostic *d = tn_job_usage(&job, "--of-all is about a house, and this is a plan");
        tn_help(tn_job_diagnostics(&job), d, "the number of a plan is its rank among all plans: leave --of-all out");
    } else if (open && tn_job_opened_library(&job, &settings->plans, &ready)) {
        tn_plan plan = {0};
        tn_error error;
        tn_status status = text[strspn(text, " ")] == '{'
                               ? tn_plan_parse_json(ready.schema, text, strlen(text),
                                                    tn_job_max_length(&settings->plans), &plan, &error)
                               : tn_plan_parse_line(ready.schema, text, strlen(text),
                                                    tn_job_max_length(&settings->plans), &plan, &error);
        if (status == TN_OK) {
            rank_plan(&job, &ready, &plan);
        } else {
            tn_error_place(&error, 1, error.column, error.column_end);
            tn_report_error(tn_job_diagnostics(&job), &error, "PLAN", text, strlen(text));
            tn_job_status(&job, status);
        }
        free(plan.trays);
    }
    tn_library_close(&ready);
    return tn_job_end(&job);
}

#define SETTINGS rank_settings
static const tn_option options[] = {
    OPTION_LIBRARY,
    OPTION_WHERE,
    OPTION_TRAYS,
    FLAG("of-all", 0, of_all, "of a house: its rank among all houses, #R, in place of #P:V"),
    OPTION_MAX_LENGTH,
    OPTION_MAX_STATES,
    OPTION_THREADS(plans.threads),
};

const tn_command tn_command_rank = {
    .name = "rank",
    .summary = "print the number of a plan in its library",
    .usage = "FILE PLAN [--library NAME]\nFILE HOUSE [--library HOUSES] [--of-all]",
    .description = "Writes the rank of a plan: how many plans of the library come before it, in the order of length "
                   "and then tray by tray. "
                   "PLAN is a plan line or a JSON object, in quotes. For a plan that the library does not hold, the "
                   "exit code is 1 and "
                   "the message says which clause it fails. "
                   "HOUSE is a house line or a JSON object with one; of it the command writes #P:V: the rank of its "
                   "plan, and how many houses on that plan come "
                   "before it. With --of-all it writes #R: how many houses of the library come before it.",
    .example = "$ tartan rank terrace \"$(tartan unrank terrace 1000)\"\n1000",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "give fewer trays with --trays",
    .operands = "a FILE and a PLAN",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
