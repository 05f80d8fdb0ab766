/* Puts a library's clauses in a row, and asks what the others leave where some decide otherwise. */
#include "runtime/plan/library/others.h"

#include <stdlib.h>

#include "runtime/plan/library/drawn.h"

#define APART_SHARE 16u               /* of the steps of an answer: what is tried first */
#define ANSWERS_WORK_PER_STATE 20000u /* steps for all clauses together: of a million states under a minute */

bool tn_others_bounded(const tn_library *library)
{
    return library->within || library->generator->folded;
}

/* Of plans of any length what is tried before it is asked within the lengths. */
static tn_bounds row_bounds(const tn_library *library, bool within)
{
    tn_bounds bounds = tn_library_bounds(library);
    if (!within && library->max_eager < bounds.max_work)
        bounds.max_work = library->max_eager;
    return bounds;
}

/* All clauses have an equal share, so that an answer does not depend on which is asked first. */
static tn_bounds each_bounds(const tn_library *library, bool within)
{
    tn_bounds bounds = row_bounds(library, within);
    uint64_t share = (uint64_t)ANSWERS_WORK_PER_STATE * bounds.max_states / (library->applied_count + 1);
    if (share < bounds.max_work)
        bounds.max_work = share;
    return bounds;
}

/* ---- making */

static tn_status save(tn_others *others, size_t to, tn_bounds *bounds, tn_error *error)
{
    const tn_library *library = others->library;
    for (size_t i = 0; i < library->applied_count; i++) {
        size_t clause = others->order[i];
        others->sequence.clauses[i] =
            (tn_sequence_clause){library->clauses[clause], tn_library_keeping(library, clause)};
    }
    return tn_sequence_save(&others->sequence, to, bounds, error);
}

/* Totals come first, since they bound the plans; then the other requirements; then the prunes, as the library applies
 * them. Returns how many totals there are. */
static size_t list_clauses(tn_others *others)
{
    const tn_library *library = others->library;
    size_t count = library->applied_count, totals = 0, next;
    for (size_t i = 0; i < library->required_count; i++)
        if (tn_library_clause(library, library->applied[i])->kind == TN_CLAUSE_TOTAL)
            others->order[totals++] = library->applied[i];
    next = totals;
    for (size_t i = 0; i < count; i++)
        if (tn_library_clause(library, library->applied[i])->kind != TN_CLAUSE_TOTAL)
            others->order[next++] = library->applied[i];
    return totals;
}

static void find_places(tn_others *others)
{
    for (size_t i = 0; i < others->library->record->clause_count; i++)
        others->place[i] = SIZE_MAX;
    for (size_t i = 0; i < others->library->applied_count; i++)
        others->place[others->order[i]] = i;
}

/* What the totals leave tells how the other requirements are ordered. */
static tn_status make_sequence(tn_others *others, tn_error *error)
{
    const tn_library *library = others->library;
    tn_sequence *sequence = &others->sequence;
    size_t count = library->applied_count, totals = list_clauses(others);
    tn_bounds bounds = others->bounds;
    tn_sparse *all = NULL;
    tn_status status = tn_library_everything(library, others->within, &all, error);
    if (status == TN_OK)
        status = tn_sequence_make(sequence, count, all, others->within ? "library, of its lengths alone," : "library",
                                  error);
    if (status == TN_OK && count)
        status = save(others, totals < count ? totals : count - 1, &bounds, error);
    if (status == TN_OK)
        status = tn_library_order(library, sequence->after[sequence->saved], others->order + totals,
                                  library->required_count - totals, error);
    if (status == TN_OK && count)
        status = save(others, count - 1, &bounds, error);
    find_places(others);
    return status == TN_OK ? tn_sequence_make_runs(sequence, &others->bounds, error) : status;
}

tn_status tn_others_make(const tn_library *library, bool within, const tn_others **out, tn_error *error)
{
    tn_kept_others *kept = &library->late->others[within];
    if (kept->made) {
        if (kept->status != TN_OK && error)
            *error = kept->error;
        *out = kept->others;
        return kept->status;
    }
    tn_others *others = calloc(1, sizeof *others);
    if (!others)
        return tn_fail_memory(error);
    *others = (tn_others){.library = library,
                          .within = within,
                          .bounds = row_bounds(library, within),
                          .each = each_bounds(library, within)};
    others->order = malloc((library->applied_count + 1) * sizeof *others->order);
    others->place = malloc(((size_t)library->record->clause_count + 1) * sizeof *others->place);
    tn_status status =
        others->order && others->place ? make_sequence(others, &kept->error) : tn_fail_memory(&kept->error);
    if (status != TN_OK) {
        tn_others_free(others);
        others = NULL;
    }
    if (status != TN_OK && error)
        *error = kept->error;
    kept->made = status == TN_OK || status == TN_LIMIT;
    kept->status = status;
    *out = kept->others = others;
    return status;
}

