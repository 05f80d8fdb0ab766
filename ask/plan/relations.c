/* relations: how rules of plans, and clauses about houses, relate. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/session/questions.h"
#include "ask/session/session.h"
#include "driver/open/open.h"
#include "driver/plan/analysis.h"
#include "runtime/base/crew.h"
#include "runtime/base/integers.h"
#include "runtime/house/house.h"
#include "runtime/plan/analysis/analysis.h"
#include "runtime/plan/text/text.h"

/* The states of a pair of clauses about houses, unless a request gives another limit: some seconds. */
#define RELATED_STATES 100000u

static const char *relation_word(tn_rule_relation relation)
{
    static const char *const words[] = {
        [TN_RULES_UNKNOWN] = "unknown", [TN_RULES_EQUAL] = "equal",       [TN_RULES_APART] = "apart",
        [TN_RULES_INSIDE] = "inside",   [TN_RULES_CONTAINS] = "contains", [TN_RULES_OVERLAP] = "overlap",
    };
    return words[relation];
}

/* ---- clauses about houses: how many match each of two, and how many both? */

/* What two clauses make of a house. */
typedef enum pair_part { BOTH, ONLY_A, ONLY_B } pair_part;

typedef struct relating {
    tn_numbered n;
    mpz_t *matched; /* by each clause */
    bool *counted;  /* [clause] that is known */
    bool *passed;   /* [clause] that passes the limit */
    bool examples;
    tn_error limit; /* the first */
    size_t unknown;
} relating;

static const tn_house_clause_record *clause_of(const relating *r, size_t i)
{
    return &r->n.form.module->HOUSE_CLAUSE_records[r->n.record->clause_first + i];
}

/* ---- counting */

static tn_status count_houses(tn_numbered *some, mpz_t houses, tn_error *error)
{
    mpz_set_ui(houses, 0);
    tn_status status = tn_numbered_all(some, error);
    if (status == TN_OK)
        tn_houses_count(some->all, TN_ALL_LENGTHS, houses);
    if (status != TN_LIMIT || !tn_numbered_few(some))
        return status;
    uint32_t low = tn_library_min(some->plans), high = tn_library_max(some->plans);
    mpz_t *lengths = tn_integers_new((size_t)(high - low) + 1);
    status = lengths ? tn_numbered_lengths(some, low, high, lengths, error) : tn_fail_memory(error);
    for (uint32_t k = low; status == TN_OK && k <= high; k++)
        mpz_add(houses, houses, lengths[k - low]);
    tn_integers_free(lengths, (size_t)(high - low) + 1);
    return status;
}

/* The first of the houses, as an example; none where even that takes too much. */
static tn_status write_first(tn_numbered *some, char **example, tn_error *error)
{
    tn_house first;
    tn_buffer line = {0};
    tn_status status = tn_numbered_house(some, "#0", &first, error);
    if (status == TN_OK)
        status = tn_house_write(&first, &line, error);
    tn_house_clear(&first);
    if (status == TN_OK)
        *example = line.data;
    else
        free(line.data);
    return status == TN_LIMIT ? TN_OK : status;
}

/* How many houses the clauses keep, and (example not NULL) the first of them. */
static tn_status count_kept(const relating *r, tn_house_clause_record *clauses, uint32_t count, mpz_t houses,
                            char **example, tn_error *error)
{
    tn_other_clauses other;
    tn_numbered some;
    tn_other_clauses_set(&r->n.form, r->n.record, clauses, count, &other);
    tn_numbered_other(&r->n, &other.module, &other.library, r->n.plans, &some);
    tn_status status = count_houses(&some, houses, error);
    if (status == TN_OK && example && mpz_sgn(houses) > 0)
        status = write_first(&some, example, error);
    tn_numbered_other_close(&some);
    return status;
}

/* ---- pairs */

static tn_status count_clause(relating *r, size_t i, tn_error *error)
{
    tn_house_clause_record clause = *clause_of(r, i);
    if (r->counted[i] || r->passed[i])
        return r->counted[i] ? TN_OK : TN_LIMIT;
    clause.kind = TN_CLAUSE_REQUIRE;
    tn_status status = count_kept(r, &clause, 1, r->matched[i], NULL, error);
    r->counted[i] = status == TN_OK;
    r->passed[i] = status == TN_LIMIT;
    return status;
}

static tn_status count_kind(const relating *r, size_t i, size_t j, pair_part part, mpz_t houses, char **example,
                            tn_error *error)
{
    tn_house_clause_record clauses[2] = {*clause_of(r, i), *clause_of(r, j)};
    clauses[0].kind = part == ONLY_B ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE;
    clauses[1].kind = part == ONLY_A ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE;
    return count_kept(r, clauses, 2, houses, r->examples ? example : NULL, error);
}

