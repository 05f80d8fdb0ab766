/* Applies clauses one after another, and keeps what many questions about them need again. */
#include "runtime/plan/library/sequence.h"

#include <stdlib.h>

#define SAVED_EDGES (UINT64_C(1) << 24) /* of the automata kept for starting from: 128 MB */
#define RUN_STATES 100u                 /* of what a run of clauses keeps: more states save no more work (measured) */
#define RUN_CELLS (UINT64_C(1) << 23)   /* of all runs' tables: 32 MB */

tn_status tn_sequence_make(tn_sequence *sequence, size_t count, tn_sparse *all, const char *what, tn_error *error)
{
    *sequence = (tn_sequence){.count = count,
                              .clauses = calloc(count + 1, sizeof *sequence->clauses),
                              .after = calloc(count + 1, sizeof *sequence->after),
                              .runs = calloc(count + 1, sizeof *sequence->runs),
                              .what = what};
    if (!sequence->clauses || !sequence->after || !sequence->runs) {
        tn_sparse_free(all);
        return tn_fail_memory(error);
    }
    sequence->after[0] = all;
    return TN_OK;
}

void tn_sequence_clear(tn_sequence *sequence)
{
    for (size_t i = 0; sequence->after && i <= sequence->saved; i++)
        tn_sparse_free(sequence->after[i]);
    for (size_t i = 0; sequence->runs && i < sequence->count; i++)
        tn_dfa_free(sequence->runs[i].keeps);
    free(sequence->clauses);
    free(sequence->after);
    free(sequence->runs);
    *sequence = (tn_sequence){0};
}

static tn_status apply_one(const tn_sequence *sequence, size_t number, tn_bounds *bounds, tn_sparse **base,
                           tn_error *error)
{
    const tn_sequence_clause *clause = &sequence->clauses[number];
    return tn_sparse_apply(base, clause->dfa, clause->keeping, sequence->what, bounds, error);
}

tn_status tn_sequence_save(tn_sequence *sequence, size_t to, tn_bounds *bounds, tn_error *error)
{
    tn_status status = TN_OK;
    uint64_t edges = 0;
    for (size_t i = 0; i <= sequence->saved; i++)
        edges += sequence->after[i]->first[sequence->after[i]->states];
    while (status == TN_OK && sequence->saved < to && edges <= SAVED_EDGES) {
        tn_sparse *next = NULL;
        status = tn_sparse_copy(sequence->after[sequence->saved], &next, error);
        if (status == TN_OK && next->states > 0)
            status = apply_one(sequence, sequence->saved, bounds, &next, error);
        if (status != TN_OK) {
            tn_sparse_free(next);
            break;
        }
        sequence->after[++sequence->saved] = next;
        edges += next->first[next->states];
    }
    return status;
}

/* ---- runs */

/* *plans := every plan of any length. */
static tn_status begin_run(const tn_sequence *sequence, tn_sparse **plans, tn_error *error)
{
    tn_dfa *all = NULL;
    tn_sparse_free(*plans);
    *plans = NULL;
    tn_status status = tn_dfa_constant(sequence->after[0]->letters, true, &all, error);
    if (status == TN_OK)
        status = tn_sparse_make(all, 0, plans, error);
    tn_dfa_free(all);
    return status;
}

/* *plans := what of them one more clause keeps; *fits: is that small? */
static tn_status lengthen(const tn_sequence *sequence, size_t number, const tn_bounds *bounds, tn_sparse **plans,
                          bool *fits, tn_error *error)
{
    tn_bounds own = *bounds;
    tn_status status = apply_one(sequence, number, &own, plans, error);
    *fits = status == TN_OK && (*plans)->states > 0 && (*plans)->states <= RUN_STATES;
    return status == TN_LIMIT ? TN_OK : status;
}

/* From the last clause to the first: where a run gets too large, another begins. */
tn_status tn_sequence_make_runs(tn_sequence *sequence, const tn_bounds *bounds, tn_error *error)
{
    tn_sparse *plans = NULL;
    uint64_t cells = 0;
    size_t end = sequence->count;
    tn_status status = begin_run(sequence, &plans, error);
    for (size_t i = sequence->count; status == TN_OK && i-- > 0 && cells <= RUN_CELLS;) {
        bool fits;
        status = lengthen(sequence, i, bounds, &plans, &fits, error);
        for (int again = 0; status == TN_OK && !fits && again < 2; again++) {
            end = i + !again; /* with the clause alone, or, if that is too large, without it */
            status = begin_run(sequence, &plans, error);
            if (status == TN_OK && !again)
                status = lengthen(sequence, i, bounds, &plans, &fits, error);
        }
        if (status != TN_OK || !fits || end < i + 2)
            continue;
        sequence->runs[i].end = end;
        status = tn_sparse_fill(plans, &sequence->runs[i].keeps, error);
        cells += (uint64_t)plans->states * plans->columns;
    }
    tn_sparse_free(plans);
    return status;
}

/* ---- questions */

tn_status tn_sequence_before(const tn_sequence *sequence, size_t number, tn_bounds *bounds, tn_sparse **base,
                             tn_error *error)
{
    size_t from = number < sequence->saved ? number : sequence->saved;
    tn_status status = tn_sparse_copy(sequence->after[from], base, error);
    for (size_t i = from; status == TN_OK && i < number && (*base)->states > 0; i++)
        status = apply_one(sequence, i, bounds, base, error);
    return status;
}

/* Applies the run that begins at *number, or, where it has none or that passes a limit, the clause; *number: the next.
 */
static tn_status apply_run(const tn_sequence *sequence, size_t *number, tn_bounds *bounds, tn_sparse **base,
                           tn_error *error)
{
    const tn_clause_run *run = &sequence->runs[*number];
    tn_status status = TN_LIMIT;
    if (run->keeps)
        status = tn_sparse_apply(base, run->keeps, TN_DFA_AND, sequence->what, bounds, error);
    if (run->keeps && status != TN_LIMIT) {
        *number = run->end;
        return status;
    }
    return apply_one(sequence, (*number)++, bounds, base, error);
}

tn_status tn_sequence_apply(const tn_sequence *sequence, size_t from, tn_bounds *bounds, tn_sparse **base,
                            tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = from; status == TN_OK && i < sequence->count && (*base)->states > 0;)
        status = apply_run(sequence, &i, bounds, base, error);
    return status;
}

tn_status tn_sequence_count(const tn_sequence *sequence, size_t from, const uint32_t *sizes, uint32_t min, uint32_t max,
                            tn_bounds *bounds, const tn_bounds *last, tn_sparse **base, mpz_t count, tn_error *error)
{
    tn_status status = TN_OK;
    size_t i = from;
    while (status == TN_OK && (*base)->states > 0) {
        const tn_clause_run *run = &sequence->runs[i];
        tn_bounds own = *last;
        if (run->keeps && run->end == sequence->count)
            status = tn_count_both(*base, run->keeps, TN_DFA_AND, sizes, min, max, sequence->what, &own, count, error);
        else if (i + 1 == sequence->count)
            return tn_count_both(*base, sequence->clauses[i].dfa, sequence->clauses[i].keeping, sizes, min, max,
                                 sequence->what, &own, count, error);
        else
            status = TN_LIMIT; /* not the last */
        if (status != TN_LIMIT)
            return status;
        status = run->keeps && run->end == sequence->count ? apply_one(sequence, i++, bounds, base, error)
                                                           : apply_run(sequence, &i, bounds, base, error);
    }
    return status;
}
