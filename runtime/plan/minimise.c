/* Minimising by partition refinement (Hopcroft 1971, with the refinable partition of Valmari and Lehtinen 2008):
 * O(columns * states * log states). */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/dfa.h"
#include "runtime/plan/numbering.h"

/* A partition of the elements 0..n-1 into blocks; each block is a run of `elements`, its marked elements first. */
typedef struct tn_partition {
    uint32_t *elements, *place, *block; /* [n]: block by block; where an element is; its block */
    uint32_t *first, *end, *marked;     /* [blocks] */
    uint32_t blocks;
    uint32_t *touched; /* blocks with marked elements */
    uint32_t touched_count;
} tn_partition;

typedef struct tn_refiner {
    uint32_t states, columns;
    const uint32_t *delta;  /* [states][columns] */
    uint32_t *source_first; /* [columns][states + 1]: the states that lead to a state are a run of `source` */
    uint32_t *source;       /* [columns][states] */
    tn_partition partition;
    uint32_t *waiting; /* blocks still to split by */
    uint8_t *is_waiting;
    uint32_t waiting_count;
    uint32_t *splitter; /* the elements of the block being split by */
    uint32_t *memory;
} tn_refiner;

static void partition_mark(tn_partition *partition, uint32_t element)
{
    uint32_t b = partition->block[element];
    uint32_t at = partition->place[element];
    uint32_t to = partition->first[b] + partition->marked[b];
    if (at < to)
        return; /* marked already */
    uint32_t other = partition->elements[to];
    partition->elements[to] = element;
    partition->place[element] = to;
    partition->elements[at] = other;
    partition->place[other] = at;
    if (partition->marked[b]++ == 0)
        partition->touched[partition->touched_count++] = b;
}

/* Makes the marked part of block b a block, unless it is all of it. Returns the new block, or TN_NO_STATE. */
static uint32_t partition_split(tn_partition *partition, uint32_t b)
{
    uint32_t middle = partition->first[b] + partition->marked[b];
    partition->marked[b] = 0;
    if (middle == partition->end[b])
        return TN_NO_STATE;
    uint32_t made = partition->blocks++;
    partition->first[made] = partition->first[b];
    partition->end[made] = middle;
    partition->marked[made] = 0;
    partition->first[b] = middle;
    for (uint32_t i = partition->first[made]; i < middle; i++)
        partition->block[partition->elements[i]] = made;
    return made;
}

static void wait_for(tn_refiner *refiner, uint32_t b)
{
    if (refiner->is_waiting[b])
        return;
    refiner->is_waiting[b] = 1;
    refiner->waiting[refiner->waiting_count++] = b;
}

static void split_touched(tn_refiner *refiner)
{
    tn_partition *partition = &refiner->partition;
    for (uint32_t i = 0; i < partition->touched_count; i++) {
        uint32_t b = partition->touched[i];
        uint32_t made = partition_split(partition, b);
        if (made == TN_NO_STATE)
            continue;
        uint32_t size_b = partition->end[b] - partition->first[b];
        uint32_t size_made = partition->end[made] - partition->first[made];
        /* A block that waits stays waiting, and its new half joins it; otherwise the smaller half suffices. */
        wait_for(refiner, refiner->is_waiting[b] || size_made <= size_b ? made : b);
    }
    partition->touched_count = 0;
}

static void split_by(tn_refiner *refiner, uint32_t b)
{
    tn_partition *partition = &refiner->partition;
    uint32_t size = partition->end[b] - partition->first[b];
    memcpy(refiner->splitter, partition->elements + partition->first[b], size * sizeof *refiner->splitter);
    for (uint32_t c = 0; c < refiner->columns; c++) {
        const uint32_t *first = refiner->source_first + (size_t)c * (refiner->states + 1);
        const uint32_t *source = refiner->source + (size_t)c * refiner->states;
        for (uint32_t i = 0; i < size; i++)
            for (uint32_t j = first[refiner->splitter[i]]; j < first[refiner->splitter[i] + 1]; j++)
                partition_mark(partition, source[j]);
        split_touched(refiner);
    }
}

static void invert(tn_refiner *refiner)
{
    uint32_t n = refiner->states;
    for (uint32_t c = 0; c < refiner->columns; c++) {
        uint32_t *first = refiner->source_first + (size_t)c * (n + 1);
        uint32_t *source = refiner->source + (size_t)c * n;
        memset(first, 0, (n + 1) * sizeof *first);
        for (uint32_t s = 0; s < n; s++)
            first[refiner->delta[(size_t)s * refiner->columns + c]]++;
        for (uint32_t s = 0, sum = 0; s <= n; s++) {
            sum += first[s];
            first[s] = sum;
        }
        for (uint32_t s = n; s-- > 0;)
            source[--first[refiner->delta[(size_t)s * refiner->columns + c]]] = s;
    }
}

