/* What the rules of a document's libraries prune, for hovering. Counting can take long, so it is done by a thread of
 * its own, for the latest text that compiles; until it is done there is nothing to say. */
#ifndef TARTAN_LSP_COUNTS_H
#define TARTAN_LSP_COUNTS_H

#include <pthread.h>

#include "lsp/index.h"

typedef struct tn_rule_count {
    char *library, *rule;
    char *prunes, *only; /* in digits; rule NULL: how many are generated and kept */
} tn_rule_count;

typedef struct tn_counts {
    pthread_t thread;
    uint8_t *module; /* what is counted */
    size_t module_size;
    pthread_mutex_t lock;
    bool done; /* under the lock; the rest is then only read */
    tn_rule_count *items;
    size_t count, capacity;
} tn_counts;

/* Starts counting the libraries of a module, which is copied. NULL where that is not possible. */
tn_counts *tn_counts_start(const uint8_t *module, size_t size);

/* Waits for the thread. NULL does nothing. */
void tn_counts_free(tn_counts *counts);

/* Has the thread come to its end? */
bool tn_counts_done(tn_counts *counts);

/* Is it of this module? */
bool tn_counts_are_of(const tn_counts *counts, const uint8_t *module, size_t size);

/* What there is to say about a rule or library, one library a line; NULL where there is nothing (yet). The caller frees
 * it. */
char *tn_counts_text(tn_counts *counts, const tn_symbol *symbol);

#endif
