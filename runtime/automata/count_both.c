/* Counts the words that two automata agree about, without making the product of the two.
 *
 * Words are followed symbol by symbol from the start: after each symbol there is a number of words for every pair of
 * states that some word of that length leads to. A pair's transitions are worked out when the first word comes to it,
 * all those to one pair as one. Pairs from which an automaton accepts nothing within the length that is left are not
 * entered: the first word that comes to a pair is the shortest, so what is too late for it is too late for all.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/count_pairs.h"
#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

#define TABLE_ENTRIES_MAX (UINT64_C(1) << 22) /* 16 MB, of which only the pages used take memory */
#define SWEEP_LIMBS_MAX (UINT64_C(1) << 25)   /* 256 MB, likewise */
#define NEVER UINT32_MAX
#define NO_ROW SIZE_MAX

typedef struct tn_both_edge {
    uint32_t target;
    mp_limb_t weight; /* symbols that lead there */
} tn_both_edge;

/* Where symbols lead from a state of the first automaton, told apart by what the second one tells apart. */
typedef struct tn_both_step {
    uint32_t target, column; /* of a, and of b */
    uint64_t weight;         /* symbols */
} tn_both_step;

/* A pair of states that words lead to. */
typedef struct tn_both_pair {
    uint32_t p, q;
    uint32_t away;     /* symbols until both may accept, at least; 0: both do */
    size_t first, end; /* its edges; first NO_ROW: not worked out */
} tn_both_pair;

typedef struct tn_both {
    tn_agreement of;
    uint32_t min;
    const char *what;
    tn_bounds *bounds;
    mpz_ptr words;    /* the count */
    uint32_t *away_a; /* [states]: symbols to acceptance, or NEVER */
    uint32_t *away_b;
    uint32_t *table; /* number of a pair + 1, by p and q; NULL: in `numbers` */
    tn_numbering numbers;
    tn_both_pair *pairs;
    uint32_t count;
    size_t capacity;
    size_t *steps_first, *steps_end; /* [states of a]: steps_first NO_ROW: not worked out */
    tn_both_step *steps;
    size_t step_count, step_capacity;
    tn_both_edge *edges;
    size_t edge_count, edge_capacity;
} tn_both;

/* ---- how far away acceptance is */

static bool nearer_a(const tn_both *both, uint32_t state, uint32_t symbols)
{
    const tn_sparse *a = both->of.a;
    for (size_t e = a->first[state]; e < a->first[state + 1]; e++)
        if (both->away_a[a->target[e]] < symbols)
            return true;
    return false;
}

static bool nearer_b(const tn_both *both, uint32_t state, uint32_t symbols)
{
    const uint32_t *row = both->of.b->delta + (size_t)state * both->of.b->columns;
    for (uint32_t c = 0; c < both->of.b->columns; c++)
        if (both->away_b[row[c]] < symbols)
            return true;
    return false;
}

/* Settles, symbol by symbol, the states that are so many symbols away. */
static void find_away(const tn_both *both, uint32_t *away, uint32_t states,
                      bool (*nearer)(const tn_both *, uint32_t, uint32_t))
{
    bool any = true;
    for (uint32_t symbols = 1; any && symbols <= both->of.max; symbols++) {
        any = false;
        for (uint32_t s = 0; s < states; s++) {
            if (away[s] != NEVER || !nearer(both, s, symbols))
                continue;
            away[s] = symbols;
            any = true;
        }
    }
}

static tn_status look_ahead_a(tn_both *both, tn_error *error)
{
    const tn_sparse *a = both->of.a;
    both->away_a = malloc(((size_t)a->states + 1) * sizeof *both->away_a);
    if (!both->away_a)
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < a->states; s++)
        both->away_a[s] = a->accept[s] ? 0 : NEVER;
    find_away(both, both->away_a, a->states, nearer_a);
    return TN_OK;
}

static tn_status look_ahead_b(tn_both *both, tn_error *error)
{
    const tn_dfa *b = both->of.b;
    both->away_b = malloc(((size_t)b->states + 1) * sizeof *both->away_b);
    if (!both->away_b)
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < b->states; s++)
        both->away_b[s] = (b->accept[s] != 0) == both->of.agree ? 0 : NEVER;
    find_away(both, both->away_b, b->states, nearer_b);
    return TN_OK;
}

