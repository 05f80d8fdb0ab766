/* Keeps a rule laid out that was. */
#ifndef TARTAN_COMPILER_PLAN_EDIT_RULE_LAYOUT_H
#define TARTAN_COMPILER_PLAN_EDIT_RULE_LAYOUT_H

#include "compiler/plan/edit/rule_text.h"
#include "runtime/base/buffer.h"

/* If the rule stands in the old text as `tartan fmt` lays it out, lays it out in the changed one, too, which is
 * replaced; what stands around it stays. TN_MEMORY. */
tn_status tn_rule_lay_out(const char *old, size_t old_size, const char *rule, tn_buffer *changed, tn_error *error);

#endif
