/* Libraries: clauses that contradict one another, and clauses that change nothing. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/analysis/analysis_clauses.h"
#include "runtime/plan/library/alone.h"

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
        good = tn_key_push(&word, c->analysis->classes->of_tray[plan->trays[k]]);
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
    tn_status status = tn_clauses_library(c, &library, error);
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
    tn_status status = tn_clauses_needed(c, verdicts, error);
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
    tn_status status = tn_clauses_exists(c, parts, 0, SEARCH_WORK, c->count, &asked, &word, found, error);
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
    tn_status status = tn_clauses_library(c, &library, error);
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
