/* A set of small numbers that finds its next member quickly: a tree of bits, sixty-four to a word.
 *
 * Adding, removing and finding take a step a level, of which 2^32 numbers need six. The owner frees the set with
 * tn_bit_tree_clear. */
#ifndef TARTAN_GEOMETRY_BIT_TREE_H
#define TARTAN_GEOMETRY_BIT_TREE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define TN_BIT_TREE_LEVELS 6u
#define TN_BIT_TREE_NONE UINT32_MAX

typedef struct tn_bit_tree {
    uint64_t *words;
    uint32_t first[TN_BIT_TREE_LEVELS]; /* of each level's words; level 0 holds the members */
    uint32_t levels;
    uint32_t used; /* words of all levels */
} tn_bit_tree;

/* Lays out an empty set of the numbers 0 to count - 1 (count at least 1) in words that a larger set had. */
static inline void tn_bit_tree_reset(tn_bit_tree *tree, uint32_t count)
{
    uint32_t size = count;
    tree->used = tree->levels = 0;
    do {
        size = (uint32_t)(((uint64_t)size + 63) / 64);
        tree->first[tree->levels++] = tree->used;
        tree->used += size;
    } while (size > 1);
    memset(tree->words, 0, tree->used * sizeof *tree->words);
}

/* An empty set with room for the numbers 0 to count - 1. False: out of memory. */
static inline bool tn_bit_tree_new(tn_bit_tree *tree, uint32_t count)
{
    uint64_t words = 0, size = count;
    do {
        size = (size + 63) / 64;
        words += size;
    } while (size > 1);
    tree->words = malloc((size_t)words * sizeof *tree->words);
    if (tree->words)
        tn_bit_tree_reset(tree, count);
    return tree->words != NULL;
}

static inline void tn_bit_tree_clear(tn_bit_tree *tree)
{
    free(tree->words);
    *tree = (tn_bit_tree){0};
}

static inline void tn_bit_tree_add(tn_bit_tree *tree, uint32_t member)
{
    for (uint32_t level = 0; level < tree->levels; level++, member /= 64)
        tree->words[tree->first[level] + member / 64] |= UINT64_C(1) << member % 64;
}

static inline void tn_bit_tree_remove(tn_bit_tree *tree, uint32_t member)
{
    for (uint32_t level = 0; level < tree->levels; level++, member /= 64)
        if ((tree->words[tree->first[level] + member / 64] &= ~(UINT64_C(1) << member % 64)) != 0)
            return;
}

/* The least member that is not below `from`; TN_BIT_TREE_NONE if there is none. */
static inline uint32_t tn_bit_tree_next(const tn_bit_tree *tree, uint32_t from)
{
    uint32_t level = 0, word = from / 64, top = tree->levels - 1;
    uint64_t bits = tree->words[tree->first[0] + word] & UINT64_MAX << from % 64;
    while (!bits && level < top) { /* up to a word that has a later member */
        uint64_t later = UINT64_MAX << word % 64 << 1;
        word /= 64;
        bits = tree->words[tree->first[++level] + word] & later;
    }
    if (!bits)
        return TN_BIT_TREE_NONE;
    while (level > 0) { /* down to its first */
        word = word * 64 + (uint32_t)__builtin_ctzll(bits);
        bits = tree->words[tree->first[--level] + word];
    }
    return word * 64 + (uint32_t)__builtin_ctzll(bits);
}

#endif
