/* What takes longer than a keystroke may: what a document's rules mean (the warnings W001 to W009), how many plans they
 * prune, how they lie to one another. A thread of its own does it, on copies of the texts that are open, when typing
 * pauses; the next edit cancels it.
 */
#ifndef TARTAN_LSP_BACKGROUND_H
#define TARTAN_LSP_BACKGROUND_H

#include "lsp/facts.h"
#include "lsp/workspace.h"

typedef struct tn_background tn_background;

/* Starts on a document that compiled. When it is done (or has given up), writes to the event `wake` (eventfd). NULL
 * where that is not possible. */
tn_background *tn_background_start(const tn_workspace *workspace, const tn_document *document, int wake);

/* Lets it give up, soon; does not wait for that. */
void tn_background_cancel(tn_background *background);

/* Has it come to its end? */
bool tn_background_ended(tn_background *background);

/* Waits for its end, and frees it. What was found goes to *analysis (the document's, with the warnings among its
 * diagnostics) and *facts, which may be NULL too; both are NULL where it was cancelled or failed. */
void tn_background_finish(tn_background *background, tn_file_analysis **analysis, tn_facts **facts);

#endif
