/* Counts the words that two automata agree about, with a row of numbers for each state of the first: one for each state
 * of the second. No pair is looked up, and none has edges of its own.
 *
 * Where the first has no cycle and holds words of the lengths asked about only, its states are taken once each, in
 * their order, in which edges only lead forward: the numbers are of words of whatever length. Otherwise, and to tell
 * lengths apart, they are taken layer by layer (walk.h), as if the row were a polynomial whose powers are the states of
 * the second. The words before one word are counted so, too. */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/count_pairs.h"

#include "runtime/automata/walk.h"
#include "runtime/base/array.h"

#define ROWS_MAX (UINT64_C(1) << 32) /* bytes of a layer: 4 GiB */
#define CHECK_EVERY 1024u            /* states between two looks at the bounds */

/* Where symbols lead from the state in hand, told apart by what the second automaton tells apart. */
typedef struct tn_count_step {
    uint32_t target, column;
    uint64_t weight;
} tn_count_step;

typedef struct tn_count_sweep {
    const tn_agreement *of;
    const uint32_t *longest, *away;
    mp_limb_t *value;     /* [states of a][states of b][limbs]: words that lead there */
    uint8_t *reached;     /* [states of a][states of b]: are there any? */
    tn_count_step *steps; /* of the state in hand */
} tn_count_sweep;

void tn_sweep_measure(const tn_sparse *a, uint32_t *shortest, uint32_t *longest)
{
    for (uint32_t s = a->states; s-- > 0;) {
        shortest[s] = a->accept[s] ? 0 : UINT32_MAX;
        longest[s] = 0;
        for (size_t e = a->first[s]; e < a->first[s + 1]; e++) {
            uint32_t target = a->target[e];
            shortest[s] = shortest[target] + 1 < shortest[s] ? shortest[target] + 1 : shortest[s];
            longest[s] = longest[target] + 1 > longest[s] ? longest[target] + 1 : longest[s];
        }
    }
}

/* Gathers the steps of a state; weights: symbols of each column of the product. What leads to one place by one column
 * mostly lies side by side. */
static uint32_t gather(const tn_agreement *of, const uint64_t *weights, uint32_t state, tn_count_step *steps)
{
    const tn_sparse *a = of->a;
    uint32_t count = 0;
    for (size_t e = a->first[state]; e < a->first[state + 1]; e++)
        for (size_t i = of->splits.first[a->label[e]]; i < of->splits.first[a->label[e] + 1]; i++) {
            tn_count_step next = {a->target[e], of->splits.splits[i].other, weights[of->splits.splits[i].label]};
            uint32_t same = count;
            for (uint32_t k = count; k > 0 && count - k < TN_BOTH_NEAR && same == count; k--)
                if (steps[k - 1].target == next.target && steps[k - 1].column == next.column)
                    same = k - 1;
            if (same < count)
                steps[same].weight += next.weight;
            else if (next.weight > 0)
                steps[count++] = next;
        }
    return count;
}

/* Moves the words of one pair on by a symbol. */
static void move_on(const tn_count_sweep *sweep, uint32_t p, uint32_t q, uint32_t count)
{
    const tn_agreement *of = sweep->of;
    size_t states = of->b->states, limbs = of->limbs;
    const uint32_t *row = of->b->delta + (size_t)q * of->b->columns;
    const mp_limb_t *value = sweep->value + ((size_t)p * states + q) * limbs;
    for (uint32_t i = 0; i < count; i++) {
        const tn_count_step *step = &sweep->steps[i];
        uint32_t to = row[step->column];
        if (sweep->away[to] > sweep->longest[step->target])
            continue;
        size_t pair = (size_t)step->target * states + to;
        sweep->reached[pair] = 1;
        tn_limbs_add(sweep->value + pair * limbs, value, limbs, step->weight);
    }
}

