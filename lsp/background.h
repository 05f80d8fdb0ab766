/* A thread of its own for what takes longer than a keystroke may (review.h). */
#ifndef TARTAN_LSP_BACKGROUND_H
#define TARTAN_LSP_BACKGROUND_H

#include "lsp/review.h"

typedef struct tn_background tn_background;

/* Starts a thread that reviews, for so long at most. When it is done, or has given up, the thread calls `ended`. NULL
 * if there can be no thread. */
tn_background *tn_background_start(tn_review *review, double seconds, void (*ended)(void *context), void *context);

/* Has it called `ended`? */
bool tn_background_ended(tn_background *background);

/* Waits for its end, and frees it; the review is the caller's again, and is returned. */
tn_review *tn_background_join(tn_background *background);

#endif