static tn_rule_relation relation_of(const mpz_t a, const mpz_t b, const mpz_t both)
{
    bool inside = mpz_cmp(a, both) == 0, contains = mpz_cmp(b, both) == 0;
    if (inside && contains)
        return TN_RULES_EQUAL;
    if (mpz_sgn(both) == 0)
        return TN_RULES_APART;
    return inside ? TN_RULES_INSIDE : contains ? TN_RULES_CONTAINS : TN_RULES_OVERLAP;
}

static tn_status relate_counted(const relating *r, size_t i, size_t j, tn_related_pair *pair, tn_error *error)
{
    mpz_t both, only;
    mpz_inits(both, only, NULL);
    tn_status status = count_kind(r, i, j, BOTH, both, &pair->both, error);
    if (status == TN_OK)
        pair->relation = relation_word(relation_of(r->matched[i], r->matched[j], both));
    if (status == TN_OK && r->examples && mpz_cmp(r->matched[i], both) > 0)
        status = count_kind(r, i, j, ONLY_A, only, &pair->only_a, error);
    if (status == TN_OK && r->examples && mpz_cmp(r->matched[j], both) > 0)
        status = count_kind(r, i, j, ONLY_B, only, &pair->only_b, error);
    mpz_clears(both, only, NULL);
    return status;
}

static tn_status relate_clauses(relating *r, size_t i, size_t j, tn_related_pair *pair, tn_error *error)
{
    const tn_module *module = r->n.form.module;
    pair->a = tn_text(module, clause_of(r, i)->name);
    pair->b = tn_text(module, clause_of(r, j)->name);
    pair->relation = relation_word(TN_RULES_UNKNOWN);
    pair->has_both = pair->has_only_a = pair->has_only_b = r->examples;
    tn_status status = count_clause(r, i, error);
    if (status == TN_OK)
        status = count_clause(r, j, error);
    if (status == TN_OK)
        status = relate_counted(r, i, j, pair, error);
    if (status == TN_LIMIT && r->unknown++ == 0)
        r->limit = *error;
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status relate(relating *r, tn_related *related, tn_error *error)
{
    size_t count = r->n.record->clause_count, pair = 0;
    tn_status status = TN_NEW_LIST(related_pair, related->relations, count * (count - (count > 0)) / 2, error);
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; status == TN_OK && j < count; j++)
            status = relate_clauses(r, i, j, &related->relations.items[pair++], error);
    return status;
}

/* ---- all of it */

static tn_status begin(relating *r, tn_related *related, tn_error *error)
{
    const tn_module *module = r->n.form.module;
    size_t count = r->n.record->clause_count;
    related->has_library = related->has_clauses = true;
    related->library = tn_text(module, r->n.record->name);
    related->clauses.items = calloc(count + 1, sizeof *related->clauses.items);
    r->matched = tn_integers_new(count);
    r->counted = calloc(count + 1, sizeof *r->counted);
    r->passed = calloc(count + 1, sizeof *r->passed);
    if (!related->clauses.items || !r->matched || !r->counted || !r->passed)
        return tn_fail_memory(error);
    related->clauses.count = count;
    for (size_t i = 0; i < count; i++)
        related->clauses.items[i] = tn_text(module, clause_of(r, i)->name);
    return TN_OK;
}

/* The limit that the first pair passed. */
static void say_unknown(relating *r)
{
    const tn_house_library_record *record = r->n.record;
    size_t count = record->clause_count;
    tn_span place = {record->file, record->begin, record->end};
    tn_opened *opened = r->n.session->opened;
    tn_error_help(&r->limit, "--max-states N allows more; a library on plans of fewer trays takes fewer");
    tn_diagnostic *d = tn_finding_limit(opened, &r->limit, &place);
    tn_note(&opened->compilation.diagnostics, d, NULL, "so %zu of %zu pairs of clauses are not related", r->unknown,
            count * (count - 1) / 2);
}

/* Relates the clauses of a library of houses, whatever they do with what they match, by counting the houses that match
 * each of them and each two. A pair that passes the limit of states is TN_RULES_UNKNOWN, and a note says so. */
