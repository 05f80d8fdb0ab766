/* What the parts of a report share, each in a file of its own (report_*.c). */
#ifndef TARTAN_DRIVER_REPORT_REPORT_DATA_H
#define TARTAN_DRIVER_REPORT_REPORT_DATA_H

#include <string.h>

#include "driver/report/report.h"
#include "runtime/base/picture.h"

typedef struct tn_reporting {
    tn_opened *opened;
    const tn_ready_library *ready;
    const tn_module *module;
    const tn_plan_analyses *analyses;
    const tn_covered *covered;
    const tn_report_options *options;
    tn_buffer *page;
    unsigned pictures; /* so far */
    tn_error *error;
} tn_reporting;

/* TN_OK, or out of memory. */
static inline tn_status tn_report_written(const tn_reporting *r, bool good)
{
    return good ? TN_OK : tn_fail_memory(r->error);
}

/* HTML as it is, and a text with &, <, > and quotes written for HTML. */
bool tn_report_html(const tn_reporting *r, const char *html);
bool tn_report_text(const tn_reporting *r, const char *text);
bool tn_report_text_part(const tn_reporting *r, const char *text, size_t size);

/* A sentence in which what stands between backticks is code. */
bool tn_report_prose(const tn_reporting *r, const char *text);

/* A number with commas; a share of a whole, in per cent with two digits that count. */
bool tn_report_number(const tn_reporting *r, const mpz_t number);
bool tn_report_share(const tn_reporting *r, const mpz_t part, const mpz_t whole);

/* A plan line. */
bool tn_report_plan(const tn_reporting *r, const tn_tray *trays, size_t length);

/* Where the next picture goes. */
tn_picture tn_report_next_picture(tn_reporting *r);

/* Puts a drawn picture into the page, and frees it. Pass on the status of the drawing. */
tn_status tn_report_put_picture(const tn_reporting *r, tn_picture *picture, const char *description, tn_status drawn);

/* The plan with the reasons why the library keeps or drops it. */
tn_status tn_report_put_explained(tn_reporting *r, const tn_explained *explained, const char *description);

/* The chart of plans by length: `generated` and `kept` of lengths low, low + 1, ... */
bool tn_report_chart(const tn_reporting *r, uint32_t low, const mpz_t *generated, const mpz_t *kept, size_t count);

/* The plan alone. */
tn_status tn_report_put_plan(tn_reporting *r, const tn_tray *trays, size_t length, const char *description);

tn_status tn_report_measures(tn_reporting *r);
tn_status tn_report_rules(tn_reporting *r);
tn_status tn_report_plans(tn_reporting *r);

extern const char tn_report_head[], tn_report_foot[];

#endif
