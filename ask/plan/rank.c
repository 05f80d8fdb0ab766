/* rank, unrank: plans and houses of a library by their numbers. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/plan/found.h"
#include "ask/plan/plan_rows.h"
#include "ask/plan/searched.h"
#include "ask/plan/ways.h"
#include "ask/session/questions.h"
#include "ask/session/spelled.h"
#include "driver/plan/library.h"
#include "runtime/house/house.h"
#include "runtime/plan/text/text.h"

/* ---- why there is none */

/* Names one clause that the plan fails, and where it is written. */
static void name_clause(tn_opened *opened, tn_diagnostic *why, uint32_t clause)
{
    const tn_module *module = opened->module;
    const tn_clause_record *record = &module->CLAUSE_records[clause];
    const char *doc = tn_text(module, record->doc);
    tn_span span = {record->file, record->begin, record->end};
    bool known = record->file < opened->compilation.sources.count;
    tn_note(&opened->compilation.diagnostics, why, known ? &span : NULL, "it fails `%s`%s%s",
            tn_text(module, record->name), *doc ? ": " : "", doc);
}

/* Why the plan has no rank: each clause that it fails, as the interpreter finds them. Returns TN_INVALID. */
static tn_status say_why(tn_session *session, const tn_ready_library *ready, const tn_plan *plan, size_t longest)
{
    tn_opened *opened = session->opened;
    tn_diagnostics *list = &opened->compilation.diagnostics;
    const tn_rules_options options = {.engine = TN_ENGINE_VM, .max_length = longest};
    tn_rules *rules = NULL;
    tn_matcher *matcher = NULL;
    tn_error error;
    uint64_t *bits = calloc(ready->record->clause_count / 64 + 1, sizeof *bits);
    tn_diagnostic *why = tn_report_bare(list, TN_ERROR, E_NOT_IN_LIBRARY, "the plan is not in `%s`",
                                        tn_text(opened->module, ready->record->name));
    tn_status status =
        bits ? tn_clause_rules_new(ready->schema, ready->record, &options, &rules, &error) : tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_matcher_new(rules, &matcher, &error);
    if (status == TN_OK)
        status = tn_match(matcher, plan->trays, plan->length, bits, &error);
    if (plan->length < tn_library_min(ready->library) || plan->length > tn_library_max(ready->library))
        tn_note(list, why, NULL, "it fails `trays`: it has %zu, and plans there have %u to %u", plan->length,
                tn_library_min(ready->library), tn_library_max(ready->library));
    for (uint32_t i = 0; status == TN_OK && i < ready->record->clause_count; i++)
        if (tn_clause_drops(opened->module, ready->record, i, bits))
            name_clause(opened, why, ready->record->clause_first + i);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    free(bits);
    return status == TN_OK ? TN_INVALID : tn_session_fail(session, &error);
}

static tn_status find_ways(const tn_ready_library *ready, const tn_plan *plan, tn_ranked_plan *ranked, tn_error *error)
{
    tn_ways_of_plans ways;
    tn_status status = tn_ways_open(&ways, ready, error);
    if (status == TN_OK)
        status = tn_ways_find(&ways, plan->trays, plan->length, error);
    ranked->has_ways = status == TN_OK;
    mpz_set(ranked->ways, ways.ways);
    tn_ways_close(&ways);
    return status;
}

/* ---- the number of a row of plans */

