/* The changes of rules about plans, measured; and what is measured, which the rest of coverage shares (coverage.c).
 * Internal to driver/coverage. */
#ifndef TARTAN_DRIVER_COVERAGE_COVERAGE_CHANGES_H
#define TARTAN_DRIVER_COVERAGE_COVERAGE_CHANGES_H

#include "compiler/plan/syntax/program.h"
#include "driver/coverage/coverage.h"
#include "driver/house/dependents.h"
#include "runtime/plan/match/parts.h"

/* A library of houses of the file itself, opened when a part is counted in it. */
typedef struct tn_measured_houses {
    tn_dependents *dependents; /* or NULL */
    size_t asked, unknown;     /* parts; those of which the number of houses is not known */
    tn_error limit;            /* the first that was passed */
} tn_measured_houses;

/* What is measured: the file's library (or each rule by itself), and its tests. */
typedef struct tn_covering {
    tn_opened *opened;
    const tn_module *module;
    const tn_library_record *library; /* or NULL */
    uint32_t schema_index;
    const tn_coverage_options *options;
    tn_house_cases houses;         /* of tests */
    tn_measured_houses *libraries; /* [HOUSE_LIBRARY records] */
    tn_covered *covered;
} tn_covering;

/* Room for one more part; NULL where out of memory. */
tn_covered_part *tn_covered_add(tn_covered *covered);

/* Makes each change of the rules about plans, and measures it. */
tn_status tn_measure_changes(tn_covering *m, tn_error *error);

#endif
