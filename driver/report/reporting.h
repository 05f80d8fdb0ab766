/* What the files of a report of plans share: the page under way (report.c), its rules (report_rules.c) and its measures
 * (report_measures.c). */
#ifndef TARTAN_DRIVER_REPORT_REPORTING_H
#define TARTAN_DRIVER_REPORT_REPORTING_H

#include <string.h>

#include "driver/measure/spread.h"
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
    size_t pairs, pairs_unknown; /* of rules that are compared on the page, and past the limit of states */
    size_t clauses_unknown;      /* of which it is not known whether they alone keep a plan out, likewise */
} tn_reporting;

/* A number with commas; a share of a whole, in per cent with two digits that count. */
bool tn_report_number(const tn_reporting *r, const mpz_t number);
bool tn_report_share(const tn_reporting *r, const mpz_t part, const mpz_t whole);

/* A plan line. */
bool tn_report_plan(const tn_reporting *r, const tn_tray *trays, size_t length);

/* The plan with the reasons why the library keeps or drops it. */
tn_status tn_report_put_explained(tn_reporting *r, const tn_explained *explained, const char *description);

/* The plan alone. */
tn_status tn_report_put_plan(tn_reporting *r, const tn_tray *trays, size_t length, const char *description);

/* ---- measures */

typedef struct tn_reported_measure {
    uint32_t measure; /* runtime/plan/measure/named.h */
    tn_spread spread;
    char *limit; /* owned; why there is no spread; or NULL */
} tn_reported_measure;

typedef struct tn_reported_measures {
    tn_reported_measure *items;
    size_t count, room;
} tn_reported_measures;

/* Works out the measures of the library; starts as zeros. Clear in any case. */
tn_status tn_reported_measures_make(const tn_reporting *r, tn_reported_measures *measures);
void tn_reported_measures_clear(tn_reported_measures *measures);

/* A table of what plans come to; and a card for each measure. */
bool tn_report_figures(const tn_reporting *r, const tn_reported_measures *measures);
tn_status tn_report_measures(tn_reporting *r, const tn_reported_measures *measures);

/* ---- rules */

/* A card for each clause of the library, and for each rule of the file that is none. */
tn_status tn_report_rules(tn_reporting *r);

#endif