void tn_others_free(tn_others *others)
{
    if (!others)
        return;
    tn_sequence_clear(&others->sequence);
    free(others->order);
    free(others->place);
    free(others);
}

/* ---- asking */

/* What leaves of some plans those that a clause keeps out. */
static tn_dfa_operation dropping(const tn_sequence_clause *clause)
{
    return clause->keeping == TN_DFA_AND ? TN_DFA_MINUS : TN_DFA_AND;
}

/* *plans := those that the clauses before this one keep, and it does not. */
static tn_status turn_round(const tn_others *others, size_t number, tn_bounds *bounds, tn_sparse **plans,
                            tn_error *error)
{
    const tn_sequence *sequence = &others->sequence;
    const tn_sequence_clause *clause = &sequence->clauses[number];
    tn_status status = tn_sequence_before(sequence, number, bounds, plans, error);
    if (status == TN_OK)
        status = tn_sparse_apply(plans, clause->dfa, dropping(clause), sequence->what, bounds, error);
    return status;
}

tn_status tn_others_alone(const tn_others *others, size_t number, tn_sparse **plans, tn_error *error)
{
    tn_bounds bounds = others->each;
    *plans = NULL;
    tn_status status = turn_round(others, number, &bounds, plans, error);
    if (status == TN_OK)
        status = tn_sequence_apply(&others->sequence, number + 1, &bounds, plans, error);
    if (status != TN_OK) {
        tn_sparse_free(*plans);
        *plans = NULL;
    }
    return status;
}

/* How many plans of the library's lengths both `plans` and dfa accept, or only `plans`. */
static tn_status count_with(const tn_others *others, const tn_sparse *plans, const tn_dfa *dfa,
                            tn_dfa_operation operation, mpz_t count, tn_error *error)
{
    const tn_library *library = others->library;
    tn_bounds bounds = others->each;
    return tn_count_both(plans, dfa, operation, library->classes->size, library->min, library->max,
                         others->sequence.what, &bounds, count, error);
}

/* Counts what of the plans the clauses from a number on keep; uses the plans up. */
static tn_status count_rest(const tn_others *others, size_t from, tn_bounds *bounds, tn_sparse **plans, mpz_t count,
                            tn_error *error)
{
    const tn_library *library = others->library;
    tn_bounds last = others->each;
    mpz_set_ui(count, 0);
    if (from == others->sequence.count)
        return tn_count_range(*plans, library->classes->size, library->min, library->max, count,
                              library->schema->module->watch, error);
    return tn_sequence_count(&others->sequence, from, library->classes->size, library->min, library->max, bounds, &last,
                             plans, count, error);
}

/* ---- taken apart: most clauses of many keep out by themselves little or nothing, and a few others show that */

/* The clause not applied yet that most of some plans fail; the sequence's count: they fail none. */
static size_t choose_clause(const tn_sequence *sequence, const bool *applied, const tn_drawn_plans *drawn)
{
    size_t best = sequence->count;
    int most = 0;
    for (size_t k = 0; k < sequence->count; k++) {
        const tn_sequence_clause *clause = &sequence->clauses[k];
        if (applied[k])
            continue;
        int failing = __builtin_popcountll(tn_drawn_plans_failing(drawn, clause->dfa, clause->keeping == TN_DFA_AND));
        if (failing > most) {
            best = k;
            most = failing;
        }
    }
    return best;
}

/* Leaves of the plans those that all clauses keep which are not applied: while there are any, first the one that most
 * of some plans fail. */
static tn_status take_apart(const tn_sequence *sequence, bool *applied, tn_bounds *bounds, tn_sparse **plans,
                            tn_error *error)
{
    tn_status status = TN_OK;
    bool chosen = true;
    for (size_t next = 0; status == TN_OK && (*plans)->states > 0 && next < sequence->count;) {
        size_t clause = sequence->count;
        tn_drawn_plans drawn;
        if (chosen) {
            status = tn_drawn_plans_make(*plans, &drawn, error);
            clause = status == TN_OK ? choose_clause(sequence, applied, &drawn) : clause;
            chosen = clause < sequence->count;
            tn_drawn_plans_clear(&drawn);
        }
        while (!chosen && next < sequence->count && applied[next])
            next++;
        clause = chosen ? clause : next;
        if (status != TN_OK || clause == sequence->count)
            break;
        applied[clause] = true;
        status = tn_sparse_apply(plans, sequence->clauses[clause].dfa, sequence->clauses[clause].keeping,
                                 sequence->what, bounds, error);
    }
    return status;
}