/* Takes one state; returns the steps that took. */
static uint64_t take_state(const tn_count_sweep *sweep, uint32_t p, mpz_t count)
{
    const tn_agreement *of = sweep->of;
    uint32_t states = of->b->states, steps = 0;
    uint64_t work = 0;
    for (uint32_t q = 0; q < states; q++) {
        size_t pair = (size_t)p * states + q;
        if (!sweep->reached[pair])
            continue;
        if (work == 0)
            steps = gather(sweep->of, sweep->of->weights, p, sweep->steps);
        move_on(sweep, p, q, steps);
        work += steps + 1;
        if (!of->a->accept[p] || sweep->away[q] != 0)
            continue;
        mpz_t value;
        mpz_roinit_n(value, sweep->value + pair * of->limbs, (mp_size_t)of->limbs);
        mpz_add(count, count, value);
    }
    return work;
}

static tn_status take_states(const tn_count_sweep *sweep, const char *what, tn_bounds *bounds, mpz_t count,
                             tn_error *error)
{
    uint64_t work = 0;
    for (uint32_t p = 0; p < sweep->of->a->states; p++) {
        work += take_state(sweep, p, count);
        if (p % CHECK_EVERY != 0 && p + 1 < sweep->of->a->states)
            continue;
        tn_status status = tn_bounds_check(bounds, what, 1, 1, work, error);
        if (status != TN_OK)
            return status;
        work = 0;
    }
    return TN_OK;
}

tn_status tn_sweep_count(const tn_agreement *of, const uint32_t *longest, const uint32_t *away, const char *what,
                         tn_bounds *bounds, mpz_t count, tn_error *error)
{
    size_t pairs = (size_t)of->a->states * of->b->states;
    tn_count_sweep sweep = {.of = of,
                            .longest = longest,
                            .away = away,
                            .value = calloc(tn_size_of(pairs, of->limbs) + 1, sizeof *sweep.value),
                            .reached = calloc(pairs + 1, 1),
                            .steps = malloc(((size_t)of->splits.columns + 1) * sizeof *sweep.steps)};
    tn_status status = sweep.value && sweep.reached && sweep.steps ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && of->a->states > 0 && away[0] <= longest[0]) {
        sweep.value[0] = 1;
        sweep.reached[0] = 1;
        status = take_states(&sweep, what, bounds, count, error);
    }
    free(sweep.value);
    free(sweep.reached);
    free(sweep.steps);
    return status;
}

/* ---- by length */

typedef struct tn_sweep_row {
    uint32_t begin, end; /* the states of b that have numbers, from the first to the last */
    mp_limb_t numbers[]; /* [states of b][limbs] */
} tn_sweep_row;

typedef struct tn_row_count {
    const tn_agreement *of;
    uint32_t *away;
    size_t row; /* bytes */
    tn_count_step *steps;
    mpz_t *counts; /* by length */
    const char *what;
    tn_bounds *bounds;
} tn_row_count;

static void row_zero(const void *context, void *row)
{
    const tn_row_count *r = context;
    memset(row, 0, r->row);
    ((tn_sweep_row *)row)->begin = r->of->b->states;
}

static void widen(tn_sweep_row *row, uint32_t state)
{
    row->begin = state < row->begin ? state : row->begin;
    row->end = state >= row->end ? state + 1 : row->end;
}

static tn_status row_one(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const tn_row_count *r = context;
    tn_sweep_row *row = element;
    (void)layer, (void)state, (void)error;
    if (r->away[0] <= r->of->max) {
        widen(row, 0);
        row->numbers[0] = 1;
    }
    return TN_OK;
}

static tn_status row_add(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    const tn_row_count *r = context;
    const tn_count_step *step = edge->label;
    const tn_dfa *b = r->of->b;
    const tn_sweep_row *row = element;
    tn_sweep_row *next = sum;
    size_t limbs = r->of->limbs;
    uint32_t left = r->of->max - edge->layer - 1;
    (void)error;
    for (uint32_t q = row->begin; q < row->end; q++) {
        const mp_limb_t *number = row->numbers + q * limbs;
        uint32_t to = b->delta[(size_t)q * b->columns + step->column];
        if (r->away[to] > left || mpn_zero_p(number, (mp_size_t)limbs))
            continue;
        widen(next, to);
        tn_limbs_add(next->numbers + to * limbs, number, limbs, step->weight);
    }
    return TN_OK;
}

