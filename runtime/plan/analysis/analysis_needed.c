/* Clauses of a library that are needed: those that alone keep out some plan of its lengths.
 *
 * Most are, and a short search shows it. What is left over is asked of the library itself, which is then made, or, of
 * many clauses, of products that halves of them share.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/analysis/analysis_clauses.h"
#include "runtime/plan/library/alone.h"

/* Of finding out whether one clause is needed, before all that are left are asked about together. */
#define QUICK_WORK UINT64_C(2000000) /* a few milliseconds */
#define QUICK_CLAUSES 12u

#define FEW_CLAUSES 24u /* what so many alone keep out is made one by one */

/* Written in the library itself, not taken over from another one. */
static bool is_own(const tn_analysed_clauses *c, size_t i)
{
    const tn_clause_record *clause = &c->clauses[i];
    return clause->file == c->record->file && clause->begin >= c->record->begin && clause->end <= c->record->end;
}

/* ---- the library */

/* The one that the analysis was given, where it is this one with its own lengths. */
static const tn_library *given_library(const tn_analysed_clauses *c)
{
    const tn_library *given = c->analysis->library;
    bool same = given && tn_library_record_of(given) == c->record &&
                tn_library_min(given) == tn_clauses_shortest(c, true) &&
                tn_library_max(given) == tn_clauses_longest(c, true);
    return same ? given : NULL;
}

tn_status tn_clauses_library(tn_analysed_clauses *c, const tn_library **library, tn_error *error)
{
    const tn_library_options options = {.max_states = c->analysis->asked_states, .threads = c->analysis->threads};
    tn_status status = TN_OK;
    *library = given_library(c) ? given_library(c) : c->made;
    if (!*library) {
        status = tn_library_new(c->analysis->schema, c->index, &options, &c->made, error);
        *library = c->made;
    }
    return status;
}

/* ---- searching */

/* Moves a part that the plan fails to the first `asked`, those that are asked about. False where it fails none. */
static bool ask_one_more(tn_search_part *parts, size_t count, size_t *asked, const tn_key *word)
{
    for (size_t i = *asked; i < count; i++) {
        if (tn_dfa_accepts(parts[i].dfa, word->data, word->size) == parts[i].accepts)
            continue;
        tn_search_part part = parts[i];
        parts[i] = parts[*asked];
        parts[(*asked)++] = part;
        return true;
    }
    return false;
}

tn_status tn_clauses_exists(const tn_analysed_clauses *c, tn_search_part *parts, size_t first, uint64_t max_work,
                            size_t max_asked, size_t *asked, tn_key *word, bool *found, tn_error *error)
{
    *asked = 1;
    tn_search_part part = parts[first];
    parts[first] = parts[0];
    parts[0] = part;
    for (;;) {
        free(word->data);
        *word = (tn_key){0};
        tn_status status =
            tn_plan_analysis_search(c->analysis, parts, *asked, tn_clauses_shortest(c, true),
                                    tn_clauses_longest(c, true), "library", max_work, word, found, error);
        if (status != TN_OK || !*found || !ask_one_more(parts, c->count, asked, word))
            return status;
        if (*asked > max_asked)
            return tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "too many clauses to look at one by one");
    }
}

/* Is there a plan that this clause alone keeps out? Found quickly, or TN_LIMIT. */
static tn_status drops_alone(const tn_analysed_clauses *c, size_t i, bool *alone, tn_error *error)
{
    tn_search_part *parts = malloc(c->count * sizeof *parts);
    tn_key word = {0};
    size_t asked;
    if (!parts)
        return tn_fail_memory(error);
    memcpy(parts, c->parts, c->count * sizeof *parts);
    parts[i].accepts = !parts[i].accepts;
    tn_status status = tn_clauses_exists(c, parts, i, QUICK_WORK, QUICK_CLAUSES, &asked, &word, alone, error);
    free(parts);
    free(word.data);
    return status;
}

typedef struct trying {
    const tn_analysed_clauses *clauses;
    tn_clause_verdict *verdicts;
} trying;

static void try_one(void *context, uint32_t i)
{
    const trying *t = context;
    tn_clause_verdict *own = &t->verdicts[i];
    own->needed = true;
    if (is_own(t->clauses, i))
        own->status = drops_alone(t->clauses, i, &own->needed, &own->error);
}

/* Clause by clause, as far as that is quick. */
static tn_status try_each(const tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    trying t = {c, verdicts};
    return tn_crew_share(c->analysis->crew, (uint32_t)c->count, try_one, &t, error);
}

/* ---- what is left over */

/* One by one, from what each alone keeps out. */
static tn_status ask_library(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    const tn_library *library;
    tn_status status = tn_clauses_library(c, &library, error);
    for (uint32_t i = 0; status == TN_OK && i < c->count; i++) {
        tn_clause_verdict *verdict = &verdicts[i];
        if (verdict->status != TN_LIMIT)
            continue;
        verdict->status = tn_library_alone_any(library, i, &verdict->needed, &verdict->error);
        if (verdict->status != TN_OK && verdict->status != TN_LIMIT) {
            status = verdict->status;
            if (error)
                *error = verdict->error;
        }
    }
    return status;
}

