/* Libraries: clauses that contradict one another, and clauses that change nothing. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/analysis/analysis_data.h"

/* Of finding out whether one clause is needed, before all that are left are asked about together. */
#define QUICK_WORK UINT64_C(2000000) /* a few milliseconds */
#define QUICK_CLAUSES 12u

typedef struct work {
    const tn_plan_analysis *analysis;
    tn_plan_analysis *findings; /* the same, to add to; NULL: nothing is added */
    uint32_t index;
    const tn_library_record *record;
    const tn_clause_record *clauses;
    size_t count;
    tn_search_part *parts; /* [count]: what each clause has to answer of a kept plan */
    tn_dfa **dfas;         /* [count] */
    uint64_t max_work;     /* of a search; 0: TN_SEARCH_WORK */
    size_t max_asked;      /* clauses that `exists` may look at together */
} work;

static bool prunes(const work *w, size_t i)
{
    return w->clauses[i].kind == TN_CLAUSE_PRUNE;
}

/* Written in the library itself, not taken over from another one. */
static bool is_own(const work *w, size_t i)
{
    const tn_clause_record *clause = &w->clauses[i];
    return clause->file == w->record->file && clause->begin >= w->record->begin && clause->end <= w->record->end;
}

static tn_status name_clause(const work *w, size_t i, tn_error *error)
{
    tn_error inner = *error;
    tn_fail(error, inner.status, inner.code, "in the clause `%.80s`: %.360s",
            tn_text(w->analysis->schema->module, w->clauses[i].name), inner.message);
    tn_error_help(error, "%s", inner.help);
    error->code_offset = inner.code_offset;
    return inner.status;
}

static tn_status lower_clauses(work *w, tn_error *error)
{
    for (size_t i = 0; i < w->count; i++) {
        tn_status status = tn_lower(w->analysis->lowering, w->clauses[i].holds, &w->dfas[i], error);
        if (status != TN_OK)
            return status == TN_LIMIT ? name_clause(w, i, error) : status;
        w->parts[i] = (tn_search_part){w->dfas[i], !prunes(w, i)};
    }
    return TN_OK;
}

/* ---- plans by what some clauses say of them */

static uint32_t shortest(const work *w, bool lengths)
{
    return lengths || w->record->trays_min == 0 ? w->record->trays_min : 1;
}

static uint32_t longest(const work *w, bool lengths)
{
    return lengths ? w->record->trays_max : UINT32_MAX;
}

static tn_status search(const work *w, const tn_search_part *parts, size_t count, bool lengths, tn_key *word,
                        bool *found, tn_error *error)
{
    return tn_plan_analysis_search(w->analysis, parts, count, shortest(w, lengths), longest(w, lengths), "library",
                                   w->max_work, word, found, error);
}

/* With the clauses that are `in`, and without clause `left_out` (TN_NO_RECORD: with all of them). */
static tn_status search_some(const work *w, const bool *in, size_t left_out, bool lengths, tn_key *word, bool *found,
                             tn_error *error)
{
    tn_search_part *parts = malloc((w->count + 1) * sizeof *parts);
    tn_dfa *all = NULL;
    size_t count = 0;
    if (!parts)
        return tn_fail_memory(error);
    for (size_t i = 0; i < w->count; i++)
        if (in[i] && i != left_out)
            parts[count++] = w->parts[i];
    tn_status status = TN_OK;
    if (count == 0) {
        status = tn_dfa_constant(w->analysis->classes->count, true, &all, error);
        parts[count++] = (tn_search_part){all, true};
    }
    if (status == TN_OK)
        status = search(w, parts, count, lengths, word, found, error);
    tn_dfa_free(all);
    free(parts);
    return status;
}

/* Confirms what every clause but `except` says of a plan that it leaves in. */
static tn_status confirm_some(const work *w, const bool *in, size_t except, tn_shown_plan *plan, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < w->count; i++)
        if (in[i] && i != except)
            status = tn_plan_analysis_confirm(w->analysis, plan, w->clauses[i].holds, !prunes(w, i), error);
    return status;
}

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

