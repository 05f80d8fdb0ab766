/* Houses on a page: each with its plans and views, its rooms and what it costs; and a few side by side. */
#ifndef TARTAN_DRIVER_REPORT_HOUSE_PAGE_H
#define TARTAN_DRIVER_REPORT_HOUSE_PAGE_H

#include "driver/open/open.h"
#include "driver/report/page.h"
#include "runtime/house/solids.h"

typedef struct tn_reported_house {
    tn_house house;
    tn_solids solids;
    char *name; /* "#12": its rank */
} tn_reported_house;

/* Its sheet (plans, sections, elevations, a view), its rooms and its parts with their prices; full: open, else to be
 * opened by who reads it. */
tn_status tn_page_put_house(tn_page *page, const tn_reported_house *reported, bool full);

/* All drawn in space, to one scale. */
tn_status tn_page_put_gallery(tn_page *page, const tn_reported_house *houses, size_t count);

/* The page of a house, or of several of one form that are compared: in space, in a table with what differs marked, and
 * one by one. */
tn_status tn_houses_page(tn_opened *opened, const tn_house_form *form, const tn_reported_house *houses, size_t count,
                         tn_buffer *page, tn_error *error);

#endif