tn_status tn_agreement_away(const tn_agreement *of, uint32_t **away, tn_error *error)
{
    tn_both both = {.of = *of};
    tn_status status = look_ahead_b(&both, error);
    *away = both.away_b;
    return status;
}

tn_status tn_agreement_make(tn_agreement *of, const uint32_t *sizes, tn_error *error)
{
    if (!tn_splits_make(&of->splits, of->a, of->b))
        return tn_fail_memory(error);
    return tn_column_weights(sizes, of->a->letters, of->splits.column, of->splits.columns, &of->weights, error);
}

void tn_agreement_clear(tn_agreement *of)
{
    tn_splits_clear(&of->splits);
    free(of->weights);
    of->weights = NULL;
}

/* ---- steps of the first automaton */

static tn_status make_steps(tn_both *both, tn_error *error)
{
    both->steps_first = malloc(((size_t)both->of.a->states + 1) * sizeof *both->steps_first);
    both->steps_end = malloc(((size_t)both->of.a->states + 1) * sizeof *both->steps_end);
    for (uint32_t s = 0; both->steps_first && s < both->of.a->states; s++)
        both->steps_first[s] = NO_ROW;
    return both->steps_first && both->steps_end ? TN_OK : tn_fail_memory(error);
}

static bool reserve_steps(tn_both *both)
{
    return tn_array_reserve_from(&both->steps, &both->step_capacity, 1024, both->step_count, both->of.splits.columns,
                                 sizeof *both->steps);
}

/* Adds symbols to a state's steps. What leads to one place by one column mostly lies side by side; what does not makes
 * two steps of one, which changes nothing but time. */
static void add_step(tn_both *both, size_t first, uint32_t target, uint32_t column, uint64_t weight)
{
    size_t count = both->step_count;
    if (weight == 0)
        return;
    for (size_t i = count; i > first && count - i < TN_BOTH_NEAR; i--)
        if (both->steps[i - 1].target == target && both->steps[i - 1].column == column) {
            both->steps[i - 1].weight += weight;
            return;
        }
    both->steps[both->step_count++] = (tn_both_step){target, column, weight};
}

/* Works out the steps of a state of a, at the first pair that has it. */
static bool find_steps(tn_both *both, uint32_t state)
{
    const tn_sparse *a = both->of.a;
    const tn_splits *splits = &both->of.splits;
    if (both->steps_first[state] != NO_ROW)
        return true;
    if (!reserve_steps(both))
        return false;
    size_t first = both->steps_first[state] = both->step_count;
    for (size_t e = a->first[state]; e < a->first[state + 1]; e++)
        for (size_t i = splits->first[a->label[e]]; i < splits->first[a->label[e] + 1]; i++)
            add_step(both, first, a->target[e], splits->splits[i].other, both->of.weights[splits->splits[i].label]);
    both->steps_end[state] = both->step_count;
    return true;
}

/* ---- pairs */

/* The pair's number; UINT32_MAX where out of memory. */
static uint32_t number(tn_both *both, uint32_t p, uint32_t q, uint32_t away)
{
    uint32_t *slot = both->table ? &both->table[(size_t)p * both->of.b->states + q] : NULL;
    uint32_t found = slot ? *slot - 1 : tn_number(&both->numbers, (uint64_t)p << 32 | q);
    if (slot ? *slot != 0 : found < both->count || found == UINT32_MAX)
        return found;
    if (!tn_array_reserve_from(&both->pairs, &both->capacity, 256, both->count, 1, sizeof *both->pairs))
        return UINT32_MAX;
    both->pairs[both->count] = (tn_both_pair){.p = p, .q = q, .away = away, .first = NO_ROW};
    if (slot)
        *slot = both->count + 1;
    return both->count++;
}

static bool reserve_edges(tn_both *both)
{
    return tn_array_reserve_from(&both->edges, &both->edge_capacity, 1024, both->edge_count, both->of.splits.columns,
                                 sizeof *both->edges);
}

/* Adds symbols to the edge to a pair: as add_step. */
static void add_edge(tn_both *both, size_t first, uint32_t target, uint64_t weight)
{
    for (size_t e = both->edge_count; e > first && both->edge_count - e < TN_BOTH_NEAR; e--)
        if (both->edges[e - 1].target == target) {
            both->edges[e - 1].weight += weight;
            return;
        }
    both->edges[both->edge_count++] = (tn_both_edge){target, weight};
}

