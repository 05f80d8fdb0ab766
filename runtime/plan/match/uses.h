/* How a rule depends on the relations of its instructions: on the whole plan only, on whether there is any stretch, or
 * on which stretches there are. */
#ifndef TARTAN_PLAN_MATCH_USES_H
#define TARTAN_PLAN_MATCH_USES_H

#include "runtime/module/code.h"

typedef enum tn_relation_use {
    TN_USE_WHOLE,     /* is the whole plan in the relation? */
    TN_USE_SOMEWHERE, /* is any stretch that is not empty? */
    TN_USE_STRETCHES  /* anything else */
} tn_relation_use;

/* Shown each instruction about houses (tn_code_asks_house) that a function depends on, once for each use. */
typedef tn_status tn_use_seen(void *context, const tn_instruction *op, tn_relation_use use, tn_error *error);

/* function: asked of whole plans. */
tn_status tn_rule_uses(const tn_module *module, uint32_t function, tn_use_seen *seen, void *context, tn_error *error);

#endif
