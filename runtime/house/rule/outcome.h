/* Decisions of which only a part is known: false, true, or still open. */
#ifndef TARTAN_HOUSE_RULE_OUTCOME_H
#define TARTAN_HOUSE_RULE_OUTCOME_H

#include "runtime/house/house_names.h"
#include "runtime/module/code.h"

typedef enum tn_outcome { TN_OUTCOME_FALSE, TN_OUTCOME_TRUE, TN_OUTCOME_OPEN } tn_outcome;

/* What is known of an instruction that has no inputs. */
typedef tn_outcome tn_outcome_ask(const void *context, const tn_instruction *instruction);

/* What is known of a function of kind CELL, SECTION or ROOM. */
tn_outcome tn_outcome_decide(const tn_module *module, uint32_t function, tn_outcome_ask *ask, const void *context);

#endif
