/* Minimising automata without their dead state: partition refinement over the live transitions alone (Valmari and
 * Lehtinen: Efficient minimization of DFAs with partial transition functions, 2008), O(edges * log states).
 *
 * Of the blocks that partition a block's transitions, one may be left out as a splitter; the dead state's is. So both
 * initial blocks (accepting or not) must wait. */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/automata/partition.h"
#include "runtime/automata/sparse.h"

typedef struct tn_sparse_refiner {
    const tn_sparse *sparse;
    tn_inverse sources;
    tn_partition partition;
    uint32_t *splitter; /* [states] */
    size_t *bucket;     /* [columns]: edges into the splitter; then where the column's sources end */
    uint32_t *labels;   /* [columns]: those with such edges */
    uint32_t *into;     /* [edges]: sources by label */
} tn_sparse_refiner;

/* Collects the sources of edges into the splitter, by label. Returns how many labels there are. */
static uint32_t collect(tn_sparse_refiner *refiner, uint32_t size)
{
    const tn_inverse *sources = &refiner->sources;
    uint32_t labels = 0;
    for (uint32_t i = 0; i < size; i++)
        for (size_t e = sources->first[refiner->splitter[i]]; e < sources->first[refiner->splitter[i] + 1]; e++)
            if (refiner->bucket[sources->label[e]]++ == 0)
                refiner->labels[labels++] = sources->label[e];
    size_t sum = 0;
    for (uint32_t l = 0; l < labels; l++) {
        size_t count = refiner->bucket[refiner->labels[l]];
        refiner->bucket[refiner->labels[l]] = sum;
        sum += count;
    }
    for (uint32_t i = 0; i < size; i++)
        for (size_t e = sources->first[refiner->splitter[i]]; e < sources->first[refiner->splitter[i] + 1]; e++)
            refiner->into[refiner->bucket[sources->label[e]]++] = sources->source[e];
    return labels;
}

static void split_by(tn_sparse_refiner *refiner, uint32_t b)
{
    tn_partition *partition = &refiner->partition;
    uint32_t size = partition->end[b] - partition->first[b];
    memcpy(refiner->splitter, partition->elements + partition->first[b], size * sizeof *refiner->splitter);
    uint32_t labels = collect(refiner, size);
    size_t from = 0;
    for (uint32_t l = 0; l < labels; l++) {
        size_t end = refiner->bucket[refiner->labels[l]];
        for (; from < end; from++)
            tn_partition_mark(partition, refiner->into[from]);
        tn_partition_split(partition);
        refiner->bucket[refiner->labels[l]] = 0;
    }
}

static void refine(tn_sparse_refiner *refiner)
{
    tn_partition *partition = &refiner->partition;
    for (uint32_t s = 0; s < refiner->sparse->states; s++)
        if (refiner->sparse->accept[s])
            tn_partition_mark(partition, s);
    tn_partition_split(partition);
    for (uint32_t b = 0; b < partition->blocks; b++)
        tn_partition_wait(partition, b);
    while (partition->waiting_count > 0) {
        uint32_t b = partition->waiting[--partition->waiting_count];
        partition->is_waiting[b] = 0;
        split_by(refiner, b);
    }
}

static tn_status refiner_make(tn_sparse_refiner *refiner, tn_error *error)
{
    const tn_sparse *sparse = refiner->sparse;
    tn_status status = tn_inverse_make(sparse, &refiner->sources, error);
    refiner->splitter = malloc(((size_t)sparse->states + 1) * sizeof *refiner->splitter);
    refiner->bucket = calloc((size_t)sparse->columns + 1, sizeof *refiner->bucket);
    refiner->labels = malloc(((size_t)sparse->columns + 1) * sizeof *refiner->labels);
    refiner->into = malloc((sparse->first[sparse->states] + 1) * sizeof *refiner->into);
    bool ok = tn_partition_make(&refiner->partition, sparse->states) && refiner->splitter && refiner->bucket &&
              refiner->labels && refiner->into;
    return status == TN_OK && !ok ? tn_fail_memory(error) : status;
}

static void refiner_clear(tn_sparse_refiner *refiner)
{
    tn_inverse_clear(&refiner->sources);
    tn_partition_clear(&refiner->partition);
    free(refiner->splitter);
    free(refiner->bucket);
    free(refiner->labels);
    free(refiner->into);
}

/* ---- the quotient */

/* Columns as they look in the quotient: a hash of all of a column's edges, and how many there are. */
typedef struct tn_column_hash {
    uint64_t hash;
    size_t edges;
} tn_column_hash;

