/* Relations over the stretches of a plan, as bits, and what the rule opcodes do to them.
 *
 * A relation over a plan of N trays has N + 1 rows of `words` words, words = N / 64 + 1; bit j of row i says whether
 * the stretch [i, j) is in it. Bits with j < i and past N are always clear. Everything is inline and takes `words`, so
 * that a caller who passes the constant 1 (N <= 63) gets code for single words.
 *
 * The operations that shrink or close a relation work in place. Nothing here allocates or fails.
 */
#ifndef TARTAN_PLAN_MATCH_RELATION_H
#define TARTAN_PLAN_MATCH_RELATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define TN_RELATION_INLINE static inline __attribute__((always_inline))
#define TN_NO_BIT SIZE_MAX

/* The bits of word `word` that stand for numbers >= first. */
TN_RELATION_INLINE uint64_t tn_bits_from(size_t first, size_t word)
{
    size_t base = word * 64;
    if (first <= base)
        return ~UINT64_C(0);
    return first >= base + 64 ? 0 : ~UINT64_C(0) << (first - base);
}

/* The bits of word `word` that stand for numbers <= last. */
TN_RELATION_INLINE uint64_t tn_bits_to(size_t last, size_t word)
{
    size_t base = word * 64;
    if (last < base)
        return 0;
    return last >= base + 63 ? ~UINT64_C(0) : ~UINT64_C(0) >> (63 - (last - base));
}

TN_RELATION_INLINE uint64_t *tn_relation_row(uint64_t *relation, size_t row, size_t words)
{
    return relation + row * words;
}

TN_RELATION_INLINE bool tn_relation_row_has(const uint64_t *row, size_t bit)
{
    return row[bit / 64] >> (bit % 64) & 1;
}

TN_RELATION_INLINE void tn_relation_row_set(uint64_t *row, size_t bit)
{
    row[bit / 64] |= UINT64_C(1) << (bit % 64);
}

TN_RELATION_INLINE void tn_relation_row_clear(uint64_t *row, size_t bit)
{
    row[bit / 64] &= ~(UINT64_C(1) << (bit % 64));
}

/* The least bit >= first, or TN_NO_BIT. */
TN_RELATION_INLINE size_t tn_relation_row_next(const uint64_t *row, size_t first, size_t words)
{
    for (size_t w = first / 64; w < words; w++) {
        uint64_t bits = row[w] & tn_bits_from(first, w);
        if (bits)
            return w * 64 + (size_t)__builtin_ctzll(bits);
    }
    return TN_NO_BIT;
}

/* The greatest bit, or TN_NO_BIT. */
TN_RELATION_INLINE size_t tn_row_last(const uint64_t *row, size_t words)
{
    for (size_t w = words; w-- > 0;) {
        if (row[w])
            return w * 64 + 63 - (size_t)__builtin_clzll(row[w]);
    }
    return TN_NO_BIT;
}

/* The bits of [first, last]; none where first > last. */
TN_RELATION_INLINE void tn_row_range(uint64_t *row, size_t first, size_t last, size_t words)
{
    for (size_t w = 0; w < words; w++)
        row[w] = tn_bits_from(first, w) & tn_bits_to(last, w);
}

/* Is [k, k + 1) in the relation? */
TN_RELATION_INLINE bool tn_relation_single(const uint64_t *relation, size_t k, size_t words)
{
    return tn_relation_row_has(relation + k * words, k + 1);
}

TN_RELATION_INLINE void tn_relation_and(uint64_t *into, const uint64_t *other, size_t trays, size_t words)
{
    for (size_t w = 0; w < (trays + 1) * words; w++)
        into[w] &= other[w];
}

TN_RELATION_INLINE void tn_relation_or(uint64_t *into, const uint64_t *other, size_t trays, size_t words)
{
    for (size_t w = 0; w < (trays + 1) * words; w++)
        into[w] |= other[w];
}

TN_RELATION_INLINE void tn_relation_not(uint64_t *relation, size_t trays, size_t words)
{
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = tn_relation_row(relation, i, words);
        for (size_t w = 0; w < words; w++)
            row[w] = ~row[w] & tn_bits_from(i, w) & tn_bits_to(trays, w);
    }
}

/* H from M: [i, j) contains a non-empty stretch of the relation once j reaches the first end of one that starts at i or
 * later. */
