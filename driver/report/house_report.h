/* A form and a library of its houses as one HTML page that needs nothing else: what the form declares, with its tiles
 * drawn; how many houses there are, and what each clause keeps out; and some of the houses, drawn.
 */
#ifndef TARTAN_DRIVER_REPORT_HOUSE_REPORT_H
#define TARTAN_DRIVER_REPORT_HOUSE_REPORT_H

#include <gmp.h>

#include "driver/report/house_page.h"

/* All of it is borrowed. lengths: houses by number of trays, from low to high; kept_out, alone: of the houses that the
 * form allows by each clause, and only by it. NULL: not counted, and `limit` says why. */
typedef struct tn_house_report {
    tn_opened *opened;
    const tn_house_form *form;
    const tn_house_library_record *library;
    uint32_t low, high;
    mpz_t *lengths, *kept_out, *alone;
    const char *limit;
    const tn_reported_house *houses;
    size_t house_count;
    uint64_t seed;
} tn_house_report;

/* Appends the page. */
tn_status tn_house_report_page(const tn_house_report *report, tn_buffer *page, tn_error *error);

#endif
