/* What the commands that evolve share: opening a study and the run it is to make. */
#ifndef TARTAN_CLI_GENOME_EVOLUTION_SESSION_H
#define TARTAN_CLI_GENOME_EVOLUTION_SESSION_H

#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "driver/breed/evolve.h"

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
    tn_option_number generations, seed, threads;
    tn_option_list changes;
} tn_session_settings;

typedef struct tn_evolution_session {
    tn_job *command;
    const tn_session_settings *settings;
    tn_evolution_job job;
    tn_run run;
    uint32_t generations; /* to be bred, after the first */
    bool remembers;
    bool exhausted; /* it ended because there is nothing left to be scored */
    bool written;   /* best/ and the rest are those of its last generation */
    char *parameters_study; /* owned: the name of the study that parameters became, or NULL */
} tn_evolution_session;

/* Opens the study that the first operand names, begins or resumes its run, and has it worked on, interruptible. The
 * command's exit code. remembers: whoever was born can be chosen as a parent later. */
int tn_evolution_session_run(const tn_session_settings *settings, bool remembers,
                             void (*work)(tn_evolution_session *evolution));

/* Warns of what the first generation shows, once it was made here. */
void tn_evolution_session_warn(tn_evolution_session *evolution);

#endif
