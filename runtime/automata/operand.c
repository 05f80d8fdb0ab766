/* Makes an automaton ready for subset constructions, and drops members that others include. */
#include "runtime/automata/operand.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* Gives each state its phase: the number of markers on the way to it. A live state has only one, since marked words
 * have two markers and the word so far is part of one. */
static bool find_phases(tn_operand *operand)
{
    const tn_dfa *dfa = operand->dfa;
    operand->phase = malloc((size_t)dfa->states + 1);
    uint32_t *order = malloc(((size_t)dfa->states + 1) * sizeof *order);
    if (!operand->phase || !order) {
        free(order);
        return false;
    }
    memset(operand->phase, 0xff, dfa->states);
    if (operand->dead != TN_NO_STATE)
        operand->phase[operand->dead] = 3;
    uint32_t count = 0;
    if (operand->dead != 0) {
        operand->phase[0] = 0;
        order[count++] = 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t c = 0; c < dfa->columns; c++) {
            uint32_t to = tn_operand_read(operand, order[i], c);
            if (operand->phase[to] != 0xff)
                continue;
            operand->phase[to] = (uint8_t)(operand->phase[order[i]] + (c == operand->marker));
            order[count++] = to;
        }
    }
    free(order);
    return true;
}

static uint32_t find_everything(const tn_operand *operand)
{
    const tn_dfa *dfa = operand->dfa;
    for (uint32_t s = 0; s < dfa->states; s++) {
        if (!dfa->accept[s])
            continue;
        uint32_t c = 0;
        while (c < dfa->columns && tn_operand_read(operand, s, c) == (c == operand->marker ? operand->dead : s))
            c++;
        if (c == dfa->columns)
            return s;
    }
    return TN_NO_STATE;
}

tn_status tn_operand_make(tn_operand *operand, const tn_dfa *dfa, tn_error *error)
{
    *operand = (tn_operand){.dfa = dfa, .marker = dfa->column[dfa->letters - 1]};
    operand->dead = tn_dfa_sink(dfa, 0);
    operand->everything = find_everything(operand);
    return find_phases(operand) ? TN_OK : tn_fail_memory(error);
}

void tn_operand_clear(tn_operand *operand)
{
    free(operand->phase);
    free(operand->exceeds);
    free(operand->above_first);
    free(operand->above);
    *operand = (tn_operand){0};
}

/* ---- inclusion */

typedef struct tn_set_comparison {
    tn_operand *operand;
    uint32_t *first;   /* [columns][states + 1] */
    uint32_t *source;  /* [columns][states] */
    uint32_t *pending; /* pairs p * states + q */
    size_t pending_count;
} tn_set_comparison;

static void comparison_invert(tn_set_comparison *comparison)
{
    const tn_dfa *dfa = comparison->operand->dfa;
    uint32_t n = dfa->states;
    for (uint32_t c = 0; c < dfa->columns; c++) {
        uint32_t *first = comparison->first + (size_t)c * (n + 1), *source = comparison->source + (size_t)c * n;
        for (uint32_t s = 0; s < n; s++)
            first[dfa->delta[(size_t)s * dfa->columns + c]]++;
        for (uint32_t s = 0, sum = 0; s <= n; s++) {
            sum += first[s];
            first[s] = sum;
        }
        for (uint32_t s = n; s-- > 0;)
            source[--first[dfa->delta[(size_t)s * dfa->columns + c]]] = s;
    }
}

/* p accepts something that q does not. Pairs of different phases are never asked for, but the dead state goes with
 * every phase. */
static void comparison_add(tn_set_comparison *comparison, uint32_t p, uint32_t q)
{
    tn_operand *operand = comparison->operand;
    if (operand->phase[p] != operand->phase[q] && q != operand->dead)
        return;
    uint64_t *word = &operand->exceeds[(size_t)p * operand->words + q / 64], bit = UINT64_C(1) << (q % 64);
    if (*word & bit)
        return;
    *word |= bit;
    comparison->pending[comparison->pending_count++] = p * operand->dfa->states + q;
}

