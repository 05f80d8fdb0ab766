/* Findings as a SARIF 2.1.0 log (docs.oasis-open.org/sarif/sarif/v2.1.0), which code hosts show beside the lines. */
#ifndef TARTAN_CLI_SOURCE_SARIF_H
#define TARTAN_CLI_SOURCE_SARIF_H

#include <jansson.h>

#include "cli/common/job.h"

/* Listens to a job. Begin it before, write it or clear it after. */
typedef struct tn_sarif {
    tn_listener listener; /* first */
    json_t *results, *rules;
} tn_sarif;

void tn_sarif_begin(tn_sarif *sarif);
void tn_sarif_clear(tn_sarif *sarif);

/* path: "-" is standard output. */
tn_status tn_sarif_write(const tn_sarif *sarif, const char *path, tn_error *error);

#endif
