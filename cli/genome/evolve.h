/* What the commands that evolve share: their options, and opening a study. */
#ifndef TARTAN_CLI_GENOME_EVOLVE_H
#define TARTAN_CLI_GENOME_EVOLVE_H

#include "ask/genome/evolve.h"
#include "cli/common/job.h"
#include "cli/common/options.h"

/* The options of all of them; what the number of generations means is told by each. */
#define OPTIONS_RUN(generations_help)                                                                                  \
    WRITTEN("output", 'o', "DIR", output, TN_WRITES_FOLDER,                                                            \
            "the run's folder (default: the study's name with .run instead of .study)"),                               \
        FLAG("resume", 0, resume, "continue the run in the folder, if there is one"),                                  \
        FLAG("rescore", 0, rescore,                                                                                    \
             "with --resume, where files that scores depend on have changed: score all members again"),                \
        NUMBER("generations", 'g', "N", generations, 0, 1000000, generations_help),                                    \
        LIST("set", 0, "\"NAME VALUE\"", changes,                                                                      \
             "with --resume: from here on another target, weight, rate or surroundings, as \"length-weight 0.01\", "   \
             "\"mutation codons 0.05\" or \"gravity 0 0 -0.2\"; may be repeated"),                                     \
        NUMBER("seed", 's', "S", seed, 0, 0, "another seed than the study's"), OPTION_THREADS(threads),                \
        FLAG("open", 0, open,                                                                                          \
             "of fields: draw forms that reach the box open there, so that one sees into them, instead of closed"),    \
        FLAG("run-programs", 0, run_programs, "let the study run the program that it names for scores"),               \
        FLAG("ponyge", 0, ponyge, "the file has parameters of PonyGE2, `POPULATION_SIZE: 500` a line"),                \
        FLAG("durable", 0, durable, "sync every generation to the disk, against loss of power")

typedef struct tn_session_settings {
    tn_settings common;
    const char *output; /* the run's folder */
    bool resume, durable, rescore, ponyge, run_programs, open;
    bool json; /* of evolve */
    tn_option_number generations, seed, threads;
    tn_option_list changes;
} tn_session_settings;

/* A study that is open, and the run that is asked for. */
typedef struct tn_study_job {
    tn_job job;
    tn_run_asked asked;
    char *own_dir;          /* owned: of a run whose folder is not named */
    char *parameters_study; /* owned: the name of the study that parameters became, or NULL */
} tn_study_job;

/* Begins the job, and opens the study that the first operand names; false: that failed, with several ranks on any of
 * them. End it in any case, which is the command's exit code. */
bool tn_study_job_open(tn_study_job *study, const tn_session_settings *settings);
int tn_study_job_end(tn_study_job *study);

#endif