static void comparison_run(tn_set_comparison *comparison)
{
    const tn_dfa *dfa = comparison->operand->dfa;
    uint32_t n = dfa->states;
    for (uint32_t p = 0; p < n; p++)
        for (uint32_t q = 0; q < n; q++)
            if (dfa->accept[p] && !dfa->accept[q])
                comparison_add(comparison, p, q);
    while (comparison->pending_count > 0) {
        uint32_t pair = comparison->pending[--comparison->pending_count];
        for (uint32_t c = 0; c < dfa->columns; c++) {
            const uint32_t *first = comparison->first + (size_t)c * (n + 1),
                           *source = comparison->source + (size_t)c * n;
            for (uint32_t i = first[pair / n]; i < first[pair / n + 1]; i++)
                for (uint32_t j = first[pair % n]; j < first[pair % n + 1]; j++)
                    comparison_add(comparison, source[i], source[j]);
        }
    }
}

static bool list_above(tn_operand *operand)
{
    uint32_t n = operand->dfa->states;
    size_t count = 0, capacity = 0;
    operand->above_first = malloc(((size_t)n + 1) * sizeof *operand->above_first);
    if (!operand->above_first)
        return false;
    for (uint32_t p = 0; p < n; p++) {
        operand->above_first[p] = (uint32_t)count;
        if (!tn_array_reserve(&operand->above, &capacity, count, n, sizeof *operand->above))
            return false;
        for (uint32_t q = 0; q < n; q++)
            if (q != p && tn_operand_below(operand, p, q))
                operand->above[count++] = q;
    }
    operand->above_first[n] = (uint32_t)count;
    return true;
}

bool tn_operand_compare(tn_operand *operand)
{
    if (operand->compared)
        return true;
    operand->compared = true;
    size_t n = operand->dfa->states, k = operand->dfa->columns;
    if (n > TN_INCLUSION_STATES || (uint64_t)n * n > (UINT64_C(1) << 30) / k)
        return true;
    operand->words = (uint32_t)(n / 64 + 1);
    operand->exceeds = calloc(tn_size_of(n, operand->words), sizeof *operand->exceeds);
    tn_set_comparison comparison = {.operand = operand};
    comparison.first = calloc(k * (n + 1), sizeof *comparison.first);
    comparison.source = malloc(k * n * sizeof *comparison.source);
    comparison.pending = malloc(n * n * sizeof *comparison.pending);
    bool ok = operand->exceeds && comparison.first && comparison.source && comparison.pending;
    if (ok) {
        comparison_invert(&comparison);
        comparison_run(&comparison);
        ok = list_above(operand);
    }
    free(comparison.first);
    free(comparison.source);
    free(comparison.pending);
    return ok;
}

/* ---- sets of pairs */

void tn_pairs_add(tn_pairs *pairs, uint32_t first, uint32_t second)
{
    if (first == pairs->first->dead || (pairs->second && second == pairs->second->dead))
        return;
    if (!tn_array_reserve(&pairs->data, &pairs->capacity, pairs->size, 1, sizeof *pairs->data)) {
        pairs->failed = true;
        return;
    }
    pairs->data[pairs->size++] = (uint64_t)first << 32 | second;
}