static tn_status relate_houses(tn_session *session, const tn_relations_request *request,
                               const tn_house_library_record *library, tn_related *related)
{
    relating r = {.examples = request->examples};
    const tn_house_settings settings = {
        .library = tn_text(session->opened->module, library->name),
        .plans = {.max_states = (uint32_t)request->max_states,
                  .threads = request->has_threads ? (unsigned)request->threads : tn_crew_default()},
    };
    tn_error error;
    tn_status status = tn_numbered_open(&r.n, session, &settings);
    if (status == TN_OK) {
        if (!r.n.max_states)
            r.n.max_states = RELATED_STATES;
        status = begin(&r, related, &error);
        if (status == TN_OK)
            status = relate(&r, related, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
        else if (r.unknown)
            say_unknown(&r);
        tn_integers_free(r.matched, library->clause_count);
    }
    tn_numbered_close(&r.n);
    free(r.counted);
    free(r.passed);
    return status;
}

/* ---- rules */

typedef struct relating_rules {
    const tn_schema *schema;
    const tn_plan_analysis *analysis;
    bool examples;
} relating_rules;

static const char *rule_name(const relating_rules *r, size_t i)
{
    const tn_module *module = r->schema->module;
    return tn_text(module, module->RULE_records[tn_plan_analysis_rule(r->analysis, i)].name);
}

/* NULL if there is no such plan. */
static tn_status take_plan(const relating_rules *r, const tn_shown_plan *plan, char **to, tn_error *error)
{
    tn_buffer line = {0};
    if (!plan->shown)
        return TN_OK;
    bool written = tn_plan_write_line(r->schema, plan->trays, plan->length, &line) && tn_buffer_append(&line, "", 1);
    *to = line.data;
    return written ? TN_OK : tn_fail_memory(error);
}

static tn_status relate_pair(const relating_rules *r, size_t i, size_t j, tn_related_pair *pair, tn_error *error)
{
    tn_shown_plan plans[3];
    char **const to[3] = {&pair->both, &pair->only_a, &pair->only_b};
    pair->a = rule_name(r, i);
    pair->b = rule_name(r, j);
    pair->relation = relation_word(tn_plan_analysis_relation(r->analysis, i, j));
    pair->has_both = pair->has_only_a = pair->has_only_b = r->examples;
    if (!r->examples)
        return TN_OK;
    tn_status status = tn_plan_analysis_examples(r->analysis, i, j, plans, error);
    for (int e = 0; e < 3; e++) {
        if (status == TN_OK)
            status = take_plan(r, &plans[e], to[e], error);
        tn_shown_plan_clear(&plans[e]);
    }
    return status;
}

static tn_status relate_rules(const relating_rules *r, tn_related *related, tn_error *error)
{
    size_t count = tn_plan_analysis_rule_count(r->analysis), pair = 0;
    related->has_schema = related->has_rules = true;
    related->schema = tn_text(r->schema->module, r->schema->record->name);
    related->rules.items = calloc(count + 1, sizeof *related->rules.items);
    if (!related->rules.items)
        return tn_fail_memory(error);
    related->rules.count = count;
    for (size_t i = 0; i < count; i++)
        related->rules.items[i] = rule_name(r, i);
    tn_status status = TN_NEW_LIST(related_pair, related->relations, count * (count - (count > 0)) / 2, error);
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; status == TN_OK && j < count; j++)
            status = relate_pair(r, i, j, &related->relations.items[pair++], error);
    return status;
}

/* ---- the whole */

static bool is_own(const tn_house_library_record *library)
{
    return !(library->flags & TN_IMPORTED);
}

static size_t own_house_libraries(const tn_module *module)
{
    size_t count = 0;
    for (size_t i = 0; i < module->HOUSE_LIBRARY_count; i++)
        count += is_own(&module->HOUSE_LIBRARY_records[i]);
    return count;
}

static tn_status relate_analysed(tn_session *session, const tn_relations_request *request,
                                 const tn_plan_analyses *analyses, tn_relations *relations)
{
    const tn_module *module = session->opened->module;
    size_t count = analyses->count, houses = own_house_libraries(module);
    tn_error error;
    tn_status status = TN_NEW_LIST(related, relations->items, count + houses, &error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const relating_rules r = {analyses->schemas[i], analyses->items[i], request->examples};
        status = relate_rules(&r, &relations->items.items[i], &error);
    }
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    for (size_t i = 0; status == TN_OK && i < module->HOUSE_LIBRARY_count; i++)
        if (is_own(&module->HOUSE_LIBRARY_records[i]))
            status =
                relate_houses(session, request, &module->HOUSE_LIBRARY_records[i], &relations->items.items[count++]);
    return status;
}

tn_status tn_ask_relations(tn_session *session, const tn_relations_request *request, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    const tn_plan_analysis_options options = {
        .max_states = (uint32_t)request->max_states,
        .threads = request->has_threads ? (unsigned)request->threads : tn_crew_default(),
    };
    tn_plan_analyses analyses = {0};
    tn_error error;
    *answer = (tn_reply){0};
    if (module->RULE_count == 0 && own_house_libraries(module) == 0)
        return tn_session_refuse(session, NULL,
                                 "--relations is about rules of plans and libraries of houses, and %.200s has none",
                                 session->opened->path);
    tn_session_begins(session, "relating the rules");
    tn_status status = tn_plan_analyse(session->opened, &options, &analyses);
    if (status == TN_OK && tn_reply_new(&tn_message_relations, answer, &error) != TN_OK)
        status = tn_session_fail(session, &error);
    if (status == TN_OK)
        status = relate_analysed(session, request, &analyses, answer->value);
    tn_session_ends(session);
    tn_plan_analyses_free(&analyses);
    return status;
}
