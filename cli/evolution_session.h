/* What the commands that evolve share: opening a study and the run it is to make. */
#ifndef TARTAN_CLI_EVOLUTION_SESSION_H
#define TARTAN_CLI_EVOLUTION_SESSION_H

#include "cli/job.h"
#include "cli/option_rows.h"
#include "driver/evolve.h"

#define OPTION_RUN_DIR                                                                                                 \
    TEXT("output", 'o', "DIR", output, "the run's folder (default: the study's name with .run instead of .study)")
#define OPTION_RUN_RESUME FLAG("resume", 0, resume, "go on with the run in the folder, if there is one")
#define OPTION_RUN_SET                                                                                                 \
    LIST("set", 0, "\"NAME VALUE\"", changes,                                                                          \
         "with --resume: from here on another target or weight, as \"length-weight 0.01\"; may be repeated")
#define OPTION_RUN_SEED NUMBER("seed", 's', "S", seed, 0, 0, "another seed than the study's")
#define OPTION_RUN_DURABLE FLAG("durable", 0, durable, "sync every generation to the disk, against loss of power")

typedef struct tn_evolution_session {
    tn_job *command;
    tn_evolution_job job;
    tn_run run;
    uint32_t generations; /* to be bred, after the first */
} tn_evolution_session;

/* Opens the study that the first operand names, and begins or resumes its run. False where that failed. Close it in any
 * case, before the job ends. */
bool tn_evolution_session_open(tn_job *command, tn_evolution_session *evolution);
void tn_evolution_session_close(tn_evolution_session *evolution);

#endif
