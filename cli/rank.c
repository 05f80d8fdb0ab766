/* tartan rank: a plan's place in its library. */
#include <stdlib.h>
#include <string.h>

#include "cli/library_session.h"
#include "cli/option_rows.h"
#include "runtime/plan/text.h"

/* Why the plan has no rank. */
static void say_why(tn_session *session, const tn_ready_library *ready, uint32_t clause)
{
    const char *name, *doc;
    tn_clause_describe(session->opened.module, clause, &name, &doc);
    tn_diagnostics *list = tn_session_diagnostics(session);
    tn_diagnostic *why =
        tn_report_bare(list, TN_ERROR, E_NOT_IN_LIBRARY, "the plan is not in `%s`: it fails `%s`%s%s",
                       tn_text(session->opened.module, ready->record->name), name, *doc ? ", " : "", doc);
    if (clause < session->opened.module->CLAUSE_count) {
        const tn_clause_record *record = &session->opened.module->CLAUSE_records[clause];
        tn_span span = {record->file, record->begin, record->end};
        if (record->file < session->opened.compilation.sources.count)
            tn_note(list, why, &span, "`%s` is here", name);
    } else {
        tn_help(list, why, "it keeps plans of %u to %u trays", tn_library_min(ready->library),
                tn_library_max(ready->library));
    }
    tn_session_status(session, TN_INVALID);
}

static void write_rank(tn_session *session, const mpz_t rank)
{
    tn_output output;
    if (!tn_session_output(session, NULL, &output))
        return;
    mpz_out_str(output.stream, 10, rank);
    fputc('\n', output.stream);
    tn_session_commit(session, &output);
}

static void rank_plan(tn_session *session, const tn_ready_library *ready, const tn_plan *plan)
{
    mpz_t rank;
    uint32_t clause;
    mpz_init(rank);
    if (tn_library_rank(ready->library, plan->trays, plan->length, rank))
        write_rank(session, rank);
    else if (!tn_library_has(ready->library, plan->trays, plan->length, &clause))
        say_why(session, ready, clause);
    mpz_clear(rank);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_session session;
    tn_ready_library ready;
    const char *text = settings->operands.items[1];
    tn_session_begin(&session, settings);
    if (tn_session_library(&session, settings->operands.items[0], &ready)) {
        tn_plan plan = {0};
        tn_error error;
        tn_status status =
            text[strspn(text, " ")] == '{'
                ? tn_plan_parse_json(ready.schema, text, strlen(text), tn_session_max_length(settings), &plan, &error)
                : tn_plan_parse_line(ready.schema, text, strlen(text), tn_session_max_length(settings), &plan, &error);
        if (status == TN_OK) {
            rank_plan(&session, &ready, &plan);
        } else {
            tn_error_place(&error, 1, error.column, error.column_end);
            tn_report_error(tn_session_diagnostics(&session), &error, "PLAN", text, strlen(text));
            tn_session_status(&session, status);
        }
        free(plan.trays);
    }
    tn_library_close(&ready);
    return tn_session_end(&session);
}

static const tn_option options[] = {OPTION_LIBRARY, OPTION_TRAYS, OPTION_MAX_LENGTH, OPTION_MAX_STATES, OPTION_THREADS};

const tn_command tn_command_rank = {
    .name = "rank",
    .summary = "say which place a plan has in its library",
    .usage = "FILE PLAN [--library NAME]",
    .description = "Writes the rank of a plan: how many plans of the library come before it, in the order of length "
                   "and then tray by tray. "
                   "PLAN is a plan line or a JSON object, in quotes. For a plan that the library does not hold, the "
                   "exit code is 1 and "
                   "the message says which clause it fails.",
    .example = "$ tartan rank terrace.plan \"$(tartan unrank terrace.plan 1000)\"\n1000",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "a FILE and a PLAN",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
