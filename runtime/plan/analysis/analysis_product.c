/* What many clauses leave of a library's plans when some are left out. Searching asks that anew of hundreds of clauses
 * for each one left out; here products of half of them are shared by all the questions about the other half. */
#include <stdlib.h>

#include "runtime/automata/shortest.h"
#include "runtime/automata/sparse.h"
#include "runtime/base/random.h"
#include "runtime/plan/analysis/analysis_data.h"

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

#define DRAWN 64u /* plans that tell which part to apply next */

/* The letters of each column: those of column c are letters[first[c]] to letters[first[c + 1] - 1]. */
typedef struct column_letters {
    uint32_t *first, *letters;
} column_letters;

static bool list_letters(const tn_sparse *plans, column_letters *l)
{
    l->first = calloc((size_t)plans->columns + 2, sizeof *l->first);
    l->letters = malloc(((size_t)plans->letters + 1) * sizeof *l->letters);
    if (!l->first || !l->letters)
        return false;
    for (uint32_t letter = 0; letter < plans->letters; letter++)
        l->first[plans->column[letter] + 2]++;
    for (uint32_t c = 1; c <= plans->columns; c++)
        l->first[c + 1] += l->first[c];
    for (uint32_t letter = 0; letter < plans->letters; letter++)
        l->letters[l->first[plans->column[letter] + 1]++] = letter;
    return true;
}

static void letters_clear(column_letters *l)
{
    free(l->first);
    free(l->letters);
}

/* A plan of an automaton without cycles, by a random walk. */
static bool draw(const tn_sparse *plans, const column_letters *l, uint64_t number, tn_key *word)
{
    word->size = 0;
    for (uint32_t state = 0;;) {
        size_t first = plans->first[state], edges = plans->first[state + 1] - first;
        uint64_t chance = tn_random64(number, 0, word->size);
        uint64_t way = chance % (edges + plans->accept[state]);
        if (way == edges)
            return true;
        uint32_t column = plans->label[first + way];
        uint32_t letters = l->first[column + 1] - l->first[column];
        if (!tn_key_push(word, l->letters[l->first[column] + (chance >> 32) % letters]))
            return false;
        state = plans->target[first + way];
    }
}

static bool fails(const tn_search_part *part, const tn_key *word)
{
    return tn_dfa_accepts(part->dfa, word->data, word->size) != part->accepts;
}

/* The other part that most of these plans fail; *escapes: does one of them fail none? */
static size_t choose_part(const question *q, size_t count, size_t except, const tn_key *words, size_t drawn,
                          bool *escapes)
{
    size_t best = count, most = 0, failed[DRAWN] = {0};
    for (size_t k = 0; k < count; k++) {
        size_t here = 0;
        for (size_t w = 0; k != except && w < drawn; w++) {
            bool one = fails(&q->parts[k], &words[w]);
            failed[w] += one;
            here += one;
        }
        if (here > most) {
            best = k;
            most = here;
        }
    }
    *escapes = false;
    for (size_t w = 0; w < drawn; w++)
        *escapes = *escapes || failed[w] == 0;
    return best;
}

/* Some plans of those that are left: drawn, or the shortest if there are cycles. *drawn = 0: there is none. */
static tn_status draw_some(const question *q, const tn_sparse *plans, uint32_t max, tn_key *words, size_t *drawn,
                           tn_error *error)
{
    column_letters letters = {0};
    bool found;
    *drawn = 0;
    if (!plans->folded) {
        tn_status status = tn_sparse_shortest(plans, q->min, max, &words[0], &found, error);
        *drawn = status == TN_OK && found;
        return status;
    }
    bool good = list_letters(plans, &letters);
    for (; good && *drawn < DRAWN; ++*drawn)
        good = draw(plans, &letters, *drawn, &words[*drawn]);
    letters_clear(&letters);
    return good ? TN_OK : tn_fail_memory(error);
}

/* Takes from the plans what another part keeps out, the one that most of some plans fail, again and again: few parts
 * are ever applied. *alone: is there a plan that no other part keeps out? */
static tn_status take_apart(question *q, size_t count, size_t i, uint32_t max, tn_sparse **plans, bool *alone,
                            tn_error *error)
{
    tn_status status = apply(q, &q->parts[i], !q->parts[i].accepts, plans, error);
    *alone = false;
    while (status == TN_OK && !*alone && leaves(*plans, q->min)) {
        tn_key words[DRAWN] = {0};
        size_t drawn;
        status = draw_some(q, *plans, max, words, &drawn, error);
        size_t other = status == TN_OK ? choose_part(q, count, i, words, drawn, alone) : count;
        for (size_t w = 0; w < DRAWN; w++)
            free(words[w].data);
        if (status != TN_OK || drawn == 0)
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