TN_RELATION_INLINE void tn_relation_somewhere(uint64_t *relation, size_t trays, size_t words)
{
    size_t first_end = TN_NO_BIT;
    for (size_t i = trays + 1; i-- > 0;) {
        uint64_t *row = tn_relation_row(relation, i, words);
        size_t end = tn_relation_row_next(row, i + 1, words);
        first_end = end < first_end ? end : first_end;
        tn_row_range(row, first_end, trays, words);
    }
}

TN_RELATION_INLINE void tn_relation_nonempty(uint64_t *relation, size_t trays, size_t words)
{
    for (size_t i = 0; i <= trays; i++)
        tn_relation_row_clear(tn_relation_row(relation, i, words), i);
}

TN_RELATION_INLINE void tn_relation_optional(uint64_t *relation, size_t trays, size_t words)
{
    for (size_t i = 0; i <= trays; i++)
        tn_relation_row_set(tn_relation_row(relation, i, words), i);
}

/* lower := { [i, j) : some c has [i, c) in lower and [c, j) in upper }. `row_room` is room for one row. */
TN_RELATION_INLINE void tn_relation_chain(uint64_t *lower, const uint64_t *upper, size_t trays, size_t words,
                                          uint64_t *row_room)
{
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = tn_relation_row(lower, i, words);
        memset(row_room, 0, words * sizeof *row_room);
        for (size_t w = 0; w < words; w++) {
            for (uint64_t cuts = row[w]; cuts; cuts &= cuts - 1) {
                const uint64_t *rest = upper + (w * 64 + (size_t)__builtin_ctzll(cuts)) * words;
                for (size_t v = 0; v < words; v++)
                    row_room[v] |= rest[v];
            }
        }
        memcpy(row, row_room, words * sizeof *row);
    }
}

/* relation := what any number of non-empty stretches of it make, one after another; none of them, too. Row i is made of
 * the rows behind it. */
TN_RELATION_INLINE void tn_relation_star(uint64_t *relation, size_t trays, size_t words, uint64_t *row_room)
{
    for (size_t i = trays + 1; i-- > 0;) {
        uint64_t *row = tn_relation_row(relation, i, words);
        memset(row_room, 0, words * sizeof *row_room);
        tn_relation_row_set(row_room, i);
        for (size_t end = tn_relation_row_next(row, i + 1, words); end != TN_NO_BIT;
             end = end < trays ? tn_relation_row_next(row, end + 1, words) : TN_NO_BIT)
            for (size_t w = 0; w < words; w++)
                row_room[w] |= relation[end * words + w];
        memcpy(row, row_room, words * sizeof *row);
    }
}

TN_RELATION_INLINE void tn_relation_beginning(uint64_t *relation, size_t trays, size_t words)
{
    memset(relation + words, 0, trays * words * sizeof *relation);
}

TN_RELATION_INLINE void tn_relation_end(uint64_t *relation, size_t trays, size_t words)
{
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = tn_relation_row(relation, i, words);
        bool ends = tn_relation_row_has(row, trays);
        memset(row, 0, words * sizeof *row);
        if (ends)
            tn_relation_row_set(row, trays);
    }
}

/* Non-empty stretches of which each single tray is in the relation: row i reaches to the end of the run of trays at i.
 */
TN_RELATION_INLINE void tn_relation_many(uint64_t *relation, size_t trays, size_t words)
{
    size_t run_end = 0; /* of the run that tray i + 1 is in; 0 where it is in none */
    memset(tn_relation_row(relation, trays, words), 0, words * sizeof *relation);
    for (size_t i = trays; i-- > 0;) {
        uint64_t *row = tn_relation_row(relation, i, words);
        if (!tn_relation_row_has(row, i + 1))
            run_end = 0;
        else if (run_end == 0)
            run_end = i + 1;
        tn_row_range(row, i + 1, run_end, words);
    }
}

/* What a distance needs to know of its destinations and its separator. Each array is borrowed from the caller. */
typedef struct tn_gaps {
    uint64_t *begins;     /* row: where destinations begin */
    uint64_t *ends;       /* row: where destinations end */
    uint64_t *right_fine; /* row: the j such that every destination at or after j has its gap [j, a) in the separator */
    uint64_t *left_bad;   /* row: the i such that a destination before i has its gap [b, i) not in the separator */
    size_t *overlap_from; /* [N + 1]: the least begin of a destination that ends after i, or TN_NO_BIT */
} tn_gaps;

