/* What `tartan diff` prints: counts, the clauses that are responsible, and some of the plans. */
#ifndef TARTAN_CLI_PLAN_DIFF_REPORT_H
#define TARTAN_CLI_PLAN_DIFF_REPORT_H

#include <stdio.h>

#include "cli/plan/diff_measures.h"
#include "runtime/plan/library/diff.h"

/* Plans of one part to be shown: the first, then some drawn at random. */
typedef struct tn_diff_sample {
    mpz_t *ranks;
    size_t count, room;
} tn_diff_sample;

typedef struct tn_diff_report {
    const tn_library_diff *diff;
    const char *paths[2];
    const tn_module *modules[2];
    const tn_library_record *records[2];
    tn_diff_sample samples[TN_DIFF_PARTS];
    const tn_measure_changes *measures; /* NULL: left out */
} tn_diff_report;

extern const char *const tn_diff_part_names[TN_DIFF_PARTS]; /* "removed", "added", "kept" */

/* Chooses the plans to be shown: the first of each part and `count` at random. Clear in any case. */
tn_status tn_diff_samples_take(tn_diff_report *report, size_t count, uint64_t seed, tn_error *error);
void tn_diff_samples_clear(tn_diff_report *report);

/* The plan of a rank of a part: its trays (room for the part's longest), and its rank in its own library. */
tn_status tn_diff_plan(const tn_diff_report *report, tn_diff_part part, const mpz_t rank, tn_tray *trays,
                       uint32_t *length, mpz_t own, tn_error *error);

tn_status tn_diff_write_text(const tn_diff_report *report, FILE *out, tn_error *error);
tn_status tn_diff_write_json(const tn_diff_report *report, FILE *out, tn_error *error);

#endif
