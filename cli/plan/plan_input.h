/* Plans given to a command: opening their file as the options say, and reporting the bad ones by line. */
#ifndef TARTAN_CLI_PLAN_PLAN_INPUT_H
#define TARTAN_CLI_PLAN_PLAN_INPUT_H

#include "cli/common/job.h"
#include "cli/common/progress.h"
#include "cli/plan/library_job.h"
#include "driver/plan/answering.h"

/* How plans are read. Commands embed it as `input`. */
typedef struct tn_input_settings {
    int format;   /* a tn_plan_format */
    int on_error; /* 0 stop, 1 skip */
} tn_input_settings;

#define OPTION_INPUT_FORMAT                                                                                            \
    CHOICE("input-format", 0, "FORMAT", input.format, "auto|lines|json|csv|bin|sqlite|parquet",                        \
           "what the plans are written in (default: found out from their first bytes)")
#define OPTION_ON_ERROR                                                                                                \
    CHOICE("on-error", 0, "WHAT", input.on_error, "stop|skip",                                                         \
           "what to do at a plan that cannot be read: stop (default), or skip it; the exit code is 1 either way")

/* The plans' path: the operand after the rule file, or standard input. NULL (and wrong usage recorded) where both would
 * be standard input. */
const char *tn_job_plans_path(tn_job *job);

/* Plans to be read. */
typedef struct tn_plans_source {
    const char *path;
    const tn_input_settings *input;
    const tn_plan_settings *plans;
} tn_plans_source;

/* Opens the plans; false where that failed. */
bool tn_job_reader(tn_job *job, const tn_schema *schema, const tn_plans_source *source, tn_plan_reader **reader);

/* Records a bad plan; true where the options say to go on. */
bool tn_job_bad_plan(tn_job *job, const tn_plans_source *source, const tn_error *error, const char *text, size_t size);

/* Plans to be matched against rules, and what is to be written of each. */
typedef struct tn_sifting {
    tn_job *job;
    tn_plans_source source;
    const tn_answering *answering;
    bool (*open)(void *context); /* called when the plans could be opened; false (and recorded why) ends it there */
    FILE **streams[TN_RELAY_TEXTS]; /* where the texts go; NULL where nothing is appended to one */
    void *context;
    bool stopped;  /* before the end of the plans, by a plan that cannot be read or a failure */
    uint64_t done; /* plans written of */
    tn_progress progress;
} tn_sifting;

/* Reads the plans as the options say, and reports the bad ones. True where the outputs were opened: then they are to be
 * closed. */
bool tn_job_sift(tn_sifting *sifting);

/* Notes the rules that fell back to the interpreter. */
void tn_job_fallbacks(tn_job *job, const tn_answering *answering);

#endif
