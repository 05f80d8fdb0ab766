/* Words for help: the one that was likely meant, and lists of those that there are. */
#ifndef TARTAN_BASE_NEAREST_H
#define TARTAN_BASE_NEAREST_H

#include <stddef.h>

/* The candidate nearest to `word` by edit distance (insert, delete, replace, swap neighbours; case does not count), the
 * first of several; NULL if none is near enough to suggest. */
const char *tn_nearest(const char *word, const char *const *candidates, size_t count);

/* "a, b and c" into `text`, cut off where it has no room. */
void tn_word_list(const char *const *words, size_t count, char *text, size_t size);

#endif