static int compare_words(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* More words than this out of their order, and sorting them all is faster than moving each to its place. */
enum { MOVES = 24 };

/* Automata number states as they are met, so that most sets are in order already but for a few pairs. */
static void sort_pairs(uint64_t *data, size_t size)
{
    unsigned moves = 0;
    for (size_t i = 1; i < size; i++) {
        uint64_t pair = data[i];
        if (data[i - 1] <= pair)
            continue;
        if (moves++ == MOVES) {
            qsort(data, size, sizeof *data, compare_words);
            return;
        }
        size_t low = 0, high = i;
        while (low < high) {
            size_t middle = (low + high) / 2;
            if (data[middle] <= pair)
                low = middle + 1;
            else
                high = middle;
        }
        memmove(data + low + 1, data + low, (i - low) * sizeof *data);
        data[low] = pair;
    }
}

static bool pair_below(const tn_pairs *pairs, uint64_t a, uint64_t b)
{
    return tn_operand_below(pairs->first, (uint32_t)(a >> 32), (uint32_t)(b >> 32)) &&
           (!pairs->second || tn_operand_below(pairs->second, (uint32_t)a, (uint32_t)b));
}

/* Keeps the pairs that no other one covers, by comparing pairs. States are minimal, so two different pairs never cover
 * each other. */
static void keep_antichain_by_pairs(tn_pairs *pairs)
{
    size_t kept = 0;
    for (size_t i = 0; i < pairs->size; i++) {
        size_t j = 0;
        while (j < kept && !pair_below(pairs, pairs->data[i], pairs->data[j]))
            j++;
        pairs->effort += j;
        if (j < kept)
            continue;
        size_t rest = 0;
        for (j = 0; j < kept; j++)
            if (!pair_below(pairs, pairs->data[j], pairs->data[i]))
                pairs->data[rest++] = pairs->data[j];
        pairs->effort += kept;
        pairs->data[rest++] = pairs->data[i];
        kept = rest;
    }
    pairs->size = kept;
}

/* A state and those above it: the state itself is number `count`. */
typedef struct tn_above {
    const uint32_t *states;
    uint32_t count;
} tn_above;

static tn_above above(const tn_operand *operand, uint32_t state)
{
    if (!operand || !operand->above_first)
        return (tn_above){0};
    uint32_t first = operand->above_first[state];
    return (tn_above){operand->above + first, operand->above_first[state + 1] - first};
}

/* How many pairs may cover this one, itself among them. */
static uint64_t covers(const tn_pairs *pairs, uint64_t pair)
{
    return ((uint64_t)above(pairs->first, (uint32_t)(pair >> 32)).count + 1) *
           ((uint64_t)above(pairs->second, (uint32_t)pair).count + 1);
}

/* Is a pair that covers this one in the (sorted) set? */
static bool is_covered(const tn_pairs *pairs, uint64_t pair)
{
    tn_above first = above(pairs->first, (uint32_t)(pair >> 32)), second = above(pairs->second, (uint32_t)pair);
    for (uint32_t i = 0; i <= first.count; i++)
        for (uint32_t j = 0; j <= second.count; j++) {
            uint64_t p = i < first.count ? first.states[i] : (uint32_t)(pair >> 32);
            uint64_t other = p << 32 | (j < second.count ? second.states[j] : (uint32_t)pair);
            if (other != pair && bsearch(&other, pairs->data, pairs->size, sizeof other, compare_words))
                return true;
        }
    return false;
}

/* The same by looking each pair's covers up, which is faster where few states are above others. What is dropped stays
 * in the set that is looked through, in `covered`, since a pair that covers it covers what it covers. */
static bool keep_antichain_by_lookup(tn_pairs *pairs)
{
    bool *covered = malloc(pairs->size);
    if (!covered)
        return false;
    for (size_t i = 0; i < pairs->size; i++)
        covered[i] = is_covered(pairs, pairs->data[i]);
    size_t kept = 0;
    for (size_t i = 0; i < pairs->size; i++)
        if (!covered[i])
            pairs->data[kept++] = pairs->data[i];
    pairs->size = kept;
    free(covered);
    return true;
}

/* A look-up is a binary search: about as long as comparing with eight pairs. */
enum { LOOKUP_COST = 8 };

static bool keep_antichain(tn_pairs *pairs)
{
    uint64_t lookups = 0, none = pairs->size;
    for (size_t i = 0; i < pairs->size; i++)
        lookups += covers(pairs, pairs->data[i]);
    if (lookups == none) /* no state is above another, or it is not known */
        return true;
    if (lookups > pairs->size * pairs->size / LOOKUP_COST) {
        keep_antichain_by_pairs(pairs);
        return true;
    }
    pairs->effort += lookups * LOOKUP_COST;
    return keep_antichain_by_lookup(pairs);
}

bool tn_pairs_write(tn_pairs *pairs, tn_key *key)
{
    if (pairs->failed)
        return false;
    sort_pairs(pairs->data, pairs->size);
    size_t count = 0;
    for (size_t i = 0; i < pairs->size; i++)
        if (count == 0 || pairs->data[i] != pairs->data[count - 1])
            pairs->data[count++] = pairs->data[i];
    pairs->size = count;
    if (count > 1) {
        if (!tn_operand_compare(pairs->first) || (pairs->second && !tn_operand_compare(pairs->second)))
            return false;
        if (!keep_antichain(pairs))
            return false;
    }
    for (size_t i = 0; i < pairs->size; i++)
        if (!tn_key_push(key, (uint32_t)(pairs->data[i] >> 32)) || !tn_key_push(key, (uint32_t)pairs->data[i]))
            return false;
    return true;
}

void tn_pairs_clear(tn_pairs *pairs)
{
    free(pairs->data);
    *pairs = (tn_pairs){0};
}