static void look_at_columns(const tn_sparse *sparse, tn_column_hash *looks)
{
    for (uint32_t s = 0; s < sparse->states; s++)
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++) {
            tn_column_hash *look = &looks[sparse->label[e]];
            uint64_t edge = (uint64_t)s << 32 | sparse->target[e];
            look->hash = (look->hash ^ edge) * UINT64_C(0x9e3779b97f4a7c15) + (look->hash >> 29);
            look->edges++;
        }
}

/* Takes back the merging of columns that differ after all, since two hashes met. `row` is room for a state's targets.
 */
static void check_merges(const tn_sparse *sparse, uint32_t *same, uint32_t *row)
{
    memset(row, 0xff, sparse->columns * sizeof *row);
    for (uint32_t s = 0; s < sparse->states; s++) {
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++)
            row[sparse->label[e]] = sparse->target[e];
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++)
            if (row[same[sparse->label[e]]] != sparse->target[e])
                same[sparse->label[e]] = sparse->label[e];
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++)
            row[sparse->label[e]] = TN_NO_STATE;
    }
}

/* Says of each column which is the first one equal to it. Equal numbers of edges, all of them met by the other's, are
 * equal columns. */
static bool find_merges(const tn_sparse *sparse, uint32_t *same)
{
    tn_column_hash *looks = calloc((size_t)sparse->columns + 1, sizeof *looks);
    uint32_t *row = malloc(((size_t)sparse->columns + 1) * sizeof *row);
    tn_numbering hashes = {0};
    bool ok = looks && row;
    if (ok)
        look_at_columns(sparse, looks);
    for (uint32_t c = 0; ok && c < sparse->columns; c++) {
        uint32_t before = hashes.count;
        uint32_t number = tn_number(&hashes, looks[c].hash);
        ok = number != UINT32_MAX;
        if (ok && number == before)
            row[number] = c; /* until check_merges needs it, the first column of each hash */
        if (ok)
            same[c] = looks[row[number]].edges == looks[c].edges ? row[number] : c;
    }
    if (ok)
        check_merges(sparse, same, row);
    free(looks);
    free(row);
    tn_numbering_clear(&hashes);
    return ok;
}

/* The automaton of the blocks, the start's first, with all its columns. */
static tn_sparse *make_quotient(const tn_sparse *sparse, const tn_partition *partition)
{
    uint32_t start = partition->block[0];
    size_t edges = 0;
    for (uint32_t b = 0; b < partition->blocks; b++) {
        uint32_t s = partition->elements[partition->first[b]];
        edges += sparse->first[s + 1] - sparse->first[s];
    }
    tn_sparse *made = tn_sparse_new(sparse->letters, sparse->columns, partition->blocks, edges);
    if (!made)
        return NULL;
    memcpy(made->column, sparse->column, sparse->letters * sizeof *sparse->column);
    edges = 0;
    for (uint32_t i = 0; i < partition->blocks; i++) {
        uint32_t b = i == 0 ? start : i == start ? 0 : i; /* the start changes places with block 0 */
        uint32_t s = partition->elements[partition->first[b]];
        made->accept[i] = sparse->accept[s];
        for (size_t e = sparse->first[s]; e < sparse->first[s + 1]; e++) {
            uint32_t to = partition->block[sparse->target[e]];
            made->label[edges] = sparse->label[e];
            made->target[edges++] = to == start ? 0 : to == 0 ? start : to;
        }
        made->first[i + 1] = edges;
    }
    return made;
}

/* Keeps of each set of equal columns the first, numbered in their old order. */
static bool merge_columns(tn_sparse *sparse)
{
    uint32_t *same = malloc(((size_t)sparse->columns + 1) * 2 * sizeof *same);
    if (!same || !find_merges(sparse, same)) {
        free(same);
        return false;
    }
    uint32_t *rank = same + sparse->columns, columns = 0;
    for (uint32_t c = 0; c < sparse->columns; c++)
        rank[c] = same[c] == c ? columns++ : rank[same[c]];
    size_t used = 0;
    for (uint32_t s = 0; s < sparse->states; s++) {
        size_t e = sparse->first[s];
        sparse->first[s] = used;
        for (; e < sparse->first[s + 1]; e++) {
            if (same[sparse->label[e]] != sparse->label[e])
                continue;
            sparse->target[used] = sparse->target[e];
            sparse->label[used++] = rank[sparse->label[e]];
        }
    }
    sparse->first[sparse->states] = used;
    for (uint32_t l = 0; l < sparse->letters; l++)
        sparse->column[l] = rank[sparse->column[l]];
    sparse->columns = columns;
    free(same);
    return true;
}