static bool refiner_allocate(tn_refiner *refiner)
{
    size_t n = refiner->states, k = refiner->columns;
    size_t words = k * (n + 1) + k * n + 9 * n;
    refiner->memory = malloc((words + 1) * sizeof *refiner->memory);
    refiner->is_waiting = calloc(n + 1, 1);
    if (!refiner->memory || !refiner->is_waiting)
        return false;
    uint32_t *at = refiner->memory;
    refiner->source_first = at, at += k * (n + 1);
    refiner->source = at, at += k * n;
    refiner->partition.elements = at, at += n;
    refiner->partition.place = at, at += n;
    refiner->partition.block = at, at += n;
    refiner->partition.first = at, at += n;
    refiner->partition.end = at, at += n;
    refiner->partition.marked = at, at += n;
    refiner->partition.touched = at, at += n;
    refiner->waiting = at, at += n;
    refiner->splitter = at;
    return true;
}

static void refine_partition(tn_refiner *refiner, const uint8_t *accept)
{
    tn_partition *partition = &refiner->partition;
    uint32_t n = refiner->states;
    partition->blocks = 1;
    partition->first[0] = 0;
    partition->end[0] = n;
    partition->marked[0] = 0;
    for (uint32_t s = 0; s < n; s++) {
        partition->elements[s] = partition->place[s] = s;
        partition->block[s] = 0;
    }
    for (uint32_t s = 0; s < n; s++)
        if (accept[s])
            partition_mark(partition, s);
    split_touched(refiner);
    while (refiner->waiting_count > 0) {
        uint32_t b = refiner->waiting[--refiner->waiting_count];
        refiner->is_waiting[b] = 0;
        split_by(refiner, b);
    }
}

/* ---- tidying: equal columns merged, unreachable states dropped, canonical numbers */

static bool columns_equal(const tn_dfa *dfa, uint32_t a, uint32_t b)
{
    for (uint32_t s = 0; s < dfa->states; s++)
        if (dfa->delta[(size_t)s * dfa->columns + a] != dfa->delta[(size_t)s * dfa->columns + b])
            return false;
    return true;
}

/* Says of each column which is the first one equal to it. */
static bool first_equal_columns(const tn_dfa *dfa, uint32_t *same)
{
    uint64_t *hash = calloc((size_t)dfa->columns + 1, sizeof *hash);
    uint32_t *first = malloc(((size_t)dfa->columns + 1) * sizeof *first);
    tn_numbering hashes = {0};
    bool ok = hash && first;
    for (uint32_t s = 0; ok && s < dfa->states; s++)
        for (uint32_t c = 0; c < dfa->columns; c++)
            hash[c] =
                (hash[c] ^ dfa->delta[(size_t)s * dfa->columns + c]) * UINT64_C(0x9e3779b97f4a7c15) + (hash[c] >> 31);
    for (uint32_t c = 0; ok && c < dfa->columns; c++) {
        uint32_t before = hashes.count;
        uint32_t number = tn_number(&hashes, hash[c]);
        ok = number != UINT32_MAX;
        if (!ok)
            break;
        if (number == before)
            first[number] = c;
        same[c] = first[number];
        if (columns_equal(dfa, same[c], c))
            continue;
        /* Two different columns with one hash: look through them all. */
        for (same[c] = 0; !columns_equal(dfa, same[c], c);)
            same[c]++;
    }
    free(hash);
    free(first);
    tn_numbering_clear(&hashes);
    return ok;
}

typedef struct tn_tidy {
    uint32_t *same;   /* [columns]: the first equal column */
    uint32_t *rank;   /* [columns]: new number of a first column, by first letter; UINT32_MAX: no letter has it */
    uint32_t *chosen; /* [columns]: the column of a rank */
    uint32_t *order;  /* [states]: breadth first */
    uint32_t *number; /* [states]: place in the order */
    uint32_t columns, states;
    uint32_t *memory;
} tn_tidy;

