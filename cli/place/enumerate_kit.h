/* What `tartan enumerate` does with a kit: every building of so many of its parts, once. */
#ifndef TARTAN_CLI_PLACE_ENUMERATE_KIT_H
#define TARTAN_CLI_PLACE_ENUMERATE_KIT_H

#include "cli/place/kit_options.h"

/* Which of the buildings, by their ranks; digits, or NULL: from the first, and to the last. */
typedef struct tn_building_range {
    const char *from, *to;
    tn_option_number limit;
} tn_building_range;

/* Writes a line for each building, or an object if `json`; where `path` ends in .mpd, a sub-file for each. */
void tn_job_enumerate_kit(tn_job *job, const tn_kit_options *options, bool json, const tn_building_range *range,
                          const char *path);

#endif
