/* Products of automata without cycles, minimal as they are made.
 *
 * Pairs of states are walked depth first. When all that follows a pair is finished, its row is looked up among the
 * finished rows (a table of hashes): equal rows and equal acceptance are equal languages, since what they lead to is
 * minimal already. Pairs from which nothing is accepted finish as no state at all. So the product itself, which may be
 * many times larger than its minimal automaton, is never stored: only a number for each pair that was met.
 *
 * Rows list columns in one order in all of an automaton: that of the first operand, split. So rows compare as they
 * are. */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"
#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"

#define TABLE_ENTRIES_MAX (UINT64_C(1) << 24) /* 64 MB, of which only the pages used take memory */
#define UNKNOWN 0u
#define NOTHING 1u  /* finished: nothing is accepted */
#define FINISHED 2u /* plus the state */

typedef struct tn_edge {
    uint32_t label, target;
} tn_edge;

/* A pair under way. */
typedef struct tn_visit {
    uint32_t p, q;
    size_t edge;  /* of p: the one in hand */
    size_t split; /* of its column: the one in hand */
    size_t row;   /* where the pair's row starts on the stack of edges */
    size_t slot;  /* of the pair in the table */
} tn_visit;

/* All edges of a column: a hash of them, and how many. */
typedef struct tn_fold_column {
    uint64_t hash;
    size_t edges;
} tn_fold_column;

typedef struct tn_folding {
    const tn_sparse *a;
    const tn_dfa *b;
    bool both; /* b must accept (otherwise: must not) */
    uint32_t settled;
    tn_splits splits;
    uint32_t *done; /* [pairs]: UNKNOWN, NOTHING, or FINISHED + state */
    size_t done_capacity;
    bool hashed; /* a pair's place in `done` is its number in `pairs`; otherwise p * states of b + q */
    tn_numbering pairs;
    tn_visit *visits;
    size_t visit_count, visit_capacity;
    tn_edge *stack; /* rows of the pairs under way */
    size_t stack_count, stack_capacity;
    tn_edge *edges; /* of finished states */
    size_t edge_count, edge_capacity;
    size_t *first;  /* [states + 1] */
    uint64_t *hash; /* [states] */
    uint8_t *accept;
    uint32_t states;
    size_t state_capacity;
    tn_hash_table table;   /* of states, by their rows */
    tn_fold_column *looks; /* [columns] */
    uint64_t work;
} tn_folding;

/* ---- pairs */

/* The pair's place in `done`; SIZE_MAX where out of memory. */
static size_t find_slot(tn_folding *f, uint32_t p, uint32_t q)
{
    if (!f->hashed)
        return (size_t)p * f->b->states + q;
    uint32_t number = tn_number(&f->pairs, (uint64_t)p << 32 | q);
    size_t before = f->done_capacity;
    if (number == UINT32_MAX || !tn_array_reserve(&f->done, &f->done_capacity, number, 1, sizeof *f->done))
        return SIZE_MAX;
    memset(f->done + before, 0, (f->done_capacity - before) * sizeof *f->done);
    return number;
}

static bool visit(tn_folding *f, uint32_t p, uint32_t q, size_t slot)
{
    if (!tn_array_reserve(&f->visits, &f->visit_capacity, f->visit_count, 1, sizeof *f->visits))
        return false;
    size_t edge = f->a->first[p];
    f->visits[f->visit_count++] = (tn_visit){
        .p = p,
        .q = q,
        .edge = edge,
        .split = edge < f->a->first[p + 1] ? f->splits.first[f->a->label[edge]] : 0,
        .row = f->stack_count,
        .slot = slot,
    };
    return true;
}

/* ---- finished states */

static uint64_t mix(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 29;
}

static bool reserve_state(tn_folding *f, size_t edges)
{
    if ((size_t)f->states + 1 >= f->state_capacity) {
        size_t capacity = tn_array_larger(f->state_capacity, 0, 256);
        if (!tn_array_resize(&f->first, capacity + 1, sizeof *f->first) ||
            !tn_array_resize(&f->hash, capacity, sizeof *f->hash) ||
            !tn_array_resize(&f->accept, capacity, sizeof *f->accept))
            return false;
        f->first[0] = 0;
        f->state_capacity = capacity;
    }
    return tn_array_reserve(&f->edges, &f->edge_capacity, f->edge_count, edges, sizeof *f->edges);
}

static void look_at(tn_fold_column *look, uint32_t state, uint32_t target)
{
    look->hash = mix(look->hash, (uint64_t)state << 32 | target);
    look->edges++;
}

typedef struct wanted_row {
    const tn_folding *folding;
    const tn_edge *row;
    size_t size;
    uint64_t hash;
    uint8_t accept;
} wanted_row;

