/* Ranks drawn from a library, as --seed, --length and --per-length say. */
#ifndef TARTAN_CLI_PLAN_SAMPLED_H
#define TARTAN_CLI_PLAN_SAMPLED_H

#include "cli/plan/library_job.h"

/* The most ranks that are drawn at once: they are all in memory. */
#define TN_SAMPLE_MAX 50000000u

/* Which ranks are drawn. Commands embed it as `sampled`. */
typedef struct tn_sampled_settings {
    tn_option_number seed, length, per_length;
    bool diverse; /* plans that differ, instead of even chances */
} tn_sampled_settings;

#define OPTION_DIVERSE                                                                                                 \
    FLAG("diverse", 0, sampled.diverse, "plans that differ from one another, instead of each as likely as each")

typedef struct tn_sampled {
    mpz_t *ranks; /* ascending */
    size_t count, room;
} tn_sampled;

/* Draws `wanted` ranks of all lengths or of --length, or as many of each length with --per-length. Notes where there
 * are fewer. False where it failed. Clear in any case. */
bool tn_job_sample(tn_job *job, const tn_ready_library *ready, const tn_sampled_settings *settings, size_t wanted,
                   tn_sampled *sampled);
void tn_sampled_clear(tn_sampled *sampled);

#endif