static tn_status answer_row(tn_rows_of_plans *rows, const tn_rank_request *request, tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_reply_new(&tn_message_ranked_plan, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(rows->session, &error);
    tn_ranked_plan *ranked = answer->value;
    ranked->library = tn_text(rows->session->opened->module, rows->ready->record->name);
    status = tn_rows_read(rows, request->plan);
    if (status != TN_OK ||
        tn_plan_rows_rank(rows->rows, rows->trays, rows->length, (const mpz_t *)rows->numbers, ranked->rank))
        return status;
    const tn_plan row = {.trays = rows->trays, .length = rows->length};
    return say_why(rows->session, rows->ready, &row, tn_asked_length(&request->subject));
}

/* The rows of plans of the library that is asked about. Close them in any case. */
static tn_status open_rows(tn_session *session, const tn_library_asked *asked, tn_rows_of_plans *rows)
{
    const tn_ready_library *ready;
    *rows = (tn_rows_of_plans){0};
    tn_status status = tn_session_library(session, asked, &ready);
    return status == TN_OK ? tn_rows_open(rows, session, ready, asked) : status;
}

static tn_status rank_row(tn_session *session, const tn_rank_request *request, tn_reply *answer)
{
    tn_rows_of_plans rows;
    tn_status status = open_rows(session, &request->subject, &rows);
    if (status == TN_OK)
        status = answer_row(&rows, request, answer);
    tn_rows_close(&rows);
    return status;
}

/* ---- the number of a plan */

static tn_status answer_plan(tn_session *session, const tn_ready_library *ready, const tn_plan *plan,
                             const tn_rank_request *request, tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_reply_new(&tn_message_ranked_plan, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    tn_ranked_plan *ranked = answer->value;
    ranked->library = tn_text(session->opened->module, ready->record->name);
    bool has = false;
    if (tn_library_counted_rank(ready->library, plan->trays, plan->length, &has, ranked->rank, &error) != TN_OK)
        return tn_session_fail(session, &error);
    if (!has)
        return say_why(session, ready, plan, tn_asked_length(&request->subject));
    if (request->ways && find_ways(ready, plan, ranked, &error) != TN_OK)
        return tn_session_fail(session, &error);
    return TN_OK;
}

static tn_status rank_plan(tn_session *session, const tn_rank_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    tn_plan plan = {0};
    size_t longest = tn_asked_length(&request->subject);
    tn_status status =
        tn_searched_instead(session, tn_session_counted(session, &request->subject, &ready),
                            "a rank counts the plans before a plan. `explain` says without it whether the "
                            "library keeps a plan, and `enumerate` finds the first plans by search, with "
                            "their ranks");
    if (status == TN_OK)
        status = tn_session_plan(session, ready->schema, request->plan, longest, &plan);
    if (status == TN_OK)
        status = answer_plan(session, ready, &plan, request, answer);
    free(plan.trays);
    return status;
}

/* ---- the number of a house */

static tn_status number_house(tn_numbered *n, const tn_rank_request *request, const tn_house *house, tn_reply *answer,
                              tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_ranked_house, answer, error);
    if (status != TN_OK)
        return status;
    tn_ranked_house *ranked = answer->value;
    ranked->library = tn_text(n->session->opened->module, n->record->name);
    ranked->has_rank = request->of_all;
    ranked->has_plan = ranked->has_variant = !request->of_all;
    return request->of_all ? tn_numbered_rank(n, house, ranked->rank, error)
                           : tn_numbered_name(n, house, ranked->plan, ranked->variant, error);
}

static tn_status rank_house(tn_session *session, const tn_rank_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    tn_numbered n;
    tn_house house = {0};
    tn_error error = {0};
    tn_status status = tn_numbered_open(&n, session, &settings);
    if (status == TN_OK)
        status = tn_numbered_typed(&n, request->house, settings.max_length, &house);
    if (status == TN_OK && number_house(&n, request, &house, answer, &error) != TN_OK)
        status = tn_session_bad_text(session, &error, "HOUSE", request->house);
    tn_house_clear(&house);
    tn_numbered_close(&n);
    return status;
}

tn_status tn_ask_rank(tn_session *session, const tn_rank_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (!request->plan == !request->house)
        return tn_session_refuse(session, NULL, "say whose number is asked for: a plan's or a house's");
    if (request->house && request->ways)
        return tn_ways_refuse_houses(session);
    if (request->plans && (request->house || request->ways))
        return tn_rows_refuse_with(session, request->house ? "houses" : "--ways");
    if (request->house)
        return rank_house(session, request, answer);
    if (request->of_all)
        return tn_session_refuse(session, "the number of a plan is its rank among all plans: leave --of-all out",
                                 "--of-all is about a house, and this is a plan");
    return (request->plans ? rank_row : rank_plan)(session, request, answer);
}

/* ---- the plan of a number */

static tn_status set_plan(const tn_schema *schema, const tn_tray *trays, uint32_t length, tn_reply *answer,
                          tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_unranked_plan, answer, error);
    tn_unranked_plan *plan = answer->value;
    return status == TN_OK ? tn_found_plan_texts(schema, trays, length, &plan->line, &plan->members, error) : status;
}

