/* A kit as one HTML page that needs nothing else: its parts with pictures of their connectors, which connectors join,
 * which rule places which parts, and its models, placed and held to what they require.
 */
#ifndef TARTAN_DRIVER_REPORT_KIT_REPORT_H
#define TARTAN_DRIVER_REPORT_KIT_REPORT_H

#include "driver/open/open.h"
#include "runtime/plan/text/text.h"

#define TN_KIT_REPORT_PICTURES 500
#define TN_KIT_REPORT_PARTS 1000
#define TN_KIT_REPORT_STEPS 20000000
#define TN_KIT_REPORT_SEARCH 5000

/* How much work a page may be; 0: as above. What passes a limit is said on the page. */
typedef struct tn_kit_report_options {
    uint32_t seed;         /* of each model */
    size_t pictures;       /* of parts; those beyond are listed without */
    uint64_t part_limit;   /* of a model */
    uint64_t step_limit;   /* of a model that is placed without a search */
    uint64_t search_limit; /* models that a search looks at */
    tn_watch *watch;       /* or NULL */
} tn_kit_report_options;

/* What became of the kit's models. */
typedef struct tn_kit_report_tally {
    size_t models, unplaced; /* unplaced: not, or not to their end */
    size_t unmet;            /* requirements of those placed that do not hold */
} tn_kit_report_tally;

/* Appends the page of a file that holds a kit. TN_MEMORY, TN_STOPPED; what cannot be placed is no failure. The
 * diagnostics of `opened` stay as they are. */
tn_status tn_kit_report_page(tn_opened *opened, const tn_kit_report_options *options, tn_buffer *page,
                             tn_kit_report_tally *tally, tn_error *error);

#endif
