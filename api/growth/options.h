/* How a surface of the C interface grows. */
#ifndef TARTAN_API_GROWTH_OPTIONS_H
#define TARTAN_API_GROWTH_OPTIONS_H

#include "api/growth/growth.h"

/* What the module says, with the caller's options in its place (NULL: none) and his surroundings besides. Clear the
 * study in any case. */
tartan_status tn_api_growth_study(const tartan_module *module, const tartan_growth_options *options, tn_study *study,
                                  tartan_error *error);

#endif
