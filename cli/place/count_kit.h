/* What `tartan count` does with a kit: how many buildings can be made of so many of its parts. */
#ifndef TARTAN_CLI_PLACE_COUNT_KIT_H
#define TARTAN_CLI_PLACE_COUNT_KIT_H

#include "cli/common/job.h"

typedef struct tn_count_kit_options {
    tn_option_number parts;
    tn_option_list kinds; /* parts by name; none: all of the kit */
    unsigned threads;     /* 0: all processors */
    const char *inside;   /* a model of the kit, or NULL */
    bool fixed, json;
} tn_count_kit_options;

/* Counts, and writes the counts to `path` (NULL: standard output). */
void tn_job_count_kit(tn_job *job, const tn_count_kit_options *options, const char *path);

#endif
