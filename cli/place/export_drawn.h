/* What `tartan export` does with a model that was drawn: rules that place it again. */
#ifndef TARTAN_CLI_PLACE_EXPORT_DRAWN_H
#define TARTAN_CLI_PLACE_EXPORT_DRAWN_H

#include "cli/common/job.h"

typedef struct tn_export_drawn_options {
    const char *kit;  /* write a kit that uses this one; NULL: a connection grammar, */
    const char *init; /* which begins with this; or NULL */
    const char *output;
} tn_export_drawn_options;

/* Is it the name of an LDraw file, .ldr, .mpd or .dat? */
bool tn_path_is_drawn(const char *path);

void tn_job_export_drawn(tn_job *job, const tn_export_drawn_options *options, const char *path);

#endif