static bool is_wanted(const void *context, uint32_t s)
{
    const wanted_row *w = context;
    const tn_folding *f = w->folding;
    return f->hash[s] == w->hash && f->accept[s] == w->accept && f->first[s + 1] - f->first[s] == w->size &&
           (w->size == 0 || memcmp(f->edges + f->first[s], w->row, w->size * sizeof *w->row) == 0);
}

/* The state that has this row: an old one, or a new one. */
static uint32_t intern_row(tn_folding *f, const tn_edge *row, size_t size, uint8_t accept)
{
    uint64_t hash = accept;
    for (size_t i = 0; i < size; i++)
        hash = mix(hash, (uint64_t)row[i].label << 32 | row[i].target);
    hash = mix(hash, size);
    if (!reserve_state(f, size))
        return UINT32_MAX;
    wanted_row wanted = {f, row, size, hash, accept};
    uint32_t s = f->states;
    if (tn_hash_enter(&f->table, hash, is_wanted, &wanted, &s, NULL) != TN_OK)
        return UINT32_MAX;
    if (s < f->states)
        return s;
    f->states++;
    f->hash[s] = hash;
    f->accept[s] = accept;
    if (size > 0)
        memcpy(f->edges + f->edge_count, row, size * sizeof *row);
    f->edge_count += size;
    f->first[s + 1] = f->edge_count;
    for (size_t i = 0; i < size; i++)
        look_at(&f->looks[row[i].label], s, row[i].target);
    return s;
}

/* ---- the walk */

/* Goes on with the pair on top until it is finished or another is on top of it. */
static bool proceed(tn_folding *f)
{
    tn_visit *top = &f->visits[f->visit_count - 1];
    const tn_sparse *a = f->a;
    const uint32_t *row = f->b->delta + (size_t)top->q * f->b->columns;
    size_t end = a->first[top->p + 1];
    while (top->edge < end) {
        size_t split_end = f->splits.first[a->label[top->edge] + 1];
        uint32_t p = a->target[top->edge];
        for (; top->split < split_end; top->split++) {
            uint32_t q = row[f->splits.splits[top->split].other];
            if (q == f->settled)
                continue;
            size_t slot = find_slot(f, p, q);
            if (slot == SIZE_MAX)
                return false;
            uint32_t done = f->done[slot];
            if (done == UNKNOWN)
                return visit(f, p, q, slot);
            f->work++;
            if (done == NOTHING)
                continue;
            if (!tn_array_reserve(&f->stack, &f->stack_capacity, f->stack_count, 1, sizeof *f->stack))
                return false;
            f->stack[f->stack_count++] = (tn_edge){f->splits.splits[top->split].label, done - FINISHED};
        }
        if (++top->edge < end)
            top->split = f->splits.first[a->label[top->edge]];
    }
    bool accept = a->accept[top->p] && (f->b->accept[top->q] != 0) == f->both;
    size_t size = f->stack_count - top->row;
    uint32_t state = size || accept ? intern_row(f, f->stack + top->row, size, accept) : 0;
    if (state == UINT32_MAX)
        return false;
    f->done[top->slot] = size || accept ? FINISHED + state : NOTHING;
    f->stack_count = top->row;
    f->visit_count--;
    f->work++;
    return true;
}

