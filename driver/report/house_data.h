/* What the parts of a report of houses share (house_*.c). */
#ifndef TARTAN_DRIVER_REPORT_HOUSE_DATA_H
#define TARTAN_DRIVER_REPORT_HOUSE_DATA_H

#include "driver/report/house_report.h"
#include "driver/report/page.h"

typedef struct tn_house_reporting {
    const tn_house_report *report;
    const tn_module *module;
    tn_page page;
} tn_house_reporting;

/* A length in the units of the schema. */
bool tn_house_put_length(const tn_house_reporting *r, int64_t length);

/* What the form declares: storeys, functions, openings, faces, and tiles with their boxes. */
bool tn_house_report_form(const tn_house_reporting *r);

#endif
