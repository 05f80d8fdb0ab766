/* Keeps complete automata: products, complements, joined columns. */
#include "runtime/automata/dfa.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

tn_bounds tn_bounds_make(uint32_t max_states)
{
    return (tn_bounds){.max_states = max_states,
                       .max_transitions = UINT64_C(1) << 26,
                       .max_words = UINT64_C(1) << 26,
                       .max_work = UINT64_C(2000000000)};
}

tn_status tn_bounds_check(tn_bounds *bounds, const char *what, uint64_t states, uint64_t columns, uint64_t work,
                          tn_error *error)
{
    bounds->work += work;
    if (tn_watch_stopped(bounds->watch))
        return tn_fail_stopped(bounds->watch, error);
    tn_status status = TN_OK;
    if (states > bounds->max_states)
        status = tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "the automaton of this %s passes the limit of %u states",
                         what, bounds->max_states);
    else if (states * columns > bounds->max_transitions)
        status = tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
                         "the automaton of this %s passes the limit of %llu transitions at %llu states", what,
                         (unsigned long long)bounds->max_transitions, (unsigned long long)states);
    else if (bounds->work > bounds->max_work)
        status = tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
                         "the automaton of this %s takes more than %llu steps to build; it had %llu states by then",
                         what, (unsigned long long)bounds->max_work, (unsigned long long)states);
    if (status != TN_OK)
        tn_error_help(error,
                      states > bounds->max_states ? "raise it with --max-states" : "split the rule into smaller ones");
    return status;
}

tn_dfa *tn_dfa_new(uint32_t letters, uint32_t columns, uint32_t states)
{
    uint64_t transitions = (uint64_t)states * columns, words = letters + transitions;
    tn_dfa *dfa = words < TN_SIZE_MOST / 8 ? calloc(1, sizeof *dfa + (size_t)words * sizeof(uint32_t) + states) : NULL;
    if (!dfa)
        return NULL;
    dfa->uses = 1;
    dfa->letters = letters;
    dfa->columns = columns;
    dfa->states = states;
    dfa->column = (uint32_t *)(dfa + 1);
    dfa->delta = dfa->column + letters;
    dfa->accept = (uint8_t *)(dfa->delta + transitions);
    return dfa;
}

tn_dfa *tn_dfa_share(tn_dfa *dfa)
{
    dfa->uses++;
    return dfa;
}

void tn_dfa_free(tn_dfa *dfa)
{
    if (dfa && --dfa->uses == 0)
        free(dfa);
}

uint32_t tn_dfa_sink(const tn_dfa *dfa, uint8_t accepting)
{
    for (uint32_t s = 0; s < dfa->states; s++) {
        if (dfa->accept[s] != accepting)
            continue;
        const uint32_t *row = dfa->delta + (size_t)s * dfa->columns;
        uint32_t c = 0;
        while (c < dfa->columns && row[c] == s)
            c++;
        if (c == dfa->columns)
            return s;
    }
    return TN_NO_STATE;
}

bool tn_dfa_equal(const tn_dfa *a, const tn_dfa *b)
{
    return a->letters == b->letters && a->columns == b->columns && a->states == b->states &&
           memcmp(a->column, b->column, a->letters * sizeof *a->column) == 0 &&
           memcmp(a->delta, b->delta, (size_t)a->states * a->columns * sizeof *a->delta) == 0 &&
           memcmp(a->accept, b->accept, a->states) == 0;
}

tn_status tn_dfa_constant(uint32_t letters, bool everything, tn_dfa **out, tn_error *error)
{
    *out = tn_dfa_new(letters, 1, 1);
    if (!*out)
        return tn_fail_memory(error);
    (*out)->accept[0] = everything;
    return TN_OK;
}

tn_status tn_dfa_complement(const tn_dfa *dfa, tn_dfa **out, tn_error *error)
{
    tn_dfa *copy = tn_dfa_new(dfa->letters, dfa->columns, dfa->states);
    if (!copy)
        return tn_fail_memory(error);
    memcpy(copy->column, dfa->column, dfa->letters * sizeof *dfa->column);
    memcpy(copy->delta, dfa->delta, (size_t)dfa->states * dfa->columns * sizeof *dfa->delta);
    for (uint32_t s = 0; s < dfa->states; s++)
        copy->accept[s] = !dfa->accept[s];
    *out = copy;
    return TN_OK;
}

/* ---- joining columns */

/* Refines the columns found so far by what `next` says of each letter. */
static bool refine(uint32_t *column, uint32_t letters, const uint32_t *next, uint32_t *count)
{
    tn_numbering pairs = {0};
    bool ok = true;
    for (uint32_t l = 0; l < letters && ok; l++) {
        column[l] = tn_number(&pairs, (uint64_t)column[l] << 32 | next[l]);
        ok = column[l] != UINT32_MAX;
    }
    *count = pairs.count;
    tn_numbering_clear(&pairs);
    return ok;
}

static bool join_columns(tn_join *join, const tn_dfa *const *parts, const uint32_t *extra)
{
    for (uint32_t p = 0; p < join->parts; p++)
        if (!refine(join->column, join->letters, parts[p]->column, &join->columns))
            return false;
    return !extra || refine(join->column, join->letters, extra, &join->columns);
}

/* The last letter shares its column with others: gives it a new one. It comes last, so the order of first letters
 * holds. */
static void join_apart(tn_join *join)
{
    uint32_t last = join->letters - 1;
    for (uint32_t l = 0; l < last; l++) {
        if (join->column[l] != join->column[last])
            continue;
        join->column[last] = join->columns++;
        return;
    }
}

