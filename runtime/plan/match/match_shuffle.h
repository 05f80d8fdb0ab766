/* Many small automata stepped by one byte shuffle.
 *
 * A byte shuffle looks up every byte of one vector in another: r[i] = table[v[i]]. So let the byte at rule i's place in
 * v be that rule's state, and let the states of all the rules of the vector be numbered through: then one table, the
 * one of the tray, steps all of the rules at once, and a plan of n trays takes n loads and n shuffles whatever the
 * number of rules in the vector. The bits of the matching rules come out of a last shuffle and a move of sign bits.
 *
 * AVX-512 VBMI shuffles 64 bytes: up to 64 rules of up to 64 states in all. AVX2 shuffles two times 16 bytes. Rules
 * that do not fit, and processors that have neither, are the business of match_joint.h.
 */
#ifndef TARTAN_PLAN_MATCH_MATCH_SHUFFLE_H
#define TARTAN_PLAN_MATCH_MATCH_SHUFFLE_H

#include "runtime/plan/match/match_lanes.h"

/* Instruction sets, each including those before. */
typedef enum tn_simd { TN_SIMD_BEST, TN_SIMD_NONE, TN_SIMD_AVX2, TN_SIMD_AVX512 } tn_simd;

/* The best of this processor that is not past `wanted`. */
tn_simd tn_simd_choose(tn_simd wanted);

/* The stretch of a vector that one shuffle cannot cross: rules from bit `bit` of result word `word` on. */
typedef struct tn_shuffle_block {
    uint64_t used; /* lanes that hold a rule; all of them within the block */
    uint32_t word;
    uint8_t bit;
} tn_shuffle_block;

#define TN_SHUFFLE_BLOCKS_MAX 2

typedef struct tn_shuffle {
    uint8_t *table; /* [rows + 1][width]; the last row, of padding, keeps every state */
    uint8_t start[64];
    uint8_t accept[64]; /* by state: 0 or 0x80 */
    tn_shuffle_block blocks[TN_SHUFFLE_BLOCKS_MAX];
    uint32_t block_count;
} tn_shuffle;

typedef struct tn_shuffles {
    tn_simd simd;
    uint32_t width; /* bytes of a vector */
    tn_shuffle *items;
    size_t count;
} tn_shuffles;

/* Packs the automata (NULL: none) into vectors, in order, and sets taken[i] for those that are in. Free with
 * tn_shuffles_clear, also after a failure. */
tn_status tn_shuffles_make(tn_shuffles *shuffles, tn_simd simd, const tn_row_map *map, tn_dfa *const *dfas,
                           size_t count, bool *taken, tn_error *error);
void tn_shuffles_clear(tn_shuffles *shuffles);

/* Adds the bits of the vector's rules to bits[lane * words + word]. */
void tn_shuffle_walk(const tn_shuffles *shuffles, size_t i, const tn_lanes *lanes, uint64_t *bits, size_t words);

#endif
