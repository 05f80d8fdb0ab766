/* A condition's code written back as the author would write it. */
#ifndef TARTAN_PLAN_MATCH_CONDITION_TEXT_H
#define TARTAN_PLAN_MATCH_CONDITION_TEXT_H

#include "runtime/module/module.h"

#define TN_CONDITION_TEXT_MAX 160

/* Writes "n > 1 and not n mod 3 = 1" for a condition function of a verified module; "..." where that would be too long.
 */
void tn_condition_text(const tn_module *module, uint32_t function, char text[TN_CONDITION_TEXT_MAX]);

#endif
