/* What `tartan explain` answers of houses, as text for people. */
#ifndef TARTAN_CLI_PLAN_EXPLAIN_TEXT_H
#define TARTAN_CLI_PLAN_EXPLAIN_TEXT_H

#include "ask/session/requests.h"
#include "runtime/base/buffer.h"

/* full: also clauses that keep the house. */
void tn_explain_house_text(const tn_explained_house *explained, bool full, tn_buffer *out);

void tn_explain_house_rules_text(const tn_explained_house_by_rules *explained, tn_buffer *out);
void tn_explain_cells_text(const tn_explained_cells *explained, tn_buffer *out);

#endif