/* Is there a plan of the library's lengths that answers all parts as wanted? Asks about `first` alone to begin with,
 * and about another part when a plan fails it: few of them are ever looked at together. Reorders the parts: where there
 * is no such plan, the first `*asked` are reason enough. *word: the shortest such plan; the caller frees its data, also
 * after a failure. */
static tn_status exists(const work *w, tn_search_part *parts, size_t first, size_t *asked, tn_key *word, bool *found,
                        tn_error *error)
{
    *asked = 1;
    tn_search_part part = parts[first];
    parts[first] = parts[0];
    parts[0] = part;
    for (;;) {
        free(word->data);
        *word = (tn_key){0};
        tn_status status = search(w, parts, *asked, true, word, found, error);
        if (status != TN_OK || !*found || !ask_one_more(parts, w->count, asked, word))
            return status;
        if (*asked > w->max_asked)
            return tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "too many clauses to look at one by one");
    }
}

/* ---- empty libraries */

/* Takes out what is not needed for there to be no plan; where that passes a limit all stays, and *why says so. */
static tn_status reduce(const work *w, bool *in, bool lengths, tn_error **why, tn_error *error)
{
    tn_error failure;
    tn_status status = tn_plan_analysis_reduce(w->analysis, w->parts, w->count, shortest(w, lengths),
                                               longest(w, lengths), in, &failure);
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

static tn_status show_without(const work *w, const bool *in, size_t i, bool lengths, tn_shown_plan *plan,
                              tn_error *error)
{
    tn_key word = {0};
    bool found;
    tn_status status = search_some(w, in, i, true, &word, &found, error);
    if (status == TN_OK && !found && !lengths)
        status = search_some(w, in, i, false, &word, &found, error);
    if (status == TN_OK && found)
        status = tn_plan_analysis_show(w->analysis, &word, plan, error);
    free(word.data);
    if (status == TN_OK)
        status = confirm_some(w, in, i, plan, error);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status list_reasons(const work *w, const bool *in, tn_plan_analysis_finding *finding, tn_error *error)
{
    finding->reasons = malloc((w->count + 1) * sizeof *finding->reasons);
    if (!finding->reasons)
        return tn_fail_memory(error);
    for (size_t i = 0; i < w->count; i++) {
        if (!in[i])
            continue;
        tn_status status = show_without(w, in, i, finding->with_lengths, &finding->plans[finding->reason_count], error);
        if (status != TN_OK)
            return status;
        finding->reasons[finding->reason_count++] = (uint32_t)(w->record->clause_first + i);
    }
    return TN_OK;
}

/* `in`: clauses that leave no plan together. */
static tn_status explain_empty(const work *w, bool *in, tn_error *error)
{
    tn_plan_analysis_finding *finding = tn_plan_analysis_add(w->findings, TN_FOUND_EMPTY, w->count);
    if (!finding)
        return tn_fail_memory(error);
    finding->library = w->index;
    tn_key word = {0};
    tn_status status = search_some(w, in, w->count, false, &word, &finding->with_lengths, error);
    free(word.data);
    if (status == TN_LIMIT)
        finding->with_lengths = true;
    else if (status != TN_OK)
        return status;
    status = reduce(w, in, finding->with_lengths, &finding->why, error);
    return status == TN_OK ? list_reasons(w, in, finding, error) : status;
}

/* ---- clauses that change nothing */

/* Is there a plan that this clause alone keeps out? The shortest is *word. */
static tn_status drops_alone(const work *w, size_t i, tn_key *word, bool *alone, tn_error *error)
{
    tn_search_part *parts = malloc(w->count * sizeof *parts);
    if (!parts)
        return tn_fail_memory(error);
    memcpy(parts, w->parts, w->count * sizeof *parts);
    parts[i].accepts = !parts[i].accepts;
    size_t asked;
    tn_status status = exists(w, parts, i, &asked, word, alone, error);
    free(parts);
    return status;
}

/* The other prunes that drop the plan too. */
static tn_status list_droppers(const work *w, size_t i, const tn_key *word, tn_plan_analysis_finding *finding,
                               tn_error *error)
{
    finding->reasons = malloc(w->count * sizeof *finding->reasons);
    if (!finding->reasons)
        return tn_fail_memory(error);
    tn_status status = tn_plan_analysis_confirm(w->analysis, finding->plans, w->clauses[i].holds, true, error);
    for (size_t k = 0; status == TN_OK && k < w->count; k++) {
        if (k == i || !prunes(w, k) || !tn_dfa_accepts(w->dfas[k], word->data, word->size))
            continue;
        finding->reasons[finding->reason_count++] = (uint32_t)(w->record->clause_first + k);
        status = tn_plan_analysis_confirm(w->analysis, finding->plans, w->clauses[k].holds, true, error);
    }
    return status;
}

/* The shortest plan that the library would generate and the prune drops. */
static tn_status show_dropped(const work *w, size_t i, tn_plan_analysis_finding *finding, tn_error *error)
{
    tn_search_part *parts = malloc(w->count * sizeof *parts);
    tn_key word = {0};
    size_t count = 0;
    bool found;
    if (!parts)
        return tn_fail_memory(error);
    for (size_t k = 0; k < w->count; k++)
        if (!prunes(w, k) || k == i)
            parts[count++] = (tn_search_part){w->dfas[k], true};
    tn_status status = search(w, parts, count, true, &word, &found, error);
    if (status == TN_OK && found)
        status = tn_plan_analysis_show(w->analysis, &word, finding->plans, error);
    if (status == TN_OK && found)
        status = list_droppers(w, i, &word, finding, error);
    free(parts);
    free(word.data);
    return status;
}

static tn_status report_idle(const work *w, size_t i, tn_error *error)
{
    tn_plan_analysis_finding *finding =
        tn_plan_analysis_add(w->findings, prunes(w, i) ? TN_FOUND_IDLE_PRUNE : TN_FOUND_IDLE_REQUIRE, 1);
    if (!finding)
        return tn_fail_memory(error);
    finding->library = w->index;
    finding->clause = (uint32_t)(w->record->clause_first + i);
    return prunes(w, i) ? show_dropped(w, i, finding, error) : TN_OK;
}

/* What became of one clause. */
typedef struct verdict {
    tn_status status;
    bool needed;
    tn_error error;
} verdict;

typedef struct trying {
    const work *quick;
    verdict *verdicts;
} trying;

static void try_one(void *context, uint32_t i)
{
    const trying *t = context;
    verdict *own = &t->verdicts[i];
    tn_key word = {0};
    own->needed = true;
    if (is_own(t->quick, i))
        own->status = drops_alone(t->quick, i, &word, &own->needed, &own->error);
    free(word.data);
}

/* Most clauses are needed, and a plan that shows it is found after looking at few others: clause by clause, as far as
 * that is quick. */
static tn_status try_each(const work *w, verdict *verdicts, tn_error *error)
{
    work quick = *w;
    quick.max_work = QUICK_WORK;
    quick.max_asked = QUICK_CLAUSES;
    trying t = {&quick, verdicts};
    return tn_crew_share(w->analysis->crew, (uint32_t)w->count, try_one, &t, error);
}

/* The clauses for which that was not quick, all together. */
static tn_status try_rest(const work *w, verdict *verdicts, tn_error *error)
{
    bool *asked = calloc(w->count + 1, sizeof *asked), *needed = calloc(w->count + 1, sizeof *needed), any = false;
    tn_status status = asked && needed ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < w->count; i++)
        any |= asked[i] = verdicts[i].status == TN_LIMIT;
    if (status == TN_OK && any)
        status = tn_plan_analysis_needed(w->analysis, w->parts, w->count, shortest(w, true), longest(w, true), asked,
                                         needed, error);
    for (size_t i = 0; status == TN_OK && i < w->count; i++)
        if (asked[i])
            verdicts[i] = (verdict){.status = TN_OK, .needed = needed[i]};
    free(asked);
    free(needed);
    return status;
}

/* ---- verdicts found before */

/* What is kept of a library: whether finding its verdicts failed, and else for each clause whether it is needed. */
typedef struct kept_verdicts {
    tn_status status; /* TN_OK or TN_LIMIT */
    tn_error error;   /* of TN_LIMIT */
    uint8_t needed[];
} kept_verdicts;

static size_t kept_size(const work *w)
{
    return sizeof(kept_verdicts) + w->count;
}

/* All that the verdicts depend on. */
static tn_memory_key make_key(const work *w, tn_memory_part *parts)
{
    const uint64_t subject[] = {'v', shortest(w, true), longest(w, true), w->analysis->max_states,
                                w->analysis->max_joint};
    for (size_t i = 0; i < w->count; i++)
        parts[i] = (tn_memory_part){w->dfas[i], (uint32_t)w->parts[i].accepts | (uint32_t)is_own(w, i) << 1};
    return tn_memory_key_make(subject, sizeof subject / sizeof *subject, parts, w->count);
}

static tn_status find_verdicts(const work *w, verdict *verdicts, tn_error *error)
{
    tn_status status = try_each(w, verdicts, error);
    return status == TN_OK ? try_rest(w, verdicts, error) : status;
}

static void keep_verdicts(const work *w, tn_memory_key key, kept_verdicts *kept, const verdict *verdicts,
                          tn_status status, const tn_error *why)
{
    memset(kept, 0, kept_size(w));
    kept->status = status;
    if (status == TN_LIMIT)
        kept->error = *why;
    bool all = status == TN_OK || (status == TN_LIMIT && why->code_offset == TN_NO_OFFSET);
    for (size_t i = 0; all && i < w->count; i++) {
        kept->needed[i] = verdicts[i].needed;
        all = status == TN_LIMIT || verdicts[i].status == TN_OK;
    }
    if (all)
        tn_plan_memory_keep(w->analysis->memory, key, kept, kept_size(w));
}

static tn_status recall_verdicts(const work *w, verdict *verdicts, tn_error *error)
{
    tn_error why = {.code_offset = TN_NO_OFFSET};
    kept_verdicts *kept = malloc(kept_size(w));
    tn_memory_part *parts = malloc((w->count + 1) * sizeof *parts);
    tn_status status = kept && parts ? TN_OK : tn_fail_memory(&why);
    if (status == TN_OK) {
        tn_memory_key key = make_key(w, parts);
        if (tn_plan_memory_find(w->analysis->memory, key, kept, kept_size(w))) {
            status = kept->status;
            why = kept->error;
            for (size_t i = 0; i < w->count; i++)
                verdicts[i] = (verdict){.status = TN_OK, .needed = kept->needed[i]};
        } else {
            status = find_verdicts(w, verdicts, &why);
            keep_verdicts(w, key, kept, verdicts, status, &why);
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
static tn_status count_verdicts(const work *w, verdict *verdicts, bool *known, tn_error *error)
{
    const tn_library *library = w->analysis->library;
    tn_status status = TN_OK;
    mpz_t out, only;
    *known = library && tn_library_record_of(library) == w->record && tn_library_min(library) == shortest(w, true) &&
             tn_library_max(library) == longest(w, true);
    mpz_inits(out, only, NULL);
    for (uint32_t i = 0; *known && status == TN_OK && i < w->count; i++) {
        uint32_t states;
        status = tn_library_effect(library, i, out, only, &states, error);
        verdicts[i] = (verdict){.status = TN_OK, .needed = !is_own(w, i) || mpz_sgn(only) > 0};
        *known = status == TN_OK;
    }
    mpz_clears(out, only, NULL);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status find_idle(const work *w, tn_error *error)
{
    bool known;
    verdict *verdicts = calloc(w->count, sizeof *verdicts);
    if (!verdicts)
        return tn_fail_memory(error);
    tn_status status = count_verdicts(w, verdicts, &known, error);
    if (status == TN_OK && !known)
        status = w->analysis->memory ? recall_verdicts(w, verdicts, error) : find_verdicts(w, verdicts, error);
    for (size_t i = 0; status == TN_OK && i < w->count; i++) {
        status = verdicts[i].status;
        if (status == TN_OK && !verdicts[i].needed)
            status = report_idle(w, i, &verdicts[i].error);
        if (status == TN_LIMIT) {
            name_clause(w, i, &verdicts[i].error);
            status = tn_plan_analysis_give_up(w->findings, TN_NO_RECORD, w->index, &verdicts[i].error, error);
        } else if (status != TN_OK && error) {
            *error = verdicts[i].error;
        }
    }
    free(verdicts);
    return status;
}

/* ---- a library */

static tn_status analyse(work *w, bool *in, tn_error *error)
{
    bool found = false;
    tn_search_part *parts = malloc(w->count * sizeof *parts);
    if (!parts)
        return tn_fail_memory(error);
    memcpy(parts, w->parts, w->count * sizeof *parts);
    size_t asked;
    tn_key word = {0};
    tn_status status = exists(w, parts, 0, &asked, &word, &found, error);
    free(word.data);
    for (size_t p = 0; p < asked; p++)
        for (size_t i = 0; i < w->count; i++)
            in[i] |= parts[p].dfa == w->dfas[i] && parts[p].accepts == w->parts[i].accepts;
    free(parts);
    if (status != TN_OK)
        return status;
    return found ? find_idle(w, error) : explain_empty(w, in, error);
}

static tn_status prepare(work *w, tn_error *error)
{
    w->parts = calloc(w->count + 1, sizeof *w->parts);
    w->dfas = calloc(w->count + 1, sizeof *w->dfas);
    return w->parts && w->dfas ? lower_clauses(w, error) : tn_fail_memory(error);
}

static void work_clear(work *w)
{
    for (size_t i = 0; w->dfas && i < w->count; i++)
        tn_dfa_free(w->dfas[i]);
    free(w->dfas);
    free(w->parts);
}

static tn_status look_at(work *w, tn_error *error)
{
    bool *in = calloc(w->count + 1, sizeof *in);
    tn_error why = {0};
    tn_status status = in ? prepare(w, &why) : tn_fail_memory(&why);
    if (status == TN_OK)
        status = analyse(w, in, &why);
    work_clear(w);
    free(in);
    if (status == TN_LIMIT)
        return tn_plan_analysis_give_up(w->findings, TN_NO_RECORD, w->index, &why, error);
    if (status != TN_OK && error)
        *error = why;
    return status;
}

tn_status tn_plan_analysis_alone(const tn_plan_analysis *analysis, uint32_t library, size_t i, tn_shown_plan *plan,
                                 tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    const tn_library_record *record = &module->LIBRARY_records[library];
    work w = {.analysis = analysis,
              .index = library,
              .record = record,
              .clauses = module->CLAUSE_records + record->clause_first,
              .count = record->clause_count,
              .max_asked = record->clause_count};
    tn_key word = {0};
    bool found = false;
    *plan = (tn_shown_plan){0};
    tn_status status = prepare(&w, error);
    if (status == TN_OK)
        status = drops_alone(&w, i, &word, &found, error);
    if (status == TN_OK && found)
        status = tn_plan_analysis_show(analysis, &word, plan, error);
    for (size_t k = 0; status == TN_OK && found && k < w.count; k++)
        status = tn_plan_analysis_confirm(analysis, plan, w.clauses[k].holds, prunes(&w, k) == (k == i), error);
    free(word.data);
    work_clear(&w);
    return status;
}

tn_status tn_plan_analysis_libraries(tn_plan_analysis *analysis, tn_error *error)
{
    const tn_module *module = analysis->schema->module;
    tn_status status = TN_OK;
    for (uint32_t l = 0; status == TN_OK && l < module->LIBRARY_count; l++) {
        const tn_library_record *record = &module->LIBRARY_records[l];
        work w = {.analysis = analysis,
                  .findings = analysis,
                  .index = l,
                  .record = record,
                  .clauses = module->CLAUSE_records + record->clause_first,
                  .count = record->clause_count,
                  .max_asked = record->clause_count};
        if (record->schema == analysis->schema_index && !(record->flags & TN_IMPORTED) && w.count > 0)
            status = look_at(&w, error);
    }
    return status;
}
