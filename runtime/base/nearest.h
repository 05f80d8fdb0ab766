/* "Did you mean": the word that was likely meant. */
#ifndef TARTAN_BASE_NEAREST_H
#define TARTAN_BASE_NEAREST_H

#include <stddef.h>

/* The candidate nearest to `word` by edit distance (insert, delete, replace, swap neighbours; case does not count), the
 * first of several; NULL where none is near enough to suggest. */
const char *tn_nearest(const char *word, const char *const *candidates, size_t count);

#endif
