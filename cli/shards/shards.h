/* What the parts of `tartan shards` have in common: the options, and opening a set. */
#ifndef TARTAN_CLI_SHARDS_SHARDS_H
#define TARTAN_CLI_SHARDS_SHARDS_H

#include "ask/house/numbered.h"
#include "ask/plan/match.h"
#include "cli/plan/found_rows.h"
#include "cli/plan/new_set.h"
#include "cli/plan/plan_input.h"
#include "driver/plan/answering.h"
#include "driver/plan/provenance.h"
#include "driver/shards/run.h"
#include "driver/shards/set.h"

typedef struct tn_shards_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_written_settings written;
    int task;              /* a tn_shard_task */
    tn_option_list inputs; /* --input; further operands are inputs too */
    tn_option_list rules;  /* --rule */
    tn_input_settings input;
    tn_option_number shards, each; /* --shards, --plans */
    const char *from, *to;
    tn_option_number sample, seed;
    bool uniform;
    int compress; /* 1: zstd */
    tn_option_number shard;
    const char *part, *time, *stale;
} tn_shards_settings;

static inline const tn_shards_settings *tn_shards_settings_of(const tn_job *job)
{
    return (const tn_shards_settings *)job->settings;
}

/* A set that a command works on. Zero it to begin with; clear it after the job's end. */
typedef struct tn_shards_open {
    tn_shard_set set;
    tn_ready_library ready;
    tn_chosen_rules rules; /* of a set of answers, with what is said of plans */
    tn_matched matched;
    tn_pruned pruned;
    tn_answering answering;
    tn_numbered houses; /* of a set of houses, with where they come from */
    tn_provenance described;
    char *module; /* its path, which the job borrows */
} tn_shards_open;

/* What --format says beside the formats of plans. */
enum { TN_SHARDS_NAMES = TN_FORMAT_COUNT, TN_SHARDS_BITS, TN_SHARDS_ANY };

/* Opens the module of a set that was read, and its library or rules, which must agree with the manifest. */
bool tn_shards_open_rules(tn_job *job, tn_shards_open *open);

/* Makes ready what the set's answers are made by, of the file that the job has open. */
bool tn_shards_ready_answers(tn_job *job, tn_shards_open *open);

/* The seconds after which a claim is stale; false where the option is no time, which is recorded. */
bool tn_shards_stale(tn_job *job, double *seconds);

/* Each does one thing that `tartan shards` does, and records what went wrong. */
void tn_shards_new(tn_job *job);
void tn_shards_new_answers(tn_job *job, tn_shards_open *open);
void tn_shards_status(tn_job *job, tn_shards_open *open);
void tn_shards_check_set(tn_job *job, tn_shards_open *open);

/* ---- houses.c: a shard is a table of houses, one of their rooms and one of their faces */

/* Does the name mean a library of houses of the file that the job has open? */
bool tn_shards_of_houses(const tn_job *job, const char *library);

/* Makes a set of them. What went wrong is recorded, also by the others here. */
void tn_shards_new_houses(tn_job *job, const tn_new_set *what);

/* Makes ready what the set's houses are counted by: open->houses and open->described. */
bool tn_shards_ready_houses(tn_job *job, tn_shards_open *open);

/* Writes a shard of the set that `context` is, a tn_shards_open (tn_shard_houses). */
tn_status tn_shards_write_houses(void *context, const char *path, const mpz_t from, const mpz_t to, uint64_t before,
                                 tn_shard_between *between, void *of, uint64_t *written, tn_error *error);

/* Writes the tables of all shards as CSV or into a database. */
void tn_shards_gather_houses(tn_job *job, tn_shards_open *open, const char *output, tn_plan_format format);

#endif