static tn_status walk(tn_folding *f, const char *what, tn_bounds *bounds, tn_error *error)
{
    uint64_t all = (uint64_t)f->a->states * f->b->states;
    f->hashed = all > TABLE_ENTRIES_MAX;
    f->done_capacity = f->hashed ? 0 : (size_t)all;
    f->done = f->hashed ? NULL : calloc((size_t)all + 1, sizeof *f->done);
    size_t slot = f->hashed || f->done ? find_slot(f, 0, 0) : SIZE_MAX;
    /* Room for an edge at least, so that the row of a state without edges has a place as well. */
    bool room = tn_array_reserve(&f->stack, &f->stack_capacity, 0, 1, sizeof *f->stack);
    if (slot == SIZE_MAX || !room || !visit(f, 0, 0, slot))
        return tn_fail_memory(error);
    while (f->visit_count > 0) {
        if (!proceed(f))
            return tn_fail_memory(error);
        tn_status status = tn_bounds_check(bounds, what, f->states, 1, f->work, error);
        f->work = 0;
        if (status == TN_OK && f->edge_count > bounds->max_transitions)
            status = tn_bounds_check(bounds, what, f->states, UINT32_MAX, 0, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* ---- what is made of it */

/* Takes back the merging of columns that differ after all, since two hashes met. `row` and `seen` are room for a
 * state's targets, and for the state of which they are. */
static void check_merges(const tn_folding *f, uint32_t *same, uint32_t *row, uint32_t *seen)
{
    for (uint32_t s = 0; s < f->states; s++) {
        for (size_t e = f->first[s]; e < f->first[s + 1]; e++) {
            row[f->edges[e].label] = f->edges[e].target;
            seen[f->edges[e].label] = s + 1;
        }
        for (size_t e = f->first[s]; e < f->first[s + 1]; e++) {
            uint32_t c = f->edges[e].label;
            if (seen[same[c]] != s + 1 || row[same[c]] != f->edges[e].target)
                same[c] = c;
        }
    }
}

/* Says of each column which is the first one equal to it. A column that has all edges of another, and as many, is equal
 * to it. */
static bool find_merges(const tn_folding *f, uint32_t *same)
{
    size_t columns = f->splits.columns;
    uint32_t *row = calloc(2 * columns + 1, sizeof *row);
    tn_numbering hashes = {0};
    bool ok = row != NULL, merged = false;
    for (uint32_t c = 0; ok && c < columns; c++) {
        uint32_t before = hashes.count, number = tn_number(&hashes, f->looks[c].hash);
        ok = number != UINT32_MAX;
        if (ok && number == before)
            row[number] = c; /* until check_merges needs it, the first column of each hash */
        if (ok)
            same[c] = f->looks[row[number]].edges == f->looks[c].edges ? row[number] : c;
        merged = merged || (ok && same[c] != c);
    }
    if (ok && merged)
        check_merges(f, same, row, row + columns);
    free(row);
    tn_numbering_clear(&hashes);
    return ok;
}

/* The finished states in reverse, so that the start, finished last, comes first; equal columns merged. */
static void write_rows(const tn_folding *f, const uint32_t *same, uint32_t *rank, tn_sparse *made)
{
    uint32_t columns = 0;
    for (uint32_t c = 0; c < f->splits.columns; c++)
        rank[c] = same[c] == c ? columns++ : rank[same[c]];
    made->columns = columns;
    for (uint32_t l = 0; l < made->letters; l++)
        made->column[l] = rank[f->splits.column[l]];
    size_t used = 0;
    for (uint32_t s = 0; s < f->states; s++) {
        uint32_t from = f->states - 1 - s;
        made->accept[s] = f->accept[from];
        for (size_t e = f->first[from]; e < f->first[from + 1]; e++) {
            if (same[f->edges[e].label] != f->edges[e].label)
                continue;
            made->label[used] = rank[f->edges[e].label];
            made->target[used++] = f->states - 1 - f->edges[e].target;
        }
        made->first[s + 1] = used;
    }
}

static tn_status finish(const tn_folding *f, tn_sparse **out, tn_error *error)
{
    uint32_t *same = malloc(((size_t)f->splits.columns * 2 + 1) * sizeof *same);
    bool ok = same && find_merges(f, same);
    size_t edges = 0;
    for (uint32_t c = 0; ok && c < f->splits.columns; c++)
        edges += same[c] == c ? f->looks[c].edges : 0;
    tn_sparse *made = ok ? tn_sparse_new(f->a->letters, f->splits.columns, f->states, edges) : NULL;
    if (made)
        write_rows(f, same, same + f->splits.columns, made);
    if (made)
        made->folded = true;
    free(same);
    *out = made;
    return made ? TN_OK : tn_fail_memory(error);
}

tn_status tn_sparse_fold(const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                         tn_bounds *bounds, tn_sparse **out, tn_error *error)
{
    tn_folding f = {.a = a, .b = b, .both = operation == TN_DFA_AND};
    f.settled = tn_dfa_sink(b, operation != TN_DFA_AND);
    tn_status status = tn_bounds_check(bounds, what, 1, 1, a->letters, error);
    if (status == TN_OK && !tn_splits_make(&f.splits, a, b))
        status = tn_fail_memory(error);
    f.looks = calloc((size_t)f.splits.columns + 1, sizeof *f.looks);
    if (status == TN_OK && !f.looks)
        status = tn_fail_memory(error);
    if (status == TN_OK && a->states > 0 && f.settled != 0)
        status = walk(&f, what, bounds, error);
    if (status == TN_OK)
        status = finish(&f, out, error);
    tn_splits_clear(&f.splits);
    tn_numbering_clear(&f.pairs);
    free(f.done);
    free(f.visits);
    free(f.stack);
    free(f.edges);
    free(f.first);
    free(f.hash);
    free(f.accept);
    tn_hash_clear(&f.table);
    free(f.looks);
    return status;
}

tn_status tn_sparse_words(uint32_t letters, uint32_t min, uint32_t max, tn_sparse **out, tn_error *error)
{
    if (letters == 0)
        max = 0;
    uint32_t states = min > max ? 0 : max + 1;
    tn_sparse *words = tn_sparse_new(letters, letters > 0, states, states);
    *out = words;
    if (!words)
        return tn_fail_memory(error);
    memset(words->column, 0, letters * sizeof *words->column);
    words->folded = true;
    size_t edges = 0;
    for (uint32_t s = 0; s < states; s++) {
        words->accept[s] = s >= min;
        if (s < max && letters > 0) {
            words->label[edges] = 0;
            words->target[edges++] = s + 1;
        }
        words->first[s + 1] = edges;
    }
    return TN_OK;
}
