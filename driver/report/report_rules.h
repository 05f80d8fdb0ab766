/* The rules of a report, and what they are written with, as the rest of the page is (report.c). */
#ifndef TARTAN_DRIVER_REPORT_REPORT_RULES_H
#define TARTAN_DRIVER_REPORT_REPORT_RULES_H

#include <string.h>

#include "driver/report/page.h"
#include "driver/report/report.h"

typedef struct tn_reporting {
    tn_opened *opened;
    const tn_ready_library *ready;
    const tn_module *module;
    const tn_plan_analyses *analyses;
    const tn_covered *covered;
    const tn_report_options *options;
    tn_page page;
} tn_reporting;

/* A number with commas; a share of a whole, in per cent with two digits that count. */
bool tn_report_number(const tn_reporting *r, const mpz_t number);
bool tn_report_share(const tn_reporting *r, const mpz_t part, const mpz_t whole);

/* A plan line. */
bool tn_report_plan(const tn_reporting *r, const tn_tray *trays, size_t length);

/* The plan with the reasons why the library keeps or drops it. */
tn_status tn_report_put_explained(tn_reporting *r, const tn_explained *explained, const char *description);

/* A card for each clause of the library, and for each rule of the file that is none. */
tn_status tn_report_rules(tn_reporting *r);

#endif
