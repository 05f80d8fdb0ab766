/* Libraries: clauses that contradict one another, and clauses that change nothing. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/analysis/analysis_data.h"
#include "runtime/plan/library/alone.h"

typedef struct tn_analysed_clauses {
    const tn_plan_analysis *analysis;
    tn_plan_analysis *findings; /* the same, to add to */
    uint32_t index;
    const tn_library_record *record;
    const tn_clause_record *clauses;
    size_t count;
    tn_search_part *parts; /* [count]: what each clause has to answer of a kept plan */
    tn_dfa **dfas;         /* [count] */
    tn_lowering *within;   /* of the clauses that compare sums, for plans of the library's lengths; or NULL */
    tn_library *made;      /* the library, where a search took too much and the caller has none; or NULL */
} tn_analysed_clauses;

/* What became of one clause. */
typedef struct tn_clause_verdict {
    tn_status status; /* TN_OK or TN_LIMIT */
    bool needed;      /* it alone keeps out some plan */
    tn_error error;
} tn_clause_verdict;

static inline bool tn_clause_prunes(const tn_analysed_clauses *c, size_t i)
{
    return c->clauses[i].kind == TN_CLAUSE_PRUNE;
}

/* Are its automata of plans of any length? Then plans longer than the library's can be asked about too. */
static inline bool tn_clauses_unbounded(const tn_analysed_clauses *c)
{
    return c->within == NULL;
}

/* Trays of the shortest and the longest plan asked about: of the library, or any. */
static inline uint32_t tn_clauses_shortest(const tn_analysed_clauses *c, bool lengths)
{
    return lengths || c->record->trays_min == 0 ? c->record->trays_min : 1;
}

static inline uint32_t tn_clauses_longest(const tn_analysed_clauses *c, bool lengths)
{
    return lengths ? c->record->trays_max : UINT32_MAX;
}

/* ---- which clauses are needed */

/* What finding out whether one clause is needed may take: by a search over the clauses side by side; by taking apart
 * what the clause keeps out; and the same again, of those that are left then, all together at most so much. What is
 * left after that is asked about together. */
#define SEARCH_ALONE_WORK UINT64_C(100000)
#define SEARCH_ALONE_CLAUSES 12u
#define TAKE_APART_WORK UINT64_C(2000000) /* a few milliseconds */
#define TAKE_APART_MORE UINT64_C(20000000)
#define TAKE_APART_MORE_ALL UINT64_C(40000000)

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

/* The library itself, made by the first who asks where the analysis was not given it. TN_LIMIT (E0802). */
static tn_status clauses_library(tn_analysed_clauses *c, const tn_library **library, tn_error *error)
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

/* Is there a plan of the library's lengths that answers all parts ([count], reordered) as wanted? Asks about `first`
 * alone to begin with, and about another part when a plan fails it: few of them are ever looked at together. Where
 * there is no such plan, the first `*asked` are reason enough. *word: the shortest such plan; the caller frees its
 * data, also after a failure. TN_LIMIT past max_work steps, and past max_asked parts. */
