/* What takes longer than a keystroke may: what a document's rules mean (the warnings W001 to W009), how many plans they
 * prune, how they lie to one another. It is found on copies of the texts that are open, so that these may change
 * meanwhile, by whichever thread the caller has for it. */
#ifndef TARTAN_LSP_REVIEW_H
#define TARTAN_LSP_REVIEW_H

#include "lsp/facts.h"
#include "lsp/workspace.h"

typedef struct tn_review tn_review;

/* Makes ready to review a document that compiled. The workspace stays until the review is freed. NULL where out of
 * memory. */
tn_review *tn_review_new(const tn_workspace *workspace, const tn_document *document);

/* Reviews; returns when all is found, the review is cancelled, or so many seconds have passed, which cancels it. Once,
 * on any thread. */
void tn_review_run(tn_review *review, double seconds);

/* Lets it give up, soon; does not wait for that. From any thread. */
void tn_review_cancel(tn_review *review);

/* Frees it, after it has run or instead. What was found goes to *analysis (the document's, with the warnings among its
 * diagnostics) and *facts, which may be NULL too; both are NULL if it was cancelled, has failed or has not run. */
void tn_review_end(tn_review *review, tn_file_analysis **analysis, tn_facts **facts);

/* ---- A thread of its own for what takes longer than a keystroke may (review.h) */

typedef struct tn_background tn_background;

/* Starts a thread that reviews, for so long at most. When it is done, or has given up, the thread calls `ended`. NULL
 * if there can be no thread. */
tn_background *tn_background_start(tn_review *review, double seconds, void (*ended)(void *context), void *context);

/* Has it called `ended`? */
bool tn_background_ended(tn_background *background);

/* Waits for its end, and frees it; the review is the caller's again, and is returned. */
tn_review *tn_background_join(tn_background *background);

#endif