/* All together. */
static tn_status ask_products(const tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    bool *asked = calloc(c->count + 1, sizeof *asked), *needed = calloc(c->count + 1, sizeof *needed);
    tn_status status = asked && needed ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        asked[i] = verdicts[i].status == TN_LIMIT;
    if (status == TN_OK)
        status = tn_plan_analysis_needed(c->analysis, c->parts, c->count, tn_clauses_shortest(c, true),
                                         tn_clauses_longest(c, true), asked, needed, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        if (asked[i])
            verdicts[i] = (tn_clause_verdict){.status = TN_OK, .needed = needed[i]};
    free(asked);
    free(needed);
    return status;
}

static tn_status find_verdicts(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    size_t left = 0;
    tn_status status = try_each(c, verdicts, error);
    for (size_t i = 0; i < c->count; i++)
        left += verdicts[i].status == TN_LIMIT;
    if (status != TN_OK || left == 0)
        return status;
    return left <= FEW_CLAUSES ? ask_library(c, verdicts, error) : ask_products(c, verdicts, error);
}

/* ---- verdicts found before */

/* What is kept of a library: whether finding its verdicts failed, and else for each clause whether it is needed. */
typedef struct kept_verdicts {
    tn_status status; /* TN_OK or TN_LIMIT */
    tn_error error;   /* of TN_LIMIT */
    uint8_t needed[];
} kept_verdicts;

static size_t kept_size(const tn_analysed_clauses *c)
{
    return sizeof(kept_verdicts) + c->count;
}

/* All that the verdicts depend on. */
static tn_memory_key make_key(const tn_analysed_clauses *c, tn_memory_part *parts)
{
    const uint64_t subject[] = {'v', tn_clauses_shortest(c, true), tn_clauses_longest(c, true), c->analysis->max_states,
                                c->analysis->max_joint};
    for (size_t i = 0; i < c->count; i++)
        parts[i] = (tn_memory_part){c->dfas[i], (uint32_t)c->parts[i].accepts | (uint32_t)is_own(c, i) << 1};
    return tn_memory_key_make(subject, sizeof subject / sizeof *subject, parts, c->count);
}

static void keep_verdicts(const tn_analysed_clauses *c, tn_memory_key key, kept_verdicts *kept,
                          const tn_clause_verdict *verdicts, tn_status status, const tn_error *why)
{
    memset(kept, 0, kept_size(c));
    kept->status = status;
    if (status == TN_LIMIT)
        kept->error = *why;
    bool all = status == TN_OK || (status == TN_LIMIT && why->code_offset == TN_NO_OFFSET);
    for (size_t i = 0; all && i < c->count; i++) {
        kept->needed[i] = verdicts[i].needed;
        all = status == TN_LIMIT || verdicts[i].status == TN_OK;
    }
    if (all)
        tn_plan_memory_keep(c->analysis->memory, key, kept, kept_size(c));
}

static tn_status recall_verdicts(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    tn_error why = {.code_offset = TN_NO_OFFSET};
    kept_verdicts *kept = malloc(kept_size(c));
    tn_memory_part *parts = malloc((c->count + 1) * sizeof *parts);
    tn_status status = kept && parts ? TN_OK : tn_fail_memory(&why);
    if (status == TN_OK) {
        tn_memory_key key = make_key(c, parts);
        if (tn_plan_memory_find(c->analysis->memory, key, kept, kept_size(c))) {
            status = kept->status;
            why = kept->error;
            for (size_t i = 0; i < c->count; i++)
                verdicts[i] = (tn_clause_verdict){.status = TN_OK, .needed = kept->needed[i]};
        } else {
            status = find_verdicts(c, verdicts, &why);
            keep_verdicts(c, key, kept, verdicts, status, &why);
        }
    }
    free(kept);
    free(parts);
    if (status != TN_OK && error)
        *error = why;
    return status;
}

/* Takes the verdicts from the counts of a library that is counted anyway: a clause is needed where it alone keeps out
 * some plan. *known: are all clauses counted? */
static tn_status count_verdicts(const tn_analysed_clauses *c, tn_clause_verdict *verdicts, bool *known, tn_error *error)
{
    const tn_library *library = given_library(c);
    tn_status status = TN_OK;
    mpz_t out, only;
    *known = library != NULL;
    mpz_inits(out, only, NULL);
    for (uint32_t i = 0; *known && status == TN_OK && i < c->count; i++) {
        uint32_t states;
        status = tn_library_effect(library, i, out, only, &states, error);
        verdicts[i] = (tn_clause_verdict){.status = TN_OK, .needed = !is_own(c, i) || mpz_sgn(only) > 0};
        *known = status == TN_OK;
    }
    mpz_clears(out, only, NULL);
    return status == TN_LIMIT ? TN_OK : status;
}

tn_status tn_clauses_needed(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    bool known;
    tn_status status = count_verdicts(c, verdicts, &known, error);
    if (status == TN_OK && !known)
        status = c->analysis->memory ? recall_verdicts(c, verdicts, error) : find_verdicts(c, verdicts, error);
    return status;
}
