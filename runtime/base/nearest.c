/* Finds the word that was likely meant, and joins words to a list. */
#include "runtime/base/nearest.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Longer words are no slips of the pen. */
enum { WORD_MAX = 63 };

/* The characters of a word, capitals as small letters where they are of ASCII: how many, or more than WORD_MAX. */
static size_t letters(const char *word, uint32_t read[WORD_MAX])
{
    size_t count = 0;
    for (; *word && count <= WORD_MAX; word++) {
        unsigned char byte = (unsigned char)*word;
        bool goes_on = (byte & 0xc0) == 0x80 && count > 0;
        if (goes_on)
            read[count - 1] = read[count - 1] << 8 | byte;
        else if (count++ < WORD_MAX)
            read[count - 1] = byte >= 'A' && byte <= 'Z' ? (uint32_t)(byte - 'A' + 'a') : byte;
    }
    return count;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Optimal string alignment distance: Levenshtein's, with a swap of neighbours as one step. */
static size_t distance(const uint32_t *a, size_t a_size, const uint32_t *b, size_t b_size)
{
    size_t rows[3][WORD_MAX + 1];
    size_t *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b_size; j++) {
        before[j] = 0;
        last[j] = j;
    }
    for (size_t i = 1; i <= a_size; i++) {
        row[0] = i;
        for (size_t j = 1; j <= b_size; j++) {
            size_t replaced = last[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = least(replaced, least(last[j], row[j - 1]) + 1);
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped)
                row[j] = least(row[j], before[j - 2] + 1);
        }
        size_t *spare = before;
        before = last;
        last = row;
        row = spare;
    }
    return last[b_size];
}

const char *tn_nearest(const char *word, const char *const *candidates, size_t count)
{
    uint32_t wrong[WORD_MAX], candidate[WORD_MAX];
    size_t size = letters(word, wrong);
    if (size == 0 || size > WORD_MAX)
        return NULL;
    /* A third of the letters may be wrong, one at least; but something of the word must remain. */
    size_t best_distance = least(size < 6 ? 1 : size / 3, size - 1) + 1;
    const char *best = NULL;
    for (size_t i = 0; i < count; i++) {
        size_t candidate_size = letters(candidates[i], candidate);
        if (candidate_size > WORD_MAX || candidate_size + best_distance <= size ||
            size + best_distance <= candidate_size)
            continue;
        size_t d = distance(wrong, size, candidate, candidate_size);
        if (d < best_distance) {
            best_distance = d;
            best = candidates[i];
        }
    }
    return best;
}

void tn_word_list(const char *const *words, size_t count, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < count && used < size; i++) {
        const char *between = i == 0 ? "" : i + 1 == count ? " and " : ", ";
        used += (size_t)snprintf(text + used, size - used, "%s%s", between, words[i]);
    }
}