tn_status tn_join_make(tn_join *join, const tn_dfa *const *parts, uint32_t count, uint32_t letters,
                       const uint32_t *extra, bool apart, tn_error *error)
{
    *join = (tn_join){.letters = letters, .parts = count, .columns = letters > 0};
    join->column = calloc(letters + 1, sizeof *join->column);
    if (!join->column || !join_columns(join, parts, extra))
        return tn_fail_memory(error);
    if (apart && letters > 0)
        join_apart(join);
    join->pick = calloc(tn_size_of(join->columns, count) + 1, sizeof *join->pick);
    join->letter = calloc((size_t)join->columns + 1, sizeof *join->letter);
    if (!join->pick || !join->letter)
        return tn_fail_memory(error);
    for (uint32_t l = letters; l-- > 0;) {
        join->letter[join->column[l]] = l;
        for (uint32_t p = 0; p < count; p++)
            join->pick[(size_t)join->column[l] * count + p] = parts[p]->column[l];
    }
    return TN_OK;
}

void tn_join_clear(tn_join *join)
{
    free(join->column);
    free(join->pick);
    free(join->letter);
    *join = (tn_join){0};
}

/* ---- products */

/* The state of a product that no letter changes any more: one operand has decided. */
#define SETTLED UINT64_MAX

typedef struct tn_product {
    const tn_dfa *a, *b;
    tn_dfa_operation operation;
    uint32_t settled_a, settled_b; /* operand states that decide */
    tn_join join;
    tn_numbering pairs;
    tn_depth depth;
    uint32_t *delta; /* [pairs][columns], grows */
    size_t capacity; /* rows of delta */
} tn_product;

static uint64_t product_pair(const tn_product *product, uint32_t p, uint32_t q)
{
    if (p == product->settled_a || q == product->settled_b)
        return SETTLED;
    return (uint64_t)p << 32 | q;
}

static uint8_t product_accepts(const tn_product *product, uint64_t pair)
{
    if (pair == SETTLED)
        return product->operation == TN_DFA_OR;
    uint8_t p = product->a->accept[pair >> 32], q = product->b->accept[(uint32_t)pair];
    switch (product->operation) {
    case TN_DFA_AND:
        return p & q;
    case TN_DFA_OR:
        return p | q;
    default:
        return p & !q;
    }
}

static tn_status product_row(tn_product *product, uint32_t state, tn_error *error)
{
    uint32_t columns = product->join.columns;
    if (!tn_array_reserve_from(&product->delta, &product->capacity, 32, state, 1, columns * sizeof *product->delta))
        return tn_fail_memory(error);
    uint64_t pair = product->pairs.keys[state];
    uint32_t *row = product->delta + (size_t)state * columns;
    const uint32_t *a = product->a->delta + (pair >> 32) * product->a->columns;
    const uint32_t *b = product->b->delta + (size_t)(uint32_t)pair * product->b->columns;
    for (uint32_t c = 0; c < columns; c++) {
        const uint32_t *pick = product->join.pick + (size_t)c * 2;
        bool stays = pair == SETTLED || tn_depth_over(&product->depth, state, c);
        row[c] = stays ? state : tn_number(&product->pairs, product_pair(product, a[pick[0]], b[pick[1]]));
        if (row[c] == UINT32_MAX || !tn_depth_found(&product->depth, state, c, row[c]))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

static tn_status product_explore(tn_product *product, const char *what, tn_bounds *bounds, tn_error *error)
{
    if (tn_number(&product->pairs, product_pair(product, 0, 0)) == UINT32_MAX ||
        !tn_depth_begin(&product->depth, bounds, product->join.column, product->join.letters))
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < product->pairs.count; s++) {
        tn_status status = product_row(product, s, error);
        if (status == TN_OK)
            status = tn_bounds_check(bounds, what, product->pairs.count, product->join.columns, product->join.columns,
                                     error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status product_finish(const tn_product *product, tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    uint32_t states = product->pairs.count;
    tn_dfa *dfa = tn_dfa_new(product->join.letters, product->join.columns, states);
    if (!dfa)
        return tn_fail_memory(error);
    memcpy(dfa->column, product->join.column, dfa->letters * sizeof *dfa->column);
    memcpy(dfa->delta, product->delta, (size_t)states * dfa->columns * sizeof *dfa->delta);
    for (uint32_t s = 0; s < states; s++)
        dfa->accept[s] = product_accepts(product, product->pairs.keys[s]);
    tn_status status = tn_cover_minimise(dfa, bounds, out, error);
    tn_dfa_free(dfa);
    return status;
}

tn_status tn_dfa_product(const tn_dfa *a, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                         tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    tn_product product = {.a = a, .b = b, .operation = operation};
    product.settled_a = tn_dfa_sink(a, operation == TN_DFA_OR);
    product.settled_b = tn_dfa_sink(b, operation != TN_DFA_AND);
    const tn_dfa *parts[2] = {a, b};
    tn_status status = tn_bounds_check(bounds, what, 1, 1, a->letters, error);
    if (status == TN_OK)
        status = tn_join_make(&product.join, parts, 2, a->letters, NULL, false, error);
    if (status == TN_OK)
        status = product_explore(&product, what, bounds, error);
    if (status == TN_OK)
        status = product_finish(&product, bounds, out, error);
    tn_join_clear(&product.join);
    tn_numbering_clear(&product.pairs);
    tn_depth_clear(&product.depth);
    free(product.delta);
    return status;
}
