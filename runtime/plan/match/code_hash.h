/* A hash of the code of a rule's function, with all that it calls: whatever numbers its records have in the module.
 * Functions that do the same by other code have other hashes. */
#ifndef TARTAN_PLAN_MATCH_CODE_HASH_H
#define TARTAN_PLAN_MATCH_CODE_HASH_H

#include "runtime/module/module.h"

/* The same on every machine. */
tn_status tn_code_hash(const tn_module *module, uint32_t function, uint64_t hash[2], tn_error *error);

#endif