/* count += the words of a row in which b answers as wanted. */
static void add_row(const tn_row_count *r, const tn_sweep_row *row, mpz_t count)
{
    size_t limbs = r->of->limbs;
    for (uint32_t q = row->begin; q < row->end; q++) {
        mpz_t value;
        if (r->away[q] != 0)
            continue;
        mpz_roinit_n(value, row->numbers + q * limbs, (mp_size_t)limbs);
        mpz_add(count, count, value);
    }
}

/* Counts the words that end here. */
static tn_status row_settle(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const tn_row_count *r = context;
    (void)error;
    if (r->of->a->accept[state])
        add_row(r, element, r->counts[layer]);
    return TN_OK;
}

static tn_status row_edges(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                           tn_error *error)
{
    tn_row_count *r = context;
    uint32_t count = gather(r->of, r->of->weights, state, r->steps);
    tn_status status = tn_bounds_check(r->bounds, r->what, 1, 1, count + UINT64_C(1), error);
    (void)layer;
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = seen(walk, r->steps[i].target, &r->steps[i], error);
    return status;
}

static const tn_walk_graph row_graph = {tn_walk_starts_first, row_edges};
TN_WALK_ALGEBRA(row_algebra, row_zero, NULL, row_one, row_add, row_settle);

static tn_status fail_rows(const char *what, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "counting the plans of this %s takes more than %llu MB", what,
            (unsigned long long)(ROWS_MAX >> 20));
    tn_error_help(error, "give fewer trays with --trays");
    return TN_LIMIT;
}

static tn_status count_rows(tn_row_count *r, const tn_walk_graph *graph, const tn_walk_algebra *algebra,
                            tn_error *error)
{
    const tn_agreement *of = r->of;
    tn_layers walk = {0};
    r->row = sizeof(tn_sweep_row) + tn_size_of(tn_size_of(of->b->states, of->limbs), sizeof(mp_limb_t));
    if (r->row > ROWS_MAX / (of->a->states + UINT64_C(1)))
        return fail_rows(r->what, error);
    r->steps = malloc(((size_t)of->splits.columns + 1) * sizeof *r->steps);
    if (!r->steps)
        return tn_fail_memory(error);
    tn_status status = tn_agreement_away(of, &r->away, error);
    if (status == TN_OK)
        status = tn_walk_begin(&walk, of->max, false, error);
    if (status == TN_OK && of->a->states > 0)
        status = tn_walk_forward(&walk, graph, r, algebra, r, r->row, error);
    tn_walk_clear(&walk, algebra, NULL);
    return status;
}

/* Makes the agreement, which `r` points to, and counts. */
static tn_status count_agreement(tn_row_count *r, tn_agreement *of, const uint32_t *sizes, const tn_walk_graph *graph,
                                 const tn_walk_algebra *algebra, tn_error *error)
{
    tn_status status = tn_agreement_make(of, sizes, error);
    uint64_t limbs = status == TN_OK ? tn_count_limbs(of->weights, of->splits.columns, of->max) : 0;
    of->limbs = tn_as_size(limbs);
    if (status == TN_OK)
        status = count_rows(r, graph, algebra, error);
    tn_agreement_clear(of);
    free(r->steps);
    free(r->away);
    return status;
}

tn_status tn_count_both_lengths(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                                uint32_t max, const char *what, tn_bounds *bounds, mpz_t *counts, tn_error *error)
{
    tn_agreement of = {.a = a, .b = b, .agree = operation == TN_DFA_AND, .max = max};
    tn_row_count r = {.of = &of, .counts = counts, .what = what, .bounds = bounds};
    for (uint32_t length = 0; length <= max; length++)
        mpz_set_ui(counts[length], 0);
    return count_agreement(&r, &of, sizes, &row_graph, &row_algebra, error);
}

