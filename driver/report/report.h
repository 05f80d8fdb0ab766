/* A library as one HTML page that needs nothing else: its counts as a chart, its rules with their pictures, and a sheet
 * of plans, kept and dropped, each with the reasons.
 */
#ifndef TARTAN_DRIVER_REPORT_REPORT_H
#define TARTAN_DRIVER_REPORT_REPORT_H

#include "driver/coverage/coverage.h"
#include "driver/plan/analysis.h"
#include "driver/plan/explain.h"

typedef struct tn_report_options {
    uint64_t seed;
    size_t samples;      /* plans that are kept, and as many that are generated and dropped */
    uint32_t max_states; /* as in tn_library_options */
} tn_report_options;

/* Appends the page. The library is ready (with its automaton); the analyses and the coverage are of the same file. */
tn_status tn_report_page(tn_opened *opened, const tn_ready_library *ready, const tn_plan_analyses *analyses,
                         const tn_covered *covered, const tn_report_options *options, tn_buffer *page, tn_error *error);

#endif