/* Works out the edges of a pair that words of `length` symbols lead to. */
static bool make_row(tn_both *both, uint32_t pair, uint32_t length)
{
    uint32_t p = both->pairs[pair].p, left = both->of.max - length - 1;
    const uint32_t *row = both->of.b->delta + (size_t)both->pairs[pair].q * both->of.b->columns;
    if (!reserve_edges(both) || !find_steps(both, p))
        return false;
    size_t first = both->edge_count;
    for (size_t i = both->steps_first[p]; i < both->steps_end[p]; i++) {
        const tn_both_step *step = &both->steps[i];
        uint32_t away_a = both->away_a[step->target], away_b = both->away_b[row[step->column]];
        if (away_a > left || away_b > left)
            continue;
        uint32_t target = number(both, step->target, row[step->column], away_b > away_a ? away_b : away_a);
        if (target == UINT32_MAX)
            return false;
        add_edge(both, first, target, step->weight);
    }
    both->pairs[pair].first = first;
    both->pairs[pair].end = both->edge_count;
    return true;
}

/* ---- the walk: states are pairs, in the order of their numbers */

static tn_status edges_of(void *context, uint32_t length, uint32_t pair, tn_walk_seen *seen, void *walk,
                          tn_error *error)
{
    tn_both *both = context;
    size_t before = both->edge_count;
    if (both->pairs[pair].first == NO_ROW && !make_row(both, pair, length))
        return tn_fail_memory(error);
    const tn_both_pair *pairs = both->pairs;
    const tn_both_edge *end = both->edges + pairs[pair].end;
    uint32_t left = both->of.max - length - 1;
    tn_status status = TN_OK;
    for (const tn_both_edge *edge = both->edges + pairs[pair].first; status == TN_OK && edge < end; edge++)
        if (pairs[edge->target].away <= left)
            status = seen(walk, edge->target, &edge->weight, error);
    if (status == TN_OK)
        status = tn_bounds_check(both->bounds, both->what, both->count, 1, both->edge_count - before + 1, error);
    if (status == TN_OK && both->edge_count > both->bounds->max_transitions)
        status = tn_bounds_check(both->bounds, both->what, both->count, UINT32_MAX, 0, error);
    return status;
}

/* Trays that lead from a pair to one where both accept. */
static uint64_t last_symbols(const tn_both *both, uint32_t p, uint32_t q)
{
    const uint32_t *row = both->of.b->delta + (size_t)q * both->of.b->columns;
    uint64_t symbols = 0;
    for (size_t i = both->steps_first[p]; i < both->steps_end[p]; i++)
        if (both->away_a[both->steps[i].target] == 0 && both->away_b[row[both->steps[i].column]] == 0)
            symbols += both->steps[i].weight;
    return symbols;
}

/* Counts the words that end here. The longest are counted from those that are one symbol shorter, by what their last
 * symbol may be: if most words are so long, most pairs are only ever met there, and no edges of theirs are needed. */
static tn_status end_words(void *context, uint32_t length, uint32_t number, void *element, tn_error *error)
{
    tn_both *both = context;
    const tn_both_pair *pair = &both->pairs[number];
    mpz_t value;
    mpz_roinit_n(value, element, (mp_size_t)both->of.limbs);
    if (length >= both->min && pair->away == 0)
        mpz_add(both->words, both->words, value);
    if (length + 1 != both->of.max)
        return TN_OK;
    if (!find_steps(both, pair->p))
        return tn_fail_memory(error);
    mpz_addmul_ui(both->words, value, last_symbols(both, pair->p, pair->q));
    return TN_OK;
}

static const tn_walk_graph graph = {tn_walk_starts_first, edges_of};
TN_WALK_ALGEBRA(algebra, tn_limbs_begin, NULL, tn_limbs_one, tn_limbs_extend, end_words);

