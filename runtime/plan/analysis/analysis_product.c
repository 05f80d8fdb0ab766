/* What many clauses leave of a library's plans when some are left out. Searching asks that anew of hundreds of clauses
 * for each one left out; here products of half of them are shared by all the questions about the other half. */
#include <stdlib.h>

#include "runtime/automata/shortest.h"
#include "runtime/automata/sparse.h"
#include "runtime/plan/analysis/analysis_data.h"
#include "runtime/plan/library/drawn.h"

#define WORK_PER_STATE 300u /* as libraries are combined */

typedef struct question {
    const tn_search_part *parts;
    uint32_t min;
    tn_bounds bounds; /* of all products together */
    const bool *asked;
    bool *answer;
} question;

/* The plans of these lengths. */
static tn_status everything(const tn_plan_analysis *analysis, uint32_t min, uint32_t max, tn_sparse **out,
                            tn_error *error)
{
    if (max != UINT32_MAX)
        return tn_sparse_words(analysis->classes->count, min, max, out, error);
    tn_dfa *all = NULL;
    tn_status status = tn_dfa_constant(analysis->classes->count, true, &all, error);
    if (status == TN_OK)
        status = tn_sparse_make(all, 0, out, error);
    tn_dfa_free(all);
    return status;
}

/* Is any plan left, of so many trays at least? */
static bool leaves(const tn_sparse *plans, uint32_t min)
{
    return plans->states > 0 && (plans->first[1] > 0 || (min == 0 && plans->accept[0]));
}

static tn_status copy(const tn_sparse *plans, tn_sparse **out, tn_error *error)
{
    return tn_sparse_minimise(plans, out, error);
}

/* *plans := those of them that the part answers so. */
static tn_status apply(question *q, const tn_search_part *part, bool accepts, tn_sparse **plans, tn_error *error)
{
    return tn_sparse_apply(plans, part->dfa, accepts ? TN_DFA_AND : TN_DFA_MINUS, "library", &q->bounds, error);
}

/* A copy of the plans that the asked parts of [low, high) leave. */
static tn_status apply_range(question *q, const tn_sparse *plans, const bool *in, size_t low, size_t high,
                             tn_sparse **out, tn_error *error)
{
    tn_status status = copy(plans, out, error);
    for (size_t i = low; status == TN_OK && i < high && leaves(*out, q->min); i++)
        if (in[i])
            status = apply(q, &q->parts[i], q->parts[i].accepts, out, error);
    return status;
}

static bool any_in(const bool *in, size_t low, size_t high)
{
    while (low < high && !in[low])
        low++;
    return low < high;
}

/* ---- reasons for there being no plan */

/* Junker, QuickXplain: preferred explanations and relaxations for over-constrained problems, AAAI 2004. Marks in
 * `answer` what of [low, high) it takes to leave none of these plans; `added` says whether anything was applied to them
 * since that was last asked. */
static tn_status find_reasons(question *q, const tn_sparse *plans, bool added, size_t low, size_t high, tn_error *error)
{
    if ((added && !leaves(plans, q->min)) || !any_in(q->asked, low, high))
        return TN_OK;
    if (high - low == 1) {
        q->answer[low] = true;
        return TN_OK;
    }
    size_t middle = low + (high - low) / 2;
    tn_sparse *rest = NULL;
    tn_status status = apply_range(q, plans, q->asked, low, middle, &rest, error);
    if (status == TN_OK)
        status = find_reasons(q, rest, any_in(q->asked, low, middle), middle, high, error);
    tn_sparse_free(rest);
    rest = NULL;
    if (status == TN_OK)
        status = apply_range(q, plans, q->answer, middle, high, &rest, error);
    if (status == TN_OK)
        status = find_reasons(q, rest, any_in(q->answer, middle, high), low, middle, error);
    tn_sparse_free(rest);
    return status;
}

/* ---- what one part keeps out */

/* The other part that most of these plans fail; *escapes: does one of them fail none? */
static size_t choose_part(const question *q, size_t count, size_t except, const tn_drawn_plans *drawn, bool *escapes)
{
    size_t best = count;
    int most = 0;
    uint64_t failed = 0, all = drawn->count < 64 ? (UINT64_C(1) << drawn->count) - 1 : UINT64_MAX;
    for (size_t k = 0; k < count; k++) {
        if (k == except)
            continue;
        uint64_t here = tn_drawn_plans_failing(drawn, q->parts[k].dfa, q->parts[k].accepts);
        failed |= here;
        if (__builtin_popcountll(here) > most) {
            best = k;
            most = __builtin_popcountll(here);
        }
    }
    *escapes = failed != all;
    return best;
}

