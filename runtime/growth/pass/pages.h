/* Large arrays that grow and are used again: mapped in huge pages where the system has them, and enlarged in place or
 * by moving page tables. A growing surface touches each page once; fresh pages at every step would cost as much as the
 * growing. Where pages cannot be moved (Linux alone can), they are on the heap. */
#ifndef TARTAN_GROWTH_PASS_PAGES_H
#define TARTAN_GROWTH_PASS_PAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tn_pages {
    void *data;      /* owned; aligned for any type */
    size_t capacity; /* bytes */
} tn_pages;

/* Makes room for at least `size` bytes, which may be more than a size_t counts; what was there stays. False: out of
 * memory, and nothing changed. */
bool tn_pages_reserve(tn_pages *pages, uint64_t size);
void tn_pages_release(tn_pages *pages);

#endif
