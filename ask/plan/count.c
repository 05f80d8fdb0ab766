/* count: how many plans, houses or buildings there are; of plans by length, and what clauses keep out. */
#include "ask/plan/count.h"

#include <stdlib.h>
#include <string.h>

#include "ask/session/made.h"
#include "ask/session/questions.h"

/* ---- plans */

typedef struct counting {
    tn_session *session;
    const tn_ready_library *ready;
    tn_counted_plans *counted;
    bool mirror;
} counting;

static const tn_clause_record *clause_record(const counting *c, uint32_t i)
{
    return &c->ready->schema->module->CLAUSE_records[c->ready->record->clause_first + i];
}

/* Of all lengths, or of one. What is below 0 is not known. */
static tn_status count_length(const counting *c, uint32_t length, tn_plans_of_length *count, tn_error *error)
{
    const tn_library *library = c->ready->library;
    tn_status status = tn_watch_check(c->session->opened->module->watch, error);
    count->length = length;
    tn_library_kept(library, length, count->kept);
    if (status == TN_OK)
        status = tn_library_generated(library, length, count->generated, error);
    if (status == TN_OK && c->mirror)
        status = tn_library_kept_mirror(library, length, count->mirror, error);
    count->has_generated = mpz_sgn(count->generated) >= 0;
    count->has_kept = mpz_sgn(count->kept) >= 0;
    count->has_mirror = c->mirror;
    return status;
}

static tn_status count_all(const counting *c, tn_error *error)
{
    tn_counted_plans *counted = c->counted;
    tn_plans_of_length all;
    tn_message_init(&tn_message_plans_of_length, &all);
    tn_status status = count_length(c, TN_ALL_LENGTHS, &all, error);
    counted->has_generated = all.has_generated;
    counted->has_kept = all.has_kept;
    counted->has_mirror = all.has_mirror;
    mpz_set(counted->generated, all.generated);
    mpz_set(counted->kept, all.kept);
    mpz_set(counted->mirror, all.mirror);
    mpz_sub(counted->pruned, all.generated, all.kept);
    counted->has_pruned = mpz_sgn(counted->pruned) >= 0;
    tn_message_clear(&tn_message_plans_of_length, &all);
    return status;
}