/* ---- before a word
 *
 * State 0 of this walk is that of the words that begin as the word does; state s + 1 is state s of the first automaton,
 * in words that are before it already. */

#define AS_THE_WORD 0u

typedef struct tn_before_count {
    tn_row_count rows; /* first: the algebra of rows sees it */
    const tn_count_word *word;
    mpz_ptr count;
    uint32_t state;    /* of the first automaton, where the word has led so far */
    uint64_t *lower;   /* [letters]: symbols before that of the word in its next place, */
    uint64_t *weights; /* [letters]: by column of the product, of which there are no more */
} tn_before_count;

/* The state after one more letter; TN_NO_STATE: no word goes on so. */
static uint32_t follow(const tn_sparse *a, uint32_t state, uint32_t letter)
{
    for (size_t e = a->first[state]; e < a->first[state + 1]; e++)
        if (a->label[e] == a->column[letter])
            return a->target[e];
    return TN_NO_STATE;
}

/* Where words lead that leave the word in this place, by a lower symbol. */
static uint32_t gather_lower(tn_before_count *b, uint32_t place)
{
    const tn_agreement *of = b->rows.of;
    memset(b->lower, 0, of->a->letters * sizeof *b->lower);
    memset(b->weights, 0, of->splits.columns * sizeof *b->weights);
    b->word->lower(b->word->context, place, b->lower);
    for (uint32_t letter = 0; letter < of->a->letters; letter++)
        b->weights[of->splits.column[letter]] += b->lower[letter];
    return gather(of, b->weights, b->state, b->rows.steps);
}

/* Goes on as the word does. */
static tn_status edge_as_the_word(tn_before_count *b, uint32_t place, tn_walk_seen *seen, void *walk, tn_error *error)
{
    const tn_agreement *of = b->rows.of;
    uint32_t letter = b->word->letters[place];
    const tn_count_step step = {AS_THE_WORD, of->b->column[letter], 1};
    b->state = follow(of->a, b->state, letter);
    return b->state == TN_NO_STATE ? TN_OK : seen(walk, AS_THE_WORD, &step, error);
}

static tn_status before_edges(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                              tn_error *error)
{
    tn_before_count *b = context;
    const tn_row_count *r = &b->rows;
    uint32_t count = state == AS_THE_WORD ? gather_lower(b, layer) : gather(r->of, r->of->weights, state - 1, r->steps);
    tn_status status = tn_bounds_check(r->bounds, r->what, 1, 1, count + UINT64_C(1), error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = seen(walk, r->steps[i].target + 1, &r->steps[i], error);
    return status == TN_OK && state == AS_THE_WORD ? edge_as_the_word(b, layer, seen, walk, error) : status;
}

/* Counts the words that are as long as the word. */
static tn_status before_settle(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const tn_before_count *b = context;
    (void)error;
    if (layer == b->word->length && state != AS_THE_WORD && b->rows.of->a->accept[state - 1])
        add_row(&b->rows, element, b->count);
    return TN_OK;
}

static const tn_walk_graph before_graph = {tn_walk_starts_first, before_edges};
TN_WALK_ALGEBRA(before_algebra, row_zero, NULL, row_one, row_add, before_settle);

tn_status tn_count_both_before(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const uint32_t *sizes,
                               const tn_count_word *word, const char *what, tn_bounds *bounds, mpz_t count,
                               tn_error *error)
{
    tn_agreement of = {.a = a, .b = b, .agree = operation == TN_DFA_AND, .max = word->length};
    tn_before_count before = {.rows = {.of = &of, .what = what, .bounds = bounds},
                              .word = word,
                              .count = count,
                              .lower = malloc(((size_t)a->letters + 1) * sizeof *before.lower),
                              .weights = malloc(((size_t)a->letters + 1) * sizeof *before.weights)};
    mpz_set_ui(count, 0);
    tn_status status = before.lower && before.weights
                           ? count_agreement(&before.rows, &of, sizes, &before_graph, &before_algebra, error)
                           : tn_fail_memory(error);
    free(before.lower);
    free(before.weights);
    return status;
}
