/* A shard set of the plans of a library, or of a sample of them, as a command asks for it. */
#ifndef TARTAN_CLI_PLAN_NEW_SET_H
#define TARTAN_CLI_PLAN_NEW_SET_H

#include "cli/plan/found_rows.h"
#include "driver/shards/set.h"

/* All is borrowed. written: its output is the folder. */
typedef struct tn_new_set {
    const char *path; /* of the rule file, as it was written */
    const tn_plan_settings *plans;
    const tn_written_settings *written;
    const char *from, *to; /* ranks, or NULL */
    uint64_t shards, each; /* so many shards, or shards of so many plans each; the other is 0 */
    bool compress;
    bool sampled; /* only a sample of so many plans */
    uint64_t sample, seed;
    bool uniform; /* the sample leaves weights out */
} tn_new_set;

/* Are there a folder, and a rule file whose name a manifest can hold? False: what is wrong was said. */
bool tn_new_set_named(tn_job *job, const char *folder, const char *path);

/* The same, and can shards be written so? */
bool tn_new_set_fits(tn_job *job, const tn_new_set *what);

/* Makes a set that is described, with the module that the job has open: just compiled, or the bytes of its file. */
tn_status tn_new_set_create(tn_job *job, tn_shard_set *set, tn_error *error);

/* What has the ranks that the shards divide: so many `things` ("plans", "houses") of a library. format: what they are
 * written as if the command does not say. */
typedef struct tn_new_set_of {
    tn_shard_task task;
    tn_plan_format format;
    const char *things, *library;
    const tn_library *plans;
    const tn_schema *schema;
    mpz_srcptr all;
} tn_new_set_of;

/* Makes the set, and says how large it is. */
void tn_new_set_make(tn_job *job, const tn_new_set *what, const tn_new_set_of *of);

/* The same, of the plans of a library. */
void tn_job_new_set(tn_job *job, const tn_ready_library *ready, const tn_new_set *what);

#endif
