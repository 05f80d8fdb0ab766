/* The answers to what editors ask about one document. Each returns a value of its own (`null` where there is nothing to
 * say), or NULL where out of memory. `offset` is the byte that the cursor is before. */
#ifndef TARTAN_LSP_FEATURES_H
#define TARTAN_LSP_FEATURES_H

#include "lsp/workspace.h"

/* The parameters of textDocument/publishDiagnostics. pages: the address of the documentation's pages, one of which each
 * code then links to; or NULL. */
json_t *tn_lsp_diagnostics(tn_document *document, tn_file_analysis *analysis, const char *pages);

json_t *tn_lsp_outline(tn_document *document, tn_file_analysis *analysis);
json_t *tn_lsp_hover(tn_document *document, tn_file_analysis *analysis, size_t offset);
json_t *tn_lsp_definition(tn_document *document, tn_file_analysis *analysis, size_t offset);
json_t *tn_lsp_references(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset,
                          bool declaration);
json_t *tn_lsp_highlight(tn_document *document, tn_file_analysis *analysis, size_t offset);

/* The range of a name that can be renamed, or null. */
json_t *tn_lsp_prepare_rename(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis,
                              size_t offset);
/* A workspace edit; NULL with *reason where the name cannot be changed so. */
json_t *tn_lsp_rename(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset,
                      const char *name, const char **reason);

json_t *tn_lsp_completion(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset);
/* What the word of the language that the cursor is in says there, with its stretch in *span; NULL where there is none.
 */
const char *tn_lsp_word(tn_document *document, tn_file_analysis *analysis, size_t offset, tn_span *span);
json_t *tn_lsp_format(tn_document *document);

/* Quick fixes for what is wrong in [begin, end), to a list. */
void tn_lsp_fixes(tn_document *document, tn_file_analysis *analysis, size_t begin, size_t end, json_t *list);

/* What can be done with the part of a rule there, as pictures of rules have it (compiler/plan/edit/rule_edit.h). Each
 * action has its edit if `whole`, otherwise what tn_lsp_resolve makes it of. False where out of memory. */
bool tn_lsp_rule_actions(tn_document *document, tn_file_analysis *analysis, size_t begin, size_t end, bool whole,
                         json_t *list);

/* The document that such an action is about; NULL: it is none, or of a document or version that is not open. */
tn_document *tn_lsp_action_document(const tn_workspace *workspace, const json_t *action);

/* The action with its edit. NULL where out of memory, or with *reason (valid until the next call) why there is none. */
json_t *tn_lsp_resolve(tn_document *document, tn_file_analysis *analysis, const json_t *action, char reason[400]);

#endif
