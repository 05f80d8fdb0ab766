/* CHAIN (M of neighbour): exists a cut. A set's pairs (p, q) are: before x, the one pair of both automata; after it,
 * that pair with x read by the first (the cut is still to come; p is between its markers) and the pairs that were cut
 * somewhere (p is after its second marker, q after its first). */
#include <stdlib.h>

#include "runtime/automata/explore.h"
#include "runtime/automata/marked.h"
#include "runtime/automata/operand.h"

typedef struct tn_chain {
    tn_join join;
    uint32_t marker; /* column of the join */
    tn_operand a, b;
    tn_pairs pairs;
} tn_chain;

/* Adds a pair whose cut is still to come, and the pair that is cut here. */
static void add_uncut(tn_chain *chain, uint32_t p, uint32_t q)
{
    tn_pairs_add(&chain->pairs, p, q);
    if (p != chain->a.dead && q != chain->b.dead)
        tn_pairs_add(&chain->pairs, tn_operand_mark(&chain->a, p), tn_operand_mark(&chain->b, q));
}

static void chain_marker(tn_chain *chain, uint32_t phase, uint32_t p, uint32_t q)
{
    if (phase == 0)
        add_uncut(chain, tn_operand_mark(&chain->a, p), q);
    else if (phase == 1 && chain->a.phase[p] == 2)
        tn_pairs_add(&chain->pairs, p, tn_operand_mark(&chain->b, q));
}

/* A key is the phase, then the pairs; without pairs, nothing. */
static bool chain_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_chain *chain = context;
    chain->pairs.size = 0;
    if (size == 0)
        return true;
    const uint32_t *pick = chain->join.pick + (size_t)column * 2;
    uint32_t phase = key[0];
    for (size_t i = 1; i < size; i += 2) {
        uint32_t p = key[i], q = key[i + 1];
        if (column == chain->marker) {
            chain_marker(chain, phase, p, q);
            continue;
        }
        bool uncut = phase == 1 && chain->a.phase[p] == 1;
        p = tn_operand_read(&chain->a, p, pick[0]);
        q = tn_operand_read(&chain->b, q, pick[1]);
        if (uncut)
            add_uncut(chain, p, q);
        else
            tn_pairs_add(&chain->pairs, p, q);
    }
    if (chain->pairs.failed)
        return false;
    if (chain->pairs.size == 0)
        return true;
    return tn_key_push(next, phase + (column == chain->marker)) && tn_pairs_write(&chain->pairs, next);
}

static bool chain_accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_chain *chain = context;
    for (size_t i = 1; i < size; i += 2)
        if (chain->a.dfa->accept[key[i]] && chain->b.dfa->accept[key[i + 1]])
            return true;
    return false;
}

tn_status tn_marked_chain(const tn_marked *marked, const tn_dfa *a, const tn_dfa *b, tn_dfa **out, tn_error *error)
{
    tn_chain chain = {0};
    const tn_dfa *parts[2] = {a, b};
    tn_key start = {0};
    tn_status status = tn_join_make(&chain.join, parts, 2, marked->letters, NULL, true, error);
    if (status == TN_OK)
        status = tn_operand_make(&chain.a, a, error);
    if (status == TN_OK)
        status = tn_operand_make(&chain.b, b, error);
    if (status == TN_OK) {
        chain.marker = chain.join.column[marked->letters - 1];
        chain.pairs.first = &chain.a;
        chain.pairs.second = &chain.b;
        tn_pairs_add(&chain.pairs, 0, 0);
        bool ok = chain.pairs.size == 0 || (tn_key_push(&start, 0) && tn_pairs_write(&chain.pairs, &start));
        status = ok && !chain.pairs.failed ? TN_OK : tn_fail_memory(error);
    }
    if (status == TN_OK) {
        tn_construction construction = {"neighbour", &chain.join, &chain, chain_step, chain_accepts};
        status = tn_explore(&construction, &start, &chain.pairs.effort, marked->bounds, out, error);
    }
    free(start.data);
    tn_join_clear(&chain.join);
    tn_operand_clear(&chain.a);
    tn_operand_clear(&chain.b);
    tn_pairs_clear(&chain.pairs);
    return status;
}
