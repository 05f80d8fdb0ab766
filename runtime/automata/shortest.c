/* Finds the shortest word of an automaton: which states accept after so many letters more, letter by letter, and then
 * forward along the first such letters. */
#include "runtime/automata/shortest.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

typedef struct layers {
    const tn_sparse *sparse;
    size_t words;   /* of a layer */
    uint64_t *bits; /* [count][words]: bit s of layer k: state s accepts some word of k letters */
    size_t count, capacity;
} layers;

static bool has(const layers *l, size_t layer, uint32_t state)
{
    return l->bits[layer * l->words + state / 64] >> (state % 64) & 1;
}

/* Adds the next layer; *any: is some state in it? */
static bool add_layer(layers *l, bool *any)
{
    const tn_sparse *sparse = l->sparse;
    if (!tn_array_reserve_from(&l->bits, &l->capacity, 4 * l->words, l->count * l->words, l->words, sizeof *l->bits))
        return false;
    uint64_t *bits = l->bits + l->count * l->words;
    memset(bits, 0, l->words * sizeof *bits);
    *any = false;
    for (uint32_t s = 0; s < sparse->states; s++) {
        bool in = l->count == 0 && sparse->accept[s];
        for (size_t e = sparse->first[s]; l->count > 0 && !in && e < sparse->first[s + 1]; e++)
            in = has(l, l->count - 1, sparse->target[e]);
        bits[s / 64] |= (uint64_t)in << (s % 64);
        *any = *any || in;
    }
    l->count++;
    return true;
}

/* first[c]: the first letter of each column. NULL where out of memory. */
static uint32_t *first_letters(const tn_sparse *sparse)
{
    uint32_t *first = malloc(((size_t)sparse->columns + 1) * sizeof *first);
    if (first)
        memset(first, 0xff, ((size_t)sparse->columns + 1) * sizeof *first);
    for (uint32_t letter = sparse->letters; first && letter-- > 0;)
        first[sparse->column[letter]] = letter;
    return first;
}

/* From the start along the first letters that the layers allow. */
static bool read_word(const layers *l, const uint32_t *first, tn_key *word)
{
    const tn_sparse *sparse = l->sparse;
    uint32_t state = 0;
    for (size_t left = l->count - 1; left > 0; left--) {
        uint32_t letter = UINT32_MAX, to = 0;
        for (size_t e = sparse->first[state]; e < sparse->first[state + 1]; e++)
            if (first[sparse->label[e]] < letter && has(l, left - 1, sparse->target[e])) {
                letter = first[sparse->label[e]];
                to = sparse->target[e];
            }
        if (!tn_key_push(word, letter))
            return false;
        state = to;
    }
    return true;
}

tn_status tn_sparse_shortest(const tn_sparse *sparse, uint32_t min, uint32_t max, tn_key *word, bool *found,
                             tn_error *error)
{
    layers l = {.sparse = sparse, .words = sparse->states / 64 + 1};
    bool good = true, any = sparse->states > 0;
    *found = false;
    while (good && any && !*found && l.count <= max) {
        good = add_layer(&l, &any);
        *found = good && l.count > min && has(&l, l.count - 1, 0);
    }
    uint32_t *first = good && *found ? first_letters(sparse) : NULL;
    if (*found)
        good = first && read_word(&l, first, word);
    free(first);
    free(l.bits);
    return good ? TN_OK : tn_fail_memory(error);
}
