/* A library as one HTML page that needs nothing else: its counts as a chart, its rules with their pictures, and a sheet
 * of plans, kept and dropped, each with the reasons.
 */
#ifndef TARTAN_DRIVER_REPORT_H
#define TARTAN_DRIVER_REPORT_H

#include "driver/analysis.h"
#include "driver/library.h"
#include "runtime/plan/text.h"

typedef struct tn_report_options {
    uint64_t seed;
    size_t samples;      /* plans that are kept, and as many that are generated and dropped */
    uint32_t max_states; /* as in tn_library_options */
    const char *scratch; /* a file beside the report, ending in .svg, that pictures are drawn to and that is removed */
} tn_report_options;

/* Appends the page. The library is ready (with its automaton); the analyses are of the same file. */
tn_status tn_report_page(tn_opened *opened, const tn_ready_library *ready, const tn_plan_analyses *analyses,
                         const tn_report_options *options, tn_buffer *page, tn_error *error);

/* ---- pieces (report_html.c) */

/* A text with &, <, > and quotes written for HTML. */
bool tn_report_text(tn_buffer *page, const char *text, size_t size);

/* An <img> with the picture file in it, which is removed. */
tn_status tn_report_picture(tn_buffer *page, const char *path, const char *description, tn_error *error);

/* A number with commas. */
bool tn_report_number(tn_buffer *page, const mpz_t number);

/* The chart of plans by length: `generated` and `kept` of lengths low, low + 1, ... */
bool tn_report_chart(tn_buffer *page, uint32_t low, const mpz_t *generated, const mpz_t *kept, size_t count);

extern const char tn_report_head[], tn_report_foot[];

#endif
