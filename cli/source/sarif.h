/* Findings as a SARIF 2.1.0 log (docs.oasis-open.org/sarif/sarif/v2.1.0), which code hosts show beside the lines. */
#ifndef TARTAN_CLI_SOURCE_SARIF_H
#define TARTAN_CLI_SOURCE_SARIF_H

#include "cli/common/job.h"
#include "runtime/base/json.h"

/* Listens to a job. Begin it before, in the place where it stays; write it and clear it after. */
typedef struct tn_sarif {
    tn_listener listener; /* first */
    tn_buffer results;
    tn_json json;    /* writes them, as they come */
    uint32_t *rules; /* the codes of those that they are about */
    size_t rule_count, rule_capacity;
    uint64_t *lines; /* hashes of what each finding is known again by */
    size_t line_count, line_capacity;
} tn_sarif;

void tn_sarif_begin(tn_sarif *sarif);
void tn_sarif_clear(tn_sarif *sarif);

/* path: "-" is standard output. */
tn_status tn_sarif_write(const tn_sarif *sarif, const char *path, tn_error *error);

#endif
