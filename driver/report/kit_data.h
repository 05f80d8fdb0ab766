/* What the parts of a kit's report share, each in a file of its own (kit_*.c). */
#ifndef TARTAN_DRIVER_REPORT_KIT_DATA_H
#define TARTAN_DRIVER_REPORT_KIT_DATA_H

#include "driver/report/kit_report.h"
#include "driver/report/page.h"

typedef struct tn_kit_reporting {
    tn_opened *opened;
    const tn_module *module;
    tn_kit_report_options options; /* none is 0 but the seed, and the watch NULL */
    tn_kit_report_tally *tally;
    double unit[3]; /* a cell's sides, in LDU */
    tn_page page;
} tn_kit_reporting;

/* A kind of connectors with a square in its colour, as in the pictures of parts. */
bool tn_kit_report_type(const tn_kit_reporting *r, uint32_t type);

/* The text of a record's place in its source. */
bool tn_kit_report_source(const tn_kit_reporting *r, uint32_t file, uint32_t begin, uint32_t end);

tn_status tn_kit_report_parts(tn_kit_reporting *r);
tn_status tn_kit_report_rules(tn_kit_reporting *r);
tn_status tn_kit_report_models(tn_kit_reporting *r);

#endif