static tn_status count_words(tn_both *both, tn_error *error)
{
    const tn_agreement *of = &both->of;
    uint64_t all = (uint64_t)of->a->states * of->b->states;
    tn_layers walk = {0};
    if (of->a->states == 0 || both->away_a[0] > of->max || both->away_b[0] > of->max)
        return TN_OK;
    if (all <= TABLE_ENTRIES_MAX && !(both->table = calloc((size_t)all, sizeof *both->table)))
        return tn_fail_memory(error);
    if (number(both, 0, 0, both->away_a[0] > both->away_b[0] ? both->away_a[0] : both->away_b[0]) == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = tn_walk_begin(&walk, of->max ? of->max - 1 : 0, false, error);
    if (status == TN_OK)
        status = tn_walk_forward(&walk, &graph, both, &algebra, both, of->limbs * sizeof(mp_limb_t), error);
    tn_walk_clear(&walk, &algebra, NULL);
    return status;
}

static void both_clear(tn_both *both)
{
    tn_agreement_clear(&both->of);
    free(both->away_a);
    free(both->away_b);
    free(both->table);
    tn_numbering_clear(&both->numbers);
    free(both->steps_first);
    free(both->steps_end);
    free(both->steps);
    free(both->pairs);
    free(both->edges);
}

/* Counts of so many limbs: from the product. */
static tn_status count_product(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                               uint32_t min, uint32_t max, const char *what, tn_bounds *bounds, mpz_t count,
                               tn_error *error)
{
    tn_sparse *product = NULL;
    tn_status status = tn_sparse_combine(a, b, operation, what, bounds, &product, error);
    if (status == TN_OK)
        status = tn_count_range(product, sizes, min, max, count, bounds->watch, error);
    tn_sparse_free(product);
    return status;
}

/* State by state, where the first automaton has no cycle and all its plans are of min..max trays; *swept: is it so? */
static tn_status try_sweep(const tn_both *both, bool *swept, tn_error *error)
{
    const tn_agreement *of = &both->of;
    tn_status status = TN_OK;
    *swept = false;
    if (!of->a->folded || (uint64_t)of->a->states * of->b->states * of->limbs > SWEEP_LIMBS_MAX)
        return TN_OK;
    uint32_t *shortest = malloc(((size_t)of->a->states + 1) * 2 * sizeof *shortest);
    if (!shortest)
        return tn_fail_memory(error);
    uint32_t *longest = shortest + of->a->states;
    tn_sweep_measure(of->a, shortest, longest);
    *swept = shortest[0] >= both->min && longest[0] <= of->max;
    if (*swept)
        status = tn_sweep_count(of, longest, both->away_b, both->what, both->bounds, both->words, error);
    free(shortest);
    return status;
}

static tn_status walk_pairs(tn_both *both, tn_error *error)
{
    tn_status status = look_ahead_a(both, error);
    if (status == TN_OK)
        status = make_steps(both, error);
    return status == TN_OK ? count_words(both, error) : status;
}

/* Counts pair by pair. */
static tn_status count_pairs(tn_both *both, const uint32_t *sizes, bool *fits, tn_error *error)
{
    tn_agreement *of = &both->of;
    bool swept = false;
    tn_status status = tn_agreement_make(of, sizes, error);
    uint64_t limbs = status == TN_OK ? tn_count_limbs(of->weights, of->splits.columns, of->max) : 0;
    *fits = limbs <= TN_FORWARD_LIMBS_MAX;
    if (status != TN_OK || !*fits)
        return status;
    of->limbs = (size_t)limbs;
    status = look_ahead_b(both, error);
    if (status == TN_OK)
        status = try_sweep(both, &swept, error);
    return status == TN_OK && !swept ? walk_pairs(both, error) : status;
}

/* Pairs that pass the bounds may still make an automaton within them, where that is folded as it is made. */
tn_status tn_count_both(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                        uint32_t min, uint32_t max, const char *what, tn_bounds *bounds, mpz_t count, tn_error *error)
{
    tn_bounds own = *bounds;
    tn_both both = {.of = {.a = a, .b = b, .agree = operation == TN_DFA_AND, .max = max},
                    .min = min,
                    .what = what,
                    .bounds = &own,
                    .words = count};
    bool fits = true;
    mpz_set_ui(count, 0);
    if (min > max || a->states == 0 || (b->states == 1 && (b->accept[0] != 0) != both.of.agree))
        return TN_OK;
    tn_status status = count_pairs(&both, sizes, &fits, error);
    both_clear(&both);
    if ((status == TN_OK && !fits) || (status == TN_LIMIT && a->folded))
        return count_product(a, b, operation, sizes, min, max, what, bounds, count, error);
    *bounds = own;
    return status;
}