tn_status tn_sparse_copy(const tn_sparse *sparse, tn_sparse **out, tn_error *error)
{
    size_t edges = sparse->first[sparse->states];
    tn_sparse *made = tn_sparse_new(sparse->letters, sparse->columns, sparse->states, edges);
    *out = made;
    if (!made)
        return tn_fail_memory(error);
    memcpy(made->column, sparse->column, sparse->letters * sizeof *made->column);
    memcpy(made->first, sparse->first, ((size_t)sparse->states + 1) * sizeof *made->first);
    memcpy(made->label, sparse->label, edges * sizeof *made->label);
    memcpy(made->target, sparse->target, edges * sizeof *made->target);
    memcpy(made->accept, sparse->accept, sparse->states);
    made->folded = sparse->folded;
    return TN_OK;
}

/* Puts the states in this order; first is the start, which no edge leads to. `rank` is room for a number a state. */
static tn_status put_in_order(tn_sparse **sparse, const uint32_t *order, uint32_t *rank, tn_error *error)
{
    const tn_sparse *old = *sparse;
    size_t edges = 0;
    tn_sparse *made = tn_sparse_new(old->letters, old->columns, old->states, old->first[old->states]);
    if (!made)
        return tn_fail_memory(error);
    memcpy(made->column, old->column, old->letters * sizeof *old->column);
    for (uint32_t i = 0; i < old->states; i++)
        rank[order[i]] = i;
    for (uint32_t i = 0; i < old->states; i++) {
        made->accept[i] = old->accept[order[i]];
        for (size_t e = old->first[order[i]]; e < old->first[order[i] + 1]; e++) {
            made->label[edges] = old->label[e];
            made->target[edges++] = rank[old->target[e]];
        }
        made->first[i + 1] = edges;
    }
    made->folded = true;
    tn_sparse_free(*sparse);
    *sparse = made;
    return TN_OK;
}

/* Has it no cycle? Then its edges are made to lead forward. Counts, state by state, the edges into it that have been
 * passed (Kahn: Topological sorting of large networks, 1962). */
static tn_status find_order(tn_sparse **out, tn_error *error)
{
    const tn_sparse *sparse = *out;
    uint32_t n = sparse->states, count = 0;
    uint32_t *into = calloc((size_t)n + 1, sizeof *into), *order = malloc(((size_t)n + 1) * sizeof *order);
    bool made = into && order;
    for (size_t e = 0; made && e < sparse->first[n]; e++)
        into[sparse->target[e]]++;
    for (uint32_t s = 0; made && s < n; s++)
        if (into[s] == 0)
            order[count++] = s;
    for (uint32_t i = 0; made && i < count; i++)
        for (size_t e = sparse->first[order[i]]; e < sparse->first[order[i] + 1]; e++)
            if (--into[sparse->target[e]] == 0)
                order[count++] = sparse->target[e];
    tn_status status = made ? TN_OK : tn_fail_memory(error);
    if (made && count == n)
        status = put_in_order(out, order, into, error);
    free(into);
    free(order);
    return status;
}

tn_status tn_sparse_minimise(const tn_sparse *sparse, tn_sparse **out, tn_error *error)
{
    if (sparse->folded)
        return tn_sparse_copy(sparse, out, error);
    tn_sparse_refiner refiner = {.sparse = sparse};
    tn_sparse *made = NULL;
    tn_status status = refiner_make(&refiner, error);
    if (status == TN_OK && sparse->states > 0)
        refine(&refiner);
    else
        refiner.partition.blocks = 0;
    if (status == TN_OK && sparse->states == 0)
        made = tn_sparse_new(sparse->letters, sparse->columns, 0, 0);
    else if (status == TN_OK)
        made = make_quotient(sparse, &refiner.partition);
    if (made && sparse->states == 0)
        memcpy(made->column, sparse->column, sparse->letters * sizeof *sparse->column);
    if (status == TN_OK && (!made || !merge_columns(made))) {
        tn_sparse_free(made);
        made = NULL;
        status = tn_fail_memory(error);
    }
    refiner_clear(&refiner);
    if (status == TN_OK)
        status = find_order(&made, error);
    if (status != TN_OK) {
        tn_sparse_free(made);
        made = NULL;
    }
    *out = made;
    return status;
}

tn_status tn_sparse_apply(tn_sparse **sparse, const tn_dfa *b, tn_dfa_operation operation, const char *what,
                          tn_bounds *bounds, tn_error *error)
{
    tn_sparse *product = NULL, *small = NULL;
    tn_status status;
    if ((*sparse)->folded) {
        status = tn_sparse_fold(*sparse, b, operation, what, bounds, &small, error);
    } else {
        status = tn_sparse_product(*sparse, b, operation, what, bounds, &product, error);
        if (status == TN_OK)
            status = tn_sparse_minimise(product, &small, error);
        tn_sparse_free(product);
    }
    if (status != TN_OK)
        return status;
    tn_sparse_free(*sparse);
    *sparse = small;
    return TN_OK;
}