static tn_status count_lengths(const counting *c, tn_error *error)
{
    uint32_t low = tn_library_min(c->ready->library), high = tn_library_max(c->ready->library);
    size_t count = (size_t)high - low + 1;
    tn_status status = TN_NEW_LIST(plans_of_length, c->counted->by_length, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = count_length(c, low + (uint32_t)i, &c->counted->by_length.items[i], error);
    return status == TN_OK ? count_all(c, error) : status;
}

static tn_status describe(const counting *c, tn_error *error)
{
    const tn_module *module = c->ready->schema->module;
    tn_counted_plans *counted = c->counted;
    char hash[33];
    tn_library_hash(c->ready->library, hash);
    counted->library = tn_text(module, c->ready->record->name);
    counted->doc = tn_text(module, c->ready->record->doc);
    counted->states = tn_library_states(c->ready->library);
    counted->has_states = !tn_library_within(c->ready->library);
    counted->hash = strdup(hash);
    return counted->hash ? TN_OK : tn_fail_memory(error);
}

/* ---- clauses */

/* A clause past a limit leaves the other counts as they are: a note says which it is. */
static tn_status count_clause(const counting *c, uint32_t i, mpz_t out, mpz_t only, uint64_t *states, tn_error *error)
{
    uint32_t taken = 0;
    tn_status status = tn_library_effect(c->ready->library, i, out, only, &taken, error);
    *states = taken;
    if (status != TN_LIMIT)
        return status;
    tn_finding_uncounted(c->session->opened, tn_text(c->ready->schema->module, clause_record(c, i)->name), error);
    return TN_OK;
}

static tn_status count_requirement(const counting *c, uint32_t i, tn_requirement_effect *r, tn_error *error)
{
    tn_status status = count_clause(c, i, r->keeps_out, r->only, &r->states, error);
    r->name = tn_text(c->ready->schema->module, clause_record(c, i)->name);
    r->has_keeps_out = mpz_sgn(r->keeps_out) >= 0;
    r->has_only = mpz_sgn(r->only) >= 0;
    return status;
}

static tn_status count_rule(const counting *c, uint32_t i, tn_rule_effect *r, tn_error *error)
{
    tn_status status = count_clause(c, i, r->prunes, r->only, &r->states, error);
    r->name = tn_text(c->ready->schema->module, clause_record(c, i)->name);
    r->has_prunes = mpz_sgn(r->prunes) >= 0;
    r->has_only = mpz_sgn(r->only) >= 0;
    return status;
}

static bool is_rule(const counting *c, uint32_t i)
{
    return clause_record(c, i)->kind == TN_CLAUSE_PRUNE;
}

static tn_status count_clauses(const counting *c, tn_error *error)
{
    tn_counted_plans *counted = c->counted;
    uint32_t count = c->ready->record->clause_count, rules = 0, rule = 0, requirement = 0;
    for (uint32_t i = 0; i < count; i++)
        rules += is_rule(c, i);
    tn_status status = TN_NEW_LIST(rule_effect, counted->rules, rules, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(requirement_effect, counted->requirements, count - rules, error);
    tn_session_begins(c->session, "clauses counted");
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = is_rule(c, i) ? count_rule(c, i, &counted->rules.items[rule++], error)
                               : count_requirement(c, i, &counted->requirements.items[requirement++], error);
    tn_session_ends(c->session);
    counted->has_rules = counted->has_requirements = true;
    return status;
}

static tn_status count_plans(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    counting c = {.session = session, .mirror = request->mirror};
    tn_error error;
    tn_status status = tn_session_library(session, &request->subject, &c.ready);
    if (status != TN_OK)
        return status;
    status = tn_reply_new(&tn_message_counted_plans, answer, &error);
    c.counted = answer->value;
    if (status == TN_OK)
        status = describe(&c, &error);
    if (status == TN_OK)
        status = count_lengths(&c, &error);
    if (status == TN_OK && session->so_far)
        session->so_far(session->so_far_context, answer);
    if (status == TN_OK && !request->no_effects)
        status = count_clauses(&c, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- asked */

/* What only libraries of plans and houses are asked, or NULL. */
static const char *asks_library(const tn_count_request *r)
{
    return r->subject.library       ? "library"
           : r->subject.where.count ? "where"
           : r->subject.has_trays   ? "trays"
           : r->by                  ? "by"
           : r->drawn.picture       ? "picture"
           : r->step                ? "step"
           : r->has_bins            ? "bins"
           : r->plan                ? "plan"
           : r->clauses             ? "clauses"
           : r->mirror              ? "mirror"
           : r->no_effects          ? "no-effects"
                                    : NULL;
}

/* With a plan or clauses, or if the library named is one of houses. */
static bool counts_houses(const tn_session *session, const tn_count_request *r)
{
    return r->plan || r->clauses || tn_session_of_houses(session, &r->subject);
}

/* The histogram of a distribution. */
static tn_status draw(tn_session *session, const tn_answer_picture *asked, tn_counted_values *values)
{
    tn_picture to = tn_answer_picture_begin(asked);
    tn_error error;
    tn_status status = tn_spread_draw(values->spread.value, &to, &error);
    return tn_answer_picture_give(session, asked, &to, status, &error, (tn_list *)&values->files, &values->has_files);
}

static tn_status count(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    if (counts_houses(session, request))
        return tn_count_houses(session, request, answer);
    return request->by ? tn_count_plans_by(session, request, answer) : count_plans(session, request, answer);
}

tn_status tn_ask_count(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (session->opened->module->KIT_count > 0) {
        const char *option = asks_library(request);
        return option ? tn_session_refuse(session, NULL, "--%s is about a library of plans, and %.200s is a kit",
                                          option, session->opened->path)
                      : tn_count_kit(session, request, answer);
    }
    tn_status status = tn_kit_none_asked(session, &request->kit);
    if (status != TN_OK)
        return status;
    if (tn_answer_has_picture(&request->drawn) && !request->by)
        return tn_session_refuse(session, "give `by`, a measure", "only how plans are spread over a measure is drawn");
    status = count(session, request, answer);
    tn_counted_values *values = TN_REPLY(counted_values, answer);
    return status == TN_OK && tn_answer_has_picture(&request->drawn) && values ? draw(session, &request->drawn, values)
                                                                               : status;
}
