/* Canonical and minimal forms of complete automata. Minimising itself is on the live transitions (sparse_minimise.c).
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/dfa.h"
#include "runtime/automata/numbering.h"
#include "runtime/automata/sparse.h"
#include "runtime/base/array.h"

/* ---- tidying: equal columns merged, unreachable states dropped, canonical numbers */

/* Gives each column the first one with its hash; columns of which that one differs keep themselves. */
static void check_equal(const tn_dfa *dfa, uint32_t *same)
{
    for (uint32_t s = 0; s < dfa->states; s++) {
        const uint32_t *row = dfa->delta + (size_t)s * dfa->columns;
        for (uint32_t c = 0; c < dfa->columns; c++)
            if (row[c] != row[same[c]])
                same[c] = c;
    }
}

/* Says of each column which is the first one equal to it. (Two different columns with one hash of 64 bits would at
 * worst hide that further ones are equal.) */
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
        if (ok && number == before)
            first[number] = c;
        if (ok)
            same[c] = first[number];
    }
    if (ok)
        check_equal(dfa, same);
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

tn_status tn_dfa_tidy(const tn_dfa *dfa, uint32_t start, tn_dfa **out, tn_error *error)
{
    tn_tidy tidy = {0};
    size_t n = dfa->states, k = dfa->columns;
    tidy.memory = tn_array_new(3 * (uint64_t)k + 2 * (uint64_t)n + 1, sizeof *tidy.memory);
    if (!tidy.memory)
        return tn_fail_memory(error);
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
    *out = copy;
    return copy ? TN_OK : tn_fail_memory(error);
}

tn_status tn_dfa_minimise(const tn_dfa *dfa, uint32_t start, tn_dfa **out, tn_error *error)
{
    tn_sparse *live = NULL, *small = NULL;
    tn_status status = tn_sparse_make(dfa, start, &live, error);
    if (status == TN_OK)
        status = tn_sparse_minimise(live, &small, error);
    if (status == TN_OK)
        status = tn_sparse_complete(small, out, error);
    tn_sparse_free(live);
    tn_sparse_free(small);
    return status;
}
