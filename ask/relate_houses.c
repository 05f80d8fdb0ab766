/* Relates the clauses of a library of houses: how many houses match each of two, and how many both? */
#include "cli/house/related.h"

#include <stdlib.h>
#include <string.h>

#include "cli/house/houses.h"
#include "driver/open/findings.h"
#include "runtime/base/integers.h"

typedef struct relating {
    tn_numbered n;
    mpz_t *matched; /* by each clause */
    bool *counted;  /* [clause] that is known */
    bool *passed;   /* [clause] that passes the limit */
    bool examples;
    tn_related_houses *related;
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
    tn_module module = *r->n.form.module; /* but for the clauses it is the same */
    module.HOUSE_CLAUSE_records = clauses;
    module.HOUSE_CLAUSE_count = count;
    tn_house_library_record record = *r->n.record;
    record.clause_first = 0;
    record.clause_count = count;
    tn_numbered some;
    tn_status status = tn_numbered_other(&r->n, &module, &record, r->n.plans, &some, error);
    if (status == TN_OK)
        status = count_houses(&some, houses, error);
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

static tn_status count_kind(const relating *r, size_t i, size_t j, tn_related_kind kind, mpz_t houses, tn_error *error)
{
    tn_house_clause_record clauses[2] = {*clause_of(r, i), *clause_of(r, j)};
    clauses[0].kind = kind == TN_RELATED_ONLY_B ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE;
    clauses[1].kind = kind == TN_RELATED_ONLY_A ? TN_CLAUSE_PRUNE : TN_CLAUSE_REQUIRE;
    char **example = &r->related->examples[(i * r->related->count + j) * TN_RELATED_KINDS + kind];
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

static tn_rule_relation turned(tn_rule_relation relation)
{
    return relation == TN_RULES_INSIDE ? TN_RULES_CONTAINS : relation == TN_RULES_CONTAINS ? TN_RULES_INSIDE : relation;
}

static tn_status relate_pair(relating *r, size_t i, size_t j, tn_rule_relation *relation, tn_error *error)
{
    mpz_t both, only;
    mpz_inits(both, only, NULL);
    tn_status status = count_clause(r, i, error);
    if (status == TN_OK)
        status = count_clause(r, j, error);
    if (status == TN_OK)
        status = count_kind(r, i, j, TN_RELATED_BOTH, both, error);
    if (status == TN_OK)
        *relation = relation_of(r->matched[i], r->matched[j], both);
    if (status == TN_OK && r->examples && mpz_cmp(r->matched[i], both) > 0)
        status = count_kind(r, i, j, TN_RELATED_ONLY_A, only, error);
    if (status == TN_OK && r->examples && mpz_cmp(r->matched[j], both) > 0)
        status = count_kind(r, i, j, TN_RELATED_ONLY_B, only, error);
    mpz_clears(both, only, NULL);
    return status;
}

static tn_status relate(relating *r, tn_error *error)
{
    size_t count = r->related->count;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        r->related->relations[i * count + i] = TN_RULES_EQUAL;
        for (size_t j = i + 1; status == TN_OK && j < count; j++) {
            tn_rule_relation relation = TN_RULES_UNKNOWN;
            status = relate_pair(r, i, j, &relation, error);
            if (status == TN_LIMIT && r->unknown++ == 0)
                r->limit = *error;
            status = status == TN_LIMIT ? TN_OK : status;
            r->related->relations[i * count + j] = relation;
            r->related->relations[j * count + i] = turned(relation);
        }
    }
    return status;
}

/* ---- all of it */

static bool make_room(relating *r)
{
    tn_related_houses *related = r->related;
    size_t count = r->n.record->clause_count;
    related->library = tn_text(r->n.form.module, r->n.record->name);
    related->count = count;
    related->names = calloc(count + 1, sizeof *related->names);
    related->relations = calloc(count * count + 1, sizeof *related->relations);
    related->examples = calloc(count * count * TN_RELATED_KINDS + 1, sizeof *related->examples);
    r->matched = tn_integers_new(count);
    r->counted = calloc(count + 1, sizeof *r->counted);
    r->passed = calloc(count + 1, sizeof *r->passed);
    if (!related->names || !related->relations || !related->examples || !r->matched || !r->counted || !r->passed)
        return false;
    for (size_t i = 0; i < count; i++)
        related->names[i] = tn_text(r->n.form.module, clause_of(r, i)->name);
    return true;
}

/* The limit that the first pair passed. */
static void say_unknown(relating *r)
{
    const tn_house_library_record *record = r->n.record;
    tn_span place = {record->file, record->begin, record->end};
    tn_error_help(&r->limit, "--max-states N allows more; a library on plans of fewer trays takes fewer");
    tn_diagnostic *d = tn_finding_limit(&tn_numbered_job(&r->n)->opened, &r->limit, &place);
    tn_note(tn_job_diagnostics(tn_numbered_job(&r->n)), d, NULL, "so %zu of %zu pairs of clauses are not related",
            r->unknown, r->related->count * (r->related->count - 1) / 2);
}

bool tn_job_relate_houses(tn_job *job, const tn_house_settings *settings, bool examples, tn_related_houses *related)
{
    relating r = {.examples = examples, .related = related};
    tn_error error;
    *related = (tn_related_houses){0};
    tn_status status = TN_INVALID;
    if (tn_job_numbered(job, &r.n, settings)) {
        if (!r.n.max_states)
            r.n.max_states = TN_RELATED_STATES;
        status = make_room(&r) ? relate(&r, &error) : tn_fail_memory(&error);
        if (status != TN_OK)
            tn_job_fail(job, &error);
        if (status == TN_OK && r.unknown)
            say_unknown(&r);
    }
    tn_integers_free(r.matched, related->count);
    tn_numbered_close(&r.n);
    free(r.counted);
    free(r.passed);
    return status == TN_OK;
}

void tn_related_houses_clear(tn_related_houses *related)
{
    for (size_t i = 0; related->examples && i < related->count * related->count * TN_RELATED_KINDS; i++)
        free(related->examples[i]);
    free(related->examples);
    free(related->relations);
    free(related->names);
    *related = (tn_related_houses){0};
}