static tn_status clauses_exists(const tn_analysed_clauses *c, tn_search_part *parts, size_t first, uint64_t max_work,
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

typedef struct trying {
    const tn_analysed_clauses *clauses;
    tn_clause_verdict *verdicts;
    uint64_t work; /* of each */
} trying;

/* By a search over all clauses side by side, which finds at once what is near. */
static tn_status search_alone(const tn_analysed_clauses *c, size_t i, bool *alone, tn_error *error)
{
    tn_search_part *parts = malloc(c->count * sizeof *parts);
    tn_key word = {0};
    size_t asked;
    if (!parts)
        return tn_fail_memory(error);
    memcpy(parts, c->parts, c->count * sizeof *parts);
    parts[i].accepts = !parts[i].accepts;
    tn_status status =
        clauses_exists(c, parts, i, SEARCH_ALONE_WORK, SEARCH_ALONE_CLAUSES, &asked, &word, alone, error);
    free(parts);
    free(word.data);
    return status;
}

static void search_one(void *context, uint32_t i)
{
    const trying *t = context;
    tn_clause_verdict *own = &t->verdicts[i];
    if (own->status == TN_LIMIT)
        own->status = search_alone(t->clauses, i, &own->needed, &own->error);
}

/* Is there a plan that this clause alone keeps out? TN_LIMIT if that takes more than the work. */
static void take_one_apart(void *context, uint32_t i)
{
    const trying *t = context;
    const tn_analysed_clauses *c = t->clauses;
    tn_clause_verdict *own = &t->verdicts[i];
    if (own->status == TN_LIMIT)
        own->status = tn_plan_analysis_keeps_out(c->analysis, c->parts, c->count, i, tn_clauses_shortest(c, true),
                                                 tn_clauses_longest(c, true), t->work, &own->needed, &own->error);
}

static size_t count_left(const tn_analysed_clauses *c, const tn_clause_verdict *verdicts)
{
    size_t left = 0;
    for (size_t i = 0; i < c->count; i++)
        left += verdicts[i].status == TN_LIMIT;
    return left;
}

/* Clause by clause, as far as that is quick. Clauses of other libraries are needed, whatever they do here. */
static tn_status try_each(const tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    trying t = {c, verdicts, TAKE_APART_WORK};
    for (size_t i = 0; i < c->count; i++)
        verdicts[i] = (tn_clause_verdict){.status = is_own(c, i) ? TN_LIMIT : TN_OK, .needed = true};
    tn_status status = tn_crew_share(c->analysis->crew, (uint32_t)c->count, search_one, &t, error);
    if (status == TN_OK)
        status = tn_crew_share(c->analysis->crew, (uint32_t)c->count, take_one_apart, &t, error);
    size_t left = count_left(c, verdicts);
    if (status != TN_OK || left == 0)
        return status;
    t.work = TAKE_APART_MORE_ALL / left < TAKE_APART_MORE ? TAKE_APART_MORE_ALL / left : TAKE_APART_MORE;
    return tn_crew_share(c->analysis->crew, (uint32_t)c->count, take_one_apart, &t, error);
}

/* ---- what is left over */

/* One by one, from what each alone keeps out. */
static tn_status ask_library(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    const tn_library *library;
    tn_status status = clauses_library(c, &library, error);
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
    tn_status status = try_each(c, verdicts, error);
    size_t left = count_left(c, verdicts);
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

/* Finds for each clause written in the library itself whether it is needed; of others it says so. verdicts: [count],
 * zeroed. */
static tn_status clauses_needed(tn_analysed_clauses *c, tn_clause_verdict *verdicts, tn_error *error)
{
    bool known;
    tn_status status = count_verdicts(c, verdicts, &known, error);
    if (status == TN_OK && !known)
        status = c->analysis->memory ? recall_verdicts(c, verdicts, error) : find_verdicts(c, verdicts, error);
    return status;
}

/* Of a search that the library itself can answer too, only later. */
#define SEARCH_WORK UINT64_C(40000000) /* a tenth of a second */

#define LONGEST_WITHIN 4096u /* trays, as in tn_library_options.max_length */

static tn_status name_clause(const tn_analysed_clauses *c, size_t i, tn_error *error)
{
    if (!error)
        return TN_LIMIT;
    tn_error inner = *error;
    tn_fail(error, inner.status, inner.code, "in the clause `%.80s`: %.360s",
            tn_text(c->analysis->schema->module, c->clauses[i].name), inner.message);
    tn_error_help(error, "%s", inner.help);
    error->code_offset = inner.code_offset;
    return inner.status;
}

/* A comparison of sums, or what has to be mirrored, may have no automaton for plans of any length: it is made for the
 * library's own. */
static tn_status lower_clause(tn_analysed_clauses *c, size_t i, tn_error *error)
{
    const tn_plan_analysis *analysis = c->analysis;
    bool bounded = false;
    tn_status status = TN_OK;
    if (c->record->trays_max <= LONGEST_WITHIN)
        status = tn_plan_analysis_needs_length(analysis->schema->module, c->clauses[i].holds, &bounded, error);
    if (status == TN_OK && bounded && !c->within) {
        status = tn_lowering_new(analysis->classes, analysis->max_states, &c->within, error);
        if (status == TN_OK)
            tn_lowering_within(c->within, c->record->trays_max);
    }
    if (status != TN_OK)
        return status;
    return tn_lower(bounded ? c->within : analysis->lowering, c->clauses[i].holds, &c->dfas[i], error);
}

static tn_status lower_clauses(tn_analysed_clauses *c, tn_error *error)
{
    for (size_t i = 0; i < c->count; i++) {
        tn_status status = lower_clause(c, i, error);
        if (status != TN_OK)
            return status == TN_LIMIT ? name_clause(c, i, error) : status;
        c->parts[i] = (tn_search_part){c->dfas[i], !tn_clause_prunes(c, i)};
    }
    return TN_OK;
}

/* ---- plans by what some clauses say of them */

static tn_status search(const tn_analysed_clauses *c, const tn_search_part *parts, size_t count, bool lengths,
                        tn_key *word, bool *found, tn_error *error)
{
    return tn_plan_analysis_search(c->analysis, parts, count, tn_clauses_shortest(c, lengths),
                                   tn_clauses_longest(c, lengths), "library", 0, word, found, error);
}

/* With the clauses that are `in`, and without clause `left_out` (TN_NO_RECORD: with all of them). */
static tn_status search_some(const tn_analysed_clauses *c, const bool *in, size_t left_out, bool lengths, tn_key *word,
                             bool *found, tn_error *error)
{
    tn_search_part *parts = malloc((c->count + 1) * sizeof *parts);
    tn_dfa *all = NULL;
    size_t count = 0;
    if (!parts)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->count; i++)
        if (in[i] && i != left_out)
            parts[count++] = c->parts[i];
    tn_status status = TN_OK;
    if (count == 0) {
        status = tn_dfa_constant(c->analysis->classes->count, true, &all, error);
        parts[count++] = (tn_search_part){all, true};
    }
    if (status == TN_OK)
        status = search(c, parts, count, lengths, word, found, error);
    tn_dfa_free(all);
    free(parts);
    return status;
}

/* Confirms what every clause but `except` says of a plan that it leaves in. */
static tn_status confirm_some(const tn_analysed_clauses *c, const bool *in, size_t except, tn_shown_plan *plan,
                              tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        if (in[i] && i != except)
            status = tn_plan_analysis_confirm(c->analysis, plan, c->clauses[i].holds, !tn_clause_prunes(c, i), error);
    return status;
}

/* ---- empty libraries */

/* Takes out what is not needed for there to be no plan of the library's lengths; where that passes a limit all stays,
 * and *why says so. */
static tn_status reduce(const tn_analysed_clauses *c, bool *in, tn_error **why, tn_error *error)
{
    tn_error failure;
    tn_status status = tn_plan_analysis_reduce(c->analysis, c->parts, c->count, tn_clauses_shortest(c, true),
                                               tn_clauses_longest(c, true), in, &failure);
    if (status == TN_LIMIT) {
        *why = malloc(sizeof **why);
        if (!*why)
            return tn_fail_memory(error);
        **why = failure;
        return TN_OK;
    }
    if (status != TN_OK && error)
        *error = failure;
    return status;
}

static tn_status show_without(const tn_analysed_clauses *c, const bool *in, size_t i, tn_shown_plan *plan,
                              tn_error *error)
{
    tn_key word = {0};
    bool found;
    tn_status status = search_some(c, in, i, true, &word, &found, error);
    if (status == TN_OK && found)
        status = tn_plan_analysis_show(c->analysis, &word, plan, error);
    free(word.data);
    if (status == TN_OK)
        status = confirm_some(c, in, i, plan, error);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status list_reasons(const tn_analysed_clauses *c, const bool *in, tn_plan_analysis_finding *finding,
                              tn_error *error)
{
    finding->reasons = malloc((c->count + 1) * sizeof *finding->reasons);
    if (!finding->reasons)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->count; i++) {
        if (!in[i])
            continue;
        tn_status status = show_without(c, in, i, &finding->plans[finding->reason_count], error);
        if (status != TN_OK)
            return status;
        finding->reasons[finding->reason_count++] = (uint32_t)(c->record->clause_first + i);
    }
    return TN_OK;
}

/* `in`: clauses that leave no plan together. */
static tn_status explain_empty(const tn_analysed_clauses *c, bool *in, tn_error *error)
{
    tn_plan_analysis_finding *finding = tn_plan_analysis_add(c->findings, TN_FOUND_EMPTY, c->count);
    if (!finding)
        return tn_fail_memory(error);
    finding->library = c->index;
    tn_key word = {0};
    tn_status status = reduce(c, in, &finding->why, error);
    finding->with_lengths = true;
    if (status == TN_OK && tn_clauses_unbounded(c))
        status = search_some(c, in, c->count, false, &word, &finding->with_lengths, error);
    free(word.data);
    if (status == TN_LIMIT) {
        finding->with_lengths = true;
        status = TN_OK;
    }
    return status == TN_OK ? list_reasons(c, in, finding, error) : status;
}

/* ---- clauses that change nothing */

/* The other prunes that drop the plan too. */
static tn_status list_droppers(const tn_analysed_clauses *c, size_t i, tn_plan_analysis_finding *finding,
                               tn_error *error)
{
    const tn_shown_plan *plan = finding->plans;
    tn_key word = {0};
    bool good = true;
    finding->reasons = malloc(c->count * sizeof *finding->reasons);
    for (size_t k = 0; good && k < plan->length; k++)
        good = tn_key_push(&word, tn_class_of(c->analysis->classes, plan->trays[k]));
    tn_status status = good && finding->reasons ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_plan_analysis_confirm(c->analysis, finding->plans, c->clauses[i].holds, true, error);
    for (size_t k = 0; status == TN_OK && k < c->count; k++) {
        if (k == i || !tn_clause_prunes(c, k) || !tn_dfa_accepts(c->dfas[k], word.data, word.size))
            continue;
        finding->reasons[finding->reason_count++] = (uint32_t)(c->record->clause_first + k);
        status = tn_plan_analysis_confirm(c->analysis, finding->plans, c->clauses[k].holds, true, error);
    }
    free(word.data);
    return status;
}

/* The shortest plan that the library would generate and the prune drops, by searching. */
static tn_status search_dropped(const tn_analysed_clauses *c, size_t i, tn_shown_plan *plan, tn_error *error)
{
    tn_search_part *parts = malloc(c->count * sizeof *parts);
    tn_key word = {0};
    size_t count = 0;
    bool found;
    if (!parts)
        return tn_fail_memory(error);
    for (size_t k = 0; k < c->count; k++)
        if (!tn_clause_prunes(c, k) || k == i)
            parts[count++] = (tn_search_part){c->dfas[k], true};
    tn_status status =
        tn_plan_analysis_search(c->analysis, parts, count, tn_clauses_shortest(c, true), tn_clauses_longest(c, true),
                                "library", SEARCH_WORK, &word, &found, error);
    if (status == TN_OK && found)
        status = tn_plan_analysis_show(c->analysis, &word, plan, error);
    free(parts);
    free(word.data);
    return status;
}

/* The same from the library. */
static tn_status ask_dropped(tn_analysed_clauses *c, size_t i, tn_shown_plan *plan, tn_error *error)
{
    const tn_library *library;
    bool found;
    tn_status status = clauses_library(c, &library, error);
    if (status == TN_OK)
        status = tn_library_pruned_shortest(library, (uint32_t)i, &plan->trays, &plan->length, &found, error);
    plan->shown = status == TN_OK && found;
    return status;
}

static tn_status show_dropped(tn_analysed_clauses *c, size_t i, tn_plan_analysis_finding *finding, tn_error *error)
{
    tn_status status = search_dropped(c, i, finding->plans, error);
    if (status == TN_LIMIT)
        status = ask_dropped(c, i, finding->plans, error);
    return status == TN_OK && finding->plans->shown ? list_droppers(c, i, finding, error) : status;
}

static tn_status report_idle(tn_analysed_clauses *c, size_t i, tn_error *error)
{
    tn_plan_analysis_finding *finding =
        tn_plan_analysis_add(c->findings, tn_clause_prunes(c, i) ? TN_FOUND_IDLE_PRUNE : TN_FOUND_IDLE_REQUIRE, 1);
    if (!finding)
        return tn_fail_memory(error);
    finding->library = c->index;
    finding->clause = (uint32_t)(c->record->clause_first + i);
    return tn_clause_prunes(c, i) ? show_dropped(c, i, finding, error) : TN_OK;
}

static tn_status find_idle(tn_analysed_clauses *c, tn_error *error)
{
    tn_clause_verdict *verdicts = calloc(c->count, sizeof *verdicts);
    if (!verdicts)
        return tn_fail_memory(error);
    tn_status status = clauses_needed(c, verdicts, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++) {
        status = verdicts[i].status;
        if (status == TN_OK && !verdicts[i].needed)
            status = report_idle(c, i, &verdicts[i].error);
        if (status == TN_LIMIT) {
            name_clause(c, i, &verdicts[i].error);
            status = tn_plan_analysis_give_up(c->findings, TN_NO_RECORD, c->index, &verdicts[i].error, error);
        } else if (status != TN_OK && error) {
            *error = verdicts[i].error;
        }
    }
    free(verdicts);
    return status;
}

/* ---- a library */

/* Does it hold any plan? *in: clauses that are reason enough, where it does not. */
static tn_status find_plan(tn_analysed_clauses *c, bool *in, bool *found, tn_error *error)
{
    tn_search_part *parts = malloc(c->count * sizeof *parts);
    tn_key word = {0};
    size_t asked;
    if (!parts)
        return tn_fail_memory(error);
    memcpy(parts, c->parts, c->count * sizeof *parts);
    tn_status status = clauses_exists(c, parts, 0, SEARCH_WORK, c->count, &asked, &word, found, error);
    for (size_t p = 0; p < asked; p++)
        for (size_t i = 0; i < c->count; i++)
            in[i] |= parts[p].dfa == c->dfas[i] && parts[p].accepts == c->parts[i].accepts;
    free(parts);
    free(word.data);
    return status;
}

/* The same from the library. */
static tn_status ask_plan(tn_analysed_clauses *c, bool *in, bool *found, tn_error *error)
{
    const tn_library *library;
    mpz_t kept;
    mpz_init(kept);
    tn_status status = clauses_library(c, &library, error);
    if (status == TN_OK)
        tn_library_kept(library, TN_ALL_LENGTHS, kept);
    *found = mpz_sgn(kept) > 0;
    mpz_clear(kept);
    for (size_t i = 0; i < c->count; i++)
        in[i] = true;
    return status;
}

static tn_status analyse(tn_analysed_clauses *c, bool *in, tn_error *error)
{
    bool found = false;
    tn_status status = find_plan(c, in, &found, error);
    if (status == TN_LIMIT)
        status = ask_plan(c, in, &found, error);
    if (status != TN_OK)
        return status;
    return found ? find_idle(c, error) : explain_empty(c, in, error);
}

static tn_status prepare(tn_analysed_clauses *c, tn_error *error)
{
    c->parts = calloc(c->count + 1, sizeof *c->parts);
    c->dfas = calloc(c->count + 1, sizeof *c->dfas);
    return c->parts && c->dfas ? lower_clauses(c, error) : tn_fail_memory(error);
}

static void clauses_clear(tn_analysed_clauses *c)
{
    for (size_t i = 0; c->dfas && i < c->count; i++)
        tn_dfa_free(c->dfas[i]);
    tn_library_free(c->made);
    tn_lowering_free(c->within);
    free(c->dfas);
    free(c->parts);
}

static tn_status look_at(tn_analysed_clauses *c, tn_error *error)
{
    bool *in = calloc(c->count + 1, sizeof *in);
    tn_error why = {0};
    tn_status status = in ? prepare(c, &why) : tn_fail_memory(&why);
    if (status == TN_OK)
        status = analyse(c, in, &why);
    clauses_clear(c);
    free(in);
    if (status == TN_LIMIT)
        return tn_plan_analysis_give_up(c->findings, TN_NO_RECORD, c->index, &why, error);
    if (status != TN_OK && error)
        *error = why;
    return status;
}

tn_status tn_plan_analysis_alone(const tn_plan_analysis *analysis, const tn_library *library, uint32_t i,
                                 tn_shown_plan *plan, tn_error *error)
{
    const tn_library_record *record = tn_library_record_of(library);
    *plan = (tn_shown_plan){0};
    tn_status status = tn_library_alone_shortest(library, i, &plan->trays, &plan->length, &plan->shown, error);
    for (uint32_t k = 0; status == TN_OK && plan->shown && k < record->clause_count; k++) {
        const tn_clause_record *clause = &analysis->schema->module->CLAUSE_records[record->clause_first + k];
        bool expected = (clause->kind == TN_CLAUSE_PRUNE) == (k == i);
        status = tn_plan_analysis_confirm(analysis, plan, clause->holds, expected, error);
    }
    return status;
}

tn_status tn_plan_analysis_libraries(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    tn_status status = TN_OK;
    for (uint32_t l = 0; status == TN_OK && l < module->LIBRARY_count; l++) {
        const tn_library_record *record = &module->LIBRARY_records[l];
        tn_analysed_clauses c = {.analysis = analysis,
                                 .findings = analysis,
                                 .index = l,
                                 .record = record,
                                 .clauses = module->CLAUSE_records + record->clause_first,
                                 .count = record->clause_count};
        if (record->schema == analysis->schema_index && !(record->flags & TN_IMPORTED) && c.count > 0)
            status = look_at(&c, error);
    }
    return status;
}