/* Some plans of those that are left: drawn, or the shortest if there are cycles. */
static tn_status draw_some(const question *q, const tn_sparse *plans, uint32_t max, tn_drawn_plans *drawn,
                           tn_error *error)
{
    if (plans->folded)
        return tn_drawn_plans_make(plans, drawn, error);
    bool found;
    *drawn = (tn_drawn_plans){0};
    tn_status status = tn_sparse_shortest(plans, q->min, max, &drawn->plans[0], &found, error);
    drawn->count = status == TN_OK && found;
    return status;
}

/* Takes from the plans what another part keeps out, the one that most of some plans fail, again and again: few parts
 * are ever applied. *alone: is there a plan that no other part keeps out? */
static tn_status take_apart(question *q, size_t count, size_t i, uint32_t max, tn_sparse **plans, bool *alone,
                            tn_error *error)
{
    tn_status status = apply(q, &q->parts[i], !q->parts[i].accepts, plans, error);
    *alone = false;
    while (status == TN_OK && !*alone && leaves(*plans, q->min)) {
        tn_drawn_plans drawn;
        status = draw_some(q, *plans, max, &drawn, error);
        size_t other = choose_part(q, count, i, &drawn, alone);
        bool any = drawn.count > 0;
        tn_drawn_plans_clear(&drawn);
        if (status != TN_OK || !any)
            return status;
        if (!*alone)
            status = apply(q, &q->parts[other], q->parts[other].accepts, plans, error);
    }
    return status;
}

/* ---- parts that alone keep a plan out */

/* `plans` are those that all parts but [low, high) leave. */
static tn_status find_alone(question *q, const tn_sparse *plans, const bool *all, size_t low, size_t high,
                            tn_error *error)
{
    if (!leaves(plans, q->min) || !any_in(q->asked, low, high))
        return TN_OK;
    tn_sparse *rest = NULL;
    if (high - low == 1) {
        tn_status status = copy(plans, &rest, error);
        if (status == TN_OK)
            status = apply(q, &q->parts[low], !q->parts[low].accepts, &rest, error);
        q->answer[low] = status == TN_OK && leaves(rest, q->min);
        tn_sparse_free(rest);
        return status;
    }
    size_t middle = low + (high - low) / 2;
    tn_status status = apply_range(q, plans, all, middle, high, &rest, error);
    if (status == TN_OK)
        status = find_alone(q, rest, all, low, middle, error);
    tn_sparse_free(rest);
    rest = NULL;
    if (status == TN_OK)
        status = apply_range(q, plans, all, low, middle, &rest, error);
    if (status == TN_OK)
        status = find_alone(q, rest, all, middle, high, error);
    tn_sparse_free(rest);
    return status;
}

/* ---- asking */

static question ask(const tn_plan_analysis *analysis, const tn_search_part *parts, uint32_t min, const bool *asked,
                    bool *answer)
{
    tn_bounds bounds = tn_bounds_make(analysis->max_joint);
    bounds.max_work = (uint64_t)analysis->max_joint * WORK_PER_STATE;
    bounds.watch = analysis->schema->module->watch;
    return (question){.parts = parts, .min = min, .bounds = bounds, .asked = asked, .answer = answer};
}

tn_status tn_plan_analysis_reduce(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                  uint32_t min, uint32_t max, bool *in, tn_error *error)
{
    bool *reasons = calloc(count + 1, sizeof *reasons);
    if (!reasons)
        return tn_fail_memory(error);
    question q = ask(analysis, parts, min, in, reasons);
    tn_sparse *plans = NULL;
    tn_status status = everything(analysis, min, max, &plans, error);
    if (status == TN_OK)
        status = find_reasons(&q, plans, true, 0, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        in[i] = reasons[i];
    tn_sparse_free(plans);
    free(reasons);
    return status;
}

tn_status tn_plan_analysis_keeps_out(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                     size_t i, uint32_t min, uint32_t max, uint64_t max_work, bool *alone,
                                     tn_error *error)
{
    question q = ask(analysis, parts, min, NULL, NULL);
    q.bounds.max_work = max_work;
    tn_sparse *plans = NULL;
    tn_status status = everything(analysis, min, max, &plans, error);
    if (status == TN_OK)
        status = take_apart(&q, count, i, max, &plans, alone, error);
    tn_sparse_free(plans);
    return status;
}

tn_status tn_plan_analysis_needed(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                  uint32_t min, uint32_t max, const bool *asked, bool *alone, tn_error *error)
{
    bool *all = calloc(count + 1, sizeof *all);
    if (!all)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        all[i] = true;
    question q = ask(analysis, parts, min, asked, alone);
    tn_sparse *plans = NULL;
    tn_status status = everything(analysis, min, max, &plans, error);
    if (status == TN_OK)
        status = find_alone(&q, plans, all, 0, count, error);
    tn_sparse_free(plans);
    free(all);
    return status;
}