static bool tidy_columns(tn_tidy *tidy, const tn_dfa *dfa)
{
    if (!first_equal_columns(dfa, tidy->same))
        return false;
    memset(tidy->rank, 0xff, dfa->columns * sizeof *tidy->rank);
    for (uint32_t l = 0; l < dfa->letters; l++) {
        uint32_t c = tidy->same[dfa->column[l]];
        if (tidy->rank[c] != UINT32_MAX)
            continue;
        tidy->chosen[tidy->columns] = c;
        tidy->rank[c] = tidy->columns++;
    }
    return true;
}

static void tidy_states(tn_tidy *tidy, const tn_dfa *dfa, uint32_t start)
{
    memset(tidy->number, 0xff, dfa->states * sizeof *tidy->number);
    tidy->number[start] = 0;
    tidy->order[tidy->states++] = start;
    for (uint32_t i = 0; i < tidy->states; i++) {
        const uint32_t *row = dfa->delta + (size_t)tidy->order[i] * dfa->columns;
        for (uint32_t c = 0; c < tidy->columns; c++) {
            uint32_t to = row[tidy->chosen[c]];
            if (tidy->number[to] != UINT32_MAX)
                continue;
            tidy->number[to] = tidy->states;
            tidy->order[tidy->states++] = to;
        }
    }
}

static tn_dfa *tidy_copy(const tn_tidy *tidy, const tn_dfa *dfa)
{
    tn_dfa *copy = tn_dfa_new(dfa->letters, tidy->columns, tidy->states);
    if (!copy)
        return NULL;
    for (uint32_t l = 0; l < dfa->letters; l++)
        copy->column[l] = tidy->rank[tidy->same[dfa->column[l]]];
    for (uint32_t s = 0; s < tidy->states; s++) {
        const uint32_t *row = dfa->delta + (size_t)tidy->order[s] * dfa->columns;
        copy->accept[s] = dfa->accept[tidy->order[s]];
        for (uint32_t c = 0; c < tidy->columns; c++)
            copy->delta[(size_t)s * tidy->columns + c] = tidy->number[row[tidy->chosen[c]]];
    }
    return copy;
}

static tn_dfa *tidy_dfa(const tn_dfa *dfa, uint32_t start)
{
    tn_tidy tidy = {0};
    size_t n = dfa->states, k = dfa->columns;
    tidy.memory = malloc((3 * k + 2 * n + 1) * sizeof *tidy.memory);
    if (!tidy.memory)
        return NULL;
    tidy.same = tidy.memory;
    tidy.rank = tidy.same + k;
    tidy.chosen = tidy.rank + k;
    tidy.order = tidy.chosen + k;
    tidy.number = tidy.order + n;
    tn_dfa *copy = NULL;
    if (tidy_columns(&tidy, dfa)) {
        tidy_states(&tidy, dfa, start);
        copy = tidy_copy(&tidy, dfa);
    }
    free(tidy.memory);
    return copy;
}

/* The automaton of the blocks, not yet canonical. */
static tn_dfa *quotient(const tn_refiner *refiner, const tn_dfa *dfa)
{
    const tn_partition *partition = &refiner->partition;
    tn_dfa *made = tn_dfa_new(dfa->letters, dfa->columns, partition->blocks);
    if (!made)
        return NULL;
    memcpy(made->column, dfa->column, dfa->letters * sizeof *dfa->column);
    for (uint32_t b = 0; b < partition->blocks; b++) {
        uint32_t s = partition->elements[partition->first[b]];
        made->accept[b] = dfa->accept[s];
        for (uint32_t c = 0; c < dfa->columns; c++)
            made->delta[(size_t)b * dfa->columns + c] = partition->block[dfa->delta[(size_t)s * dfa->columns + c]];
    }
    return made;
}

static tn_dfa *minimise_tidy(const tn_dfa *dfa)
{
    tn_refiner refiner = {.states = dfa->states, .columns = dfa->columns, .delta = dfa->delta};
    tn_dfa *blocks = NULL, *made = NULL;
    if (refiner_allocate(&refiner)) {
        invert(&refiner);
        refine_partition(&refiner, dfa->accept);
        blocks = quotient(&refiner, dfa);
    }
    if (blocks)
        made = tidy_dfa(blocks, refiner.partition.block[0]);
    tn_dfa_free(blocks);
    free(refiner.memory);
    free(refiner.is_waiting);
    return made;
}

tn_status tn_dfa_minimise(const tn_dfa *dfa, uint32_t start, tn_dfa **out, tn_error *error)
{
    tn_dfa *tidy = tidy_dfa(dfa, start);
    *out = tidy ? minimise_tidy(tidy) : NULL;
    tn_dfa_free(tidy);
    return *out ? TN_OK : tn_fail_memory(error);
}