TN_RELATION_INLINE void tn_gaps_find(const tn_gaps *gaps, const uint64_t *destination, const uint64_t *separator,
                                     size_t trays, size_t words)
{
    memset(gaps->begins, 0, words * sizeof(uint64_t));
    memset(gaps->ends, 0, words * sizeof(uint64_t));
    size_t covered = 0; /* overlap_from is known for i < covered */
    for (size_t a = 0; a <= trays; a++) {
        const uint64_t *row = destination + a * words;
        bool begins = false;
        for (size_t w = 0; w < words; w++) {
            uint64_t ends = row[w] & tn_bits_from(a + 1, w); /* empty destinations do not count */
            gaps->ends[w] |= ends;
            begins = begins || ends;
        }
        if (!begins)
            continue;
        tn_relation_row_set(gaps->begins, a);
        for (size_t last = tn_row_last(row, words); covered < last; covered++)
            gaps->overlap_from[covered] = a;
    }
    for (; covered <= trays; covered++)
        gaps->overlap_from[covered] = TN_NO_BIT;

    memset(gaps->right_fine, 0, words * sizeof(uint64_t));
    memset(gaps->left_bad, 0, words * sizeof(uint64_t));
    for (size_t j = 0; j <= trays; j++) {
        const uint64_t *row = separator + j * words;
        bool fine = true, ends_here = tn_relation_row_has(gaps->ends, j);
        for (size_t w = 0; w < words; w++) {
            uint64_t missing = ~row[w] & tn_bits_from(j, w) & tn_bits_to(trays, w);
            fine = fine && !(gaps->begins[w] & missing);
            if (ends_here)
                gaps->left_bad[w] |= missing;
        }
        if (fine)
            tn_relation_row_set(gaps->right_fine, j);
    }
}

/* source := { [i, j) of it, i < j, such that the gap to every destination is in the separator }. `gaps` is room. */
TN_RELATION_INLINE void tn_relation_distance(uint64_t *source, const uint64_t *destination, const uint64_t *separator,
                                             size_t trays, size_t words, const tn_gaps *gaps)
{
    tn_gaps_find(gaps, destination, separator, trays, words);
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = tn_relation_row(source, i, words);
        bool fine = !tn_relation_row_has(gaps->left_bad, i);
        bool may_overlap = gaps->overlap_from[i] == TN_NO_BIT || tn_relation_row_has(separator + i * words, i);
        size_t last = may_overlap ? trays : gaps->overlap_from[i];
        for (size_t w = 0; w < words; w++)
            row[w] &= fine ? gaps->right_fine[w] & tn_bits_from(i + 1, w) & tn_bits_to(last, w) : 0;
    }
}

/* source := { [i, j) of it, i < j, such that the gap to every destination that shares no tray with it is in the
 * separator }. */
TN_RELATION_INLINE void tn_relation_far(uint64_t *source, const uint64_t *destination, const uint64_t *separator,
                                        size_t trays, size_t words, const tn_gaps *gaps)
{
    tn_gaps_find(gaps, destination, separator, trays, words);
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = tn_relation_row(source, i, words);
        bool fine = !tn_relation_row_has(gaps->left_bad, i);
        for (size_t w = 0; w < words; w++)
            row[w] &= fine ? gaps->right_fine[w] & tn_bits_from(i + 1, w) : 0;
    }
}

/* source := { [i, j) of it, i < j, with a destination that shares no tray with it and whose gap is in the separator }:
 * not all gaps are outside of it. The separator is turned into its opposite. */
TN_RELATION_INLINE void tn_relation_near(uint64_t *source, const uint64_t *destination, uint64_t *separator,
                                         size_t trays, size_t words, const tn_gaps *gaps)
{
    tn_relation_not(separator, trays, words);
    tn_gaps_find(gaps, destination, separator, trays, words);
    for (size_t i = 0; i <= trays; i++) {
        uint64_t *row = tn_relation_row(source, i, words);
        bool left = tn_relation_row_has(gaps->left_bad, i);
        for (size_t w = 0; w < words; w++)
            row[w] &= (left ? ~UINT64_C(0) : ~gaps->right_fine[w]) & tn_bits_from(i + 1, w);
    }
}

/* turned := { [N - j, N - i) : [i, j) in relation }. */
TN_RELATION_INLINE void tn_relation_turn(uint64_t *turned, const uint64_t *relation, size_t trays, size_t words)
{
    memset(turned, 0, (trays + 1) * words * sizeof *turned);
    for (size_t i = 0; i <= trays; i++) {
        const uint64_t *row = relation + i * words;
        for (size_t w = 0; w < words; w++) {
            for (uint64_t bits = row[w]; bits; bits &= bits - 1) {
                size_t j = w * 64 + (size_t)__builtin_ctzll(bits);
                tn_relation_row_set(turned + (trays - j) * words, trays - i);
            }
        }
    }
}

#endif