static tn_status unrank_plan(tn_session *session, const tn_unrank_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    tn_error error;
    uint32_t length;
    mpz_t rank;
    tn_status status =
        tn_searched_instead(session, tn_session_library(session, &request->subject, &ready),
                            "a rank counts the plans before a plan. `enumerate` finds the first plans by "
                            "search, with their ranks, and `sample` others without");
    if (status != TN_OK)
        return status;
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(ready->library) + 1));
    if (!trays) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    mpz_init_set_str(rank, request->rank, 10);
    if (!tn_library_unrank(ready->library, rank, trays, &length))
        status = tn_session_no_rank(session, ready->library, ready->record, request->rank);
    else if (set_plan(ready->schema, trays, length, answer, &error) != TN_OK)
        status = tn_session_fail(session, &error);
    mpz_clear(rank);
    free(trays);
    return status;
}

/* ---- the row of plans of a number */

static tn_status set_row(tn_rows_of_plans *rows, tn_reply *answer, tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_unranked_plan, answer, error);
    tn_unranked_plan *plan = answer->value;
    return status == TN_OK ? tn_rows_texts(rows, &plan->line, &plan->members, error) : status;
}

static tn_status answer_row_of(tn_rows_of_plans *rows, const char *digits, tn_reply *answer)
{
    tn_error error;
    mpz_t rank;
    mpz_init_set_str(rank, digits, 10);
    bool there = tn_rows_find(rows, rank);
    mpz_clear(rank);
    if (!there)
        return tn_rows_no_rank(rows, digits);
    return set_row(rows, answer, &error) == TN_OK ? TN_OK : tn_session_fail(rows->session, &error);
}

static tn_status unrank_row(tn_session *session, const tn_unrank_request *request, tn_reply *answer)
{
    tn_rows_of_plans rows;
    tn_status status = open_rows(session, &request->subject, &rows);
    if (status == TN_OK)
        status = answer_row_of(&rows, request->rank, answer);
    tn_rows_close(&rows);
    return status;
}

/* ---- the house of a number */

static tn_status set_house(void *context, const tn_house *house, tn_error *error)
{
    tn_reply *answer = context;
    tn_status status = tn_reply_new(&tn_message_unranked_house, answer, error);
    tn_unranked_house *to = answer->value;
    return status == TN_OK ? tn_found_house_texts(house, &to->line, &to->members, error) : status;
}

static tn_status unrank_house(tn_session *session, const tn_unrank_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    return tn_session_house(session, &settings, request->rank, set_house, answer);
}

tn_status tn_ask_unrank(tn_session *session, const tn_unrank_request *request, tn_reply *answer)
{
    const char *rank = request->rank;
    bool digits = tn_is_rank(rank);
    *answer = (tn_reply){0};
    if (!digits && !tn_is_house_number(rank))
        return tn_session_refuse(session, NULL, "a rank is a whole number from 0, not `%.60s`", rank);
    bool house = !digits || tn_session_of_houses(session, &request->subject);
    if (house && request->plans)
        return tn_rows_refuse_with(session, "houses");
    return (house ? unrank_house : request->plans ? unrank_row : unrank_plan)(session, request, answer);
}
