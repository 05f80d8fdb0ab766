/* What commands about plans print, for those that answer several questions at once. */
#ifndef TARTAN_CLI_PLAN_ANSWERS_H
#define TARTAN_CLI_PLAN_ANSWERS_H

#include "ask/session/requests.h"
#include "cli/plan/library_job.h"
#include "driver/plan/tests.h"

/* Asks how many there are and writes the answer; path: NULL is standard output. */
void tn_job_count(tn_job *job, const tn_count_request *request, bool json, const char *path);

/* How two libraries are compared: all zero as `tartan diff` does without options. */
typedef struct tn_compare_options {
    tn_option_number sample, seed;
    bool json, without_measures;
    const char *output, *title; /* of a picture */
} tn_compare_options;

/* Two libraries that are open, and their files. */
typedef struct tn_compared {
    const char *paths[2];
    const tn_ready_library *before, *after;
    uint32_t max_states; /* 0: the default */
} tn_compared;

/* What `tartan diff` prints of the two. The job is the one that has the second open. */
void tn_job_compare(tn_job *job, const tn_compared *compared, const tn_compare_options *options);

/* The last line of `tartan test`. */
void tn_test_counts_write(const tn_test_counts *counts, FILE *out);

/* The same as JSON; coverage and solids: what stands between the brackets of arrays, or NULL. */
void tn_test_counts_json(const tn_test_counts *counts, const char *coverage, const char *solids, FILE *out);

#endif
