/* Where a name occurs: in the documents that are open, in what they use, and in the rule files of the editor's folders
 * that use the same file. */
#ifndef TARTAN_LSP_OCCURRENCES_H
#define TARTAN_LSP_OCCURRENCES_H

#include "lsp/workspace.h"

/* `document` is open, or was read for this: it is gone after the call. False ends the visit. */
typedef bool tn_visit_occurrence(void *context, tn_document *document, tn_span span);

typedef enum tn_visited {
    TN_VISITED_ALL,
    TN_VISITED_CUT_OFF, /* the folders have more files than are looked at */
    TN_VISITED_STOPPED, /* by the visitor, or out of memory */
} tn_visited;

/* Visits every occurrence of a symbol of the asked document's analysis once. */
tn_visited tn_each_occurrence(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol,
                              tn_visit_occurrence *visit, void *context);

/* Are two paths those of one file? */
bool tn_same_file(const char *a, const char *b);

static inline const char *tn_analysis_path(const tn_file_analysis *analysis, uint32_t file)
{
    return analysis->compilation.sources.files[file].path;
}

#endif
