/* Are two functions the same code, though they are of two modules? Records may have other numbers there; what they say
 * counts. Functions that do the same by other code are taken for different ones.
 */
#ifndef TARTAN_PLAN_MATCH_SAME_H
#define TARTAN_PLAN_MATCH_SAME_H

#include "runtime/module/module.h"

/* *same: does `function` of one module do the same as `other` of the other one, with all that they call? Both modules
 * have the same schemas. */
tn_status tn_functions_same(const tn_module *module, uint32_t function, const tn_module *other_module, uint32_t other,
                            bool *same, tn_error *error);

/* A hash of the code of a function, with all that it calls: whatever numbers its records have in the module, and the
 * same on every machine. Functions that do the same by other code have other hashes. */
tn_status tn_code_hash(const tn_module *module, uint32_t function, uint64_t hash[2], tn_error *error);

#endif
