/* Reading a module's file with the engines that are given: what runtime/load.h does with all of them. */
#ifndef TARTAN_MODULE_READ_H
#define TARTAN_MODULE_READ_H

#include "runtime/module/engine.h"

/* Loads and verifies a module. `limits` may be NULL (defaults). On success the caller owns *module. A module with
 * sections or code of no engine that is given is refused. TN_INVALID (E0701 to E0703), TN_LIMIT (E0810), TN_MEMORY. */
tn_status tn_module_read(const void *bytes, size_t size, const tn_engines *engines, const tn_module_limits *limits,
                         tn_module **module, tn_error *error);

#endif