/* As tn_others_count_alone, from the plans that the clause does not keep. TN_LIMIT: that takes much. */
static tn_status count_taken_apart(const tn_others *others, size_t number, mpz_t count, tn_error *error)
{
    const tn_library *library = others->library;
    const tn_sequence *sequence = &others->sequence;
    tn_bounds bounds = others->each;
    bool *applied = calloc(sequence->count + 1, sizeof *applied);
    tn_sparse *plans = NULL;
    bounds.max_work /= APART_SHARE;
    tn_status status = applied ? tn_library_everything(library, true, &plans, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_sparse_apply(&plans, sequence->clauses[number].dfa, dropping(&sequence->clauses[number]),
                                 sequence->what, &bounds, error);
    if (status == TN_OK) {
        applied[number] = true;
        status = take_apart(sequence, applied, &bounds, &plans, error);
    }
    if (status == TN_OK)
        status = tn_count_range(plans, library->classes->size, library->min, library->max, count,
                                library->schema->module->watch, error);
    tn_sparse_free(plans);
    free(applied);
    return status;
}

tn_status tn_others_count_alone(const tn_others *others, size_t number, mpz_t count, tn_error *error)
{
    const tn_sequence *sequence = &others->sequence;
    const tn_sequence_clause *clause = &sequence->clauses[number];
    tn_bounds bounds = others->each;
    tn_sparse *plans = NULL;
    tn_status status = count_taken_apart(others, number, count, error);
    if (status != TN_LIMIT)
        return status;
    if (number + 1 == sequence->count) {
        status = tn_sequence_before(sequence, number, &bounds, &plans, error);
        if (status == TN_OK)
            status = count_with(others, plans, clause->dfa, dropping(clause), count, error);
    } else {
        status = turn_round(others, number, &bounds, &plans, error);
        if (status == TN_OK)
            status = count_rest(others, number + 1, &bounds, &plans, count, error);
    }
    tn_sparse_free(plans);
    return status;
}

/* *left := what of the plans the clauses keep that are not skipped, up to the last one that is. *end: the number behind
 * that. */
static tn_status keep_to_skipped(const tn_others *others, const bool *skipped, const tn_dfa *plans, tn_bounds *bounds,
                                 tn_sparse **left, size_t *end, tn_error *error)
{
    const tn_sequence *sequence = &others->sequence;
    size_t first = sequence->count;
    *end = 0;
    for (size_t i = 0; i < sequence->count; i++) {
        if (!skipped[others->order[i]])
            continue;
        first = i < first ? i : first;
        *end = i + 1;
    }
    tn_status status = tn_sequence_before(sequence, first, bounds, left, error);
    if (status == TN_OK)
        status = tn_sparse_apply(left, plans, TN_DFA_AND, sequence->what, bounds, error);
    for (size_t i = first; status == TN_OK && i < *end; i++)
        if (!skipped[others->order[i]])
            status = tn_sparse_apply(left, sequence->clauses[i].dfa, sequence->clauses[i].keeping, sequence->what,
                                     bounds, error);
    if (*end <= first)
        *end = sequence->count;
    return status;
}

tn_status tn_others_left(const tn_others *others, const bool *skipped, const tn_dfa *plans, tn_sparse **left,
                         tn_error *error)
{
    tn_bounds bounds = others->each;
    size_t end;
    *left = NULL;
    tn_status status = keep_to_skipped(others, skipped, plans, &bounds, left, &end, error);
    if (status == TN_OK)
        status = tn_sequence_apply(&others->sequence, end, &bounds, left, error);
    if (status != TN_OK) {
        tn_sparse_free(*left);
        *left = NULL;
    }
    return status;
}

tn_status tn_others_count(const tn_others *others, const bool *skipped, const tn_dfa *plans, mpz_t count,
                          tn_error *error)
{
    tn_bounds bounds = others->each;
    tn_sparse *left = NULL;
    size_t end;
    tn_status status = keep_to_skipped(others, skipped, plans, &bounds, &left, &end, error);
    if (status == TN_OK)
        status = count_rest(others, end, &bounds, &left, count, error);
    tn_sparse_free(left);
    return status;
}
