/* What the files that measure coverage share. Internal to driver/plan. */
#ifndef TARTAN_DRIVER_PLAN_COVERAGE_PARTS_H
#define TARTAN_DRIVER_PLAN_COVERAGE_PARTS_H

#include "compiler/plan/syntax/program.h"
#include "driver/house/dependents.h"
#include "driver/plan/coverage.h"
#include "runtime/plan/analysis/coverage.h"
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
    tn_schema *schema;
    tn_library *automaton;         /* of the library, where the caller has none */
    tn_coverage *plans;            /* of the library; without one, of the rule at hand */
    tn_coverage *tests;            /* of all rules and clauses that tests are of; NULL: there are none */
    uint32_t *tested;              /* per test block: its first function in `tests` */
    bool *left_out;                /* per test block: not known, a clause of it passes a limit */
    tn_house_cases houses;         /* of tests */
    tn_measured_houses *libraries; /* [HOUSE_LIBRARY records] */
    tn_covered *covered;
} tn_covering;

/* The rule or clause at hand, in the code of both its judgements. */
typedef struct tn_covered_subject {
    uint32_t function; /* HOLDS */
    uint32_t whole;    /* UINT32_MAX: a clause has none */
    const char *name;
    bool of_houses;
    uint32_t library; /* the HOUSE_LIBRARY in which houses are counted; TN_NO_RECORD: none uses it */
    tn_parts trees[2];
} tn_covered_subject;

/* Measures all parts of a rule or clause; one that passes a limit is left out, and that is said. */
tn_status tn_measure_subject(tn_covering *m, tn_covered_subject s, tn_error *error);

/* ---- coverage_houses.c */

/* Of a part of a rule or clause about houses: do tests notice, and how many houses depend on it? */
tn_status tn_measure_dependents(tn_covering *m, const tn_covered_subject *s, const uint32_t *offsets, size_t count,
                                tn_covered_part *made, tn_error *error);

/* The rules and clauses about houses, and the forms. */
tn_status tn_measure_houses(tn_covering *m, tn_error *error);

#endif
